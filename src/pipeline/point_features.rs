use cinesplat_objects::{FeatureSettings, ObjectSet, fill_features};
use cinesplat_scene::Scene;
use cinesplat_vision::Dino;

use super::direct::prepare_objects;
use super::error::PipelineError;

/// Gives every object a sparse cloud if it has none, and the points of all clouds the features of a network for pictures. The
/// director does not take them: its networks were trained without.
///
/// `progress` gets the number of objects done and of all.
///
/// # Errors
/// [`PipelineError::Objects`] when the views of the objects cannot be rendered, [`PipelineError::Vision`] when the network
/// fails.
pub fn describe_points(
    scene: &Scene,
    set: &mut ObjectSet,
    dino: &Dino,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<(), PipelineError> {
    prepare_objects(scene, set)?;
    let settings = FeatureSettings::of_patches(dino.patch_px());
    let side_px = settings.picture_px as usize;
    let mut describe = |rgb8: &[u8]| Ok(dino.patches(rgb8, [side_px; 2])?.values);
    fill_features::<PipelineError>(scene, set, &settings, &mut describe, progress)
}
