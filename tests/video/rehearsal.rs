use std::path::Path;

use cinesplat::video::{VideoError, VideoSettings, rehearse};

use super::test_frame;

#[test]
fn a_rehearsal_keeps_nothing_and_refuses_what_a_film_refuses() {
    let folder = tempfile::tempdir().unwrap();
    let settings = VideoSettings { width: 64, height: 36, ..VideoSettings::default() };
    let frames: Vec<_> = (0..5).map(|idx| test_frame(64, 36, idx)).collect();
    let frames: Vec<&[u8]> = frames.iter().map(Vec::as_slice).collect();
    for name in ["film.mp4", "film.webm", "%03d.png"] {
        rehearse(&folder.path().join(name), &settings, &frames).unwrap();
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    let refused = |path: &str, frames: &[&[u8]]| rehearse(Path::new(path), &settings, frames).unwrap_err();
    assert!(matches!(refused("film.gif", &frames), VideoError::UnknownFormat { .. }));
    assert!(matches!(refused("film.mp4", &[&[0; 3]]), VideoError::FrameSize { found: 3, expected: 6912 }));
}
