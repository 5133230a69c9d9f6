//! Jobs of Slurm, by its programs `sbatch`, `squeue` and `scancel`.

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::process::{Command, Output};

use crate::cli::failure::{Exit, Failure};

/// A job that was submitted.
pub(super) struct Job {
    id: String,
}

/// Tasks of a job that have not ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Tasks {
    /// Some run or wait.
    Left {
        /// Numbers of tasks by state, such as `RUNNING`. Waiting tasks that nothing will start count as `HELD`.
        states: BTreeMap<String, usize>,
    },
    /// None are left.
    Ended,
    /// Slurm does not answer; its reason.
    Unknown(String),
}

impl Tasks {
    /// Whether tasks are left and all of them are held.
    pub(super) fn are_held(&self) -> bool {
        matches!(self, Self::Left { states } if states.keys().eq(["HELD"]))
    }
}

impl Job {
    /// Submits a job with these words for `sbatch`, the last of which is the script.
    pub(super) fn submit(words: &[String]) -> Result<Self, Failure> {
        let output = run("sbatch", &[&["--parsable".to_owned()], words].concat())?;
        if !output.status.success() {
            let found = format!("sbatch refuses the job: {}", first_line(&output.stderr));
            return Err(Failure::new("SLURM-REFUSED", found, "--sbatch passes words on to sbatch", Exit::Unavailable));
        }
        // On a federation the name of the cluster follows a semicolon.
        let id = first_line(&output.stdout);
        Ok(Self { id: id.split(';').next().unwrap_or_default().to_owned() })
    }

    pub(super) fn id(&self) -> &str {
        &self.id
    }

    /// Asks Slurm for the tasks that have not ended.
    pub(super) fn tasks(&self) -> Result<Tasks, Failure> {
        let words = ["--noheader", "--array", "--format=%T|%r", "--jobs", &self.id].map(str::to_owned);
        let output = run("squeue", &words)?;
        if !output.status.success() {
            let reason = first_line(&output.stderr);
            // Slurm forgets a job some minutes after its end.
            return Ok(if reason.contains("Invalid job id") { Tasks::Ended } else { Tasks::Unknown(reason) });
        }
        let mut states = BTreeMap::new();
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            let (state, reason) = line.split_once('|').unwrap_or((line, ""));
            // A task whose node failed while it started is held until somebody releases it.
            let is_held = state == "PENDING" && reason.to_ascii_lowercase().contains("held");
            *states.entry(if is_held { "HELD" } else { state }.to_owned()).or_insert(0) += 1;
        }
        Ok(if states.is_empty() { Tasks::Ended } else { Tasks::Left { states } })
    }

    /// Stops what is left: tasks that render finish their frame.
    pub(super) fn cancel(&self) -> Result<(), Failure> {
        // A job that has ended cannot be canceled, and need not be.
        run("scancel", std::slice::from_ref(&self.id)).map(drop)
    }
}

fn run(program: &str, words: &[String]) -> Result<Output, Failure> {
    Command::new(program).args(words).output().map_err(|error| {
        let found = format!("{program}: {error}, expected Slurm's programs on this machine");
        let help = "run it where jobs are submitted, or use --local";
        let exit = if error.kind() == ErrorKind::PermissionDenied { Exit::Permission } else { Exit::Unavailable };
        Failure::new("SLURM-MISSING", found, help, exit)
    })
}

fn first_line(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).lines().next().unwrap_or_default().trim().to_owned()
}
