//! The choices among classes that a key makes, and how many classes each has.

use cinesplat_operator::{Pass, Speed, SubjectPart};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};
use strum::VariantArray;

/// Number of fields.
pub const NUM_FIELDS: usize = Field::VARIANTS.len();

/// Class of [`Field::Next`]: a segment follows.
pub(crate) const NEXT_SEGMENT: u8 = 0;
/// Class of [`Field::Next`]: a cut follows.
pub(crate) const NEXT_CUT: u8 = 1;
/// Class of [`Field::Next`]: the film ends.
pub(crate) const NEXT_STOP: u8 = 2;

/// Class of [`Field::Amount`]: a quantity of the text.
pub(crate) const AMOUNT_QUANTITY: u8 = 1;
/// Class of [`Field::Amount`]: a little.
pub(super) const AMOUNT_SLIGHT: u8 = 2;
/// Class of [`Field::Amount`]: a lot.
pub(super) const AMOUNT_LARGE: u8 = 3;

/// A choice among classes that a key makes.
///
/// The network outputs the scores in the order of the variants; the shipped weights depend on it. Class 0 of an optional
/// field means "unspecified". The text of a variant is its name in reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::Display, strum::IntoStaticStr)]
#[derive(strum::VariantArray)]
#[strum(serialize_all = "kebab-case")]
pub enum Field {
    /// What follows the key: a segment, a cut, the end of the film.
    Next,
    /// The move of the segment.
    #[strum(serialize = "move")]
    Movement,
    /// A second move at the same time.
    #[strum(serialize = "second move")]
    With,
    /// Whether the direction of the move is open.
    EitherWay,
    /// How the segment passes objects.
    Via,
    /// Extent of the move: unspecified, a quantity of the text, a little, a lot.
    Amount,
    /// Speed of the move.
    Speed,
    /// Easing of the move.
    Easing,
    /// Whether the segment ends where the film began.
    Returns,
    /// Shot size when the camera arrives at the key.
    #[strum(serialize = "end size")]
    ArriveSize,
    /// Shot angle on arrival.
    #[strum(serialize = "end angle")]
    ArriveAngle,
    /// Part of the subject on arrival.
    #[strum(serialize = "end part")]
    ArrivePart,
    /// Whether all subjects are wholly in the frame on arrival.
    #[strum(serialize = "end whole")]
    ArriveWhole,
    /// Shot size when the camera departs from the key.
    #[strum(serialize = "start size")]
    DepartSize,
    /// Shot angle on departure.
    #[strum(serialize = "start angle")]
    DepartAngle,
    /// Part of the subject on departure.
    #[strum(serialize = "start part")]
    DepartPart,
    /// Whether all subjects are wholly in the frame on departure.
    #[strum(serialize = "start whole")]
    DepartWhole,
}

impl Field {
    /// Number of classes.
    pub fn num_classes(self) -> usize {
        match self {
            Self::Next => 3,
            Self::Movement => Move::VARIANTS.len(),
            Self::With => 1 + Move::VARIANTS.len(),
            Self::EitherWay | Self::Returns | Self::ArriveWhole | Self::DepartWhole => 2,
            Self::Via => 1 + Pass::VARIANTS.len(),
            Self::Amount => 4,
            Self::Speed => Speed::VARIANTS.len(),
            Self::Easing => 1 + Easing::VOCABULARY.len(),
            Self::ArriveSize | Self::DepartSize => 1 + ShotSize::VARIANTS.len(),
            Self::ArriveAngle | Self::DepartAngle => 1 + ShotAngle::VARIANTS.len(),
            Self::ArrivePart | Self::DepartPart => SubjectPart::VARIANTS.len(),
        }
    }

    /// Index of the field's first class in the concatenated classes of all fields.
    pub fn offset(self) -> usize {
        Self::VARIANTS[..self as usize].iter().map(|field| field.num_classes()).sum()
    }

    /// Number of classes of all fields together.
    pub fn total_classes() -> usize {
        Self::VARIANTS.iter().map(|field| field.num_classes()).sum()
    }

    /// Whether a key with class `next` of [`Field::Next`] makes this choice; `is_first` marks the film's first key, at
    /// which no camera arrives.
    pub(crate) fn applies(self, next: u8, is_first: bool) -> bool {
        match self {
            Self::Next => true,
            _ if self.is_arrival() => !is_first,
            _ => next == NEXT_SEGMENT,
        }
    }

    /// Whether the field describes the frame when the camera arrives at the key.
    pub(crate) fn is_arrival(self) -> bool {
        matches!(self, Self::ArriveSize | Self::ArriveAngle | Self::ArrivePart | Self::ArriveWhole)
    }
}
