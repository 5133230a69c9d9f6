//! Renders pictures of 3D Gaussians on the CPU.
//!
//! # What enters, what leaves
//!
//! Enters: [`cinesplat_scene::Gaussians`] (loaded with [`cinesplat_scene::load`] or made in memory), a
//! [`cinesplat_geometry::Camera`] and [`RenderSettings`]. Leaves: a [`Frame`] (color in `f32` and the final
//! transmittance of every pixel) or an [`Rgb8Frame`] (8 bits). Instead of colors, the same blending loop gives depth
//! ([`Renderer::depth`]), object ids ([`Renderer::object_ids`]), blended features ([`Renderer::features`]), the weight
//! of every Gaussian in every pixel ([`Renderer::weights`]), and sums of pixel values per Gaussian
//! ([`Renderer::lift`]). `cinesplat bench render` measures what each costs beside a picture.
//!
//! # Example
//!
//! ```no_run
//! use cinesplat_render::geometry::{Camera, Intrinsics, Pose};
//! use cinesplat_render::scene::{LoadOptions, load};
//! use cinesplat_render::{Quality, RenderSettings, Renderer};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let scene = load("room.ply".as_ref(), &LoadOptions::default())?;
//! let target = scene.bounds().center();
//! let eye = target - 0.5 * scene.bounds().size() * scene.up.any_orthonormal_vector();
//! let camera = Camera {
//!     pose: Pose::look_at(eye, target, scene.up, None)?,
//!     intrinsics: Intrinsics::from_fov_y(1280, 720, 50_f64.to_radians()),
//! };
//! let settings = RenderSettings { quality: Quality::Final, ..RenderSettings::for_scene(&scene) };
//! let frame = Renderer::new(&scene.gaussians).render(&camera, &settings)?;
//! let header = format!("P6 {} {} 255\n", frame.width, frame.height);
//! std::fs::write("still.ppm", [header.into_bytes(), frame.to_rgb8()].concat())?;
//! # Ok(())
//! # }
//! ```
//!
//! A [`Renderer`] keeps its buffers from picture to picture: make one per scene, not one per picture.
//!
//! # Conventions
//!
//! - The world is that of the scene file; positions and depths are in scene units.
//! - A pose is `world_from_camera`. Camera axes are those of OpenCV: x right, y down, z forward.
//! - Pixel rows count from the top, columns from the left. The center of the first pixel is at (0.5, 0.5).
//! - Colors are those of the trained scene, without conversion: display-referred, nominally 0..=1, not clamped from
//!   above in a [`Frame`].
//!
//! # Stages
//!
//! | stage | file | does |
//! |---|---|---|
//! | group | `groups` | once per scene: sorts the Gaussians into groups of neighbors |
//! | project | `project` | Gaussians to splats (their projections), 16 at a time; rejects groups outside the picture |
//! | sort | `order`, `sort` | splats to depth order, where possible from the order of the previous picture |
//! | bin | `bin` | splats to tiles of 64 x 64 pixels |
//! | blend | `blend`, `coverage`, `kernel` | tiles to pixels, front to back, in blocks of 8 x 4 pixels in SIMD registers |
//!
//! Effects of the lens are extra inputs of these stages: `blur` widens the splats of one picture, `exposure` averages
//! several pictures, `sweep` blends several pictures of the splats of one. A picture without them runs the code that it
//! would run if they did not exist.
//!
//! `fast` runs these stages in `f32`. `reference` renders the same picture in `f64`, pixel by pixel; it defines the
//! *spec image* that every accuracy is measured against. `spec` holds the constants of both.
//!
//! The one invariant: a picture has the same bits for any number of threads, for any instruction set, and whether it is
//! rendered as a whole or in bands to save memory.
//!
//! Reference: Kerbl et al., 3D Gaussian Splatting for Real-Time Radiance Field Rendering, 2023.

#![allow(
    clippy::inline_always,
    reason = "code for an instruction set that is detected at run time must be inlined into the function that enables it"
)]

mod batch;
mod bin;
mod blend;
mod blur;
mod blur_extent;
mod canvas;
mod close;
mod coverage;
mod depth;
mod error;
mod exposure;
mod fast;
mod features;
mod fog;
mod frame;
mod groups;
mod harmonics;
mod ids;
mod instruction_set;
mod kernel;
mod lift;
mod light;
mod logarithm;
mod memory;
mod order;
mod payload;
mod pixels;
mod pool;
mod project;
mod record;
mod reference;
mod renderer;
mod settings;
mod sort;
mod spec;
mod splat;
mod splats;
mod spread;
pub mod srgb;
mod stats;
mod sweep;
mod tiles;
mod upsample;
mod view;
mod weights;

pub use blur::{SplatBlur, SubFrame, ThinLens};
pub use blur_extent::BlurExtent;
pub use depth::DepthMap;
pub use error::RenderError;
pub use features::FeatureMap;
pub use fog::Fog;
pub use frame::{Frame, Rgb8Frame};
pub use ids::IdMap;
pub use instruction_set::InstructionSet;
pub use lift::LiftedValues;
pub use memory::memory_target_bytes;
pub use renderer::Renderer;
pub use settings::{Accuracy, ColorClamp, Limits, Precision, Quality, RenderSettings, SortMode};
pub use stats::{RenderStats, StageTimes, WorkCounts};
pub use sweep::{Sweep, SweepPattern};
pub use weights::PixelWeight;

/// The crate of poses and cameras.
pub use cinesplat_geometry as geometry;
/// The crate of scenes: Gaussians and their file formats.
pub use cinesplat_scene as scene;

use view::View;
