//! The stretch between two moves that flow into each other.
//!
//! Enters: the camera, its velocity and its acceleration where one move ends and where the next one begins. Leaves: a
//! quintic in time through both, so that position, rotation and lens are continuous up to the acceleration. Between a
//! move of velocity v and one of velocity w that would meet at a corner, the quintic is the classic blend of straight
//! lines: the velocity changes from v to w by 3 x^2 - 2 x^3 (Paul 1979, "Manipulator Cartesian path control", with a
//! smooth ramp).

use std::ops::{Add, Mul, Sub};

use glam::{DQuat, DVec3};

use super::CameraState;
use super::curve::STEEP_PITCH_RAD;
use cinesplat_geometry::{LevelAngles, LevelFrame, Pose, rotation};

/// Longest time step of the differences that measure velocity and acceleration at an end, and least number of steps in a
/// segment: the steepest easing doubles its speed in a tenth of it.
const STEP_SECS: f64 = 0.01;
const NUM_STEPS: f64 = 32.0;

/// The camera at three moments one step apart: at an end of a blend, and one and two steps into the neighboring move.
#[derive(Debug, Clone, Copy)]
pub(super) struct EndMotion {
    states: [CameraState; 3],
    step_secs: f64,
}

impl EndMotion {
    /// The motion at the end of a segment of a given duration. `at` gives the camera some time into the segment, counted
    /// from the end in question.
    pub(super) fn of(duration_secs: f64, at: impl Fn(f64) -> CameraState) -> Self {
        let step_secs = STEP_SECS.min(duration_secs / NUM_STEPS);
        Self { states: [0.0, 1.0, 2.0].map(|steps| at(steps * step_secs)), step_secs }
    }

    /// A camera at rest.
    pub(super) fn rest(state: CameraState) -> Self {
        Self { states: [state; 3], step_secs: STEP_SECS }
    }

    /// Value, first and second derivative by the time of a quantity of the camera; `sign` is -1 where the moments lie
    /// before the end.
    fn derivatives<V>(&self, sign: f64, of: impl Fn(&CameraState) -> V) -> [V; 3]
    where
        V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
    {
        let [a, b, c] = [of(&self.states[0]), of(&self.states[1]), of(&self.states[2])];
        let rate = (b * 4.0 - a * 3.0 - c) * (sign / (2.0 * self.step_secs));
        let acceleration = (a - b * 2.0 + c) * (1.0 / (self.step_secs * self.step_secs));
        [a, rate, acceleration]
    }
}

/// How rotations are written as three numbers.
#[derive(Debug, Clone, Copy)]
enum RotationChart {
    /// Yaw, pitch and roll: the horizon stays level between level cameras. Yaws are the shortest turn from this one.
    Level(LevelFrame, f64),
    /// Rotation vector from this rotation: for steep cameras, or where up is unknown.
    Free(DQuat),
}

impl RotationChart {
    fn new(frame: Option<LevelFrame>, ends: [&EndMotion; 2]) -> Self {
        let first = ends[0].states[0].pose.rotation;
        let level = |frame: &LevelFrame| {
            let mut states = ends.iter().flat_map(|end| &end.states);
            states.all(|s| frame.angles(s.pose.rotation).pitch_rad.abs() <= STEEP_PITCH_RAD)
        };
        match frame.filter(level) {
            Some(frame) => Self::Level(frame, frame.angles(first).yaw_rad),
            None => Self::Free(first),
        }
    }

    fn numbers(&self, rotation: DQuat) -> DVec3 {
        match self {
            Self::Level(frame, yaw_rad) => {
                let angles = frame.angles(rotation);
                DVec3::new(rotation::short_turn(angles.yaw_rad - yaw_rad), angles.pitch_rad, angles.roll_rad)
            }
            Self::Free(first) => rotation::log(first.conjugate() * rotation),
        }
    }

    fn rotation(&self, numbers: DVec3) -> DQuat {
        match self {
            Self::Level(frame, yaw_rad) => {
                frame.rotation(LevelAngles { yaw_rad: yaw_rad + numbers.x, pitch_rad: numbers.y, roll_rad: numbers.z })
            }
            Self::Free(first) => *first * rotation::exp(numbers),
        }
    }
}

/// The camera over the time of a blend.
#[derive(Debug, Clone)]
pub(super) struct Blend {
    position: Quintic<DVec3>,
    chart: RotationChart,
    turn: Quintic<DVec3>,
    log_focal: Quintic<f64>,
    focus: [Option<f64>; 2],
}

impl Blend {
    /// The blend of a given duration from the end of one move (`from`, measured backward) to the start of the next.
    pub(super) fn new(frame: Option<LevelFrame>, duration_secs: f64, from: &EndMotion, to: &EndMotion) -> Self {
        let chart = RotationChart::new(frame, [from, to]);
        let focal = |state: &CameraState| -(state.fov_y_rad / 2.0).tan().ln();
        let turn = |state: &CameraState| chart.numbers(state.pose.rotation);
        let position = |state: &CameraState| state.pose.position;
        Self {
            position: Quintic::new(duration_secs, from.derivatives(-1.0, position), to.derivatives(1.0, position)),
            turn: Quintic::new(duration_secs, from.derivatives(-1.0, turn), to.derivatives(1.0, turn)),
            log_focal: Quintic::new(duration_secs, from.derivatives(-1.0, focal), to.derivatives(1.0, focal)),
            chart,
            focus: [from.states[0].focus_distance, to.states[0].focus_distance],
        }
    }

    /// The camera after a fraction 0..=1 of the time.
    pub(super) fn at(&self, fraction: f64) -> CameraState {
        let rotation = self.chart.rotation(self.turn.at(fraction));
        let focus_distance = match self.focus {
            [Some(a), Some(b)] => Some(a + (b - a) * fraction),
            [a, b] => a.or(b),
        };
        let fov_y_rad = 2.0 * (-self.log_focal.at(fraction)).exp().atan();
        CameraState { pose: Pose { position: self.position_at(fraction), rotation }, fov_y_rad, focus_distance }
    }

    /// Position after a fraction of the time, world.
    pub(super) fn position_at(&self, fraction: f64) -> DVec3 {
        self.position.at(fraction)
    }

    /// Upper bound of the distance from `center` to any position on a range of the time: a polynomial lies in the convex
    /// hull of its Bezier points.
    pub(super) fn max_deviation(&self, range: (f64, f64), center: DVec3) -> f64 {
        self.position.part(range).0.into_iter().map(|point| point.distance(center)).fold(0.0, f64::max)
    }
}

/// A polynomial of degree 5 over 0..=1 by its Bezier values.
#[derive(Debug, Clone, Copy)]
struct Quintic<V>([V; 6]);

impl<V> Quintic<V>
where
    V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
{
    /// The polynomial with the given values, rates and accelerations at the ends of `secs`.
    fn new(secs: f64, [p, v, a]: [V; 3], [q, w, b]: [V; 3]) -> Self {
        let (fifth, twentieth) = (secs / 5.0, secs * secs / 20.0);
        Self([
            p,
            p + v * fifth,
            p + v * (2.0 * fifth) + a * twentieth,
            q - w * (2.0 * fifth) + b * twentieth,
            q - w * fifth,
            q,
        ])
    }

    fn at(&self, t: f64) -> V {
        self.split(t)[0].0[5]
    }

    /// Bezier values on a sub-interval of 0..=1.
    fn part(&self, (from, to): (f64, f64)) -> Self {
        let [head, _] = self.split(to);
        let [_, tail] = head.split(if to > 0.0 { from / to } else { 0.0 });
        tail
    }

    /// The parts before and after `t` (de Casteljau).
    fn split(&self, t: f64) -> [Self; 2] {
        let (mut row, mut head, mut tail) = (self.0, self.0, self.0);
        for level in 1..6 {
            for i in 0..6 - level {
                row[i] = row[i] * (1.0 - t) + row[i + 1] * t;
            }
            head[level] = row[0];
            tail[5 - level] = row[5 - level];
        }
        [Self(head), Self(tail)]
    }
}
