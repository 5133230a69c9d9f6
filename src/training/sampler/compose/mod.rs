//! Composes a prompt clause by clause, together with the program that it means.
//!
//! Enters: the grammar, objects, a random generator. Leaves: a prompt, its program, and the mentions that linking must
//! find. Four rules keep the meaning unambiguous: every template has its tokens of meaning; a draw with contradicting
//! tokens (`slowly .. fast`) is rejected; a pronoun refers only to the one object in focus after the clause before; a
//! framing before a move is the start of that move.

mod clauses;
mod composer;
mod consistency;
mod framings;
mod prompt;
mod realize;

pub(crate) use prompt::{Composed, compose};
