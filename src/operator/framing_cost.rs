//! What the framing of a segment's ends is worth: subjects that the edge of the frame cuts, and turns that hardly show.

use glam::DVec3;

use super::composition::square_azimuths;
use super::constraint::{Constraint, ConstraintKind, Scope};
use super::framing::{extent_frac, frame_position, in_frame_frac, off_center};
use super::motion::MotionSegment;
use super::program::SubjectSide;
use super::view::ramp;
use super::wall_side::{wall_behind, wall_side};
use super::world::{Subject, World};
use cinesplat_geometry::rotation;
use cinesplat_trajectory::{CameraState, Move};

/// Cost of a subject that is wholly out of the frame at an end, over what of it is cut.
const CUT_COST: f64 = 1.4;
/// Height in the frame from which a stated size cuts its subject: that of a medium close-up.
const CUTTING_HEIGHT: f64 = 0.8;
/// Radius of a subject over the scene size from which it is part of the room, and no picture has to hold it.
const LARGE_FRAC: f64 = 0.22;
/// Margin of the frame, over its size, within which a subject touches the edge.
const EDGE: f64 = 0.01;
/// Cost of a turn from one subject to another that does not change the picture.
const SHORT_TURN_COST: f64 = 0.9;
/// Angle of such a turn over the field of view from which on it costs nothing.
const LEAST_TURN: f64 = 0.75;
/// Cost of a pull-out whose lens widens at all: nearly that of a violated constraint.
const WIDENED_COST: f64 = 2.5;

/// Cost of the framing at the ends of a segment.
pub(super) fn framing_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let turned = short_turn_cost(world, segment, states);
    let sized = cut_cost(world, segment, states) + small_cost(world, segment, states);
    let composed = slide_turn_cost(world, segment, states)
        + askew_cost(world, segment, states)
        + off_wall_side_cost(world, segment, states)
        + raked_cost(world, segment, states)
        + unsquare_cost(world, segment, states)
        + keystone_cost(world, segment, states)
        + wide_cost(world, segment, states)
        + near_room_cost(world, segment, states);
    sized
        + turned
        + soft_cost(world, segment, states)
        + widened_cost(segment)
        + approach_cost(segment, states)
        + composed
}

/// Cost of a turn on the way from one thing to another on the same table, and the turns at which it begins and is
/// reached, degrees.
const SLIDE_TURN_COST: f64 = 0.9;
const SLIDE_TURN_DEG: (f64, f64) = (25.0, 90.0);
/// Distance from the frame's middle up to which a thing is what a way sets out from.
const AMID: f64 = 0.25;

/// Cost of a way from thing to thing on one table that turns: who stands before a table slides along it.
fn slide_turn_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if segment.movement != Move::Follow || segment.is_join {
        return 0.0;
    }
    let mut at_end = segment.constraints.iter().filter(|constraint| constraint.scope == Scope::End);
    let goal = at_end.find_map(|constraint| constraint.shown(world));
    let Some(goal) = goal.filter(|goal| goal.bearer.is_some()) else { return 0.0 };
    let (first, last) = (&states[0], &states[states.len() - 1]);
    let beside = |subject: &Subject| {
        let is_amid = || off_center(world, first, subject.center) <= AMID;
        subject.bearer == goal.bearer && subject.center != goal.center && is_amid()
    };
    if !world.subjects().any(beside) {
        return 0.0;
    }
    let yaw = |state: &CameraState| world.frame.angles(state.pose.rotation).yaw_rad;
    let turn_deg = rotation::short_turn(yaw(last) - yaw(first)).abs().to_degrees();
    SLIDE_TURN_COST * ramp(SLIDE_TURN_DEG, turn_deg)
}

/// Cost of seeing what stands at a wall along the wall, and the angles from its front at which it begins and is reached,
/// degrees.
const ALONG_WALL_COST: f64 = 0.8;
const ALONG_WALL_DEG: (f64, f64) = (42.0, 80.0);
/// The same of what faces people, from behind.
const BEHIND_DEG: (f64, f64) = (75.0, 135.0);

/// Cost of pictures that see what stands at a wall from beside it, or what faces people from behind, where no words ask for a side:
/// nobody looks at a bookshelf along its wall, or at the back of a chair.
fn off_wall_side_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let goes_round = segment.movement.is_circular() || matches!(segment.movement, Move::FlyThrough | Move::Reveal);
    let is_sided = |constraint: &Constraint| matches!(constraint.kind, ConstraintKind::FromSide(..));
    if goes_round || segment.is_join || segment.constraints.iter().any(is_sided) {
        return 0.0;
    }
    let off = |constraint: &Constraint| {
        let Some(subject) = constraint.shown(world) else { return 0.0 };
        let faced = || subject.facing_rad.filter(|_| world.is_indoor()).map(|facing_rad| (facing_rad, BEHIND_DEG));
        let side = wall_side(world, subject).map(|front_rad| (front_rad, ALONG_WALL_DEG)).or_else(faced);
        let Some((front_rad, range_deg)) = side else { return 0.0 };
        let beside = |state: &CameraState| {
            let azimuth = world.frame.azimuth(state.pose.position - subject.center);
            let off_deg = rotation::short_turn(azimuth - front_rad).abs().to_degrees();
            ramp(range_deg, off_deg)
        };
        let ends = [states[0], states[states.len() - 1]];
        constraint.scope.of(&ends).iter().map(beside).fold(0.0, f64::max)
    };
    ALONG_WALL_COST * segment.constraints.iter().map(off).fold(0.0, f64::max)
}

/// Cost of a slide along a wall that does not face it, and the angles at which it begins and is reached, degrees.
const RAKED_COST: f64 = 1.2;
const RAKED_DEG: (f64, f64) = (4.0, 40.0);

/// Cost of a slide or a rise before what stands at a wall or hangs there, askew to that wall, where no words ask for a side:
/// along pictures, shelves and counters the camera slides square to them.
fn raked_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let slides = matches!(segment.movement, Move::TruckLeft | Move::TruckRight | Move::PedestalUp | Move::PedestalDown);
    let is_sided = |constraint: &Constraint| {
        matches!(constraint.kind, ConstraintKind::FromSide(..) | ConstraintKind::Backdrop(..))
    };
    if !slides || segment.is_join || segment.constraints.iter().any(is_sided) {
        return 0.0;
    }
    let ahead = world.frame.azimuth(-states[states.len() / 2].pose.forward());
    let off_deg = |subject: &Subject| {
        let square_rad = wall_behind(world, subject)?;
        Some(rotation::short_turn(ahead - square_rad).abs().to_degrees())
    };
    let about = segment.constraints.iter().flat_map(Constraint::about).filter_map(|id| world.subject(*id));
    RAKED_COST * mean(about.filter_map(off_deg).map(|off_deg| ramp(RAKED_DEG, off_deg)))
}

/// Mean of some values; 0 of none.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count.max(1))
}

/// Cost of a pull-out to the room as a whole that ends near what it leaves, and the sizes of that, the larger of its shares of width and
/// height, at which it begins and is reached.
const NEAR_ROOM_COST: f64 = 1.4;
const LEFT_SIZE: (f64, f64) = (0.12, 0.45);

/// Cost of pull-outs that still show the thing that they leave, and hardly the room.
fn near_room_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if segment.movement != Move::PullOut || segment.is_join || !world.is_indoor() {
        return 0.0;
    }
    let left = segment.constraints.iter().find_map(|constraint| match &constraint.kind {
        // Nothing says how large the thing is at the end: the picture is one of the room.
        ConstraintKind::Height(target, (low, _)) if constraint.scope == Scope::End && *low <= 0.0 => Some(target),
        _ => None,
    });
    let Some(left) = left else { return 0.0 };
    let size = extent_frac(world, &states[states.len() - 1], left.sized_by()).max_element();
    NEAR_ROOM_COST * ramp(LEFT_SIZE, size)
}

/// Cost of a wide lens near a thing, which bends it, where the words state no lens, and the vertical fields of view at which it begins
/// and is reached, degrees.
const WIDE_COST: f64 = 0.7;
const WIDE_DEG: (f64, f64) = (60.0, 86.0);

/// Cost of lenses that are wider than a person would take for a thing in a room.
fn wide_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let is_stated = |constraint: &Constraint| {
        matches!(constraint.kind, ConstraintKind::FieldOfView(_) | ConstraintKind::LensRatio(_))
    };
    let is_small = |constraint: &Constraint| {
        constraint.shown(world).is_some_and(|subject| subject.radius < LARGE_FRAC * world.bounds.size())
    };
    if segment.is_join || segment.constraints.iter().any(is_stated) || !segment.constraints.iter().any(is_small) {
        return 0.0;
    }
    let widest = [states[0], states[states.len() - 1]].map(|state| state.fov_y_rad.to_degrees());
    WIDE_COST * ramp(WIDE_DEG, widest[0].max(widest[1]))
}

/// Cost of a view from the front, where the words ask for that, that is not square to it, and the angles at which it begins and is
/// reached, degrees.
const UNSQUARE_COST: f64 = 0.9;
const UNSQUARE_DEG: (f64, f64) = (2.0, 25.0);

/// Cost of pictures that see a subject from the front only about.
fn unsquare_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if segment.is_join || segment.movement.is_circular() || !world.is_indoor() {
        return 0.0;
    }
    let ends = [states[0], states[states.len() - 1]];
    let off = |constraint: &Constraint| {
        let ConstraintKind::FromSide(target, side @ SubjectSide::FromFront) = &constraint.kind else { return 0.0 };
        let Some(square_rad) = square_azimuths(world, target, *side).first().copied() else { return 0.0 };
        let share = |state: &CameraState| {
            let azimuth = world.frame.azimuth(state.pose.position - target.center);
            let off_deg = rotation::short_turn(azimuth - square_rad).abs().to_degrees();
            ramp(UNSQUARE_DEG, off_deg)
        };
        constraint.scope.of(&ends).iter().map(share).fold(0.0, f64::max)
    };
    UNSQUARE_COST * segment.constraints.iter().map(off).fold(0.0, f64::max)
}

/// Cost of a picture in which what hangs flat on a wall is a trapezoid, and the angles between the view and the wall's normal at
/// which it begins and is reached, degrees.
const KEYSTONE_COST: f64 = 1.2;
const KEYSTONE_DEG: (f64, f64) = (1.0, 45.0);
/// Height and length of a flat upright thing over its depth.
const UPRIGHT: f64 = 3.0;

/// Cost of pictures that are about something flat on a wall and do not face it, where no words ask for a side or an angle: pictures,
/// windows and boards are seen square to their wall and from about their own height.
fn keystone_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    use ConstraintKind::{Backdrop, FromSide, Pitch, Placed};
    let is_stated =
        |constraint: &Constraint| matches!(constraint.kind, FromSide(..) | Backdrop(..) | Pitch(_) | Placed(..));
    if segment.is_join || segment.movement.is_circular() || segment.constraints.iter().any(is_stated) {
        return 0.0;
    }
    let ends = [states[0], states[states.len() - 1]];
    let off = |subject: &Subject, scope: Scope| {
        let [long, short] = subject.level_axes(world.frame.up);
        let least = UPRIGHT * short.length();
        if long.length() < least || subject.reach(world.frame.up) < least {
            return None;
        }
        let normal = world.frame.direction(wall_behind(world, subject)?);
        let off_deg = |state: &CameraState| (-state.pose.forward()).angle_between(normal).to_degrees();
        let of_ends = scope.of(&ends).iter().map(off_deg).fold(0.0, f64::max);
        // A pan from one to another stands before both rather than before either.
        Some(ramp(KEYSTONE_DEG, of_ends).powi(2))
    };
    let about =
        segment.constraints.iter().flat_map(|constraint| constraint.about().iter().map(|id| (id, constraint.scope)));
    KEYSTONE_COST * mean(about.filter_map(|(id, scope)| off(world.subject(*id)?, scope)))
}

/// Cost of a picture from straight above that shows its subject askew, and the pitch from which on a view is one, radians.
const ASKEW_COST: f64 = 0.7;
const STRAIGHT_DOWN_RAD: f64 = -1.2;
/// Length of a subject over its breadth from which on it lies along the frame's width or its height.
const OBLONG: f64 = 1.15;

/// Cost of looking straight down on an oblong thing whose sides are not those of the frame.
fn askew_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let turns = segment.movement.is_circular() || matches!(segment.movement, Move::RollCw | Move::RollCcw);
    let last = &states[states.len() - 1];
    if turns || segment.is_join || world.frame.angles(last.pose.rotation).pitch_rad > STRAIGHT_DOWN_RAD {
        return 0.0;
    }
    let askew = |constraint: &Constraint| {
        let Some(subject) = constraint.shown(world) else { return 0.0 };
        let [long, short] = subject.level_axes(world.frame.up);
        let along = world.frame.horizontal(last.pose.right()).normalize_or_zero().dot(long.normalize_or_zero()).abs();
        let off_rad = along.clamp(0.0, 1.0).acos().min(along.clamp(0.0, 1.0).asin());
        if long.length() > OBLONG * short.length() { off_rad / std::f64::consts::FRAC_PI_4 } else { 0.0 }
    };
    ASKEW_COST * segment.constraints.iter().map(askew).fold(0.0, f64::max)
}

/// Size of a subject in the frame, the larger of its shares of width and height, below which it is small in the best
/// picture of it; and what a speck costs.
const LEAST_FIT: f64 = 0.45;
const SMALL_COST: f64 = 1.1;

/// Cost of a subject that is small in every picture that is about it, where the words state no size.
fn small_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if segment.is_join {
        return 0.0;
    }
    let ends = [(Scope::Start, &states[0]), (Scope::End, &states[states.len() - 1])];
    let small = |constraint: &Constraint| {
        let ConstraintKind::Unoccluded(id, _) = constraint.kind else { return 0.0 };
        let Some(subject) = world.subject(id) else { return 0.0 };
        let about = ends.iter().filter(|(scope, _)| constraint.scope.covers(*scope));
        if about.clone().any(|(scope, _)| is_sized(&segment.constraints, id, *scope)) {
            return 0.0;
        }
        let sizes: Vec<f64> =
            about.map(|(_, state)| extent_frac(world, state, &subject.corners).max_element()).collect();
        let small = |size: f64| (1.0 - size / LEAST_FIT).max(0.0);
        let largest = small(sizes.iter().copied().fold(0.0, f64::max));
        // Around a lone thing there is nothing else to see.
        let alone = if world.is_indoor() { 0.0 } else { small(sizes.iter().copied().fold(f64::INFINITY, f64::min)) };
        largest.max(alone)
    };
    let smallest = segment.constraints.iter().map(small).fold(0.0, f64::max);
    SMALL_COST * smallest.max(loose_frac(world, segment, &states[states.len() - 1]))
}

/// Size of the splats of a subject over the frame's height at which a picture looks painted, and at which it is a
/// smear; and what that costs where the words state no size.
const SOFT_FRAC: (f64, f64) = (40.0 / 720.0, 100.0 / 720.0);
const SOFT_COST: f64 = 0.8;

/// Cost of a subject so close that the capture does not hold, where nothing asks for that.
fn soft_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let ends = [(Scope::Start, &states[0]), (Scope::End, &states[states.len() - 1])];
    let soft = |constraint: &Constraint| {
        let ConstraintKind::Unoccluded(id, _) = constraint.kind else { return 0.0 };
        let Some(subject) = world.subject(id) else { return 0.0 };
        let open = ends
            .iter()
            .filter(|(scope, _)| constraint.scope.covers(*scope) && !is_sized(&segment.constraints, id, *scope));
        let frac = |state: &CameraState| {
            let depth = state.pose.position.distance(subject.center).max(1e-9);
            subject.splat_size / (2.0 * depth * (state.fov_y_rad / 2.0).tan())
        };
        open.map(|(_, state)| ramp(SOFT_FRAC, frac(state))).fold(0.0, f64::max)
    };
    SOFT_COST * segment.constraints.iter().map(soft).fold(0.0, f64::max)
}

/// Size of what the last picture has to hold as a whole, in the frame, below which the picture is loose.
const LEAST_WHOLE: f64 = 0.55;

/// How far the last picture is from being filled by what it has to hold as a whole, 0..=1.
fn loose_frac(world: &World, segment: &MotionSegment, last: &CameraState) -> f64 {
    let sized = |constraint: &Constraint| {
        matches!(
            constraint.kind,
            ConstraintKind::Height(..) | ConstraintKind::Distance(..) | ConstraintKind::FieldOfView(_)
        )
    };
    if segment.constraints.iter().any(sized) {
        return 0.0;
    }
    let held = segment.constraints.iter().filter(|constraint| constraint.scope == Scope::End);
    let corners: Vec<DVec3> = held
        .filter_map(|constraint| match &constraint.kind {
            ConstraintKind::InFrame(ids, _) => Some(ids),
            _ => None,
        })
        .flatten()
        .filter_map(|id| world.subject(*id))
        .flat_map(|subject| subject.corners.iter().copied())
        .collect();
    if corners.is_empty() {
        return 0.0;
    }
    (1.0 - extent_frac(world, last, &corners).max_element() / LEAST_WHOLE).max(0.0)
}

/// Whether the words state how large a subject is, or what else the picture has to hold.
fn is_sized(constraints: &[Constraint], id: u32, scope: Scope) -> bool {
    let states_size = |constraint: &Constraint| match &constraint.kind {
        ConstraintKind::Height(target, _) | ConstraintKind::Distance(target, _) => target.ids.contains(&id),
        ConstraintKind::InFrame(..) | ConstraintKind::FieldOfView(_) => true,
        _ => false,
    };
    constraints.iter().any(|constraint| constraint.scope.covers(scope) && states_size(constraint))
}

/// Cost of a way to a thing that ends hardly nearer to it than it begins or farther, and the factors on the distance at which it
/// begins and is reached.
const APPROACH_COST: f64 = 1.6;
const RETREAT: (f64, f64) = (0.85, 1.3);

/// Cost of a walk to a thing that leads away from it: `stroll over to the armchair` ends at the armchair.
fn approach_cost(segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if segment.movement != Move::Follow || segment.is_join {
        return 0.0;
    }
    let sized = |constraint: &Constraint| {
        let states_size = matches!(constraint.kind, ConstraintKind::Height(..) | ConstraintKind::Distance(..));
        constraint.scope.covers(Scope::End) && states_size
    };
    let goal = segment.constraints.iter().find_map(|constraint| match &constraint.kind {
        ConstraintKind::Centered(goal, _) if constraint.scope == Scope::End => Some(goal),
        _ => None,
    });
    let Some(goal) = goal.filter(|_| !segment.constraints.iter().any(sized)) else { return 0.0 };
    let distance = |state: &CameraState| state.pose.position.distance(goal.aim).max(1e-9);
    let retreat = distance(&states[states.len() - 1]) / distance(&states[0]);
    APPROACH_COST * ((retreat / RETREAT.0).ln() / (RETREAT.1 / RETREAT.0).ln()).clamp(0.0, 1.0)
}

/// Cost of a pull-out that widens its lens because the room ends behind the camera: as one that stays in the room by
/// itself is better.
fn widened_cost(segment: &MotionSegment) -> f64 {
    let tan = |state: &CameraState| (state.fov_y_rad / 2.0).tan();
    let widened = (tan(&segment.last()) / tan(&segment.states[0])).ln();
    let is_stated =
        segment.constraints.iter().any(|constraint| matches!(constraint.kind, ConstraintKind::FieldOfView(_)));
    if !is_stated && segment.movement == Move::PullOut && widened > 0.01 { WIDENED_COST + widened } else { 0.0 }
}

/// Cost of a subject that is cut by the edge of the frame at an end for which the words state no size that cuts it.
fn cut_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if goes_along(segment) {
        return 0.0;
    }
    let middle = &states[states.len() / 2];
    let ends = [(Scope::Start, &states[0]), (Scope::All, middle), (Scope::End, &states[states.len() - 1])];
    let cut_at = |constraint: &Constraint| {
        let ConstraintKind::Unoccluded(id, _) = constraint.kind else { return 0.0 };
        let Some(subject) = world.subject(id) else { return 0.0 };
        if world.is_indoor() && subject.radius > LARGE_FRAC * world.bounds.size() {
            return 0.0;
        }
        let holds = |(scope, _): &&(Scope, &CameraState)| {
            constraint.scope.covers(*scope) && !is_to_be_cut(&segment.constraints, id, *scope)
        };
        let cut = |(_, state): &(Scope, &CameraState)| {
            let beyond = 1.0 - in_frame_frac(world, state, &subject.points, EDGE);
            CUT_COST * beyond + shaved_cost(world, state, &subject.points)
        };
        ends.iter().filter(holds).map(cut).fold(0.0, f64::max)
    };
    segment.constraints.iter().map(cut_at).fold(0.0, f64::max)
}

/// Whether a segment goes along what does not fit the picture, as rises do, and tilts that are not from one thing to another.
fn goes_along(segment: &MotionSegment) -> bool {
    let shown = |scope: Scope| {
        let covers = move |constraint: &&Constraint| constraint.scope.covers(scope);
        segment.constraints.iter().filter(covers).filter_map(Constraint::shown_id)
    };
    match segment.movement {
        Move::PedestalUp | Move::PedestalDown => true,
        Move::TiltUp | Move::TiltDown => {
            let starts: Vec<u32> = shown(Scope::Start).collect();
            starts.is_empty() || shown(Scope::End).any(|id| starts.contains(&id))
        }
        _ => false,
    }
}

/// Cost of a subject whose chin or feet the frame shaves while there is room on the other side, and the room, over the
/// frame's height, from which on it costs as much.
const SHAVED_COST: f64 = 0.8;
const SPARE_ROOM: f64 = 0.08;
/// Margin above and below a subject that leaves it untouched, over the frame's height.
const HEADROOM: f64 = 0.025;

/// Cost of a subject that touches the upper or the lower edge while it is away from the other one.
fn shaved_cost(world: &World, state: &CameraState, points: &[DVec3]) -> f64 {
    let heights = points.iter().filter_map(|&point| frame_position(world, state, point)).map(|(at, _)| at.y);
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    let (below, above) = (low + 0.5 - HEADROOM, 0.5 - HEADROOM - high);
    let (least, most) = (below.min(above), below.max(above));
    if least >= 0.0 || most <= 0.0 { 0.0 } else { SHAVED_COST * (most.min(-2.0 * least) / SPARE_ROOM).min(1.0) }
}

/// Whether the words ask for a picture that a subject does not fit in.
fn is_to_be_cut(constraints: &[Constraint], id: u32, scope: Scope) -> bool {
    let cuts = |constraint: &Constraint| match &constraint.kind {
        ConstraintKind::Height(target, (low, _)) => target.ids.contains(&id) && *low >= CUTTING_HEIGHT,
        ConstraintKind::NotWhole(ids, _) => ids.contains(&id),
        ConstraintKind::Distance(target, _) => target.ids.contains(&id),
        _ => false,
    };
    constraints.iter().any(|constraint| constraint.scope.covers(scope) && cuts(constraint))
}

/// Cost of a pan between two subjects that are in the frame together from its start to its end.
fn short_turn_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if !matches!(segment.movement, Move::PanLeft | Move::PanRight | Move::WhipPan) {
        return 0.0;
    }
    let seen_at = |wanted: Scope| {
        segment.constraints.iter().filter(|constraint| constraint.scope == wanted).find_map(Constraint::shown_id)
    };
    if seen_at(Scope::Start).is_none() || seen_at(Scope::Start) == seen_at(Scope::End) {
        return 0.0;
    }
    let (first, last) = (&states[0], &states[states.len() - 1]);
    let turn_rad = first.pose.forward().angle_between(last.pose.forward());
    let field_rad = 2.0 * ((first.fov_y_rad / 2.0).tan() * world.aspect.max(1.0)).atan();
    SHORT_TURN_COST * (1.0 - turn_rad / (LEAST_TURN * field_rad)).max(0.0)
}
