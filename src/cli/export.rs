use super::choice::choice;
use super::outputs::Overwrite;
use std::path::PathBuf;
use strum::{VariantArray, VariantNames};

use super::failure::Failure;
use super::{console, formats, heading, outputs, shot_args};
use cinesplat::export::{self, Content, EncodedFiles, ExportSettings, Format, Layout};
use cinesplat::objects::{self, Object};
use cinesplat::trajectory::retimed;

const EXAMPLES: &str = "\
Examples:
  cinesplat export shot.json --to nerfstudio --fps 10 -o path.json
  cinesplat export shot.json -o move.blender.py --keyframes
  cinesplat export shot.json --to tum -o - | less";

/// Write a shot's camera path for another program
///
/// Prints a warning for everything in the shot that the format cannot hold.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, after_long_help = formats::table_with(EXAMPLES))]
pub(super) struct Args {
    /// Shot to export
    #[arg(value_name = "SHOT.JSON")]
    shot: PathBuf,
    /// File to write, a folder for COLMAP, or - for stdout
    ///
    /// The name decides the format unless --to names it.
    #[arg(short, long, value_name = "OUT", help_heading = heading::OUTPUT)]
    output: PathBuf,
    /// Format to write [default: by the name of the output]
    #[arg(long, value_name = "FORMAT", hide_possible_values = true, value_parser = choice::<Format>())]
    to: Option<Format>,
    /// Frames per second [default: the shot's]
    #[arg(long, value_name = "FPS")]
    fps: Option<f64>,
    /// Write the keyframes instead of every frame
    #[arg(long)]
    keyframes: bool,
    /// Objects that keys of the shot look at by name
    #[arg(long, value_name = "OBJECTS.JSON")]
    objects: Option<PathBuf>,
    /// Move the inner keys in time so that the camera's speed is constant
    #[arg(long)]
    retime: bool,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let format = self.to.or_else(|| Format::from_path(&self.output)).ok_or_else(|| {
            let found =
                format!("{}: the name does not determine the format, expected --to FORMAT", self.output.display());
            Failure::usage(found, format!("add --to with one of {}", <Format as VariantNames>::VARIANTS.join(" ")))
        })?;
        if !format.is_written() {
            let written =
                <Format as VariantArray>::VARIANTS.iter().filter(|format| format.is_written()).map(AsRef::as_ref);
            return Err(Failure::usage(
                format!("{format} is read and not written"),
                format!("choose one of {}", written.collect::<Vec<&str>>().join(" ")),
            ));
        }
        let layout = Layout::of_path(&self.output);
        match (outputs::is_stdout(&self.output), export::output_files(&self.output, format, layout).len()) {
            (true, 1) => {}
            (true, num_files) => {
                let found = format!("{format} needs {num_files} files, standard output holds one");
                return Err(Failure::usage(found, "name a folder, or choose another format with --to"));
            }
            (false, _) => export::check_output(&self.output, format, layout, self.overwrite.existing())?,
        }
        self.check_not_inputs(format, layout)?;
        let objects = self.objects.as_deref().map(objects::read_boxes).transpose()?.unwrap_or_default();
        // An object without a box has no place outside its scene.
        let objects: Vec<Object> = objects.into_iter().filter(|object| object.radius() > 0.0).collect();
        let shot = shot_args::read_file(&self.shot, &objects)?;
        shot_args::print_warnings(&shot);
        let shot = if self.retime { retimed(&shot) } else { shot };
        let content = if self.keyframes { Content::Keyframes } else { Content::Sampled };
        let settings = ExportSettings { content, fps: self.fps, layout };
        let encoded = export::encode(format, &shot, &settings);
        let encoded = encoded.map_err(|error| Failure::from(error).in_file(&self.shot))?;
        match &encoded.files {
            EncodedFiles::Single(bytes) => self.overwrite.write(&self.output, bytes)?,
            EncodedFiles::Folder(_) => encoded.write(&self.output, self.overwrite.existing())?,
        }
        console::warnings(&encoded.losses);
        console::note(&format!("{}: {}", self.output.display(), format));
        Ok(())
    }

    fn check_not_inputs(&self, format: Format, layout: Layout) -> Result<(), Failure> {
        let files = export::output_files(&self.output, format, layout);
        outputs::check_not_inputs(
            files.iter().map(|path| ("--output", path.as_path())),
            [("the shot", Some(self.shot.as_path())), ("the objects", self.objects.as_deref())],
        )
    }
}
