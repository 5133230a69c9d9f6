//! Weights as a safetensors file.
//!
//! Enters: tensors by name, as `f32`. Leaves: `f16`, and for the matrices of BERT blocks of 256 numbers of 6.6 bits each
//! (GGML's `Q6_K`; the last one is filled up with zeros), which are most of the bytes. The format has no such type: the
//! bytes are stored as `U8`, and the metadata says which tensors they are and their shapes.

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};

use candle_core::quantized::{GgmlDType, QStorage, QTensor};
use candle_core::{Device, Tensor};
use half::f16;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};

use crate::error::DirectorError;

/// Name of the file with the weights.
pub(crate) const WEIGHTS_FILE: &str = "director.safetensors";
/// Type of the blocks.
const BLOCKS: GgmlDType = GgmlDType::Q6K;
/// Key of the metadata: a JSON object of the shapes of the tensors in blocks, by name.
const BLOCK_SHAPES: &str = "q6_k";

/// All tensors of a file by name, as `f32`.
///
/// # Errors
/// [`DirectorError::BadModel`] when the file is not a safetensors file, or a tensor has another type or holds a value that is
/// not finite.
pub(crate) fn read_tensors(bytes: &[u8]) -> Result<BTreeMap<String, Tensor>, DirectorError> {
    let damaged = |error: &dyn std::fmt::Display| bad_weights(error, &"a safetensors file");
    let (_, header) = SafeTensors::read_metadata(bytes).map_err(|error| damaged(&error))?;
    let in_blocks: BTreeMap<String, Vec<usize>> = match header.metadata().as_ref().and_then(|m| m.get(BLOCK_SHAPES)) {
        None => BTreeMap::new(),
        Some(shapes) => serde_json::from_str(shapes).map_err(|error| damaged(&error))?,
    };
    let file = SafeTensors::deserialize(bytes).map_err(|error| damaged(&error))?;
    let read = |(name, view): (&str, TensorView<'_>)| {
        let values = match in_blocks.get(name) {
            Some(shape) => of_blocks(name, shape, &view)?,
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

fn of_blocks(name: &str, shape: &[usize], view: &TensorView<'_>) -> Result<(Vec<usize>, Vec<f32>), DirectorError> {
    let count = shape.iter().try_fold(1_usize, |count, size| count.checked_mul(*size)).unwrap_or(0);
    let found = view.data().len();
    let num_blocks = count.div_ceil(BLOCKS.block_size());
    if view.dtype() != Dtype::U8 || count == 0 || num_blocks.checked_mul(BLOCKS.type_size()) != Some(found) {
        return Err(bad(&name, &format!("{found} bytes of {:?}", view.dtype()), &format!("blocks of {shape:?}")));
    }
    let blocks = QStorage::from_data(Cow::Borrowed(view.data()), &Device::Cpu, BLOCKS)?;
    let mut values = QTensor::new(blocks, num_blocks * BLOCKS.block_size())?.dequantize(&Device::Cpu)?.to_vec1()?;
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
pub(crate) fn pack_tensors(tensors: &BTreeMap<String, (Vec<usize>, Vec<f32>)>) -> Result<Vec<u8>, DirectorError> {
    let mut in_blocks: BTreeMap<&str, &[usize]> = BTreeMap::new();
    let mut packed: Vec<(&str, Dtype, Vec<usize>, Vec<u8>)> = Vec::with_capacity(tensors.len());
    for (name, (shape, values)) in tensors {
        if name.starts_with("bert.") && shape.len() == 2 {
            let mut values = values.clone();
            values.resize(values.len().next_multiple_of(BLOCKS.block_size()), 0.0);
            let blocks = QTensor::quantize(&Tensor::new(values, &Device::Cpu)?, BLOCKS)?;
            let bytes = blocks.data()?.into_owned();
            in_blocks.insert(name, shape);
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
        Some(HashMap::from([(BLOCK_SHAPES.to_owned(), shapes)]))
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
