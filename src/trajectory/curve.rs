//! The geometry of a leg: where the camera goes and how it turns, without regard to time.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use super::stray::sub_bezier;
use super::track::Track;
use super::{Keyframe, Move};
use cinesplat_geometry::{LevelAngles, LevelFrame, Pose, rotation};

/// Beyond this pitch the heading of a camera means too little to interpolate yaw, pitch and roll one by one.
const STEEP_PITCH_RAD: f64 = 1.48;

/// Positions over knots.
#[derive(Debug, Clone)]
pub(super) enum PositionCurve {
    /// Through the keys.
    Spline(Track<DVec3>),
    /// A circle about an upright axis, or a spiral where the keys' radii and heights differ.
    Arc { frame: LevelFrame, pivot: DVec3, azimuth: Track<f64>, radius: Track<f64>, height: Track<f64> },
}

impl PositionCurve {
    /// A true arc about `pivot` through the keys, at knots.
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

    /// Bound of the distance between `center`, the position half way, and any position on `range` of a segment's knots.
    pub(super) fn stray(&self, segment: usize, range: (f64, f64), center: DVec3) -> f64 {
        match self {
            Self::Spline(track) => {
                let hull = sub_bezier(track.bezier(segment), range);
                hull.into_iter().map(|point| point.distance(center)).fold(0.0, f64::max)
            }
            Self::Arc { frame, pivot, azimuth, radius, height } => {
                let offset = center - *pivot;
                let middle_radius = frame.horizontal(offset).length();
                let middle_azimuth = sub_bezier(azimuth.bezier(segment), (range.0, range.0.midpoint(range.1)))[3];
                let turned = spread(azimuth, segment, range, middle_azimuth).min(PI);
                let widened = spread(radius, segment, range, middle_radius);
                let raised = spread(height, segment, range, frame.height(offset));
                // A point at radius r, turned by a from another at radius s, is at most |r - s| + 2 s sin(a / 2) from it.
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

/// How far a track gets from `middle` on `range` of a segment's knots, at most.
fn spread(track: &Track<f64>, segment: usize, range: (f64, f64), middle: f64) -> f64 {
    sub_bezier(track.bezier(segment), range).into_iter().map(|value| (value - middle).abs()).fold(0.0, f64::max)
}

/// Sign of the change of azimuth that an orbit asks for: travel to the camera's right lowers the azimuth of the camera
/// as seen from the pivot (counter-clockwise from above; azimuths grow clockwise). 0 without an opinion.
fn arc_sign(key: &Keyframe) -> f64 {
    match key.intent.as_ref().and_then(|intent| intent.movement) {
        Some(Move::OrbitRight | Move::ArcRight) => -1.0,
        Some(Move::OrbitLeft | Move::ArcLeft) => 1.0,
        _ => 0.0,
    }
}

/// Sign of the change of yaw that a pan asks for; 0 without an opinion.
fn pan_sign(key: &Keyframe) -> f64 {
    match key.intent.as_ref().and_then(|intent| intent.movement) {
        Some(Move::PanRight) => 1.0,
        Some(Move::PanLeft) => -1.0,
        _ => 0.0,
    }
}

/// Angles without jumps. Each step goes the short way, except steps of over 150 degrees whose key asks for a
/// direction (`signs[i]` is that of the step from `i` to `i + 1`): half turns have no short way.
fn unwrapped(angles: &[f64], signs: &[f64]) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::with_capacity(angles.len());
    for (i, &angle) in angles.iter().enumerate() {
        let Some(&last) = out.last() else {
            out.push(angle);
            continue;
        };
        let mut step = (angle - last + PI).rem_euclid(TAU) - PI;
        let sign = signs[i - 1];
        if step * sign < 0.0 && step.abs() > 150.0_f64.to_radians() {
            step += TAU * sign;
        }
        out.push(last + step);
    }
    out
}

/// Rotations over knots.
#[derive(Debug, Clone)]
pub(super) enum TurnCurve {
    /// Yaw, pitch and roll one by one: the horizon stays as level as the keys are.
    Level { frame: LevelFrame, angles: AngleTracks },
    /// Aimed at a point on the way, with the keys' departures from that aim interpolated.
    Aimed { frame: LevelFrame, target: DVec3, departures: AngleTracks },
    /// The short way from key to key, C1 by quaternion Bezier curves (Shoemake 1985).
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

impl TurnCurve {
    /// The curve for a leg's keys: aimed where all keys name one `target` and none is steep, else level, else free.
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
                    yaw_rad: (a.yaw_rad - b.yaw_rad + PI).rem_euclid(TAU) - PI,
                    pitch_rad: a.pitch_rad - b.pitch_rad,
                    roll_rad: a.roll_rad - b.roll_rad,
                };
                let departures: Vec<LevelAngles> = angles.iter().zip(&aims).map(less).collect();
                let departures = AngleTracks::new(knots, &departures, &vec![0.0; keys.len()]);
                return Self::Aimed { frame, target, departures };
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

    /// Rotation at a knot value between knots `segment` and `segment + 1`, at a position on the way.
    pub(super) fn at(&self, segment: usize, knot: f64, position: DVec3) -> DQuat {
        match self {
            Self::Level { frame, angles } => frame.rotation(angles.at(knot)),
            Self::Aimed { frame, target, departures } => {
                let (aim, off) = (aim(*frame, position, *target, DQuat::IDENTITY), departures.at(knot));
                frame.rotation(LevelAngles {
                    yaw_rad: aim.yaw_rad + off.yaw_rad,
                    pitch_rad: aim.pitch_rad + off.pitch_rad,
                    roll_rad: aim.roll_rad + off.roll_rad,
                })
            }
            Self::Free { knots, rotations, rates } => bezier(knots, rotations, rates, segment, knot),
        }
    }
}

/// Angles of a level camera at `position` that looks at `target`; those of `spare` where the two coincide.
fn aim(frame: LevelFrame, position: DVec3, target: DVec3, spare: DQuat) -> LevelAngles {
    Pose::look_at(position, target, frame.up, None).map_or_else(|_| frame.angles(spare), |p| frame.angles(p.rotation))
}

fn bezier(knots: &[f64], rotations: &[DQuat], rates: &[DVec3], segment: usize, knot: f64) -> DQuat {
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
