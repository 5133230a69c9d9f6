//! Jobs of Slurm, by its programs `sbatch`, `squeue` and `scancel`.

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::process::{Command, Output};

use crate::cli::failure::{Exit, Failure};

/// Waiting tasks that a person holds, and those that Slurm never starts.
const HELD: &str = "HELD";
const LOST: &str = "LOST";
/// Reasons of tasks that Slurm never starts by itself, in small letters alone: their node failed while it started them,
/// they wait for a job that failed, or no machine and no account suits them.
const NEVER_STARTS: [&str; 6] = [
    "launchfailedrequeuedheld",
    "jobholdmaxrequeue",
    "dependencyneversatisfied",
    "badconstraints",
    "invalidaccount",
    "invalidqos",
];

/// A job that was submitted.
pub(super) struct Job {
    id: String,
}

/// Tasks of a job that have not ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Tasks {
    /// Some run or wait.
    Left {
        /// Numbers of tasks by state, such as `RUNNING`. Waiting tasks that a person holds count as `HELD`.
        states: BTreeMap<String, usize>,
        /// Why those that count as `LOST` never start, in Slurm's words.
        lost: Option<String>,
    },
    /// None are left.
    Ended,
    /// Slurm does not answer; its reason.
    Unknown(String),
}

impl Tasks {
    /// Why all tasks that are left never start; `None` if one may.
    pub(super) fn never_start(&self) -> Option<&str> {
        match self {
            Self::Left { states, lost } if states.keys().eq([LOST]) => lost.as_deref(),
            _ => None,
        }
    }

    /// Number of tasks that a person holds.
    pub(super) fn num_held(&self) -> usize {
        match self {
            Self::Left { states, .. } => states.get(HELD).copied().unwrap_or(0),
            _ => 0,
        }
    }
}

impl Job {
    /// Submits a job with these words for `sbatch`, the last of which is the script.
    pub(super) fn submit(words: &[String]) -> Result<Self, Failure> {
        let output = run("sbatch", &[&["--parsable".to_owned()], words].concat())?;
        if !output.status.success() {
            let reason = first_line(&output.stderr);
            let exit = if is_silent(&reason) { Exit::Unavailable } else { Exit::Usage };
            let found = format!("sbatch refuses the job: {reason}");
            return Err(Failure::new("SLURM-REFUSED", found, "--sbatch passes words on to sbatch", exit));
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
        let (mut states, mut lost) = (BTreeMap::new(), None);
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            let (state, reason) = line.split_once('|').unwrap_or((line, ""));
            let state = if state == "PENDING" { waiting_state(reason) } else { state };
            lost = lost.or_else(|| (state == LOST).then(|| reason.to_owned()));
            *states.entry(state.to_owned()).or_insert(0) += 1;
        }
        Ok(if states.is_empty() { Tasks::Ended } else { Tasks::Left { states, lost } })
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

/// The state of a waiting task by the reason that Slurm gives.
fn waiting_state(reason: &str) -> &'static str {
    let plain: String = reason.chars().filter(char::is_ascii_alphabetic).collect::<String>().to_ascii_lowercase();
    if NEVER_STARTS.contains(&plain.as_str()) {
        LOST
    } else if plain.contains("held") {
        HELD
    } else {
        "PENDING"
    }
}

/// Whether `sbatch` refuses a job because it does not reach the cluster.
fn is_silent(reason: &str) -> bool {
    ["contact", "connect", "timed out", "communication", "socket"]
        .iter()
        .any(|word| reason.to_ascii_lowercase().contains(word))
}

fn first_line(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).lines().next().unwrap_or_default().trim().to_owned()
}
