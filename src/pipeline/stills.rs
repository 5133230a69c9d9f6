use super::PipelineError;
use crate::export::cameras_json::NamedCamera;
use crate::render::{Frame, RenderSettings, Renderer};
use crate::scene::Scene;

/// A picture with the name of its camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Still<'a> {
    /// Name of the camera.
    pub name: &'a str,
    /// What it sees.
    pub frame: Frame,
}

/// Takes one picture a camera, in order, and hands each to `take`, which may stop with an error of its own.
///
/// # Errors
/// [`PipelineError::Render`] for a camera that cannot be; else what `take` returns.
pub fn still<E: From<PipelineError>>(
    scene: &Scene,
    cameras: &[NamedCamera],
    settings: &RenderSettings,
    take: &mut dyn FnMut(Still) -> Result<(), E>,
) -> Result<(), E> {
    let renderer = Renderer::new(&scene.gaussians);
    for NamedCamera { name, camera } in cameras {
        let frame = renderer.render(camera, settings).map_err(|error| E::from(error.into()))?;
        take(Still { name, frame })?;
    }
    Ok(())
}
