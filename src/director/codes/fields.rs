//! The choices among classes that a key makes, and how many classes each has.

use cinesplat_operator::{FramePlace, Motion, Pass, Speed, SubjectPart, SubjectSide};
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

/// Class of [`Field::Look`]: objects.
pub(crate) const LOOK_AT: u8 = 1;
/// Class of [`Field::Look`]: the direction of travel.
pub(super) const LOOK_AHEAD: u8 = 2;
/// Class of [`Field::Look`]: against the direction of travel.
pub(super) const LOOK_BACK: u8 = 3;
/// Class of [`Field::Look`]: the middle of the scene.
pub(super) const LOOK_ROOM: u8 = 4;

/// Class of a lens field: a focal length of the text.
pub(crate) const LENS_FOCAL: u8 = 1;
/// Class of a lens field: a field of view of the text.
pub(crate) const LENS_FOV: u8 = 2;
/// Class of a lens field: wide.
pub(super) const LENS_WIDE: u8 = 3;
/// Class of a lens field: long.
pub(super) const LENS_LONG: u8 = 4;

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
    /// A third move at the same time.
    #[strum(serialize = "third move")]
    SecondWith,
    /// What the camera looks at while it travels elsewhere.
    Look,
    /// Lens on arrival: unspecified, a focal length, a field of view, wide, long.
    #[strum(serialize = "end lens")]
    ArriveLens,
    /// Side from which the camera sees the subject on arrival.
    #[strum(serialize = "end side")]
    ArriveSide,
    /// Place of the subject in the frame on arrival.
    #[strum(serialize = "end place")]
    ArrivePlace,
    /// Whether the subjects are hidden on arrival.
    #[strum(serialize = "end hidden")]
    ArriveHidden,
    /// Lens on departure.
    #[strum(serialize = "start lens")]
    DepartLens,
    /// Side on departure.
    #[strum(serialize = "start side")]
    DepartSide,
    /// Place on departure.
    #[strum(serialize = "start place")]
    DepartPlace,
    /// Whether the subjects are hidden on departure.
    #[strum(serialize = "start hidden")]
    DepartHidden,
    /// Whether the film must not zoom.
    NoZoom,
    /// Whether the film must not pan.
    NoPan,
    /// Whether the film must not tilt.
    NoTilt,
    /// Whether the film must not roll.
    NoRoll,
    /// Whether the film must not turn.
    NoTurn,
    /// Whether the camera must not travel.
    NoTravel,
    /// Whether the camera must not shake.
    NoShake,
    /// Whether the film must not cut.
    NoCut,
}

/// Fields of the motions that the network reads as forbidden. Their order is that of its classes.
pub(super) const FORBIDDEN: [(Field, Motion); 8] = [
    (Field::NoZoom, Motion::Zoom),
    (Field::NoPan, Motion::Pan),
    (Field::NoTilt, Motion::Tilt),
    (Field::NoRoll, Motion::Roll),
    (Field::NoTurn, Motion::Turn),
    (Field::NoTravel, Motion::Travel),
    (Field::NoShake, Motion::Shake),
    (Field::NoCut, Motion::Cut),
];

impl Field {
    /// Number of classes.
    pub fn num_classes(self) -> usize {
        match self {
            Self::Next => 3,
            Self::Movement => Move::VARIANTS.len(),
            Self::With | Self::SecondWith => 1 + Move::VARIANTS.len(),
            Self::EitherWay
            | Self::Returns
            | Self::ArriveWhole
            | Self::DepartWhole
            | Self::ArriveHidden
            | Self::DepartHidden
            | Self::NoZoom
            | Self::NoPan
            | Self::NoTilt
            | Self::NoRoll
            | Self::NoTurn
            | Self::NoTravel
            | Self::NoShake
            | Self::NoCut => 2,
            Self::Look | Self::ArriveLens | Self::DepartLens => 5,
            Self::ArriveSide | Self::DepartSide => 1 + SubjectSide::READ.len(),
            Self::ArrivePlace | Self::DepartPlace => 1 + FramePlace::VARIANTS.len(),
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
            _ if self.is_of_film() => is_first,
            _ if self.is_arrival() => !is_first,
            _ => next == NEXT_SEGMENT,
        }
    }

    /// Whether the field describes the frame when the camera arrives at the key.
    pub(crate) fn is_arrival(self) -> bool {
        matches!(
            self,
            Self::ArriveSize
                | Self::ArriveAngle
                | Self::ArrivePart
                | Self::ArriveWhole
                | Self::ArriveLens
                | Self::ArriveSide
                | Self::ArrivePlace
                | Self::ArriveHidden
        )
    }

    /// Whether the field describes the whole film; the first key has it.
    pub(crate) fn is_of_film(self) -> bool {
        FORBIDDEN.iter().any(|(field, _)| *field == self)
    }
}
