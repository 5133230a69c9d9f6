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
fn only_names_of_the_pattern_have_a_number() {
    let number = |pattern: &str, name: &str| FramePattern::parse(Path::new(pattern)).unwrap().number_of(name);
    assert_eq!(number("out/%03d.png", "042.png"), Some(42));
    assert_eq!(number("out/%03d.png", "1042.png"), Some(1042));
    assert_eq!(number("a%%b%d.png", "a%b7.png"), Some(7));
    for other in
        ["42.png", "0042.png", "+42.png", "042.PNG", ".png", "x042.png", "042.png.part", "99999999999999999999999.png"]
    {
        assert_eq!(number("out/%03d.png", other), None, "{other}");
    }
}

#[test]
fn patterns_without_one_number_per_frame_are_rejected() {
    for bad in ["out/frame.png", "%d_%d.png", "%x.png", "%5d.png", "%.png", "%", "%099d.png"] {
        let error = FramePattern::parse(Path::new(bad)).unwrap_err();
        assert_eq!(error.code(), "VIDEO-PATTERN", "{bad}");
    }
}
