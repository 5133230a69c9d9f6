//! Oracle: exact integer arithmetic over all pairs of triangle and point.

use std::collections::BTreeSet;

use cinesplat::objects::delaunay::{GRID_MAX, GridPoint, Triangulation};

use super::Dice;

fn doubled_area(a: GridPoint, b: GridPoint, c: GridPoint) -> i128 {
    let (ux, uy) = (i128::from(b[0] - a[0]), i128::from(b[1] - a[1]));
    let (vx, vy) = (i128::from(c[0] - a[0]), i128::from(c[1] - a[1]));
    ux * vy - uy * vx
}

/// Above 0 when `d` is strictly inside the circle through `a`, `b`, `c` (counter-clockwise).
fn in_circle(a: GridPoint, b: GridPoint, c: GridPoint, d: GridPoint) -> i128 {
    let row = |p: GridPoint| {
        let (x, y) = (i128::from(p[0] - d[0]), i128::from(p[1] - d[1]));
        (x, y, x * x + y * y)
    };
    let (a, b, c) = (row(a), row(b), row(c));
    a.0 * (b.1 * c.2 - c.1 * b.2) - a.1 * (b.0 * c.2 - c.0 * b.2) + a.2 * (b.0 * c.1 - c.0 * b.1)
}

/// Twice the area of the hull, by Andrew's monotone chain.
fn doubled_hull_area(points: &[GridPoint]) -> i128 {
    let mut sorted = points.to_vec();
    sorted.sort_unstable();
    let chain = |points: &mut dyn Iterator<Item = &GridPoint>| {
        let mut chain: Vec<GridPoint> = Vec::new();
        for &p in points {
            while chain.len() >= 2 && doubled_area(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0 {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut sorted.iter());
    hull.extend(chain(&mut sorted.iter().rev()));
    (1..hull.len().saturating_sub(1)).map(|i| doubled_area(hull[0], hull[i], hull[i + 1])).sum()
}

fn check(points: &[GridPoint]) {
    let triangulation = Triangulation::new(points);
    let mut area = 0;
    for triangle in triangulation.corners.chunks_exact(3) {
        let [a, b, c] = [points[triangle[0]], points[triangle[1]], points[triangle[2]]];
        let signed = doubled_area(a, b, c);
        assert_ne!(signed, 0, "a triangle without area");
        area += signed.abs();
        for &p in points {
            assert!(in_circle(a, b, c, p) * signed.signum() <= 0, "{p:?} is inside the circle of {a:?} {b:?} {c:?}");
        }
    }
    assert_eq!(area, doubled_hull_area(points), "the triangles do not tile the hull of {points:?}");
}

fn random_points(dice: &mut Dice, count: usize, side: usize, step: i64) -> Vec<GridPoint> {
    let mut points = BTreeSet::new();
    for _ in 0..count {
        points.insert([dice.below(side) as i64 * step, dice.below(side) as i64 * step]);
    }
    points.into_iter().collect()
}

#[test]
fn coarse_grids_full_of_ties_are_delaunay() {
    let mut dice = Dice::new(1);
    for round in 0..200 {
        let points = random_points(&mut dice, 4 + round % 40, 7, 149_797);
        if doubled_hull_area(&points) > 0 {
            check(&points);
        }
    }
}

#[test]
fn fine_grids_are_delaunay() {
    let mut dice = Dice::new(2);
    for _ in 0..40 {
        check(&random_points(&mut dice, 60, GRID_MAX as usize, 1));
    }
}

#[test]
fn needles_along_a_line_are_delaunay() {
    let mut dice = Dice::new(3);
    for _ in 0..40 {
        let points: BTreeSet<GridPoint> =
            (0..40).map(|_| [dice.below(GRID_MAX as usize) as i64, 500_000 + dice.below(3) as i64]).collect();
        let points: Vec<GridPoint> = points.into_iter().collect();
        if doubled_hull_area(&points) > 0 {
            check(&points);
        }
    }
}

#[test]
fn triangles_on_one_circle_have_one_radius() {
    // Twenty whole-number points at distance 65 from (100, 100).
    let steps = [(65, 0), (63, 16), (60, 25), (56, 33), (52, 39), (39, 52), (33, 56), (25, 60), (16, 63), (0, 65)];
    let points: Vec<GridPoint> = steps.iter().flat_map(|&(x, y)| [[100 + x, 100 + y], [100 - x, 100 - y]]).collect();
    let points: Vec<GridPoint> = points.into_iter().collect::<BTreeSet<_>>().into_iter().collect();
    let triangulation = Triangulation::new(&points);
    assert_eq!(triangulation.radii.len(), points.len() - 2);
    assert!(
        triangulation.radii.iter().all(|&radius| radius.to_bits() == 65.0_f64.to_bits()),
        "{:?}",
        triangulation.radii
    );
}
