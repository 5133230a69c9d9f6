/// What was proved about the distance between a whole path, every moment of it, and the matter of its scene.
///
/// Matter: the ellipsoids of all Gaussians of at least `opacity_floor`, out to `sigma_level` standard deviations.
#[derive(Debug, Clone, PartialEq)]
pub struct ClearanceProof {
    /// Radius of the ball that stands for the camera, scene units.
    pub camera_radius: f64,
    /// Opacity from which a Gaussian is matter.
    pub opacity_floor: f64,
    /// Standard deviations out to which it is.
    pub sigma_level: f64,
    /// No point of the path is nearer to matter than this, scene units; infinite where there is none.
    pub least: f64,
    /// When the camera is nearest to matter.
    pub at_secs: f64,
    /// Index of the Gaussian that it is nearest to then.
    pub gaussian_idx: Option<usize>,
    /// Parts of the path that the proof looked at.
    pub num_parts: usize,
    /// Where it comes nearer than the radius; `None` when it is proved that it never does.
    pub failure: Option<ClearanceFailure>,
}

/// The first stretch of a path that is not clear of matter.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ClearanceFailure {
    /// When it begins.
    pub from_secs: f64,
    /// When it ends.
    pub to_secs: f64,
    /// Distance to matter at its nearest, scene units; 0 inside.
    pub distance: f64,
    /// Index of the Gaussian in the way.
    pub gaussian_idx: usize,
}

impl ClearanceProof {
    /// Whether the camera is clear of matter at every moment.
    pub fn is_clear(&self) -> bool {
        self.failure.is_none()
    }
}
