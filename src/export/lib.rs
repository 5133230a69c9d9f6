//! Files of camera paths: the project's own `shot.json` and the formats of other programs, one module per format.
//!
//! Enters: a [`Shot`](cinesplat_trajectory::Shot), or a file. Leaves: files, or shots and [`PoseTrack`]s. In memory a
//! pose is `world_from_camera` with OpenCV camera axes in the scene's world; each module documents the convention of
//! its format. Only this crate and `geometry::frames` flip the signs of axes. The one invariant: warnings name
//! every property that a format cannot hold.

mod aria;
mod blender;
mod bytes;
pub mod cameras_json;
mod clearance_json;
mod colmap;
mod columns;
mod csv;
mod effects_json;
mod encode;
mod error;
mod euler_edits;
mod euroc;
mod format;
mod gltf;
mod hermite;
mod import;
mod imported_shot;
mod inria;
mod json_read;
pub mod json_write;
mod key_slopes;
mod kitti;
mod lens_json;
mod lens_losses;
mod lichtfeld;
mod line_layout;
mod look_at;
mod losses;
mod motionctrl;
mod name_order;
mod named_camera;
mod nerfstudio;
mod nerfstudio_spline;
mod opengl;
mod pose_lines;
mod re10k;
mod recammaster;
mod redwood_log;
mod ros;
mod seven_scenes;
pub mod shot_json;
mod stamp_unit;
mod stray;
mod supersplat;
mod track;
mod transforms;
mod tum;
mod usd;
mod which_camera;

pub use encode::{Content, Encoded, EncodedFiles, ExportSettings, Layout, check_output, encode, output_files, write};
pub use error::ExportError;
pub use format::{Doubt, Format};
pub use import::{Imported, ReadSettings, read, read_with};
pub use imported_shot::ImportSettings;
pub use track::{ImageLens, LensSide, PoseFrame, PoseTrack};
