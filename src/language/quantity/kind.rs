//! What a quantity is.

/// Dimension of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum QuantityKind {
    /// A time, in seconds.
    Seconds,
    /// An angle, in degrees.
    Degrees,
    /// A length in scene units.
    Units,
    /// A factor on the distance to the subject, or on the focal length for zooms.
    Factor,
    /// A share of the frame, in percent.
    Percent,
    /// A focal length on full frame, in millimeters.
    Millimeters,
}

/// A quantity that a prompt states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// Its dimension.
    pub kind: QuantityKind,
    /// Its value in the unit of `kind`, above 0 and finite.
    pub value: f64,
}

/// A quantity that begins at a word: the number of its words, and the quantity.
pub(super) type Found = (usize, Quantity);

/// `len` words that state `value`.
pub(super) fn found(len: usize, kind: QuantityKind, value: f64) -> Found {
    (len, Quantity { kind, value })
}
