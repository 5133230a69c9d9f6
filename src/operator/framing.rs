//! A subject in the frame: its size, position and visibility; and the view that frames it at a wanted size.

use glam::{DVec2, DVec3};

use super::program::{Framing, SubjectPart};
use super::world::{Subject, World};
use cinesplat_geometry::Pose;
use cinesplat_trajectory::CameraState;

/// Things from which on a picture is one of many.
pub(super) const MANY: usize = 3;

/// The target of a view: a point to aim at, and the corners that must fit.
#[derive(Debug, Clone)]
pub(super) struct Target {
    /// Object ids; empty for the scene as a whole.
    pub(super) ids: Vec<u32>,
    /// Point on the view axis, world.
    pub(super) aim: DVec3,
    /// Center of the first subject, world.
    pub(super) center: DVec3,
    /// Corners of all boxes that must fit, world.
    pub(super) corners: Vec<DVec3>,
    /// Outermost points of the matter in them, where its size is stated as a share of the frame.
    pub(super) outline: Option<Vec<DVec3>>,
    /// Radius of a sphere about `aim` that contains the corners.
    pub(super) radius: f64,
}

impl Target {
    /// The target of a framing; `None` where it names no known object.
    pub(super) fn of(world: &World, framing: &Framing) -> Option<Self> {
        let subjects: Vec<&Subject> = framing.subjects.iter().filter_map(|&id| world.subject(id)).collect();
        let first = *subjects.first()?;
        // Many things are one picture; two may be one after the other.
        let joint = subjects.len() > if framing.whole { 1 } else { 2 };
        let shown = if joint { &subjects[..] } else { &subjects[..1] };
        let corners: Vec<DVec3> = shown.iter().flat_map(|subject| subject.corners.iter().copied()).collect();
        let matter = || shown.iter().flat_map(|subject| subject.outline.iter().copied()).collect();
        let outline = framing.height_frac.map(|_| matter());
        let aim = match framing.place {
            _ if joint => {
                let hung = subjects.iter().map(|subject| hung_shift(world, subject)).fold(0.0, f64::min);
                middle(&corners) + world.frame.up * hung
            }
            // A stated place is that of the subject's center.
            Some(_) if framing.part == SubjectPart::Middle => first.center,
            _ if framing.part == SubjectPart::Middle && !overflows(framing) => {
                first.center + world.frame.up * hung_shift(world, first)
            }
            _ => part_point(world, first, framing.part),
        };
        let radius = corners.iter().map(|c| c.distance(aim)).fold(0.0, f64::max);
        Some(Self { ids: framing.subjects.clone(), aim, center: first.center, corners, outline, radius })
    }

    /// Heights along up of the surface of its first subject on which other things stand, and of the highest of them.
    pub(super) fn borne_heights(&self, world: &World) -> Option<[f64; 2]> {
        world.subject(*self.ids.first()?)?.borne_heights
    }

    /// The scene as a whole.
    pub(super) fn scene(world: &World) -> Self {
        let bounds = &world.bounds;
        let pick = |bit: bool, low: f64, high: f64| if bit { high } else { low };
        let corner = |i: usize| {
            DVec3::new(
                pick(i & 1 > 0, bounds.core_min.x, bounds.core_max.x),
                pick(i & 2 > 0, bounds.core_min.y, bounds.core_max.y),
                pick(i & 4 > 0, bounds.core_min.z, bounds.core_max.z),
            )
        };
        let center = bounds.center();
        Self {
            ids: Vec::new(),
            aim: center,
            center,
            corners: (0..8).map(corner).collect(),
            outline: None,
            radius: bounds.size() / 2.0,
        }
    }

    /// The points by which its size in the picture is measured. A stated share of the frame is that of the matter: a bowl does not fill its
    /// box. The sizes that have names are those of the box, so that a close-up of a thing shows its edges.
    pub(super) fn sized_by(&self) -> &[DVec3] {
        self.outline.as_deref().unwrap_or(&self.corners)
    }
}

fn middle(points: &[DVec3]) -> DVec3 {
    let low = points.iter().copied().reduce(DVec3::min).unwrap_or(DVec3::ZERO);
    let high = points.iter().copied().reduce(DVec3::max).unwrap_or(DVec3::ZERO);
    (low + high) / 2.0
}

/// Height over width from which on a subject counts as upright, and from which on its aim is all the way up.
const UPRIGHT: (f64, f64) = (1.3, 1.9);
/// Height of the aim of an upright subject above its middle, over half its height, in pictures that it is too large for. What
/// fits into the picture is aimed at its middle, or its foot would be cut off below empty space.
const UPPER_AIM: f64 = 0.22;

/// Whether a framing states that its subject is taller than the frame.
fn overflows(framing: &Framing) -> bool {
    let height_frac = framing.height_frac.or(framing.size.map(|size| size.height_band_frac().0));
    height_frac.is_some_and(|height_frac| height_frac >= 1.0)
}

/// The point to aim at for a part of a subject: 60 % of the way from its middle to that end. Left and right give the
/// middle, because they depend on the camera's position ([`aimed_at_side`](super::view::aimed_at_side)). Where the prompt
/// names no part, upright subjects are aimed at above their middle, where people have their heads.
fn part_point(world: &World, subject: &Subject, part: SubjectPart) -> DVec3 {
    let heights = || subject.corners.iter().map(|&c| world.frame.height(c - subject.center));
    let rise = match part {
        SubjectPart::Top => heights().fold(0.0, f64::max),
        SubjectPart::Bottom => heights().fold(0.0, f64::min),
        SubjectPart::Middle => return subject.center + world.frame.up * upper_aim(world, subject),
        SubjectPart::Left | SubjectPart::Right => 0.0,
    };
    subject.center + world.frame.up * rise * 0.6
}

/// How far the middle of a subject's matter is below the middle of its box, over half its height, from which on it is its body
/// that is looked at: that of a radio under its antenna.
const BODY_BELOW: f64 = 0.15;

/// The same from which on it hangs on something thin, and share of the way down to it by which it is aimed lower: a pendant lamp is
/// its shade.
const HUNG_BELOW: f64 = 0.3;
const HUNG_SHARE: f64 = 0.6;

/// Height of the aim of a subject that hangs on a cord above its middle; 0 of any other one.
fn hung_shift(world: &World, subject: &Subject) -> f64 {
    let body = world.frame.height(subject.body - subject.center);
    if body < -HUNG_BELOW * subject.reach(world.frame.up) { HUNG_SHARE * body } else { 0.0 }
}

/// Height of a subject's aim above its middle.
fn upper_aim(world: &World, subject: &Subject) -> f64 {
    let half_height = subject.reach(world.frame.up);
    let body = world.frame.height(subject.body - subject.center);
    if body < -BODY_BELOW * half_height {
        return body.max(-UPPER_AIM * half_height);
    }
    let half_width = subject.level_axes(world.frame.up)[0].length();
    let upright = (half_height / half_width.max(1e-9) - UPRIGHT.0) / (UPRIGHT.1 - UPRIGHT.0);
    UPPER_AIM * half_height * upright.clamp(0.0, 1.0)
}

/// Position in the frame as fractions of its width and height from the middle (right and up positive), and the depth
/// along the view axis. `None` for points at or behind the camera.
pub(super) fn frame_position(world: &World, state: &CameraState, point: DVec3) -> Option<(DVec2, f64)> {
    let p = state.pose.to_camera(point);
    let tan = (state.fov_y_rad / 2.0).tan();
    (p.z > 1e-9).then(|| (DVec2::new(p.x / (2.0 * p.z * tan * world.aspect), -p.y / (2.0 * p.z * tan)), p.z))
}

/// Distance of a point from the frame's middle: the larger of |x| over the width and |y| over the height. Infinite
/// behind the camera.
pub(super) fn off_center(world: &World, state: &CameraState, point: DVec3) -> f64 {
    frame_position(world, state, point).map_or(f64::INFINITY, |(at, _)| at.abs().max_element())
}

/// The way to a place in the frame ([`frame_position`]), in camera axes, with depth 1.
pub(super) fn frame_ray(world: &World, state: &CameraState, at: DVec2) -> DVec3 {
    let tan = 2.0 * (state.fov_y_rad / 2.0).tan();
    DVec3::new(at.x * tan * world.aspect, -at.y * tan, 1.0)
}

/// Least and largest place in the frame ([`frame_position`]) of points, and the least depth; `None` where a point is behind the
/// camera.
pub(super) fn frame_bounds(world: &World, state: &CameraState, points: &[DVec3]) -> Option<([DVec2; 2], f64)> {
    let (mut low, mut high, mut near) = (DVec2::INFINITY, DVec2::NEG_INFINITY, f64::INFINITY);
    for &point in points {
        let (at, depth) = frame_position(world, state, point)?;
        (low, high, near) = (low.min(at), high.max(at), near.min(depth));
    }
    Some(([low, high], near))
}

/// Width and height of the points' projection over the frame's; infinite where a point is behind the camera.
pub(super) fn extent_frac(world: &World, state: &CameraState, points: &[DVec3]) -> DVec2 {
    frame_bounds(world, state, points).map_or(DVec2::INFINITY, |([low, high], _)| high - low)
}

/// Share of the points inside the frame, which is shrunk by `margin` of its size on every side.
pub(super) fn in_frame_frac(world: &World, state: &CameraState, points: &[DVec3], margin: f64) -> f64 {
    let inside = |p: &&DVec3| off_center(world, state, **p) <= 0.5 - margin;
    points.iter().filter(inside).count() as f64 / points.len().max(1) as f64
}

/// Visible share of a subject's points in the frame: those with a transmittance of at least 0.5. 0 where no point is in
/// the frame.
pub(super) fn unoccluded_frac(world: &World, state: &CameraState, subject: &Subject, num_points: usize) -> f64 {
    let stride = (subject.points.len() / num_points).max(1);
    let (mut framed, mut seen) = (0, 0);
    for &point in subject.points.iter().step_by(stride) {
        if off_center(world, state, point) <= 0.5 {
            framed += 1;
            seen += usize::from(subject.transmittance(state.pose.position, point) >= 0.5);
        }
    }
    f64::from(u32::try_from(seen).unwrap_or(0)) / f64::from(u32::try_from(framed).unwrap_or(1).max(1))
}

/// Share of all points of a subject that are in the frame and visible.
pub(super) fn seen_frac(world: &World, state: &CameraState, subject: &Subject, num_points: usize) -> f64 {
    let points: Vec<DVec3> =
        subject.points.iter().step_by((subject.points.len() / num_points).max(1)).copied().collect();
    let seen =
        |p: &&DVec3| off_center(world, state, **p) <= 0.5 && subject.transmittance(state.pose.position, **p) >= 0.5;
    points.iter().filter(seen).count() as f64 / points.len().max(1) as f64
}

/// Direction from the aim of a view to its camera.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bearing {
    /// Azimuth of the camera, seen from the aim.
    pub(super) azimuth_rad: f64,
    /// Elevation of the camera, seen from the aim.
    pub(super) elevation_rad: f64,
}

/// A level camera at a bearing and distance from a point, aimed at it.
pub(super) fn view_at(world: &World, aim: DVec3, bearing: Bearing, distance: f64, fov_y_rad: f64) -> CameraState {
    let (sin, cos) = bearing.elevation_rad.sin_cos();
    let away = world.frame.direction(bearing.azimuth_rad) * cos + world.frame.up * sin;
    let pose = Pose::facing(aim + away * distance, -away, world.frame.up, None);
    CameraState { pose, fov_y_rad, focus_distance: None }
}

/// How a wanted size is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fill {
    /// Projected height over the frame's height: the definition of the shot sizes.
    Height(f64),
    /// The larger of projected width over the frame's width and projected height over its height: for wide targets too.
    Fit(f64),
}

impl Fill {
    fn reached(self, world: &World, state: &CameraState, points: &[DVec3]) -> bool {
        let extent = extent_frac(world, state, points);
        match self {
            Self::Height(wanted) => extent.y >= wanted,
            Self::Fit(wanted) => extent.max_element() >= wanted,
        }
    }
}

/// The distance at which a target has the wanted size, seen from a bearing. The projection shrinks with the
/// distance: 40 bisections find it to 1e-9 of the range.
pub(super) fn distance_for(world: &World, target: &Target, bearing: Bearing, fill: Fill, fov_y_rad: f64) -> f64 {
    let reached = |d: f64| fill.reached(world, &view_at(world, target.aim, bearing, d, fov_y_rad), target.sized_by());
    let (mut near, mut far) = (0.2 * target.radius, 200.0 * target.radius.max(1e-9));
    for _ in 0..40 {
        let middle = (near * far).sqrt();
        if reached(middle) {
            near = middle;
        } else {
            far = middle;
        }
    }
    (near * far).sqrt()
}

/// Bearing of a camera position as seen from a point.
pub(super) fn bearing_of(world: &World, aim: DVec3, position: DVec3) -> Bearing {
    let away = position - aim;
    let level = world.frame.horizontal(away).length();
    Bearing { azimuth_rad: world.frame.azimuth(away), elevation_rad: world.frame.height(away).atan2(level) }
}
