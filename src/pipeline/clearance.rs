use super::error::PipelineError;
use super::film::called_effects;
use cinesplat_lens::{Called, EffectChoice};
use cinesplat_operator;
use cinesplat_scene::Scene;
use cinesplat_trajectory::{CameraPath, ClearanceProof, Shot};

/// A lower bound of the distance between the camera and the solid Gaussians of a scene, over the whole path of a shot.
///
/// # Errors
/// [`PipelineError::Trajectory`] for keyframes that make no path.
pub fn prove_clearance(scene: &Scene, shot: &Shot) -> Result<ClearanceProof, PipelineError> {
    let path = CameraPath::new(shot)?;
    Ok(in_file_order(scene, cinesplat_operator::prove_clear_around(&scene.gaussians, &path, reach(scene, shot))))
}

/// Gives a shot its proof of clearance, and makes its report say the same.
///
/// # Errors
/// As [`prove_clearance`].
pub fn certify(scene: &Scene, shot: &mut Shot) -> Result<(), PipelineError> {
    let proof = prove_clearance(scene, shot)?;
    cinesplat_operator::restate_clearance(&mut shot.report, &proof, scene.bounds().size());
    shot.clearance = Some(proof);
    Ok(())
}

/// How far the effects of a shot take the camera from its path, scene units.
fn reach(scene: &Scene, shot: &Shot) -> f64 {
    let size = scene.bounds().size();
    reach_of(&called_effects(shot, &EffectChoice::Auto, size))
}

/// How far effects take the camera from its path, scene units.
pub(super) fn reach_of(called: &Called) -> f64 {
    called.effects.iter().map(|called| called.effect.reach()).sum()
}

/// The proof with indices of Gaussians in the scene's file, where dropped Gaussians count too.
pub(super) fn in_file_order(scene: &Scene, mut proof: ClearanceProof) -> ClearanceProof {
    let file_idx = |kept: usize| {
        // Each dropped Gaussian before it shifts the index by one.
        scene.dropped.iter().fold(kept, |at, &dropped| if dropped as usize <= at { at + 1 } else { at })
    };
    proof.gaussian_idx = proof.gaussian_idx.map(file_idx);
    if let Some(failure) = &mut proof.failure {
        failure.gaussian_idx = file_idx(failure.gaussian_idx);
    }
    proof
}
