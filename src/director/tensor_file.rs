//! Weights as a safetensors file.
//!
//! Enters: tensors by name, as `f32`. Leaves: `f16`, and matrices in GGML's blocks, which [`Packing`] says; the last block is
//! filled up with zeros. The format has no such types: the bytes are stored as `U8`, and the metadata says which tensors they
//! are and their shapes.

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};

use candle_core::quantized::{GgmlDType, QStorage, QTensor};
use candle_core::{Device, Tensor};
use half::f16;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};

use crate::error::DirectorError;

/// Name of the file with the weights.
pub(crate) const WEIGHTS_FILE: &str = "director.safetensors";
/// Types of blocks, by their names in the metadata.
const BLOCKS: [(&str, GgmlDType); 3] = [("q4_k", GgmlDType::Q4K), ("q6_k", GgmlDType::Q6K), ("q8_0", GgmlDType::Q8_0)];
/// Key of the metadata: a JSON object of the types and shapes of the tensors in blocks, by name.
const IN_BLOCKS: &str = "blocks";

/// How the names of BERT's tensors begin.
const BERT: &str = "bert.";

/// How matrices are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Packing {
    /// `f16`; those of BERT, which are most of the bytes, in 6.6 bits a number.
    Training,
    /// 8.5 bits a number; those of BERT in 4.5, and those above it in 6.6.
    Compact,
}

impl Packing {
    /// The blocks of a matrix of a network; `None` for `f16`. `has_bert` says whether the text encoder is BERT.
    fn blocks_of(self, name: &str, has_bert: bool) -> Option<(&'static str, GgmlDType)> {
        let [q4_k, q6_k, q8_0] = BLOCKS;
        match (self, name.starts_with(BERT)) {
            (Self::Training, true) => Some(q6_k),
            (Self::Training, false) => None,
            (Self::Compact, true) => Some(q4_k),
            (Self::Compact, false) => Some(if has_bert { q6_k } else { q8_0 }),
        }
    }
}

/// All tensors of a file by name, as `f32`.
///
/// # Errors
/// [`DirectorError::BadModel`] when the file is not a safetensors file, or a tensor has another type or holds a value that is
/// not finite.
pub(crate) fn read_tensors(bytes: &[u8]) -> Result<BTreeMap<String, Tensor>, DirectorError> {
    let damaged = |error: &dyn std::fmt::Display| bad_weights(error, &"a safetensors file");
    let (_, header) = SafeTensors::read_metadata(bytes).map_err(|error| damaged(&error))?;
    let in_blocks: BTreeMap<String, (String, Vec<usize>)> =
        match header.metadata().as_ref().and_then(|m| m.get(IN_BLOCKS)) {
            None => BTreeMap::new(),
            Some(shapes) => serde_json::from_str(shapes).map_err(|error| damaged(&error))?,
        };
    let file = SafeTensors::deserialize(bytes).map_err(|error| damaged(&error))?;
    let read = |(name, view): (&str, TensorView<'_>)| {
        let values = match in_blocks.get(name) {
            Some((blocks, shape)) => of_blocks(name, blocks, shape, &view)?,
            None => of_numbers(name, &view)?,
        };
        Ok((name.to_owned(), finite(name, values)?))
    };
    file.iter().map(read).collect()
}

fn of_numbers(name: &str, view: &TensorView<'_>) -> Result<(Vec<usize>, Vec<f32>), DirectorError> {
    let values = match view.dtype() {
        Dtype::F16 => view.data().as_chunks::<2>().0.iter().map(|b| f16::from_le_bytes(*b).to_f32()).collect(),
        Dtype::F32 => view.data().as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect(),
        other => return Err(bad(&name, &format!("{other:?}"), &"F16 or F32")),
    };
    Ok((view.shape().to_vec(), values))
}

fn of_blocks(
    name: &str,
    blocks: &str,
    shape: &[usize],
    view: &TensorView<'_>,
) -> Result<(Vec<usize>, Vec<f32>), DirectorError> {
    let known = BLOCKS.iter().find(|(own, _)| *own == blocks);
    let (_, blocks) = known.ok_or_else(|| bad(&name, &format!("blocks {blocks:?}"), &"q4_k, q6_k or q8_0"))?;
    let count = shape.iter().try_fold(1_usize, |count, size| count.checked_mul(*size)).unwrap_or(0);
    let found = view.data().len();
    let num_blocks = count.div_ceil(blocks.block_size());
    if view.dtype() != Dtype::U8 || count == 0 || num_blocks.checked_mul(blocks.type_size()) != Some(found) {
        return Err(bad(&name, &format!("{found} bytes of {:?}", view.dtype()), &format!("blocks of {shape:?}")));
    }
    let size = num_blocks * blocks.block_size();
    // Copied, because the bytes of a file that is compiled in stand anywhere.
    let blocks = QStorage::from_data(Cow::Owned(view.data().to_vec()), &Device::Cpu, *blocks)?;
    let mut values = QTensor::new(blocks, size)?.dequantize(&Device::Cpu)?.to_vec1()?;
    values.truncate(count);
    Ok((shape.to_vec(), values))
}

fn finite(name: &str, (shape, values): (Vec<usize>, Vec<f32>)) -> Result<Tensor, DirectorError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(at) => Err(bad(&name, &format!("{} at {at}", values[at]), &"finite numbers")),
        None => Ok(Tensor::from_vec(values, shape, &Device::Cpu)?),
    }
}

/// The bytes of a file; `tensors` maps names to shapes and values. The same tensors give the same bytes.
///
/// # Errors
/// [`DirectorError::BadModel`] when they cannot be serialized.
pub(crate) fn pack_tensors(
    tensors: &BTreeMap<String, (Vec<usize>, Vec<f32>)>,
    packing: Packing,
) -> Result<Vec<u8>, DirectorError> {
    let has_bert = tensors.keys().any(|name| name.starts_with(BERT));
    let mut in_blocks: BTreeMap<&str, (&str, &[usize])> = BTreeMap::new();
    let mut packed: Vec<(&str, Dtype, Vec<usize>, Vec<u8>)> = Vec::with_capacity(tensors.len());
    for (name, (shape, values)) in tensors {
        if let Some((key, blocks)) = packing.blocks_of(name, has_bert).filter(|_| shape.len() == 2) {
            let mut values = values.clone();
            values.resize(values.len().next_multiple_of(blocks.block_size()), 0.0);
            let bytes = QTensor::quantize(&Tensor::new(values, &Device::Cpu)?, blocks)?.data()?.into_owned();
            in_blocks.insert(name, (key, shape));
            packed.push((name, Dtype::U8, vec![bytes.len()], bytes));
        } else {
            let bytes = values.iter().flat_map(|value| f16::from_f32(*value).to_le_bytes()).collect();
            packed.push((name, Dtype::F16, shape.clone(), bytes));
        }
    }
    let failed = |error: &dyn std::fmt::Display| bad_weights(error, &"tensors that can be written");
    let metadata = if in_blocks.is_empty() {
        None
    } else {
        let shapes = serde_json::to_string(&in_blocks).map_err(|error| failed(&error))?;
        // One entry: those of a map have no order.
        Some(HashMap::from([(IN_BLOCKS.to_owned(), shapes)]))
    };
    let views =
        packed.iter().map(|(name, dtype, shape, bytes)| Ok((*name, TensorView::new(*dtype, shape.clone(), bytes)?)));
    let views = views.collect::<Result<Vec<_>, safetensors::SafeTensorError>>().map_err(|error| failed(&error))?;
    safetensors::serialize(views, metadata).map_err(|error| failed(&error))
}

/// What failed, in one line: where `RUST_BACKTRACE` is set, candle's errors end with a stack.
pub(crate) fn reason(error: &candle_core::Error) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}

/// Checks that an output of the network of `file` is finite.
///
/// # Errors
/// [`DirectorError::NotFinite`]
pub(crate) fn check_finite(file: &'static str, output: &'static str, values: &[f32]) -> Result<(), DirectorError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(found) => Err(DirectorError::NotFinite { file, output, found: *found }),
        None => Ok(()),
    }
}

/// The error for a bad weights file.
pub(crate) fn bad_weights(found: &dyn std::fmt::Display, expected: &dyn std::fmt::Display) -> DirectorError {
    bad(&WEIGHTS_FILE, found, expected)
}

/// The error for a bad part of a model.
pub(crate) fn bad(
    part: &dyn std::fmt::Display,
    found: &dyn std::fmt::Display,
    expected: &dyn std::fmt::Display,
) -> DirectorError {
    DirectorError::BadModel { part: part.to_string(), found: found.to_string(), expected: expected.to_string() }
}
