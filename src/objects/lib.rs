//! The objects of a scene, and their sparse clouds by multi-view alpha shapes.
//!
//! Enters: a scene, and optionally boxes or labels. Leaves: an [`ObjectSet`]. Objects are found ([`find()`]), read from
//! a file ([`read()`]) or assembled from labels ([`from_labels`]). [`fill_clouds`] computes the clouds that the
//! director takes as input, and [`sheet()`] draws a contact sheet of all objects.

pub mod alpha_shape;
mod background;
mod boxes;
mod cloud;
mod color;
pub mod delaunay;
mod drawing;
mod error;
mod file;
mod find;
mod grouping;
mod naming;
mod object;
mod planes;
pub mod radius_search;
mod sampling;
mod segmentation;
mod settings;
mod sheet;
mod viewpoints;
mod views;
mod voxels;

pub use cloud::{CloudSettings, fill_clouds};
pub use error::ObjectsError;
pub use file::{ObjectsFile, labels_path, read, read_boxes, read_labels, to_json, write};
pub use find::{find, from_labels};
pub use object::{Object, ObjectSet};
pub use settings::FindSettings;
pub use sheet::{SheetSettings, sheet};
