//! The critic: looks at small pictures of finished camera moves and says which one is worth filming.
//!
//! Enters: a scene, its subjects ([`Subjects`]) and films that the operator has finished ([`Film`]). Leaves: one [`Review`]
//! per film, with a mark of 0..=1 for each [`Term`] of taste and a check of each hard [`Limit`]; the order of several
//! films ([`ranked`]); and what the choice traded, in words ([`trade`]).
//!
//! The terms, their weights and their sources stand in one table ([`TERMS`]). A requirement of the prompt ranks above a
//! limit, and a limit above taste: a film that violates what another meets never wins.
//!
//! The one invariant: the same films get the same marks on any number of threads.
//!
//! The crate does no IO.

mod choice;
mod critic;
mod face;
mod film;
mod front;
mod limits;
mod marks;
mod painted;
mod picture;
mod profile;
mod report;
mod resolution;
mod review;
mod settings;
mod sides;
mod subjects;
mod terms;
mod thinned;
mod trade;

pub use choice::{Candidate, ranked};
pub use critic::Critic;
pub use film::Film;
pub use limits::{Limit, LimitCheck};
pub use picture::{Picture, Sight};
pub use report::report_lines;
pub use resolution::{MAX_SPLAT_FRAC, holds_to};
pub use review::{Mark, Review};
pub use settings::CriticSettings;
pub use subjects::Subjects;
pub use terms::{TERMS, Term, TermRow, Weights};
pub use trade::trade;
