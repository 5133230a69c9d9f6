//! Settings of the search.

/// Effort of the search: the number of candidates.
#[derive(Default, Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum SolveLevel {
    /// No search: one candidate. Every move has its exact geometry. The director's first camera of a step gives the
    /// bearing from which a step without a camera before it sees its subject; without a director that is the bearing of
    /// the place with the widest view of the scene. Every other open parameter takes the middle of its range, and paths
    /// are straight. Nothing is tried again where matter is in the way or a subject is hidden: the report says so.
    Off,
    /// About 300 candidates for a program of one step.
    Fast,
    /// About 1,300 candidates for a program of one step, and 1,800 more for each further step.
    #[default]
    Full,
}

/// Settings of [`realize`](crate::realize()).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolveSettings {
    /// Effort of the search.
    pub level: SolveLevel,
    /// Seed of the search. The same seed gives the same solution on any number of threads.
    pub seed: u64,
    /// Factor on the level's number of candidates, for measuring accuracy against time.
    pub tries_factor: f64,
    /// The dutch angle that the prompt requests; `None` keeps the horizon level.
    pub slant: Option<Slant>,
}

/// A slanted horizon during some steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slant {
    /// Roll of the camera in degrees, clockwise.
    pub degrees: f64,
    /// The first step that it belongs to, and the last.
    pub steps: [usize; 2],
}

impl Default for SolveSettings {
    fn default() -> Self {
        Self { level: SolveLevel::default(), seed: 0, tries_factor: 1.0, slant: None }
    }
}
