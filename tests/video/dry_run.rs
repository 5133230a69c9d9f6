use std::path::Path;

use cinesplat::video::{VideoError, VideoSettings, encode_and_discard};

use super::test_frame;

#[test]
fn encode_and_discard_writes_no_file_and_rejects_what_a_film_rejects() {
    let folder = tempfile::tempdir().unwrap();
    let settings = VideoSettings { width: 64, height: 36, ..VideoSettings::default() };
    let frames: Vec<_> = (0..5).map(|idx| test_frame(64, 36, idx)).collect();
    let frames: Vec<&[u8]> = frames.iter().map(Vec::as_slice).collect();
    for name in ["film.mp4", "film.webm", "%03d.png"] {
        encode_and_discard(&folder.path().join(name), &settings, &frames).unwrap();
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    let rejected = |path: &str, frames: &[&[u8]]| encode_and_discard(Path::new(path), &settings, frames).unwrap_err();
    assert!(matches!(rejected("film.gif", &frames), VideoError::UnknownFormat { .. }));
    assert!(matches!(rejected("film.mp4", &[&[0; 3]]), VideoError::FrameSize { found: 3, expected: 6912 }));
}
