use super::choice::choice;
use super::outputs::Overwrite;
use std::path::PathBuf;
use strum::VariantNames;

use super::failure::Failure;
use super::{console, outputs};
use cinesplat::export::{self, Content, ExportSettings, Format, Layout, shot_json};
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
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let format = self.to.or_else(|| Format::from_path(&self.output)).ok_or_else(|| {
            let found = format!("{}: the name leaves the format open, expected --to FORMAT", self.output.display());
            Failure::usage(found, format!("add --to with one of {}", <Format as VariantNames>::VARIANTS.join(" ")))
        })?;
        let layout = Layout::of_path(&self.output);
        let files = export::output_files(&self.output, format, layout);
        if outputs::is_stdout(&self.output) && files.len() > 1 {
            let help = "name a folder, or choose another format with --to";
            return Err(Failure::usage(format!("{format} is {} files, standard output is one", files.len()), help));
        }
        files.iter().try_for_each(|file| self.overwrite.check(file))?;
        let text = outputs::read_text(&self.shot)?;
        let shot = shot_json::read(&text).map_err(|error| Failure::from(error).in_file(&self.shot))?;
        let shot = if self.retime { retimed(&shot) } else { shot };
        let content = if self.keyframes { Content::Keyframes } else { Content::Sampled };
        let settings = ExportSettings { content, fps: self.fps, layout };
        let encoded = export::encode(format, &shot, &settings);
        let encoded = encoded.map_err(|error| Failure::from(error).in_file(&self.shot))?;
        match encoded.files.as_slice() {
            [(_, bytes)] => self.overwrite.write(&self.output, bytes)?,
            _ => encoded.write(&self.output, self.overwrite.existing())?,
        }
        for line in &encoded.losses {
            console::note(&format!("warning: {line}"));
        }
        console::note(&format!("{}: {}", self.output.display(), format));
        Ok(())
    }
}
