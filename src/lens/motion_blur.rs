//! The shutter.

use cinesplat_render::{RenderError, SplatBlur};
use cinesplat_trajectory::Move;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::seen::FrameFacts;

/// Longest exposure, frames.
const MAX_OPEN_FRAMES: f64 = 10.0;

/// Blur of what moves in the frame while the shutter is open. The exposure is centered on the time of the frame, and ends
/// at a cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionBlur {
    /// Share of the time from frame to frame that the shutter is open, as an angle of a full turn, where no keyframe says
    /// otherwise.
    pub shutter_angle_rad: f64,
    /// Time that the shutter is open, seconds, where the words state that instead of an angle.
    pub open_secs: Option<f64>,
}

impl MotionBlur {
    /// When the shutter of a moment opens and closes, seconds.
    fn shutter_secs(self, moment: &Moment<'_>) -> [f64; 2] {
        let optics = moment.take.optics;
        let open_secs = match (optics.shutter_angle_rad(moment.time_secs), self.open_secs) {
            (None, Some(open_secs)) => open_secs,
            (angle, _) => angle.unwrap_or(self.shutter_angle_rad) / std::f64::consts::TAU * moment.frame_secs(),
        };
        let half = 0.5 * open_secs.min(MAX_OPEN_FRAMES * moment.frame_secs());
        optics.uncut(moment.time_secs, [moment.time_secs - half, moment.time_secs + half])
    }
}

impl EffectKind for MotionBlur {
    const NAME: &'static str = "motion-blur";
    const SETTINGS: &'static [&'static str] = &["shutter_speed", "shutter_angle_deg"];

    fn call(calls: &Calls<'_>) -> Option<Call> {
        let of_key = || {
            let opens = |angle: Option<f64>| angle.is_some_and(|angle| angle > 0.0);
            calls.of_keyframes(Self::NAME, "shutter_angle_deg", |key| opens(key.optics.shutter_angle_rad))
        };
        calls.named(Self::NAME).cloned().or_else(of_key).or_else(|| calls.of_move(Self::NAME, Move::WhipPan))
    }

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let angle_deg = call.setting_or("shutter_angle_deg", [90.0, 180.0, 360.0]).min(3600.0);
        // `1/50` states the 50.
        let open_secs = call.setting("shutter_speed").filter(|speed| *speed > 0.0).map(f64::recip);
        (angle_deg > 0.0).then(|| Self { shutter_angle_rad: angle_deg.to_radians(), open_secs })
    }
}

impl Effect for MotionBlur {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        match self.open_secs {
            Some(open_secs) => vec![("shutter_speed", open_secs.recip())],
            None => vec![("shutter_angle_deg", self.shutter_angle_rad.to_degrees())],
        }
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("motion during the exposure", "px")
    }

    fn shares_samples(&self) -> bool {
        true
    }

    fn is_local(&self) -> bool {
        true
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let ends = self.shutter_secs(&frame.moment).map(|time_secs| frame.moment.at(time_secs).camera);
        let motion_px = frame.blur_extent(&SplatBlur { lens: None, motion: Some(ends) })?.motion_px;
        Ok(Loss { error: motion_px, allowed: budget.blur_px, samples: budget.motion_samples(motion_px) })
    }

    fn apply(&self, moment: &Moment<'_>, samples: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let shutter_secs = Some(self.shutter_secs(moment));
        let between = moment.budget.between_motion(samples);
        next(&moment.exposed(|exposing| exposing.shutter_secs = shutter_secs, (samples, between)))
    }
}
