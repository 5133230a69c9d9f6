//! Measures constraints: by how much a film violates them.

use glam::{DVec2, DVec3};

use super::attainable::least_visible;
use super::composition::{frame_place, off_side_deg};
use super::constraint::{
    AHEAD_FRAC, BACKDROP_FRAC, BACKDROP_OFF, Constraint, ConstraintKind, FOREGROUND_OFF, PLACE_TOLERANCE, Scope,
    TravelDirection, side_tolerance_deg,
};
use super::framing::{
    Target, bearing_of, extent_frac, frame_position, in_frame_frac, off_center, seen_frac, unoccluded_frac,
};
use super::limit::measured;
use super::passage::passage;
use super::simultaneous::extent;
use super::steadiness::excess;
use super::world::World;
use cinesplat_geometry::rotation;
use cinesplat_trajectory::CameraState;

/// Sample points per subject for visibility during the search; the report uses all points.
pub(super) const SEARCH_POINTS: usize = 14;
/// Margin on the visible share during the search, because few points measure it coarsely.
const SEARCH_MARGIN: f64 = 0.12;
/// Factor on the largest visible share of what must not be seen, during the search.
const SEARCH_UNSEEN: f64 = 0.4;
/// Range of the distance from the frame's middle that counts as on a third.
const THIRD_BAND: (f64, f64) = (0.13, 0.2);
/// Least share of an object's points in the frame where it is the foreground.
const FOREGROUND_FRAC: f64 = 0.15;
/// How far off a limit is a clear violation, over the scene size.
const LIMIT_UNIT_FRAC: f64 = 0.08;
/// Share of the frames on which a subject must be visible: a post may hide it briefly, a wall may not.
const VISIBLE_FRAMES_FRAC: f64 = 0.85;

/// A constraint measured on a film.
#[derive(Debug, Clone)]
pub(super) struct Measurement {
    /// The measured value on the worst frame.
    pub(super) value: f64,
    /// 0 where the constraint is met, else the distance from its range, in units in which 1 is a clear violation.
    pub(super) violation: f64,
}

/// Measures a constraint on the sampled states of its segment. `num_points` is the number of points per subject whose
/// visibility is tested.
pub(super) fn measure(
    world: &World,
    constraint: &Constraint,
    states: &[CameraState],
    num_points: usize,
) -> Measurement {
    let picked = constraint.scope.of(states);
    let over = |value: &dyn Fn(&CameraState) -> f64, band: (f64, f64), unit: f64| {
        worst_of(picked.iter().map(|s| range_violation(value(s), band, unit)), constraint.scope)
    };
    let (first, last) = (&states[0], &states[states.len() - 1]);
    match &constraint.kind {
        ConstraintKind::Centered(target, most) => over(&|s| off_center(world, s, target.aim), (0.0, *most), 0.2),
        ConstraintKind::OnThird(target) => over(&|s| off_center(world, s, target.aim), THIRD_BAND, 0.2),
        ConstraintKind::Unoccluded(id, least) => visible_share(world, *id, *least, picked, num_points),
        ConstraintKind::Height(target, band) => over(&|s| height(world, s, target), *band, 0.3 * band.0.max(0.2)),
        ConstraintKind::InFrame(ids, least) => over(&|s| framed(world, s, ids), (*least, 1.0), 0.4),
        ConstraintKind::NotWhole(ids, most) => over(&|s| framed(world, s, ids), (0.0, *most), 0.4),
        ConstraintKind::Pitch(band) => {
            over(&|s| world.frame.angles(s.pose.rotation).pitch_rad.to_degrees(), *band, 15.0)
        }
        ConstraintKind::YawChange(band) => range_violation(turn_deg(world, states).0, *band, 20.0),
        ConstraintKind::PitchChange(band) => range_violation(turn_deg(world, states).1, *band, 20.0),
        ConstraintKind::DistanceRatio(point, band) => {
            let ratio = last.pose.position.distance(*point) / first.pose.position.distance(*point);
            range_violation(ratio, *band, 0.3)
        }
        ConstraintKind::LensRatio(band) => {
            range_violation((last.fov_y_rad / 2.0).tan() / (first.fov_y_rad / 2.0).tan(), *band, 0.3)
        }
        ConstraintKind::Travel(direction, point, least) => travel(world, *direction, *point, *least, (first, last)),
        ConstraintKind::Passed(how, id) => passage(world, *how, *id, states)
            .map_or(Measurement { value: f64::NAN, violation: 1.0 }, |(value, band)| range_violation(value, band, 0.5)),
        ConstraintKind::Also(movement, point) => {
            let (value, least) = extent(world, *movement, *point, states);
            range_violation(value, (least, f64::INFINITY), least.abs().max(0.1))
        }
        ConstraintKind::Without(motion) => {
            let (value, most, unit) = excess(world, *motion, states);
            range_violation(value, (0.0, most), unit)
        }
        ConstraintKind::LookAlong(sign, most) => {
            let moving = ((states.len() as f64 * AHEAD_FRAC) as usize).clamp(2, states.len());
            let off = states[..moving].windows(2).filter_map(|pair| off_travel_deg(pair, *sign));
            worst_of(off.map(|value| range_violation(value, (0.0, *most), 30.0)), Scope::All)
        }
        kind => worst_of(picked.iter().map(|state| composed(world, kind, state, num_points)), constraint.scope),
    }
}

/// The constraints that concern one frame and its composition.
fn composed(world: &World, kind: &ConstraintKind, state: &CameraState, num_points: usize) -> Measurement {
    let position = state.pose.position;
    match kind {
        ConstraintKind::Placed(target, place) => {
            let off = frame_position(world, state, target.aim)
                .map_or(f64::INFINITY, |(at, _)| (at - frame_place(*place)).abs().max_element());
            range_violation(off, (0.0, PLACE_TOLERANCE), 0.2)
        }
        ConstraintKind::Distance(target, band) => {
            range_violation(position.distance(target.center), *band, 0.3 * band.0.max(1e-9))
        }
        ConstraintKind::Elevation(target, band) => {
            range_violation(bearing_of(world, target.center, position).elevation_rad.to_degrees(), *band, 15.0)
        }
        ConstraintKind::CameraHeight(band) => {
            range_violation(world.height_above_floor(position), *band, 0.1 * world.bounds.size())
        }
        ConstraintKind::FieldOfView(band) => range_violation(state.fov_y_rad.to_degrees(), *band, 10.0),
        ConstraintKind::FromSide(target, side) => {
            range_violation(off_side_deg(world, target.center, position, *side), (0.0, side_tolerance_deg(*side)), 40.0)
        }
        ConstraintKind::Unseen(id, most) => {
            let share = world.subject(*id).map_or(0.0, |subject| seen_frac(world, state, subject, num_points));
            // As few points as the search tests miss what shows beside them: it accepts none.
            let most = if num_points <= SEARCH_POINTS { SEARCH_UNSEEN * most } else { *most };
            range_violation(share, (0.0, most), 0.3)
        }
        ConstraintKind::Foreground(id, target) => {
            let off = foreground_off(world, *id, target, state).unwrap_or(f64::NAN);
            range_violation(off, (FOREGROUND_OFF, 0.5), 0.2)
        }
        ConstraintKind::Backdrop(id, target) => {
            let off = backdrop_off(world, *id, target, state).unwrap_or(f64::NAN);
            range_violation(off, (0.0, BACKDROP_OFF), 0.5)
        }
        ConstraintKind::Limited(limit) => {
            let (value, band) = measured(world, limit, state);
            range_violation(value, band, LIMIT_UNIT_FRAC * world.bounds.size())
        }
        ConstraintKind::LookAt(point, _, most) => range_violation(off_center(world, state, *point), (0.0, *most), 0.2),
        _ => Measurement { value: f64::NAN, violation: 0.0 },
    }
}

/// Distance of the middle of an object's points in the frame from the frame's middle, to a side or below. `None` where
/// less than [`FOREGROUND_FRAC`] of it is in the frame, or where it is not nearer than the target.
fn foreground_off(world: &World, id: u32, target: &Target, state: &CameraState) -> Option<f64> {
    let subject = world.subject(id)?;
    let position = state.pose.position;
    let nearer = position.distance(subject.center) < position.distance(target.center);
    let inside: Vec<DVec2> = subject
        .points
        .iter()
        .filter_map(|&point| frame_position(world, state, point).map(|(at, _)| at))
        .filter(|at| at.abs().max_element() <= 0.5)
        .collect();
    let share = inside.len() as f64 / subject.points.len().max(1) as f64;
    let middle = inside.iter().sum::<DVec2>() / inside.len().max(1) as f64;
    (nearer && share >= FOREGROUND_FRAC).then(|| middle.x.abs().max(-middle.y))
}

/// Distance of an object's center beside that of the target's first subject, over the frame's width. `None` where the object
/// is not farther away, or where less than [`BACKDROP_FRAC`] of it is in the frame.
fn backdrop_off(world: &World, id: u32, target: &Target, state: &CameraState) -> Option<f64> {
    let object = world.subject(id)?;
    let (own, own_depth) = frame_position(world, state, target.center)?;
    let (at, depth) = frame_position(world, state, object.center)?;
    let is_behind = depth > own_depth && in_frame_frac(world, state, &object.points, 0.0) >= BACKDROP_FRAC;
    is_behind.then(|| (at.x - own.x).abs())
}

/// Angle between the view axis and the direction of travel (`sign` 1) or its opposite (-1) between two samples, degrees.
/// `None` where the camera stands still.
fn off_travel_deg(pair: &[CameraState], sign: f64) -> Option<f64> {
    let way = (pair[1].pose.position - pair[0].pose.position).try_normalize()?;
    let forward = pair[0].pose.forward() + pair[1].pose.forward();
    Some(forward.angle_between(way * sign).to_degrees())
}

/// The violation of a range: 0 inside, else the distance from it over `unit`.
fn range_violation(value: f64, (low, high): (f64, f64), unit: f64) -> Measurement {
    let off = (low - value).max(value - high).max(0.0);
    // A NaN counts as a violation.
    let violation = match (value.is_nan(), off > 0.0) {
        (true, _) => 1.0,
        (false, true) => (off / unit).clamp(0.02, 10.0),
        (false, false) => 0.0,
    };
    Measurement { value, violation }
}

/// The worst of several frames, or the best where one frame suffices.
fn worst_of(measurements: impl Iterator<Item = Measurement>, scope: Scope) -> Measurement {
    let by = |a: &Measurement, b: &Measurement| a.violation.total_cmp(&b.violation);
    let picked = if scope == Scope::Any { measurements.min_by(by) } else { measurements.max_by(by) };
    picked.unwrap_or(Measurement { value: f64::NAN, violation: 1.0 })
}

/// Share of what must be visible that the first and the last frame show.
const ENDS_OF_LEAST: f64 = 0.75;

/// The largest share of a subject's points that is visible on at least [`VISIBLE_FRAMES_FRAC`] of the frames.
fn visible_share(world: &World, id: u32, least: f64, states: &[CameraState], num_points: usize) -> Measurement {
    let Some(subject) = world.subject(id) else { return Measurement { value: 0.0, violation: 1.0 } };
    let mut shares: Vec<f64> = states.iter().map(|s| unoccluded_frac(world, s, subject, num_points)).collect();
    let least = if num_points <= SEARCH_POINTS { least + SEARCH_MARGIN } else { least };
    let least = least_visible(world, subject, least);
    // The first and the last picture stay for longer than those between.
    let at_ends = shares[0].min(shares[shares.len() - 1]);
    let at_ends_off = if at_ends < ENDS_OF_LEAST * least { (least - at_ends).max(0.02) } else { 0.0 };
    shares.sort_by(f64::total_cmp);
    let enough = shares.iter().filter(|&&share| share >= least).count() as f64 / shares.len() as f64;
    let hidden = ((1.0 - VISIBLE_FRAMES_FRAC) * shares.len() as f64 + 1e-9) as usize;
    let value = shares[hidden.min(shares.len() - 1)];
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    let off = ((VISIBLE_FRAMES_FRAC - enough) / VISIBLE_FRAMES_FRAC).max((least - mean) / 0.5).max(0.0);
    let off = if enough >= VISIBLE_FRAMES_FRAC { 0.0 } else { off.max(0.02) };
    Measurement { value: if at_ends_off > 0.0 { value.min(at_ends) } else { value }, violation: off.max(at_ends_off) }
}

fn height(world: &World, state: &CameraState, target: &Target) -> f64 {
    extent_frac(world, state, target.sized_by()).y
}

/// The least share, over the subjects, of corners and points inside the frame.
fn framed(world: &World, state: &CameraState, ids: &[u32]) -> f64 {
    let share = |id: &u32| {
        world.subject(*id).map_or(1.0, |s| {
            let points: Vec<DVec3> = s.points.iter().chain(&s.corners).copied().collect();
            in_frame_frac(world, state, &points, 0.012)
        })
    };
    ids.iter().map(share).fold(1.0, f64::min)
}

/// Total turn to the right and upward along the samples, degrees.
fn turn_deg(world: &World, states: &[CameraState]) -> (f64, f64) {
    let angles = |s: &CameraState| world.frame.angles(s.pose.rotation);
    let step = |pair: &[CameraState]| rotation::short_turn(angles(&pair[1]).yaw_rad - angles(&pair[0]).yaw_rad);
    let yaw: f64 = states.windows(2).map(step).sum();
    let pitch = angles(&states[states.len() - 1]).pitch_rad - angles(&states[0]).pitch_rad;
    (yaw.to_degrees(), pitch.to_degrees())
}

fn travel(
    world: &World,
    direction: TravelDirection,
    point: DVec3,
    least: f64,
    (first, last): (&CameraState, &CameraState),
) -> Measurement {
    let unit = match direction {
        TravelDirection::Right => first.pose.right(),
        TravelDirection::Left => -first.pose.right(),
        TravelDirection::Up => world.frame.up,
        TravelDirection::Down => -world.frame.up,
    };
    let way = last.pose.position - first.pose.position;
    let along = way.dot(unit);
    let pure = if way.length() > 0.0 { along / way.length() } else { 0.0 };
    let value = along / first.pose.position.distance(point).max(1e-9);
    let measured = range_violation(value, (least, f64::INFINITY), 0.3);
    Measurement { violation: measured.violation + if pure < 0.9 { 1.0 } else { 0.0 }, ..measured }
}
