use glam::DVec3;

use super::filter::SplatFilter;
use super::intake::Collected;
use super::up::UpPrior;

/// A decoded file before its up axis is settled.
pub(super) struct DecodedScene {
    /// Human name of the format.
    pub(super) format: String,
    /// Gaussians and what was dropped.
    pub(super) collected: Collected,
    /// Filter that the file asks for.
    pub(super) filter: Option<SplatFilter>,
    /// Up axis that the file states, with its words.
    pub(super) up: Option<(DVec3, String)>,
    /// Which up axes files of this kind tend to have.
    pub(super) up_prior: UpPrior,
}
