use super::outputs::Overwrite;
use std::path::PathBuf;

use super::choice::choice;
use super::failure::Failure;
use super::{console, formats, heading};
use cinesplat::export::{self, Format, shot_json};

const EXAMPLES: &str = "\
Examples:
  cinesplat import camera_path.json -o shot.json
  cinesplat import poses.txt --from kitti -o shot.json";

/// Turn another program's camera path into a shot
///
/// Prints a warning for everything that the file does not say and the shot assumes.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, after_long_help = formats::table_with(EXAMPLES))]
pub(super) struct Args {
    /// Camera path to read, or the folder of a COLMAP, EuRoC or nerfstudio capture
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Shot to write, or - for stdout
    #[arg(short, long, value_name = "SHOT.JSON", help_heading = heading::OUTPUT)]
    output: PathBuf,
    /// Format to read [default: by the content of the file]
    #[arg(long, value_name = "FORMAT", hide_possible_values = true, value_parser = choice::<Format>())]
    from: Option<Format>,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        self.overwrite.check(&self.output)?;
        let in_file = |error| Failure::from(error).in_file(&self.file);
        let imported = export::read(&self.file, self.from).map_err(in_file)?;
        let format = imported.format;
        let (shot, assumed) = imported.into_shot().map_err(in_file)?;
        for line in &assumed {
            console::note(&format!("warning: {line}"));
        }
        self.overwrite.write(&self.output, shot_json::write(&shot).as_bytes())?;
        let (keys, secs) = (shot.keyframes.len(), shot.duration_secs);
        console::note(&format!("{}: {keys} keys, {secs:.2} s, from {format}", self.output.display()));
        Ok(())
    }
}
