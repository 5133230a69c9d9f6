//! Words beside points: each goes to the place about its point where it covers least.

use super::text::text_width;

/// Left, top, right, bottom, px.
type Box4 = [f64; 4];

/// Where words may go and what is there already.
pub(super) struct Labels {
    frame: Box4,
    taken: Vec<Box4>,
}

impl Labels {
    /// Nothing inside a frame.
    pub(super) fn inside(frame: Box4) -> Self {
        Self { frame, taken: Vec::new() }
    }

    /// Keeps words off a dot.
    pub(super) fn block(&mut self, (x, y): (f64, f64), radius: f64) {
        self.taken.push([x - radius, y - radius, x + radius, y + radius]);
    }

    /// Left end of the base line of a word beside the dot at a point; the place is taken from then on.
    pub(super) fn place(&mut self, (x, y): (f64, f64), radius: f64, word: &str, font_px: f64) -> (f64, f64) {
        let (width, height) = (text_width(word, font_px), font_px);
        // Beside, above, below, the corners; then the same farther away.
        let sides =
            [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0)];
        let at = |away: f64, (across, down): (f64, f64)| {
            let (middle_x, middle_y) =
                (x + across * (radius + 3.0 + away + width / 2.0), y + down * (radius + 2.0 + away + height / 2.0));
            [middle_x - width / 2.0, middle_y - height / 2.0, middle_x + width / 2.0, middle_y + height / 2.0]
        };
        let places = [0.0, 7.0, 16.0].into_iter().flat_map(|away| sides.map(|side| at(away, side)));
        let mut best = (f64::INFINITY, at(0.0, sides[0]));
        for place in places {
            let covered = self.covered(&place);
            if covered < best.0 {
                best = (covered, place);
            }
        }
        self.taken.push(best.1);
        (best.1[0], best.1[3] - 0.2 * font_px)
    }

    /// Area of a place that is taken or outside the frame, px2; what is outside counts tenfold.
    fn covered(&self, place: &Box4) -> f64 {
        let outside = area(place) - overlap(place, &self.frame);
        self.taken.iter().map(|taken| overlap(place, taken)).sum::<f64>() + 10.0 * outside
    }
}

fn area([left, top, right, bottom]: &Box4) -> f64 {
    (right - left) * (bottom - top)
}

fn overlap(a: &Box4, b: &Box4) -> f64 {
    let (width, height) = (a[2].min(b[2]) - a[0].max(b[0]), a[3].min(b[3]) - a[1].max(b[1]));
    width.max(0.0) * height.max(0.0)
}
