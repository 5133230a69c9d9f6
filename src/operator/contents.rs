//! What a picture of a room without a subject shows: its things, whole or cut, and how they lie in the frame.
//!
//! A way into a room starts wide and ends anywhere. The end is a picture too: it should be about something, and neither cut
//! what it is about nor push it to a side.

use glam::DVec2;

use super::crowding::LARGE_FRAC;
use super::framing::frame_position;
use super::lookout::Thing;
use super::motion::MotionSegment;
use super::world::World;
use cinesplat_trajectory::{CameraState, Move};

/// Things of a scene from which on they tell what its pictures show: of a scan somebody names the few that matter.
const LEAST_THINGS: usize = 12;
/// Cost of a picture in which the edge cuts everything, of one whose things all lie at an edge, and of one without any.
const CUT_COST: f64 = 0.8;
const ASIDE_COST: f64 = 1.0;
const NOTHING_COST: f64 = 1.0;
/// Largest weight of one thing: its diameter over the frame's height.
const MOST_WEIGHT: f64 = 0.35;
/// Sum of the weights from which a picture shows enough.
const ENOUGH: f64 = 2.4;
/// Share of the cost that falls to the last picture.
const OF_LAST: f64 = 0.65;

/// A thing in a picture.
#[derive(Debug, Clone, Copy)]
struct Seen {
    /// Its middle from the frame's middle, over the frame's width and height; right and up positive.
    at: DVec2,
    /// Its size in the frame, limited.
    weight: f64,
    /// Share of its breadth, and of its height, in the frame.
    within: f64,
}

/// Cost of what the ends of a way through a room show, where it is about no subject.
pub(super) fn contents_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let shows = segment.constraints.iter().any(|constraint| constraint.shown(world).is_some());
    let is_told = world.is_indoor() && world.things.len() >= LEAST_THINGS;
    if shows || segment.is_join || !is_told || !is_framed(segment.movement) {
        return 0.0;
    }
    let (first, last) = (cost_of(world, &states[0]), cost_of(world, &states[states.len() - 1]));
    OF_LAST * last + (1.0 - OF_LAST) * first
}

/// Whether a move has pictures at its ends that are looked at: a turn on the spot and a circle pass over what there is.
fn is_framed(movement: Move) -> bool {
    use Move::{FlyThrough, Follow, Handheld, PullOut, PushIn, Static, TruckLeft, TruckRight, ZoomIn, ZoomOut};
    matches!(
        movement,
        Static | Handheld | PushIn | PullOut | TruckLeft | TruckRight | ZoomIn | ZoomOut | Follow | FlyThrough
    )
}

/// Cost of one picture.
fn cost_of(world: &World, state: &CameraState) -> f64 {
    let seen = seen_things(world, state);
    let total: f64 = seen.iter().map(|seen| seen.weight).sum();
    if total <= 0.0 {
        return NOTHING_COST + ASIDE_COST;
    }
    let cut = seen.iter().map(|seen| seen.weight * (1.0 - seen.within)).sum::<f64>() / total;
    let aside = (2.0 * middle(&seen)).length().min(1.0);
    CUT_COST * cut + ASIDE_COST * aside * aside + NOTHING_COST * (1.0 - total / ENOUGH).max(0.0)
}

/// Where what a picture shows lies on the whole: from the frame's middle, over its width and height; right and up positive.
/// `None` where it shows no thing, or the scene names few.
pub(super) fn middle_of_things(world: &World, state: &CameraState) -> Option<DVec2> {
    let seen = seen_things(world, state);
    (!seen.is_empty()).then(|| middle(&seen))
}

/// Mean of the places of at least one thing, by weight.
fn middle(seen: &[Seen]) -> DVec2 {
    let half = DVec2::splat(0.5);
    let total: f64 = seen.iter().map(|seen| seen.weight).sum();
    seen.iter().map(|seen| seen.at.clamp(-half, half) * seen.weight).sum::<DVec2>() / total
}

/// The things that a picture shows at least in part, and that nothing hides; none where the scene names few things.
fn seen_things(world: &World, state: &CameraState) -> Vec<Seen> {
    if world.things.len() < LEAST_THINGS {
        return Vec::new();
    }
    let tan = (state.fov_y_rad / 2.0).tan();
    let eye = state.pose.position;
    let seen = |thing: &Thing| {
        let (at, depth) = frame_position(world, state, thing.center)?;
        let half = thing.radius / (2.0 * depth * tan);
        let reach = DVec2::new(half / world.aspect, half);
        let inside = (at + reach).min(DVec2::splat(0.5)) - (at - reach).max(DVec2::splat(-0.5));
        let way = thing.center - eye;
        let length = way.length();
        let is_small = thing.radius < LARGE_FRAC * world.bounds.size() && length > thing.radius;
        if !is_small || inside.min_element() <= 0.0 {
            return None;
        }
        let hit = world.hit_distance(eye, way / length).unwrap_or(f64::INFINITY);
        let within = (inside / (2.0 * reach)).min_element().clamp(0.0, 1.0);
        let weight = (2.0 * half).min(MOST_WEIGHT);
        (hit >= length - 1.2 * thing.radius).then_some(Seen { at, weight, within })
    };
    world.things.iter().filter_map(seen).collect()
}
