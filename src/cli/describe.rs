use std::path::PathBuf;

use super::choice::choice;
use super::eval::parse_subject;
use super::failure::Failure;
use super::scene_args::parse_vector;
use super::{console, eval_paths, heading};
use cinesplat::evaluation::{Description, SubjectSphere, Trajectory};
use cinesplat::export::Format;
use glam::DVec3;

/// Say what a camera does, from its path alone
///
/// Prints a sentence that `plan` and `read` understand, and a table of the moves with their times, amounts, heights of
/// view and lenses.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat describe shot.json
  cinesplat describe path.tum --up 0,0,1 --json
  cinesplat describe shot.json --subject 0,1,-2,0.4")]
pub(super) struct Args {
    /// Camera path: a shot or any file that `import` reads
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Format to read [default: by the content of the file]
    #[arg(long, value_name = "FORMAT", hide_possible_values = true, value_parser = choice::<Format>())]
    from: Option<Format>,
    /// World up [default: the file's, else the mean up of the cameras]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    up: Option<DVec3>,
    /// Also tell the size of a sphere in the frame: center and radius, scene units
    #[arg(long, value_name = "X,Y,Z,R", value_parser = parse_subject, allow_hyphen_values = true)]
    subject: Option<SubjectSphere>,
    /// Print JSON
    #[arg(long, help_heading = heading::OUTPUT)]
    json: bool,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let track = eval_paths::read(&self.file, self.from)?;
        let cuts: Vec<usize> =
            track.frames.iter().enumerate().filter(|(_, frame)| frame.cut).map(|(idx, _)| idx).collect();
        let mut path = Trajectory::from(&track);
        if !track.timed {
            console::note(&format!("note: {}: no times, 30 poses per second are assumed", self.file.display()));
            path.times_secs = Some(track.frames.iter().map(|frame| frame.time_secs).collect());
        }
        path.up = self.up.and_then(DVec3::try_normalize).or(path.up);
        let description = Description::new(&path, &cuts, self.subject);
        if self.json {
            return console::data(&description.to_json());
        }
        console::text(&format!("{}\n\n{}", description.sentence(), description.table()))
    }
}
