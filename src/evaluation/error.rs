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
    /// Which part of the error is measured.
    Relation,
}

/// What keeps two paths from being compared.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EvaluationError {
    /// A path without poses.
    #[error("the {which} has no poses, expected at least one")]
    Empty {
        /// "reference" or "estimate".
        which: &'static str,
    },
    /// A file of a batch that is no path.
    #[error("{reason}")]
    Unreadable {
        /// The file and what is wrong with it.
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
    /// No time stamps that lie close enough together.
    #[error(
        "no poses at the same times: nearest are {nearest_secs:.6} s apart, expected at most {max_diff_secs} s \
         (reference {reference_secs:?} s, estimate {estimate_secs:?} s)"
    )]
    NoMatches {
        /// Smallest distance of any two stamps.
        nearest_secs: f64,
        /// The bound.
        max_diff_secs: f64,
        /// First and last stamp of the reference.
        reference_secs: [f64; 2],
        /// First and last stamp of the estimate.
        estimate_secs: [f64; 2],
    },
    /// No pair of poses lies the asked distance apart.
    #[error("no pairs of poses are {delta} {unit} apart ({num_poses} poses, {available} {unit} in all)")]
    NoPairs {
        /// The asked distance.
        delta: f64,
        /// Its unit.
        unit: &'static str,
        /// Number of matched poses.
        num_poses: usize,
        /// Length of the whole path in that unit.
        available: f64,
    },
    /// A setting out of range.
    #[error("{setting} is {found}, expected {expected}")]
    BadSetting {
        /// Which one.
        setting: SettingName,
        /// Its value.
        found: String,
        /// What is allowed.
        expected: &'static str,
    },
}

impl EvaluationError {
    /// A short stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Empty { .. } => "EVAL-EMPTY",
            Self::Unreadable { .. } => "EVAL-UNREADABLE",
            Self::SameStem { .. } => "EVAL-SAME-STEM",
            Self::NoMatches { .. } => "EVAL-NO-MATCHES",
            Self::NoPairs { .. } => "EVAL-NO-PAIRS",
            Self::BadSetting { .. } => "EVAL-SETTING",
        }
    }
}
