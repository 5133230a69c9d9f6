use super::error::PipelineError;
use cinesplat_operator;
use cinesplat_scene::Scene;
use cinesplat_trajectory::{CameraPath, ClearanceProof, Shot};

/// What can be proved about the distance between a shot's whole path and the matter of a scene.
///
/// # Errors
/// [`PipelineError::Trajectory`] for keys that cannot be used.
pub fn prove_clearance(scene: &Scene, shot: &Shot) -> Result<ClearanceProof, PipelineError> {
    let path = CameraPath::new(shot)?;
    Ok(in_file_order(scene, cinesplat_operator::prove_clear(&scene.gaussians, &path)))
}

/// The proof with Gaussians counted as in the scene's file, those that were dropped on reading included.
pub(super) fn in_file_order(scene: &Scene, mut proof: ClearanceProof) -> ClearanceProof {
    let file_idx = |kept: usize| {
        // Every dropped one that stands before moves it by one.
        scene.dropped.iter().fold(kept, |at, &dropped| if dropped as usize <= at { at + 1 } else { at })
    };
    proof.gaussian_idx = proof.gaussian_idx.map(file_idx);
    if let Some(failure) = &mut proof.failure {
        failure.gaussian_idx = file_idx(failure.gaussian_idx);
    }
    proof
}
