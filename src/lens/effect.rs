//! What an effect is.

use std::fmt::Debug;
use std::sync::Arc;

use cinesplat_geometry::Camera;
use cinesplat_render::RenderError;
use glam::DVec3;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::eyes::EyeLayout;
use super::light::Picture;
use super::moment::Moment;
use super::seen::FrameFacts;

/// Makes the picture of a moment without the effect that asks, but with all effects inside it.
pub type Next<'a> = &'a mut dyn FnMut(&Moment<'_>) -> Result<Picture, RenderError>;

/// What calls for an effect.
pub trait EffectKind: Effect + Sized {
    /// Name, as in `--effects` and in `shot.json`.
    const NAME: &'static str;

    /// Names of the settings that it reads from a call.
    const SETTINGS: &'static [&'static str];

    /// Other names that ask for the effect.
    const ALSO: &'static [&'static str] = &[];

    /// Effects that take the place of this one where both are asked for, each with the reason.
    const YIELDS_TO: &'static [(&'static str, &'static str)] = &[];

    /// The call that asks for the effect. Without an own version: the first call by one of its names.
    fn call(calls: &Calls<'_>) -> Option<Call> {
        calls.calls.iter().find(|call| call.name == Self::NAME || Self::ALSO.contains(&call.name.as_str())).cloned()
    }

    /// The effect as the call asks for it. `None` if the call's settings make it do nothing.
    fn called_for(call: &Call, calls: &Calls<'_>) -> Option<Self>;
}

/// An effect with its settings.
///
/// Implementors are plain data: equal settings, seed and moment give equal pictures, whichever frame is rendered first.
pub trait Effect: Debug + Send + Sync {
    /// Every setting with its value: [`EffectKind::called_for`] makes the same effect from them.
    fn settings(&self) -> Vec<(&'static str, f64)>;

    /// What [`Loss::error`] is, and its unit: `("circle of confusion", "px")`.
    fn measure(&self) -> (&'static str, &'static str);

    /// What leaving the effect out of a frame would cost, against the budget.
    ///
    /// # Errors
    /// Those of the renderer, where the answer depends on what is seen.
    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError>;

    /// The effect with what it takes from the first frame of the shot, such as the distance of what it focuses on. `None`
    /// if it takes nothing.
    ///
    /// # Errors
    /// Those of the renderer.
    fn measured(&self, first: &FrameFacts<'_>) -> Result<Option<Arc<dyn Effect>>, RenderError> {
        let _ = first;
        Ok(None)
    }

    /// The camera as the effect moves it. Where this is all that the effect does ([`Effect::develops`]), frames stay
    /// plain.
    fn moved(&self, camera: Camera, time_secs: f64) -> Camera {
        let _ = time_secs;
        camera
    }

    /// The camera that the effects inside this one see, where that is another one than the shot's: what it does not show
    /// of the camera's motion, they do not blur. `up` is the world's.
    fn seen_through(&self, camera: Camera, up: Option<DVec3>) -> Option<Camera> {
        let _ = (camera, up);
        None
    }

    /// What the effect chose by itself from the first frame, as a part of the reason for it.
    fn chose(&self) -> Option<String> {
        None
    }

    /// Largest distance between the camera and its path, scene units.
    fn reach(&self) -> f64 {
        0.0
    }

    /// Whether the effect does anything besides [`Effect::moved`].
    fn develops(&self) -> bool {
        true
    }

    /// Whether the film carries how much of each pixel the scene covers.
    fn is_transparent(&self) -> bool {
        false
    }

    /// Whether its pictures show all directions, by longitude and latitude.
    fn is_panorama(&self) -> bool {
        false
    }

    /// How its pictures hold one view per eye; `None` for a single view.
    fn eyes(&self) -> Option<EyeLayout> {
        None
    }

    /// Whether its samples are those of [`Moment::exposing`], which all effects that say so share.
    fn shares_samples(&self) -> bool {
        false
    }

    /// Whether its picture of a part of the frame is that part of its picture of the whole frame.
    fn is_local(&self) -> bool {
        false
    }

    /// Pictures' worth of work that the samples of a frame take.
    fn num_pictures(&self, samples: u32) -> u32 {
        samples
    }

    /// Whether two frames with the same camera have different pictures.
    fn changes_with_time(&self) -> bool {
        true
    }

    /// What the picture of a moment depends on besides its camera: with equal cameras and states, pictures are equal. `None` if
    /// no two pictures are.
    fn state(&self, moment: &Moment<'_>) -> Option<Vec<f64>> {
        let _ = moment;
        (!self.changes_with_time()).then(Vec::new)
    }

    /// The picture of a moment with the effect, made from pictures that `next` gives. `samples` are those of
    /// [`Loss::samples`].
    ///
    /// # Errors
    /// Those of `next`.
    fn apply(&self, moment: &Moment<'_>, samples: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let _ = samples;
        next(moment)
    }
}
