use std::path::Path;

use clap::Args;

use super::failure::Failure;
use super::heading;
use cinesplat::pipeline::{self, JobSettings, JobStart, Piece};

/// How finished frames are kept until a film is whole.
#[derive(Debug, Clone, Args)]
#[allow(clippy::struct_excessive_bools, reason = "flags of a command line")]
pub(super) struct JobArgs {
    /// Start anew: throw away the finished frames of a stopped film [default: go on]
    #[arg(long, help_heading = heading::OUTPUT, hide_short_help = true)]
    pub(super) fresh: bool,
    /// Keep the frames in OUT.job when the film is whole
    #[arg(long, help_heading = heading::OUTPUT, hide_short_help = true, conflicts_with = "no_job")]
    keep_frames: bool,
    /// Keep no finished frames: a stopped film starts over
    ///
    /// Finished frames take 1.5 bytes per pixel, with opacity 8, until the film is whole.
    #[arg(long, help_heading = heading::OUTPUT, hide_short_help = true, conflicts_with_all = ["fresh", "part"])]
    pub(super) no_job: bool,
    /// Only render the frames of --frames into OUT.job, beside other programs that do the same
    ///
    /// With I/N, the I-th of N programs: each begins at a place of its own and then helps the others. The same line without
    /// --part and --frames makes the film when all frames are there. `cinesplat farm` does both.
    #[arg(long, value_name = "I/N", num_args = 0..=1, require_equals = true, default_missing_value = "1/1", help_heading = heading::OUTPUT, hide_short_help = true, conflicts_with_all = ["fresh", "budget", "min_psnr", "sheet", "prompts"])]
    pub(super) part: Option<Piece>,
}

impl JobArgs {
    /// Settings of the job folder; `None` = none is used.
    pub(super) fn settings(&self, inputs: Vec<(&'static str, String)>) -> Option<JobSettings> {
        let start = if self.fresh { JobStart::Fresh } else { JobStart::GoOn };
        (!self.no_job).then_some(JobSettings { start, keeps_frames: self.keep_frames, inputs })
    }

    /// Takes the frames that are there, whatever was asked for.
    pub(super) fn go_on(&mut self) {
        self.fresh = false;
    }

    /// Whether there are frames of an earlier run to go on from.
    pub(super) fn goes_on(&self, output: &Path) -> bool {
        !self.no_job && !self.fresh && pipeline::has_job(output)
    }

    /// Checks before any work that frames can be kept.
    pub(super) fn check(&self, output: &Path) -> Result<(), Failure> {
        if self.no_job || self.part.is_some() { Ok(()) } else { Ok(pipeline::check_job(output)?) }
    }
}
