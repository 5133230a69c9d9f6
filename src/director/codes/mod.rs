//! Keys and camera poses as numbers: the format of the network's outputs and of the training targets.

mod decoding;
mod encoding;
mod fields;
mod framing_end;
mod key_code;
mod pose_code;

pub(crate) use decoding::read_motions;
pub use decoding::{decode_key, forbidden_of};
pub use encoding::encode_key;
pub use fields::{Field, NUM_FIELDS};
pub use key_code::{KeyCode, MAX_SUBJECTS, OBJECT_POINTERS, QUANTITY_POINTERS, QuantityRole};
pub use pose_code::{POSE_WIDTH, PoseCode, log_fov, previous_poses};

pub(crate) use fields::{AMOUNT_QUANTITY, LENS_FOCAL, LENS_FOV, LOOK_AT, NEXT_CUT, NEXT_SEGMENT, NEXT_STOP};
pub(crate) use key_code::{AVOID_POINTER, KEEP_POINTER, LOOK_POINTER};
pub(crate) use pose_code::fov_y_rad;
