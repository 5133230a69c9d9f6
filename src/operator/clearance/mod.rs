//! Distances between the camera and matter, and certificates of a path's clearance.
//!
//! Enters: the Gaussians of a scene and a [`CameraPath`](cinesplat_trajectory::CameraPath). Leaves: distances to
//! matter, and a [`ClearanceProof`](cinesplat_trajectory::ClearanceProof) that holds for every moment of the path, not
//! only for samples of it.
//!
//! *Matter* is the set of ellipsoids of all Gaussians of at least [`SOLID_OPACITY`](cinesplat_scene::SOLID_OPACITY),
//! out to [`SIGMA_LEVEL`] standard deviations. The camera is a ball. It is clear of matter where the distance from its
//! center to every ellipsoid is at least its radius. A measurement to the means alone, or to ellipsoids of one standard
//! deviation, gives larger distances, never smaller ones.

mod certificate;
mod ellipsoid;
mod index;

pub use index::{ClearanceIndex, Nearest, SIGMA_LEVEL};

pub(super) use certificate::{ClearanceQuery, least_clearance, prove};
