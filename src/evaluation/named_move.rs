//! The name of the move that a whole path makes, free of scale.
//!
//! A path is sorted by what it does: stands or travels, turns or not, zooms or not. A path that travels and turns with all
//! view axes through nearly one point circles it (an arc, an orbit from half a turn on) or rises past it (a crane).

use glam::{DMat3, DQuat, DVec3};

use super::Trajectory;
use cinesplat_geometry::{LevelAngles, LevelFrame};
use cinesplat_trajectory::Move;

/// Turns below are none, rad (1 degree).
const TURN_RAD: f64 = 0.0175;
/// Changes of focal length below this factor are no zoom.
const ZOOM_FACTOR: f64 = 1.02;
/// Share of a displacement or turn that its main axis must carry for a name.
const PURITY: f64 = 0.8;
/// Largest distance of a view axis from the common point, over the distance to that point.
const AIM_TOLERANCE: f64 = 0.1;
/// Largest change of the distance to the common point for a circle, as a factor.
const RADIUS_FACTOR: f64 = 1.15;
/// Share of the displacement that is height in a crane.
const RISE_SHARE: f64 = 0.7;
/// Angle from which an arc is called an orbit, rad.
const ORBIT_RAD: f64 = std::f64::consts::PI;

/// What a path was recognized as.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NamedMove {
    /// Its name.
    pub name: Move,
    /// How far: rad for turns and arcs, a factor for zooms, scene units else.
    pub amount: f64,
}

/// The move that the path makes from its first pose to its last; `None` for compound ones.
///
/// `still_distance` is the travel that counts as none, scene units: a thousandth of the scene's size, or 0 for paths
/// that are exact.
pub fn name_move(path: &Trajectory, still_distance: f64) -> Option<NamedMove> {
    let level = LevelFrame::new(path.up_or_mean()).ok()?;
    let angles = turned(path, &level)?;
    let (first, last) = (*path.positions.first()?, *path.positions.last()?);
    let extent = path.positions.iter().map(|p| p.distance(first)).fold(0.0, f64::max);
    let rounding = 1e-9 * path.positions.iter().map(|p| p.length()).fold(0.0, f64::max);
    let travels = extent > still_distance.max(rounding);
    let turns = angles.yaw_rad.abs().max(angles.pitch_rad.abs()).max(angles.roll_rad.abs()) > TURN_RAD;
    let zoom = zoom_factor(path);
    match (travels, turns) {
        (false, false) => Some(standing(zoom)),
        (false, true) => turning(angles),
        (true, false) => travelling(path.rotations[0].transpose() * (last - first), level.height(last - first), zoom),
        (true, true) => circling(path, &level),
    }
}

fn named(name: Move, amount: f64) -> NamedMove {
    NamedMove { name, amount }
}

/// Picks one of two opposite moves by the sign.
fn signed(amount: f64, positive: Move, negative: Move) -> NamedMove {
    named(if amount > 0.0 { positive } else { negative }, amount.abs())
}

fn zoom_factor(path: &Trajectory) -> f64 {
    let focal = |fov: Option<&Option<f64>>| fov.copied().flatten().map(|fov| 1.0 / (fov / 2.0).tan());
    focal(path.fov_y_rad.last()).zip(focal(path.fov_y_rad.first())).map_or(1.0, |(last, first)| last / first)
}

fn standing(zoom: f64) -> NamedMove {
    if zoom > ZOOM_FACTOR {
        named(Move::ZoomIn, zoom)
    } else if zoom < 1.0 / ZOOM_FACTOR {
        named(Move::ZoomOut, zoom)
    } else {
        named(Move::Static, 0.0)
    }
}

/// Sums of the changes of yaw, pitch and roll, so that a full turn counts as one.
fn turned(path: &Trajectory, level: &LevelFrame) -> Option<LevelAngles> {
    let angles = path.rotations.iter().map(|rotation| level.angles(DQuat::from_mat3(rotation).normalize()));
    let angles: Vec<LevelAngles> = angles.collect();
    let change = |of: fn(&LevelAngles) -> f64| {
        let wrapped = |pair: &[LevelAngles]| {
            let (sin, cos) = (of(&pair[1]) - of(&pair[0])).sin_cos();
            sin.atan2(cos)
        };
        angles.windows(2).map(wrapped).sum::<f64>()
    };
    angles.first()?;
    Some(LevelAngles {
        yaw_rad: change(|a| a.yaw_rad),
        pitch_rad: change(|a| a.pitch_rad),
        roll_rad: change(|a| a.roll_rad),
    })
}

fn turning(angles: LevelAngles) -> Option<NamedMove> {
    let candidates = [
        (angles.yaw_rad, Move::PanRight, Move::PanLeft),
        (angles.pitch_rad, Move::TiltUp, Move::TiltDown),
        (angles.roll_rad, Move::RollCw, Move::RollCcw),
    ];
    main_of(candidates)
}

/// The candidate of the largest magnitude, if it carries enough of the whole.
fn main_of(candidates: [(f64, Move, Move); 3]) -> Option<NamedMove> {
    let whole = candidates.iter().map(|(amount, ..)| amount * amount).sum::<f64>().sqrt();
    let main = candidates.into_iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    (main.0.abs() >= PURITY * whole).then(|| signed(main.0, main.1, main.2))
}

/// Names a displacement without a turn: in the first camera's axes, height along the world's up.
fn travelling(moved_camera: DVec3, rise: f64, zoom: f64) -> Option<NamedMove> {
    let upward = (rise, Move::PedestalUp, Move::PedestalDown);
    let found = main_of([
        (moved_camera.x, Move::TruckRight, Move::TruckLeft),
        upward,
        (moved_camera.z, Move::PushIn, Move::PullOut),
    ])?;
    // Toward the subject with a widening lens, or away with a narrowing one.
    match found.name {
        Move::PushIn if zoom < 1.0 / ZOOM_FACTOR => Some(named(Move::DollyZoomIn, found.amount)),
        Move::PullOut if zoom > ZOOM_FACTOR => Some(named(Move::DollyZoomOut, found.amount)),
        _ => (zoom < ZOOM_FACTOR && zoom > 1.0 / ZOOM_FACTOR).then_some(found),
    }
}

/// The point nearest to all view axes, in the least squares sense; `None` for parallel ones.
fn aimed_at(path: &Trajectory) -> Option<DVec3> {
    let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
    for (position, rotation) in path.positions.iter().zip(&path.rotations) {
        let axis = rotation.z_axis;
        let across = DMat3::IDENTITY - DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z);
        matrix += across;
        right += across * *position;
    }
    let count = path.len() as f64;
    (matrix.determinant().abs() > 1e-9 * count.powi(3)).then(|| matrix.inverse() * right)
}

fn circling(path: &Trajectory, level: &LevelFrame) -> Option<NamedMove> {
    let center = aimed_at(path)?;
    let ahead = |idx: usize| path.rotations[idx].transpose() * (center - path.positions[idx]);
    let aims = (0..path.len()).all(|idx| {
        let seen = ahead(idx);
        seen.z > 0.0 && seen.truncate().length() <= AIM_TOLERANCE * seen.z
    });
    let moved = path.positions.last()?.distance(*path.positions.first()?);
    let rise = level.height(*path.positions.last()? - *path.positions.first()?);
    if aims && rise.abs() > RISE_SHARE * moved && moved > 0.0 {
        return Some(signed(rise, Move::CraneUp, Move::CraneDown));
    }
    let radii = path.positions.iter().map(|p| level.horizontal(*p - center).length());
    let (near, far) = radii.fold((f64::INFINITY, 0.0_f64), |(near, far), r| (near.min(r), far.max(r)));
    if !aims || far > RADIUS_FACTOR * near {
        return None;
    }
    let azimuths: Vec<f64> = path.positions.iter().map(|p| level.azimuth(*p - center)).collect();
    let wrapped = |pair: &[f64]| (pair[1] - pair[0]).sin().atan2((pair[1] - pair[0]).cos());
    // Azimuths grow clockwise seen from above, which is travel to the operator's left around a point ahead.
    let swept = -azimuths.windows(2).map(wrapped).sum::<f64>();
    if swept.abs() >= ORBIT_RAD {
        return Some(signed(swept, Move::OrbitRight, Move::OrbitLeft));
    }
    Some(signed(swept, Move::ArcRight, Move::ArcLeft))
}
