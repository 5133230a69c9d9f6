//! What the words of a step say plainly, over what the network read into them.

mod directions;
mod open;
mod places;

pub(crate) use directions::take_said_directions;
pub(crate) use open::{open_unstated_directions, reverse_retraced};
pub(crate) use places::{complete_framings, drop_descriptions};
