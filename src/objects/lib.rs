//! The objects of a scene, and their sparse clouds by multi-view alpha shapes.
//!
//! Enters: a scene, and optionally boxes or labels. Leaves: an [`ObjectSet`]. Objects are found ([`find()`]), read from
//! a file ([`read()`]) or assembled from labels ([`from_labels`]), which masks of posed images give ([`lift_masks`]).
//! [`fill_clouds`] computes the clouds that the director takes as input, and [`sheet()`] draws a contact sheet of all
//! objects.

mod absorbing;
mod agreement;
pub mod alpha_shape;
mod background;
mod bearing;
mod borders;
mod boxes;
mod by_name;
mod candidates;
mod closed_room;
mod cloud;
mod clouds_file;
mod color;
pub mod delaunay;
mod drawing;
mod error;
mod file;
mod file_write;
mod find;
mod flats;
mod floating;
mod grouping;
mod groups;
mod kept_points;
mod lifting;
mod lone;
mod loose;
mod mask;
mod median;
mod naming;
mod neighbors;
mod object;
mod open_background;
mod open_room;
mod outlines;
mod parts;
mod patches;
mod person;
mod photo;
mod pieces;
mod planes;
pub mod radius_search;
mod relief;
mod renaming;
mod sampling;
mod seen_colors;
mod segmentation;
mod settings;
mod sheet;
mod sheet_html;
mod shelves;
mod silhouettes;
mod slices;
mod standing;
mod structure;
mod surroundings;
mod tidying;
mod tops;
mod up_views;
mod valleys;
mod viewpoints;
mod views;
mod voxels;
mod windows;

pub use agreement::{Agreement, agreements};
pub use by_name::named;
pub use cloud::{CloudSettings, fill_clouds, fill_clouds_of};
pub use error::ObjectsError;
pub use file::{ObjectsFile, read, read_boxes, read_labels};
pub use file_write::{Sidecars, clouds_path, labels_path, to_json, write};
pub use find::{find, from_labels};
pub use lifting::{LiftedLabels, PosedMask, lift_masks, read_mask};
pub use lone::only_whole;
pub use naming::is_description;
pub use object::{Object, ObjectSet};
pub use renaming::{Renaming, rename};
pub use sampling::PointSampler;
pub use settings::FindSettings;
pub use sheet::{Sheet, SheetSettings, Tile, sheet};
pub use up_views::UpView;
