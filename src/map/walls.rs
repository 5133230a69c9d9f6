//! Finds the direction of the walls of a scene.

use glam::DVec2;

/// Directions that are tried in a quarter turn, one per degree.
const NUM_YAWS: usize = 90;
/// Stripes across the scene in which points are counted.
const NUM_STRIPES: usize = 192;
/// Most points that are looked at.
const MAX_POINTS: usize = 24_000;
/// Least ratio of the best score to the median of all: without walls the directions score alike.
const MIN_RATIO: f64 = 1.06;

/// Azimuth of the walls, rad, 0..pi/2, of points seen from above; `None` in a scene without a main direction.
///
/// Seen along a wall, its points fall into few stripes: the score of a direction is the sum of the squared counts of the
/// stripes along and across it.
pub(crate) fn azimuth_rad(points: &[DVec2]) -> Option<f64> {
    let stride = points.len().div_ceil(MAX_POINTS).max(1);
    let points: Vec<DVec2> = points.iter().copied().step_by(stride).collect();
    let middle = points.iter().copied().sum::<DVec2>() / points.len().max(1) as f64;
    let reach = points.iter().map(|point| point.distance(middle)).fold(0.0, f64::max);
    if !(reach > 0.0) {
        return None;
    }
    let score = |yaw_rad: f64| -> f64 {
        let turn = DVec2::from_angle(-yaw_rad);
        let stripe =
            |value: f64| ((f64::midpoint(value / reach, 1.0) * NUM_STRIPES as f64) as usize).min(NUM_STRIPES - 1);
        let mut counts = [[0.0_f64; NUM_STRIPES]; 2];
        for point in &points {
            let turned = turn.rotate(*point - middle);
            counts[0][stripe(turned.x)] += 1.0;
            counts[1][stripe(turned.y)] += 1.0;
        }
        counts.iter().flatten().map(|count| count * count).sum()
    };
    let yaws: Vec<f64> = (0..NUM_YAWS).map(|degree| (degree as f64).to_radians()).collect();
    let scores: Vec<f64> = yaws.iter().map(|yaw| score(*yaw)).collect();
    let best = (0..NUM_YAWS).max_by(|a, b| scores[*a].total_cmp(&scores[*b]).then(b.cmp(a)))?;
    let mut sorted = scores.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    (scores[best] >= MIN_RATIO * sorted[NUM_YAWS / 2]).then_some(yaws[best])
}
