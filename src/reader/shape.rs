//! Sizes of a model and the tensors that they require.
//!
//! Enters: the header of a GGUF file. Leaves: [`Shape`], with every tensor present, of the shape that the others imply and
//! wholly in the file, so that nothing larger than the file is allocated.

use std::fmt::Display;
use std::path::Path;

use candle_core::quantized::gguf_file::{Content, TensorInfo, Value};

use crate::error::ReaderError;

/// Most layers, heads and channels of a model.
const MAX_LAYERS: u32 = 256;
const MAX_HEADS: u32 = 256;
const MAX_WIDTH: u32 = 1 << 15;

/// Families of models that can be run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Family {
    Qwen2,
    Llama,
}

impl Family {
    /// Its name in GGUF files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Qwen2 => "qwen2",
            Self::Llama => "llama",
        }
    }

    /// Whether its models were trained on texts that begin with a token for the beginning.
    pub(crate) fn begins_with_token(self) -> bool {
        self == Self::Llama
    }
}

/// Sizes of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shape {
    pub(crate) family: Family,
    pub(crate) num_layers: usize,
    pub(crate) num_heads: usize,
    pub(crate) num_key_heads: usize,
    pub(crate) width: usize,
    /// Most tokens of prompt and answer together.
    pub(crate) max_tokens: usize,
    /// Rows of the table of tokens.
    pub(crate) num_tokens: usize,
}

impl Shape {
    /// The sizes that a header states, checked against its tensors.
    ///
    /// # Errors
    /// [`ReaderError::BadModel`] for an unknown family, a missing or absurd size, and a tensor that is missing, of the wrong
    /// shape or beyond the end of the file.
    pub(crate) fn of(path: &Path, content: &Content, file_bytes: u64) -> Result<Self, ReaderError> {
        let header = Header { path, content, file_bytes };
        let family = header.family()?;
        let size = |key: &str, most: u32| header.size(&format!("{}.{key}", family.name()), most);
        let num_heads = size("attention.head_count", MAX_HEADS)?;
        let num_key_heads = size("attention.head_count_kv", MAX_HEADS)?;
        let width = size("embedding_length", MAX_WIDTH)?;
        let num_layers = size("block_count", MAX_LAYERS)?;
        let max_tokens = size("context_length", u32::MAX)?;
        let bad = |part: &str, found: usize, expected: String| ReaderError::bad_model(path, part, &found, &expected);
        if num_heads % num_key_heads != 0 {
            return Err(bad("head_count_kv", num_key_heads, format!("a divisor of head_count, {num_heads}")));
        }
        if width % (2 * num_heads) != 0 {
            return Err(bad("embedding_length", width, format!("a multiple of twice head_count, {}", 2 * num_heads)));
        }
        if family == Family::Llama {
            let rotated = size("rope.dimension_count", MAX_WIDTH)?;
            if rotated != width / num_heads {
                return Err(bad("rope.dimension_count", rotated, format!("{}", width / num_heads)));
            }
            header.refuse_experts()?;
        }
        header.check_epsilon(family)?;
        let num_tokens = header.tensor("token_embd.weight")?.shape.dims().first().copied().unwrap_or(0);
        let shape = Self { family, num_layers, num_heads, num_key_heads, width, max_tokens, num_tokens };
        header.check_tensors(&shape)?;
        Ok(shape)
    }
}

struct Header<'a> {
    path: &'a Path,
    content: &'a Content,
    file_bytes: u64,
}

impl Header<'_> {
    fn family(&self) -> Result<Family, ReaderError> {
        let key = "general.architecture";
        let found = match self.content.metadata.get(key) {
            Some(Value::String(name)) => name.as_str(),
            _ => "missing",
        };
        let family = [Family::Qwen2, Family::Llama].into_iter().find(|family| family.name() == found);
        family.ok_or_else(|| self.bad(key, &found, &"qwen2 or llama"))
    }

    /// A size from 1 to `most`.
    fn size(&self, key: &str, most: u32) -> Result<usize, ReaderError> {
        match self.content.metadata.get(key) {
            Some(Value::U32(size)) if (1..=most).contains(size) => Ok(*size as usize),
            found => Err(self.bad(key, &told(found), &format!("a 32-bit number from 1 to {most}"))),
        }
    }

    fn check_epsilon(&self, family: Family) -> Result<(), ReaderError> {
        let key = format!("{}.attention.layer_norm_rms_epsilon", family.name());
        match self.content.metadata.get(&key) {
            Some(Value::F32(epsilon)) if *epsilon > 0.0 && *epsilon < 1.0 => Ok(()),
            found => Err(self.bad(&key, &told(found), &"a 32-bit float between 0 and 1")),
        }
    }

    fn refuse_experts(&self) -> Result<(), ReaderError> {
        match self.content.metadata.get("llama.expert_count") {
            None | Some(Value::U32(0 | 1)) => Ok(()),
            found => Err(self.bad("llama.expert_count", &told(found), &"a model without experts")),
        }
    }

    fn check_tensors(&self, shape: &Shape) -> Result<(), ReaderError> {
        let Shape { width, num_tokens, .. } = *shape;
        let key_width = width / shape.num_heads * shape.num_key_heads;
        self.check("token_embd.weight", &[num_tokens, width])?;
        self.check("output_norm.weight", &[width])?;
        if self.content.tensor_infos.contains_key("output.weight") {
            self.check("output.weight", &[num_tokens, width])?;
        }
        for layer in 0..shape.num_layers {
            let name = |part: &str| format!("blk.{layer}.{part}");
            let inner = self.tensor(&name("ffn_gate.weight"))?.shape.dims().first().copied().unwrap_or(0);
            let weights: [(&str, &[usize]); 9] = [
                ("attn_q.weight", &[width, width]),
                ("attn_k.weight", &[key_width, width]),
                ("attn_v.weight", &[key_width, width]),
                ("attn_output.weight", &[width, width]),
                ("ffn_gate.weight", &[inner, width]),
                ("ffn_up.weight", &[inner, width]),
                ("ffn_down.weight", &[width, inner]),
                ("attn_norm.weight", &[width]),
                ("ffn_norm.weight", &[width]),
            ];
            weights.iter().try_for_each(|(part, dims)| self.check(&name(part), dims))?;
            if shape.family == Family::Qwen2 {
                let biases = [("attn_q.bias", width), ("attn_k.bias", key_width), ("attn_v.bias", key_width)];
                biases.iter().try_for_each(|(part, size)| self.check(&name(part), &[*size]))?;
            }
        }
        Ok(())
    }

    /// Checks that a tensor has a shape, that its rows are whole blocks, and that the file holds all of it.
    fn check(&self, name: &str, expected: &[usize]) -> Result<(), ReaderError> {
        let tensor = self.tensor(name)?;
        let dims = tensor.shape.dims();
        if dims != expected {
            return Err(self.bad(name, &format!("{dims:?}"), &format!("{expected:?}")));
        }
        let (row, block) = (dims.last().copied().unwrap_or(0), tensor.ggml_dtype.block_size());
        if row % block != 0 {
            return Err(self.bad(name, &format!("in rows of {row}"), &format!("rows of a multiple of {block}")));
        }
        let num_bytes = (tensor.shape.elem_count() / block * tensor.ggml_dtype.type_size()) as u64;
        let end = self.content.tensor_data_offset.saturating_add(tensor.offset).saturating_add(num_bytes);
        if end > self.file_bytes {
            let found = format!("cut: it ends at byte {end}");
            return Err(self.bad(name, &found, &format!("an end within the file's {} bytes", self.file_bytes)));
        }
        Ok(())
    }

    fn tensor(&self, name: &str) -> Result<&TensorInfo, ReaderError> {
        let missing = || self.bad(name, &"missing", &"a tensor of this name");
        self.content.tensor_infos.get(name).ok_or_else(missing)
    }

    fn bad(&self, part: &str, found: &dyn Display, expected: &dyn Display) -> ReaderError {
        ReaderError::bad_model(self.path, part, found, expected)
    }
}

/// A value of the header in words.
fn told(value: Option<&Value>) -> String {
    match value {
        None => "missing".to_owned(),
        Some(Value::Array(values)) => format!("an array of {}", values.len()),
        Some(Value::String(text)) => format!("\"{}\"", text.chars().take(40).collect::<String>()),
        Some(value) => {
            let text = format!("{value:?}");
            let (kind, value) = text.split_once('(').unwrap_or(("", &text));
            format!("{} of type {kind}", value.trim_end_matches(')'))
        }
    }
}
