/// Header flag: trained with antialiasing.
pub(super) const ANTIALIASED: u8 = 0x01;
/// Header flag: extension records are there.
pub(super) const HAS_EXTENSIONS: u8 = 0x02;
/// Header flag of another program: a tree of levels of detail, with opacities that mean something else.
pub(super) const LOD_TREE: u8 = 0x80;
