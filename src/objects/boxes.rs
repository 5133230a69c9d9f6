//! Upright boxes from labeled Gaussians, and labels from boxes.
//!
//! The y axis of a box is the world's up.

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::object::Object;
use cinesplat_geometry::LevelFrame;
use cinesplat_scene::{Gaussians, SOLID_OPACITY};

/// Share of an object's solid Gaussians trimmed at both ends of each axis, so that floaters do not enlarge the box.
const TRIM_FRAC: f64 = 0.005;

/// Steps of the search for the tightest yaw in 90 degrees, half a degree each.
const NUM_YAWS: usize = 180;

/// Least relative reduction of the footprint's area for a yaw other than 0, so that boxes of round or noisy objects do
/// not turn at random.
const YAW_GAIN: f64 = 0.04;

/// An upright box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UprightBox {
    pub(crate) center: DVec3,
    pub(crate) half_extents: DVec3,
    pub(crate) rotation: DQuat,
}

impl Object {
    /// Gives the object a box.
    pub(crate) fn take_box(&mut self, fitted: &UprightBox) {
        (self.center, self.half_extents, self.rotation) = (fitted.center, fitted.half_extents, fitted.rotation);
    }
}

/// The upright box of some Gaussians: the yaw of the smallest footprint, with 0.5 % trimmed at both ends of each axis.
/// Ignores Gaussians that are not solid, unless fewer than a tenth are solid. `None` without Gaussians.
pub(crate) fn fit(gaussians: &Gaussians, members: &[usize], up: DVec3) -> Option<UprightBox> {
    let solid: Vec<usize> = members.iter().copied().filter(|&i| gaussians.opacities[i] >= SOLID_OPACITY).collect();
    let chosen = if solid.len() * 10 >= members.len() { &solid } else { members };
    let points: Vec<DVec3> = chosen.iter().map(|&i| gaussians.mean_world(i)).collect();
    fit_points(&points, up)
}

/// As [`fit`], for points.
pub(crate) fn fit_points(points: &[DVec3], up: DVec3) -> Option<UprightBox> {
    let anchor = *points.first()?;
    let axes = upright_axes(up);
    let local: Vec<DVec3> = points.iter().map(|&p| axes.transpose() * (p - anchor)).collect();
    let flat: Vec<DVec2> = local.iter().map(|p| DVec2::new(p.x, p.z)).collect();
    let (yaw_rad, low, high) = tightest_yaw(&flat);
    let (bottom, top) = trimmed(local.iter().map(|p| p.y).collect());
    let turned = axes * DMat3::from_rotation_y(-yaw_rad);
    let middle = (low + high) / 2.0;
    let center = anchor + turned * DVec3::new(middle.x, f64::midpoint(bottom, top), middle.y);
    let half_extents = DVec3::new(high.x - low.x, top - bottom, high.y - low.y) / 2.0;
    Some(UprightBox { center, half_extents, rotation: DQuat::from_mat3(&turned).normalize() })
}

/// Right-handed axes with y along up, and x and z as close to the world's axes as possible.
pub(crate) fn upright_axes(up: DVec3) -> DMat3 {
    let up = up.try_normalize().unwrap_or(DVec3::Y);
    if up.dot(DVec3::Y).abs() > 0.5 {
        return DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Y, up));
    }
    let level = LevelFrame::new(up).map_or(DVec3::X, |frame| frame.east);
    DMat3::from_cols(level, up, level.cross(up))
}

/// The yaw (rad, 0..pi/2) at which the trimmed footprint is smallest, with its corners in the turned frame.
fn tightest_yaw(flat: &[DVec2]) -> (f64, DVec2, DVec2) {
    // A sample of a few thousand points decides the yaw; all points give the extent.
    let stride = flat.len().div_ceil(4096);
    let sample: Vec<DVec2> = flat.iter().copied().step_by(stride.max(1)).collect();
    let yaw_of = |step: usize| step as f64 * std::f64::consts::FRAC_PI_2 / NUM_YAWS as f64;
    let area = |step: usize| {
        let (low, high) = footprint(&sample, yaw_of(step));
        (high - low).element_product()
    };
    let level = area(0);
    let best = (0..NUM_YAWS).map(|step| (step, area(step))).min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, level));
    let yaw_rad = if best.1 < level * (1.0 - YAW_GAIN) { yaw_of(best.0) } else { 0.0 };
    let (low, high) = footprint(flat, yaw_rad);
    (yaw_rad, low, high)
}

/// Trimmed extent of points after a turn by `-yaw_rad`.
fn footprint(flat: &[DVec2], yaw_rad: f64) -> (DVec2, DVec2) {
    let turn = DVec2::from_angle(-yaw_rad);
    let turned: Vec<DVec2> = flat.iter().map(|p| turn.rotate(*p)).collect();
    let x = trimmed(turned.iter().map(|p| p.x).collect());
    let z = trimmed(turned.iter().map(|p| p.y).collect());
    (DVec2::new(x.0, z.0), DVec2::new(x.1, z.1))
}

/// Smallest and largest value after trimming; 0 for none.
pub(crate) fn trimmed(mut values: Vec<f64>) -> (f64, f64) {
    let Some(last) = values.len().checked_sub(1) else { return (0.0, 0.0) };
    let cut = (values.len() as f64 * TRIM_FRAC) as usize;
    let low = *values.select_nth_unstable_by(cut, f64::total_cmp).1;
    let high = *values.select_nth_unstable_by(last - cut, f64::total_cmp).1;
    (low, high)
}

/// One id per Gaussian: the id of the smallest box that contains its mean. 0 without a box, or if it is not solid.
pub(crate) fn labels_from_boxes(gaussians: &Gaussians, objects: &[Object]) -> Vec<u16> {
    let mut by_volume: Vec<&Object> = objects.iter().collect();
    by_volume.sort_by(|a, b| a.half_extents.element_product().total_cmp(&b.half_extents.element_product()));
    let label = |i: usize| {
        let mean = gaussians.mean_world(i);
        let holder = by_volume.iter().find(|object| object.contains(mean, 0.0));
        holder.filter(|_| gaussians.opacities[i] >= SOLID_OPACITY).map_or(0, |object| object.id as u16)
    };
    (0..gaussians.len()).map(label).collect()
}
