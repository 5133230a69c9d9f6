use super::outputs::Overwrite;
use std::path::{Path, PathBuf};

use glam::DVec3;

use super::choice::choice;
use super::failure::Failure;
use super::scene_args::parse_vector;
use super::shot_args::{parse_rate, parse_size};
use super::{console, formats, heading, outputs};
use cinesplat::export::{self, Format, ImportSettings, ReadSettings, shot_json};
use cinesplat::lens;

const EXAMPLES: &str = "\
Examples:
  cinesplat import camera_path.json -o shot.json
  cinesplat import poses.txt --from kitti --fps 10 -o shot.json
  cinesplat import poses.tum --size 1920x1080 --fov 40 --up 0,0,1 -o shot.json
  cinesplat import run.bag#/odom -o shot.json";

/// Turn another program's camera path into a shot
///
/// Prints a warning for everything that the file does not say and the shot assumes. Flags win over the file. The distortion of
/// the file's lens becomes the effect lens-distortion, with its principal point and its second focal length.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, after_long_help = formats::table_with(EXAMPLES))]
pub(super) struct Args {
    /// Camera path to read, or the folder of a COLMAP, EuRoC, nerfstudio or 7-Scenes capture, or RECORDING#TOPIC of ROS
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Shot to write, or - for stdout
    #[arg(short, long, value_name = "SHOT.JSON", help_heading = heading::OUTPUT)]
    output: PathBuf,
    /// Format to read [default: by the content of the file]
    #[arg(long, value_name = "FORMAT", hide_possible_values = true, value_parser = choice::<Format>())]
    from: Option<Format>,
    /// Camera to read of a file that holds several [default: the first]
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// Frames per second [default: the file's, or what its times show]
    #[arg(long, value_name = "FPS", help_heading = heading::SHOT, value_parser = parse_rate)]
    fps: Option<f64>,
    /// Frame size in pixels [default: the file's, or 1280x720]
    #[arg(long, value_name = "WxH", help_heading = heading::SHOT, value_parser = parse_size)]
    size: Option<(u32, u32)>,
    /// Vertical field of view in degrees [default: the file's, or 50]
    #[arg(long, value_name = "DEG", help_heading = heading::SHOT, value_parser = parse_fov)]
    fov: Option<f64>,
    /// World up [default: the file's]
    #[arg(long, value_name = "X,Y,Z", help_heading = heading::SHOT, value_parser = parse_vector, allow_hyphen_values = true)]
    up: Option<DVec3>,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        self.overwrite.check(&self.output)?;
        // Of a recording the name of a topic may follow.
        let file = self.file.to_string_lossy();
        let inputs =
            [&*file, file.split('#').next().unwrap_or_default()].map(|file| ("the path", Some(Path::new(file))));
        outputs::check_not_inputs([("--output", self.output.as_path())], inputs)?;
        let in_file = |error| Failure::from(error).in_file(&self.file);
        let how = ReadSettings { format: self.from, camera: self.camera.clone() };
        let imported = export::read_with(&self.file, &how).map_err(in_file)?;
        let format = imported.format;
        formats::note_doubt(&self.file, imported.doubt.as_ref());
        let settings =
            ImportSettings { fps: self.fps, size_px: self.size, fov_y_rad: self.fov.map(f64::to_radians), up: self.up };
        let (shot, assumed) = imported.into_shot(&settings).map_err(in_file)?;
        console::warnings(&assumed);
        console::file_warnings(&self.file, &lens::unknown_names(&shot.effects));
        self.overwrite.write(&self.output, shot_json::write(&shot).as_bytes())?;
        let (keys, secs) = (shot.keyframes.len(), shot.duration_secs);
        console::note(&format!("{}: {keys} keys, {secs:.2} s, from {format}", self.output.display()));
        for effect in shot.effects.iter().filter(|_| format != Format::Shot) {
            let values: Vec<String> =
                effect.settings.iter().map(|(name, value)| format!("{name} {value:.4}")).collect();
            console::note(&format!("{} for {}: {}", effect.kind, effect.because, values.join(", ")));
        }
        Ok(())
    }
}

fn parse_fov(text: &str) -> Result<f64, String> {
    let degrees = text.parse().ok().filter(|degrees: &f64| *degrees > 0.0 && *degrees < 180.0);
    degrees.ok_or_else(|| "expected degrees, above 0 and below 180".to_owned())
}
