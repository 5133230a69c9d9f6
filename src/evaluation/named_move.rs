//! Recognition of the camera move that a whole path makes, independent of scale.
//!
//! A path is classified by whether its position changes, whether its rotation changes, and whether its focal length
//! changes. If position and rotation change and all view axes pass near one point, the move is an arc about that point
//! (an orbit from half a turn on) or, if it is mainly vertical, a crane. The thresholds are chosen by this project.

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::Trajectory;
use cinesplat_geometry::{LevelAngles, LevelFrame, rotation};
use cinesplat_trajectory::Move;

/// Smallest rotation that counts, rad (1 degree).
const TURN_RAD: f64 = 0.0175;
/// Smallest factor of the focal length that counts as a zoom.
const ZOOM_FACTOR: f64 = 1.02;
/// Fraction of a displacement or rotation that lies along its main axis in a pure move.
const PURITY: f64 = 0.8;
/// Largest distance of the common point from a view axis, over its depth.
const AIM_TOLERANCE: f64 = 0.1;
/// Largest ratio of the radii of an arc.
const RADIUS_FACTOR: f64 = 1.15;
/// Smallest fraction of a crane's displacement that is vertical.
const RISE_FRAC: f64 = 0.7;
/// Smallest angle of an orbit, rad; below it the move is an arc.
const ORBIT_RAD: f64 = std::f64::consts::PI;

/// A recognized move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NamedMove {
    /// The move.
    pub name: Move,
    /// Extent: rad for pans, tilts, rolls, arcs and orbits; the factor of the focal length for zooms; scene units for
    /// the rest.
    pub amount: f64,
}

/// The move from the first pose of a path to its last; `None` for a compound move.
///
/// Travel up to `still_distance`, in scene units, counts as none. A thousandth of the scene's size suits recorded
/// paths, 0 suits exact ones.
pub fn name_move(path: &Trajectory, still_distance: f64) -> Option<NamedMove> {
    let level = LevelFrame::new(path.up_or_mean()).ok()?;
    let angles = total_angles(path, &level)?;
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

/// One of two opposite moves, by the sign of the amount.
fn signed(amount: f64, positive: Move, negative: Move) -> NamedMove {
    named(if amount > 0.0 { positive } else { negative }, amount.abs())
}

/// Last focal length over the first; 1 if unknown.
pub(super) fn zoom_factor(path: &Trajectory) -> f64 {
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

/// Sums of the changes of yaw, pitch and roll from pose to pose, so that full turns are not lost.
fn total_angles(path: &Trajectory, level: &LevelFrame) -> Option<LevelAngles> {
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
    dominant(candidates)
}

/// The candidate of the largest magnitude, if it is at least [`PURITY`] of the whole.
fn dominant(candidates: [(f64, Move, Move); 3]) -> Option<NamedMove> {
    let whole = candidates.iter().map(|(amount, ..)| amount * amount).sum::<f64>().sqrt();
    let main = candidates.into_iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    (main.0.abs() >= PURITY * whole).then(|| signed(main.0, main.1, main.2))
}

/// The move of a displacement without rotation: `moved_camera` in the first camera's axes, `rise` along the world's up.
fn travelling(moved_camera: DVec3, rise: f64, zoom: f64) -> Option<NamedMove> {
    let upward = (rise, Move::PedestalUp, Move::PedestalDown);
    let found = dominant([
        (moved_camera.x, Move::TruckRight, Move::TruckLeft),
        upward,
        (moved_camera.z, Move::PushIn, Move::PullOut),
    ])?;
    // A dolly zoom widens the field of view on the way in, or narrows it on the way out. Beside other moves a zoom is
    // one of its own, which has no name here.
    Some(match found.name {
        Move::PushIn if zoom < 1.0 / ZOOM_FACTOR => named(Move::DollyZoomIn, found.amount),
        Move::PullOut if zoom > ZOOM_FACTOR => named(Move::DollyZoomOut, found.amount),
        _ => found,
    })
}

/// The point with the least sum of squared distances to all view axes; `None` for parallel axes.
pub(super) fn aimed_at(path: &Trajectory) -> Option<DVec3> {
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

/// The extent of a move over a path whose middle makes it. At its ends another move may flow in.
pub(super) fn extent(path: &Trajectory, name: Move) -> Option<f64> {
    let level = LevelFrame::new(path.up_or_mean()).ok()?;
    let angles = total_angles(path, &level)?;
    let moved = *path.positions.last()? - *path.positions.first()?;
    Some(match name {
        Move::PanLeft | Move::PanRight => angles.yaw_rad.abs(),
        Move::TiltUp | Move::TiltDown => angles.pitch_rad.abs(),
        Move::RollCw | Move::RollCcw => angles.roll_rad.abs(),
        Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown => level.height(moved).abs(),
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => {
            swept_rad(path, &level, aimed_at(path)?).abs()
        }
        Move::ZoomIn | Move::ZoomOut => zoom_factor(path),
        Move::Static => 0.0,
        _ => moved.length(),
    })
}

/// A path unrolled from the upright cylinder about the point that it aims at: how far to the operator's right, and how
/// high, each pose is, in scene units. `None` without a common aim.
pub(super) fn unrolled(path: &Trajectory) -> Option<Vec<DVec2>> {
    let level = LevelFrame::new(path.up_or_mean()).ok()?;
    let center = aimed_at(path)?;
    let radii = path.positions.iter().map(|p| level.horizontal(*p - center).length());
    let radius = radii.sum::<f64>() / path.len() as f64;
    let azimuths = unwrapped(path.positions.iter().map(|p| level.azimuth(*p - center)));
    let place = |(p, azimuth): (&DVec3, f64)| DVec2::new(-radius * azimuth, level.height(*p));
    Some(path.positions.iter().zip(azimuths).map(place).collect())
}

/// Angles without jumps by full turns.
pub(super) fn unwrapped(angles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    for angle in angles {
        let last = found.last().copied().unwrap_or(angle);
        found.push(last + rotation::short_turn(angle - last));
    }
    found
}

/// The angle that a path sweeps about an upright axis through a point, positive to the operator's right.
fn swept_rad(path: &Trajectory, level: &LevelFrame, center: DVec3) -> f64 {
    let azimuths: Vec<f64> = path.positions.iter().map(|p| level.azimuth(*p - center)).collect();
    let wrapped = |pair: &[f64]| (pair[1] - pair[0]).sin().atan2((pair[1] - pair[0]).cos());
    // Azimuths grow clockwise seen from above, which is travel to the operator's left about a point ahead.
    -azimuths.windows(2).map(wrapped).sum::<f64>()
}

/// The move of a path whose position and rotation change: an arc, an orbit or a crane.
fn circling(path: &Trajectory, level: &LevelFrame) -> Option<NamedMove> {
    let center = aimed_at(path)?;
    let ahead = |idx: usize| path.rotations[idx].transpose() * (center - path.positions[idx]);
    let aims = (0..path.len()).all(|idx| {
        let seen = ahead(idx);
        seen.z > 0.0 && seen.truncate().length() <= AIM_TOLERANCE * seen.z
    });
    let moved = path.positions.last()?.distance(*path.positions.first()?);
    let rise = level.height(*path.positions.last()? - *path.positions.first()?);
    if aims && rise.abs() > RISE_FRAC * moved && moved > 0.0 {
        return Some(signed(rise, Move::CraneUp, Move::CraneDown));
    }
    let radii = path.positions.iter().map(|p| level.horizontal(*p - center).length());
    let (near, far) = radii.fold((f64::INFINITY, 0.0_f64), |(near, far), r| (near.min(r), far.max(r)));
    if !aims || far > RADIUS_FACTOR * near {
        return None;
    }
    let swept = swept_rad(path, level, center);
    if swept.abs() >= ORBIT_RAD {
        return Some(signed(swept, Move::OrbitRight, Move::OrbitLeft));
    }
    Some(signed(swept, Move::ArcRight, Move::ArcLeft))
}
