use cinesplat_trajectory::Move;

/// Error of a text that is no program in the notation.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NotationError {
    /// A step without a move.
    #[error("step without a move, expected one such as push-in")]
    NoMove,
    /// A word that is neither a token of the notation nor a move.
    #[error("unknown move \"{name}\", expected one such as push-in")]
    UnknownMove {
        /// The word.
        name: String,
    },
    /// A direction that the move of its step does not have.
    #[error("\"{movement}\" has no direction {direction}")]
    WrongDirection {
        /// The move.
        movement: Move,
        /// The direction.
        direction: String,
    },
    /// A token with an unknown key or a value that its key does not take.
    #[error("unknown token \"{token}\"")]
    UnknownToken {
        /// The whole token.
        token: String,
    },
    /// A qualifier of a framing that is no shot size, angle or part.
    #[error("unknown framing \"{qualifier}\", expected a shot size, an angle or a part")]
    UnknownFraming {
        /// The qualifier.
        qualifier: String,
    },
    /// A name that stands for no object.
    #[error("unknown object \"{name}\"")]
    UnknownObject {
        /// The name.
        name: String,
    },
    /// A duration that is not a number of seconds.
    #[error("duration \"{found}\", expected seconds such as 2.5s")]
    BadDuration {
        /// The value.
        found: String,
    },
    /// A token that contradicts another one of its step, or repeats an amount or a duration.
    #[error("\"{token}\" contradicts or repeats another token of its step")]
    Contradiction {
        /// The token, or its value.
        token: String,
    },
}
