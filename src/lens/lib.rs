//! Effects of the camera that a shot calls for: its lens, its shutter, its film stock, the hand that holds it.
//!
//! Enters: the calls of a shot (its words, its moves, fields on its keyframes, `--effects`). Leaves: a plan of effects
//! as data, and pictures with the effects. The invariant: a frame on which no effect runs is rendered by the plain
//! renderer, with the same bytes and the same work as without this crate.
//!
//! # How it works
//!
//! 1. Every [`Call`] names an effect and says why. [`Called::of`] makes the effects: each one reads its settings from its
//!    call ([`EffectKind::called_for`]). Of effects that exclude each other one is kept ([`EffectKind::YIELDS_TO`]).
//!    Whatever is called for and left out is reported by name with the reason ([`Unmet`]).
//! 2. [`EffectPlan::of`] asks every effect per frame what leaving it out would cost ([`Effect::error_if_skipped`]). The
//!    effect runs on the frames where that is above the budget of the quality ([`Budget`]).
//! 3. [`EffectPlan::expose`] makes a frame. The effects that run on it stand around the renderer like layers: the
//!    outermost one asks the next one for a picture ([`Effect::apply`]), as often and of whatever [`Moment`] it needs,
//!    and the innermost one asks the renderer.
//!
//! # Samples
//!
//! Lens and shutter take the mean light of several pictures. [`Budget::of`] says how many and why, from the figures of
//! `make bench-lens` (`renders/lens/lens.csv`): samples are sharp where they stand close, and only where there are gaps
//! between them the splats of each one are blurred. Sharp samples share one projection ([`cinesplat_render::Sweep`]),
//! and a tile of the picture takes as many of them as its splats move: none but the middle where nothing moves. A frame
//! that a film has already, because neither the camera nor the state of an effect has changed, is repeated
//! ([`EffectPlan::repeats`]). `bench lens --parts auto` compares films with films whose effects run everywhere on every
//! frame.
//!
//! # Adding an effect
//!
//! One file with a struct of settings that implements [`Effect`] and [`EffectKind`], and one line in [`KINDS`]: the
//! order of that list is the order of the layers, outermost first. Its words are a line of `prompts/effects.txt`.

mod anamorphic;
mod background;
mod bloom;
mod blur;
mod budget;
mod called;
mod calls;
mod choice;
mod chromatic_aberration;
mod depth_of_field;
mod effect;
mod exposure;
mod eyes;
mod film_grain;
mod fisheye;
mod fog;
mod handheld;
mod kinds;
mod lens_distortion;
mod lens_flare;
mod light;
mod moment;
mod motion_blur;
mod opencv;
mod optics;
mod panorama;
mod plan;
mod planned;
mod rack_focus;
mod resample;
mod rolling_shutter;
mod samples;
mod sampling;
mod seen;
mod stereo;
mod tilt_shift;
mod vignette;

pub use anamorphic::Anamorphic;
pub use background::Background;
pub use bloom::Bloom;
pub use budget::{Budget, Loss, MAX_SAMPLES};
pub use called::{Called, CalledEffect, Unmet, UnmetReason, other_means};
pub use calls::{Call, Calls, Degree, Source};
pub use choice::{EffectChoice, UnknownEffect};
pub use chromatic_aberration::ChromaticAberration;
pub use depth_of_field::{DepthOfField, Focus};
pub use effect::{Effect, EffectKind, Next};
pub use exposure::Exposure;
pub use eyes::EyeLayout;
pub use film_grain::FilmGrain;
pub use fisheye::Fisheye;
pub use fog::Fog;
pub use handheld::Handheld;
pub use kinds::{KINDS, Kind, is_known, names, unknown_names};
pub use lens_distortion::LensDistortion;
pub use lens_flare::LensFlare;
pub use light::{Light, Picture};
pub use moment::{Exposing, Moment, OpticsTrack, Take};
pub use motion_blur::MotionBlur;
pub use optics::{Aperture, LensAndShutter, SENSOR_M, focal_length_m};
pub use panorama::Panorama;
pub use plan::{EffectPlan, PlannedEffect};
pub use planned::{PlannedExposure, Sampling};
pub use rack_focus::RackFocus;
pub use rolling_shutter::RollingShutter;
pub use samples::Between;
pub use seen::{FrameFacts, SeenPoint};
pub use stereo::Stereo;
pub use tilt_shift::TiltShift;
pub use vignette::Vignette;
