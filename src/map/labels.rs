//! Places labels so that they do not cover each other.

use glam::DVec2;

use crate::style::INK;
use cinesplat_plot::drawing::{Anchor, Ink, Mark, Stroke, TextStyle, text_width_px};

/// A rectangle by its upper left and lower right corner, px.
type Rect = (DVec2, DVec2);

/// White border of labels, px.
const HALO_PX: f64 = 2.6;
/// Distance from its point beyond which a label gets a line to it, px.
const LEADER_PX: f64 = 15.0;
/// Directions and distances (px) of the candidates around a point.
const NUM_DIRECTIONS: usize = 16;
const DISTANCES_PX: [f64; 7] = [7.0, 12.0, 20.0, 32.0, 48.0, 68.0, 92.0];

/// A rectangle with areas that labels keep clear of.
pub(crate) struct Labels {
    frame: Rect,
    /// Areas that no label may cover.
    taken: Vec<Rect>,
    /// Points that labels avoid where they can.
    avoided: Vec<DVec2>,
}

/// A label to be placed.
pub(crate) struct Label<'a> {
    pub(crate) text: &'a str,
    /// The point that it belongs to, px.
    pub(crate) at_px: DVec2,
    /// Half the width and height of the mark at the point, px; zero for a name that may lie on the point itself.
    pub(crate) half_px: DVec2,
    pub(crate) size_px: f64,
    pub(crate) ink: Ink,
    pub(crate) is_bold: bool,
}

impl Labels {
    pub(crate) fn inside(frame: Rect) -> Self {
        Self { frame, taken: Vec::new(), avoided: Vec::new() }
    }

    pub(crate) fn take(&mut self, center_px: DVec2, half_px: DVec2) {
        self.taken.push((center_px - half_px, center_px + half_px));
    }

    pub(crate) fn avoid(&mut self, points_px: impl Iterator<Item = DVec2>) {
        self.avoided.extend(points_px);
    }

    /// Whether the square around a point covers nothing that is taken.
    pub(crate) fn is_free(&self, center_px: DVec2, half_px: f64) -> bool {
        let overlaps =
            |other: &Rect| (center_px - half_px).cmplt(other.1).all() && (center_px + half_px).cmpgt(other.0).all();
        !self.taken.iter().any(overlaps)
    }

    /// Marks of a label at the best free place around its point; none where every place is taken.
    pub(crate) fn place(&mut self, label: &Label<'_>) -> Vec<Mark> {
        let half = DVec2::new(text_width_px(label.text, label.size_px) / 2.0, label.size_px * 0.5);
        let directions = (0..NUM_DIRECTIONS).map(|i| DVec2::from_angle(std::f64::consts::TAU * i as f64 / 16.0));
        let directions: Vec<DVec2> = directions.collect();
        // A name without a mark lies on its point if it can.
        let on_point = Some(label.at_px).filter(|_| label.half_px == DVec2::ZERO);
        let on_point = on_point.and_then(|center| Some((self.cost((center - half, center + half))?, center)));
        let mut best: Option<(f64, DVec2)> = on_point;
        for away in DISTANCES_PX {
            for direction in &directions {
                // About `away` from the border of the mark to that of the label.
                let beside = direction.signum() * direction.abs().powf(0.5) * (half + label.half_px);
                let center = label.at_px + *direction * away + beside;
                let Some(cost) = self.cost((center - half, center + half)) else { continue };
                let cost = cost + 0.35 * away;
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, center));
                }
            }
        }
        let on_mark =
            Some((0.0, label.at_px)).filter(|_| self.cost((label.at_px - half, label.at_px + half)).is_some());
        let Some((_, center)) = best.or(on_mark) else { return Vec::new() };
        self.taken.push((center - half, center + half));
        let style =
            TextStyle { size_px: label.size_px, ink: label.ink, anchor: Anchor::Middle, is_bold: label.is_bold };
        let base = center + DVec2::new(0.0, 0.36 * label.size_px);
        let text = Mark::Text { at_px: base, style, halo_px: HALO_PX, text: label.text.to_owned() };
        let start = center.clamp(label.at_px - label.half_px, label.at_px + label.half_px);
        let near = start.clamp(center - half, center + half);
        let line = near.distance(start) > LEADER_PX;
        let leader = Mark::Line { points_px: vec![start, near], stroke: Stroke::solid(INK, 0.8) };
        line.then_some(leader).into_iter().chain([text]).collect()
    }

    /// What a place costs: avoided points under it; `None` where it is taken or outside.
    fn cost(&self, (low, high): Rect) -> Option<f64> {
        let is_outside = low.cmplt(self.frame.0 + 2.0).any() || high.cmpgt(self.frame.1 - 2.0).any();
        let (padded_low, padded_high) = (low - 3.0, high + 3.0);
        let overlaps = |other: &Rect| padded_low.cmplt(other.1).all() && padded_high.cmpgt(other.0).all();
        if is_outside || self.taken.iter().any(overlaps) {
            return None;
        }
        let hidden = |point: &&DVec2| point.cmpge(padded_low).all() && point.cmple(padded_high).all();
        Some(2.5 * self.avoided.iter().filter(hidden).count() as f64)
    }
}
