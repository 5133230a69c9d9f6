//! A view on the page: a parallel projection at the scale of the map.

use glam::{DVec2, DVec3};

use crate::space::Space;

/// Which way a view looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum View {
    /// Down from above; up the page is ahead.
    Plan,
    /// Ahead from the side; up the page is up.
    Elevation,
}

/// A view with its rectangle on the page.
#[derive(Debug, Clone)]
pub(crate) struct Panel {
    pub(crate) view: View,
    /// World axes: right on the page, up on the page, toward the reader.
    pub(crate) right: DVec3,
    pub(crate) upward: DVec3,
    pub(crate) toward: DVec3,
    /// Coordinates along right and upward of the lower left and upper right corner.
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
    /// Upper left corner on the page, px.
    pub(crate) corner_px: DVec2,
    pub(crate) px_per_unit: f64,
}

impl Panel {
    pub(crate) fn new(view: View, space: &Space, corner_px: DVec2, px_per_unit: f64) -> Self {
        let (low, high) = (space.low, space.high);
        let (upward, toward, low, high) = match view {
            View::Plan => (space.ahead, space.up, DVec2::new(low.x, low.y), DVec2::new(high.x, high.y)),
            View::Elevation => (space.up, -space.ahead, DVec2::new(low.x, low.z), DVec2::new(high.x, high.z)),
        };
        Self { view, right: space.right, upward, toward, low, high, corner_px, px_per_unit }
    }

    /// Position of a world point on the page, px.
    pub(crate) fn to_px(&self, point: DVec3) -> DVec2 {
        let (across, up) = (point.dot(self.right) - self.low.x, self.high.y - point.dot(self.upward));
        self.corner_px + DVec2::new(across, up) * self.px_per_unit
    }

    /// Width and height on the page, px.
    pub(crate) fn size_px(&self) -> DVec2 {
        (self.high - self.low) * self.px_per_unit
    }

    /// Lower right corner on the page, px.
    pub(crate) fn end_px(&self) -> DVec2 {
        self.corner_px + self.size_px()
    }

    /// Whether a position on the page lies in the rectangle.
    pub(crate) fn is_inside(&self, at_px: DVec2) -> bool {
        at_px.cmpge(self.corner_px).all() && at_px.cmple(self.end_px()).all()
    }

    /// The parts of a finely sampled line inside the rectangle.
    pub(crate) fn pieces_inside(&self, points_px: impl Iterator<Item = DVec2>) -> Vec<Vec<DVec2>> {
        let mut pieces: Vec<Vec<DVec2>> = vec![Vec::new()];
        for point in points_px {
            match (self.is_inside(point), pieces.last_mut()) {
                (true, Some(piece)) => piece.push(point),
                (false, Some(piece)) if !piece.is_empty() => pieces.push(Vec::new()),
                _ => {}
            }
        }
        pieces.retain(|piece| piece.len() > 1);
        pieces
    }

    /// The part of a convex polygon inside the rectangle (Sutherland and Hodgman 1974).
    pub(crate) fn clipped(&self, outline_px: &[DVec2]) -> Vec<DVec2> {
        let (low, high) = (self.corner_px, self.end_px());
        let sides: [(DVec2, DVec2); 4] = [(low, DVec2::X), (low, DVec2::Y), (high, DVec2::NEG_X), (high, DVec2::NEG_Y)];
        sides.into_iter().fold(outline_px.to_vec(), |outline, (corner, inward)| {
            let depth = |point: DVec2| (point - corner).dot(inward);
            let mut kept = Vec::with_capacity(outline.len() + 1);
            for (i, &to) in outline.iter().enumerate() {
                let from = outline[(i + outline.len() - 1) % outline.len()];
                if (depth(from) < 0.0) != (depth(to) < 0.0) {
                    kept.push(from.lerp(to, depth(from) / (depth(from) - depth(to))));
                }
                if depth(to) >= 0.0 {
                    kept.push(to);
                }
            }
            kept
        })
    }
}
