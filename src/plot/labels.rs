//! Labels beside points, each at the candidate position with the least overlap.

use super::drawing::text_width_px;

/// Left, top, right, bottom, px.
type Rect = [f64; 4];

/// The frame for labels and the areas already occupied.
pub(super) struct Labels {
    frame: Rect,
    occupied: Vec<Rect>,
}

impl Labels {
    /// An empty frame.
    pub(super) fn inside(frame: Rect) -> Self {
        Self { frame, occupied: Vec::new() }
    }

    /// Marks the area of a dot as occupied.
    pub(super) fn block(&mut self, (x, y): (f64, f64), radius: f64) {
        self.occupied.push([x - radius, y - radius, x + radius, y + radius]);
    }

    /// Left end of the base line of a label beside the dot at a point. The label's area becomes occupied.
    pub(super) fn place(&mut self, (x, y): (f64, f64), radius: f64, label: &str, font_px: f64) -> (f64, f64) {
        let (width, height) = (text_width_px(label, font_px), font_px);
        // Right, left, above, below, the corners; then the same farther away.
        let sides =
            [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0)];
        let at = |away: f64, (across, down): (f64, f64)| {
            let (middle_x, middle_y) =
                (x + across * (radius + 3.0 + away + width / 2.0), y + down * (radius + 2.0 + away + height / 2.0));
            [middle_x - width / 2.0, middle_y - height / 2.0, middle_x + width / 2.0, middle_y + height / 2.0]
        };
        let candidates = [0.0, 7.0, 16.0].into_iter().flat_map(|away| sides.map(|side| at(away, side)));
        let mut best = (f64::INFINITY, at(0.0, sides[0]));
        for candidate in candidates {
            let cost = self.cost(&candidate);
            if cost < best.0 {
                best = (cost, candidate);
            }
        }
        self.occupied.push(best.1);
        (best.1[0], best.1[3] - 0.2 * font_px)
    }

    /// Area of a candidate that is occupied, plus ten times the area outside the frame, px2.
    fn cost(&self, candidate: &Rect) -> f64 {
        let outside = area(candidate) - overlap(candidate, &self.frame);
        self.occupied.iter().map(|rect| overlap(candidate, rect)).sum::<f64>() + 10.0 * outside
    }
}

fn area([left, top, right, bottom]: &Rect) -> f64 {
    (right - left) * (bottom - top)
}

fn overlap(a: &Rect, b: &Rect) -> f64 {
    let (width, height) = (a[2].min(b[2]) - a[0].max(b[0]), a[3].min(b[3]) - a[1].max(b[1]));
    width.max(0.0) * height.max(0.0)
}
