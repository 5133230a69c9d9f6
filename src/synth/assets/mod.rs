//! The catalog of assets: one function per object, which draws its own proportions. Lengths in m.

pub(super) mod beds;
pub(super) mod decor;
pub(super) mod devices;
pub(super) mod hearth;
pub(super) mod instruments;
pub(super) mod kitchen;
pub(super) mod lamps;
pub(super) mod openings;
pub(super) mod plants;
pub(super) mod seats;
pub(super) mod storage;
pub(super) mod tables;
pub(super) mod tableware;
pub(super) mod textiles;
pub(super) mod walls;
