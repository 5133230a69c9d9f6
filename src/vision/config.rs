//! The sizes of a network, as its `config.json` states them.

use std::path::Path;

use serde_json::Value;

use crate::error::VisionError;

/// Largest size of any kind. That of the largest DINOv2 has 1536 channels, 6144 inside a layer and 40 layers.
const MAX_SIZE: usize = 16_384;

/// Sizes of a network.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Config {
    /// Numbers per token.
    pub(crate) width: usize,
    /// Numbers per token between the two linear layers of the feed-forward part.
    pub(crate) inner_width: usize,
    pub(crate) num_layers: usize,
    pub(crate) num_heads: usize,
    /// Patches per side of the pictures that the network was trained for.
    pub(crate) side_patches: usize,
    /// Side of a patch.
    pub(crate) patch_px: usize,
    /// Added to variances before division.
    pub(crate) norm_epsilon: f64,
    /// Whether queries, keys and values have biases.
    pub(crate) has_biases: bool,
}

impl Config {
    /// Reads the text of a `config.json`. `path` is for messages.
    ///
    /// # Errors
    /// [`VisionError::BadModel`] for another kind of network, and for sizes that are missing or fit no network.
    pub(crate) fn parse(path: &Path, bytes: &[u8]) -> Result<Self, VisionError> {
        let parsed: Value = serde_json::from_slice(bytes)
            .map_err(|error| VisionError::bad_model(path, "the text", &error, &"JSON of a network's sizes"))?;
        let keys = Keys { path, values: &parsed };
        if keys.get("model_type").is_none() {
            return Err(keys.bad("model_type", "\"dinov2\""));
        }
        // What the file leaves out has the values that `transformers` gives it.
        let only = [
            ("model_type", Value::from("dinov2")),
            ("hidden_act", Value::from("gelu")),
            ("use_swiglu_ffn", Value::from(false)),
            ("num_channels", Value::from(3)),
        ];
        if let Some((key, expected)) = only.iter().find(|(key, only)| keys.get(key).is_some_and(|value| value != only))
        {
            return Err(keys.bad(key, &expected.to_string()));
        }
        let (width, num_heads) = (keys.size("hidden_size")?, keys.size("num_attention_heads")?);
        if !width.is_multiple_of(num_heads) {
            return Err(keys.bad("num_attention_heads", &format!("a divisor of hidden_size, {width}")));
        }
        let (image_px, patch_px) = (keys.size("image_size")?, keys.size("patch_size")?);
        if image_px < patch_px {
            return Err(keys.bad("image_size", &format!("at least patch_size, {patch_px}")));
        }
        let mlp_ratio = keys.positive("mlp_ratio", 4.0)?;
        Ok(Self {
            width,
            inner_width: (width as f64 * mlp_ratio) as usize,
            num_layers: keys.size("num_hidden_layers")?,
            num_heads,
            side_patches: image_px / patch_px,
            patch_px,
            norm_epsilon: keys.positive("layer_norm_eps", 1e-6)?,
            has_biases: keys.get("qkv_bias").and_then(Value::as_bool).unwrap_or(true),
        })
    }
}

/// The keys of a file.
struct Keys<'a> {
    path: &'a Path,
    values: &'a Value,
}

impl Keys<'_> {
    fn get(&self, key: &str) -> Option<&Value> {
        self.values.get(key).filter(|value| !value.is_null())
    }

    fn bad(&self, key: &str, expected: &str) -> VisionError {
        let found = self.get(key).map_or_else(|| "missing".to_owned(), Value::to_string);
        VisionError::bad_model(self.path, key, &found, &expected)
    }

    fn size(&self, key: &str) -> Result<usize, VisionError> {
        let size = self.get(key).and_then(Value::as_u64).and_then(|size| usize::try_from(size).ok());
        let size = size.filter(|size| (1..=MAX_SIZE).contains(size));
        size.ok_or_else(|| self.bad(key, &format!("a whole number 1..{MAX_SIZE}")))
    }

    fn positive(&self, key: &str, default: f64) -> Result<f64, VisionError> {
        let Some(value) = self.get(key) else { return Ok(default) };
        let number = value.as_f64().filter(|number| *number > 0.0 && *number <= 64.0);
        number.ok_or_else(|| self.bad(key, "a number above 0, at most 64"))
    }
}
