//! A picture per eye.

use std::sync::Arc;

use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::{Frame, RenderError};

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::depth_of_field::middle_depth;
use super::effect::{Effect, EffectKind, Next};
use super::eyes::EyeLayout;
use super::light::Picture;
use super::moment::Moment;
use super::seen::FrameFacts;

/// Distance between the eyes over that to the screen: the 1/30 rule of stereoscopic photography.
const EYES_FRAC: f64 = 1.0 / 30.0;

/// Two views, of cameras whose distance is that of the eyes. Their pictures agree at the distance of the screen: what is
/// nearer stands out of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stereo {
    /// How a frame holds the views.
    pub layout: EyeLayout,
    /// Distance of the screen, scene units; 0 = that of what is in the middle of the first frame.
    pub screen_distance: f64,
    /// Distance between the eyes, scene units; 0 = one thirtieth of the screen's distance.
    pub eye_distance: f64,
}

impl Stereo {
    /// The camera of an eye, -1 for the left one and 1 for the right one, with half a frame for its picture.
    fn eye(&self, camera: &Camera, side: f64) -> Camera {
        let offset = 0.5 * side * self.eye_distance;
        let mut pose = camera.pose;
        pose.position += pose.right() * offset;
        let own = camera.intrinsics;
        // Off-axis, not turned inward: nothing is seen at different heights by the eyes.
        let cx_px = own.cx_px + own.fx_px * offset / self.screen_distance;
        let intrinsics = match self.layout {
            EyeLayout::SideBySide => {
                let width = (own.width / 2).max(1);
                let part = f64::from(width) / f64::from(own.width);
                Intrinsics { width, fx_px: own.fx_px * part, cx_px: cx_px * part, ..own }
            }
            EyeLayout::OverUnder => {
                let height = (own.height / 2).max(1);
                let part = f64::from(height) / f64::from(own.height);
                Intrinsics { height, fy_px: own.fy_px * part, cy_px: own.cy_px * part, cx_px, ..own }
            }
        };
        Camera { pose, intrinsics }
    }
}

impl EffectKind for Stereo {
    const NAME: &'static str = "stereo";
    const SETTINGS: &'static [&'static str] = &["over_under", "screen_distance", "eye_distance"];
    const YIELDS_TO: &'static [(&'static str, &'static str)] = &[
        ("panorama", "an eye that looks everywhere has no right side"),
        ("fisheye", "its picture cannot be squeezed"),
    ];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let is_over_under = call.setting("over_under").is_some_and(|set| set > 0.0);
        let layout = if is_over_under { EyeLayout::OverUnder } else { EyeLayout::SideBySide };
        let distance = |name: &str| call.setting(name).unwrap_or(0.0).max(0.0);
        Some(Self { layout, screen_distance: distance("screen_distance"), eye_distance: distance("eye_distance") })
    }
}

impl Effect for Stereo {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        let is_over_under = f64::from(u8::from(self.layout == EyeLayout::OverUnder));
        vec![
            ("over_under", is_over_under),
            ("screen_distance", self.screen_distance),
            ("eye_distance", self.eye_distance),
        ]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("views that a plain picture lacks", "of 1")
    }

    fn measured(&self, first: &FrameFacts<'_>) -> Result<Option<Arc<dyn Effect>>, RenderError> {
        let mut settled = *self;
        if !(settled.screen_distance > 0.0) {
            settled.screen_distance = middle_depth(first)?.unwrap_or(1.0);
        }
        if !(settled.eye_distance > 0.0) {
            settled.eye_distance = settled.screen_distance * EYES_FRAC;
        }
        Ok(Some(Arc::new(settled)))
    }

    fn error_if_skipped(&self, _: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        Ok(Loss::of_one_sample(1.0, budget.color))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn eyes(&self) -> Option<EyeLayout> {
        Some(self.layout)
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let whole = moment.camera.intrinsics;
        let mut view = |side: f64| {
            let mut picture = next(&moment.with_camera(self.eye(&moment.camera, side)))?;
            Ok::<Frame, RenderError>(std::mem::take(picture.display()))
        };
        let [left, right] = [view(-1.0)?, view(1.0)?];
        let mut stats = left.stats;
        stats += right.stats;
        let mut frame = Frame { width: whole.width, height: whole.height, stats, ..Frame::default() };
        for row in 0..whole.height {
            match self.layout {
                EyeLayout::SideBySide => add_row(&mut frame, [(&left, row), (&right, row)]),
                EyeLayout::OverUnder if row < left.height => add_row(&mut frame, [(&left, row)]),
                // The last row of an odd height is that of the row above.
                EyeLayout::OverUnder => {
                    add_row(&mut frame, [(&right, (row - left.height).min(right.height.saturating_sub(1)))]);
                }
            }
        }
        Ok(Picture::of_display(frame))
    }
}

/// Adds a row of parts, one beside the other. An odd width repeats the last pixel.
fn add_row<const N: usize>(frame: &mut Frame, parts: [(&Frame, u32); N]) {
    let end = frame.transmittance.len() + frame.width as usize;
    for (part, row) in parts {
        let pixels = row as usize * part.width as usize..(row as usize + 1) * part.width as usize;
        frame.rgb.extend_from_slice(&part.rgb[3 * pixels.start..3 * pixels.end]);
        frame.transmittance.extend_from_slice(&part.transmittance[pixels]);
    }
    while frame.transmittance.len() < end {
        let (last, len) = (frame.transmittance.last().copied().unwrap_or(1.0), frame.rgb.len());
        frame.transmittance.push(last);
        frame.rgb.extend_from_within(len.saturating_sub(3)..len);
    }
}
