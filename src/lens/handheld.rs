//! The hand that holds the camera.

use cinesplat_geometry::{Camera, Pose, rotation};
use cinesplat_render::RenderError;
use cinesplat_trajectory::Move;
use glam::DVec3;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind};
use super::light::mixed;
use super::seen::FrameFacts;

/// Layers of the noise: rate in values per second and share of the amplitude. Slow sway of the body, steps and
/// breathing, tremor of the hands.
const LAYERS: [(f64, f64); 3] = [(0.9, 1.0), (2.6, 0.35), (7.0, 0.09)];
/// The angles of a lens with this field of view; a longer lens is heavier and is held more steadily.
const FOV_Y_RAD: f64 = 0.87;
/// Amplitude of the roll over that of pan and tilt, and of the motion along the view over that across it.
const ROLL: f64 = 0.5;

/// Unsteady motion of a hand-held camera: smooth noise of three rates on all six axes.
///
/// The motion is a function of seed and time alone. It is a sum of cubic curves through hashed values: at most
/// [`Effect::reach`] from the path, with continuous speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Handheld {
    /// Amplitude of pan and tilt for a normal lens, radians.
    pub turn_rad: f64,
    /// Amplitude of the displacement, scene units.
    pub shift: f64,
    /// Seed of the motion.
    pub seed: u32,
}

impl Handheld {
    /// Smooth noise of an axis at a time, about -1..1.
    fn noise(&self, axis: u64, time_secs: f64) -> f64 {
        let layer = |(idx, (rate, share)): (usize, &(f64, f64))| {
            let key = mixed(u64::from(self.seed), axis * LAYERS.len() as u64 + idx as u64);
            share * curve(key, time_secs * rate)
        };
        LAYERS.iter().enumerate().map(layer).sum()
    }
}

impl EffectKind for Handheld {
    const NAME: &'static str = "handheld";
    const SETTINGS: &'static [&'static str] = &["turn_deg", "shift", "seed"];

    fn call(calls: &Calls<'_>) -> Option<Call> {
        calls.named(Self::NAME).cloned().or_else(|| calls.of_move(Self::NAME, Move::Handheld))
    }

    fn called_for(call: &Call, calls: &Calls<'_>) -> Option<Self> {
        let turn_deg = call.setting_or("turn_deg", [0.15, 0.35, 0.9]).clamp(0.0, 20.0);
        let shift = call.setting("shift").unwrap_or(calls.scene_size * call.degree.of([3e-4, 8e-4, 2e-3])).max(0.0);
        let seed = call.setting("seed").map_or(calls.seed as u32, |seed| seed as u32);
        (turn_deg > 0.0 || shift > 0.0).then_some(Self { turn_rad: turn_deg.to_radians(), shift, seed })
    }
}

impl Effect for Handheld {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("turn_deg", self.turn_rad.to_degrees()), ("shift", self.shift), ("seed", f64::from(self.seed))]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("displacement of the middle of the picture", "px")
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let intrinsics = frame.moment.camera.intrinsics;
        // The largest one of the whole motion: a hand that rests for a frame still holds the camera.
        let turn_px = self.turn_rad * steadiness(intrinsics.fov_y_rad()) * intrinsics.fy_px;
        let nearest = frame.moment.render.near.max(f64::MIN_POSITIVE);
        let shift_px = if self.shift > 0.0 { self.shift / (self.shift + nearest) * intrinsics.fy_px } else { 0.0 };
        Ok(Loss::of_one_sample(turn_px + shift_px, budget.shift_px))
    }

    fn moved(&self, camera: Camera, time_secs: f64) -> Camera {
        let [x, y, z, pan, tilt, roll] = [0, 1, 2, 3, 4, 5].map(|axis| self.noise(axis, time_secs));
        let Pose { position, rotation } = camera.pose;
        let turn = self.turn_rad * steadiness(camera.intrinsics.fov_y_rad());
        let shift = DVec3::new(x, y, ROLL * z) * self.shift;
        let twist = DVec3::new(tilt, pan, ROLL * roll) * turn;
        let pose = Pose::new(position + rotation * shift, rotation * rotation::exp(twist));
        Camera { pose, ..camera }
    }

    fn reach(&self) -> f64 {
        // Each axis stays within the sum of its layers, times the overshoot of a cubic curve.
        let layers: f64 = LAYERS.iter().map(|(_, share)| share).sum();
        1.25 * layers * self.shift * (2.0 + ROLL * ROLL).sqrt()
    }

    fn develops(&self) -> bool {
        false
    }
}

/// Amplitude of the turns for a field of view: with the square root of the picture's extent, between a fixed angle and a
/// fixed number of pixels.
fn steadiness(fov_y_rad: f64) -> f64 {
    ((fov_y_rad / 2.0).tan() / (FOV_Y_RAD / 2.0).tan()).sqrt()
}

/// A Catmull-Rom curve through one hashed value in -1..1 per unit of `at`.
fn curve(key: u64, at: f64) -> f64 {
    let cell = at.floor();
    let t = at - cell;
    let value = |offset: f64| {
        let counter = (cell + offset) as i64 as u64;
        (mixed(key, counter) >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    let [a, b, c, d] = [-1.0, 0.0, 1.0, 2.0].map(value);
    b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
}
