//! Shots for the tests of this folder.

use cinesplat::files::Existing;
use std::path::{Path, PathBuf};

use cinesplat::export::{Content, ExportSettings, Format, Imported, Layout, read, write};
use cinesplat::geometry::{Pose, rotation};
use cinesplat::trajectory::{Easing, Keyframe, SceneRef, Shot};
use glam::{DQuat, DVec3};

use crate::support::shot_over;

pub(super) fn key(time_secs: f64, position: DVec3, rotation: DQuat, fov_y_deg: f64) -> Keyframe {
    Keyframe {
        time_secs,
        pose: Pose::new(position, rotation),
        fov_y_rad: fov_y_deg.to_radians(),
        focus_distance: None,
        optics: cinesplat::trajectory::KeyOptics::default(),
        easing: Easing::Linear,
        cut: false,
        intent: None,
    }
}

pub(super) fn shot(keyframes: Vec<Keyframe>, up: DVec3) -> Shot {
    let scene = SceneRef { up: Some(up), ..SceneRef::default() };
    Shot { scene, width: 1280, height: 720, fps: 24.0, ..shot_over(keyframes) }
}

/// Keys with a zoom, focus distances and a cut at 2 s, in a world with y down.
pub(super) fn with_cut() -> Shot {
    let turn = |x: f64, y: f64, z: f64| rotation::exp(DVec3::new(x, y, z));
    let mut keys = vec![
        key(0.0, DVec3::new(1.0, -2.0, 0.5), turn(0.1, 0.2, 0.0), 50.0),
        key(1.0, DVec3::new(1.5, -2.0, 1.5), turn(0.1, 0.9, 0.1), 40.0),
        key(2.0, DVec3::new(-3.0, -1.0, 0.0), turn(0.0, -2.5, 0.0), 35.0),
        key(3.0, DVec3::new(-3.0, -1.2, 1.0), turn(0.0, -3.0, 0.0), 35.0),
    ];
    keys[2].cut = true;
    for key in &mut keys {
        key.focus_distance = Some(2.0 + key.time_secs);
    }
    shot(keys, DVec3::NEG_Y)
}

/// Writes a shot, reads it back without naming the format, and returns the result, the warnings and the file's folder.
pub(super) fn there_and_back(
    shot: &Shot,
    format: Format,
    name: &str,
    content: Content,
) -> (Imported, Vec<String>, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let warnings = write(
        &path,
        format,
        shot,
        &ExportSettings { content, layout: Layout::of_path(&path), fps: None },
        Existing::Replace,
    )
    .unwrap();
    let imported = read(&path, None).unwrap_or_else(|error| panic!("{}: {error}", format.as_ref()));
    (imported, warnings, folder)
}

/// A file with the given bytes, and its folder.
pub(super) fn file(name: &str, text: &[u8]) -> (PathBuf, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = Path::new(folder.path()).join(name);
    std::fs::write(&path, text).unwrap();
    (path, folder)
}
