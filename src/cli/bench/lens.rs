use crate::cli::outputs::BenchFolder;

use super::scenes::{ScenesArgs, own_views, parse_size, resized, scene_name, settings};
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::scene_args::PictureArgs;
use cinesplat::render::{Quality, Renderer};
use cinesplat_bench::{LENS_CASES, LENS_CSV_HEADER, LensBench, LensRow, lens_csv_line, lens_svg};

/// Width and height in pixels; `None` = those of the cameras file. A name of its own, because an `Option` would make the
/// flag optional.
type SizeOrGiven = Option<[u32; 2]>;

/// Measure motion blur and depth of field: PSNR and time over samples, methods and presets
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench lens room.spz skull.sog --cameras room.cameras.json --cameras auto -o bench
Prints one CSV line per scene, camera, blur and method. PSNR is against the mean light of 256 sharp pictures at `final`.
times_plain is the median ratio to the time of the plain picture of the same quality, measured alternately, in 8 bits.
blur_px is the 99th percentile over the visible splats. -o keeps the CSV and a plot.")]
pub(crate) struct Args {
    #[command(flatten)]
    scenes: ScenesArgs,
    /// Size of the pictures; `given` takes that of the cameras file
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: SizeOrGiven,
    /// Largest number of cameras per scene
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    max_cameras: u16,
    /// Timed runs per row, after one warm-up run
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
    #[command(flatten)]
    folder: BenchFolder,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let files = (&self.folder, &["lens.csv", "lens.svg"][..]);
        let scenes = self.scenes.begin(files, &self.picture, LENS_CSV_HEADER)?;
        let mut rows: Vec<LensRow> = Vec::new();
        for (path, file) in &scenes {
            let scene = self.scenes.options.open(path)?.scene;
            let cameras = match file {
                Some(file) => file.cameras.iter().map(|named| (named.name.clone(), named.camera)).collect(),
                None => own_views(&scene)?,
            };
            let renderer = Renderer::new(&scene.gaussians);
            let settings = settings(&self.picture, &scene, Quality::Standard, file.as_ref());
            let bench = LensBench { renderer: &renderer, settings, num_repeats: usize::from(self.runs) };
            for (name, camera) in cameras.iter().take(usize::from(self.max_cameras)) {
                let camera = resized(camera, self.size);
                for case in LENS_CASES {
                    bench.measure(&camera, case, &mut |row| {
                        let row = LensRow { scene: scene_name(path), camera: name.clone(), ..row };
                        // A closed stdout is reported at the end.
                        let _ = console::data(&lens_csv_line(&row));
                        rows.push(row);
                    })?;
                }
            }
        }
        let lines: String = rows.iter().map(lens_csv_line).collect();
        self.folder.write("lens.csv", &format!("{LENS_CSV_HEADER}{lines}"))?;
        self.folder.write("lens.svg", &lens_svg(&rows))
    }
}
