//! What a part of a film is worth: its goals, its clearance, what stands behind it in the capture, and taste.

use glam::{DVec2, DVec3};

use super::clearance::{Search, least_clearance};
use super::draft::{Axis, Goal, GoalKind, Part, StepLabels, When, keyframes};
use super::framing::{DEFAULT_ASPECT, Target, extent_frac, in_frame_frac, off_center, unoccluded_frac};
use super::world::World;
use cinesplat_geometry::Intrinsics;
use cinesplat_trajectory::{CameraPath, CameraState};

/// Points of a subject that are looked for while searching; the report looks for all.
const SEARCH_POINTS: usize = 14;
/// What must show beyond the goal while searching.
const SEARCH_MARGIN: f64 = 0.12;

/// Distance from the frame's middle that is still on a third.
const THIRD_BAND: (f64, f64) = (0.13, 0.2);

/// Parts of a path that are looked at for its clearance while searching.
const SEARCH_PARTS: usize = 400;

/// How a goal came out.
#[derive(Debug, Clone)]
pub(super) struct Outcome {
    /// The value at its worst.
    pub(super) got: f64,
    /// 0 when met, else how far off, in units in which 1 is a plain failure.
    pub(super) violation: f64,
}

/// Cost above which a part is hopeless, so that dearer measures are not taken.
const HOPELESS: f64 = 9.0;

/// Cost of a part: sums over parts; 0 to 3 for a good one, above 3 when something asked for is missing. What costs little
/// to measure comes first; a part that is already hopeless is charged for the rest without a look.
pub(super) fn cost(world: &World, part: &Part, suggestion: Option<&CameraState>) -> f64 {
    let path = path_of(world, part);
    let states = sampled(&path, part, if part.states.len() > 2 { 11 } else { 9 });
    let charge = |goal: &Goal| match outcome(world, goal, &states, SEARCH_POINTS).violation {
        violation if violation > 0.0 => 3.0 + 4.0 * violation.min(2.0),
        _ => 0.0,
    };
    let (dear, cheap): (Vec<&Goal>, Vec<&Goal>) =
        part.goals.iter().partition(|goal| matches!(goal.kind, GoalKind::Unoccluded(..)));
    let mut total: f64 = cheap.into_iter().map(charge).sum::<f64>() + clearance_cost(world, &path);
    if total > HOPELESS {
        return total + HOPELESS;
    }
    total += support_cost(world, &states);
    if total > HOPELESS {
        return total + HOPELESS / 2.0;
    }
    total += dear.into_iter().map(charge).sum::<f64>();
    total + void_cost(world, &states) + suggestion.map_or(0.0, |guess| departure(world, &states[0], guess))
}

/// The path of a part by itself.
pub(super) fn path_of(world: &World, part: &Part) -> CameraPath {
    let alone = Part { cut: false, step: 0, ..part.clone() };
    // Labels that carry nothing let the keys keep their move and pivot.
    CameraPath::coarse(keyframes(&[alone], &[StepLabels::default()]), world.frame)
}

/// Even samples in time of the path of a part.
pub(super) fn sampled(path: &CameraPath, part: &Part, count: usize) -> Vec<CameraState> {
    (0..count).map(|i| path.sample(part.secs * i as f64 / (count - 1) as f64)).collect()
}

/// Coming too near to matter at any moment.
fn clearance_cost(world: &World, path: &CameraPath) -> f64 {
    let radius = world.camera_radius;
    let search = Search { enough: radius, tolerance: 0.1 * radius, max_parts: SEARCH_PARTS };
    let short = 1.0 - least_clearance(world.ellipsoids(), path, &search).bound / radius;
    if short > 0.0 { 6.0 + 6.0 * short } else { 0.0 }
}

/// Standing where the capture shows backs, or (mildly) far outside of what it covers.
fn support_cost(world: &World, states: &[CameraState]) -> f64 {
    let position = |state: &CameraState| state.pose.position;
    let sunk = states.iter().map(|s| world.sunk_frac(position(s))).fold(0.0, f64::max);
    if sunk > 0.0 && world.is_indoor() {
        return 5.0 + 20.0 * sunk.min(0.4);
    }
    let around = states.iter().map(|s| around_a_corner_frac(world, position(s))).fold(0.0, f64::max);
    if around > 0.0 && world.is_indoor() {
        return 5.0 + 20.0 * around.min(0.4);
    }
    let unsupported = states.iter().filter(|s| !world.supports(position(s))).count() as f64 / states.len() as f64;
    if unsupported > 0.0 {
        return 5.0 + 8.0 * unsupported;
    }
    let ends = [&states[0], &states[states.len() / 2], &states[states.len() - 1]];
    let wrong = ends.iter().filter(|s| !world.is_good_side(position(s))).count();
    let outside = states.iter().map(|s| world.outside_frac(position(s))).fold(0.0, f64::max);
    3.0 * wrong as f64 + if world.is_indoor() { (8.0 * outside).min(2.0) } else { (8.0 * sunk).min(2.0) }
}

/// How far a point lies outside the scene's core in two level directions at once, the lesser of both over the scene size.
/// A room is often captured through an open side: the camera may stand before it, but not beyond the lines of the walls
/// beside it, from where their backs show.
fn around_a_corner_frac(world: &World, point: DVec3) -> f64 {
    let bounds = &world.bounds;
    let outside = (bounds.core_min - point).max(point - bounds.core_max).max(DVec3::ZERO);
    let mut level = outside;
    // Up and down do not count.
    level[world.frame.up.abs().max_position()] = f64::INFINITY;
    level.min_element() / bounds.size()
}

/// Share of a part's samples that stand in supported space.
pub(super) fn supported_frac(world: &World, states: &[CameraState]) -> f64 {
    let good = |s: &&CameraState| {
        let p = s.pose.position;
        let inside = world.sunk_frac(p) <= 0.0 && around_a_corner_frac(world, p) <= 0.0;
        world.supports(p) && world.is_good_side(p) && (inside || !world.is_indoor())
    };
    states.iter().filter(good).count() as f64 / states.len() as f64
}

/// Pictures of nothing, and pictures with something large right before the lens.
fn void_cost(world: &World, states: &[CameraState]) -> f64 {
    let picks = [0, states.len() / 2, states.len() - 1];
    let total: f64 = picks.iter().map(|&i| picture_cost(world, &states[i])).sum();
    total / picks.len() as f64
}

fn picture_cost(world: &World, state: &CameraState) -> f64 {
    let camera = cinesplat_geometry::Camera {
        pose: state.pose,
        intrinsics: Intrinsics::from_fov_y((9.0 * DEFAULT_ASPECT) as u32, 9, state.fov_y_rad),
    };
    let near = 0.05 * world.bounds.size();
    let (mut void, mut blocked, mut count) = (0.0, 0.0, 0.0);
    for column in 0..6 {
        for row in 0..4 {
            let at = DVec2::new((f64::from(column) + 0.5) / 6.0 * 16.0, (f64::from(row) + 0.5) / 4.0 * 9.0);
            match world.hit_distance(state.pose.position, camera.ray(at)) {
                None => void += 1.0,
                Some(distance) if distance < near => blocked += 1.0,
                Some(_) => {}
            }
            count += 1.0;
        }
    }
    let weight = if world.is_indoor() { 2.6 } else { 0.3 };
    (weight * void + 1.2 * blocked) / count
}

/// How far a first view is from what the director suggested: a tie breaker.
fn departure(world: &World, state: &CameraState, guess: &CameraState) -> f64 {
    let apart = state.pose.position.distance(guess.pose.position) / world.bounds.size();
    let turned = state.pose.forward().angle_between(guess.pose.forward());
    0.5 * apart.min(1.0) + 0.25 * turned
}

/// How a goal comes out on sampled states; `num_points` of a subject are looked for.
pub(super) fn outcome(world: &World, goal: &Goal, states: &[CameraState], num_points: usize) -> Outcome {
    let picked: &[CameraState] = match goal.when {
        When::Start => &states[..1],
        When::End => &states[states.len() - 1..],
        When::All | When::Any => states,
    };
    let over = |value: &dyn Fn(&CameraState) -> f64, band: (f64, f64), unit: f64| {
        worst_of(picked.iter().map(|s| banded(value(s), band, unit)), goal.when)
    };
    let (first, last) = (&states[0], &states[states.len() - 1]);
    match &goal.kind {
        GoalKind::Centered(target, most) => over(&|s| off_center(s, target.aim), (0.0, *most), 0.2),
        GoalKind::OnThird(target) => over(&|s| off_center(s, target.aim), THIRD_BAND, 0.2),
        GoalKind::Unoccluded(id, least) => seen_share(world, *id, *least, picked, num_points),
        GoalKind::Height(target, band) => over(&|s| height(s, target), *band, 0.3 * band.0.max(0.2)),
        GoalKind::InFrame(ids, least) => over(&|s| framed(world, s, ids), (*least, 1.0), 0.4),
        GoalKind::NotWhole(ids, most) => over(&|s| framed(world, s, ids), (0.0, *most), 0.4),
        GoalKind::Pitch(band) => over(&|s| world.frame.angles(s.pose.rotation).pitch_rad.to_degrees(), *band, 15.0),
        GoalKind::YawChange(band) => banded(turn_deg(world, states).0, *band, 20.0),
        GoalKind::PitchChange(band) => banded(turn_deg(world, states).1, *band, 20.0),
        GoalKind::DistanceRatio(point, band) => {
            let ratio = last.pose.position.distance(*point) / first.pose.position.distance(*point);
            banded(ratio, *band, 0.3)
        }
        GoalKind::LensRatio(band) => banded((last.fov_y_rad / 2.0).tan() / (first.fov_y_rad / 2.0).tan(), *band, 0.3),
        GoalKind::Travel(axis, point, least) => travel(world, *axis, *point, *least, first, last),
    }
}

fn banded(got: f64, (low, high): (f64, f64), unit: f64) -> Outcome {
    let off = (low - got).max(got - high).max(0.0);
    // A NaN counts as a failure.
    let violation = if off.is_nan() || off > 0.0 { (off / unit).clamp(0.02, 10.0) } else { 0.0 };
    Outcome { got, violation }
}

/// The worst of several frames, or the best where one of them is enough.
fn worst_of(outcomes: impl Iterator<Item = Outcome>, when: When) -> Outcome {
    let by = |a: &Outcome, b: &Outcome| a.violation.total_cmp(&b.violation);
    let found = if when == When::Any { outcomes.min_by(by) } else { outcomes.max_by(by) };
    found.unwrap_or(Outcome { got: f64::NAN, violation: 1.0 })
}

/// Frames on which a subject has to be seen: a post may pass before it, a wall may not stay.
const MOST_FRAMES: f64 = 0.85;

/// Share of the subject seen in most frames: what [`MOST_FRAMES`] of them reach.
fn seen_share(world: &World, id: u32, least: f64, states: &[CameraState], num_points: usize) -> Outcome {
    let Some(subject) = world.subject(id) else { return Outcome { got: 0.0, violation: 1.0 } };
    let mut shares: Vec<f64> = states.iter().map(|s| unoccluded_frac(s, subject, num_points)).collect();
    shares.sort_by(f64::total_cmp);
    // While searching fewer points are looked for, so a little more of them must show.
    let least = if num_points <= SEARCH_POINTS { least + SEARCH_MARGIN } else { least };
    let enough = shares.iter().filter(|&&share| share >= least).count() as f64 / shares.len() as f64;
    let hidden = ((1.0 - MOST_FRAMES) * shares.len() as f64 + 1e-9) as usize;
    let got = shares[hidden.min(shares.len() - 1)];
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    let off = ((MOST_FRAMES - enough) / MOST_FRAMES).max((least - mean) / 0.5).max(0.0);
    Outcome { got, violation: if enough >= MOST_FRAMES { 0.0 } else { off.max(0.02) } }
}

fn height(state: &CameraState, target: &Target) -> f64 {
    extent_frac(state, &target.corners).y
}

fn framed(world: &World, state: &CameraState, ids: &[u32]) -> f64 {
    let share = |id: &u32| {
        world.subject(*id).map_or(1.0, |s| {
            let points: Vec<DVec3> = s.points.iter().chain(&s.corners).copied().collect();
            in_frame_frac(state, &points, 0.012)
        })
    };
    ids.iter().map(share).fold(1.0, f64::min)
}

/// Total turn to the right and upward, degrees, along the samples.
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

fn travel(world: &World, axis: Axis, point: DVec3, least: f64, first: &CameraState, last: &CameraState) -> Outcome {
    let unit = match axis {
        Axis::Right => first.pose.right(),
        Axis::Left => -first.pose.right(),
        Axis::Up => world.frame.up,
        Axis::Down => -world.frame.up,
    };
    let way = last.pose.position - first.pose.position;
    let along = way.dot(unit);
    let pure = if way.length() > 0.0 { along / way.length() } else { 0.0 };
    let got = along / first.pose.position.distance(point).max(1e-9);
    let outcome = banded(got, (least, f64::INFINITY), 0.3);
    Outcome { violation: outcome.violation + if pure < 0.9 { 1.0 } else { 0.0 }, ..outcome }
}

/// What a goal asks for, in words.
pub(super) fn wording(world: &World, goal: &Goal) -> String {
    let name = |id: &u32| world.subject(*id).map_or_else(|| format!("<obj-{id}>"), |s| s.label.clone());
    let names = |ids: &[u32]| ids.iter().map(name).collect::<Vec<_>>().join(", ");
    let what = match &goal.kind {
        GoalKind::Centered(target, most) => format!("{} within {most:.2} of the frame's middle", names(&target.ids)),
        GoalKind::OnThird(target) => format!("{} on a third of the frame", names(&target.ids)),
        GoalKind::Unoccluded(id, least) => format!("{} seen past everything else, share at least {least:.2}", name(id)),
        GoalKind::Height(target, (low, high)) => {
            format!("{} {low:.2} to {high:.2} of the frame's height", names(&target.ids))
        }
        GoalKind::InFrame(ids, least) => format!("{} in the frame, share at least {least:.2}", names(ids)),
        GoalKind::NotWhole(ids, most) => format!("{} in the frame, share at most {most:.2}", names(ids)),
        GoalKind::Pitch((low, high)) => format!("pitch {low:.0} to {high:.0} degrees"),
        GoalKind::YawChange((low, high)) => format!("turn to the right {low:.0} to {high:.0} degrees"),
        GoalKind::PitchChange((low, high)) => format!("turn upward {low:.0} to {high:.0} degrees"),
        GoalKind::DistanceRatio(_, band) => format!("distance, end over start, {}", range(*band)),
        GoalKind::LensRatio(band) => format!("tangent of half the field of view, end over start, {}", range(*band)),
        GoalKind::Travel(axis, _, least) => {
            format!("way to the {} over the distance at least {least:.2}", axis_name(*axis))
        }
    };
    let when = match goal.when {
        When::Start => " at the start",
        When::End => " at the end",
        When::All => "",
        When::Any => " at some time",
    };
    what + when
}

fn range((low, high): (f64, f64)) -> String {
    match (low > 0.0, high.is_finite()) {
        (true, true) => format!("{low:.2} to {high:.2}"),
        (true, false) => format!("at least {low:.2}"),
        _ => format!("at most {high:.2}"),
    }
}

fn axis_name(axis: Axis) -> &'static str {
    match axis {
        Axis::Right => "right",
        Axis::Left => "left",
        Axis::Up => "up",
        Axis::Down => "down",
    }
}
