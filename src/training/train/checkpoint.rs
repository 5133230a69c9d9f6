//! Checkpoints: the whole state of a training run. A resumed run gives the same weights as an uninterrupted one.

use std::collections::BTreeMap;
use std::path::Path;

use candle_core::{Device, Tensor, Var};
use safetensors::tensor::{Dtype, SafeTensors, TensorView};

use super::error::TrainError;
use super::optimizer::{AdamW, Moments};
use cinesplat_files::{Existing, Limits};

/// Metadata key of the step count.
const STEPS: &str = "steps";
/// Metadata key of the settings.
const SETTINGS: &str = "settings";

/// Writes weights, moments, step count and settings. The file appears complete or not at all.
///
/// # Errors
/// [`TrainError::File`] · [`TrainError::BadCheckpoint`] when the tensors cannot be serialized.
pub(super) fn write(
    path: &Path,
    vars: &BTreeMap<String, Var>,
    optimizer: &AdamW,
    settings: &str,
) -> Result<(), TrainError> {
    let mut arrays: Vec<(String, Vec<usize>, Vec<f32>)> = Vec::new();
    for (name, var) in vars {
        arrays.push((format!("weight/{name}"), var.dims().to_vec(), var.flatten_all()?.to_vec1()?));
        if let Some(moments) = optimizer.moments.get(name) {
            arrays.push((format!("mean/{name}"), var.dims().to_vec(), moments.mean.clone()));
            arrays.push((format!("square/{name}"), var.dims().to_vec(), moments.square.clone()));
        }
    }
    let bad = |error: safetensors::SafeTensorError| TrainError::BadCheckpoint {
        path: path.to_owned(),
        found: error.to_string(),
    };
    let views = arrays.iter().map(|(name, shape, values)| {
        Ok((name.clone(), TensorView::new(Dtype::F32, shape.clone(), bytemuck::cast_slice(values))?))
    });
    let views = views.collect::<Result<Vec<_>, safetensors::SafeTensorError>>().map_err(bad)?;
    let metadata = [(STEPS, optimizer.steps.to_string()), (SETTINGS, settings.to_owned())];
    let metadata = metadata.map(|(key, value)| (key.to_owned(), value)).into_iter().collect();
    let bytes = safetensors::serialize(views, Some(metadata)).map_err(bad)?;
    Ok(cinesplat_files::write(path, &bytes, Existing::Replace)?)
}

/// Reads the weights of a checkpoint into `vars` and returns the state of the optimizer.
///
/// # Errors
/// [`TrainError::File`] · [`TrainError::BadCheckpoint`] when the file is damaged, or when its settings or tensors differ from
/// those of this training.
pub(super) fn read(path: &Path, vars: &BTreeMap<String, Var>, settings: &str) -> Result<AdamW, TrainError> {
    let bad = |found: String| TrainError::BadCheckpoint { path: path.to_owned(), found };
    let bytes = cinesplat_files::read(path, Limits::DEFAULT.array_bytes)?;
    let (_, header) = SafeTensors::read_metadata(&bytes).map_err(|error| bad(error.to_string()))?;
    let metadata = header.metadata().clone().unwrap_or_default();
    match metadata.get(SETTINGS) {
        Some(found) if found == settings => {}
        found => return Err(bad(format!("settings {found:?} instead of {settings}"))),
    }
    let steps = metadata.get(STEPS).and_then(|steps| steps.parse().ok()).ok_or_else(|| bad("no step count".into()))?;
    let file = SafeTensors::deserialize(&bytes).map_err(|error| bad(error.to_string()))?;
    let mut optimizer = AdamW { steps, moments: BTreeMap::new() };
    for (name, var) in vars {
        let values = |kind: &str| -> Result<Vec<f32>, TrainError> {
            let view = file.tensor(&format!("{kind}/{name}")).map_err(|error| bad(error.to_string()))?;
            if view.dtype() != Dtype::F32 || view.shape() != var.dims() {
                return Err(bad(format!("{kind}/{name} of {:?} {:?}", view.dtype(), view.shape())));
            }
            Ok(view.data().as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect())
        };
        var.set(&Tensor::from_vec(values("weight")?, var.shape(), &Device::Cpu)?)?;
        optimizer.moments.insert(name.clone(), Moments { mean: values("mean")?, square: values("square")? });
    }
    Ok(optimizer)
}
