use crate::cli::outputs::BenchFolder;

use strum::VariantArray;

use super::scenes::{ScenesArgs, Size, parse_size, resized, scene_name, settings, views};
use crate::cli::choice::choice;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::scene_args::PictureArgs;
use cinesplat::geometry::Camera;
use cinesplat::render::{Quality, Renderer};
use cinesplat_bench::{
    AUTO_CSV_HEADER, AUTO_FLOORS, AutoShot, COST_CSV_HEADER, LENS_CASES, LENS_CSV_HEADER, LensBench, LensRow,
    lens_csv_line, lens_svg, measure_auto, measure_costs,
};

/// A part of the bench.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
enum Part {
    /// Motion blur and depth of field over samples, methods and presets.
    Sampling,
    /// Effects where they show against effects everywhere.
    Auto,
    /// Each effect alone.
    Costs,
}

/// Measure effects: blur over samples, methods and presets; what `auto` saves; what each effect costs
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench lens room.spz skull.sog --cameras room.cameras.json --cameras auto -o bench
Prints one CSV line per scene, camera, blur and method. PSNR is against the mean light of 256 sharp pictures at `final`.
times_plain is the median ratio to the time of the plain picture of the same quality, measured alternately, in 8 bits.
blur_px is the 99th percentile over the visible splats.
The part `auto` compares films whose effects run where they show with films in which they run on every frame: the worst
frame's PSNR, and the ratio of the times. The part `costs` is the time of each effect alone over that of the plain frame.
-o keeps a CSV per part and a plot.")]
pub(crate) struct Args {
    #[command(flatten)]
    scenes: ScenesArgs,
    /// Size of the pictures; `given` takes that of the cameras file
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: Size,
    /// Largest number of cameras per scene
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    max_cameras: u16,
    /// What is measured
    #[arg(long, value_name = "PART", value_delimiter = ',', default_value = "sampling,auto,costs", value_parser = choice::<Part>())]
    parts: Vec<Part>,
    /// Timed runs per row, after one warm-up run
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
    #[command(flatten)]
    folder: BenchFolder,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let mut files = Vec::new();
        for part in &self.parts {
            files.extend_from_slice(part.files());
        }
        let scenes = self.scenes.begin((&self.folder, &files), &self.picture, "")?;
        let mut tables = Part::VARIANTS.iter().map(|_| String::new()).collect::<Vec<_>>();
        let mut rows: Vec<LensRow> = Vec::new();
        for (path, file) in &scenes {
            let scene = self.scenes.options.open(path)?.scene;
            let cameras = views(&scene, file.as_ref())?;
            let renderer = Renderer::new(&scene.gaussians);
            let settings = settings(&self.picture, &scene, Quality::Standard, file.as_ref());
            let bench = LensBench { renderer: &renderer, settings, num_repeats: usize::from(self.runs) };
            for (name, camera) in cameras.iter().take(usize::from(self.max_cameras)) {
                let view = (scene_name(path), name.clone(), resized(camera, self.size));
                for part in &self.parts {
                    let table = &mut tables[*part as usize];
                    part.measure(&bench, &view, (table, &mut rows))?;
                }
            }
        }
        for part in &self.parts {
            self.folder.write(part.files()[0], &format!("{}{}", part.header(), tables[*part as usize]))?;
        }
        if self.parts.contains(&Part::Sampling) { self.folder.write("lens.svg", &lens_svg(&rows)) } else { Ok(()) }
    }
}

impl Part {
    fn files(self) -> &'static [&'static str] {
        match self {
            Self::Sampling => &["lens.csv", "lens.svg"],
            Self::Auto => &["lens-auto.csv"],
            Self::Costs => &["lens-costs.csv"],
        }
    }

    fn header(self) -> &'static str {
        match self {
            Self::Sampling => LENS_CSV_HEADER,
            Self::Auto => AUTO_CSV_HEADER,
            Self::Costs => COST_CSV_HEADER,
        }
    }

    /// Measures the part in a view: the names of scene and camera, and the camera. Adds its lines to the table, which has
    /// none for a picture without splats.
    fn measure(
        self,
        bench: &LensBench<'_>,
        (scene, name, camera): &(String, String, Camera),
        (table, rows): (&mut String, &mut Vec<LensRow>),
    ) -> Result<(), Failure> {
        let mut add = |line: &str| {
            let header = if table.is_empty() { self.header() } else { "" };
            // A closed stdout is reported at the end.
            let _ = console::data(&format!("{header}{line}"));
            table.push_str(line);
        };
        let Some(distance) = bench.focus_distance(camera)? else { return Ok(()) };
        let LensBench { renderer, settings, num_repeats } = bench;
        match self {
            Self::Sampling => {
                for case in LENS_CASES {
                    bench.measure(camera, case, &mut |row| {
                        let row = LensRow { scene: scene.clone(), camera: name.clone(), ..row };
                        add(&lens_csv_line(&row));
                        rows.push(row);
                    })?;
                }
            }
            Self::Auto => {
                for (shot, floor) in AutoShot::VARIANTS.iter().flat_map(|shot| AUTO_FLOORS.map(|floor| (shot, floor))) {
                    let mut row = measure_auto(renderer, settings, (camera, distance), *shot, floor)?;
                    row.scene.clone_from(scene);
                    add(&row.csv_line());
                }
            }
            Self::Costs => {
                for mut row in measure_costs(renderer, settings, (camera, distance), *num_repeats)? {
                    row.scene.clone_from(scene);
                    add(&row.csv_line());
                }
            }
        }
        Ok(())
    }
}
