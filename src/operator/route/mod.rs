//! A way around what stands between two cameras.
//!
//! Enters: a start and a goal. Leaves: cameras whose path is proved to be clear of matter, or why there is none. The
//! straight way where that is clear; else a search on a lattice of free places (`lattice`), pulled tight, rounded and
//! pushed off the walls (`band`), and given to the path's own curve through as few keys as keep it clear. Deterministic,
//! and bounded by the number of places looked at.

mod band;
mod lattice;
mod straight;

use glam::DVec3;

use self::lattice::{Lattice, Reached};
use super::clearance::prove;
use super::draft::{Part, StepLabels, keyframes};
use super::world::World;
use cinesplat_geometry::{LevelAngles, Pose};
use cinesplat_trajectory::{CameraPath, CameraState, ClearanceProof, Easing, Keyframe, Move, retime};

/// Lattices to try: edge of a cell over the scene size, and room beyond the camera's radius over that radius. Wide ways
/// first; the last finds gaps a few percent wider than the camera.
const ATTEMPTS: [(f64, f64); 4] = [(1.0 / 36.0, 1.0), (1.0 / 72.0, 0.4), (1.0 / 144.0, 0.2), (1.0 / 144.0, 0.04)];
/// Points of the band between two keys of the path, from few keys to many.
const STRIDES: [usize; 5] = [16, 8, 4, 2, 1];

/// A proved way from one camera to another.
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// The camera at the keys, start and goal included.
    pub states: Vec<CameraState>,
    /// What was proved about the path through them.
    pub proof: ClearanceProof,
}

impl Route {
    /// Whether the way is the straight one.
    pub fn is_straight(&self) -> bool {
        self.states.len() == 2
    }

    /// Keys that fly the route in a time, from rest to rest at an even cruise.
    pub fn keyframes(&self, world: &World, secs: f64) -> Vec<Keyframe> {
        let mut keys = bare_keys(&self.states, secs);
        retime(&mut keys, Some(world.frame));
        keys
    }
}

/// Why there is no route.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoRoute {
    /// The camera does not fit where it should start.
    #[error("the camera does not fit where it starts")]
    BlockedStart,
    /// The camera does not fit where it should go.
    #[error("the camera does not fit where it goes")]
    BlockedGoal,
    /// All that can be reached from one end was seen, and the other end is not there.
    #[error("matter encloses one end: nothing as wide as the camera leads out")]
    Enclosed,
    /// Too many places to look at, or ways too narrow for a smooth path.
    #[error("no way was found within the search's bounds")]
    NotFound,
}

/// A way from `start` to `goal` that a ball of the world's camera radius can go.
///
/// # Errors
/// [`NoRoute`].
pub fn route(world: &World, start: &CameraState, goal: &CameraState) -> Result<Route, NoRoute> {
    let (from, to) = (start.pose.position, goal.pose.position);
    let radius = world.camera_radius;
    let fits = |point: DVec3| world.ellipsoids().nearest_within(point, radius).is_none();
    if !fits(from) {
        return Err(NoRoute::BlockedStart);
    }
    if !fits(to) {
        return Err(NoRoute::BlockedGoal);
    }
    let direct = proved(world, vec![*start, *goal]);
    if direct.proof.is_clear() {
        return Ok(direct);
    }
    let mut end = NoRoute::NotFound;
    for (cell_frac, room) in ATTEMPTS {
        let lattice = Lattice::new(world, (from, to), cell_frac * world.bounds.size(), radius * (1.0 + room));
        match lattice.way(from, to) {
            Reached::Way(way) => {
                if let Some(route) = smooth_route(world, (start, goal), &way, radius * (1.0 + room)) {
                    return Ok(route);
                }
            }
            Reached::Enclosed => end = NoRoute::Enclosed,
            Reached::GaveUp => end = NoRoute::NotFound,
        }
    }
    Err(end)
}

/// The way as a path through few keys that is proved to be clear; `None` where even one through all is not.
fn smooth_route(world: &World, (start, goal): (&CameraState, &CameraState), way: &[DVec3], room: f64) -> Option<Route> {
    let tight = straight::pulled_tight(world, way, room);
    let band = band::rounded(world, &tight, room);
    for stride in STRIDES {
        let inner = band.len() - 1;
        let picked: Vec<DVec3> = (0..inner).step_by(stride).chain([inner]).map(|i| band[i]).collect();
        let found = proved(world, states_along(world, (start, goal), &picked));
        if found.proof.is_clear() {
            return Some(found);
        }
    }
    None
}

/// The path through some states with what can be proved of it.
fn proved(world: &World, states: Vec<CameraState>) -> Route {
    let path = CameraPath::coarse(bare_keys(&states, states.len() as f64), world.frame);
    let proof = prove(world.ellipsoids(), &path, world.camera_radius);
    Route { states, proof }
}

fn bare_keys(states: &[CameraState], secs: f64) -> Vec<Keyframe> {
    let mut part = Part::new(0, Move::FlyThrough, states.to_vec(), secs);
    part.easing = Easing::Smooth;
    keyframes(&[part], &[StepLabels::default()])
}

/// Cameras at points along a way: yaw, pitch, roll and lens go over from start to goal with the length of the way.
pub(super) fn states_along(
    world: &World,
    (start, goal): (&CameraState, &CameraState),
    points: &[DVec3],
) -> Vec<CameraState> {
    let frame = &world.frame;
    let (a, b) = (frame.angles(start.pose.rotation), frame.angles(goal.pose.rotation));
    let short = |turn: f64| (turn + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
    let (yaw, roll) = (short(b.yaw_rad - a.yaw_rad), short(b.roll_rad - a.roll_rad));
    let total: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut covered = 0.0;
    let mut states = vec![*start];
    for (i, pair) in points.windows(2).enumerate() {
        covered += pair[0].distance(pair[1]);
        if i + 2 == points.len() {
            break;
        }
        let share = covered / total;
        let angles = LevelAngles {
            yaw_rad: a.yaw_rad + yaw * share,
            pitch_rad: a.pitch_rad + (b.pitch_rad - a.pitch_rad) * share,
            roll_rad: a.roll_rad + roll * share,
        };
        states.push(CameraState {
            pose: Pose { position: pair[1], rotation: frame.rotation(angles) },
            fov_y_rad: start.fov_y_rad + (goal.fov_y_rad - start.fov_y_rad) * share,
            focus_distance: None,
        });
    }
    states.push(*goal);
    states
}
