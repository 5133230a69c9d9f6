//! Subsets of points.

use glam::DVec3;

/// Distinct points, sorted by coordinates: the result does not depend on the order of the input.
pub(crate) fn in_canonical_order(mut points: Vec<DVec3>) -> Vec<DVec3> {
    let order = |a: &DVec3, b: &DVec3| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z));
    points.sort_unstable_by(order);
    points.dedup();
    points
}

/// At most `max_points` points by farthest point sampling (Gonzalez 1985): first the point farthest from the mean, then
/// repeatedly the point farthest from all chosen ones. Ties go to the earlier point.
pub(crate) fn farthest_points(points: &[DVec3], max_points: usize) -> Vec<DVec3> {
    if points.is_empty() || max_points == 0 {
        return Vec::new();
    }
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut gaps: Vec<f64> = points.iter().map(|p| p.distance_squared(middle)).collect();
    let mut chosen = Vec::with_capacity(max_points.min(points.len()));
    for round in 0..max_points.min(points.len()) {
        let farthest = (0..points.len()).rev().max_by(|&a, &b| gaps[a].total_cmp(&gaps[b])).unwrap_or(0);
        if round > 0 && gaps[farthest] <= 0.0 {
            break;
        }
        chosen.push(points[farthest]);
        for (gap, point) in gaps.iter_mut().zip(points) {
            let apart = point.distance_squared(points[farthest]);
            *gap = if round == 0 { apart } else { gap.min(apart) };
        }
    }
    chosen
}
