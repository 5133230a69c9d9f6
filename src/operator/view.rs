//! The opening view of a shot, or of a step after a cut: bearing, size and lens; and small changes to a camera.

use std::f64::consts::TAU;

use glam::DVec3;

use super::composition::{lens_fov_deg, natural_elevation_deg, stated_azimuths};
use super::framing::{Bearing, Fill, Target, bearing_of, distance_for, view_at};
use super::motion::StepParameters;
use super::program::{Framing, SubjectPart};
use super::suggestion::StepCameras;
use super::world::World;
use cinesplat_geometry::{LevelFrame, Pose, rotation};
use cinesplat_trajectory::{CameraState, ShotAngle, ShotSize};

/// Share of the parameter's range that picks one of the preferred azimuths (the director's, across the line between two
/// subjects, facing a broad side) instead of any azimuth.
const PREFERRED_FRAC: f64 = 0.65;

/// The ranges that an opening view chooses from.
#[derive(Debug, Clone)]
pub(super) struct ViewRange {
    /// Size of the subject where the prompt states none, as in [`Fill::Fit`].
    pub(super) fill: (f64, f64),
    /// Vertical field of view, degrees.
    pub(super) fov_deg: (f64, f64),
    /// Preferred azimuths of the camera, seen from the subject.
    pub(super) azimuths_rad: Vec<f64>,
    /// Elevation of an overhead view, degrees.
    pub(super) overhead_deg: (f64, f64),
}

/// Elevation of an overhead view: straight down to the eye, but with a horizon that the camera's yaw can be told from.
pub(super) const OVERHEAD_DEG: (f64, f64) = (84.0, 88.5);
/// The same for a camera that circles its subject or sinks beside it: from nearer to the zenith it would spin in place,
/// or come down on it.
pub(super) const CIRCLING_OVERHEAD_DEG: (f64, f64) = (52.0, 74.0);
/// Widest vertical field of view where the room before a subject is short, degrees; and above it, from this elevation
/// on.
const WIDEST_DEG: f64 = 64.0;
const WIDEST_STEEP_DEG: f64 = 84.0;
const STEEP_DEG: f64 = 60.0;
/// Least free distance from a subject's aim to a camera, over that to the subject's near side.
const LEAST_SPACE: f64 = 1.4;

/// Range of the camera's elevation, seen from the subject, for an angle of the shot; degrees.
fn elevation_band_deg(angle: ShotAngle, range: &ViewRange) -> (f64, f64) {
    match angle {
        ShotAngle::Overhead => range.overhead_deg,
        ShotAngle::High => (24.0, 38.0),
        ShotAngle::EyeLevel => (-4.0, 8.0),
        ShotAngle::Low => (-34.0, -11.0),
        ShotAngle::Worm => (-65.0, -42.0),
    }
}

/// Elevation of a high angle on a thing that stands low in a room, degrees: what lies on a table is seen from 33 degrees on,
/// and 40 is the steepest pitch of a high angle.
const HIGH_OVER_LOW_DEG: (f64, f64) = (33.0, 39.5);
/// Height of the top of such a thing, over that of a standing person's eyes.
const LOW_TOP: f64 = 0.66;

/// Whether a target in a room ends well below the eyes of a standing person.
fn lies_low(world: &World, target: &Target) -> bool {
    let top = target.corners.iter().map(|c| world.height_above_floor(*c)).fold(f64::NEG_INFINITY, f64::max);
    world.is_indoor() && !target.ids.is_empty() && top < LOW_TOP * world.eye_height()
}

/// Elevation of the camera where the words state none: as a person would see the target. Parameter 1 chooses it; its
/// outer tenths leave the usual range, upward more than downward, where something is in the way.
fn free_elevation_deg(world: &World, target: &Target, parameter: f64, proposed: Option<Bearing>) -> f64 {
    let (low, high) = natural_elevation_deg(world, target);
    let usual = lerp((low, high), ((parameter - 0.1) / 0.8).clamp(0.0, 1.0));
    let usual = proposed.map_or(usual, |bearing| usual.midpoint(bearing.elevation_rad.to_degrees().clamp(low, high)));
    let beyond = ((parameter - 0.9) / 0.1).max(0.0) * 16.0 - ((0.1 - parameter) / 0.1).max(0.0) * 0.3 * low.max(0.0);
    usual + beyond
}

/// Range of the height of the subject over the frame's from which a close-up of a thing is taken: hardly more than all of it, because
/// people want to see what it is.
const CLOSE_UP: (f64, f64) = (1.03, 1.2);

/// The fill for a shot size: a parameter in 0..1 selects from the inner part of the size's range.
pub(super) fn size_fill(size: ShotSize, parameter: f64) -> Fill {
    if size == ShotSize::CloseUp {
        return Fill::Height(lerp(CLOSE_UP, parameter));
    }
    let (low, high) = size.height_band_frac();
    let high = high.min(2.0);
    Fill::Height(lerp((low * 0.93 + high * 0.07, low * 0.2 + high * 0.8), parameter))
}

/// Height of a lone thing, over the frame's, in a full shot: all of it, with a little room.
const FULL_SHOT: (f64, f64) = (0.62, 0.88);
const MOST_FULL: f64 = 0.95;

/// Whether a framing is that of a full shot of a lone thing, from head to toe: around it there is nothing else to see.
fn is_full_shot(world: &World, framing: &Framing) -> bool {
    !world.is_indoor() && framing.whole && framing.size == Some(ShotSize::Long) && framing.height_frac.is_none()
}

/// Range of the height of a framing's subject over the frame's for a size. A long shot that holds the whole of it may come
/// nearer where there is no room for more.
pub(super) fn height_band_frac(framing: &Framing, size: ShotSize) -> (f64, f64) {
    let (low, high) = size.height_band_frac();
    let is_of_whole = framing.whole && size == ShotSize::Long;
    (low, if is_of_whole { MOST_FULL } else { high })
}

/// The fill that a framing states, see [`stated_fill`], in a scene where a long shot of a whole thing may be a full shot.
pub(super) fn fill_in(world: &World, framing: &Framing, parameter: f64) -> Option<Fill> {
    if is_full_shot(world, framing) {
        return Some(Fill::Fit(lerp(FULL_SHOT, parameter)));
    }
    stated_fill(framing, parameter)
}

/// The fill that a framing states: the height of its first subject, or else its size. `None` where it states neither.
pub(super) fn stated_fill(framing: &Framing, parameter: f64) -> Option<Fill> {
    framing.height_frac.map(Fill::Height).or_else(|| framing.size.map(|size| size_fill(size, parameter)))
}

/// Linear interpolation in a range, `t` in 0..1.
pub(super) fn lerp(range: (f64, f64), t: f64) -> f64 {
    range.0 + (range.1 - range.0) * t
}

/// How far a value is on the way from the first end of a range to the second, 0..=1: the inverse of [`lerp`], clamped.
pub(super) fn ramp((from, to): (f64, f64), value: f64) -> f64 {
    ((value - from) / (to - from)).clamp(0.0, 1.0)
}

/// A view of `target` as `framing` requires it. Parameters 0 to 4 choose azimuth, elevation, size, lens, and the
/// preferred azimuth.
pub(super) fn opening_view(
    world: &World,
    target: &Target,
    framing: &Framing,
    range: &ViewRange,
    suggestion: Option<&StepCameras>,
    parameters: &StepParameters,
) -> CameraState {
    let proposed = suggestion.map(|cameras| bearing_of(world, target.aim, cameras.start.pose.position));
    let free_azimuth = || {
        let azimuth_rad = azimuth(range, proposed, parameters);
        let is_plan = framing.angle == Some(ShotAngle::Overhead) && range.overhead_deg == OVERHEAD_DEG;
        if is_plan { squared(&world.frame, &target.corners, azimuth_rad) } else { azimuth_rad }
    };
    let azimuth_rad = stated_azimuths(world, target, framing)
        .map_or_else(free_azimuth, |(azimuths_rad, spread_rad)| beside(&azimuths_rad, spread_rad, parameters));
    let elevation_deg = match framing.angle {
        Some(ShotAngle::High) if lies_low(world, target) => lerp(HIGH_OVER_LOW_DEG, parameters[1]),
        Some(angle) => lerp(elevation_band_deg(angle, range), parameters[1]),
        None => free_elevation_deg(world, target, parameters[1], proposed),
    };
    let elevation_rad = framing.elevation_deg.unwrap_or(elevation_deg).to_radians();
    let bearing = Bearing { azimuth_rad, elevation_rad };
    let fill = stated_fill(framing, parameters[2]).unwrap_or_else(|| Fill::Fit(lerp(range.fill, parameters[2])));
    let loose = framing.whole && framing.height_frac.is_none();
    let fill = if loose { Fill::Fit(lerp((0.62, 0.9), parameters[2])) } else { fill };
    let fov_deg = framing.lens.map_or(range.fov_deg, lens_fov_deg);
    let fov_y_rad = lerp(fov_deg, parameters[3]).to_radians();
    let view = view_from(world, (target, framing), bearing, fill, fov_y_rad);
    // A subject that must not be seen is hidden by what is in the way.
    let free = framing.distance.is_none() && framing.lens.is_none() && !framing.hidden;
    let view = if free { in_front_of_matter(world, target, bearing, view) } else { view };
    let sized = framing.size.is_some() || framing.height_frac.is_some() || framing.whole;
    let is_lens_alone = framing.lens.is_some() && framing.distance.is_none() && !framing.hidden && !sized;
    let view = if is_lens_alone { before_wall(world, target, view) } else { view };
    let is_open = framing.distance.is_none() && !framing.hidden;
    let lies = is_open && framing.height.is_none() && framing.elevation_deg.is_none();
    let raised = if lies { above_floor(world, target, framing.angle, view) } else { view };
    // A stated lens stays.
    let view = if framing.lens.is_some() { with_fov(&raised, view.fov_y_rad) } else { raised };
    aimed_at_side(world, target, framing.part, view)
}

/// The view of a target from a bearing: at the framing's distance, or else at the distance of a fill. The bearing's
/// elevation gives way to the framing's height above the floor.
pub(super) fn view_from(
    world: &World,
    (target, framing): (&Target, &Framing),
    bearing: Bearing,
    fill: Fill,
    fov_y_rad: f64,
) -> CameraState {
    let distance = |bearing: Bearing| match framing.distance {
        Some(wanted) => distance_along(world, target, bearing, wanted),
        None => distance_for(world, target, bearing, fill, fov_y_rad),
    };
    let bearing = match framing.height {
        Some(height) => Bearing { elevation_rad: elevation_at(world, target, height, bearing, &distance), ..bearing },
        None => bearing,
    };
    view_at(world, target.aim, bearing, distance(bearing), fov_y_rad)
}

/// The view in a room, brought nearer where a wall, a ceiling or furniture is between the camera and its target, with a
/// wider lens for the same picture. A view that would need too wide a lens stays as it is.
fn in_front_of_matter(world: &World, target: &Target, bearing: Bearing, view: CameraState) -> CameraState {
    if !world.is_indoor() {
        return view;
    }
    let away = -view.pose.forward();
    let (start, distance, free) = space_before(world, target, &view);
    let steep = bearing.elevation_rad > STEEP_DEG.to_radians();
    let widest_deg: f64 = if steep { WIDEST_STEEP_DEG } else { WIDEST_DEG };
    let widest = (widest_deg / 2.0).to_radians().tan();
    let tan = (view.fov_y_rad / 2.0).tan() * distance / free;
    // From above, part of a subject below a lamp shows more than the lamp does.
    let tan = if steep { tan.min(widest) } else { tan };
    let fits = free > LEAST_SPACE * start && free < distance && tan <= widest;
    if fits { with_fov(&moved(&view, away * (free - distance)), 2.0 * tan.atan()) } else { view }
}

/// Distances from a target's aim toward a camera: to before its near side, to the camera, and to where a camera has room
/// before the first matter on the way.
fn space_before(world: &World, target: &Target, view: &CameraState) -> (f64, f64, f64) {
    let away = -view.pose.forward();
    let start = target.corners.iter().map(|c| (*c - target.aim).dot(away)).fold(0.0, f64::max) + world.camera_radius;
    let distance = view.pose.position.distance(target.aim);
    let free = world.hit_distance(target.aim + away * start, away).map_or(distance, |free| start + free);
    (start, distance, free - 2.0 * world.camera_radius)
}

/// The view in a room through a stated lens, brought nearer where a wall or furniture is between the camera and its target,
/// which then is larger in the picture.
fn before_wall(world: &World, target: &Target, view: CameraState) -> CameraState {
    if !world.is_indoor() {
        return view;
    }
    let away = -view.pose.forward();
    let (start, distance, free) = space_before(world, target, &view);
    if free > LEAST_SPACE * start && free < distance { moved(&view, away * (free - distance)) } else { view }
}

/// The view raised to the floor of a room, or to the foot of a lone thing, where it would lie under it: as low as a camera can
/// lie, nearer for the angle of the shot, with a wider lens for the same picture.
fn above_floor(world: &World, target: &Target, angle: Option<ShotAngle>, view: CameraState) -> CameraState {
    if world.sunk_frac(view.pose.position) <= 0.0 {
        return view;
    }
    let lying = LYING_RADII * world.camera_radius;
    let away = view.pose.position - target.aim;
    let level = world.frame.horizontal(away);
    // A worm looks at the upper part of what towers above it.
    let top = target.corners.iter().map(|c| world.height_above_floor(*c)).fold(f64::NEG_INFINITY, f64::max);
    let middle = world.height_above_floor(target.aim);
    let aimed_height = if angle == Some(ShotAngle::Worm) { middle.midpoint(top) } else { middle };
    let rise = (aimed_height - lying).max(world.camera_radius);
    let steepness = match angle {
        Some(ShotAngle::Worm) => Some(WORM_PITCH_DEG),
        Some(ShotAngle::Low) => Some(LOW_PITCH_DEG),
        _ => None,
    };
    let reach = target.corners.iter().map(|c| world.frame.horizontal(*c - target.aim).length()).fold(0.0, f64::max);
    let nearest = reach + 2.0 * world.camera_radius;
    let wanted = steepness.map_or(away.length(), |deg| rise / deg.to_radians().tan());
    let distance = wanted.min(away.length()).max(nearest);
    let direction = level.try_normalize().unwrap_or_else(|| world.frame.direction(0.0));
    let up = world.frame.up;
    let position = target.aim + direction * distance + up * (lying - middle);
    let widest = (WIDEST_STEEP_DEG / 2.0).to_radians().tan();
    let tan = ((view.fov_y_rad / 2.0).tan() * away.length() / distance.hypot(rise)).min(widest);
    let tan = tan.max((view.fov_y_rad / 2.0).tan().min(widest));
    let raised = with_fov(&moved(&view, position - view.pose.position), 2.0 * tan.atan());
    aimed(world, &raised, target.aim + up * (aimed_height - middle))
}

/// Height of a camera that lies on the floor, over its radius.
pub(super) const LYING_RADII: f64 = 1.3;
/// Pitch of a worm's view and of a low one from the floor, degrees.
const WORM_PITCH_DEG: f64 = 43.0;
const LOW_PITCH_DEG: f64 = 10.0;

/// Distance from a target's aim, in the direction of a bearing, to the point that is `wanted` away from the center of
/// its first subject.
pub(super) fn distance_along(world: &World, target: &Target, bearing: Bearing, wanted: f64) -> f64 {
    let (sin, cos) = bearing.elevation_rad.sin_cos();
    let away = world.frame.direction(bearing.azimuth_rad) * cos + world.frame.up * sin;
    let offset = target.aim - target.center;
    let along = offset.dot(away);
    (along * along - offset.length_squared() + wanted * wanted).max(0.0).sqrt() - along
}

/// Elevation, seen from the target's aim, at which the camera is `height` above the floor: 24 bisections of -80 to 80
/// degrees, on which the camera's height grows.
fn elevation_at(
    world: &World,
    target: &Target,
    height: f64,
    bearing: Bearing,
    distance: &dyn Fn(Bearing) -> f64,
) -> f64 {
    let rise = height - world.height_above_floor(target.aim);
    let limit = 80.0_f64.to_radians();
    let (mut low, mut high) = (-limit, limit);
    for _ in 0..24 {
        let middle = low.midpoint(high);
        if distance(Bearing { elevation_rad: middle, ..bearing }) * middle.sin() < rise {
            low = middle;
        } else {
            high = middle;
        }
    }
    low.midpoint(high)
}

/// The item of a list that a share of 0..=1 picks, each by an equal part of it; `None` of an empty list.
pub(super) fn picked<T>(list: &[T], share: f64) -> Option<&T> {
    list.get(((share * list.len() as f64) as usize).min(list.len().saturating_sub(1)))
}

/// One of several azimuths, or up to an angle beside it. Parameter 4 picks it, parameter 0 the deviation.
pub(super) fn beside(azimuths_rad: &[f64], spread_rad: f64, parameters: &StepParameters) -> f64 {
    let off = parameters[0] * 2.0 - 1.0;
    picked(azimuths_rad, parameters[4]).copied().unwrap_or(0.0) + off * off.abs() * spread_rad
}

/// A preferred azimuth or any azimuth. The director's counts twice among the preferred ones.
fn azimuth(range: &ViewRange, proposed: Option<Bearing>, parameters: &StepParameters) -> f64 {
    let mut preferred = range.azimuths_rad.clone();
    preferred.extend(proposed.map(|bearing| bearing.azimuth_rad));
    preferred.extend(proposed.map(|bearing| bearing.azimuth_rad));
    if preferred.is_empty() || parameters[4] > PREFERRED_FRAC {
        return parameters[0] * TAU;
    }
    let pick = ((parameters[4] / PREFERRED_FRAC * preferred.len() as f64) as usize).min(preferred.len() - 1);
    // The density peaks at the preferred azimuth and ends 35 degrees from it.
    let off = parameters[0] * 2.0 - 1.0;
    preferred[pick] + off * off.abs() * 0.61
}

/// The view aimed at the left or right end of its target, where `part` names one.
pub(super) fn aimed_at_side(world: &World, target: &Target, part: SubjectPart, view: CameraState) -> CameraState {
    let sign = match part {
        SubjectPart::Left => -1.0,
        SubjectPart::Right => 1.0,
        SubjectPart::Middle | SubjectPart::Top | SubjectPart::Bottom => return view,
    };
    let right = view.pose.right();
    let half = target.corners.iter().map(|c| (*c - target.center).dot(right)).fold(0.0, f64::max);
    let aim = target.center + right * half * 0.6 * sign;
    aimed(world, &view, aim)
}

/// The camera turned in place to look at a point, level. Unchanged where the point is the camera's position.
pub(super) fn aimed(world: &World, state: &CameraState, point: DVec3) -> CameraState {
    let pose = Pose::look_at(state.pose.position, point, world.frame.up, Some(state.pose.right()));
    CameraState { pose: pose.unwrap_or(state.pose), ..*state }
}

/// The camera translated by a world vector.
pub(super) fn moved(state: &CameraState, by: DVec3) -> CameraState {
    let pose = Pose { position: state.pose.position + by, rotation: state.pose.rotation };
    CameraState { pose, ..*state }
}

/// The camera with another field of view.
pub(super) fn with_fov(state: &CameraState, fov_y_rad: f64) -> CameraState {
    CameraState { fov_y_rad, ..*state }
}

/// Azimuth, seen from its subject, of a camera whose right axis points from `a` to `b` (from `b` to `a` for `to_left`).
/// `None` where one is above the other.
pub(super) fn azimuth_across(frame: &LevelFrame, a: DVec3, b: DVec3, to_left: bool) -> Option<f64> {
    let line = frame.horizontal(b - a).try_normalize()?;
    let right = if to_left { -line } else { line };
    // Forward is up x right; the direction from the subject to the camera is its opposite.
    Some(frame.azimuth(right.cross(frame.up)))
}

/// The azimuth nearest to another one that a picture from straight above needs for a level box: its long side lies across.
fn squared(frame: &LevelFrame, corners: &[DVec3], azimuth_rad: f64) -> f64 {
    let sides = broadside_azimuths(frame, corners);
    let off = |side: &f64| rotation::short_turn(side - azimuth_rad).abs();
    sides.into_iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(azimuth_rad)
}

/// Azimuths that face the two broad sides of a box given by its corners; none where the sides are about as wide.
pub(super) fn broadside_azimuths(frame: &LevelFrame, corners: &[DVec3]) -> Vec<f64> {
    let extent = |azimuth: f64| {
        let along = frame.direction(azimuth);
        let reach = |f: fn(f64, f64) -> f64, start: f64| corners.iter().map(|c| c.dot(along)).fold(start, f);
        reach(f64::max, f64::NEG_INFINITY) - reach(f64::min, f64::INFINITY)
    };
    let half_turn = (0..36).map(|i| f64::from(i) * std::f64::consts::PI / 36.0);
    let thinnest = half_turn.min_by(|a, b| extent(*a).total_cmp(&extent(*b))).unwrap_or(0.0);
    let broad = extent(thinnest + std::f64::consts::FRAC_PI_2);
    if extent(thinnest) < 0.75 * broad { vec![thinnest, thinnest + std::f64::consts::PI] } else { Vec::new() }
}
