//! The aperture.

use std::sync::Arc;

use cinesplat_geometry::Camera;
use cinesplat_render::{RenderError, SplatBlur, ThinLens};
use cinesplat_trajectory::Move;
use glam::{DVec2, DVec3};

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::optics::Aperture;
use super::seen::FrameFacts;

/// Names of the settings of [`Focus::Point`].
const POINT_SETTINGS: [&str; 4] = ["focus_x", "focus_y", "focus_z", "focus_nearer"];
/// Share of the frame, about its middle, that the camera focuses on where nothing else is said.
const MIDDLE: f64 = 0.2;

/// Diameter of the circle of confusion at twice the focus distance, over the frame's height, for words of each degree.
const BLUR_BY_DEGREE: [f64; 3] = [0.008, 0.018, 0.04];
/// Largest circle infinitely far away where the aperture is chosen for two subjects, over the frame's height: two subjects
/// at nearly the same depth would dissolve everything else.
const MOST_BLUR: f64 = 0.16;

/// What the lens is focused on, where no keyframe has a focus distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Focus {
    /// What is in the middle of the first frame.
    Middle,
    /// A point of the scene, less a distance toward the camera: the middle of a subject, and how much nearer its surface
    /// is.
    Point {
        /// The point, world.
        point: DVec3,
        /// Distance from it toward the camera, scene units.
        nearer: f64,
    },
}

/// How a reason ends that says what was chosen: see [`without_choice`].
const CHOICE_END: &str = " px infinitely far away";

/// How wide the aperture is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Opening {
    /// As keyframes say: nothing is chosen.
    OfKeyframes,
    /// Focal length over diameter, on a sensor of [`super::SENSOR_M`].
    FStop(f64),
    /// The f-stop that gives circles of this diameter, pixels, infinitely far away in the first frame.
    Chosen {
        /// Focal length over diameter.
        f_stop: f64,
        /// The diameter.
        circle_px: f64,
    },
    /// Diameter of the circle of confusion at twice the focus distance of the first frame, as a fraction of the frame's
    /// height: what words such as `shallow` promise, on a lens of any angle and in a scene of any size.
    BackgroundBlur(f64),
}

/// Blur of what is nearer or farther than the focus distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthOfField {
    opening: Opening,
    /// Meters per scene unit.
    pub meters_per_unit: f64,
    /// What the lens is focused on.
    pub focus: Focus,
}

impl DepthOfField {
    /// The depth of field that a call asks for; `None` for a closed aperture. Where the call states no blur, it is that of
    /// the call's degree.
    pub(super) fn of_call(call: &Call, blur_by_degree: [f64; 3]) -> Option<Self> {
        let opening = match call.setting("f_stop") {
            Some(f_stop) => Opening::FStop(f_stop),
            None => Opening::BackgroundBlur(call.setting_or("background_blur", blur_by_degree).min(1.0)),
        };
        let is_open = matches!(opening, Opening::FStop(amount) | Opening::BackgroundBlur(amount) if amount > 0.0);
        let focus = match POINT_SETTINGS.map(|name| call.setting(name)) {
            [Some(x), Some(y), Some(z), nearer] => {
                Focus::Point { point: DVec3::new(x, y, z), nearer: nearer.unwrap_or(0.0) }
            }
            _ => Focus::Middle,
        };
        let meters_per_unit = call.setting("meters_per_unit").filter(|scale| *scale > 0.0).unwrap_or(1.0);
        is_open.then_some(Self { opening, meters_per_unit, focus })
    }

    /// The focus distance of a moment, scene units; `None` if it is not known.
    fn focus_distance(&self, moment: &Moment<'_>) -> Option<f64> {
        let of_point = || match self.focus {
            Focus::Middle => None,
            Focus::Point { point, nearer } => {
                // Behind the camera there is no focus.
                let depth = (moment.take.camera_at)(moment.time_secs).pose.to_camera(point).z - nearer;
                Some(depth.max(moment.render.near.max(1e-6)))
            }
        };
        moment.take.optics.focus_distance(moment.time_secs).or_else(of_point)
    }

    /// The lens of a moment; `None` if its focus or its aperture is not known.
    fn lens(&self, moment: &Moment<'_>) -> Option<ThinLens> {
        let f_stop = moment.take.optics.f_stop(moment.time_secs).or(match self.opening {
            Opening::FStop(f_stop) | Opening::Chosen { f_stop, .. } => Some(f_stop),
            Opening::OfKeyframes | Opening::BackgroundBlur(_) => None,
        })?;
        let aperture = Aperture { f_stop, meters_per_unit: self.meters_per_unit };
        let Camera { intrinsics, .. } = (moment.take.camera_at)(moment.time_secs);
        Some(aperture.lens(&intrinsics, self.focus_distance(moment)?))
    }

    /// The effect as a focus puller needs it: the blur that the words promise is that of the subject which is not in
    /// focus. Unchanged where the keyframes have no two focus distances.
    pub(super) fn opened_between(&self, first: &FrameFacts<'_>) -> Self {
        let Opening::BackgroundBlur(frac) = self.opening else { return *self };
        if is_stated(first) {
            return *self;
        }
        let Some([near, far]) = first.moment.take.optics.focus_range().filter(|[near, far]| near < far) else {
            return *self;
        };
        let Camera { intrinsics, .. } = first.moment.camera;
        let unit = Aperture { f_stop: 1.0, meters_per_unit: self.meters_per_unit }.lens(&intrinsics, near);
        let of_unit = |depth: f64| unit.circle_px(intrinsics.fx_px, depth);
        let height_px = f64::from(intrinsics.height);
        let f_stop = (of_unit(far) / (frac * height_px)).max(of_unit(f64::INFINITY) / (MOST_BLUR * height_px));
        let circle_px = of_unit(f64::INFINITY) / f_stop;
        Self { opening: Opening::Chosen { f_stop, circle_px }, ..*self }
    }

    /// The effect with a focus and an f-stop.
    pub(super) fn settled(&self, first: &FrameFacts<'_>) -> Result<Self, RenderError> {
        let mut settled = *self;
        if is_stated(first) {
            settled.opening = Opening::OfKeyframes;
        }
        if self.focus_distance(&first.moment).is_none() {
            let Camera { pose, .. } = first.moment.camera;
            let distance = middle_depth(first)?.unwrap_or(f64::MAX.sqrt());
            settled.focus = Focus::Point { point: pose.position + pose.forward() * distance, nearer: 0.0 };
        }
        if let (Opening::BackgroundBlur(frac), Some(focus)) = (settled.opening, settled.focus_distance(&first.moment)) {
            let Camera { intrinsics, .. } = first.moment.camera;
            // At twice the focus distance the circle has half the diameter of one at infinity.
            let circle_px = 2.0 * frac * f64::from(intrinsics.height);
            let unit = Aperture { f_stop: 1.0, meters_per_unit: self.meters_per_unit }.lens(&intrinsics, focus);
            let f_stop = unit.circle_px(intrinsics.fx_px, f64::INFINITY) / circle_px;
            // In a scene of any size, whose lens may be one that nobody could build. What is infinitely far away has no
            // circle if the lens is focused there.
            settled.opening =
                if f_stop > 0.0 { Opening::Chosen { f_stop, circle_px } } else { Opening::FStop(f64::INFINITY) };
        }
        Ok(settled)
    }
}

/// Whether keyframes say how wide the aperture is.
fn is_stated(first: &FrameFacts<'_>) -> bool {
    first.moment.take.optics.f_stop(first.moment.time_secs).is_some()
}

/// A call without what an earlier plan chose for it, where keyframes now say how wide the aperture is.
fn without_choice(call: Call, calls: &Calls<'_>) -> Call {
    let has_choice =
        call.because.ends_with(CHOICE_END) && calls.keyframes.iter().any(|key| key.optics.f_stop.is_some());
    let words = call.because.rsplit_once(": f/").filter(|_| has_choice).map(|(words, _)| words.to_owned());
    Call { because: words.unwrap_or_else(|| call.because.clone()), ..call }
}

/// Median depth of the middle of a frame; of the whole frame, if there is nothing in the middle. `None` for an empty one.
pub(super) fn middle_depth(frame: &FrameFacts<'_>) -> Result<Option<f64>, RenderError> {
    let size = frame.moment.camera.intrinsics;
    let half = DVec2::new(f64::from(size.width), f64::from(size.height)) / 2.0;
    let seen = frame.seen()?;
    let is_middle = |position_px: DVec2| ((position_px - half) / half).abs().max_element() <= MIDDLE;
    let mut depths: Vec<f64> =
        seen.iter().filter(|point| is_middle(point.position_px)).map(|point| point.depth).collect();
    if depths.is_empty() {
        depths = seen.iter().map(|point| point.depth).collect();
    }
    depths.sort_by(f64::total_cmp);
    Ok(depths.get(depths.len() / 2).copied())
}

/// Name of the effect that pulls the focus.
pub(super) const RACK_FOCUS: &str = "rack-focus";

/// The call for a rack focus, by words or by the move.
pub(super) fn rack_focus_call(calls: &Calls<'_>) -> Option<Call> {
    let call = calls.named(RACK_FOCUS).cloned().or_else(|| calls.of_move(RACK_FOCUS, Move::RackFocus));
    call.map(|call| without_choice(call, calls))
}

impl EffectKind for DepthOfField {
    const NAME: &'static str = "depth-of-field";
    const SETTINGS: &'static [&'static str] =
        &["f_stop", "background_blur", "meters_per_unit", "focus_x", "focus_y", "focus_z", "focus_nearer"];

    fn call(calls: &Calls<'_>) -> Option<Call> {
        // A rack focus has a depth of field of its own.
        if rack_focus_call(calls).is_some() {
            return None;
        }
        let of_key = || calls.of_keyframes(Self::NAME, "f_stop", |key| key.optics.f_stop.is_some());
        let of_focus = || calls.of_keyframes(Self::NAME, "focus_distance", |key| key.focus_distance.is_some());
        let call = calls.named(Self::NAME).cloned().or_else(of_key).or_else(of_focus);
        call.map(|call| without_choice(call, calls))
    }

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        Self::of_call(call, BLUR_BY_DEGREE)
    }
}

impl Effect for DepthOfField {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        let mut settings = match self.opening {
            Opening::OfKeyframes => Vec::new(),
            Opening::FStop(f_stop) | Opening::Chosen { f_stop, .. } => vec![("f_stop", f_stop)],
            Opening::BackgroundBlur(frac) => vec![("background_blur", frac)],
        };
        settings.push(("meters_per_unit", self.meters_per_unit));
        if let Focus::Point { point, nearer } = self.focus {
            settings.extend(POINT_SETTINGS.into_iter().zip([point.x, point.y, point.z, nearer]));
        }
        settings
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("circle of confusion", "px")
    }

    fn chose(&self) -> Option<String> {
        let Opening::Chosen { f_stop, circle_px } = self.opening else { return None };
        Some(format!("f/{f_stop:.2} for a circle of confusion of {circle_px:.1}{CHOICE_END}"))
    }

    fn shares_samples(&self) -> bool {
        true
    }

    fn is_local(&self) -> bool {
        true
    }

    fn measured(&self, first: &FrameFacts<'_>) -> Result<Option<Arc<dyn Effect>>, RenderError> {
        Ok(Some(Arc::new(self.settled(first)?)))
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let circle_px = frame.blur_extent(&SplatBlur { lens: self.lens(&frame.moment), motion: None })?.circle_px;
        Ok(Loss { error: circle_px, allowed: budget.blur_px, samples: budget.lens_samples(circle_px) })
    }

    fn state(&self, moment: &Moment<'_>) -> Option<Vec<f64>> {
        // The focus distances of keyframes are nothing that the camera shows.
        Some(self.lens(moment).map_or_else(Vec::new, |lens| vec![lens.aperture_diameter, lens.focus_distance]))
    }

    fn apply(&self, moment: &Moment<'_>, samples: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let lens = self.lens(moment);
        let between = moment.budget.between_lens(samples);
        next(&moment.exposed(|exposing| exposing.lens = lens, (samples, between)))
    }
}
