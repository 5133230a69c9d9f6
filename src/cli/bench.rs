use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use glam::DVec2;

use super::failure::Failure;
use super::scene_args::{PictureArgs, SceneArgs, print_up};
use super::{console, outputs};
use crate::export::cameras_json::{self, NamedCamera};
use crate::geometry::{Camera, Intrinsics, LevelFrame, Pose};
use crate::render::{Frame, Quality, RenderSettings, Renderer};
use crate::scene::Scene;

/// Measures accuracy against time.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench room.spz --cameras cameras.json --runs 5 > room.csv
One line a camera and preset: milliseconds a frame (least, median, most of the runs) and decibels against `reference`.")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Cameras to render; without them four level views from the middle of the scene
    #[arg(long, value_name = "CAMERAS.JSON")]
    cameras: Option<PathBuf>,
    /// Frame size in pixels for views without a cameras file
    #[arg(long, value_name = "HEIGHT", default_value_t = 720, value_parser = clap::value_parser!(u32).range(16..=4320))]
    height: u32,
    /// Runs of every picture, after one that is not counted
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let cameras_file = self.cameras.as_ref().map(|path| {
            let text = outputs::read_text(path)?;
            cameras_json::read(&text).map_err(|error| Failure::from(error).in_file(path))
        });
        let file = cameras_file.transpose()?;
        self.picture.bound_threads()?;
        let scene = self.scene.open()?.scene;
        print_up(&scene);
        let stated = file.as_ref().map(|file| (file.filter.as_deref(), file.near));
        let (filter, near) = stated.unwrap_or((None, None));
        let settings = self.picture.settings(&scene, Quality::Final, filter, near);
        let cameras = match file {
            Some(file) => file.cameras,
            None => middle_views(&scene, self.height)?,
        };
        console::data("camera,width,height,quality,ms_least,ms_median,ms_most,psnr_db\n")?;
        cameras.iter().try_for_each(|camera| self.bench_camera(&scene, camera, &settings))
    }

    /// Every preset on one camera, `reference` last.
    fn bench_camera(&self, scene: &Scene, camera: &NamedCamera, settings: &RenderSettings) -> Result<(), Failure> {
        let renderer = Renderer::new(&scene.gaussians);
        let reference = RenderSettings { quality: Quality::Reference, ..*settings };
        let spec = renderer.render(&camera.camera, &reference)?;
        for quality in [Quality::Draft, Quality::Standard, Quality::Final] {
            let settings = RenderSettings { quality, ..*settings };
            let (times_ms, frame) = self.time(|| renderer.render(&camera.camera, &settings).map_err(Failure::from))?;
            let (name, width, height) = (&camera.name, frame.width, frame.height);
            let (least, most) = (times_ms[0], times_ms[times_ms.len() - 1]);
            let median = times_ms[times_ms.len() / 2];
            let mut line = format!("{name},{width},{height},{},", quality.name());
            let _ = writeln!(line, "{least:.2},{median:.2},{most:.2},{:.2}", frame.psnr_db(&spec));
            console::data(&line)?;
        }
        Ok(())
    }

    /// Sorted times of the runs in milliseconds, and the last picture.
    fn time(&self, render: impl Fn() -> Result<Frame, Failure>) -> Result<(Vec<f64>, Frame), Failure> {
        let mut frame = render()?;
        let mut times_ms = Vec::new();
        for _ in 0..self.runs {
            let start = Instant::now();
            frame = render()?;
            times_ms.push(start.elapsed().as_secs_f64() * 1e3);
        }
        times_ms.sort_by(f64::total_cmp);
        Ok((times_ms, frame))
    }
}

/// Four level views from the middle of the scene, a quarter turn apart, 16:9 with 60 degrees.
fn middle_views(scene: &Scene, height: u32) -> Result<Vec<NamedCamera>, Failure> {
    let level = LevelFrame::new(scene.up)?;
    let intrinsics = Intrinsics::from_fov_y(height * 16 / 9, height, 60_f64.to_radians());
    let axis = level.up.any_orthonormal_vector();
    let headings = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
    let view = |(number, heading): (usize, DVec2)| {
        let forward = axis * heading.x + level.up.cross(axis) * heading.y;
        let pose = Pose::facing(scene.bounds().center(), forward, level.up, None);
        NamedCamera { name: format!("middle{number}"), camera: Camera { pose, intrinsics } }
    };
    Ok(headings.into_iter().enumerate().map(view).collect())
}
