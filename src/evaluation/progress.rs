//! Whether a camera makes a move in one direction. A name depends on the first and the last pose alone: without this a
//! push in and back out again, or a truck to the right and back, would be whatever is left over.

use glam::{DQuat, DVec3};

use super::Trajectory;
use super::named_move::{aimed_at, unrolled, unwrapped};
use cinesplat_geometry::{LevelAngles, LevelFrame};
use cinesplat_trajectory::Move;

/// Largest way back, over the whole way.
const BACK_FRAC: f64 = 0.08;
/// Largest distance of a straight way, or of one on a cylinder that is unrolled, from its line, over its length.
const STRAY_FRAC: f64 = 0.12;
/// Largest distance from its place of a camera that stands, in distances that count as none.
const STANDING_DISTANCES: f64 = 3.0;
/// Largest turn of a camera that holds, rad.
const HELD_RAD: f64 = 0.035;

/// Whether a path makes a move without turning back on the way, and without going elsewhere and back.
/// `still_distance` is the travel that counts as none.
pub(super) fn is_one_way(path: &Trajectory, name: Move, still_distance: f64) -> bool {
    if strays(path, name, still_distance) {
        return false;
    }
    let Some(series) = progress(path, name) else { return false };
    let (Some(first), Some(last)) = (series.first(), series.last()) else { return true };
    if name == Move::Static {
        return series.iter().all(|turned| turned.abs() <= HELD_RAD);
    }
    let way = last - first;
    let ahead = series.iter().map(|at| (at - first) * way.signum());
    let (mut farthest, mut back) = (0.0_f64, 0.0_f64);
    for at in ahead {
        farthest = farthest.max(at);
        back = back.max(farthest - at);
    }
    back <= BACK_FRAC * way.abs()
}

/// Whether a camera that stands in a move leaves its place, one that travels straight leaves its line, or one that circles
/// rises before or after it instead of all along.
fn strays(path: &Trajectory, name: Move, still_distance: f64) -> bool {
    use Move as M;
    let Some((first, last)) = path.positions.first().zip(path.positions.last()) else { return false };
    let farthest = |off: &dyn Fn(DVec3) -> f64| path.positions.iter().map(|p| off(*p - *first)).fold(0.0, f64::max);
    match name {
        M::Static
        | M::PanLeft
        | M::PanRight
        | M::TiltUp
        | M::TiltDown
        | M::RollCw
        | M::RollCcw
        | M::ZoomIn
        | M::ZoomOut => farthest(&|moved| moved.length()) > STANDING_DISTANCES * still_distance + 1e-9,
        M::PushIn | M::PullOut | M::TruckLeft | M::TruckRight | M::PedestalUp | M::PedestalDown => {
            let way = *last - *first;
            let along = way.normalize_or_zero();
            farthest(&|moved| moved.reject_from_normalized(along).length()) > STRAY_FRAC * way.length()
        }
        _ => stray_share(path, name) > 1.0,
    }
}

/// How far a path that circles strays from an even rise, over what is allowed; 0 for other moves.
pub(super) fn stray_share(path: &Trajectory, name: Move) -> f64 {
    use Move as M;
    let circles = matches!(name, M::ArcLeft | M::ArcRight | M::OrbitLeft | M::OrbitRight | M::CraneUp | M::CraneDown);
    if circles { circle_stray(path) / STRAY_FRAC } else { 0.0 }
}

/// Largest distance of an unrolled path from the line between its ends, over the length of that line.
fn circle_stray(path: &Trajectory) -> f64 {
    let places = unrolled(path).unwrap_or_default();
    let Some((first, last)) = places.first().zip(places.last()) else { return 0.0 };
    let way = *last - *first;
    let along = way.normalize_or_zero();
    let farthest = places.iter().map(|place| (*place - *first).perp_dot(along).abs()).fold(0.0, f64::max);
    if way.length() > 0.0 { farthest / way.length() } else { 0.0 }
}

/// How far a move has come at each pose: an angle, a distance, or a logarithm.
fn progress(path: &Trajectory, name: Move) -> Option<Vec<f64>> {
    let level = LevelFrame::new(path.up_or_mean()).ok()?;
    Some(match name {
        Move::PanLeft | Move::PanRight => turned(path, &level, |a| a.yaw_rad),
        Move::TiltUp | Move::TiltDown => turned(path, &level, |a| a.pitch_rad),
        Move::RollCw | Move::RollCcw => turned(path, &level, |a| a.roll_rad),
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => {
            let center = aimed_at(path)?;
            unwrapped(path.positions.iter().map(|p| level.azimuth(*p - center)))
        }
        Move::ZoomIn | Move::ZoomOut => {
            let focal = |fov: &Option<f64>| fov.map_or(0.0, |fov| -(fov / 2.0).tan().ln());
            path.fov_y_rad.iter().map(focal).collect()
        }
        Move::Static => {
            let first = DQuat::from_mat3(path.rotations.first()?);
            path.rotations.iter().map(|rotation| first.angle_between(DQuat::from_mat3(rotation))).collect()
        }
        _ => {
            let (first, last) = (*path.positions.first()?, *path.positions.last()?);
            let along = (last - first).try_normalize()?;
            path.positions.iter().map(|p| (*p - first).dot(along)).collect()
        }
    })
}

fn turned(path: &Trajectory, level: &LevelFrame, of: fn(&LevelAngles) -> f64) -> Vec<f64> {
    unwrapped(path.rotations.iter().map(|rotation| of(&level.angles(DQuat::from_mat3(rotation).normalize()))))
}
