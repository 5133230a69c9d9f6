use thiserror::Error;

/// Error of keyframes. Indices count from 0, as in the file.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TrajectoryError {
    /// A shot without keyframes.
    #[error("a shot needs at least one keyframe, found none")]
    NoKeyframes,
    /// More keyframes than a shot may have.
    #[error("a shot has {found} keyframes, expected at most {expected}")]
    TooManyKeyframes {
        /// Number of keyframes.
        found: usize,
        /// The limit.
        expected: usize,
    },
    /// More frames than a film may have.
    #[error("a film of {found} frames (duration_secs times fps), expected at most {expected}")]
    TooManyFrames {
        /// Number of frames.
        found: usize,
        /// The limit.
        expected: usize,
    },
    /// Times that do not increase.
    #[error("keyframe {index} is at {found} s, expected later than {previous} s")]
    TimesNotIncreasing {
        /// The later keyframe.
        index: usize,
        /// Its time.
        found: f64,
        /// The time of the key before.
        previous: f64,
    },
    /// A number that is not finite or out of range.
    #[error("keyframe {index}: {field} is {found}, expected {expected}")]
    BadValue {
        /// The keyframe.
        index: usize,
        /// Name of the JSON field.
        field: &'static str,
        /// The value found.
        found: String,
        /// The values allowed.
        expected: &'static str,
    },
    /// A value of the shot is out of range.
    #[error("{field} is {found}, expected {expected}")]
    BadShotValue {
        /// Name of the JSON field.
        field: &'static str,
        /// The value found.
        found: String,
        /// The values allowed.
        expected: &'static str,
    },
}

impl TrajectoryError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        "SHOT-KEYS"
    }
}
