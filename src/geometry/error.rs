use thiserror::Error;

/// Error of geometric input.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GeometryError {
    /// Eye and target of a look-at coincide, or one of them is not finite.
    #[error("camera at {eye:?} looks at {target:?}, expected two different finite points")]
    NoViewDirection {
        /// Position of the camera, world.
        eye: [f64; 3],
        /// Target, world.
        target: [f64; 3],
    },
    /// A matrix that should be a rigid transform is not one.
    #[error("not a rotation: {reason}")]
    NotARotation {
        /// What was found.
        reason: String,
    },
    /// An up direction of zero length, or with components that are not finite.
    #[error("up direction is {found:?}, expected a finite vector of nonzero length")]
    NoUpDirection {
        /// The direction given.
        found: [f64; 3],
    },
    /// An invalid image size, focal length or principal point.
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
