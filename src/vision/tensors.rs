//! The weights of a network by their names in `transformers`.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use candle_core::{DType, Device, Tensor, safetensors};
use candle_nn::{LayerNorm, Linear};
use cinesplat_files::Limits;

use crate::error::VisionError;

/// Begins the names where the network is a part of another one, such as a classifier.
const PREFIX: &str = "dinov2.";

/// All tensors of a `model.safetensors`.
pub(crate) struct Tensors {
    path: PathBuf,
    by_name: HashMap<String, Tensor>,
}

impl Tensors {
    /// Reads a file.
    ///
    /// # Errors
    /// [`VisionError::File`] · [`VisionError::BadModel`] for what is no safetensors file.
    pub(crate) fn read(path: &Path) -> Result<Self, VisionError> {
        let bytes = cinesplat_files::read(path, Limits::DEFAULT.array_bytes)?;
        let damaged = |error| VisionError::bad_model(path, "the file", &error, &"a safetensors file of weights");
        let by_name = safetensors::load_buffer(&bytes, &Device::Cpu).map_err(damaged)?;
        Ok(Self { path: path.to_owned(), by_name })
    }

    /// A tensor as `f32`, with or without [`PREFIX`].
    ///
    /// # Errors
    /// [`VisionError::BadModel`] for a tensor that is missing, has another shape, or holds a number that is not finite.
    pub(crate) fn get(&self, name: &str, shape: &[usize]) -> Result<Tensor, VisionError> {
        let bad = |found: String, expected: String| VisionError::bad_model(&self.path, name, &found, &expected);
        let found = self.by_name.get(name).or_else(|| self.by_name.get(&format!("{PREFIX}{name}")));
        let found = found.ok_or_else(|| bad("missing".to_owned(), format!("a tensor {shape:?}")))?;
        if found.dims() != shape {
            return Err(bad(format!("{:?}", found.dims()), format!("{shape:?} by config.json")));
        }
        let floats = found.to_dtype(DType::F32).map_err(|error| bad(error.to_string(), "numbers".to_owned()))?;
        // A sum that is finite has only finite terms, up to overflow, which no weights of a network reach.
        let sum = floats.abs().and_then(|sizes| sizes.sum_all()).and_then(|sum| sum.to_scalar::<f32>());
        match sum {
            Ok(sum) if sum.is_finite() => Ok(floats),
            Ok(sum) => Err(bad(format!("of absolute sum {sum}"), "finite numbers".to_owned())),
            Err(error) => Err(VisionError::compute(&error)),
        }
    }

    /// A linear layer from `inputs` to `outputs` numbers.
    ///
    /// # Errors
    /// Those of [`Tensors::get`].
    pub(crate) fn linear(
        &self,
        name: &str,
        [outputs, inputs]: [usize; 2],
        has_bias: bool,
    ) -> Result<Linear, VisionError> {
        let weight = self.get(&format!("{name}.weight"), &[outputs, inputs])?;
        let bias = has_bias.then(|| self.get(&format!("{name}.bias"), &[outputs])).transpose()?;
        Ok(Linear::new(weight, bias))
    }

    /// A normalization of `width` numbers.
    ///
    /// # Errors
    /// Those of [`Tensors::get`].
    pub(crate) fn norm(&self, name: &str, width: usize, epsilon: f64) -> Result<LayerNorm, VisionError> {
        let weight = self.get(&format!("{name}.weight"), &[width])?;
        Ok(LayerNorm::new(weight, self.get(&format!("{name}.bias"), &[width])?, epsilon))
    }
}
