//! How far the camera is from matter, and proofs about it for whole paths.
//!
//! Enters: the Gaussians of a scene and a [`CameraPath`](cinesplat_trajectory::CameraPath). Leaves: distances to matter,
//! and a [`ClearanceProof`](cinesplat_trajectory::ClearanceProof) for every moment of the path, not for samples of it.
//!
//! *Matter* is the set of ellipsoids of all Gaussians of at least [`SOLID_OPACITY`](cinesplat_scene::SOLID_OPACITY), out to [`SIGMA_LEVEL`] standard
//! deviations. The camera is a ball; it is clear of matter where no ellipsoid comes nearer to its center than its
//! radius. Whoever measures to the means alone, or to ellipsoids of one standard deviation, finds more room, never less.

mod certificate;
mod ellipsoid;
mod index;

pub use index::{ClearanceIndex, Nearest};

pub(super) use certificate::{Search, least_clearance, prove};

/// Standard deviations out to which a Gaussian is matter: there its opacity has fallen to a third of its peak, so that
/// one of the floor's opacity hides a sixth of the light.
pub const SIGMA_LEVEL: f64 = 1.5;
