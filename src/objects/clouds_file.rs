//! The clouds of an objects file: a `safetensors` file with one tensor `ID.points` (N x 3) per object.

use std::collections::BTreeMap;
use std::path::Path;

use cinesplat_files::Limits;
use glam::DVec3;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};

use super::error::ObjectsError;
use super::object::Object;

/// End of a tensor's name, after the id.
const SUFFIX: &str = ".points";

/// The points of every object, by id. Tensors with other names are ignored.
pub(crate) fn read(path: &Path) -> Result<BTreeMap<u32, Vec<DVec3>>, ObjectsError> {
    let bad = |found: String| ObjectsError::BadClouds { path: path.to_owned(), found };
    let bytes = cinesplat_files::read(path, Limits::DEFAULT.array_bytes)?;
    let tensors = SafeTensors::deserialize(&bytes).map_err(|error| bad(error.to_string()))?;
    let mut clouds = BTreeMap::new();
    for (name, tensor) in tensors.tensors() {
        let Some(id) = name.strip_suffix(SUFFIX).and_then(|id| id.parse::<u32>().ok()) else { continue };
        let points =
            points(&tensor).ok_or_else(|| bad(format!("{name}: {:?} {:?}", tensor.dtype(), tensor.shape())))?;
        clouds.insert(id, points);
    }
    Ok(clouds)
}

/// The points of a tensor; `None` for another type or shape, or for numbers that are not finite.
fn points(tensor: &TensorView) -> Option<Vec<DVec3>> {
    let [_, 3] = *tensor.shape() else { return None };
    let data = tensor.data();
    let numbers: Vec<f64> = match tensor.dtype() {
        Dtype::F64 => data.chunks_exact(8).map(|b| f64::from_le_bytes(std::array::from_fn(|i| b[i]))).collect(),
        Dtype::F32 => data.chunks_exact(4).map(|b| f32::from_le_bytes(std::array::from_fn(|i| b[i])).into()).collect(),
        _ => return None,
    };
    let is_finite = numbers.iter().all(|number| number.is_finite());
    is_finite.then(|| numbers.chunks_exact(3).map(|p| DVec3::new(p[0], p[1], p[2])).collect())
}

/// The bytes of a clouds file; objects without points have no tensor.
pub(crate) fn encode(objects: &[Object]) -> Result<Vec<u8>, ObjectsError> {
    let failed = |reason: String| ObjectsError::Picture { reason };
    let with_points: Vec<&Object> = objects.iter().filter(|object| !object.points.is_empty()).collect();
    let data: Vec<Vec<u8>> = with_points
        .iter()
        .map(|object| object.points.iter().flat_map(DVec3::to_array).flat_map(f64::to_le_bytes).collect())
        .collect();
    let mut tensors = Vec::new();
    for (object, data) in with_points.iter().zip(&data) {
        let view = TensorView::new(Dtype::F64, vec![object.points.len(), 3], data);
        tensors.push((format!("{}{SUFFIX}", object.id), view.map_err(|error| failed(error.to_string()))?));
    }
    safetensors::serialize(tensors, None).map_err(|error| failed(error.to_string()))
}
