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
use film::{PromisedFilm, draft_secs, travel};
use load::LoadTime;
use report::{Film, PromiseRow};

/// The files of the bench.
const CSV: &str = "promises.csv";
const TABLE: &str = "promises.md";

/// Film with --min-psnr and --budget, and count the promises that are broken
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench promises room.spz synth:demo --budgets 1.5,2,4 -o bench --resume
Films short moves through each scene. After a film with a least PSNR every frame is rendered again at its quality and
compared with `reference`. The films with a budget are made while another process takes a core: half of them from before
the forecast on, half from the first frame on. A film that is refused before it begins, or of which is said that it has
no reserve, breaks no promise. Ends with 70 if a promise is broken. -o keeps promises.csv and a table.
With --resume a run that was stopped goes on with the films that are not yet in promises.csv at these settings.")]
pub(crate) struct Args {
    #[command(flatten)]
    scenes: ScenesArgs,
    /// Size of the pictures; `given` takes that of the cameras file
    #[arg(long, value_name = "WxH", default_value = "192x108", value_parser = parse_size)]
    size: Size,
    /// Frames per film with a least PSNR
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u16).range(2..=10_000))]
    frames: u16,
    /// Frames per film with a budget
    #[arg(long, value_name = "N", default_value_t = 120, value_parser = clap::value_parser!(u16).range(2..=10_000))]
    budget_frames: u16,
    /// Least PSNR of the films, one film each, dB
    #[arg(long, value_name = "DB,..", default_value = "35,43,46,60,70,78,85,110", value_delimiter = ',', value_parser = above_zero)]
    psnrs: Vec<f64>,
    /// Budgets of the films, one film each, over the time of forecast and film at `draft` without load
    #[arg(long, value_name = "SHARE,..", default_value = "1.3,1.7,2.2,3", value_delimiter = ',', value_parser = above_zero)]
    budgets: Vec<f64>,
    /// Keep the films of promises.csv in the folder of -o, and make the others
    #[arg(long, requires = "output")]
    resume: bool,
    #[command(flatten)]
    folder: BenchFolder,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        self.scenes.check_names()?;
        let names = if self.resume { &[][..] } else { &[CSV, TABLE][..] };
        let scenes = self.scenes.begin((&self.folder, names), &self.picture, report::CSV_HEADER)?;
        let mut rows = self.earlier_rows()?;
        for (path, file) in &scenes {
            self.bench_scene(path, file.as_ref(), &mut rows)?;
        }
        self.folder.rewrite(TABLE, &report::to_table(&rows))?;
        let num_broken = rows.iter().filter(|row| row.is_broken()).count();
        console::note(&format!("{} films, {num_broken} broken promises", rows.len()));
        if num_broken == 0 { Ok(()) } else { Err(Failure::fault(&format!("{num_broken} broken promises"))) }
    }

    /// The films of an earlier run, with --resume.
    fn earlier_rows(&self) -> Result<Vec<PromiseRow>, Failure> {
        let text = if self.resume { self.folder.read(CSV)? } else { None };
        let Some(text) = text else { return Ok(Vec::new()) };
        report::from_csv(&text).ok_or_else(|| {
            Failure::usage(
                format!("{CSV}: found other columns, expected {}", report::CSV_HEADER.trim()),
                "leave --resume out",
            )
        })
    }

    /// Makes the films of a scene that are not in `rows`, and adds them.
    fn bench_scene(&self, path: &Path, file: Option<&StillCameras>, rows: &mut Vec<PromiseRow>) -> Result<(), Failure> {
        let films: Vec<(PlannedFilm, usize)> = self.films(&scene_name(path));
        let is_made = |film: &PlannedFilm| rows.iter().any(|row| row.is_of(&film.names));
        let missing: Vec<_> = films.into_iter().filter(|(film, _)| !is_made(film)).collect();
        if missing.is_empty() {
            return Ok(());
        }
        let scene = self.scenes.options.open(path)?.scene;
        let views = views(&scene, file)?;
        let renderer = Renderer::new(&scene.gaussians);
        let settings = FilmSettings {
            render: settings(&self.picture, &scene, Quality::Standard, file),
            ..FilmSettings::default()
        };
        for (film, idx) in missing {
            let (_, camera) = views.get(idx % views.len().max(1)).ok_or_else(|| Failure::fault("no camera"))?;
            let frames = if film.budget.is_some() { self.budget_frames } else { self.frames };
            let shot = travel(&scene, &resized(camera, self.size), usize::from(frames), idx);
            let promised = PromisedFilm { renderer: &renderer, shot: &shot, settings: &settings };
            let row = if let Some((share, load)) = film.budget {
                let budget = Duration::from_secs_f64(share * draft_secs(&renderer, &shot, &settings)?);
                let requirements = Requirements { budget: Some(budget), ..Requirements::default() };
                promised.with_budget(&film.names, requirements, load)?
            } else {
                let requirements = Requirements { min_psnr_db: film.min_psnr_db, ..Requirements::default() };
                promised.with_psnr(&film.names, requirements)?
            };
            // A closed stdout is reported at the end.
            let _ = console::data(&report::csv_line(&row));
            rows.push(row);
            self.folder.rewrite(CSV, &report::to_csv(rows))?;
        }
        Ok(())
    }

    /// The films of a scene, each with a number that chooses its view and its move.
    fn films(&self, scene: &str) -> Vec<(PlannedFilm, usize)> {
        let size = self.size.map_or_else(|| "given".to_owned(), |[width, height]| format!("{width}x{height}"));
        let names = |promise: &str, wanted: String, load: &str, frames: u16| {
            let settings = format!("{size} {frames} frames {}", self.picture.given()).trim_end().to_owned();
            [scene.to_owned(), promise.to_owned(), wanted, load.to_owned(), settings]
        };
        let with_psnr = self.psnrs.iter().map(|least| PlannedFilm {
            names: names("min-psnr", format!("{least} dB"), "none", self.frames),
            min_psnr_db: Some(*least),
            budget: None,
        });
        let with_budget = self.budgets.iter().enumerate().map(|(idx, share)| {
            let load = if idx % 2 == 0 { LoadTime::Throughout } else { LoadTime::FromFirstFrame };
            PlannedFilm {
                names: names("budget", format!("{share} x draft"), load.name(), self.budget_frames),
                min_psnr_db: None,
                budget: Some((*share, load)),
            }
        });
        let numbered = with_psnr.zip(0..).chain(with_budget.zip(0..));
        numbered.collect()
    }
}

/// A film of the bench.
struct PlannedFilm {
    names: Film,
    min_psnr_db: Option<f64>,
    /// Over the time of forecast and film at `draft`, and when another process takes a core.
    budget: Option<(f64, LoadTime)>,
}

fn above_zero(text: &str) -> Result<f64, String> {
    let found = text.parse().ok().filter(|value: &f64| *value > 0.0 && *value <= 1e6);
    found.ok_or_else(|| "expected a number above 0, at most 1000000".to_owned())
}
