//! Tests of `src/export`, one file per format or concept.
#![allow(clippy::float_cmp, reason = "numbers written and read back keep their bits")]

mod cameras_json;
mod captures;
mod csv_euroc;
mod detection;
mod gltf_usd;
mod hostile;
mod imported_shots;
mod lichtfeld;
mod nerfstudio;
mod other_readers;
mod parents;
mod read_only_formats;
mod ros;
mod round_trips;
mod sample_shot;
mod several_cameras;
mod shot_json;
mod supersplat;
mod tum_kitti;
mod usd_binary;
mod warnings;
