//! What the words of a step say plainly, over what the network read into them.

mod directions;
mod dolly_zoom;
mod open;
mod places;
mod repeats;

pub(crate) use directions::take_said_directions;
pub(crate) use dolly_zoom::take_said_dolly_zooms;
pub(crate) use open::{open_unstated_directions, reverse_retraced};
pub(crate) use places::{complete_framings, drop_descriptions};
pub(crate) use repeats::merge_repeated;
