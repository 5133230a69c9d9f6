use super::outputs::Overwrite;
use std::path::PathBuf;

use super::choice::choice;
use super::console;
use super::failure::Failure;
use cinesplat::export::{self, Format, shot_json};

/// Makes a shot of another program's camera path.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat import camera_path.json -o shot.json
  cinesplat import poses.txt --from kitti -o shot.json")]
pub(super) struct Args {
    /// The camera path, or a folder with a COLMAP model
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The shot
    #[arg(short, long, value_name = "SHOT.JSON")]
    output: PathBuf,
    /// The format, instead of what the content says
    #[arg(long, value_name = "FORMAT", value_parser = choice::<Format>())]
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
