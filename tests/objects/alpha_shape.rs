//! Oracles: the convex hull by brute force, shapes with a known border, and invariances.

use cinesplat::objects::alpha_shape::AlphaShapes;
use glam::{DMat2, DVec2};

use super::Dice;

fn cloud(seed: u64, count: usize) -> Vec<DVec2> {
    let mut dice = Dice::new(seed);
    (0..count).map(|_| DVec2::new(dice.unit(), dice.unit()) * 100.0).collect()
}

/// Points on the convex hull, by brute force: the ends of every line through two points with all others on its left.
fn hull_by_all_pairs(points: &[DVec2]) -> Vec<usize> {
    let is_edge = |a: usize, b: usize| {
        a != b
            && (0..points.len())
                .all(|c| c == a || c == b || (points[b] - points[a]).perp_dot(points[c] - points[a]) > 0.0)
    };
    let mut hull: Vec<usize> =
        (0..points.len()).filter(|&a| (0..points.len()).any(|b| is_edge(a, b) || is_edge(b, a))).collect();
    hull.dedup();
    hull
}

#[test]
fn an_infinite_radius_gives_the_hull() {
    for seed in 0..20 {
        let points = cloud(seed, 40);
        assert_eq!(AlphaShapes::new(&points).border(f64::INFINITY), hull_by_all_pairs(&points));
    }
}

#[test]
fn a_radius_of_zero_gives_nothing() {
    assert_eq!(AlphaShapes::new(&cloud(1, 40)).border(0.0), Vec::<usize>::new());
}

#[test]
fn few_points_have_defined_borders() {
    let at = |x: f64, y: f64| DVec2::new(x, y);
    assert_eq!(AlphaShapes::new(&[]).border(1.0), Vec::<usize>::new());
    assert_eq!(AlphaShapes::new(&[at(3.0, 4.0)]).border(1.0), [0]);
    assert_eq!(AlphaShapes::new(&[at(3.0, 4.0); 5]).border(1.0), [0, 1, 2, 3, 4], "coincident points are one point");
    let two = AlphaShapes::new(&[at(0.0, 0.0), at(2.0, 0.0)]);
    assert_eq!(two.border(f64::INFINITY), [0, 1]);
    assert_eq!(two.border(0.9), Vec::<usize>::new(), "a gap longer than twice the radius");
    let three = AlphaShapes::new(&[at(0.0, 0.0), at(6.0, 0.0), at(0.0, 8.0)]);
    assert_eq!(three.border(5.01), [0, 1, 2]);
    assert_eq!(three.border(4.99), Vec::<usize>::new(), "the circle through a 6-8-10 triangle has radius 5");
}

#[test]
fn points_on_a_line_give_the_ends_of_its_pieces() {
    let on_line = |t: f64| DVec2::new(1.0, 2.0) + DVec2::new(3.0, 4.0) * t;
    let points: Vec<DVec2> = [0.0, 0.1, 0.2, 0.3, 2.0, 2.1, 9.0].into_iter().map(on_line).collect();
    let shapes = AlphaShapes::new(&points);
    assert_eq!(shapes.border(0.26), [0, 3, 4, 5], "gaps of 0.5 close at a radius of 0.25");
    assert_eq!(shapes.border(f64::INFINITY), [0, 6]);
}

#[test]
fn a_ring_has_an_inner_border_until_the_radius_closes_it() {
    let points: Vec<DVec2> = (0..4)
        .flat_map(|ring| (0..120).map(move |i| (10.0 + f64::from(ring), f64::from(i) * std::f64::consts::TAU / 120.0)))
        .map(|(radius, angle)| DVec2::from_angle(angle) * radius)
        .collect();
    let shapes = AlphaShapes::new(&points);
    let innermost = |border: &[usize]| border.iter().filter(|&&i| i < 120).count();
    assert_eq!(innermost(&shapes.border(3.0)), 120);
    assert_eq!(innermost(&shapes.border(11.0)), 0, "the hole has radius 10");
}

#[test]
fn order_and_repetition_do_not_matter() {
    let mut dice = Dice::new(5);
    for seed in 0..10 {
        // Half of the clouds lie on a coarse grid, for many ties.
        let quantum = if seed % 2 == 0 { 10.0 } else { 1e-3 };
        let points: Vec<DVec2> = cloud(seed, 150).iter().map(|p| (*p / quantum).round() * quantum).collect();
        let mut shuffled: Vec<DVec2> = points.iter().chain(&points[..30]).copied().collect();
        dice.shuffle(&mut shuffled);
        for radius in [3.0, 7.071_067_9, 12.0, f64::INFINITY] {
            let positions = |points: &[DVec2]| {
                let shapes = AlphaShapes::new(points);
                let mut carried: Vec<[i64; 2]> = shapes
                    .border(radius)
                    .iter()
                    .map(|&i| (points[i] * 1e3).round().to_array().map(|v| v as i64))
                    .collect();
                carried.sort_unstable();
                carried.dedup();
                carried
            };
            assert_eq!(positions(&points), positions(&shuffled), "cloud {seed}, radius {radius}");
        }
    }
}

#[test]
fn a_rigid_motion_does_not_matter() {
    for seed in 0..10 {
        let points = cloud(seed, 200);
        let turn = DMat2::from_angle(0.3 + seed as f64);
        let moved: Vec<DVec2> = points.iter().map(|p| turn * *p + DVec2::new(-740.0, 12.5)).collect();
        for radius in [5.0, 8.0, 20.0, f64::INFINITY] {
            assert_eq!(AlphaShapes::new(&points).border(radius), AlphaShapes::new(&moved).border(radius));
        }
    }
}

#[test]
fn covering_radii_agree_with_the_shapes() {
    // Every triangle of a square grid with spacing 4 has the circumradius sqrt(8).
    let points: Vec<DVec2> = (0..36).map(|i| DVec2::new(f64::from(i % 6), f64::from(i / 6)) * 4.0 + 2.0).collect();
    let radii = AlphaShapes::new(&points).covering_radii_px(24, 24);
    let inside = |i: usize| (2..22).contains(&(i % 24)) && (2..22).contains(&(i / 24));
    for (i, radius) in radii.iter().enumerate() {
        let expected = if inside(i) { 8.0_f32.sqrt() } else { f32::INFINITY };
        assert!(radius.to_bits() == expected.to_bits() || (radius - expected).abs() < 1e-4, "pixel {i}: {radius}");
    }
}
