//! The geometry of a leg: position and rotation over knots, independent of time.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use super::track::{Track, sub_bezier};
use super::{Keyframe, Move};
use cinesplat_geometry::{LevelAngles, LevelFrame, Pose, rotation};

/// Beyond this pitch the yaw of a camera is ill-conditioned: rotations are interpolated as quaternions instead.
pub(super) const STEEP_PITCH_RAD: f64 = 1.48;

/// Positions over knots.
#[derive(Debug, Clone)]
pub(super) enum PositionCurve {
    /// A spline through the keys.
    Spline(Track<DVec3>),
    /// A circle about the upright axis through `pivot`, or a spiral where the keys' radii and heights differ.
    Arc { frame: LevelFrame, pivot: DVec3, azimuth: Track<f64>, radius: Track<f64>, height: Track<f64> },
}

impl PositionCurve {
    /// The arc about `pivot` through the keys, each at its knot.
    pub(super) fn arc(frame: LevelFrame, pivot: DVec3, keys: &[Keyframe], knots: &[f64]) -> Self {
        let offsets: Vec<DVec3> = keys.iter().map(|key| key.pose.position - pivot).collect();
        let raw: Vec<f64> = offsets.iter().map(|&o| frame.azimuth(o)).collect();
        let signs: Vec<f64> = keys.iter().map(arc_sign).collect();
        let azimuths = unwrapped(&raw, &signs);
        let radii: Vec<f64> = offsets.iter().map(|&o| frame.horizontal(o).length()).collect();
        let heights: Vec<f64> = offsets.iter().map(|&o| frame.height(o)).collect();
        let track = |values: &[f64]| Track::monotone(knots, values);
        Self::Arc { frame, pivot, azimuth: track(&azimuths), radius: track(&radii), height: track(&heights) }
    }

    /// Upper bound of the distance from `center`, the position in the middle of `range`, to any position on `range` of
    /// a segment's parameter, scene units.
    pub(super) fn max_deviation(&self, segment: usize, range: (f64, f64), center: DVec3) -> f64 {
        match self {
            Self::Spline(track) => {
                let hull = sub_bezier(track.bezier(segment), range);
                hull.into_iter().map(|point| point.distance(center)).fold(0.0, f64::max)
            }
            Self::Arc { frame, pivot, azimuth, radius, height } => {
                let offset = center - *pivot;
                let middle_radius = frame.horizontal(offset).length();
                let middle_azimuth = sub_bezier(azimuth.bezier(segment), (range.0, range.0.midpoint(range.1)))[3];
                let turned = range_deviation(azimuth, segment, range, middle_azimuth).min(PI);
                let widened = range_deviation(radius, segment, range, middle_radius);
                let raised = range_deviation(height, segment, range, frame.height(offset));
                // Two points at radii r and s, an angle a apart, are at most |r - s| + 2 s sin(a / 2) apart.
                (widened + 2.0 * middle_radius * (turned / 2.0).sin()).hypot(raised)
            }
        }
    }

    /// Position at a knot value.
    pub(super) fn at(&self, knot: f64) -> DVec3 {
        match self {
            Self::Spline(track) => track.at(knot),
            Self::Arc { frame, pivot, azimuth, radius, height } => {
                *pivot + frame.direction(azimuth.at(knot)) * radius.at(knot) + frame.up * height.at(knot)
            }
        }
    }
}

/// Upper bound of the difference between `middle` and a track's values on `range` of a segment's parameter.
fn range_deviation(track: &Track<f64>, segment: usize, range: (f64, f64), middle: f64) -> f64 {
    sub_bezier(track.bezier(segment), range).into_iter().map(|value| (value - middle).abs()).fold(0.0, f64::max)
}

/// Sign of the change of azimuth in an orbit or arc; 0 for every other move.
///
/// Travel to the camera's right is counter-clockwise from above and lowers the camera's azimuth about the pivot,
/// because azimuths grow clockwise.
fn arc_sign(key: &Keyframe) -> f64 {
    match key.intent.as_ref().and_then(|intent| intent.movement) {
        Some(Move::OrbitRight | Move::ArcRight) => -1.0,
        Some(Move::OrbitLeft | Move::ArcLeft) => 1.0,
        _ => 0.0,
    }
}

/// Sign of the change of yaw in a pan; 0 for every other move.
fn pan_sign(key: &Keyframe) -> f64 {
    match key.intent.as_ref().and_then(|intent| intent.movement) {
        Some(Move::PanRight) => 1.0,
        Some(Move::PanLeft) => -1.0,
        _ => 0.0,
    }
}

/// Angles without jumps of a full turn, rad.
///
/// Each step takes the shorter direction. A step above 150 degrees takes the direction `signs[i]` of its key instead,
/// where that is not 0, because both directions of a half turn are equally short.
fn unwrapped(angles: &[f64], signs: &[f64]) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::with_capacity(angles.len());
    for (i, &angle) in angles.iter().enumerate() {
        let Some(&last) = out.last() else {
            out.push(angle);
            continue;
        };
        let mut step = rotation::short_turn(angle - last);
        let sign = signs[i - 1];
        if step * sign < 0.0 && step.abs() > 150.0_f64.to_radians() {
            step += TAU * sign;
        }
        out.push(last + step);
    }
    out
}

/// Rotations (`world_from_camera`) over knots.
#[derive(Debug, Clone)]
pub(super) enum RotationCurve {
    /// Yaw, pitch and roll interpolated separately: the horizon stays level if the keys are level.
    Level { frame: LevelFrame, angles: AngleTracks },
    /// Aimed at a point from every position, plus the interpolated offsets of the keys from that aim.
    Aimed { frame: LevelFrame, target: DVec3, offsets: AngleTracks },
    /// The shortest rotation from key to key, C1 by quaternion Bezier curves (Shoemake 1985).
    Free { knots: Vec<f64>, rotations: Vec<DQuat>, rates: Vec<DVec3> },
}

/// Yaw, pitch and roll over knots.
#[derive(Debug, Clone)]
pub(super) struct AngleTracks {
    yaw: Track<f64>,
    pitch: Track<f64>,
    roll: Track<f64>,
}

impl AngleTracks {
    fn new(knots: &[f64], angles: &[LevelAngles], signs: &[f64]) -> Self {
        let column = |of: fn(&LevelAngles) -> f64, signs: &[f64]| {
            Track::monotone(knots, &unwrapped(&angles.iter().map(of).collect::<Vec<f64>>(), signs))
        };
        let free = vec![0.0; signs.len()];
        Self {
            yaw: column(|a| a.yaw_rad, signs),
            pitch: column(|a| a.pitch_rad, &free),
            roll: column(|a| a.roll_rad, &free),
        }
    }

    fn at(&self, knot: f64) -> LevelAngles {
        LevelAngles { yaw_rad: self.yaw.at(knot), pitch_rad: self.pitch.at(knot), roll_rad: self.roll.at(knot) }
    }
}

impl RotationCurve {
    /// The curve for a leg's keys: free where a key is steep or up is unknown, else aimed where there is a `target`
    /// that no key looks at steeply, else level.
    pub(super) fn new(frame: Option<LevelFrame>, target: Option<DVec3>, keys: &[Keyframe], knots: &[f64]) -> Self {
        let steep = |angles: &[LevelAngles]| angles.iter().any(|a| a.pitch_rad.abs() > STEEP_PITCH_RAD);
        let Some(frame) = frame else { return Self::free(keys, knots) };
        let angles: Vec<LevelAngles> = keys.iter().map(|key| frame.angles(key.pose.rotation)).collect();
        if steep(&angles) {
            return Self::free(keys, knots);
        }
        let signs: Vec<f64> = keys.iter().map(pan_sign).collect();
        if let Some(target) = target {
            let aims: Vec<LevelAngles> =
                keys.iter().map(|key| aim(frame, key.pose.position, target, key.pose.rotation)).collect();
            if !steep(&aims) {
                let less = |(a, b): (&LevelAngles, &LevelAngles)| LevelAngles {
                    yaw_rad: rotation::short_turn(a.yaw_rad - b.yaw_rad),
                    pitch_rad: a.pitch_rad - b.pitch_rad,
                    roll_rad: a.roll_rad - b.roll_rad,
                };
                let offsets: Vec<LevelAngles> = angles.iter().zip(&aims).map(less).collect();
                let offsets = AngleTracks::new(knots, &offsets, &vec![0.0; keys.len()]);
                return Self::Aimed { frame, target, offsets };
            }
        }
        Self::Level { frame, angles: AngleTracks::new(knots, &angles, &signs) }
    }

    fn free(keys: &[Keyframe], knots: &[f64]) -> Self {
        let rotations = rotation::aligned(&keys.iter().map(|key| key.pose.rotation).collect::<Vec<_>>());
        let step = |i: usize| knots[i + 1] - knots[i];
        let rate = |i: usize| rotation::log(rotations[i].conjugate() * rotations[i + 1]) / step(i);
        let last = rotations.len() - 1;
        let at_key = |i: usize| match i {
            _ if last == 0 => DVec3::ZERO,
            0 => rate(0),
            i if i == last => rate(last - 1),
            i => (rate(i - 1) * step(i) + rate(i) * step(i - 1)) / (step(i - 1) + step(i)),
        };
        let rates = (0..=last).map(at_key).collect();
        Self::Free { knots: knots.to_vec(), rotations, rates }
    }

    /// Rotation at a knot value between knots `segment` and `segment + 1`, where the camera is at `position`.
    pub(super) fn at(&self, segment: usize, knot: f64, position: DVec3) -> DQuat {
        match self {
            Self::Level { frame, angles } => frame.rotation(angles.at(knot)),
            Self::Aimed { frame, target, offsets } => {
                let (aim, off) = (aim(*frame, position, *target, DQuat::IDENTITY), offsets.at(knot));
                frame.rotation(LevelAngles {
                    yaw_rad: aim.yaw_rad + off.yaw_rad,
                    pitch_rad: aim.pitch_rad + off.pitch_rad,
                    roll_rad: aim.roll_rad + off.roll_rad,
                })
            }
            Self::Free { knots, rotations, rates } => quaternion_bezier(knots, rotations, rates, segment, knot),
        }
    }
}

/// Angles of a level camera at `position` that looks at `target`; those of `fallback` where the two coincide.
fn aim(frame: LevelFrame, position: DVec3, target: DVec3, fallback: DQuat) -> LevelAngles {
    Pose::look_at(position, target, frame.up, None)
        .map_or_else(|_| frame.angles(fallback), |p| frame.angles(p.rotation))
}

/// Cubic Bezier curve of quaternions (de Casteljau by slerp) with the given angular rates at the keys.
fn quaternion_bezier(knots: &[f64], rotations: &[DQuat], rates: &[DVec3], segment: usize, knot: f64) -> DQuat {
    if rotations.len() == 1 {
        return rotations[0];
    }
    let step = knots[segment + 1] - knots[segment];
    let t = ((knot - knots[segment]) / step).clamp(0.0, 1.0);
    let (q0, q3) = (rotations[segment], rotations[segment + 1]);
    let q1 = q0 * rotation::exp(rates[segment] * (step / 3.0));
    let q2 = q3 * rotation::exp(rates[segment + 1] * (-step / 3.0));
    let (a, b, c) = (rotation::slerp(q0, q1, t), rotation::slerp(q1, q2, t), rotation::slerp(q2, q3, t));
    rotation::slerp(rotation::slerp(a, b, t), rotation::slerp(b, c, t), t)
}
