//! The clearance proof of a shot: the key `clearance` of `shot.json`, an addition to version 1.
//!
//! The proof carries a digest of the keys that it was computed for. A proof whose digest differs from that of the keys
//! in the file is stale, because the keys were edited: it is not read.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};

use super::ExportError;
use super::json_read::Node;
use super::json_write::{Json, object};
use cinesplat_trajectory::{ClearanceFailure, ClearanceProof, Shot};

/// The JSON value of a proof.
pub(super) fn write(proof: &ClearanceProof, shot: &Shot) -> Json {
    let failure = proof.failure.map(|failure| {
        object([
            ("from_secs", failure.from_secs.into()),
            ("to_secs", failure.to_secs.into()),
            ("distance", failure.distance.into()),
            ("gaussian", (failure.gaussian_idx as u64).into()),
        ])
    });
    object([
        ("proved", proof.is_clear().into()),
        ("camera_radius", proof.camera_radius.into()),
        ("least", proof.min_distance.into()),
        ("at_secs", proof.at_secs.into()),
        ("gaussian", proof.gaussian_idx.map_or_else(Json::NULL, |idx| (idx as u64).into())),
        ("opacity_floor", proof.opacity_floor.into()),
        ("sigma_level", proof.sigma_level.into()),
        ("num_parts", (proof.num_intervals as u64).into()),
        ("fails", failure.unwrap_or_else(Json::NULL)),
        ("keys_sha256", keys_sha256(shot).as_str().into()),
    ])
}

/// Keys of `clearance`.
pub(super) const KEYS: [&str; 10] = [
    "proved",
    "camera_radius",
    "least",
    "at_secs",
    "gaussian",
    "opacity_floor",
    "sigma_level",
    "num_parts",
    "fails",
    "keys_sha256",
];
/// Keys of `clearance.fails`.
pub(super) const FAILURE_KEYS: [&str; 4] = ["from_secs", "to_secs", "distance", "gaussian"];

/// The proof of a shot; `None` if it is stale.
pub(super) fn read(node: &Node, shot: &Shot) -> Result<Option<ClearanceProof>, ExportError> {
    if node.optional("keys_sha256").map(|digest| digest.text()).transpose()? != Some(keys_sha256(shot).as_str()) {
        return Ok(None);
    }
    let number = |name: &str| node.field(name, "a number")?.number();
    let index = |node: Node| node.whole(u64::from(u32::MAX)).map(|idx| idx as usize);
    Ok(Some(ClearanceProof {
        camera_radius: number("camera_radius")?,
        opacity_floor: number("opacity_floor")?,
        sigma_level: number("sigma_level")?,
        // Written as null where there is no matter.
        min_distance: node.optional("least").map_or(Ok(f64::INFINITY), |least| least.number())?,
        at_secs: number("at_secs")?,
        gaussian_idx: node.optional("gaussian").map(index).transpose()?,
        num_intervals: index(node.field("num_parts", "a number of parts")?)?,
        failure: node.optional("fails").map(|failure| read_failure(&failure)).transpose()?,
    }))
}

fn read_failure(node: &Node) -> Result<ClearanceFailure, ExportError> {
    let number = |name: &str| node.field(name, "a number")?.number();
    Ok(ClearanceFailure {
        from_secs: number("from_secs")?,
        to_secs: number("to_secs")?,
        distance: number("distance")?,
        gaussian_idx: node.field("gaussian", "an index")?.whole(u64::from(u32::MAX))? as usize,
    })
}

/// SHA-256 in hex of everything that determines the camera's position over time: up, and the time, position, easing,
/// cut, move and pivot of every key. Rotations are left out: the camera is a ball.
fn keys_sha256(shot: &Shot) -> String {
    let mut digest = Sha256::new();
    let mut numbers = |values: &[f64]| values.iter().for_each(|value| digest.update(value.to_bits().to_le_bytes()));
    numbers(&shot.scene.up.map_or([f64::NAN; 3], |up| up.to_array()));
    for key in &shot.keyframes {
        numbers(&[key.time_secs, f64::from(u8::from(key.cut))]);
        numbers(&key.pose.position.to_array());
    }
    for key in &shot.keyframes {
        digest.update(key.easing.as_ref());
        let intent = key.intent.as_ref();
        digest.update(intent.and_then(|intent| intent.movement).map_or("", <&str>::from));
        for value in intent.and_then(|intent| intent.pivot).map_or([f64::NAN; 3], |pivot| pivot.to_array()) {
            digest.update(value.to_bits().to_le_bytes());
        }
    }
    digest.finalize().iter().fold(String::new(), |mut hex, byte| {
        let _ = write!(hex, "{byte:02x}");
        hex
    })
}
