//! The choices whose certainty is reported.

use crate::codes::{Field, QuantityRole};

/// A choice that the network makes for a key. Its text is its name in reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::Display, strum::IntoStaticStr)]
pub enum Choice {
    /// The class of a field.
    #[strum(transparent)]
    Class(Field),
    /// Subjects when the camera arrives at the key.
    #[strum(serialize = "end subjects")]
    EndSubjects,
    /// Subjects when the camera departs from the key.
    #[strum(serialize = "start subjects")]
    StartSubjects,
    /// Objects that the segment passes.
    #[strum(serialize = "objects on the way")]
    PassedObjects,
    /// What the camera looks at.
    #[strum(serialize = "look")]
    Look,
    /// Objects that stay in view.
    #[strum(serialize = "kept in view")]
    Keep,
    /// Objects that are never in view.
    #[strum(serialize = "avoided")]
    Avoid,
    /// The quantity of the text that has a role.
    #[strum(transparent)]
    Quantity(QuantityRole),
    /// The quantity of the text that is the length of the film.
    #[strum(serialize = "film length")]
    FilmLength,
}

impl Choice {
    /// Whether the choice belongs to the step that ends at the key, not to the step that begins there.
    pub(crate) fn is_arrival(self) -> bool {
        match self {
            Self::Class(field) => field.is_arrival(),
            Self::EndSubjects => true,
            Self::Quantity(role) => role.is_arrival(),
            _ => false,
        }
    }
}
