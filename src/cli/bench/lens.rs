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
    AUTO_CSV_HEADER, AUTO_FLOORS, AutoShot, COST_CSV_HEADER, CostRow, LENS_CASES, LENS_CSV_HEADER, LensBench,
    LensMethod, LensRow, lens_csv_line, lens_row_of, lens_svg, measure_auto, measure_costs,
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
-o keeps a CSV per part and a plot, after every measurement: `--resume` goes on from there.")]
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
    /// Keep the rows that the folder holds, and measure only what they lack
    #[arg(long, requires_all = ["output", "overwrite"])]
    resume: bool,
    #[command(flatten)]
    folder: BenchFolder,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        self.scenes.check_names()?;
        let mut files = Vec::new();
        for part in &self.parts {
            files.extend_from_slice(part.files());
        }
        let scenes = self.scenes.begin((&self.folder, &files), &self.picture, "")?;
        let table = |part: &Part| Table::of(*part, &self.folder, self.resume);
        let mut tables = self.parts.iter().map(table).collect::<Result<Vec<_>, _>>()?;
        for (path, file) in &scenes {
            let scene = self.scenes.options.open(path)?.scene;
            let cameras = views(&scene, file.as_ref())?;
            let renderer = Renderer::new(&scene.gaussians);
            let settings = settings(&self.picture, &scene, Quality::Standard, file.as_ref());
            let bench = LensBench { renderer: &renderer, settings, num_repeats: usize::from(self.runs) };
            for (name, camera) in cameras.iter().take(usize::from(self.max_cameras)) {
                let view = (scene_name(path), name.replace(',', " "), resized(camera, self.size));
                tables.iter_mut().try_for_each(|table| table.measure(&bench, &view))?;
            }
        }
        tables.iter().try_for_each(Table::write)
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
}

/// The rows of a part, which the folder holds as soon as they are measured.
struct Table<'a> {
    part: Part,
    folder: &'a BenchFolder,
    /// Lines without the header.
    lines: String,
}

impl<'a> Table<'a> {
    /// An empty table, or the one that the folder holds.
    fn of(part: Part, folder: &'a BenchFolder, resume: bool) -> Result<Self, Failure> {
        let kept = if resume { folder.read(part.files()[0])? } else { None };
        let lines = match kept.as_deref().map(|text| text.strip_prefix(part.header())) {
            None => String::new(),
            Some(Some(lines)) => lines.to_owned(),
            Some(None) => {
                let found = format!("{} has other columns", part.files()[0]);
                return Err(Failure::usage(found, "leave --resume out to measure everything again"));
            }
        };
        Ok(Self { part, folder, lines })
    }

    /// Whether a row begins with these fields.
    fn holds(&self, fields: &[&str]) -> bool {
        let start = format!("{},", fields.join(","));
        self.lines.lines().any(|line| line.starts_with(&start))
    }

    /// Adds rows.
    fn add(&mut self, lines: &str) -> Result<(), Failure> {
        let header = if self.lines.is_empty() { self.part.header() } else { "" };
        // A closed stdout is reported at the end.
        let _ = console::data(&format!("{header}{lines}"));
        self.lines.push_str(lines);
        self.write()
    }

    fn write(&self) -> Result<(), Failure> {
        self.folder.rewrite(self.part.files()[0], &format!("{}{}", self.part.header(), self.lines))?;
        if self.part != Part::Sampling {
            return Ok(());
        }
        let rows: Vec<LensRow> = self.lines.lines().filter_map(lens_row_of).collect();
        self.folder.rewrite("lens.svg", &lens_svg(&rows))
    }

    /// Measures what the table lacks of a view: the names of scene and camera, and the camera. A picture without splats has
    /// no rows.
    fn measure(
        &mut self,
        bench: &LensBench<'_>,
        (scene, name, camera): &(String, String, Camera),
    ) -> Result<(), Failure> {
        let Some(distance) = bench.focus_distance(camera)? else { return Ok(()) };
        let LensBench { renderer, settings, num_repeats } = bench;
        match self.part {
            Part::Sampling => {
                for case in LENS_CASES {
                    let mut lines = String::new();
                    let is_known = |quality: Quality, method: LensMethod, samples: Option<usize>| {
                        let samples = samples.map(|num| num.to_string());
                        let blur = case.blur_px.to_string();
                        let row = [scene, name, case.source.as_ref(), &blur, quality.as_ref(), method.as_ref()];
                        self.holds(&row.into_iter().chain(samples.as_deref()).collect::<Vec<&str>>())
                    };
                    bench.measure((camera, case), &is_known, &mut |row| {
                        lines += &lens_csv_line(&LensRow { scene: scene.clone(), camera: name.clone(), ..row });
                    })?;
                    if !lines.is_empty() {
                        self.add(&lines)?;
                    }
                }
            }
            Part::Auto => {
                for (shot, floor) in AutoShot::VARIANTS.iter().flat_map(|shot| AUTO_FLOORS.map(|floor| (shot, floor))) {
                    if !self.holds(&[scene, name, shot.as_ref(), floor.0.as_ref()]) {
                        let mut row = measure_auto(renderer, settings, (camera, distance), *shot, floor)?;
                        (row.scene, row.camera) = (scene.clone(), name.clone());
                        self.add(&row.csv_line())?;
                    }
                }
            }
            Part::Costs => {
                if !self.holds(&[scene, name]) {
                    let mut rows = measure_costs(renderer, settings, (camera, distance), *num_repeats)?;
                    rows.iter_mut().for_each(|row| (row.scene, row.camera) = (scene.clone(), name.clone()));
                    self.add(&rows.iter().map(CostRow::csv_line).collect::<String>())?;
                }
            }
        }
        Ok(())
    }
}
