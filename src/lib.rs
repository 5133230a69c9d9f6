//! Camera-trajectory generation for video: a Gaussian-splat scene and a sentence become a camera move, filmed.
//!
//! # Bird's eye
//!
//! ```text
//! scene file ── scene ──► objects ──► director ──► operator ──► trajectory ──► render ──► video
//!               (load)    (clouds)    (words to    (exact,      (path)         (frames)   (film)
//! sentence ───────────────────────────► program)    safe keys)
//! ```
//!
//! [`scene`] reads Gaussians and finds up. [`objects`] finds or reads what can be named and makes each a sparse cloud by
//! multi-view alpha shapes. [`director`] turns words and clouds into a program of steps and suggested cameras with a
//! small network. [`operator`] makes the program exact: keyframes that do what each move means, clear of matter, with a
//! report of what was wanted and got. [`trajectory`] is the path through keyframes. [`render`] draws it, [`video`]
//! writes it. [`pipeline`] strings these together for a program that uses the library; [`cli`] is the command line.
//!
//! # Entry points
//!
//! [`scene::load`], [`pipeline::direct`] (sentence to shot), [`pipeline::film`] (shot to video),
//! [`export::write`] and [`export::read`] (shots and other tools' paths), [`evaluation::evaluate`] (trajectory error).
//!
//! # Map
//!
//! Data goes one way, from scene and words to video. A folder imports only from rows below its own; two on one row do
//! not know each other. `tests/architecture.rs` holds this table.
//!
//! | row | folders |
//! |---|---|
//! | command line | [`cli`] |
//! | composition | [`pipeline`] |
//! | words | [`director`]: the only one with candle and tokenizers |
//! | exactness | [`operator`] |
//! | measures | [`evaluation`] |
//! | effects | [`lens`] |
//! | things | [`objects`] |
//! | pictures | [`render`], [`video`] (the only one with ffmpeg) |
//! | files | [`scene`], [`export`] |
//! | paths | [`trajectory`] |
//! | frames | [`geometry`]; charts: [`plot`] |
//!
//! # Invariants
//!
//! - The scene file's world is never changed. Cameras are OpenCV (x right, y down, z forward), poses are
//!   `world_from_camera` in `f64`. Axes are flipped only in [`geometry::frames`] and [`export`].
//! - Nothing below [`cli`] prints, reads the environment or exits. [`geometry`], [`trajectory`], [`operator`] and
//!   [`evaluation`] never do IO.
//! - Core types are not `Serialize`: a file format is a file in [`export`] or [`objects`].
//! - The same inputs, seed and version give the same bytes on any number of threads: no parallel float sums, no
//!   iteration over hash maps, every random number from a seed.
//! - A shot is checked once, at the border ([`trajectory::Shot::validated`]).

pub use cinesplat_director as director;
pub use cinesplat_evaluation as evaluation;
pub use cinesplat_export as export;
pub use cinesplat_files as files;
pub use cinesplat_geometry as geometry;
pub use cinesplat_language as language;
pub use cinesplat_lens as lens;
pub use cinesplat_objects as objects;
pub use cinesplat_operator as operator;
pub use cinesplat_plot as plot;
pub use cinesplat_render as render;
pub use cinesplat_scene as scene;
pub use cinesplat_synth as synth;
#[cfg(feature = "training")]
pub use cinesplat_training as training;
pub use cinesplat_trajectory as trajectory;
pub use cinesplat_video as video;

pub mod pipeline;
