use std::path::PathBuf;

use super::cases::CaseArgs;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::outputs::{self, Overwrite};
use crate::cli::shot_args::SolveArgs;
use cinesplat::export::{self, ExportSettings, Format, shot_json};

/// Write the camera path and the shot of every case
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    cases: CaseArgs,
    #[command(flatten)]
    solve: SolveArgs,
    /// Frames per second of the paths
    #[arg(long, value_name = "FPS", default_value_t = 10.0)]
    fps: f64,
    /// Folder for ID.path.json (nerfstudio) and ID.shot.json, created where it is missing
    #[arg(short, long, value_name = "DIR", help_heading = crate::cli::heading::OUTPUT)]
    output: PathBuf,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        outputs::create_folder(&self.output)?;
        let (cases, mut director) = self.cases.open()?;
        for case in &cases {
            let shot = director.direct(case, self.solve.level)?;
            let path = self.output.join(format!("{}.path.json", case.id));
            let settings = ExportSettings { fps: Some(self.fps), ..ExportSettings::default() };
            export::write(&path, Format::Nerfstudio, &shot, &settings, self.overwrite.existing())?;
            let file = self.output.join(format!("{}.shot.json", case.id));
            self.overwrite.write(&file, shot_json::write(&shot).as_bytes())?;
            let unmet = shot.report.iter().filter(|line| !line.met).count();
            console::note(&format!("{}: {:.1} s, {unmet} lines of the report not met", case.id, shot.duration_secs));
        }
        Ok(())
    }
}
