mod film;
mod load;
mod report;

use std::path::Path;
use std::time::Duration;

use super::scenes::{ScenesArgs, Size, parse_size, resized, scene_name, settings, views};
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::outputs::BenchFolder;
use crate::cli::scene_args::PictureArgs;
use cinesplat::export::cameras_json::StillCameras;
use cinesplat::pipeline::{FilmSettings, Requirements};
use cinesplat::render::{Quality, Renderer};
use film::{PromisedFilm, standard_secs, travel};
use load::LoadTime;
use report::PromiseRow;

/// Film with --min-psnr and --budget, and count the promises that are broken
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench promises room.spz synth:demo --budgets 1.5,2,4 -o bench
Films short moves through each scene. After a film with a least PSNR every frame is rendered again at its quality and
compared with `reference`. The films with a budget are made while another process takes a core: half of them from before
the forecast on, half from the first frame on. A film that is refused before it begins, or of which is said that it has
no reserve, breaks no promise. Ends with 70 if a promise is broken. -o keeps promises.csv and a table.")]
pub(crate) struct Args {
    #[command(flatten)]
    scenes: ScenesArgs,
    /// Size of the pictures; `given` takes that of the cameras file
    #[arg(long, value_name = "WxH", default_value = "192x108", value_parser = parse_size)]
    size: Size,
    /// Frames per film
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u16).range(2..=10_000))]
    frames: u16,
    /// Least PSNR of the films, one film each, dB
    #[arg(long, value_name = "DB,..", default_value = "35,43,46,60,70,78,85,110", value_delimiter = ',', value_parser = above_zero)]
    psnrs: Vec<f64>,
    /// Budgets of the films, one film each, over the time of forecast and film at `standard` without load
    #[arg(long, value_name = "SHARE,..", default_value = "1.2,1.6,2.5,5", value_delimiter = ',', value_parser = above_zero)]
    budgets: Vec<f64>,
    #[command(flatten)]
    folder: BenchFolder,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let files = (&self.folder, &["promises.csv", "promises.md"][..]);
        let scenes = self.scenes.begin(files, &self.picture, report::CSV_HEADER)?;
        let mut rows = Vec::new();
        for (path, file) in &scenes {
            self.bench_scene(path, file.as_ref(), &mut rows)?;
        }
        self.folder.write("promises.csv", &report::to_csv(&rows))?;
        self.folder.write("promises.md", &report::to_table(&rows))?;
        let num_broken = rows.iter().filter(|row| row.is_broken()).count();
        console::note(&format!("{} films, {num_broken} broken promises", rows.len()));
        if num_broken == 0 { Ok(()) } else { Err(Failure::fault(&format!("{num_broken} broken promises"))) }
    }

    fn bench_scene(&self, path: &Path, file: Option<&StillCameras>, rows: &mut Vec<PromiseRow>) -> Result<(), Failure> {
        let scene = self.scenes.options.open(path)?.scene;
        let views = views(&scene, file)?;
        let renderer = Renderer::new(&scene.gaussians);
        let render = settings(&self.picture, &scene, Quality::Standard, file);
        let film = FilmSettings { render, ..FilmSettings::default() };
        let name = scene_name(path);
        let mut tell = |row: PromiseRow| {
            // A closed stdout is reported at the end.
            let _ = console::data(&report::csv_line(&row));
            rows.push(row);
        };
        let shot_of = |idx: usize| {
            let (_, camera) = views.get(idx % views.len().max(1)).ok_or_else(|| Failure::fault("no camera"))?;
            Ok::<_, Failure>(travel(&scene, &resized(camera, self.size), usize::from(self.frames), idx))
        };
        for (idx, least) in self.psnrs.iter().enumerate() {
            let requirements = Requirements { min_psnr_db: Some(*least), ..Requirements::default() };
            let shot = shot_of(idx)?;
            tell(PromisedFilm { renderer: &renderer, shot: &shot, settings: &film }.with_psnr(&name, requirements)?);
        }
        for (idx, share) in self.budgets.iter().enumerate() {
            let shot = shot_of(idx)?;
            let budget = Duration::from_secs_f64(share * standard_secs(&renderer, &shot, &film)?);
            let requirements = Requirements { budget: Some(budget), ..Requirements::default() };
            let load = if idx % 2 == 0 { LoadTime::Throughout } else { LoadTime::FromFirstFrame };
            let film = PromisedFilm { renderer: &renderer, shot: &shot, settings: &film };
            tell(film.with_budget(&name, requirements, load)?);
        }
        Ok(())
    }
}

fn above_zero(text: &str) -> Result<f64, String> {
    let found = text.parse().ok().filter(|value: &f64| *value > 0.0 && *value <= 1e6);
    found.ok_or_else(|| "expected a number above 0, at most 1000000".to_owned())
}
