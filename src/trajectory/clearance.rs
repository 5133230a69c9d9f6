/// A proven lower bound of the distance between a whole camera path and the matter of its scene.
///
/// The bound holds at every moment, not only at samples. Matter is the ellipsoids of all Gaussians whose opacity is at
/// least `opacity_floor`, each out to `sigma_level` standard deviations.
#[derive(Debug, Clone, PartialEq)]
pub struct ClearanceProof {
    /// Radius of the ball around the camera that must stay clear, scene units.
    pub camera_radius: f64,
    /// Least opacity of a Gaussian that counts as matter, 0..1.
    pub opacity_floor: f64,
    /// Extent of a Gaussian's ellipsoid, standard deviations.
    pub sigma_level: f64,
    /// Every point of the path is at least this far from matter, scene units; infinite in a scene without matter.
    pub min_distance: f64,
    /// Time at which the camera is nearest to matter.
    pub at_secs: f64,
    /// Index of the Gaussian nearest to the camera at that time.
    pub gaussian_idx: Option<usize>,
    /// Number of path intervals that the proof examined.
    pub num_intervals: usize,
    /// First time interval with a distance below `camera_radius`; `None` if the path is clear.
    pub failure: Option<ClearanceFailure>,
}

/// The first time interval in which the camera is too near to matter.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ClearanceFailure {
    /// Its start.
    pub from_secs: f64,
    /// Its end.
    pub to_secs: f64,
    /// Least distance to matter within it, scene units; 0 inside matter.
    pub distance: f64,
    /// Index of the nearest Gaussian.
    pub gaussian_idx: usize,
}

impl ClearanceProof {
    /// Whether the camera stays clear of matter at every moment.
    pub fn is_clear(&self) -> bool {
        self.failure.is_none()
    }
}
