//! Lines with fewer points that look the same.

use glam::DVec2;

/// Largest distance of a line from the points that it leaves out, px. It cannot be seen.
const TOLERANCE_PX: f64 = 0.04;

/// The points without those that lie on the line between their neighbors, within [`TOLERANCE_PX`] (Ramer, 1972; Douglas
/// and Peucker, 1973). The first and the last point stay.
pub(super) fn simplified(points: &[DVec2]) -> Vec<DVec2> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut is_kept = vec![false; points.len()];
    (is_kept[0], is_kept[last]) = (true, true);
    let mut spans = vec![(0, last)];
    while let Some((from, to)) = spans.pop() {
        let off = |idx: &usize| distance_px(points[*idx], points[from], points[to]);
        let farthest = (from + 1..to).max_by(|a, b| off(a).total_cmp(&off(b)));
        // NaN stays, as it would in the whole line.
        if let Some(idx) = farthest.filter(|idx| !(off(idx) <= TOLERANCE_PX)) {
            is_kept[idx] = true;
            spans.extend([(from, idx), (idx, to)]);
        }
    }
    points.iter().zip(is_kept).filter(|(_, is_kept)| *is_kept).map(|(point, _)| *point).collect()
}

/// Distance of a point from a line between two points.
fn distance_px(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let share = if along.length_squared() > 0.0 { (point - from).dot(along) / along.length_squared() } else { 0.0 };
    point.distance(from + along * share.clamp(0.0, 1.0))
}
