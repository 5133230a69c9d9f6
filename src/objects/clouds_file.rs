//! The clouds of an objects file: a `safetensors` file with one tensor `ID.points` (N x 3) per object, and `ID.dino`
//! (N x channels) where its points have features.

use std::collections::BTreeMap;
use std::path::Path;

use cinesplat_files::Limits;
use glam::DVec3;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};

use super::error::ObjectsError;
use super::object::{Object, PointFeatures};

/// Ends of the names of tensors, after the id.
const POINTS: &str = ".points";
const FEATURES: &str = ".dino";

/// The points of every object, and their features, by id. Tensors with other names are ignored.
pub(crate) fn read(path: &Path) -> Result<BTreeMap<u32, (Vec<DVec3>, PointFeatures)>, ObjectsError> {
    let bad = |found: String| ObjectsError::BadClouds { path: path.to_owned(), found };
    let bytes = cinesplat_files::read(path, Limits::DEFAULT.array_bytes)?;
    let tensors = SafeTensors::deserialize(&bytes).map_err(|error| bad(error.to_string()))?;
    let told = |name: &str, tensor: &TensorView| bad(format!("{name}: {:?} {:?}", tensor.dtype(), tensor.shape()));
    let id_of = |name: &str, suffix: &str| name.strip_suffix(suffix).and_then(|id| id.parse::<u32>().ok());
    let mut clouds = BTreeMap::new();
    for (name, tensor) in tensors.tensors() {
        if let Some(id) = id_of(&name, POINTS) {
            let points = points(&tensor).ok_or_else(|| told(&name, &tensor))?;
            clouds.insert(id, (points, PointFeatures::default()));
        }
    }
    for (name, tensor) in tensors.tensors() {
        let Some(id) = id_of(&name, FEATURES) else { continue };
        let (points, features) = clouds.get_mut(&id).ok_or_else(|| bad(format!("{name} without {id}{POINTS}")))?;
        *features = features_of(&tensor, points.len()).ok_or_else(|| told(&name, &tensor))?;
    }
    Ok(clouds)
}

/// The points of a tensor; `None` for another type or shape, or for numbers that are not finite.
fn points(tensor: &TensorView) -> Option<Vec<DVec3>> {
    let [_, 3] = *tensor.shape() else { return None };
    let numbers: Vec<f64> = match tensor.dtype() {
        Dtype::F64 => tensor.data().as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect(),
        Dtype::F32 => f32s(tensor).into_iter().map(f64::from).collect(),
        _ => return None,
    };
    let is_finite = numbers.iter().all(|number| number.is_finite());
    is_finite.then(|| numbers.chunks_exact(3).map(|p| DVec3::new(p[0], p[1], p[2])).collect())
}

/// The features of a tensor; `None` for another type or number of points, or for numbers that are not finite.
fn features_of(tensor: &TensorView, num_points: usize) -> Option<PointFeatures> {
    let [rows, num_channels] = *tensor.shape() else { return None };
    let is_fitting = rows == num_points && tensor.dtype() == Dtype::F32;
    let features = is_fitting.then(|| PointFeatures { num_channels, values: f32s(tensor) })?;
    features.values.iter().all(|value| value.is_finite()).then_some(features)
}

fn f32s(tensor: &TensorView) -> Vec<f32> {
    tensor.data().as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect()
}

/// A tensor as it is stored.
struct Stored {
    name: String,
    dtype: Dtype,
    shape: Vec<usize>,
    bytes: Vec<u8>,
}

/// The bytes of a clouds file; objects without points have no tensor, nor have points without features.
pub(crate) fn encode(objects: &[Object]) -> Result<Vec<u8>, ObjectsError> {
    let mut stored: Vec<Stored> = Vec::new();
    for object in objects.iter().filter(|object| !object.points.is_empty()) {
        let (num_points, features) = (object.points.len(), &object.features);
        let bytes = object.points.iter().flat_map(DVec3::to_array).flat_map(f64::to_le_bytes).collect();
        let name = format!("{}{POINTS}", object.id);
        stored.push(Stored { name, dtype: Dtype::F64, shape: vec![num_points, 3], bytes });
        if features.num_channels > 0 {
            let bytes = features.values.iter().copied().flat_map(f32::to_le_bytes).collect();
            let name = format!("{}{FEATURES}", object.id);
            stored.push(Stored { name, dtype: Dtype::F32, shape: vec![num_points, features.num_channels], bytes });
        }
    }
    let failed = |error: safetensors::SafeTensorError| ObjectsError::Picture { reason: error.to_string() };
    let mut tensors = Vec::with_capacity(stored.len());
    for Stored { name, dtype, shape, bytes } in &stored {
        tensors.push((name, TensorView::new(*dtype, shape.clone(), bytes).map_err(failed)?));
    }
    safetensors::serialize(tensors, None).map_err(failed)
}
