//! A key as class numbers and pointers.

use strum::VariantArray;

use super::fields::{Field, NUM_FIELDS};

/// Limit on the subjects of one framing, and on the objects that one step passes.
pub const MAX_SUBJECTS: usize = 3;

/// Number of object pointers of a key: subjects on arrival, subjects on departure, objects passed on the way, then one
/// each to look at, to keep in view, to avoid.
pub const OBJECT_POINTERS: usize = 3 * MAX_SUBJECTS + 3;
/// Object pointer: what the camera looks at.
pub(crate) const LOOK_POINTER: usize = 3 * MAX_SUBJECTS;
/// Object pointer: what stays in view.
pub(crate) const KEEP_POINTER: usize = LOOK_POINTER + 1;
/// Object pointer: what is never in view.
pub(crate) const AVOID_POINTER: usize = LOOK_POINTER + 2;

/// Number of quantity pointers of a key.
pub const QUANTITY_POINTERS: usize = QuantityRole::VARIANTS.len();

/// What a key uses a quantity of the text for.
///
/// The network outputs the pointers in the order of the variants. The text of a variant is its name in reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::Display, strum::IntoStaticStr, strum::VariantArray)]
#[strum(serialize_all = "kebab-case")]
pub enum QuantityRole {
    /// Extent of the move.
    Amount,
    /// Duration of the segment.
    Duration,
    /// Height of the subject over the frame's on arrival.
    #[strum(serialize = "end height in the frame")]
    ArriveHeightFrac,
    /// Angle above the horizontal on arrival.
    #[strum(serialize = "end elevation")]
    ArriveElevation,
    /// Height of the camera on arrival.
    #[strum(serialize = "end height")]
    ArriveHeight,
    /// Distance to the subject on arrival.
    #[strum(serialize = "end distance")]
    ArriveDistance,
    /// Focal length or field of view on arrival.
    #[strum(serialize = "end lens")]
    ArriveLens,
    /// Height of the subject over the frame's on departure.
    #[strum(serialize = "start height in the frame")]
    DepartHeightFrac,
    /// Angle above the horizontal on departure.
    #[strum(serialize = "start elevation")]
    DepartElevation,
    /// Height of the camera on departure.
    #[strum(serialize = "start height")]
    DepartHeight,
    /// Distance to the subject on departure.
    #[strum(serialize = "start distance")]
    DepartDistance,
    /// Focal length or field of view on departure.
    #[strum(serialize = "start lens")]
    DepartLens,
}

impl QuantityRole {
    /// Whether the role belongs to the frame when the camera arrives.
    pub(crate) fn is_arrival(self) -> bool {
        matches!(
            self,
            Self::ArriveHeightFrac
                | Self::ArriveElevation
                | Self::ArriveHeight
                | Self::ArriveDistance
                | Self::ArriveLens
        )
    }
}

/// A key in numbers.
///
/// A pointer is an index into a list of the prompt, counted from 1; 0 points at nothing. `None` means that the choice
/// does not apply (a key that stops has no move) or that its value is unknown; training skips it.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyCode {
    /// Class of each [`Field`], in their order.
    pub classes: [Option<u8>; NUM_FIELDS],
    /// Pointers at objects: [`MAX_SUBJECTS`] each on arrival, on departure and on the way, then one each to look at, to
    /// keep and to avoid.
    pub objects: [Option<u8>; OBJECT_POINTERS],
    /// Pointers at quantities, one per [`QuantityRole`].
    pub quantities: [Option<u8>; QUANTITY_POINTERS],
    /// Indices of the first and the last token of the words that the key's segment comes from.
    pub span: Option<[usize; 2]>,
}

impl Default for KeyCode {
    fn default() -> Self {
        Self {
            classes: [None; NUM_FIELDS],
            objects: [None; OBJECT_POINTERS],
            quantities: [None; QUANTITY_POINTERS],
            span: None,
        }
    }
}

impl KeyCode {
    /// Class of a field; 0 where it does not apply.
    pub(crate) fn class(&self, field: Field) -> u8 {
        self.classes[field as usize].unwrap_or(0)
    }

    /// Index (from 0) of the quantity that has a role.
    pub(crate) fn quantity(&self, role: QuantityRole) -> Option<usize> {
        self.quantities[role as usize].and_then(|pointer| usize::from(pointer).checked_sub(1))
    }

    /// Sets the class of a field.
    pub(super) fn set_class(&mut self, field: Field, class: u8) {
        self.classes[field as usize] = Some(class);
    }

    /// Index (from 0) of the key's main object: the first subject on departure, else the first on arrival.
    pub(crate) fn main_object(&self) -> Option<usize> {
        let place =
            |pointer: usize| self.objects[pointer].filter(|place| *place > 0).map(|place| usize::from(place) - 1);
        place(MAX_SUBJECTS).or_else(|| place(0))
    }
}
