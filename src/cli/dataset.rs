use std::path::PathBuf;
use std::time::Instant;

use super::choice::choice;
use super::console;
use super::failure::Failure;
use cinesplat::operator::SolveLevel;
use cinesplat::synth::SynthSettings;
use cinesplat::training::{DatasetSettings, write_dataset};

/// Generate training data for the director's network
///
/// Writes shards of shots as JSON lines: shots that the operator finds for sampled prompts in generated scenes.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat dataset -o shots --scenes 256 --shots 24
Existing shards are kept: the same command resumes an interrupted run.")]
pub(super) struct Args {
    /// Folder for the shards
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Number of scenes
    #[arg(long, value_name = "N", default_value_t = DatasetSettings::default().num_scenes)]
    scenes: u64,
    /// Shots tried per scene
    #[arg(long, value_name = "N", default_value_t = DatasetSettings::default().shots_per_scene)]
    shots: u64,
    /// Number of Gaussians per scene as a share of the full number
    #[arg(long, value_name = "FRAC", default_value_t = DatasetSettings::default().detail, value_parser = parse_detail)]
    detail: f64,
    /// Effort of the camera search
    #[arg(long, value_name = "EFFORT", default_value = "fast", value_parser = choice::<SolveLevel>())]
    solve: SolveLevel,
    /// Seed of scenes and prompts
    #[arg(long, value_name = "N", default_value_t = DatasetSettings::default().seed)]
    seed: u64,
    /// Threads, each of which writes its own shards
    #[arg(long, value_name = "N", default_value_t = DatasetSettings::default().threads)]
    threads: usize,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let settings = DatasetSettings {
            seed: self.seed,
            num_scenes: self.scenes,
            shots_per_scene: self.shots,
            detail: self.detail,
            solve: self.solve,
            threads: self.threads,
        };
        let start = Instant::now();
        let summary = write_dataset(&settings, &self.output, &|done, total| {
            let left_mins = start.elapsed().as_secs_f64() / done as f64 * total.saturating_sub(done) as f64 / 60.0;
            console::note(&format!("scene {done}/{total}, {left_mins:.0} min left"));
        })?;
        console::note(&format!(
            "{}: {} shots in {} scenes; {} dropped (not fully solved, or too long); {} shards kept",
            self.output.display(),
            summary.num_shots,
            summary.num_scenes,
            summary.num_dropped,
            summary.num_shards_kept
        ));
        Ok(())
    }
}

fn parse_detail(text: &str) -> Result<f64, String> {
    let range = SynthSettings::DETAIL_RANGE;
    let detail = text.parse().ok().filter(|detail| range.contains(detail));
    detail.ok_or_else(|| format!("expected {} to {}", range.start(), range.end()))
}
