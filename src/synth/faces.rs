//! Faces of a block, as bits of a mask.

/// Face toward -x.
pub(super) const LEFT: u8 = 0b00_0001;
/// Face toward +x.
pub(super) const RIGHT: u8 = 0b00_0010;
/// Face toward -y.
pub(super) const BOTTOM: u8 = 0b00_0100;
/// Face toward +y.
pub(super) const TOP: u8 = 0b00_1000;
/// Face toward -z.
pub(super) const BACK: u8 = 0b01_0000;
/// Face toward +z.
pub(super) const FRONT: u8 = 0b10_0000;
/// Faces toward -x, +x, -y and +y.
pub(super) const SIDES: u8 = LEFT | RIGHT | BOTTOM | TOP;
/// All faces.
pub(super) const ALL: u8 = SIDES | BACK | FRONT;
