//! The extent of a further move at the same time as a step's main move.

use glam::DVec3;

use super::world::World;
use cinesplat_geometry::rotation;
use cinesplat_trajectory::{CameraState, Move};

/// Least turn or roll, degrees.
const LEAST_DEG: f64 = 4.0;
/// Least change of a distance, of a focal length, or of a position over the distance to the subject.
const LEAST_FRAC: f64 = 0.05;

/// How far a film carries out a further move, between its first and last camera, and the least extent that counts.
///
/// - pans, tilts, rolls: change of yaw, pitch, roll in that direction, degrees;
/// - orbits and arcs: change of the azimuth about the subject in that direction, degrees;
/// - pedestals and cranes: rise or fall over the distance to the subject at the start;
/// - trucks: travel to that side of the first camera, over that distance;
/// - push-in, pull-out and dolly zooms: change of the distance in that direction, over the distance at the start;
/// - zooms: change of the tangent of half the field of view in that direction, over that at the start.
pub(super) fn extent(world: &World, movement: Move, point: DVec3, states: &[CameraState]) -> (f64, f64) {
    let (first, last) = (&states[0], &states[states.len() - 1]);
    let frame = &world.frame;
    let angles = |s: &CameraState| frame.angles(s.pose.rotation);
    let (a, b) = (angles(first), angles(last));
    let yaw = || rotation::short_turn(b.yaw_rad - a.yaw_rad).to_degrees();
    let pitch = || (b.pitch_rad - a.pitch_rad).to_degrees();
    let roll = || rotation::short_turn(b.roll_rad - a.roll_rad).to_degrees();
    let azimuth = |s: &CameraState| frame.azimuth(s.pose.position - point);
    let swing = || rotation::short_turn(azimuth(last) - azimuth(first)).to_degrees();
    let distance = first.pose.position.distance(point).max(1e-9);
    let way = (last.pose.position - first.pose.position) / distance;
    let nearer = 1.0 - last.pose.position.distance(point) / distance;
    let narrower = 1.0 - (last.fov_y_rad / 2.0).tan() / (first.fov_y_rad / 2.0).tan();
    match movement {
        Move::PanRight => (yaw(), LEAST_DEG),
        Move::PanLeft => (-yaw(), LEAST_DEG),
        Move::TiltUp => (pitch(), LEAST_DEG),
        Move::TiltDown => (-pitch(), LEAST_DEG),
        Move::RollCw => (roll(), LEAST_DEG),
        Move::RollCcw => (-roll(), LEAST_DEG),
        Move::OrbitLeft | Move::ArcLeft => (swing(), LEAST_DEG),
        Move::OrbitRight | Move::ArcRight => (-swing(), LEAST_DEG),
        Move::PedestalUp | Move::CraneUp => (frame.height(way), LEAST_FRAC),
        Move::PedestalDown | Move::CraneDown => (-frame.height(way), LEAST_FRAC),
        Move::TruckRight => (way.dot(first.pose.right()), LEAST_FRAC),
        Move::TruckLeft => (-way.dot(first.pose.right()), LEAST_FRAC),
        Move::PushIn | Move::DollyZoomIn => (nearer, LEAST_FRAC),
        Move::PullOut | Move::DollyZoomOut => (-nearer, LEAST_FRAC),
        Move::ZoomIn => (narrower, LEAST_FRAC),
        Move::ZoomOut => (-narrower, LEAST_FRAC),
        Move::Static
        | Move::Handheld
        | Move::Follow
        | Move::FlyThrough
        | Move::Reveal
        | Move::WhipPan
        | Move::RackFocus => (0.0, f64::NEG_INFINITY),
    }
}

/// The quantity of [`extent`] in words.
pub(super) fn extent_words(movement: Move) -> String {
    let (what, least) = match movement {
        Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown | Move::RollCw | Move::RollCcw => {
            ("turn in degrees", LEAST_DEG)
        }
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => {
            ("angle about the subject in degrees", LEAST_DEG)
        }
        Move::ZoomIn | Move::ZoomOut => ("change of the field of view over itself", LEAST_FRAC),
        _ => ("travel over the distance to the subject", LEAST_FRAC),
    };
    format!("{what} at least {least}")
}
