use glam::{DMat3, DVec3};

use super::blur::{SplatBlur, ViewBlur};
use super::{Fog, InstructionSet, RenderError, RenderSettings, SortMode, spec};
use cinesplat_geometry::Camera;

/// A camera and the settings in the form that rendering needs.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    /// Rotation from the world's axes to the camera's.
    pub(super) camera_from_world: DMat3,
    /// Camera center minus the scene's origin, world axes, scene units.
    pub(super) center: DVec3,
    /// Image width in pixels.
    pub(super) width: u32,
    /// Image height in pixels.
    pub(super) height: u32,
    /// Focal lengths in pixels, x and y.
    pub(super) focal_px: [f64; 2],
    /// Principal point in pixels.
    pub(super) principal_px: [f64; 2],
    /// Bounds of x / z at which the projection is linearized.
    pub(super) slope_x: (f64, f64),
    /// Bounds of y / z at which the projection is linearized.
    pub(super) slope_y: (f64, f64),
    /// Near plane, scene units.
    pub(super) near: f64,
    /// Dilation: added to the diagonal of a splat's covariance, pixels squared.
    pub(super) dilation_px2: f64,
    /// Whether opacity compensates for the dilation.
    pub(super) is_compensated: bool,
    /// Opacity below which a splat is skipped.
    pub(super) alpha_cut: f64,
    /// Blending stops before the transmittance would fall below this.
    pub(super) transmittance_stop: f64,
    /// Depth that orders the splats.
    pub(super) sort: SortMode,
    /// Fog between the camera and the scene.
    pub(super) fog: Option<Fog>,
    /// Upper bound of a Gaussian's color.
    pub(super) max_color: f32,
    /// Instruction set to use.
    pub(super) instructions: InstructionSet,
    /// Whether to start from the depth order of the previous picture.
    pub(super) reuses_order: bool,
    /// Blur of splats.
    pub(super) blur: Option<ViewBlur>,
}

impl View {
    /// The view of a camera on a scene with origin `origin`.
    ///
    /// # Errors
    /// [`RenderError::Camera`] for unusable intrinsics, [`RenderError::Setting`] for a setting out of range or a pose
    /// that is not finite.
    pub(super) fn new(camera: &Camera, origin: DVec3, settings: &RenderSettings) -> Result<Self, RenderError> {
        settings.check()?;
        let image = camera.intrinsics.validated()?;
        let camera_from_world = DMat3::from_quat(camera.pose.rotation.conjugate());
        let center = camera.pose.position - origin;
        if !(center.is_finite() && camera_from_world.is_finite()) {
            return Err(RenderError::Setting { name: "camera pose", found: f64::NAN, expected: "finite numbers" });
        }
        let accuracy = settings.effective_accuracy();
        let (width_px, height_px) = (f64::from(image.width), f64::from(image.height));
        Ok(Self {
            camera_from_world,
            center,
            width: image.width,
            height: image.height,
            focal_px: [image.fx_px, image.fy_px],
            principal_px: [image.cx_px, image.cy_px],
            slope_x: spec::slope_bounds(width_px, image.fx_px, image.cx_px),
            slope_y: spec::slope_bounds(height_px, image.fy_px, image.cy_px),
            near: settings.near,
            dilation_px2: settings.dilation_px2(),
            is_compensated: settings.is_compensated(),
            alpha_cut: accuracy.alpha_cut,
            transmittance_stop: accuracy.transmittance_stop,
            sort: settings.sort,
            fog: settings.fog,
            max_color: settings.color_clamp.max_color(),
            instructions: settings.instructions,
            reuses_order: settings.reuses_order,
            blur: None,
        })
    }

    /// The view with blur of splats.
    ///
    /// # Errors
    /// [`RenderError::Setting`] for a lens out of range, [`RenderError::Camera`] for an unusable camera.
    pub(super) fn blurred(self, blur: &SplatBlur, origin: DVec3) -> Result<Self, RenderError> {
        let blur = ViewBlur::new(blur, (self.focal_px, self.near), origin)?;
        Ok(Self { blur, ..self })
    }

    /// Depth that a Gaussian is sorted by, scene units: along the view axis, or its distance in mode `ray`. Rounded
    /// once, so that the order equals that of the spec image.
    pub(super) fn sort_distance(&self, mean: DVec3, depth: f64) -> f32 {
        match self.sort {
            SortMode::Z => depth as f32,
            SortMode::Ray => (mean - self.center).length() as f32,
        }
    }
}
