/// Header flag: trained with antialiasing.
pub(super) const ANTIALIASED: u8 = 0x01;
/// Header flag: the file has extension records.
pub(super) const HAS_EXTENSIONS: u8 = 0x02;
/// Header flag of Spark: a tree of levels of detail, in which opacities have another meaning.
pub(super) const LOD_TREE: u8 = 0x80;
