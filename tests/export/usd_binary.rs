//! The binary form of USD, as usd-core 26.11 writes it (`tests/exchange/other_files.py`).

use cinesplat::export::{Format, PoseTrack, read};
use cinesplat::geometry::rotation;

use super::sample_shot::file;

const TEXT: &[u8] = include_bytes!("usd_files/camera0.usda");
const BINARY: &[u8] = include_bytes!("usd_files/camera0.usdc");
const PACKAGE: &[u8] = include_bytes!("usd_files/camera0.usdz");
const OPERATIONS_TEXT: &[u8] = include_bytes!("usd_files/camera2.usda");
const OPERATIONS: &[u8] = include_bytes!("usd_files/camera2.usdc");

fn track(name: &str, bytes: &[u8]) -> PoseTrack {
    let (path, _folder) = file(name, bytes);
    let imported = read(&path, None).unwrap();
    assert_eq!(imported.format, Format::Usd);
    imported.track
}

/// Numbers of the text form are shortened to those of an `f32` where the attribute is one.
fn assert_same(a: &PoseTrack, b: &PoseTrack) {
    assert_eq!((a.frames.len(), a.size_px, a.fps, a.up), (b.frames.len(), b.size_px, b.fps, b.up));
    for (a, b) in a.frames.iter().zip(&b.frames) {
        assert_eq!((a.time_secs, a.focus_distance), (b.time_secs, b.focus_distance));
        assert!(a.pose.position.distance(b.pose.position) < 1e-6);
        assert!(rotation::angle_between(a.pose.rotation, b.pose.rotation) < 1e-7);
        assert!((a.fov_y_rad.unwrap() - b.fov_y_rad.unwrap()).abs() < 1e-7);
    }
}

#[test]
fn the_same_camera_in_the_three_forms_of_usd_is_the_same_path() {
    let text = track("a.usda", TEXT);
    assert_eq!((text.frames.len(), text.size_px, text.fps), (12, Some((1920, 800)), Some(25.0)));
    assert_same(&text, &track("a.usdc", BINARY));
    assert_same(&text, &track("a.usdz", PACKAGE));
    assert_same(&track("b.usda", OPERATIONS_TEXT), &track("b.usdc", OPERATIONS));
}

#[test]
fn a_binary_layer_that_is_cut_or_changed_is_an_error_or_another_path() {
    for bytes in [BINARY, OPERATIONS] {
        let (path, _folder) = file("a.usdc", bytes);
        let read_changed = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            read(&path, Some(Format::Usd))
        };
        // The list of sections is at the end.
        for end in 0..bytes.len() {
            assert!(read_changed(&bytes[..end]).is_err(), "{end} bytes");
        }
        for at in 8..bytes.len() {
            let mut changed = bytes.to_vec();
            changed[at] ^= [0xff, 0x80, 0x01][at % 3];
            drop(read_changed(&changed));
        }
    }
}

#[test]
fn false_counts_in_a_binary_layer_are_refused_before_they_take_memory() {
    let sections = u64::from_le_bytes(BINARY[16..24].try_into().unwrap()) as usize + 8;
    for section in 0..6 {
        let at = sections + 32 * section;
        let start = u64::from_le_bytes(BINARY[at + 16..at + 24].try_into().unwrap()) as usize;
        let mut changed = BINARY.to_vec();
        changed[start..start + 8].copy_from_slice(&(1_u64 << 40).to_le_bytes());
        let (path, _folder) = file("a.usdc", &changed);
        let error = read(&path, None).unwrap_err().to_string();
        assert!(error.contains("found 1099511627776 entries, expected at most"), "{error}");
    }
}

#[test]
fn an_old_version_of_the_binary_form_names_the_command_that_converts_it() {
    let mut old = BINARY.to_vec();
    old[9] = 3;
    let (path, _folder) = file("a.usdc", &old);
    let error = read(&path, None).unwrap_err().to_string();
    assert!(error.contains("version 0.3") && error.contains("usdcat in.usdc -o out.usda"), "{error}");
}
