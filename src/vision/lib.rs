//! Features of the patches of a picture, by a network for pictures that the user brings.
//!
//! Enters: a folder with a DINOv2 as `transformers` stores it (`config.json`, `model.safetensors`), and pictures of 8 bits.
//! Leaves: one row of numbers per square patch of a picture ([`PatchGrid`]). The one invariant: the numbers are those of
//! `transformers` in PyTorch, up to rounding (largest difference 1e-4, which a test holds).
//!
//! The network runs on the CPU in `f32`, and nothing is fetched. The one of candle-transformers has other names of tensors,
//! one size of pictures and a classifier that these files lack, so that [`Dino`] has its own.
//!
//! Without `RAYON_NUM_THREADS` in the environment candle counts the processors before each product of matrices. Two objects from
//! twelve sides each, with a network of the size of DINOv2-small, took 10 and 11 s on two busy cores, with 2 in it 3.5 and 7.7 s, with
//! 1 in it 3.0 and 2.6 s.
//!
//! Without the feature `models` the crate has the same interface and [`Dino::load`] refuses every folder.
//!
//! Reference: Oquab et al., DINOv2: Learning Robust Visual Features without Supervision, 2023.

#![cfg_attr(not(feature = "models"), allow(dead_code, reason = "only networks use it"))]

#[cfg(feature = "models")]
mod config;
#[cfg(feature = "models")]
mod dino;
#[cfg(not(feature = "models"))]
#[path = "no_models.rs"]
mod dino;
mod error;
mod grid;
#[cfg(feature = "models")]
mod layer;
#[cfg(feature = "models")]
mod positions;
#[cfg(feature = "models")]
mod tensors;

pub use dino::Dino;
pub use error::VisionError;
pub use grid::PatchGrid;
