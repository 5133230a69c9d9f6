use super::choice::choice;
use std::path::PathBuf;
use strum::VariantNames;

use super::failure::Failure;
use super::{console, outputs};
use cinesplat::export::{self, Content, ExportSettings, Format, shot_json};
use cinesplat::trajectory::retimed;

/// Writes a shot's camera path for other programs.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat export shot.json --to nerfstudio --fps 10 -o path.json
  cinesplat export shot.json -o move.blender.py --keyframes
Formats: tum kitti euroc nerfstudio transforms colmap supersplat lichtfeld gltf usd blender csv log shot.")]
pub(super) struct Args {
    /// The shot
    #[arg(value_name = "SHOT.JSON")]
    shot: PathBuf,
    /// The file, or the folder of a COLMAP model; its name tells the format where --to does not
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// The format
    #[arg(long, value_name = "FORMAT", value_parser = choice::<Format>())]
    to: Option<Format>,
    /// Frames a second, instead of the shot's
    #[arg(long, value_name = "F")]
    fps: Option<f64>,
    /// Writes the keyframes instead of every frame
    #[arg(long)]
    keyframes: bool,
    /// Moves the inner keys in time so that the camera cruises at even speed
    #[arg(long)]
    retime: bool,
    /// Replaces a file that is already there
    #[arg(long)]
    overwrite: bool,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let format = self.to.or_else(|| Format::from_path(&self.output)).ok_or_else(|| {
            let found = format!("{}: the name leaves the format open, expected --to FORMAT", self.output.display());
            Failure::usage(found, format!("add --to with one of {}", <Format as VariantNames>::VARIANTS.join(" ")))
        })?;
        if !(format == Format::Colmap && (self.output.is_dir() || !self.output.exists())) {
            outputs::check_new(&self.output, self.overwrite)?;
        }
        let text = outputs::read_text(&self.shot)?;
        let shot = shot_json::read(&text).map_err(|error| Failure::from(error).in_file(&self.shot))?;
        let shot = if self.retime { retimed(&shot) } else { shot };
        let content = if self.keyframes { Content::Keyframes } else { Content::Sampled };
        let settings = ExportSettings { content, fps: self.fps };
        let lost = export::write(&self.output, format, &shot, &settings);
        let lost = lost.map_err(|error| Failure::from(error).in_file(&self.shot))?;
        for line in &lost {
            console::note(&format!("warning: {line}"));
        }
        console::note(&format!("{}: {}", self.output.display(), format.as_ref()));
        Ok(())
    }
}
