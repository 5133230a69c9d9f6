//! Objects of a scene: found, read from a file, and made into sparse clouds by multi-view alpha shapes.
//!
//! Enters: a scene, optionally boxes or labels. Leaves: an [`ObjectSet`] whose clouds feed the director.

pub mod alpha_shape;
mod boxes;
mod cloud;
mod color;
pub mod delaunay;
mod drawing;
mod error;
mod file;
mod find;
mod naming;
mod object;
mod planes;
pub mod radius_search;
mod sampling;
mod segments;
mod sheet;
mod viewpoints;
mod views;
mod voxels;

pub use cloud::{CloudSettings, fill_clouds};
pub use error::ObjectsError;
pub use file::{ObjectsFile, labels_path, read, read_labels, to_json, write};
pub use find::{FindSettings, find, from_labels};
pub use naming::nearest_labels;
pub use object::{Object, ObjectSet};
pub use sampling::farthest_points;
pub use sheet::{SheetSettings, sheet};
