mod array_job;
mod local;
mod slurm;
mod waiting;
mod words;

use std::num::NonZeroU16;
use std::path::Path;

use super::failure::{Exit, Failure};
use super::interrupt::Interrupt;
use super::render::BEFORE_FRAMES;
use super::{console, heading, render, reproduce};
use cinesplat::pipeline;
use waiting::{Ended, wait_for_lost_programs};

/// Render a film with several programs over one job folder
///
/// Each program renders the next frame that no other one has. A program that is killed loses the frame that it was at, and is
/// started again. When all frames are there, the film is made here. It has the same bytes as that of `render`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat farm --slurm --parts 40 room.spz --shot shot.json -o lamp.mp4")]
pub(super) struct Args {
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    cluster: slurm::ClusterArgs,
    #[command(flatten)]
    render: render::Args,
}

/// Where the programs run.
#[derive(Debug, clap::Args)]
#[group(required = true, multiple = false)]
struct Place {
    /// On this machine: number of programs
    #[arg(long, value_name = "N", help_heading = heading::OUTPUT)]
    local: Option<NonZeroU16>,
    /// On a cluster: an array job of Slurm (--parts tasks); this folder and all inputs are on a shared disk
    ///
    /// Tasks that fail, are killed or lose their node are submitted again as long as frames get finished.
    #[arg(long, help_heading = heading::OUTPUT)]
    slurm: bool,
}

impl Args {
    /// The film, or the pattern of its pictures.
    pub(super) fn output(&self) -> &Path {
        self.render.output()
    }

    pub(super) fn run(self) -> Result<(), Failure> {
        let interrupt = Interrupt::before_work(BEFORE_FRAMES)?;
        let output = self.render.check_shared()?;
        if self.place.slurm && !self.cluster.waits_for_jobs()? {
            self.check_inputs()?;
        }
        if self.render.starts_fresh() {
            pipeline::clear_job(&output)?;
        }
        let interrupt = interrupt.begun();
        let ended = match self.place.local {
            Some(num) => local::run(usize::from(num.get()), &output, &interrupt)?,
            None => slurm::Farm::new(&self.cluster, &output)?.run(&interrupt)?,
        };
        match ended {
            Ended::Done if wait_for_lost_programs(&output, &interrupt) => self.render.run_after(interrupt),
            Ended::Done | Ended::Stopped => Err(stopped(&output)),
            Ended::LeftAlone => Ok(()),
        }
    }
}

impl Args {
    /// Says here and now what is wrong with the inputs, and not by a task in an hour.
    fn check_inputs(&self) -> Result<(), Failure> {
        match self.render.check_inputs() {
            // The machines of the cluster may have the memory that this one lacks.
            Err(failure) if failure.exit() == Exit::OverCap => {
                let said = failure.to_string();
                let reason = said.lines().next().unwrap_or_default();
                console::warnings([format!("the inputs are not checked before the tasks start: {reason}")]);
                Ok(())
            }
            checked => checked,
        }
    }
}

fn stopped(output: &Path) -> Failure {
    let (done, total) = pipeline::job_progress(output).unwrap_or_default();
    let found = format!("{}: stopped after {done} of {total} frames", output.display());
    Failure::stopped(found, format!("to go on, type: {}", reproduce::line_to_go_on()))
}
