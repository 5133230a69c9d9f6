use glam::DVec3;

use super::filter::SplatFilter;
use super::intake::Collected;

/// A decoded file, before the choice of its up axis.
pub(super) struct DecodedScene {
    /// Name of the format, such as `spz v2`.
    pub(super) format: String,
    /// Gaussians, positions of the dropped ones, notes.
    pub(super) collected: Collected,
    /// Filter that the file states.
    pub(super) filter: Option<SplatFilter>,
    /// World up that the file states, with the text that states it.
    pub(super) up: Option<(DVec3, String)>,
    /// SHA-256 of each further file that was read, in a fixed order, with its name where the files present decide which is read.
    pub(super) further_sha256: Vec<String>,
}
