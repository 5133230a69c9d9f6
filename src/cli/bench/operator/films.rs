use std::path::PathBuf;

use super::cases::{CaseArgs, PromptCase};
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
        let (cases, mut director) = self.cases.open()?;
        outputs::create_folder(&self.output)?;
        let files = |case: &PromptCase| [self.file(case, "path.json"), self.file(case, "shot.json")];
        cases.iter().flat_map(files).try_for_each(|path| self.overwrite.check(&path))?;
        for case in &cases {
            let shot = director.direct(case, self.solve.level)?;
            let path = self.file(case, "path.json");
            let settings = ExportSettings { fps: Some(self.fps), ..ExportSettings::default() };
            export::write(&path, Format::Nerfstudio, &shot, &settings, self.overwrite.existing())?;
            let file = self.file(case, "shot.json");
            self.overwrite.write(&file, shot_json::write(&shot).as_bytes())?;
            let unmet = shot.report.iter().filter(|line| !line.met).count();
            console::note(&format!("{}: {:.1} s, {unmet} lines of the report not met", case.id, shot.duration_secs));
        }
        Ok(())
    }

    fn file(&self, case: &PromptCase, ending: &str) -> PathBuf {
        self.output.join(format!("{}.{ending}", case.id))
    }
}
