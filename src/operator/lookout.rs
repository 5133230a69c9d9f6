//! A place from which somebody looks at a room, and the things that are to be seen from it.

use glam::DVec3;

/// A place to stand with a heading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lookout {
    /// The eye, world.
    pub(super) eye: DVec3,
    /// Azimuth of the view.
    pub(super) azimuth_rad: f64,
    /// Distance to the first surface along the view, scene units.
    pub(super) depth: f64,
    /// Depth and content of the picture, less what spoils it; only the order and the ratios mean something.
    pub(super) rating: f64,
}

/// An object as far as a lookout sees it: center and radius.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thing {
    pub(super) center: DVec3,
    pub(super) radius: f64,
}
