//! A collision-free path between two cameras.
//!
//! Enters: a start and a goal. Leaves: cameras whose path is certified to be clear of matter, or the reason why there
//! is none. The straight path is taken where it is clear. Otherwise A* on a lattice of free points (`lattice`) finds a
//! path, which is shortened (`straight`), smoothed and pushed off the walls (`band`), and interpolated through the
//! fewest keyframes that stay clear. The search is deterministic, and the number of lattice points that it expands is
//! bounded.

mod band;
mod lattice;
mod straight;

use glam::DVec3;

use self::lattice::{Lattice, LatticePath};
use super::clearance::prove;
use super::motion::{MotionSegment, StepLabels, keyframes};
use super::world::World;
use cinesplat_geometry::{LevelAngles, Pose, rotation};
use cinesplat_trajectory::{CameraPath, CameraState, ClearanceProof, Easing, Keyframe, Move, retime};

/// Lattices to try, coarse ones first: edge of a cell over the scene size, and clearance beyond the camera's radius
/// over that radius. The last one finds gaps a few percent wider than the camera.
const ATTEMPTS: [(f64, f64); 4] = [(1.0 / 36.0, 1.0), (1.0 / 72.0, 0.4), (1.0 / 144.0, 0.2), (1.0 / 144.0, 0.04)];
/// Points of the band per keyframe of the path, from few keyframes to many.
const STRIDES: [usize; 5] = [16, 8, 4, 2, 1];

/// A path from one camera to another with its clearance certificate.
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// Camera at each keyframe, start and goal included.
    pub states: Vec<CameraState>,
    /// Certified clearance of the path through them.
    pub proof: ClearanceProof,
}

impl Route {
    /// Whether the path is the straight line.
    pub fn is_straight(&self) -> bool {
        self.states.len() == 2
    }

    /// Keyframes that travel the route in `secs` seconds, from rest to rest at constant cruising speed.
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
    /// The search explored all places that are reachable from one end; the other end is not among them.
    #[error("matter encloses one end: no gap is as wide as the camera")]
    Enclosed,
    /// The search reached its limit, or every path that it found was too narrow for a smooth curve.
    #[error("no path was found within the limits of the search")]
    NotFound,
}

/// A path from `start` to `goal` that is clear for a ball of the world's camera radius.
///
/// # Errors
/// [`NoRoute::BlockedStart`] and [`NoRoute::BlockedGoal`] where the ball does not fit at an end, [`NoRoute::Enclosed`]
/// where one end is not reachable from the other, [`NoRoute::NotFound`] where the search reaches its limit.
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
    let direct = certified(world, vec![*start, *goal]);
    if direct.proof.is_clear() {
        return Ok(direct);
    }
    let mut end = NoRoute::NotFound;
    for (cell_frac, room) in ATTEMPTS {
        let lattice = Lattice::new(world, (from, to), cell_frac * world.bounds.size(), radius * (1.0 + room));
        match lattice.path(from, to) {
            LatticePath::Found(points) => {
                if let Some(route) = smooth_route(world, (start, goal), &points, radius * (1.0 + room)) {
                    return Ok(route);
                }
            }
            LatticePath::Enclosed => end = NoRoute::Enclosed,
            LatticePath::LimitReached => end = NoRoute::NotFound,
        }
    }
    Err(end)
}

/// The path through as few points as stay certified; `None` where even the path through all of them is not clear.
fn smooth_route(
    world: &World,
    (start, goal): (&CameraState, &CameraState),
    points: &[DVec3],
    room: f64,
) -> Option<Route> {
    let tight = straight::shortened(world, points, room);
    let band = band::smoothed(world, &tight, room);
    for stride in STRIDES {
        let inner = band.len() - 1;
        let picked: Vec<DVec3> = (0..inner).step_by(stride).chain([inner]).map(|i| band[i]).collect();
        let found = certified(world, states_along(world, (start, goal), &picked));
        if found.proof.is_clear() {
            return Some(found);
        }
    }
    None
}

/// The path through camera states with its clearance certificate.
fn certified(world: &World, states: Vec<CameraState>) -> Route {
    let path = CameraPath::coarse(bare_keys(&states, states.len() as f64), world.frame);
    let proof = prove(world.ellipsoids(), &path, world.camera_radius);
    Route { states, proof }
}

fn bare_keys(states: &[CameraState], secs: f64) -> Vec<Keyframe> {
    let mut segment = MotionSegment::new(0, Move::FlyThrough, states.to_vec(), secs);
    segment.easing = Easing::Smooth;
    keyframes(&[segment], &[StepLabels::default()])
}

/// Cameras at points along a path. Yaw, pitch, roll and field of view are linear in the path length.
pub(super) fn states_along(
    world: &World,
    (start, goal): (&CameraState, &CameraState),
    points: &[DVec3],
) -> Vec<CameraState> {
    let frame = &world.frame;
    let (a, b) = (frame.angles(start.pose.rotation), frame.angles(goal.pose.rotation));
    let (yaw, roll) = (rotation::short_turn(b.yaw_rad - a.yaw_rad), rotation::short_turn(b.roll_rad - a.roll_rad));
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
