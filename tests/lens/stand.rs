//! A small scene and a shot of it.

use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::lens::{
    Call, Called, CalledEffect, Calls, EffectChoice, EffectPlan, Moment, OpticsTrack, Picture, Source, Take,
};
use cinesplat::render::{RenderSettings, Renderer};
use glam::{DQuat, DVec3};

/// Calls for effects, with settings.
pub(super) fn call(name: &str, settings: &[(&str, f64)]) -> Call {
    let settings = settings.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    Call { settings, ..Call::new(name, "the test", Source::Words) }
}

/// What calls lead to without words, moves or keyframes besides.
pub(super) fn called(calls: &[Call], choice: &EffectChoice) -> Called {
    Called::of(choice, &Calls { calls, forbidden: &[], moves: &[], keyframes: &[], scene_size: 2.0, seed: 7 })
}

/// One effect.
pub(super) fn effect(name: &str, settings: &[(&str, f64)]) -> Vec<CalledEffect> {
    called(&[call(name, settings)], &EffectChoice::Auto).effects
}

/// A camera at rest.
pub(super) fn camera(size_px: [u32; 2]) -> Camera {
    let pose = Pose::new(DVec3::new(0.0, 0.0, -2.0), DQuat::IDENTITY);
    Camera { pose, intrinsics: Intrinsics::from_fov_y(size_px[0], size_px[1], 0.9) }
}

/// Calls `work` with a shot at 10 frames per second of a camera that effects may move.
pub(super) fn with_take<T>(effects: &[CalledEffect], size_px: [u32; 2], work: impl FnOnce(Take<'_>) -> T) -> T {
    let camera_at = |secs: f64| EffectPlan::moved(effects, camera(size_px), secs);
    let optics = OpticsTrack::default();
    work(Take { camera_at: &camera_at, optics: &optics, up: Some(DVec3::NEG_Y), fps: 10.0, seed: 7 })
}

/// A frame with effects.
pub(super) fn exposed(
    effects: &[CalledEffect],
    size_px: [u32; 2],
    frame_idx: usize,
    (renderer, render): (&Renderer<'_>, &RenderSettings),
) -> Picture {
    with_take(effects, size_px, |take| {
        let plan = EffectPlan::of(effects, take, frame_idx..frame_idx + 1, (renderer, render)).unwrap();
        plan.expose(&Moment::of_frame(take, frame_idx, render), renderer).unwrap()
    })
}
