//! Networks for pictures against PyTorch (`dino/make.py`), and files that are refused.

mod files;
mod golden;

use std::collections::HashMap;
use std::path::Path;

use candle_core::{Device, Tensor, safetensors};

/// A tiny network with random weights, as `transformers` stores it.
pub const TINY: &str = "tests/vision/dino";

/// All tensors of a file of [`TINY`].
pub fn tensors(name: &str) -> HashMap<String, Tensor> {
    safetensors::load(Path::new(TINY).join(name), &Device::Cpu).unwrap()
}
