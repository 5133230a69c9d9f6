//! Rows of a picture that are exposed one after another.

use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::{Frame, RenderError};

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::seen::FrameFacts;

/// A sensor that is read from the first row to the last: each row shows the camera at its own time.
///
/// The frame is made of strips, each with the camera of the time of its middle row. Their number keeps the steps
/// between two strips below the budget of the quality.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingShutter {
    /// Time from the first row to the last over the time of a frame, where no time in seconds is stated.
    pub readout: f64,
    /// The stated time from the first row to the last.
    pub readout_secs: Option<f64>,
}

impl RollingShutter {
    /// Time from the first row of a frame to the last; a frame is read before the next one begins.
    fn readout_secs_of(self, moment: &Moment<'_>) -> f64 {
        self.readout_secs.unwrap_or(self.readout * moment.frame_secs()).min(moment.frame_secs())
    }

    /// When the first row and the last of a moment are exposed, seconds; both on the moment's side of a cut.
    fn read_secs(self, moment: &Moment<'_>) -> [f64; 2] {
        let half = 0.5 * self.readout_secs_of(moment);
        moment.take.optics.uncut(moment.time_secs, [moment.time_secs - half, moment.time_secs + half])
    }
}

impl EffectKind for RollingShutter {
    const NAME: &'static str = "rolling-shutter";
    const SETTINGS: &'static [&'static str] = &["readout", "readout_ms"];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let readout = call.setting_or("readout", [0.35, 0.7, 1.0]).clamp(0.0, 1.0);
        let readout_secs = call.setting("readout_ms").map(|millis| 1e-3 * millis);
        (readout_secs.unwrap_or(readout) > 0.0).then_some(Self { readout, readout_secs })
    }
}

impl Effect for RollingShutter {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        match self.readout_secs {
            Some(secs) => vec![("readout_ms", 1e3 * secs)],
            None => vec![("readout", self.readout)],
        }
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("skew from the first row to the last", "px")
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let [from, to] = self.read_secs(&frame.moment);
        let skew_px = frame.travel_px(from, to)?;
        let rows = frame.moment.camera.intrinsics.height;
        let strips = (skew_px / budget.blur_px).ceil().clamp(1.0, f64::from(rows)) as u32;
        Ok(Loss { error: skew_px, allowed: budget.shift_px, samples: strips })
    }

    fn num_pictures(&self, _: u32) -> u32 {
        // The strips are parts of one picture.
        1
    }

    fn apply(&self, moment: &Moment<'_>, samples: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let whole = moment.camera.intrinsics;
        let mut frame = Frame { width: whole.width, height: whole.height, ..Frame::default() };
        let strips = samples.clamp(1, whole.height);
        let [from, to] = self.read_secs(moment);
        for strip in 0..strips {
            let [first, end] =
                [strip, strip + 1].map(|strip| (u64::from(whole.height) * u64::from(strip) / u64::from(strips)) as u32);
            let middle = 0.5 * (f64::from(first) + f64::from(end)) / f64::from(whole.height) - 0.5;
            let read = moment.time_secs + middle * self.readout_secs_of(moment);
            let then = moment.at(read.clamp(from, to));
            let own = then.camera.intrinsics;
            let intrinsics = Intrinsics { height: end - first, cy_px: own.cy_px - f64::from(first), ..own };
            let mut picture = next(&then.with_camera(Camera { intrinsics, ..then.camera }))?;
            let rows = picture.display();
            frame.rgb.append(&mut rows.rgb);
            frame.transmittance.append(&mut rows.transmittance);
        }
        Ok(Picture::of_display(frame))
    }
}
