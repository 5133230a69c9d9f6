//! A program as a camera operator takes it: the same steps, put so that each is filmed as its words mean it.

use cinesplat_trajectory::{Move, ShotAngle};
use glam::DVec3;

use crate::program::{Amount, Framing, Look, Motion, Pass, Program, Step, Via};
use crate::view::LYING_RADII;
use crate::world::{Subject, World};

/// The program with the move first where a step says `handheld` before it, with flights that set out from a thing at
/// that thing, with ways in through a door that nothing lies behind as ways from the door, with flights over things to
/// what the next step shows, with ways over a rug and in among things that go straight, with worm's views of low things and descents
/// to a worm's view at the floor, with tilts to what is aside as turns, and with slides from thing to thing that look where they go.
pub(super) fn as_filmed(world: &World, program: &Program) -> Program {
    let mut filmed = program.clone();
    for (nth, step) in filmed.steps.iter_mut().enumerate() {
        if let Some(next) = program.steps.get(nth + 1).filter(|next| flies_openly(step) && leads_on(next)) {
            step.end.subjects.clone_from(&next.end.subjects);
        }
        if (nth == 0 || step.cut) && enters(world, step) {
            if let Some(via) = &mut step.via {
                via.how = Pass::From;
            }
            if step.end.subjects.is_empty() {
                step.movement = Move::PushIn;
            }
        }
        if rises_above(step)
            && let Some(via) = step.via.take()
        {
            step.end.subjects = via.objects;
            step.end.angle = Some(ShotAngle::High);
        }
        if world.is_indoor() {
            cross_rugs(world, step);
            go_in_among(step);
            if sinks_to_floor(step) {
                (step.end.angle, step.end.height) = (None, Some(LYING_RADII * world.camera_radius));
            }
            creep_along_floor(world, step);
            stay_above_tables(world, step);
        } else {
            circle_lone_thing(step);
        }
        let before = program.steps[..nth].iter().rev().find_map(|before| before.end.subjects.first());
        if turns_aside(world, before.copied(), step) {
            (step.movement, step.either_way) = (Move::PanRight, true);
        }
        if sways_first(step) {
            // The sway takes its time from the move.
            step.movement = step.with.remove(0);
            step.with.push(Move::Handheld);
        }
        if slides_between(step) {
            step.via = step.via.take().filter(|via| via.how != Pass::Along);
            let looks_back = matches!(&step.look, Some(Look::At(ids)) if *ids == step.start.subjects);
            step.look = step.look.take().filter(|_| !looks_back);
        }
        if (nth == 0 || step.cut) && departs(step) {
            let objects = std::mem::take(&mut step.start.subjects);
            step.via = Some(Via { how: Pass::From, objects });
        }
    }
    filmed
}

/// Whether a step begins with the picture that the step before leaves, and leads to another one.
fn leads_on(step: &Step) -> bool {
    !step.cut && step.start == Framing::default() && !step.end.subjects.is_empty()
}

/// Whether a step flies over or between things and names nothing beyond them: `drift over the fruit and set down by the
/// teapot` looks at the teapot as soon as the fruit is passed.
fn flies_openly(step: &Step) -> bool {
    let passes = step.via.as_ref().is_some_and(|via| matches!(via.how, Pass::Over | Pass::Between));
    step.movement == Move::FlyThrough && passes && step.end == Framing::default() && step.look.is_none()
}

/// Whether a step rises from one thing to above others: `boom up from the lamp to above the bookcases` ends on those.
fn rises_above(step: &Step) -> bool {
    let over = step.via.as_ref().is_some_and(|via| via.how == Pass::Over && via.objects != step.start.subjects);
    step.movement == Move::CraneUp && over && !step.start.subjects.is_empty() && step.end == Framing::default()
}

/// Starts a circle around what stands on a table, and would begin below the table top, just above that instead.
fn stay_above_tables(world: &World, step: &mut Step) {
    let circles = step.movement.is_circular() || step.with.iter().any(|second| second.is_circular());
    let is_short = matches!(step.amount, Some(Amount::Degrees(degrees)) if degrees < SHORT_ARC_DEG);
    let subject = step.start.subjects.first().or(step.end.subjects.first()).and_then(|id| world.subject(*id));
    let Some(subject) = subject.filter(|subject| circles && !is_short && subject.bearer.is_some()) else { return };
    let foot = subject.center - world.frame.up * subject.reach(world.frame.up);
    let height = world.height_above_floor(foot) + ABOVE_TABLE_RADII * world.camera_radius;
    for framing in [&mut step.start, &mut step.end] {
        let is_low = matches!(framing.angle, Some(ShotAngle::Low | ShotAngle::Worm));
        if is_low && framing.height.is_none() && framing.elevation_deg.is_none() {
            (framing.angle, framing.height) = (None, Some(height));
        }
    }
}

/// Angle of a circle up to which it may stay before the edge of a table, degrees, and height of a camera above a table top, over
/// its radius.
const SHORT_ARC_DEG: f64 = 100.0;
const ABOVE_TABLE_RADII: f64 = 1.6;

/// Circles a lone thing where a step rises or sinks `while turning`: beside it there is nothing to turn to.
fn circle_lone_thing(step: &mut Step) {
    let rises = Motion::of(step.movement) == Some(Motion::Rise);
    let shows = !step.start.subjects.is_empty() || !step.end.subjects.is_empty();
    for second in step.with.iter_mut().filter(|_| rises && shows) {
        // A camera that goes round to its left turns to the right.
        *second = match *second {
            Move::PanRight => Move::ArcLeft,
            Move::PanLeft => Move::ArcRight,
            other => other,
        };
    }
}

/// Distance apart from which on two things of a room do not stand one above the other, and that of a camera to the nearer one
/// of them, over its radius.
const APART_RADII: f64 = 12.0;
const SEEN_RADII: f64 = 9.0;

/// Whether a tilt leads from one thing to another one that no camera of the room sees above or below it.
fn turns_aside(world: &World, before: Option<u32>, step: &Step) -> bool {
    let tilts = matches!(step.movement, Move::TiltUp | Move::TiltDown) && step.with.is_empty() && step.via.is_none();
    let shown = step.start.subjects.first().copied().or(before);
    let pair = shown.zip(step.end.subjects.first().copied()).filter(|(from, to)| from != to);
    let Some((from, to)) = pair.filter(|_| tilts && world.is_indoor()) else { return false };
    let Some((from, to)) = world.subject(from).zip(world.subject(to)) else { return false };
    let across = world.frame.horizontal(to.center - from.center);
    let way = across.normalize_or_zero();
    let stands = |subject: &Subject, out: DVec3| {
        let point = subject.center + out * (subject.reach(out) + SEEN_RADII * world.camera_radius);
        let level = world.frame.up * (world.eye_height() - world.height_above_floor(point));
        world.in_capture_region(point + level) && world.beyond_corner_frac(point + level) <= 0.0
    };
    across.length() > APART_RADII * world.camera_radius && !stands(from, -way) && !stands(to, way)
}

/// Height up to which what lies on the floor is flat, over the camera's radius.
const FLAT_RADII: f64 = 1.0;

/// Goes its own way to what stands on a rug or behind it, where the words only say that the way leads over the rug.
fn cross_rugs(world: &World, step: &mut Step) {
    let leads = matches!(step.movement, Move::PushIn | Move::Follow | Move::PullOut) && !step.end.subjects.is_empty();
    let is_rug = |id: &u32| {
        world.subject(*id).is_some_and(|thing| world.top_above_floor(thing) < FLAT_RADII * world.camera_radius)
    };
    let over = step.via.as_ref().filter(|via| matches!(via.how, Pass::Over | Pass::Along));
    if leads && over.is_some_and(|via| via.objects.iter().all(is_rug) && via.objects != step.end.subjects) {
        step.via = None;
    }
}

/// Goes its own way to a thing among several others, as a vase `between the chairs`: there is no gate that they all make.
fn go_in_among(step: &mut Step) {
    let is_way = matches!(step.movement, Move::PushIn | Move::Follow) && !step.end.subjects.is_empty();
    let is_among = |via: &Via| via.how == Pass::Between && via.objects.len() > 2;
    step.via = step.via.take().filter(|via| !(is_way && is_among(via)));
}

/// Height of a camera that creeps along a floor, over its radius.
const CREEPING_RADII: f64 = 2.0;

/// Takes a worm's view of a way in or out for one from the floor, where the subject is lower than a person's eyes: only what is higher
/// is seen steeply from below.
fn creep_along_floor(world: &World, step: &mut Step) {
    let travels = matches!(step.movement, Move::PushIn | Move::Follow | Move::PullOut) && step.via.is_none();
    let is_low = |id: &u32| world.subject(*id).is_some_and(|thing| world.top_above_floor(thing) < world.eye_height());
    let subjects = if step.end.subjects.is_empty() { &step.start.subjects } else { &step.end.subjects };
    if !travels || subjects.is_empty() || !subjects.iter().all(is_low) {
        return;
    }
    let is_worm = |framing: &Framing| framing.angle == Some(ShotAngle::Worm) && framing.elevation_deg.is_none();
    if is_worm(&step.start) || is_worm(&step.end) {
        for framing in [&mut step.start, &mut step.end] {
            framing.angle = framing.angle.filter(|angle| *angle != ShotAngle::Worm);
            framing.height = framing.height.or(Some(CREEPING_RADII * world.camera_radius));
        }
    }
}

/// Whether a step sinks to where a worm looks from, which in a room is its floor, whatever the elevation there.
fn sinks_to_floor(step: &Step) -> bool {
    let sinks = matches!(step.movement, Move::CraneDown | Move::PedestalDown);
    let is_free = step.end.height.is_none() && step.end.elevation_deg.is_none() && step.amount.is_none();
    sinks && is_free && step.end.angle == Some(ShotAngle::Worm)
}

/// Distance before and behind a door at which a camera would stand, over its radius.
const BESIDE_DOOR: f64 = 4.0;

/// Whether a step comes in through a door behind which nothing was captured.
fn enters(world: &World, step: &Step) -> bool {
    let through = |via: &&Via| matches!(via.how, Pass::Through | Pass::Between) && via.objects.len() == 1;
    let goes = matches!(step.movement, Move::FlyThrough | Move::PushIn | Move::Follow);
    let Some(via) = step.via.as_ref().filter(through).filter(|_| goes && world.is_indoor()) else { return false };
    let Some(door) = world.subject(via.objects[0]) else { return false };
    let [_, short] = door.level_axes(world.frame.up);
    let out = short.normalize_or_zero();
    let stands = |way: DVec3| {
        let point = door.center + way * (door.reach(way) + BESIDE_DOOR * world.camera_radius);
        world.in_capture_region(point) && world.sees_front_faces(point) && world.beyond_corner_frac(point) <= 0.0
    };
    !(stands(out) && stands(-out))
}

/// Whether a step says `handheld` before its move. A whip pan and a reveal, whose first further move is their
/// direction, and a view over a shoulder stay.
fn sways_first(step: &Step) -> bool {
    let leads = |movement: &Move| !matches!(movement, Move::WhipPan | Move::Reveal | Move::Static | Move::Handheld);
    let passes = step.via.as_ref().is_some_and(|via| via.how == Pass::Past);
    step.movement == Move::Handheld && step.with.first().is_some_and(leads) && !passes
}

/// Whether a step slides from one thing to another: what it goes along on the way (`along the shelves from the mug to
/// the plates`) is told by both, and a look at the first one would keep it from the second.
fn slides_between(step: &Step) -> bool {
    let [start, end] = [&step.start.subjects, &step.end.subjects];
    matches!(step.movement, Move::TruckLeft | Move::TruckRight) && !start.is_empty() && !end.is_empty() && start != end
}

/// Whether a step flies or walks from one thing to another: `walk from the door to the windows` begins at the door and
/// looks ahead. A stated picture of the first thing is a picture to open on.
fn departs(step: &Step) -> bool {
    let [start, end] = [&step.start, &step.end];
    let is_place = *start == Framing { subjects: start.subjects.clone(), ..Framing::default() };
    let goes = start.subjects.len() == 1 && !end.subjects.is_empty() && start.subjects != end.subjects;
    step.movement == Move::FlyThrough && step.via.is_none() && is_place && goes
}
