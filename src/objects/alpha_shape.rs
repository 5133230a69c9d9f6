//! Alpha shapes of points in a picture.
//!
//! Enters: points in px. Leaves: for any radius the points on the shape's border, and for every pixel the least radius
//! at which the shape covers it. The alpha shape of radius r is the union of the Delaunay triangles of circumradius r
//! or less (Edelsbrunner, Kirkpatrick, Seidel 1983): empty at 0, the convex hull at infinity.

use glam::DVec2;

use super::delaunay::{GRID_MAX, GridPoint, Triangulation, doubled_area, squared_distance};

/// The alpha shapes of a set of points, for all radii.
#[derive(Debug, Clone)]
pub struct AlphaShapes {
    /// The distinct points, snapped to the grid.
    vertices: Vec<GridPoint>,
    /// Index in `vertices` of each input point.
    vertex_from_point: Vec<usize>,
    origin_px: DVec2,
    /// Pixels per grid unit.
    unit_px: f64,
    span: Span,
}

/// Distance, in grid units, by which rounding to the grid can move points off their common line.
const LINE_TOLERANCE: f64 = 1.5;

/// The dimension of the points' affine hull.
#[derive(Debug, Clone)]
enum Span {
    /// At most one point: the shape is empty, and its border is the point.
    Point,
    /// A line: the vertices in order along it.
    Line(Vec<usize>),
    /// An area.
    Plane(Triangulation),
}

impl AlphaShapes {
    /// Triangulates points (px, finite). They are first snapped to a grid of 2^20 steps over their extent, which makes
    /// all predicates exact. Coincident points become one vertex.
    pub fn new(points_px: &[DVec2]) -> Self {
        let low = points_px.iter().copied().reduce(DVec2::min).unwrap_or_default();
        let high = points_px.iter().copied().reduce(DVec2::max).unwrap_or_default();
        let extent = (high - low).max_element();
        let unit_px = if extent > 0.0 { extent / GRID_MAX as f64 } else { 1.0 };
        let snap = |p: &DVec2| ((*p - low) / unit_px).round().to_array().map(|v| (v as i64).clamp(0, GRID_MAX));
        let snapped: Vec<GridPoint> = points_px.iter().map(snap).collect();
        let mut vertices = snapped.clone();
        vertices.sort_unstable();
        vertices.dedup();
        let vertex_from_point = snapped.iter().map(|p| vertices.partition_point(|v| v < p)).collect();
        let span = span_of(&vertices);
        Self { vertices, vertex_from_point, origin_px: low, unit_px, span }
    }

    /// Indices of the input points on the border of the shape of radius `radius_px`, ascending.
    ///
    /// For points on a line, the shape is the union of the gaps of at most twice the radius, and its border is the ends
    /// of that union.
    pub fn border(&self, radius_px: f64) -> Vec<usize> {
        let radius = radius_px / self.unit_px;
        let vertices = match &self.span {
            Span::Point => (0..self.vertices.len()).collect(),
            Span::Line(order) => self.line_ends(order, radius),
            Span::Plane(triangulation) => triangulation.border(radius),
        };
        let mut on_border = vec![false; self.vertices.len()];
        for vertex in vertices {
            on_border[vertex] = true;
        }
        (0..self.vertex_from_point.len()).filter(|&point| on_border[self.vertex_from_point[point]]).collect()
    }

    /// The least radius (px) at which the shape covers each pixel's center, row-major; infinite outside the convex
    /// hull.
    pub fn covering_radii_px(&self, width: usize, height: usize) -> Vec<f32> {
        let mut radii = vec![f32::INFINITY; width * height];
        let Span::Plane(triangulation) = &self.span else { return radii };
        for (corners, &radius) in triangulation.corners.chunks_exact(3).zip(&triangulation.radii) {
            let corner = |i: usize| self.position_px(corners[i]);
            fill_triangle([corner(0), corner(1), corner(2)], (radius * self.unit_px) as f32, &mut radii, width);
        }
        radii
    }

    fn position_px(&self, vertex: usize) -> DVec2 {
        let [x, y] = self.vertices[vertex];
        self.origin_px + DVec2::new(x as f64, y as f64) * self.unit_px
    }

    fn line_ends(&self, order: &[usize], radius: f64) -> Vec<usize> {
        let joined = |pair: &[usize]| {
            let gap = squared_distance(self.vertices[pair[0]], self.vertices[pair[1]]) as f64;
            gap.sqrt() <= 2.0 * radius
        };
        let bridges: Vec<bool> = order.windows(2).map(joined).collect();
        let is_end = |i: &usize| {
            let before = *i > 0 && bridges[i - 1];
            let after = bridges.get(*i).copied().unwrap_or(false);
            before != after
        };
        (0..order.len()).filter(is_end).map(|i| order[i]).collect()
    }
}

/// Tests for a line before triangulating. Snapping moves points off a slanted line by less than a unit, so that points
/// within [`LINE_TOLERANCE`] units of the line through two far points count as on it.
fn span_of(vertices: &[GridPoint]) -> Span {
    let Some(&start) = vertices.first().filter(|_| vertices.len() > 1) else { return Span::Point };
    let farthest_from = |from: GridPoint| vertices.iter().copied().max_by_key(|&p| squared_distance(from, p));
    let low = farthest_from(start).unwrap_or(start);
    let high = farthest_from(low).unwrap_or(low);
    let length = (squared_distance(low, high) as f64).sqrt();
    if vertices.iter().any(|&p| doubled_area(low, high, p).abs() as f64 > LINE_TOLERANCE * length) {
        return Span::Plane(Triangulation::new(vertices));
    }
    let along = |p: GridPoint| (p[0] - low[0]) * (high[0] - low[0]) + (p[1] - low[1]) * (high[1] - low[1]);
    let mut order: Vec<usize> = (0..vertices.len()).collect();
    order.sort_by_key(|&i| along(vertices[i]));
    Span::Line(order)
}

/// Lowers `values` to at most `value` at every pixel whose center lies in the triangle or on its edge.
fn fill_triangle(corners_px: [DVec2; 3], value: f32, values: &mut [f32], width: usize) {
    let [a, b, c] = corners_px;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let height = values.len() / width.max(1);
    let first = |low: f64| (low - 0.5).ceil().max(0.0) as usize;
    let end = |high: f64, size: usize| ((high - 0.5).floor() + 1.0).clamp(0.0, size as f64) as usize;
    for y in first(low.y)..end(high.y, height) {
        for x in first(low.x)..end(high.x, width) {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let sides = [(b - a).perp_dot(p - a), (c - b).perp_dot(p - b), (a - c).perp_dot(p - c)];
            if sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0) {
                let old = &mut values[y * width + x];
                *old = old.min(value);
            }
        }
    }
}
