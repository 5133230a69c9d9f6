mod measure;
mod report;

use std::path::Path;

use super::films::{TRAVEL_FRAC, dolly};
use super::scenes::{ScenesArgs, Size, film_view, parse_size, resized, scene_name, settings};
use crate::cli::choice::choice;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::outputs::BenchFolder;
use crate::cli::scene_args::PictureArgs;
use cinesplat::export::cameras_json::StillCameras;
use cinesplat::render::Quality;
use cinesplat::video::X264Preset;
use measure::{EncoderCase, EncoderRow};

/// Measure the presets of the H.264 encoder: time, bit rate and SSIM
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench encoder room.spz synth:demo --cameras room.cameras.json --cameras auto -o bench
Films a dolly along the view axis of the first camera, as `bench films` does, and encodes its pictures with every preset
at several rate factors. One CSV line per measurement; the steps `render` and `convert` are what a film does besides.
SSIM is that of the luma of decoded pictures, every tenth one. -o keeps encoder.csv, a table and a plot with the bit rate
that each preset needs for the SSIM that `medium` has at rate factor 18.")]
pub(crate) struct Args {
    #[command(flatten)]
    scenes: ScenesArgs,
    /// Size of the pictures; `given` takes that of the cameras file
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: Size,
    /// Frames per film
    #[arg(long, value_name = "N", default_value_t = 90, value_parser = clap::value_parser!(u16).range(6..=1000))]
    frames: u16,
    /// Presets to measure
    #[arg(
        long, value_name = "PRESET,..", default_value = "ultrafast,superfast,veryfast,faster,fast,medium,slow,veryslow",
        value_delimiter = ',', value_parser = choice::<X264Preset>()
    )]
    presets: Vec<X264Preset>,
    /// Rate factors to measure
    #[arg(long, value_name = "N,..", default_value = "14,18,22", value_delimiter = ',')]
    crf: Vec<u8>,
    #[command(flatten)]
    folder: BenchFolder,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let files = (&self.folder, &["encoder.csv", "encoder.md", "encoder.svg"][..]);
        let scenes = self.scenes.begin(files, &self.picture, report::CSV_HEADER)?;
        let mut rows = Vec::new();
        for (path, file) in &scenes {
            self.bench_scene(path, file.as_ref(), &mut rows)?;
        }
        self.folder.write("encoder.csv", &report::to_csv(&rows))?;
        self.folder.write("encoder.md", &report::to_table(&rows))?;
        self.folder.write("encoder.svg", &report::to_svg(&rows))
    }

    fn bench_scene(&self, path: &Path, file: Option<&StillCameras>, rows: &mut Vec<EncoderRow>) -> Result<(), Failure> {
        let scene = self.scenes.options.open(path)?.scene;
        let camera = film_view(&scene, file)?;
        let render = settings(&self.picture, &scene, Quality::Standard, file);
        let travel = TRAVEL_FRAC * scene.bounds().size();
        let shot = dolly(&scene, &resized(&camera, self.size), travel, usize::from(self.frames));
        let mut report = |row: EncoderRow| {
            // A closed stdout is reported at the end.
            let _ = console::data(&report::csv_line(&row));
            rows.push(row);
        };
        let case = EncoderCase::film(&scene_name(path), (&scene, &render), &shot, &mut report)?;
        for &preset in &self.presets {
            self.crf.iter().try_for_each(|&crf| {
                let _: () = report(case.encode(preset, crf)?);
                Ok::<_, Failure>(())
            })?;
        }
        Ok(())
    }
}
