//! The map of a shot: camera path and scene from above and from the side, on one page.
//!
//! Enters: a scene, its objects and a shot. Leaves: a [`Drawing`], as SVG or PNG. Both views are parallel projections at one
//! scale, drawn below each other with a common horizontal axis. The matter in them is rendered from the Gaussians themselves,
//! cut below a ceiling and in front of the path. The one invariant: the same input gives the same bytes.

mod cones;
mod error;
mod keys;
mod labels;
mod legend;
mod matter;
mod page;
mod panel;
mod path_marks;
mod roof;
mod route;
mod space;
mod style;
mod things;
mod walls;

pub use cinesplat_plot::drawing::{self, Drawing};
pub use error::MapError;
pub use page::draw;
