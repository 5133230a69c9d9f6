//! Blur of single splats: depth of field of a thin lens, and motion during an exposure.
//!
//! Enters: a lens, and the cameras at the ends of an exposure. Leaves: what is added to the covariance of each splat. A
//! disk of diameter c has the variance c^2 / 16 along any axis; a line of length v has v^2 / 12 along itself. Both are
//! convolutions of the splat with a kernel of that variance (elliptical weighted average; Krivanek, Zara and Bouatouch,
//! Fast Depth of Field Rendering with Surface Splatting, 2003). [`super::spread`] says what becomes of the opacity.

use glam::{DMat3, DVec2, DVec3};

use super::RenderError;
use cinesplat_geometry::Camera;

/// A thin lens that is focused on a plane across the view axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinLens {
    /// Diameter of the aperture, scene units, 0 or more.
    pub aperture_diameter: f64,
    /// Distance of sharpest focus along the view axis, scene units, above 0; may be infinite.
    pub focus_distance: f64,
    /// Height of the aperture, which is its diameter, over its width, 1 or more: anamorphic lenses have oval ones.
    pub squeeze: f64,
}

impl ThinLens {
    /// Diameter of the circle of confusion at a depth, pixels: f A |1 / depth - 1 / focus distance|.
    pub fn circle_px(&self, focal_px: f64, depth: f64) -> f64 {
        focal_px * self.aperture_diameter * (1.0 / depth - 1.0 / self.focus_distance).abs()
    }

    /// The pinhole camera at a point of the aperture, given in radii of the aperture (right, down). Points in the plane
    /// of focus keep their pixels.
    pub fn pinhole(&self, camera: &Camera, point: DVec2) -> Camera {
        let offset = point * self.oval() * (0.5 * self.aperture_diameter);
        let (mut pose, mut intrinsics) = (camera.pose, camera.intrinsics);
        pose.position += pose.rotation * offset.extend(0.0);
        intrinsics.cx_px += intrinsics.fx_px * offset.x / self.focus_distance;
        intrinsics.cy_px += intrinsics.fy_px * offset.y / self.focus_distance;
        Camera { pose, intrinsics }
    }

    /// Width and height of the aperture over its diameter.
    fn oval(&self) -> DVec2 {
        DVec2::new(1.0 / self.squeeze, 1.0)
    }

    fn check(&self) -> Result<(), RenderError> {
        let Self { aperture_diameter: aperture, focus_distance: focus, squeeze } = *self;
        if !(squeeze >= 1.0 && squeeze.is_finite()) {
            let expected = "a finite number, 1 or more";
            return Err(RenderError::Setting { name: "squeeze of the aperture", found: squeeze, expected });
        }
        if !(aperture >= 0.0 && aperture.is_finite()) {
            let expected = "a finite length, 0 or more";
            return Err(RenderError::Setting { name: "aperture diameter", found: aperture, expected });
        }
        if focus > 0.0 {
            return Ok(());
        }
        Err(RenderError::Setting { name: "focus distance", found: focus, expected: "above 0" })
    }
}

/// Blur of each splat of one picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SplatBlur {
    /// Depth of field; `None` = a pinhole.
    pub lens: Option<ThinLens>,
    /// The cameras at the start and at the end of the exposure; `None` = an instant.
    pub motion: Option<[Camera; 2]>,
}

impl SplatBlur {
    /// Whether it blurs nothing.
    pub fn is_none(&self) -> bool {
        self.lens.is_none_or(|lens| lens.aperture_diameter == 0.0)
            && self.motion.is_none_or(|[start, end]| start == end)
    }
}

/// One picture of an exposure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SubFrame {
    /// The camera.
    pub camera: Camera,
    /// Blur of its splats.
    pub blur: SplatBlur,
}

impl From<Camera> for SubFrame {
    /// The sharp picture of a camera.
    fn from(camera: Camera) -> Self {
        Self { camera, blur: SplatBlur::default() }
    }
}

impl SubFrame {
    /// The same picture at `factor` times the resolution.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let scaled = |camera: Camera| Camera { intrinsics: camera.intrinsics.scaled(factor), ..camera };
        let motion = self.blur.motion.map(|cameras| cameras.map(scaled));
        Self { camera: scaled(self.camera), blur: SplatBlur { motion, ..self.blur } }
    }
}

/// The blur of the splats of a view.
#[derive(Debug, Clone, Copy)]
pub(super) struct ViewBlur {
    /// Diameter of the circle of confusion over |1 / depth - 1 / focus distance|, pixels times scene units, x and y.
    aperture_px: DVec2,
    inverse_focus: f64,
    motion: Option<[Pinhole; 2]>,
    near: f64,
}

/// A camera in the form that projecting means needs.
#[derive(Debug, Clone, Copy)]
struct Pinhole {
    camera_from_world: DMat3,
    center: DVec3,
    focal_px: DVec2,
    principal_px: DVec2,
}

/// What blur adds to the covariance of a splat, pixels squared: a diagonal, and the product of a vector with itself.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AddedVariance {
    pub(super) disk: DVec2,
    pub(super) smear: DVec2,
}

impl ViewBlur {
    /// The blur in a view with this focal length and near plane, on a scene with origin `origin`; `None` if it blurs
    /// nothing.
    ///
    /// # Errors
    /// [`RenderError::Setting`] for a lens out of range, [`RenderError::Camera`] for an unusable camera.
    pub(super) fn new(
        blur: &SplatBlur,
        (focal_px, near): ([f64; 2], f64),
        origin: DVec3,
    ) -> Result<Option<Self>, RenderError> {
        blur.lens.iter().try_for_each(ThinLens::check)?;
        if blur.is_none() {
            return Ok(None);
        }
        let motion = match &blur.motion {
            Some([start, end]) if start != end => Some([Pinhole::new(start, origin)?, Pinhole::new(end, origin)?]),
            _ => None,
        };
        let (aperture, inverse_focus) = blur
            .lens
            .map_or((DVec2::ZERO, 0.0), |lens| (lens.oval() * lens.aperture_diameter, 1.0 / lens.focus_distance));
        Ok(Some(Self { aperture_px: DVec2::from(focal_px) * aperture, inverse_focus, motion, near }))
    }

    /// What is added to the covariance of a Gaussian at `mean` (relative to the scene's origin) and `depth`.
    #[inline(always)]
    pub(super) fn added(&self, mean: DVec3, depth: f64) -> AddedVariance {
        let circle = self.aperture_px * (1.0 / depth - self.inverse_focus);
        AddedVariance { disk: circle * circle * (1.0 / 16.0), smear: self.motion_px(mean) * 12_f64.sqrt().recip() }
    }

    /// Motion of a mean during the exposure, pixels. Ends at the near plane.
    #[inline(always)]
    fn motion_px(&self, mean: DVec3) -> DVec2 {
        match &self.motion {
            Some([start, end]) => end.project(mean, self.near) - start.project(mean, self.near),
            None => DVec2::ZERO,
        }
    }

    /// Circle of confusion and length of the motion of a mean, pixels.
    pub(super) fn lengths_px(&self, mean: DVec3, depth: f64) -> [f64; 2] {
        let circle = self.aperture_px * (1.0 / depth - self.inverse_focus);
        [circle.abs().max_element(), self.motion_px(mean).length()]
    }

    /// Upper bound of the standard deviation that blur adds to any member of a group, pixels. `center` is the center of
    /// the group's sphere in the camera's axes.
    pub(super) fn max_deviation_px(&self, center: DVec3, radius: f64) -> f64 {
        let depths = [center.z - radius, center.z + radius].map(|depth| depth.max(self.near).max(f64::MIN_POSITIVE));
        let off_focus = depths.map(|depth| (1.0 / depth - self.inverse_focus).abs());
        let disk = self.aperture_px.max_element() * off_focus[0].max(off_focus[1]) / 4.0;
        let Some([start, end]) = &self.motion else { return disk };
        let turn = start.camera_from_world - end.camera_from_world;
        let turn = turn.x_axis.length() + turn.y_axis.length() + turn.z_axis.length();
        let apart = (end.center - start.center).length() + turn * (center.length() + radius);
        let depth = (center.z - radius - apart).max(self.near).max(f64::MIN_POSITIVE);
        let slope = (center.length() + radius + apart) / depth;
        let focal = end.focal_px.max(start.focal_px).max_element();
        let zoom = (end.focal_px - start.focal_px).length() * slope + (end.principal_px - start.principal_px).length();
        disk + (focal * apart * (1.0 + slope) / depth + zoom) * 12_f64.sqrt().recip()
    }
}

impl Pinhole {
    fn new(camera: &Camera, origin: DVec3) -> Result<Self, RenderError> {
        let image = camera.intrinsics.validated()?;
        Ok(Self {
            camera_from_world: DMat3::from_quat(camera.pose.rotation.conjugate()),
            center: camera.pose.position - origin,
            focal_px: DVec2::new(image.fx_px, image.fy_px),
            principal_px: DVec2::new(image.cx_px, image.cy_px),
        })
    }

    /// Pixel position of a point, whose depth is at least `near`.
    #[inline(always)]
    fn project(&self, point: DVec3, near: f64) -> DVec2 {
        let p = self.camera_from_world * (point - self.center);
        self.focal_px * p.truncate() / p.z.max(near) + self.principal_px
    }
}
