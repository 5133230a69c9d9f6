//! Effects where they show, against effects on every frame.
//!
//! Enters: a renderer and a camera. Leaves: one [`AutoRow`] per shot and quality. Each shot has parts that move and parts
//! that rest. Its frames are exposed three times: as planned; with every effect on every frame and in every part of it, with
//! the samples of the plan, which shows the error of skipping alone; and with the samples of the frame that needs most on
//! every frame, which is what a film takes that is not looked at before. Times are alternate, and those of the plan count as
//! a part of the first. As in films, a frame that must equal the one before it is not taken again.

use std::time::Instant;

use glam::DQuat;

use cinesplat_geometry::{Camera, Pose};
use cinesplat_lens::{Call, Called, Calls, EffectChoice, EffectPlan, Moment, OpticsTrack, Picture, Source, Take};
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer};
use cinesplat_trajectory::{Easing, KeyOptics, Keyframe};

/// Frames of a shot.
pub const AUTO_FRAMES: usize = 24;
/// Frames per second of a shot.
const FPS: f64 = 24.0;
/// Qualities that are measured, with the least PSNR that skipping may cost on any frame, dB.
pub const AUTO_FLOORS: [(Quality, f64); 2] = [(Quality::Standard, 50.0), (Quality::Final, 60.0)];
/// The header of [`AutoRow::csv_line`].
pub const AUTO_CSV_HEADER: &str = "scene,camera,shot,quality,frames,frames_with_effects,pictures,forced_pictures,worst_psnr_db,\
    worst_frame,floor_db,worst_of_forced_db,secs,forced_secs,cost_ratio\n";

/// A shot with parts that move and parts that rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum AutoShot {
    /// A push-in that ends in the middle of the shot; the shutter is half open.
    PushAndHold,
    /// A whip-pan between two rests; the shutter is half open.
    WhipBetweenRests,
    /// An arc in the second half of the shot; the shutter is half open, and its rows are read one after another.
    RestAndArc,
    /// A camera at rest whose focus is pulled from infinity to the nearer part of the picture and back.
    PullOfFocus,
}

/// One shot at one quality.
#[derive(Debug, Clone, PartialEq)]
pub struct AutoRow {
    /// The scene.
    pub scene: String,
    /// The camera.
    pub camera: String,
    /// The shot.
    pub shot: AutoShot,
    /// The quality.
    pub quality: Quality,
    /// Frames that have an effect.
    pub num_with_effects: usize,
    /// Pictures of all frames, as planned and with every effect on every frame.
    pub num_pictures: [u64; 2],
    /// Least PSNR of a planned frame against the one from which nothing is skipped, dB, and its number.
    pub worst: (f64, usize),
    /// Least PSNR of a planned frame against the one with the most samples, dB.
    pub worst_of_forced_db: f64,
    /// Seconds of all frames, as planned and with every effect on every frame.
    pub secs: [f64; 2],
    /// The least PSNR that is allowed, dB.
    pub floor_db: f64,
}

impl AutoRow {
    /// Time as planned over time with every effect on every frame.
    pub fn cost_ratio(&self) -> f64 {
        self.secs[0] / self.secs[1].max(1e-9)
    }

    /// The row as a line of a CSV.
    pub fn csv_line(&self) -> String {
        let Self { scene, camera, shot, quality, num_with_effects, num_pictures, worst, secs, floor_db, .. } = self;
        format!(
            "{scene},{camera},{shot},{quality},{AUTO_FRAMES},{num_with_effects},{},{},{:.1},{},{floor_db},{:.1},{:.2},{:.2},{:.3}\n",
            num_pictures[0],
            num_pictures[1],
            worst.0.min(150.0),
            worst.1,
            self.worst_of_forced_db.min(150.0),
            secs[0],
            secs[1],
            self.cost_ratio()
        )
    }
}

impl AutoShot {
    /// The camera at a time; `distance` is that of what it looks at.
    fn camera_at(self, camera: &Camera, distance: f64, time_secs: f64) -> Camera {
        let part = |from: f64, to: f64| {
            let along = ((time_secs * FPS / AUTO_FRAMES as f64 - from) / (to - from)).clamp(0.0, 1.0);
            along * along * (3.0 - 2.0 * along)
        };
        let mut pose = camera.pose;
        match self {
            Self::PushAndHold => pose.position += pose.forward() * (0.3 * distance * part(0.0, 0.5)),
            Self::WhipBetweenRests => pose.rotation *= DQuat::from_rotation_y(0.8 * part(0.4, 0.65)),
            Self::RestAndArc => {
                let turn = pose.rotation * DQuat::from_rotation_y(0.35 * part(0.5, 1.0));
                let middle = pose.position + pose.forward() * distance;
                let turned = Pose::new(middle, turn);
                pose = Pose::new(middle - turned.forward() * distance, turn);
            }
            Self::PullOfFocus => {}
        }
        Camera { pose, ..*camera }
    }

    /// What the shot calls for.
    fn calls(self) -> Vec<Call> {
        let names: &[&str] = match self {
            Self::PushAndHold | Self::WhipBetweenRests => &["motion-blur"],
            Self::RestAndArc => &["motion-blur", "rolling-shutter"],
            Self::PullOfFocus => &["depth-of-field"],
        };
        names.iter().map(|name| Call::new(name, "the bench", Source::File)).collect()
    }

    /// The keyframes as far as effects read them.
    fn keyframes(self, camera: &Camera, near: f64) -> Vec<Keyframe> {
        let far = 1e4 * near;
        let keys: &[(f64, f64)] = match self {
            Self::PullOfFocus => &[(0.0, near), (0.3, near), (0.5, far), (0.7, far), (0.9, near), (1.0, near)],
            _ => &[],
        };
        let key = |&(at, focus): &(f64, f64)| Keyframe {
            time_secs: at * AUTO_FRAMES as f64 / FPS,
            pose: camera.pose,
            fov_y_rad: camera.intrinsics.fov_y_rad(),
            focus_distance: Some(focus),
            optics: KeyOptics::default(),
            easing: Easing::Linear,
            cut: false,
            intent: None,
        };
        keys.iter().map(key).collect()
    }
}

/// Whether a film repeats the frame before this one.
fn repeats(plan: &EffectPlan, take: Take<'_>, frame_idx: usize) -> bool {
    let [last, this] = [frame_idx - 1, frame_idx].map(|idx| (take.camera_at)(idx as f64 / take.fps));
    last == this && plan.repeats(frame_idx, frame_idx - 1)
}

/// Measures a shot at a quality, without the scene's name. `distance` is that of what the camera looks at.
///
/// # Errors
/// Those of the renderer.
pub fn measure_auto(
    renderer: &Renderer<'_>,
    settings: &RenderSettings,
    (camera, distance): (&Camera, f64),
    shot: AutoShot,
    (quality, floor_db): (Quality, f64),
) -> Result<AutoRow, RenderError> {
    let render = RenderSettings { quality, accuracy: None, ..*settings };
    let (calls, keyframes) = (shot.calls(), shot.keyframes(camera, distance));
    let asked = Calls { calls: &calls, forbidden: &[], moves: &[], keyframes: &[], scene_size: distance, seed: 0 };
    let called = Called::of(&EffectChoice::Auto, &asked).effects;
    let camera_at = |time_secs: f64| shot.camera_at(camera, distance, time_secs);
    let optics = OpticsTrack::new(&keyframes);
    let take = Take { camera_at: &camera_at, optics: &optics, up: None, fps: FPS, seed: 0 };
    let start = Instant::now();
    let plan = EffectPlan::of(&called, take, 0..AUTO_FRAMES, (renderer, &render))?;
    let mut secs = [start.elapsed().as_secs_f64(), 0.0, 0.0];
    let plans = [plan.clone(), plan.clone().forced(), plan.clone().everywhere()];
    let (mut worst, mut worst_of_forced_db, mut num_pictures) = ((f64::INFINITY, 0), f64::INFINITY, [0; 3]);
    let mut pictures: [Option<Picture>; 3] = [None, None, None];
    for frame_idx in 0..AUTO_FRAMES {
        let moment = Moment::of_frame(take, frame_idx, &render);
        for (idx, plan) in plans.iter().enumerate() {
            // Forced, no frame is known to equal another one.
            if idx == 0 && frame_idx > 0 && repeats(plan, take, frame_idx) {
                continue;
            }
            let start = Instant::now();
            let mut picture = plan.expose(&moment, renderer)?;
            picture.display();
            secs[idx] += start.elapsed().as_secs_f64();
            num_pictures[idx] += u64::from(plan.num_samples(frame_idx));
            pictures[idx] = Some(picture);
        }
        let [Some(planned), Some(forced), Some(everywhere)] = &pictures else { continue };
        let psnr_db = planned.frame().psnr_db(everywhere.frame());
        worst_of_forced_db = worst_of_forced_db.min(planned.frame().psnr_db(forced.frame()));
        if psnr_db < worst.0 {
            worst = (psnr_db, frame_idx);
        }
    }
    let num_with_effects = (0..AUTO_FRAMES).filter(|&frame_idx| !plan.is_plain(frame_idx)).count();
    let ([planned_pictures, forced_pictures, _], [planned_secs, forced_secs, _]) = (num_pictures, secs);
    Ok(AutoRow {
        scene: String::new(),
        camera: String::new(),
        shot,
        quality,
        num_with_effects,
        num_pictures: [planned_pictures, forced_pictures],
        worst,
        worst_of_forced_db,
        secs: [planned_secs, forced_secs],
        floor_db,
    })
}
