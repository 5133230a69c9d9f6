//! The outermost points of a subject, which have to be in the picture for all of it to be, and the size of its splats.

use cinesplat_geometry::sphere_directions;
use cinesplat_scene::Gaussians;
use glam::DVec3;

/// Directions in which the outermost points are taken, and the samples of the subject among which they are.
const NUM_DIRECTIONS: usize = 42;
const MAX_SAMPLES: usize = 4000;
/// Share of the samples beyond an outermost point: stray Gaussians do not make a thing larger.
const STRAY_FRAC: f64 = 0.002;

/// Evenly taken samples of a subject's Gaussians.
fn samples<T: Copy>(own: &[T]) -> impl Iterator<Item = T> {
    own.iter().step_by(own.len().div_ceil(MAX_SAMPLES).max(1)).copied()
}

/// The outermost of the means of a subject's Gaussians, see [`outermost`].
pub(super) fn outline(gaussians: &Gaussians, own: &[usize]) -> Vec<DVec3> {
    outermost(samples(own).map(|i| gaussians.mean_world(i)).collect())
}

/// The outermost of some points, one for each of [`NUM_DIRECTIONS`] directions, without the stray ones; empty for no points.
fn outermost(samples: Vec<DVec3>) -> Vec<DVec3> {
    if samples.is_empty() {
        return samples;
    }
    let beyond = (STRAY_FRAC * samples.len() as f64) as usize;
    let farthest = |direction: DVec3| {
        let mut order: Vec<usize> = (0..samples.len()).collect();
        let by_reach = |a: &usize, b: &usize| {
            samples[*b].dot(direction).total_cmp(&samples[*a].dot(direction)).then_with(|| a.cmp(b))
        };
        let (_, &mut at, _) = order.select_nth_unstable_by(beyond, by_reach);
        samples[at]
    };
    sphere_directions(NUM_DIRECTIONS).into_iter().map(farthest).collect()
}

/// Size of the splats of a subject, twice the geometric mean of their two larger deviations: the median by area, which is
/// that of what is seen. 0 for no splats.
pub(super) fn splat_size(gaussians: &Gaussians, own: &[usize]) -> f64 {
    let area = |i: usize| {
        let scale = gaussians.scales[i].as_dvec3();
        scale.x * scale.y * scale.z / scale.min_element().max(1e-12)
    };
    let mut areas: Vec<f64> = samples(own).map(area).collect();
    areas.sort_by(f64::total_cmp);
    let half = areas.iter().sum::<f64>() / 2.0;
    let mut sum = 0.0;
    let middle = areas.iter().find(|area| {
        sum += **area;
        sum >= half
    });
    middle.map_or(0.0, |area| 2.0 * area.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_spans_the_thing_without_its_strays() {
        let mut points: Vec<DVec3> =
            sphere_directions(3000).into_iter().map(|d| d * DVec3::new(1.0, 2.0, 0.5)).collect();
        points.push(DVec3::new(0.0, 40.0, 0.0));
        let outline = outermost(samples(&points).collect());
        let top = outline.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
        let low = outline.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        assert!((1.85..=2.0).contains(&top), "top {top}");
        assert!((-2.0..=-1.85).contains(&low), "low {low}");
        assert!(outermost(Vec::new()).is_empty());
        assert_eq!(outermost(vec![DVec3::X]), vec![DVec3::X; NUM_DIRECTIONS]);
    }
}
