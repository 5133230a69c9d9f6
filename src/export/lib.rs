//! Camera paths as files: the project's own, and one file a format of other programs.
//!
//! Enters: a [`Shot`](cinesplat_trajectory::Shot) or timed poses; files of other programs. Leaves: files; shots and
//! [`PoseTrack`]s. Poses inside are `world_from_camera` with OpenCV camera axes in the scene's own world; each format's
//! file says what it makes of them, and with `geometry` this folder is the only place where signs are flipped.
//! The one invariant: what a format cannot hold is named in a warning, never dropped in silence.

mod blender;
pub mod cameras_json;
mod clearance_json;
mod colmap;
mod columns;
mod csv;
mod encode;
mod error;
mod euroc;
mod format;
mod gltf;
mod import;
mod json_read;
pub mod json_write;
mod kitti;
mod lichtfeld;
mod losses;
mod nerfstudio;
mod opengl;
mod redwood_log;
pub mod shot_json;
mod supersplat;
mod track;
mod transforms;
mod tum;
mod usd;

pub use encode::{Content, Encoded, ExportSettings, Layout, encode, encode_poses, output_files, write};
pub use error::ExportError;
pub use format::Format;
pub use import::{Imported, read};
pub use track::{DEFAULT_FOV_Y_DEG, DEFAULT_FPS, DEFAULT_SIZE_PX, PoseFrame, PoseTrack};
