use super::error::PipelineError;
use cinesplat_export::cameras_json::NamedCamera;
use cinesplat_geometry::Camera;
use cinesplat_render::{DepthMap, FeatureMap, Frame, IdMap, PixelWeight, RenderError, RenderSettings, Renderer};
use cinesplat_scene::Scene;

/// What a still holds beside color and transmittance, all from the same weights.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StillOutputs {
    /// Expected and median depth.
    pub depth: bool,
    /// Labels of the Gaussians (one each, 0 = none) for a map of ids.
    pub labels: Option<Vec<u16>>,
    /// Rows of features of the Gaussians and the channels of a row, for a feature map.
    pub features: Option<(Vec<f32>, usize)>,
    /// The list of weights.
    pub weights: bool,
}

/// A picture with the name of its camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Still<'a> {
    /// Name of the camera.
    pub name: &'a str,
    /// What it sees.
    pub frame: Frame,
    /// Depth, where asked for.
    pub depth: Option<DepthMap>,
    /// Object ids, where asked for.
    pub ids: Option<IdMap>,
    /// Features, where asked for.
    pub features: Option<FeatureMap>,
    /// Weights, where asked for.
    pub weights: Option<Vec<PixelWeight>>,
}

/// Takes one picture a camera, in order, and hands each to `take`, which may stop with an error of its own.
///
/// # Errors
/// [`PipelineError::Render`] for a camera that cannot be, labels or features of another length; else what `take`
/// returns.
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
