use cinesplat::video::{VideoSettings, VideoWriter};

use super::test_frame;

#[test]
fn a_sequence_holds_every_pixel_and_starts_at_its_first_frame() {
    let folder = tempfile::tempdir().unwrap();
    let pattern = folder.path().join("new/deep/%04d.png");
    let settings = VideoSettings { width: 33, height: 21, first_frame: 8, num_frames: 3, ..Default::default() };
    let mut writer = VideoWriter::create(&pattern, &settings).unwrap();
    for frame_idx in 0..3 {
        writer.write_frame(&test_frame(33, 21, frame_idx)).unwrap();
    }
    writer.finish().unwrap();
    for frame_idx in 0..3 {
        let read = image::open(folder.path().join(format!("new/deep/{:04}.png", 8 + frame_idx))).unwrap().into_rgb8();
        assert_eq!(read.dimensions(), (33, 21));
        assert_eq!(read.into_raw(), test_frame(33, 21, frame_idx));
    }
    let names = std::fs::read_dir(folder.path().join("new/deep")).unwrap().count();
    assert_eq!(names, 3, "only the frames are left");
}

#[test]
fn an_existing_frame_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let pattern = folder.path().join("%02d.png");
    std::fs::write(folder.path().join("05.png"), b"mine").unwrap();
    let settings = VideoSettings { width: 4, height: 4, num_frames: 10, ..Default::default() };
    let error = VideoWriter::create(&pattern, &settings).err().unwrap();
    assert_eq!(error.code(), "OUTPUT-EXISTS");
    assert_eq!(std::fs::read(folder.path().join("05.png")).unwrap(), b"mine");
    let elsewhere = VideoSettings { first_frame: 6, num_frames: 4, ..settings };
    assert!(VideoWriter::create(&pattern, &elsewhere).is_ok(), "frames 6..10 are free");
}
