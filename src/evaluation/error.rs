use thiserror::Error;

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
        /// Its name on the command line.
        setting: &'static str,
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
            Self::NoMatches { .. } => "EVAL-NO-MATCHES",
            Self::NoPairs { .. } => "EVAL-NO-PAIRS",
            Self::BadSetting { .. } => "EVAL-SETTING",
        }
    }

    /// What the user can do about it.
    pub fn help(&self) -> String {
        match self {
            Self::Empty { which } => format!("check that the {which} file holds a camera path"),
            Self::Unreadable { .. } => "check the file, or take it out of the folder".into(),
            Self::NoMatches { .. } => "raise --max-diff, or check that both files use one clock".into(),
            Self::NoPairs { .. } => "lower --delta or take --unit f".into(),
            Self::BadSetting { setting, expected, .. } => format!("set {setting} to {expected}"),
        }
    }

    /// Exit code of a program that ends with this error.
    pub fn exit_code(&self) -> i32 {
        if matches!(self, Self::BadSetting { .. }) { 2 } else { 65 }
    }
}
