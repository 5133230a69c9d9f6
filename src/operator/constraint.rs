//! Constraints on the frames of a motion segment: what they measure, by how much a film violates them, and their words
//! for the report.

use glam::DVec3;

use super::framing::{Target, extent_frac, in_frame_frac, off_center, unoccluded_frac};
use super::world::World;
use cinesplat_trajectory::{CameraState, ShotAngle};

/// Sample points per subject for visibility during the search; the report uses all points.
pub(super) const SEARCH_POINTS: usize = 14;
/// Margin on the visible share during the search, because few points measure it coarsely.
const SEARCH_MARGIN: f64 = 0.12;
/// Range of the distance from the frame's middle that counts as on a third.
const THIRD_BAND: (f64, f64) = (0.13, 0.2);
/// Share of the frames on which a subject must be visible: a post may hide it briefly, a wall may not.
const VISIBLE_FRAMES_FRAC: f64 = 0.85;

/// A constraint on the frames of a segment.
#[derive(Debug, Clone)]
pub(super) struct Constraint {
    /// The requirement.
    pub(super) kind: ConstraintKind,
    /// Frames on which it must hold.
    pub(super) scope: Scope,
}

/// Frames of a segment on which a constraint must hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scope {
    /// The first.
    Start,
    /// The last.
    End,
    /// All.
    All,
    /// At least one.
    Any,
}

/// The requirement of a constraint. Values over the whole segment, such as a turn, ignore the scope.
#[derive(Debug, Clone)]
pub(super) enum ConstraintKind {
    /// The target's aim is at most this far from the frame's middle.
    Centered(Target, f64),
    /// The target's aim is on the left or right third of the frame.
    OnThird(Target),
    /// At least this share of the subject's points in the frame is visible.
    Unoccluded(u32, f64),
    /// Projected height over the frame's height is in this range.
    Height(Target, (f64, f64)),
    /// At least this share of each subject's corners and points is in the frame.
    InFrame(Vec<u32>, f64),
    /// At most this share of the corners and points is in the frame, for at least one of the subjects.
    NotWhole(Vec<u32>, f64),
    /// Pitch of the camera is in this range, degrees.
    Pitch((f64, f64)),
    /// Total turn to the right over the segment is in this range, degrees.
    YawChange((f64, f64)),
    /// Total turn upward over the segment is in this range, degrees.
    PitchChange((f64, f64)),
    /// Distance to the point at the end over that at the start is in this range.
    DistanceRatio(DVec3, (f64, f64)),
    /// Tangent of half the field of view at the end over that at the start is in this range.
    LensRatio((f64, f64)),
    /// Travel in a direction, over the distance to the point at the start, is at least this much, and at least 0.9 of
    /// the whole displacement.
    Travel(TravelDirection, DVec3, f64),
}

/// Direction of a sliding move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::Display)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum TravelDirection {
    /// To the right of the segment's first camera.
    Right,
    /// To the left of the segment's first camera.
    Left,
    /// Along the world's up.
    Up,
    /// Against the world's up.
    Down,
}

impl TravelDirection {
    /// Whether the direction is along or against the world's up.
    pub(super) fn is_vertical(self) -> bool {
        matches!(self, Self::Up | Self::Down)
    }
}

/// Range of the camera's pitch for an angle of the shot, degrees, positive up.
pub(super) fn pitch_band_deg(angle: ShotAngle) -> (f64, f64) {
    match angle {
        ShotAngle::Overhead => (-90.0, -40.0),
        ShotAngle::High => (-40.0, -12.0),
        ShotAngle::EyeLevel => (-12.0, 10.0),
        ShotAngle::Low => (8.0, 42.0),
        ShotAngle::Worm => (38.0, 90.0),
    }
}

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
    let picked: &[CameraState] = match constraint.scope {
        Scope::Start => &states[..1],
        Scope::End => &states[states.len() - 1..],
        Scope::All | Scope::Any => states,
    };
    let over = |value: &dyn Fn(&CameraState) -> f64, band: (f64, f64), unit: f64| {
        worst_of(picked.iter().map(|s| range_violation(value(s), band, unit)), constraint.scope)
    };
    let (first, last) = (&states[0], &states[states.len() - 1]);
    match &constraint.kind {
        ConstraintKind::Centered(target, most) => over(&|s| off_center(s, target.aim), (0.0, *most), 0.2),
        ConstraintKind::OnThird(target) => over(&|s| off_center(s, target.aim), THIRD_BAND, 0.2),
        ConstraintKind::Unoccluded(id, least) => visible_share(world, *id, *least, picked, num_points),
        ConstraintKind::Height(target, band) => over(&|s| height(s, target), *band, 0.3 * band.0.max(0.2)),
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
    }
}

/// The violation of a range: 0 inside, else the distance from it over `unit`.
fn range_violation(value: f64, (low, high): (f64, f64), unit: f64) -> Measurement {
    let off = (low - value).max(value - high).max(0.0);
    // A NaN counts as a violation.
    let violation = if off.is_nan() || off > 0.0 { (off / unit).clamp(0.02, 10.0) } else { 0.0 };
    Measurement { value, violation }
}

/// The worst of several frames, or the best where one frame suffices.
fn worst_of(measurements: impl Iterator<Item = Measurement>, scope: Scope) -> Measurement {
    let by = |a: &Measurement, b: &Measurement| a.violation.total_cmp(&b.violation);
    let picked = if scope == Scope::Any { measurements.min_by(by) } else { measurements.max_by(by) };
    picked.unwrap_or(Measurement { value: f64::NAN, violation: 1.0 })
}

/// The largest share of a subject's points that is visible on at least [`VISIBLE_FRAMES_FRAC`] of the frames.
fn visible_share(world: &World, id: u32, least: f64, states: &[CameraState], num_points: usize) -> Measurement {
    let Some(subject) = world.subject(id) else { return Measurement { value: 0.0, violation: 1.0 } };
    let mut shares: Vec<f64> = states.iter().map(|s| unoccluded_frac(s, subject, num_points)).collect();
    shares.sort_by(f64::total_cmp);
    let least = if num_points <= SEARCH_POINTS { least + SEARCH_MARGIN } else { least };
    let enough = shares.iter().filter(|&&share| share >= least).count() as f64 / shares.len() as f64;
    let hidden = ((1.0 - VISIBLE_FRAMES_FRAC) * shares.len() as f64 + 1e-9) as usize;
    let value = shares[hidden.min(shares.len() - 1)];
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    let off = ((VISIBLE_FRAMES_FRAC - enough) / VISIBLE_FRAMES_FRAC).max((least - mean) / 0.5).max(0.0);
    Measurement { value, violation: if enough >= VISIBLE_FRAMES_FRAC { 0.0 } else { off.max(0.02) } }
}

fn height(state: &CameraState, target: &Target) -> f64 {
    extent_frac(state, &target.corners).y
}

/// The least share, over the subjects, of corners and points inside the frame.
fn framed(world: &World, state: &CameraState, ids: &[u32]) -> f64 {
    let share = |id: &u32| {
        world.subject(*id).map_or(1.0, |s| {
            let points: Vec<DVec3> = s.points.iter().chain(&s.corners).copied().collect();
            in_frame_frac(state, &points, 0.012)
        })
    };
    ids.iter().map(share).fold(1.0, f64::min)
}

/// Total turn to the right and upward along the samples, degrees.
fn turn_deg(world: &World, states: &[CameraState]) -> (f64, f64) {
    let angles = |s: &CameraState| world.frame.angles(s.pose.rotation);
    let step = |pair: &[CameraState]| {
        let turn = angles(&pair[1]).yaw_rad - angles(&pair[0]).yaw_rad;
        (turn + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
    };
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

/// A constraint in words, for the report.
pub(super) fn wording(world: &World, constraint: &Constraint) -> String {
    let name = |id: &u32| world.subject(*id).map_or_else(|| format!("<obj-{id}>"), |s| s.label.clone());
    let names = |ids: &[u32]| ids.iter().map(name).collect::<Vec<_>>().join(", ");
    let what = match &constraint.kind {
        ConstraintKind::Centered(target, most) => {
            format!("{} within {most:.2} of the frame's middle", names(&target.ids))
        }
        ConstraintKind::OnThird(target) => format!("{} on a third of the frame", names(&target.ids)),
        ConstraintKind::Unoccluded(id, least) => format!("visible share of {} at least {least:.2}", name(id)),
        ConstraintKind::Height(target, (low, high)) => {
            format!("{} {low:.2} to {high:.2} of the frame's height", names(&target.ids))
        }
        ConstraintKind::InFrame(ids, least) => format!("share of {} in the frame at least {least:.2}", names(ids)),
        ConstraintKind::NotWhole(ids, most) => format!("share of {} in the frame at most {most:.2}", names(ids)),
        ConstraintKind::Pitch((low, high)) => format!("pitch {low:.0} to {high:.0} degrees"),
        ConstraintKind::YawChange((low, high)) => format!("turn to the right {low:.0} to {high:.0} degrees"),
        ConstraintKind::PitchChange((low, high)) => format!("turn upward {low:.0} to {high:.0} degrees"),
        ConstraintKind::DistanceRatio(_, band) => format!("distance, end over start, {}", range(*band)),
        ConstraintKind::LensRatio(band) => {
            format!("tangent of half the field of view, end over start, {}", range(*band))
        }
        ConstraintKind::Travel(direction, _, least) => {
            format!("travel {direction}, over the distance, at least {least:.2}")
        }
    };
    let scope = match constraint.scope {
        Scope::Start => " at the start",
        Scope::End => " at the end",
        Scope::All => "",
        Scope::Any => " on at least one frame",
    };
    what + scope
}

fn range((low, high): (f64, f64)) -> String {
    match (low > 0.0, high.is_finite()) {
        (true, true) => format!("{low:.2} to {high:.2}"),
        (true, false) => format!("at least {low:.2}"),
        _ => format!("at most {high:.2}"),
    }
}
