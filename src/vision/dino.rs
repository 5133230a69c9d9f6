//! The network: a picture to the features of its patches.

use std::path::Path;

use candle_core::{Device, Result as Computed, Tensor};
use candle_nn::{LayerNorm, Linear, Module};
use cinesplat_files::Limits;

use crate::config::Config;
use crate::error::VisionError;
use crate::grid::PatchGrid;
use crate::layer::Layer;
use crate::positions::resized;
use crate::tensors::Tensors;

/// Mean and standard deviation of the colors that the network was trained with, those of ImageNet.
const MEAN: [f32; 3] = [0.485, 0.456, 0.406];
const STANDARD_DEVIATION: [f32; 3] = [0.229, 0.224, 0.225];

/// A DINOv2.
pub struct Dino {
    config: Config,
    projection: Linear,
    /// The token in front of those of the patches, with its position embedding: `[1, width]`.
    class_token: Tensor,
    /// Position embeddings of the patches of a picture of the trained size: `[patch, width]`.
    positions: Vec<f32>,
    layers: Vec<Layer>,
    norm: LayerNorm,
}

impl Dino {
    /// Loads a folder with `config.json` and `model.safetensors`, as `transformers` stores a `Dinov2Model` or a network that
    /// has one as its part `dinov2`.
    ///
    /// # Errors
    /// [`VisionError::File`] where a file cannot be read, [`VisionError::BadModel`] for another kind of network, and for a
    /// tensor that is missing, has another shape than the configuration says, or holds numbers that are not finite.
    pub fn load(folder: &Path) -> Result<Self, VisionError> {
        let path = folder.join("config.json");
        let config = Config::parse(&path, &cinesplat_files::read(&path, Limits::DEFAULT.text_bytes)?)?;
        let tensors = Tensors::read(&folder.join("model.safetensors"))?;
        let Config { width, patch_px, side_patches, .. } = config;
        let num_patches = side_patches * side_patches;

        let weight = tensors.get("embeddings.patch_embeddings.projection.weight", &[width, 3, patch_px, patch_px])?;
        let bias = tensors.get("embeddings.patch_embeddings.projection.bias", &[width])?;
        let class_token = tensors.get("embeddings.cls_token", &[1, 1, width])?;
        let positions = tensors.get("embeddings.position_embeddings", &[1, num_patches + 1, width])?;
        let layers = (0..config.num_layers).map(|idx| Layer::load(&tensors, &config, idx)).collect::<Result<_, _>>()?;
        let norm = tensors.norm("layernorm", width, config.norm_epsilon)?;
        let rearranged = || {
            let weight = weight.reshape((width, 3 * patch_px * patch_px))?; // [width, channel * row * column]
            let class_token = (class_token.squeeze(0)? + positions.narrow(1, 0, 1)?.squeeze(0)?)?; // [1, width]
            let positions = positions.narrow(1, 1, num_patches)?.flatten_all()?.to_vec1()?;
            Ok((Linear::new(weight, Some(bias)), class_token, positions))
        };
        let (projection, class_token, positions) =
            rearranged().map_err(|error: candle_core::Error| VisionError::compute(&error))?;
        Ok(Self { config, projection, class_token, positions, layers, norm })
    }

    /// Side of a patch.
    pub fn patch_px(&self) -> usize {
        self.config.patch_px
    }

    /// The features of a picture (`[(row * width + column) * 3 + channel]`, display-referred; size: width, height): those of
    /// the last layer, normalized. A patch sees all of the picture.
    ///
    /// # Errors
    /// [`VisionError::BadPicture`] unless both sides are multiples of [`Dino::patch_px`] · [`VisionError::Compute`].
    pub fn patches(&self, rgb8: &[u8], size_px: [usize; 2]) -> Result<PatchGrid, VisionError> {
        let ([width, height], patch_px) = (size_px, self.config.patch_px);
        let is_whole = |side: usize| side > 0 && side.is_multiple_of(patch_px);
        if !is_whole(width) || !is_whole(height) || rgb8.len() != width * height * 3 {
            return Err(VisionError::BadPicture { width, height, num_bytes: rgb8.len(), patch_px });
        }
        let (columns, rows) = (width / patch_px, height / patch_px);
        let values = self.apply(rgb8, [rows, columns]).map_err(|error| VisionError::compute(&error))?;
        if !values.iter().all(|value| value.is_finite()) {
            return Err(VisionError::compute(&"a feature is not finite, expected finite numbers"));
        }
        Ok(PatchGrid { columns, rows, num_channels: self.config.width, values })
    }

    fn apply(&self, rgb8: &[u8], [rows, columns]: [usize; 2]) -> Computed<Vec<f32>> {
        let Config { width, patch_px, side_patches, .. } = self.config;
        let num_patches = rows * columns;
        let pixels = in_patches(rgb8, [rows, columns], patch_px);
        let pixels = Tensor::from_vec(pixels, (num_patches, 3 * patch_px * patch_px), &Device::Cpu)?;
        let positions = if [rows, columns] == [side_patches; 2] {
            self.positions.clone()
        } else {
            resized(&self.positions, side_patches, width, [rows, columns])
        };
        let positions = Tensor::from_vec(positions, (num_patches, width), &Device::Cpu)?;
        let patches = (self.projection.forward(&pixels)? + positions)?; // [patch, width]
        let mut tokens = Tensor::cat(&[&self.class_token, &patches], 0)?; // [1 + patch, width]
        for layer in &self.layers {
            tokens = layer.apply(&tokens)?;
        }
        self.norm.forward(&tokens)?.narrow(0, 1, num_patches)?.flatten_all()?.to_vec1() // [patch * width]
    }
}

/// Normalized colors of a picture, patch by patch: `[patch, channel * row * column]`.
fn in_patches(rgb8: &[u8], [rows, columns]: [usize; 2], patch_px: usize) -> Vec<f32> {
    let mut values = Vec::with_capacity(rgb8.len());
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        for channel in 0..3 {
            for y in row * patch_px..(row + 1) * patch_px {
                let start = y * columns * patch_px + column * patch_px;
                let pixels = rgb8[3 * start..3 * (start + patch_px)].chunks_exact(3);
                values.extend(
                    pixels.map(|rgb| (f32::from(rgb[channel]) / 255.0 - MEAN[channel]) / STANDARD_DEVIATION[channel]),
                );
            }
        }
    }
    values
}
