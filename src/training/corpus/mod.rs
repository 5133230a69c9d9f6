//! The corpus: sentences written by many hands, with their mentions of objects and their programs.
//!
//! Enters: text files of `prompts/corpus`, one per writer. Leaves: [`Writer`]s with their [`CorpusSentence`]s.
//!
//! # Format
//!
//! ```text
//! # a comment
//! object A 3 table lamp
//! A | s | @1 Push in on [the lamp|3] @0 please | push-in end=3
//! ```
//!
//! `object SCENE ID LABEL` declares an object of a scene. A sentence has four parts: its scene, its kind (`s` one clause,
//! `m` several clauses, `f` free; `!` after it marks what cannot be done), the sentence with marks, its program in the
//! notation. The marks: `[words|IDS]` is a mention, with `+` between the ids of several objects, `/` between ids of which
//! any could be meant, and `?` for a thing that the scene lacks. `@N` begins words of step N; `@0` words of no step.
//! A fifth part, after ` || `, is the program of a second reader where it differs from the first.
//! Braces hold words that ask for what the notation cannot say. In a program `?` is the first mention of a lacking thing.

mod marks;
mod read;

pub use marks::{Marked, parse_marked};
pub use read::{CorpusError, CorpusSentence, SentenceKind, Split, Writer, read_folder, read_writer};
