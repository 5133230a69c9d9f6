use glam::{DVec2, DVec3};

use super::{GeometryError, Pose};

/// Image size, focal lengths and principal point of a pinhole camera, in pixels.
///
/// The origin is the top left corner of the image; pixel centers are at +0.5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intrinsics {
    /// Image width in pixels.
    pub width: u32,
    /// Image height in pixels.
    pub height: u32,
    /// Horizontal focal length.
    pub fx_px: f64,
    /// Vertical focal length.
    pub fy_px: f64,
    /// Principal point, horizontal.
    pub cx_px: f64,
    /// Principal point, vertical.
    pub cy_px: f64,
}

impl Intrinsics {
    /// Intrinsics with a vertical field of view, square pixels and the principal point in the middle of the image.
    pub fn from_fov_y(width: u32, height: u32, fov_y_rad: f64) -> Self {
        let focal_px = f64::from(height) / 2.0 / (fov_y_rad / 2.0).tan();
        let (cx_px, cy_px) = (f64::from(width) / 2.0, f64::from(height) / 2.0);
        Self { width, height, fx_px: focal_px, fy_px: focal_px, cx_px, cy_px }
    }

    /// Vertical field of view of an image centered on the principal point.
    pub fn fov_y_rad(&self) -> f64 {
        2.0 * (f64::from(self.height) / 2.0 / self.fy_px).atan()
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.width) / f64::from(self.height)
    }

    /// The same picture at `factor` times the resolution. Width and height are rounded, at least one pixel.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let size = |pixels: u32| ((f64::from(pixels) * factor).round() as u32).max(1);
        self.resized(size(self.width), size(self.height))
    }

    /// The same picture at another size, in pixels.
    #[must_use]
    pub fn resized(&self, width: u32, height: u32) -> Self {
        let (x, y) = (f64::from(width) / f64::from(self.width), f64::from(height) / f64::from(self.height));
        Self {
            width,
            height,
            fx_px: self.fx_px * x,
            fy_px: self.fy_px * y,
            cx_px: self.cx_px * x,
            cy_px: self.cy_px * y,
        }
    }

    /// The intrinsics themselves, if they are usable.
    ///
    /// # Errors
    /// [`GeometryError::BadIntrinsics`] for an empty image, a focal length that is not finite and above 0, or a
    /// principal point that is not finite.
    pub fn validated(self) -> Result<Self, GeometryError> {
        let focal = self.fx_px > 0.0 && self.fy_px > 0.0 && self.fx_px.is_finite() && self.fy_px.is_finite();
        if self.width == 0 || self.height == 0 || !focal || !self.cx_px.is_finite() || !self.cy_px.is_finite() {
            let reason = format!("{self:?} needs a size and focal lengths above 0");
            return Err(GeometryError::BadIntrinsics { reason });
        }
        Ok(self)
    }
}

/// A pinhole camera at a pose in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// `world_from_camera`.
    pub pose: Pose,
    /// Image size and projection.
    pub intrinsics: Intrinsics,
}

impl Camera {
    /// Pixel position and depth along the view axis of a world point; `None` where the depth is not above 0.
    pub fn project(&self, point_world: DVec3) -> Option<(DVec2, f64)> {
        let p = self.pose.to_camera(point_world);
        let k = &self.intrinsics;
        (p.z > 0.0).then(|| (DVec2::new(k.fx_px * p.x / p.z + k.cx_px, k.fy_px * p.y / p.z + k.cy_px), p.z))
    }

    /// Unit direction, in the world, of the ray through a pixel position.
    pub fn ray(&self, position_px: DVec2) -> DVec3 {
        let k = &self.intrinsics;
        let direction = DVec3::new((position_px.x - k.cx_px) / k.fx_px, (position_px.y - k.cy_px) / k.fy_px, 1.0);
        self.pose.rotation * direction.normalize()
    }
}
