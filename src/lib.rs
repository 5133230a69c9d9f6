//! Camera trajectories for video: a Gaussian-splat scene and a sentence become a camera move, filmed.
//!
//! # A film
//!
//! ```no_run
//! use std::ops::ControlFlow;
//! use std::path::Path;
//!
//! use cinesplat::director::Director;
//! use cinesplat::pipeline::{self, DirectSettings, FilmSettings, Interpreter};
//! use cinesplat::render::Renderer;
//! use cinesplat::scene::LoadOptions;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let opened = pipeline::open_scene(Path::new("room.spz"), &LoadOptions::default())?;
//! let (scene, objects) = opened.with_objects(Some(Path::new("objects.json")))?;
//! let interpreter = Interpreter::from(Director::embedded()?);
//! let prompt = "push in on the lamp, then orbit it to the left";
//! let directed = pipeline::direct(&scene, &objects, prompt, &interpreter, &DirectSettings::default())?;
//! for line in directed.shot.report.iter().filter(|line| !line.met) {
//!     eprintln!("{}: wanted {}, got {}", line.clause, line.wanted, line.got);
//! }
//! let (renderer, settings) = (Renderer::new(&scene.gaussians), FilmSettings::for_scene(&scene));
//! let mut watch = |_progress| ControlFlow::Continue(());
//! pipeline::film(&renderer, &directed.shot, Path::new("lamp.mp4"), &settings, &mut watch)?;
//! # Ok(())
//! # }
//! ```
//!
//! # Stills
//!
//! ```no_run
//! use cinesplat::files::Existing;
//! use cinesplat::geometry::{Camera, Intrinsics, Pose};
//! use cinesplat::render::{RenderSettings, Renderer};
//! use cinesplat::scene::{LoadOptions, load};
//! use cinesplat::video::write_png;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let scene = load("room.spz".as_ref(), &LoadOptions::default())?;
//! let bounds = scene.bounds();
//! let forward = scene.up.any_orthonormal_vector();
//! let eye = bounds.center() - forward * 0.5 * bounds.size();
//! let pose = Pose::facing(eye, forward, scene.up, None);
//! let camera = Camera { pose, intrinsics: Intrinsics::from_fov_y(1280, 720, 50_f64.to_radians()) };
//! let frame = Renderer::new(&scene.gaussians).render(&camera, &RenderSettings::for_scene(&scene))?;
//! write_png("still.png".as_ref(), &frame.to_rgb8(), [1280, 720], Existing::Keep)?;
//! # Ok(())
//! # }
//! ```
//!
//! # Trajectory error
//!
//! ```no_run
//! use cinesplat::evaluation::{Align, EvalSettings, Trajectory, evaluate};
//! use cinesplat::export;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let read = |path: &str| export::read(path.as_ref(), None).map(|file| Trajectory::from(&file.track));
//! let (reference, estimate) = (read("groundtruth.tum")?, read("estimate.tum")?);
//! let settings = EvalSettings { align: Align::Se3, ..EvalSettings::default() };
//! let evaluation = evaluate(&reference, &estimate, &settings)?;
//! println!("rmse {:.4} over {} poses", evaluation.statistics.rmse, evaluation.matches.reference.len());
//! # Ok(())
//! # }
//! ```
//!
//! # Bird's eye
//!
//! ```text
//! scene file ── scene ──► objects ──► language, director ──► operator ──► trajectory ──► render ──► video
//!               (load)    (clouds)    (words to program)     (exact,      (path)         (frames)   (film)
//! sentence ──────────────────────────►                       safe keys)
//! ```
//!
//! [`scene`] reads Gaussians and finds the up axis. [`objects`] finds or reads the objects and gives each a sparse
//! cloud by multi-view alpha shapes. [`language`] links the words of a prompt to objects and quantities. [`director`]
//! turns words and clouds into a program of steps and suggested cameras with a small network. [`operator`] makes the
//! program exact: keyframes that do what each move means, clear of matter, with a report of requested and achieved values.
//! [`trajectory`] is the path through keyframes. [`render`] draws it, [`video`] writes it. [`pipeline`] composes these
//! stages.
//!
//! # Map
//!
//! Data goes one way, from scene and words to video. Every entry is a crate of its own (`cinesplat-render` and so on) that
//! can be used alone; this crate re-exports all of them. A crate depends only on rows below its own.
//!
//! | row | crates | depends on |
//! |---|---|---|
//! | composition | [`pipeline`], in this crate | all below but training |
//! | training | `training` (feature `training`): sampler of sentences, dataset, training, exams | candle |
//! | network | [`director`]: text encoder, Q-former, decoder; [`reader`]: a language model in its place (feature `reader`); [`vision`]: features of pictures (feature `vision`) | candle, tokenizers |
//! | words | [`language`]: names, quantities, the notation of programs | |
//! | taste | [`critic`]: looks at finished moves and chooses | |
//! | exactness | [`operator`]: framing, visibility, clearance | |
//! | measures | [`evaluation`]: trajectory error, motion tags, framing, smoothness | |
//! | effects | [`lens`]: effects that a shot calls for | |
//! | generated scenes, maps | [`synth`]; [`map`]: a shot in its scene from above and from the side | |
//! | things | [`objects`]: views, masks, alpha shapes, clouds | |
//! | pictures | [`render`], [`video`] (feature `video`) | FFmpeg, in `video` alone |
//! | formats | [`scene`]: Gaussians; [`export`]: camera paths | |
//! | paths, drawings | [`trajectory`]: keyframes, splines, timing; [`plot`]: charts as SVG, PNG and PDF | |
//! | ground | [`geometry`]: poses, cameras; [`files`]: atomic output | |
//!
//! The program `cinesplat` is built on this crate with the feature `cli`. `tests/architecture.rs` checks the table.
//!
//! # Invariants
//!
//! - The scene file's world is never changed. Cameras are OpenCV (x right, y down, z forward), poses are
//!   `world_from_camera` in `f64`. Axes are flipped only in [`geometry::frames`] and [`export`].
//! - No library prints, reads the environment or exits. [`geometry`], [`trajectory`], [`operator`] and [`evaluation`]
//!   never do IO.
//! - Core types are not `Serialize`. Each file format has its own file in [`export`] or [`objects`].
//! - The same inputs, seed and version give the same bytes on any number of threads: no parallel float sums, no
//!   iteration over hash maps, every random number from a seed.
//! - A shot is validated before the engine uses it ([`trajectory::Shot::validated`]).
//! - No file is overwritten unless the caller says so ([`files::Existing`]); a file under its final name is complete.
//! - A film that was stopped, killed or refused by the disk goes on from its finished frames, to the same bytes
//!   ([`pipeline::JobSettings`]).

pub use cinesplat_critic as critic;
pub use cinesplat_director as director;
pub use cinesplat_evaluation as evaluation;
pub use cinesplat_export as export;
pub use cinesplat_files as files;
pub use cinesplat_geometry as geometry;
pub use cinesplat_language as language;
pub use cinesplat_lens as lens;
pub use cinesplat_map as map;
pub use cinesplat_objects as objects;
pub use cinesplat_operator as operator;
pub use cinesplat_plot as plot;
pub use cinesplat_reader as reader;
pub use cinesplat_render as render;
pub use cinesplat_scene as scene;
pub use cinesplat_synth as synth;
#[cfg(feature = "training")]
pub use cinesplat_training as training;
pub use cinesplat_trajectory as trajectory;
pub use cinesplat_video as video;
pub use cinesplat_vision as vision;

pub mod pipeline;
