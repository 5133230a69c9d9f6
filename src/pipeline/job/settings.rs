/// How a film uses its job folder.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct JobSettings {
    /// What happens to the frames of an earlier run.
    pub start: JobStart,
    /// Whether the folder stays when the film is whole.
    pub keeps_frames: bool,
    /// Further things that the film is made from, as names and hashes: scene, objects, weights. Frames of other inputs are
    /// refused.
    pub inputs: Vec<(&'static str, String)>,
}

/// What happens to the frames of an earlier run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum JobStart {
    /// They are used.
    #[default]
    GoOn,
    /// They are removed.
    Fresh,
}
