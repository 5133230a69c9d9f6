use std::path::{Path, PathBuf};

use super::flow_facts::{self, FlowFacts};
use crate::cli::bench::cases::{CaseArgs, CaseDirector, PromptCase};
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::outputs::{self, Overwrite};
use crate::cli::shot_args::{self, SolveArgs};
use cinesplat::export::{self, ExportSettings, Format, shot_json};
use cinesplat::trajectory::Shot;

/// Write the camera path and the shot of every case, and measure its stops, turns and speed on the screen
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    cases: CaseArgs,
    #[command(flatten)]
    solve: SolveArgs,
    /// Frames per second of the paths
    #[arg(long, value_name = "FPS", default_value_t = 10.0)]
    fps: f64,
    /// Measure the shots ID.shot.json of this folder; plan and write none
    #[arg(long, value_name = "DIR")]
    shots: Option<PathBuf>,
    /// Folder for ID.path.json (nerfstudio) and ID.shot.json, created where it is missing
    #[arg(short, long, value_name = "DIR", required_unless_present = "shots", help_heading = crate::cli::heading::OUTPUT)]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let (cases, mut director) = self.cases.open()?;
        if let Some(folder) = self.output.as_deref().filter(|_| self.shots.is_none()) {
            outputs::create_folder(folder)?;
            let files = |case: &PromptCase| ["path.json", "shot.json"].map(|ending| file(folder, case, ending));
            cases.iter().flat_map(files).try_for_each(|path| self.overwrite.check(&path))?;
        }
        console::data(flow_facts::CSV_HEADER)?;
        let mut all = Vec::new();
        for case in &cases {
            let shot = match &self.shots {
                Some(folder) => shot_args::read_file(&file(folder, case, "shot.json"), &[])?,
                None => match self.planned(case, &mut director) {
                    Ok(shot) => shot,
                    // A prompt that is refused has no film; the others do.
                    Err(failure) => {
                        console::note(&format!("{}: no film", case.id));
                        console::error(&failure);
                        continue;
                    }
                },
            };
            let facts = FlowFacts::of(&shot, director.scene_of(case)?.objects())?;
            console::data(&facts.csv_line(&case.id))?;
            all.push(facts);
        }
        console::note(&flow_facts::summary(&all));
        Ok(())
    }

    /// Plans a case and writes its files.
    fn planned(&self, case: &PromptCase, director: &mut CaseDirector) -> Result<Shot, Failure> {
        let shot = director.direct(case, self.solve.level)?;
        let Some(folder) = &self.output else { return Ok(shot) };
        let path = file(folder, case, "path.json");
        let settings = ExportSettings { fps: Some(self.fps), ..ExportSettings::default() };
        export::write(&path, Format::Nerfstudio, &shot, &settings, self.overwrite.existing())?;
        self.overwrite.write(&file(folder, case, "shot.json"), shot_json::write(&shot).as_bytes())?;
        let unmet = shot.report.iter().filter(|line| !line.met).count();
        console::note(&format!("{}: {:.1} s, {unmet} lines of the report not met", case.id, shot.duration_secs));
        Ok(shot)
    }
}

fn file(folder: &Path, case: &PromptCase, ending: &str) -> PathBuf {
    folder.join(format!("{}.{ending}", case.id))
}
