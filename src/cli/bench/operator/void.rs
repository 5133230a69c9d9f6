use std::fmt::Write as _;

use super::statistics::Summary;
use crate::cli::bench::cases::CaseArgs;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::shot_args::SolveArgs;
use cinesplat::geometry::{Camera, Intrinsics};
use cinesplat::render::{RenderSettings, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::{CameraPath, Shot};

/// Measure the share of each picture that no Gaussian covers
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    cases: CaseArgs,
    #[command(flatten)]
    solve: SolveArgs,
    /// Height of the pictures in pixels
    #[arg(long, value_name = "N", default_value_t = 72, value_parser = clap::value_parser!(u32).range(16..=2160))]
    height: u32,
    /// Pictures per second of film
    #[arg(long, value_name = "FPS", default_value_t = 2.0)]
    fps: f64,
    /// Transmittance above which a pixel counts as void
    #[arg(long, value_name = "T", default_value_t = 0.5)]
    threshold: f32,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let (cases, mut director) = self.cases.open()?;
        console::data("film,mean_void_frac,worst_void_frac\n")?;
        let mut means = Vec::new();
        for case in &cases {
            let shot = director.direct(case, self.solve.level)?;
            let shares = self.void_fracs(&director.scene_of(case)?.scene, &shot)?;
            let (mean, worst) = summary(&shares);
            means.push(mean);
            console::data(&format!("{},{mean:.4},{worst:.4}\n", case.id))?;
        }
        let Summary { median, largest: worst, .. } = Summary::of(&means);
        let mut text = String::new();
        let _ = write!(text, "{} films, solver {}: mean void per film ", means.len(), self.solve.level.as_ref());
        let _ = write!(text, "median {median:.4}, worst {worst:.4} (transmittance above {})", self.threshold);
        console::note(&text);
        Ok(())
    }

    /// Share of void pixels per picture.
    fn void_fracs(&self, scene: &Scene, shot: &Shot) -> Result<Vec<f64>, Failure> {
        let path = CameraPath::new(shot)?;
        let renderer = Renderer::new(&scene.gaussians);
        let settings = RenderSettings { near: scene.bounds().default_near(), ..RenderSettings::default() };
        let count = ((shot.duration_secs * self.fps).ceil() as usize).max(1) + 1;
        let share = |i: usize| {
            let state = path.sample(shot.duration_secs * i as f64 / (count - 1) as f64);
            let width = (f64::from(self.height) * f64::from(shot.width) / f64::from(shot.height)).round() as u32;
            let intrinsics = Intrinsics::from_fov_y(width, self.height, state.fov_y_rad);
            let frame = renderer.render(&Camera { pose: state.pose, intrinsics }, &settings)?;
            let void = frame.transmittance.iter().filter(|&&t| t > self.threshold).count();
            Ok(void as f64 / frame.transmittance.len() as f64)
        };
        (0..count).map(share).collect()
    }
}

/// Mean and largest value.
fn summary(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    (mean, values.iter().copied().fold(0.0, f64::max))
}
