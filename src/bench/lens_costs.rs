//! What every effect costs, alone, with its defaults.
//!
//! Enters: a renderer and a camera. Leaves: a [`CostRow`] per effect: its time over that of the plain frame, in the frames of
//! a film, measured alternately. The camera trucks and turns slowly, so that shutters have something to do.

use std::time::Instant;

use glam::{DQuat, DVec3};

use cinesplat_geometry::Camera;
use cinesplat_lens::{Call, Called, Calls, EffectChoice, EffectPlan, KINDS, Moment, OpticsTrack, Source, Take};
use cinesplat_render::{RenderError, RenderSettings, Renderer, Rgb8Frame};

/// The frame that is exposed, of 24 per second.
const FRAME: usize = 12;
const FPS: f64 = 24.0;
/// Motion per second: over the distance of what the camera looks at, and radians.
const TRUCK: f64 = 0.25;
const TURN_RAD: f64 = 0.15;
/// The header of [`CostRow::csv_line`].
pub const COST_CSV_HEADER: &str = "scene,camera,effect,pictures,times_plain,plain_ms\n";

/// The cost of an effect.
#[derive(Debug, Clone, PartialEq)]
pub struct CostRow {
    /// The scene.
    pub scene: String,
    /// The camera.
    pub camera: String,
    /// The effect.
    pub effect: &'static str,
    /// Pictures' worth of samples; 0 = the frame does not need the effect.
    pub num_pictures: u32,
    /// Median of the ratio to the time of the plain frame.
    pub times_plain: f64,
    /// Median time of the plain frame, ms.
    pub plain_ms: f64,
}

impl CostRow {
    /// The row as a line of a CSV.
    pub fn csv_line(&self) -> String {
        let Self { scene, camera, effect, num_pictures, times_plain, plain_ms } = self;
        format!("{scene},{camera},{effect},{num_pictures},{times_plain:.2},{plain_ms:.2}\n")
    }
}

/// Measures every effect, without the names of scene and camera. `distance` is that of what the camera looks at.
///
/// # Errors
/// Those of the renderer.
pub fn measure_costs(
    renderer: &Renderer<'_>,
    render: &RenderSettings,
    (camera, distance): (&Camera, f64),
    num_repeats: usize,
) -> Result<Vec<CostRow>, RenderError> {
    let camera_at = |time_secs: f64| {
        let mut pose = camera.pose;
        pose.position += pose.right() * (TRUCK * distance * time_secs);
        pose.rotation *= DQuat::from_rotation_y(TURN_RAD * time_secs);
        Camera { pose, ..*camera }
    };
    let optics = OpticsTrack::default();
    let up = Some(camera.pose.rotation * DVec3::NEG_Y);
    let take = Take { camera_at: &camera_at, optics: &optics, up, fps: FPS, seed: 0 };
    let moment = Moment::of_frame(take, FRAME, render);
    let mut rows = Vec::new();
    for kind in KINDS {
        // A background of its own color is none.
        let settings = if kind.name == "background" { vec![("blue".to_owned(), 1.0)] } else { Vec::new() };
        let calls = [Call { settings, ..Call::new(kind.name, "the bench", Source::File) }];
        let asked = Calls { calls: &calls, forbidden: &[], moves: &[], keyframes: &[], scene_size: distance, seed: 0 };
        let called = Called::of(&EffectChoice::Auto, &asked).effects;
        let plan = EffectPlan::of(&called, take, FRAME..FRAME + 1, (renderer, render))?;
        let mut frame = Rgb8Frame::default();
        let mut timed = Vec::new();
        // The first pair is the warm-up.
        for _ in 0..=num_repeats.max(1) {
            let start = Instant::now();
            renderer.render_rgb8_into(&moment.camera, render, &mut frame)?;
            let plain_secs = start.elapsed().as_secs_f64();
            let start = Instant::now();
            if plan.is_plain(FRAME) {
                renderer.render_rgb8_into(&moment.camera, render, &mut frame)?;
            } else {
                plan.expose(&moment, renderer)?.into_rgb8(&mut frame);
            }
            timed.push((start.elapsed().as_secs_f64() / plain_secs, plain_secs));
        }
        timed.remove(0);
        timed.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (times_plain, plain_secs) = timed[timed.len() / 2];
        let num_pictures = if plan.is_plain(FRAME) { 0 } else { plan.num_samples(FRAME) };
        let (effect, plain_ms) = (kind.name, plain_secs * 1e3);
        rows.push(CostRow { scene: String::new(), camera: String::new(), effect, num_pictures, times_plain, plain_ms });
    }
    Ok(rows)
}
