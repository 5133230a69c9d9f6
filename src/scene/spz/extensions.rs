//! Extension records: type u32, length u32, payload. Enters: their bytes. Leaves: the up axis, and notes. Reference: nianticlabs/spz `extensions/README.md`.

use glam::DVec3;

/// Type of Adobe's record of the coordinate system.
const COORDINATE_SYSTEM: u32 = 0xADBE_0003;
/// Type of Adobe's record that limits an orbiting camera. It has no information about the scene.
const SAFE_ORBIT: u32 = 0xADBE_0002;

/// Names of the coordinate systems by number: the directions of x, y and z as initials (left, right, up, down, forward,
/// back).
const SYSTEMS: [&str; 17] = [
    "", "LDB", "RDB", "LUB", "RUB", "LDF", "RDF", "LUF", "RUF", "LBD", "RBD", "LBU", "RBU", "LFD", "RFD", "LFU", "RFU",
];

/// Content of the records.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Extensions {
    /// World up and the name of the coordinate system.
    pub(super) up: Option<(DVec3, String)>,
    /// Notes for [`Scene::notes`](crate::Scene::notes).
    pub(super) notes: Vec<String>,
}

/// Reads the records. Unknown types are skipped with a note.
pub(super) fn read(mut bytes: &[u8]) -> Extensions {
    let mut found = Extensions::default();
    // Every iteration consumes the 8 bytes of a record's head, or ends the loop.
    while let Some((head, rest)) = bytes.split_at_checked(8) {
        let word = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
        let Some((payload, rest)) = rest.split_at_checked(word(4) as usize) else { break };
        match (word(0), payload.first_chunk()) {
            (COORDINATE_SYSTEM, Some(chunk)) => take_system(&mut found, u32::from_le_bytes(*chunk)),
            (SAFE_ORBIT, _) => (),
            (kind, _) => found.notes.push(format!("extension {kind:#010x} is unknown and ignored")),
        }
        bytes = rest;
    }
    if !bytes.is_empty() {
        found.notes.push(format!("{} bytes of extension records are cut or damaged", bytes.len()));
    }
    found
}

/// Takes the up axis of a coordinate system.
fn take_system(found: &mut Extensions, number: u32) {
    let Some(name) = SYSTEMS.get(number as usize).filter(|name| !name.is_empty()) else {
        found.notes.push(format!("coordinate system {number} is unknown and ignored"));
        return;
    };
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let pointing = |letter: char| name.chars().position(|c| c == letter).map(|axis| axes[axis]);
    found.up = pointing('U').or(pointing('D').map(|down| -down)).map(|up| (up, format!("coordinate system {name}")));
    let [x, y, z] = [0, 1, 2].map(|axis| name.chars().nth(axis).map_or(DVec3::ZERO, direction));
    if x.cross(y).dot(z) < 0.0 {
        found.notes.push(format!("coordinate system {name} is left-handed: the picture may be mirrored"));
    }
}

/// The direction of a letter in the frame of a viewer: x right, y up, z back.
fn direction(letter: char) -> DVec3 {
    match letter {
        'R' => DVec3::X,
        'L' => DVec3::NEG_X,
        'U' => DVec3::Y,
        'D' => DVec3::NEG_Y,
        'B' => DVec3::Z,
        _ => DVec3::NEG_Z,
    }
}
