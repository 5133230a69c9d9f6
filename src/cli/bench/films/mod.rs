use crate::cli::outputs::BenchFolder;
mod measure;
mod report;

use std::path::Path;

use super::scenes::{ScenesArgs, Size, film_view, parse_size, resized, scene_name, settings};
use crate::cli::choice::choice;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::scene_args::PictureArgs;
use cinesplat::export::cameras_json::StillCameras;
use cinesplat::geometry::{Camera, Intrinsics};
use cinesplat::pipeline::{FilmSettings, FrameRange};
use cinesplat::render::Quality;
use cinesplat::scene::Scene;
use cinesplat::trajectory::{Easing, Keyframe, SceneRef, Shot};
use cinesplat::video::VideoSettings;
use measure::{FilmCase, FilmRow};

/// Frames per second of the films.
const RATE_FPS: f64 = 30.0;
/// Default length of the dolly, as a fraction of the scene size.
pub(super) const TRAVEL_FRAC: f64 = 0.05;

/// Measure films against stills, against encoding alone and against their forecasts
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench films room.spz synth:demo --cameras room.cameras.json --cameras auto -o bench
Films a dolly: a straight move along the view axis of the first camera (auto: the camera in the middle). Prints one CSV
line per measurement, with its baseline and the difference in percent. All pictures of a film are kept in
memory to encode them alone. Films that keep their frames in a job folder alternate with films that do not, five
of each; the pairs with the median ratios of wall time and of CPU time are printed: CPU time is what a busy machine
leaves comparable. -o keeps films.csv and a table.")]
pub(crate) struct Args {
    #[command(flatten)]
    scenes: ScenesArgs,
    /// Size of the pictures; `given` takes that of the cameras file
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: Size,
    /// Frames per film
    #[arg(long, value_name = "N", default_value_t = 240, value_parser = clap::value_parser!(u16).range(2..=10_000))]
    frames: u16,
    /// Length of the dolly in scene units [default: 0.05 of the scene size]
    #[arg(long, value_name = "DISTANCE", value_parser = parse_length)]
    travel: Option<f64>,
    /// Qualities to film; the first is compared with stills as well
    #[arg(
        long, value_name = "Q,..", default_value = "standard,draft,final", value_delimiter = ',',
        value_parser = choice::<Quality>()
    )]
    qualities: Vec<Quality>,
    #[command(flatten)]
    folder: BenchFolder,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let files = (&self.folder, &["films.csv", "films.md"][..]);
        let scenes = self.scenes.begin(files, &self.picture, report::CSV_HEADER)?;
        let mut rows = Vec::new();
        for (path, file) in &scenes {
            rows.extend(self.bench_scene(path, file.as_ref())?);
        }
        self.folder.write("films.csv", &report::to_csv(&rows))?;
        self.folder.write("films.md", &report::to_table(&rows))
    }

    fn bench_scene(&self, path: &Path, file: Option<&StillCameras>) -> Result<Vec<FilmRow>, Failure> {
        let scene = self.scenes.options.open(path)?.scene;
        let camera = film_view(&scene, file)?;
        let render = settings(&self.picture, &scene, Quality::Standard, file);
        let travel = self.travel.unwrap_or(TRAVEL_FRAC * scene.bounds().size());
        let shot = dolly(&scene, &resized(&camera, self.size), travel, usize::from(self.frames));
        let name = scene_name(path);
        let case = FilmCase { scene: &scene, name: &name, shot: &shot };
        let mut rows = Vec::new();
        let mut tell = |row: FilmRow| {
            // A closed stdout is reported at the end.
            let _ = console::data(&report::csv_line(&row));
            rows.push(row);
        };
        for (idx, &quality) in self.qualities.iter().enumerate() {
            let render = cinesplat::render::RenderSettings { quality, ..render };
            let (video, frames) = (VideoSettings::default(), FrameRange::default());
            let settings = FilmSettings { render, video, frames, ..FilmSettings::default() };
            if idx == 0 {
                case.stills(&settings, &mut tell)?;
            }
            case.film(&settings, &mut tell)?;
        }
        Ok(rows)
    }
}

/// A straight move along the view axis at constant speed.
pub(super) fn dolly(scene: &Scene, camera: &Camera, travel: f64, num_frames: usize) -> Shot {
    let duration_secs = num_frames as f64 / RATE_FPS;
    let key = |time_secs: f64, distance: f64| {
        let mut pose = camera.pose;
        pose.position += pose.forward() * distance;
        let (fov_y_rad, easing) = (camera.intrinsics.fov_y_rad(), Easing::Linear);
        Keyframe {
            time_secs,
            pose,
            fov_y_rad,
            focus_distance: None,
            optics: cinesplat::trajectory::KeyOptics::default(),
            easing,
            cut: false,
            intent: None,
        }
    };
    let Intrinsics { width, height, .. } = camera.intrinsics;
    let keyframes = vec![key(0.0, 0.0), key(duration_secs, travel)];
    let scene = SceneRef { up: Some(scene.up), ..SceneRef::default() };
    Shot { scene, ..Shot::from_keyframes([width, height], RATE_FPS, duration_secs, keyframes) }
}

fn parse_length(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|length: &f64| *length > 0.0 && length.is_finite())
        .ok_or("expected a length above 0".to_owned())
}
