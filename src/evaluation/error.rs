use std::path::PathBuf;

use strum::Display;
use thiserror::Error;

/// A setting of an evaluation that can be out of range, named by its [`Display`](std::fmt::Display).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Display)]
#[strum(serialize_all = "lowercase")]
pub enum SettingName {
    /// Number of poses that the alignment uses.
    #[strum(serialize = "number of aligned poses")]
    AlignPoses,
    /// Distance between the two poses of a relative error.
    Delta,
    /// Largest time between the two poses of a match.
    #[strum(serialize = "largest time difference")]
    MaxDiff,
    /// Seconds added to the times of the estimate.
    #[strum(serialize = "time offset")]
    TimeOffset,
    /// Diameter of the scene.
    #[strum(serialize = "scene diameter")]
    Diameter,
    /// The measured part of the error.
    Relation,
}

/// Error of an evaluation.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EvaluationError {
    /// A path without poses.
    #[error("the {which} has no poses, expected at least one")]
    Empty {
        /// "reference" or "estimate".
        which: &'static str,
    },
    /// A file of a batch cannot be read as a path.
    #[error("{reason}")]
    Unreadable {
        /// The file and its defect.
        reason: String,
    },
    /// Two files of one folder that would both be paired under the same name.
    #[error("{} and {} have the same stem \"{stem}\", expected one file per stem", .files[0].display(), .files[1].display())]
    SameStem {
        /// The name up to the first dot.
        stem: String,
        /// Both files.
        files: [PathBuf; 2],
    },
    /// No two time stamps are close enough.
    #[error(
        "no poses at the same times: nearest are {nearest_secs:.6} s apart, expected at most {max_diff_secs} s \
         (reference {reference_secs:?} s, estimate {estimate_secs:?} s)"
    )]
    NoMatches {
        /// Smallest difference of two time stamps.
        nearest_secs: f64,
        /// Largest difference allowed.
        max_diff_secs: f64,
        /// First and last time stamp of the reference.
        reference_secs: [f64; 2],
        /// First and last time stamp of the estimate.
        estimate_secs: [f64; 2],
    },
    /// No pair of poses has the requested distance.
    #[error("no pairs of poses are {delta} {unit} apart ({num_poses} poses, {available} {unit} in all)")]
    NoPairs {
        /// The requested distance.
        delta: f64,
        /// Its unit.
        unit: &'static str,
        /// Number of matched poses.
        num_poses: usize,
        /// Length of the whole path in that unit.
        available: f64,
    },
    /// A path without times where times are needed.
    #[error("a path has no times, expected times for {wanted}")]
    NoTimes {
        /// What needs them.
        wanted: &'static str,
    },
    /// A setting out of range.
    #[error("{setting} is {found}, expected {expected}")]
    BadSetting {
        /// The setting.
        setting: SettingName,
        /// Its value.
        found: String,
        /// The values allowed.
        expected: &'static str,
    },
}

impl EvaluationError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Empty { .. } => "EVAL-EMPTY",
            Self::Unreadable { .. } => "EVAL-UNREADABLE",
            Self::SameStem { .. } => "EVAL-SAME-STEM",
            Self::NoMatches { .. } => "EVAL-NO-MATCHES",
            Self::NoPairs { .. } => "EVAL-NO-PAIRS",
            Self::NoTimes { .. } => "EVAL-NO-TIMES",
            Self::BadSetting { .. } => "EVAL-SETTING",
        }
    }
}
