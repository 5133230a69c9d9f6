use std::fs;

use super::{SMALL_SCENE, answer, write_shot};

#[test]
fn a_scene_that_is_not_there() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["info", "no/room.spz"]), @"");
}

#[test]
fn a_scene_that_is_no_scene() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("room.ply"), "not a ply\n").unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["info", "room.ply"]), @"");
    fs::write(folder.path().join("cut.ply"), "ply\nformat binary_little_endian 1.0\nelement vertex 9\n").unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["info", "cut.ply"]), @"");
}

#[test]
fn a_generated_scene_of_another_name() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["info", "synth:castle:1"]), @"");
}

#[test]
fn arguments_that_are_no_command() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["inof"]), @"");
    insta::assert_snapshot!(answer(folder.path(), &["info"]), @"");
    insta::assert_snapshot!(answer(folder.path(), &["info", "a.ply", "--jsno"]), @"");
    insta::assert_snapshot!(answer(folder.path(), &["render", "a.ply", "-p", "x", "--shot", "s.json", "-o", "a.mp4"]), @"");
    insta::assert_snapshot!(answer(folder.path(), &["render", "a.ply", "-p", "x", "-o", "a.mp4", "--size", "0x9"]), @"");
    insta::assert_snapshot!(answer(folder.path(), &["plan", "a.ply", "-p", "x", "-o", "s.json", "--effects", "blur"]), @"");
}

#[test]
fn outputs_are_checked_before_the_scene_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |arguments: &[&str]| answer(folder.path(), arguments);
    fs::write(folder.path().join("film.mp4"), "mine").unwrap();
    // The scene does not exist: none of these gets as far as to notice.
    insta::assert_snapshot!(refused(&["render", "no.ply", "-p", "x", "-o", "film.mp4"]), @"");
    insta::assert_snapshot!(refused(&["render", "no.ply", "-p", "x", "-o", "no/film.mp4"]), @"");
    insta::assert_snapshot!(refused(&["render", "no.ply", "-p", "x", "-o", "film.gif"]), @"");
    insta::assert_snapshot!(refused(&["render", "no.ply", "-p", "x", "-o", "frames/f.png"]), @"");
    insta::assert_snapshot!(refused(&["plan", "no.ply", "-p", "x", "-o", "film.mp4"]), @"");
    insta::assert_snapshot!(refused(&["import", "no.tum", "-o", "."]), @"");
    assert_eq!(fs::read(folder.path().join("film.mp4")).unwrap(), b"mine");
}

#[test]
fn a_prompt_that_names_an_unknown_object() {
    let folder = tempfile::tempdir().unwrap();
    let plan = |prompt: &str| answer(folder.path(), &["plan", SMALL_SCENE, "-p", prompt, "-o", "shot.json"]);
    insta::assert_snapshot!(plan("push in on <obj-99>"), @"");
    insta::assert_snapshot!(plan("orbit the elephant"), @"");
    insta::assert_snapshot!(plan("  "), @"");
    assert!(!folder.path().join("shot.json").exists());
}

#[test]
fn a_shot_that_is_no_shot() {
    let folder = tempfile::tempdir().unwrap();
    let render = |text: &str| {
        fs::write(folder.path().join("shot.json"), text).unwrap();
        answer(folder.path(), &["export", "shot.json", "--to", "tum", "-o", "out.tum"])
    };
    insta::assert_snapshot!(render("{"), @"");
    insta::assert_snapshot!(render(r#"{"format":"cinesplat.shot","version":7}"#), @"");
    let text = r#"{"format":"cinesplat.shot","version":1,"keyframes":[]}"#;
    insta::assert_snapshot!(render(text), @"");
    assert!(!folder.path().join("out.tum").exists());
}

#[test]
fn frames_that_the_film_does_not_have() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let render = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "f.mp4", "--frames", "4..9"];
    insta::assert_snapshot!(answer(folder.path(), &render), @"");
}
