use std::path::Path;

use cinesplat::video::FramePattern;

#[test]
fn patterns_name_frames_as_printf_does() {
    let name = |pattern: &str, frame_idx| FramePattern::parse(Path::new(pattern)).unwrap().path(frame_idx);
    assert_eq!(name("out/%05d.png", 42), Path::new("out/00042.png"));
    assert_eq!(name("f%d.png", 1000), Path::new("f1000.png"));
    assert_eq!(name("a%%b%03d_x.png", 7), Path::new("a%b007_x.png"));
    assert_eq!(name("50%/%02d.png", 123), Path::new("50%/123.png"));
}

#[test]
fn patterns_without_one_number_per_frame_are_rejected() {
    for bad in ["out/frame.png", "%d_%d.png", "%x.png", "%5d.png", "%.png", "%", "%099d.png"] {
        let error = FramePattern::parse(Path::new(bad)).unwrap_err();
        assert_eq!(error.code(), "VIDEO-PATTERN", "{bad}");
    }
}
