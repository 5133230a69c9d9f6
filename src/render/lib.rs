//! Gaussians and a camera to a picture, on the CPU: project, sort, bin, blend, one file a stage under that name.
//!
//! Enters: [`cinesplat_scene::Gaussians`], a [`cinesplat_geometry::Camera`] and [`RenderSettings`]. Leaves: a [`Frame`], or
//! depth, object ids and weights from the same blending loop. What a picture must look like is fixed in [`spec`];
//! `reference` computes that in `f64` without shortcuts, every other quality in `f32` through `project` (splats, 16
//! Gaussians at a time), `sort` (depth order), `bin` (64 px tiles) and `blend` (8 x 4 px blocks, their pixels in
//! SIMD registers). The one invariant: a picture is the same to the bit whatever the number of threads, the instruction
//! set, and the bands that it is cut into where memory is short.
//!
//! Reference: Kerbl et al., 3D Gaussian Splatting for Real-Time Radiance Field Rendering, 2023.

#![allow(
    clippy::inline_always,
    reason = "what runs on an instruction set found at run time must be inlined into the function that enables it"
)]

mod batch;
mod bin;
mod blend;
mod canvas;
mod coverage;
mod depth;
mod error;
mod fast;
mod features;
mod frame;
mod groups;
mod harmonics;
mod ids;
mod instruction_set;
mod kernel;
mod lift;
mod memory;
mod order;
mod payload;
mod pixels;
mod project;
mod record;
mod reference;
mod renderer;
mod settings;
mod sort;

mod spec;
mod splat;
mod splats;
mod stats;
mod tiles;
mod upsample;
mod view;
mod weights;

pub use depth::DepthMap;
pub use error::RenderError;
pub use features::FeatureMap;
pub use frame::{Frame, Rgb8Frame};
pub use ids::IdMap;
pub use instruction_set::InstructionSet;
pub use lift::LiftedValues;
pub use renderer::Renderer;
pub use settings::{Accuracy, ColorClamp, Limits, Precision, Quality, RenderSettings, SortMode};
pub use stats::{RenderStats, StageTimes, WorkCounts};
pub use weights::PixelWeight;

/// Poses and cameras.
pub use cinesplat_geometry as geometry;
/// The scenes that are rendered.
pub use cinesplat_scene as scene;

use view::View;
