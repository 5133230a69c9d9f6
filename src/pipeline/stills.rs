use super::error::PipelineError;
use cinesplat_export::cameras_json::NamedCamera;
use cinesplat_geometry::Camera;
use cinesplat_render::{DepthMap, FeatureMap, Frame, IdMap, PixelWeight, RenderError, RenderSettings, Renderer};
use cinesplat_scene::Scene;

/// Outputs of a still beside color and transmittance. All use the same blending weights.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StillOutputs {
    /// Expected and median depth.
    pub depth: bool,
    /// One object id per Gaussian (0 = none) for a map of ids.
    pub labels: Option<Vec<u16>>,
    /// Features for a feature map: one row per Gaussian, and the number of channels of a row.
    pub features: Option<(Vec<f32>, usize)>,
    /// The weight of every splat in every pixel.
    pub weights: bool,
}

/// A picture with the name of its camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Still<'a> {
    /// Name of the camera.
    pub name: &'a str,
    /// Color and transmittance.
    pub frame: Frame,
    /// Depth, if requested.
    pub depth: Option<DepthMap>,
    /// Object ids, if requested.
    pub ids: Option<IdMap>,
    /// Features, if requested.
    pub features: Option<FeatureMap>,
    /// Weights, if requested.
    pub weights: Option<Vec<PixelWeight>>,
}

/// Renders one still per camera, in order, and passes each to `take`. An error of `take` ends the loop.
///
/// # Errors
/// [`PipelineError::Render`] for an invalid camera, or labels or features of the wrong length; otherwise the error of
/// `take`.
pub fn still<E: From<PipelineError>>(
    scene: &Scene,
    cameras: &[NamedCamera],
    settings: &RenderSettings,
    outputs: &StillOutputs,
    take: &mut dyn FnMut(Still) -> Result<(), E>,
) -> Result<(), E> {
    let renderer = Renderer::new(&scene.gaussians);
    for NamedCamera { name, camera } in cameras {
        let still = one(&renderer, name, camera, (settings, outputs)).map_err(|error| E::from(error.into()))?;
        take(still)?;
    }
    Ok(())
}

fn one<'a>(
    renderer: &Renderer<'_>,
    name: &'a str,
    camera: &Camera,
    (settings, outputs): (&RenderSettings, &StillOutputs),
) -> Result<Still<'a>, RenderError> {
    let labels = outputs.labels.as_ref();
    let features = outputs.features.as_ref();
    Ok(Still {
        name,
        frame: renderer.render(camera, settings)?,
        depth: outputs.depth.then(|| renderer.depth(camera, settings)).transpose()?,
        ids: labels.map(|labels| renderer.object_ids(camera, settings, labels)).transpose()?,
        features: features.map(|(rows, num)| renderer.features(camera, settings, rows, *num)).transpose()?,
        weights: outputs.weights.then(|| renderer.weights(camera, settings)).transpose()?,
    })
}
