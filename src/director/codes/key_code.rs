//! A key as class numbers and pointers.

use super::fields::{Field, NUM_FIELDS};

/// Limit on the subjects of one framing, and on the objects that one step passes.
pub const MAX_SUBJECTS: usize = 3;

/// Number of object pointers of a key: subjects on arrival, subjects on departure, objects passed on the way.
pub const OBJECT_POINTERS: usize = 3 * MAX_SUBJECTS;

/// Number of quantity pointers of a key: amount and duration.
pub const QUANTITY_POINTERS: usize = 2;

/// A key in numbers.
///
/// A pointer is an index into a list of the prompt, counted from 1; 0 points at nothing. `None` means that the choice
/// does not apply (a key that stops has no move) or that its value is unknown; training skips it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct KeyCode {
    /// Class of each [`Field`], in their order.
    pub classes: [Option<u8>; NUM_FIELDS],
    /// Pointers at objects: [`MAX_SUBJECTS`] each on arrival, on departure and on the way.
    pub objects: [Option<u8>; OBJECT_POINTERS],
    /// Pointers at quantities: amount, duration.
    pub quantities: [Option<u8>; QUANTITY_POINTERS],
    /// Indices of the first and the last token of the words that the key's segment comes from.
    pub span: Option<[usize; 2]>,
}

impl KeyCode {
    /// Class of a field; 0 where it does not apply.
    pub(crate) fn class(&self, field: Field) -> u8 {
        self.classes[field as usize].unwrap_or(0)
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
