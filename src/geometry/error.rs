use thiserror::Error;

/// What can be wrong with geometric input.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GeometryError {
    /// Eye and target of a look-at coincide, or one of them is not finite.
    #[error("cannot look from {eye:?} at {target:?}: the two must be finite and apart")]
    NoViewDirection {
        /// Where the camera stands, world.
        eye: [f64; 3],
        /// What it should look at, world.
        target: [f64; 3],
    },
    /// A matrix that should be a rigid transform is not one.
    #[error("not a rotation: {reason}")]
    NotARotation {
        /// What was found.
        reason: String,
    },
    /// An up direction of zero length or with parts that are not finite.
    #[error("up direction {found:?} has no length")]
    NoUpDirection {
        /// The direction given.
        found: [f64; 3],
    },
    /// Image size or focal length that no camera can have.
    #[error("bad intrinsics: {reason}")]
    BadIntrinsics {
        /// What was found.
        reason: String,
    },
}

impl GeometryError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        "GEOMETRY"
    }
}
