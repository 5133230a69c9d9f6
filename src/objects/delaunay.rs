//! Exact planar Delaunay triangulation on an integer grid.
//!
//! Enters: points with coordinates in 0..2^20. Leaves: triangles that all satisfy the Delaunay condition, and their
//! circumradii. Scanned and quantized scenes project to many collinear and cocircular points, for which plain floating
//! point decides a sixth of the orientation tests wrongly. On a grid of 20 bits every predicate is exact. `delaunator`
//! triangulates; edge flips (Lawson 1977) with adaptive predicates (Shewchuk 1997, crate `robust`) correct its errors.

use delaunator::{EMPTY, Point};
use robust::Coord;

/// Largest coordinate of a point; the smallest is 0.
pub const GRID_MAX: i64 = (1 << 20) - 1;

/// A point on the grid, `[x, y]`.
pub type GridPoint = [i64; 2];

/// A triangulation of distinct grid points.
#[derive(Debug, Clone, Default)]
pub struct Triangulation {
    /// Corners, three per triangle, as indices of the input points.
    pub corners: Vec<usize>,
    /// For each half-edge (from a corner to the next one) the opposite half-edge; `None` on the convex hull.
    twins: Vec<Option<usize>>,
    /// Circumradius of each triangle in grid units. Its square is rounded up to a whole number, so that triangles on
    /// one circle have exactly the same radius.
    pub radii: Vec<f64>,
}

impl Triangulation {
    /// The Delaunay triangulation of distinct points; empty for points on one line.
    pub fn new(points: &[GridPoint]) -> Self {
        let exact: Vec<Point> = points.iter().map(|p| Point { x: p[0] as f64, y: p[1] as f64 }).collect();
        let proposed = delaunator::triangulate(&exact);
        let twins = proposed.halfedges.iter().map(|&twin| (twin != EMPTY).then_some(twin)).collect();
        let mut triangulation = Self { corners: proposed.triangles, twins, radii: Vec::new() };
        triangulation.repair(points);
        triangulation.radii = triangulation.corners.chunks_exact(3).map(|t| circumradius(points, t)).collect();
        triangulation
    }

    /// Indices of the points on the border of the union of all triangles of at most this circumradius, ascending.
    pub fn border(&self, max_radius: f64) -> Vec<usize> {
        let keeps = |triangle: usize| self.radii[triangle] <= max_radius;
        let mut on_border = Vec::new();
        for edge in (0..self.corners.len()).filter(|edge| keeps(edge / 3)) {
            if !self.twins[edge].is_some_and(|twin| keeps(twin / 3)) {
                on_border.extend([self.corners[edge], self.corners[next(edge)]]);
            }
        }
        on_border.sort_unstable();
        on_border.dedup();
        on_border
    }

    /// Flips edges until no circumcircle contains the opposite corner of a neighboring triangle.
    fn repair(&mut self, points: &[GridPoint]) {
        let mut suspects: Vec<usize> = (0..self.corners.len()).collect();
        // Flips with exact predicates terminate. The budget guards against triangles without area from `delaunator`.
        let mut budget = 64 * suspects.len();
        while let Some(edge) = suspects.pop() {
            let Some(twin) = self.twins[edge].filter(|&twin| self.must_flip(points, edge, twin)) else { continue };
            let Some(left) = budget.checked_sub(1) else { return };
            budget = left;
            self.flip(edge, twin);
            suspects.extend([edge, next(edge), previous(edge), twin, next(twin), previous(twin)]);
        }
    }

    fn must_flip(&self, points: &[GridPoint], edge: usize, twin: usize) -> bool {
        let corner = |edge: usize| coord(points[self.corners[edge]]);
        let (a, b, c, d) = (corner(edge), corner(next(edge)), corner(previous(edge)), corner(previous(twin)));
        let inside = robust::incircle(a, b, c, d);
        if robust::orient2d(a, b, c) > 0.0 { inside > 0.0 } else { inside < 0.0 }
    }

    /// Replaces the edge shared by two triangles with the other diagonal of their quadrilateral.
    fn flip(&mut self, edge: usize, twin: usize) {
        let (before, twin_before) = (previous(edge), previous(twin));
        let (outer, twin_outer) = (self.twins[before], self.twins[twin_before]);
        self.corners[edge] = self.corners[twin_before];
        self.corners[twin] = self.corners[before];
        self.link(edge, twin_outer);
        self.link(twin, outer);
        self.link(before, Some(twin_before));
    }

    fn link(&mut self, edge: usize, twin: Option<usize>) {
        self.twins[edge] = twin;
        if let Some(twin) = twin {
            self.twins[twin] = Some(edge);
        }
    }
}

/// The edge after this one in its triangle.
fn next(edge: usize) -> usize {
    if edge % 3 == 2 { edge - 2 } else { edge + 1 }
}

/// The edge before this one in its triangle.
fn previous(edge: usize) -> usize {
    if edge.is_multiple_of(3) { edge + 2 } else { edge - 1 }
}

fn coord(point: GridPoint) -> Coord<f64> {
    Coord { x: point[0] as f64, y: point[1] as f64 }
}

/// Twice the signed area of a triangle.
pub(crate) fn doubled_area(a: GridPoint, b: GridPoint, c: GridPoint) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

pub(crate) fn squared_distance(a: GridPoint, b: GridPoint) -> i64 {
    (a[0] - b[0]).pow(2) + (a[1] - b[1]).pow(2)
}

/// `abc / 4A` in grid units, with sides a, b, c and area A; infinite without area. On a 20-bit grid `(abc)^2` stays
/// below 2^123, so that its integer quotient is exact.
fn circumradius(points: &[GridPoint], triangle: &[usize]) -> f64 {
    let [a, b, c] = [points[triangle[0]], points[triangle[1]], points[triangle[2]]];
    let sides = [squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)];
    let numerator: u128 = sides.iter().map(|side| u128::from(side.unsigned_abs())).product();
    let area = u128::from(doubled_area(a, b, c).unsigned_abs());
    if area == 0 { f64::INFINITY } else { (numerator.div_ceil(4 * area * area) as f64).sqrt() }
}
