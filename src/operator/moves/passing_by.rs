//! Ways that lead past things to their goal: `let the armchairs slip by and come to rest on the fire`.
//!
//! What is passed is seen on the way, and the camera goes by it: beside one thing, between or beside several.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext};
use super::paths::{arriving, end_view};
use crate::constraint::{ConstraintKind, Scope};
use crate::framing::Target;
use crate::motion::MotionSegment;
use crate::program::{Pass, Step};
use crate::view::{aimed, lerp, moved};
use crate::world::Subject;
use cinesplat_geometry::Pose;
use cinesplat_trajectory::{CameraState, Move};

/// Height of the camera beside what it passes, over that of a standing person's eyes.
const HEIGHT: (f64, f64) = (0.55, 1.0);
/// Room between a thing and the camera beside it, over the camera's radius.
const BESIDE_RADII: (f64, f64) = (2.5, 9.0);
/// Where the camera goes between several things, over their distance aside from their middle.
const AMONG: (f64, f64) = (-1.3, 1.3);
/// Where the way begins before the things, over the height of a person's eyes; in a scene without rooms over their size.
const BEFORE: (f64, f64) = (0.3, 2.4);
/// Share of the way from the things to the goal at which the first camera is aimed.
const FIRST_AIM: f64 = 0.55;
/// Largest distance over the first at which the way ends.
const NEARER: f64 = 0.75;

/// The things that a way passes on its way to something else; empty for every other step.
pub(super) fn passed_by(step: &Step) -> &[u32] {
    let travels = matches!(step.movement, Move::Follow | Move::FlyThrough) && !step.end.subjects.is_empty();
    match &step.via {
        Some(via) if travels && via.how == Pass::Past => {
            let is_goal = via.objects.iter().any(|id| step.end.subjects.contains(id));
            if is_goal { &[] } else { &via.objects }
        }
        _ => &[],
    }
}

/// The way by the things to a view of the end target; `None` for a step that passes none.
pub(super) fn passing_by(context: &StepContext) -> Option<Vec<MotionSegment>> {
    let world = context.world;
    let end = context.end.as_ref()?;
    let things: Vec<&Subject> = passed_by(context.step).iter().filter_map(|&id| world.subject(id)).collect();
    let middle = middle(&things)?;
    let gate = gate(context, (&things, middle), end)?;
    let first = match &context.before {
        Some(before) => *before,
        None if context.start.is_some() => {
            context.view(&context.opening_target(), &context.opening_framing(), (0.4, 0.7), NORMAL_LENS_DEG)
        }
        None => before_things(context, (&things, middle), gate, end),
    };
    let beside = aimed(world, &moved(&first, gate - first.pose.position), end.aim);
    let last = end_view(context, end, &beside);
    let mut segment = context.segment(vec![first, beside, last]);
    if context.step.amount.is_none() {
        segment = segment.requiring(Scope::All, ConstraintKind::DistanceRatio(end.aim, (0.0, NEARER)));
    }
    Some(vec![arriving(context, segment, context.start.as_ref(), end)])
}

/// Middle of some things; `None` without things.
fn middle(things: &[&Subject]) -> Option<DVec3> {
    let sum: DVec3 = things.iter().map(|thing| thing.center).sum();
    (!things.is_empty()).then(|| sum / things.len() as f64)
}

/// The point beside one thing, on either hand, or among several, by which the way leads. Parameter 0 chooses it, and 1 its height.
fn gate(context: &StepContext, (things, middle): (&[&Subject], DVec3), end: &Target) -> Option<DVec3> {
    let (world, parameters) = (context.world, context.parameters);
    let frame = &world.frame;
    let way = frame.horizontal(end.aim - middle).try_normalize()?;
    let aside = way.cross(frame.up);
    let off = if let [thing] = things {
        let (sign, share) =
            if parameters[0] < 0.5 { (-1.0, 2.0 * parameters[0]) } else { (1.0, 2.0 * parameters[0] - 1.0) };
        sign * (thing.reach(aside) + lerp(BESIDE_RADII, share) * world.camera_radius)
    } else {
        let apart = things.iter().map(|thing| (thing.center - middle).dot(aside).abs()).fold(0.0, f64::max);
        lerp(AMONG, parameters[0]) * (apart + 4.0 * world.camera_radius)
    };
    let height = lerp(HEIGHT, parameters[1]) * world.eye_height() - world.height_above_floor(middle);
    Some(middle + aside * off + frame.up * height)
}

/// A camera before the things, on the line from the goal through the gate, that sees both.
fn before_things(
    context: &StepContext,
    (things, middle): (&[&Subject], DVec3),
    gate: DVec3,
    end: &Target,
) -> CameraState {
    let (world, parameters) = (context.world, context.parameters);
    let way = world.frame.horizontal(end.aim - gate).normalize_or_zero();
    let deepest = things.iter().map(|thing| (middle - thing.center).dot(way) + thing.reach(way)).fold(0.0, f64::max);
    let size = things.iter().map(|thing| thing.radius).fold(0.0, f64::max);
    let unit = if world.is_indoor() { world.eye_height() } else { 1.5 * size };
    let position = gate - way * (deepest + lerp(BEFORE, parameters[2]) * unit);
    let fov_y_rad = lerp(NORMAL_LENS_DEG, parameters[3]).to_radians();
    let pose = Pose { position, rotation: glam::DQuat::IDENTITY };
    aimed(world, &CameraState { pose, fov_y_rad, focus_distance: None }, middle.lerp(end.aim, FIRST_AIM))
}
