use std::ops::RangeInclusive;

use strum::{AsRefStr, Display, EnumString, IntoStaticStr, VariantArray, VariantNames};

/// Kind of a generated scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, AsRefStr, Display, EnumString, IntoStaticStr, VariantArray, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum SynthKind {
    /// A furnished room: living room, dining room, bedroom, kitchen, study, studio or workshop.
    Room,
    /// A still life on a table in the middle of a room.
    Tabletop,
}

/// Parameters of a generated scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SynthSettings {
    /// Seed of every random draw: equal settings give equal scenes.
    pub seed: u64,
    /// Room or still life.
    pub kind: SynthKind,
    /// Number of Gaussians relative to film quality, in [`SynthSettings::DETAIL_RANGE`]: 1 gives several hundred thousand, 0.1 suffices for
    /// training data.
    pub detail: f64,
}

impl SynthSettings {
    /// Allowed values of [`SynthSettings::detail`]; NaN is not among them.
    pub const DETAIL_RANGE: RangeInclusive<f64> = 0.01..=4.0;
}

impl Default for SynthSettings {
    /// The room of the demo and of the README.
    fn default() -> Self {
        Self { seed: 31, kind: SynthKind::Room, detail: 1.0 }
    }
}
