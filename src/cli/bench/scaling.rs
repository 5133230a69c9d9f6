use crate::cli::outputs::BenchFolder;
use std::process::Command;
use strum::VariantArray;

use crate::cli::console;
use crate::cli::failure::{Exit, Failure};
use crate::cli::scene_args::{PictureArgs, SceneArgs};
use cinesplat::render::Quality;
use cinesplat_bench::scaling::{self, Growth, ScalingCase};

/// Measure how time and memory grow with Gaussians, pixels and layers
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench scaling synth:tabletop:1 -o bench
Prints one CSV line per case. Each case is measured in a process of its own. -o keeps the CSV and a plot.")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Timed runs per picture, after one warm-up run
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
    /// Skip cases with more Gaussians, pixel rows or layers than this [default: none]
    #[arg(long, value_name = "N", default_value_t = u64::MAX, hide_default_value = true)]
    most: u64,
    #[command(flatten)]
    folder: BenchFolder,
    /// Measure one case in this process
    #[arg(long, value_name = "GROWTH:VALUE", hide = true, value_parser = parse_case)]
    case: Option<ScalingCase>,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        if let Some(case) = self.case {
            return self.measure(case);
        }
        self.folder.prepare(&["scaling.csv", "scaling.svg"])?;
        let mut csv = scaling::CSV_HEADER.to_owned();
        console::data(&csv)?;
        for &growth in Growth::VARIANTS {
            for value in growth.values().iter().filter(|value| **value <= self.most) {
                let line = in_own_process(growth, *value)?;
                console::data(&line)?;
                csv.push_str(&line);
            }
        }
        self.folder.write("scaling.csv", &csv)?;
        self.folder.write("scaling.svg", &scaling::scaling_svg(&csv))
    }

    fn measure(&self, case: ScalingCase) -> Result<(), Failure> {
        self.picture.bound_threads()?;
        let scene = self.scene.open()?.scene;
        let settings = self.picture.settings(&scene, Quality::Standard, None, None);
        let row = scaling::measure(case, &scene.gaussians, &settings, usize::from(self.runs))?;
        console::data(&scaling::csv_line(&row))
    }
}

/// The CSV line of one case, measured by a new process of this program with the same arguments.
fn in_own_process(growth: Growth, value: u64) -> Result<String, Failure> {
    let program = std::env::current_exe().map_err(|error| Failure::io("cinesplat", &error))?;
    let case = format!("--case={}:{value}", growth.as_ref());
    let ran = Command::new(program).args(std::env::args_os().skip(1)).arg(case).output();
    let ran = ran.map_err(|error| Failure::io("cinesplat", &error))?;
    if ran.status.success() {
        return Ok(String::from_utf8_lossy(&ran.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&ran.stderr).trim().replace('\n', "; ");
    let exit_code = ran.status.code().and_then(|code| u8::try_from(code).ok());
    let exit = exit_code.and_then(Exit::from_repr).unwrap_or(Exit::Fault);
    Err(Failure::new(
        "BENCH-CASE",
        format!("{} {value}: {said}", growth.as_ref()),
        "the message quotes the error of the case",
        exit,
    ))
}

fn parse_case(text: &str) -> Result<ScalingCase, String> {
    let read = text.split_once(':').and_then(|(name, value)| {
        let growth = name.parse().ok()?;
        Some(ScalingCase { growth, value: value.parse().ok()? })
    });
    read.ok_or_else(|| "expected GROWTH:VALUE".to_owned())
}
