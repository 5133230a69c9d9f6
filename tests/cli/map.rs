use std::fs;

use super::{SMALL_SCENE, answer, data, run, write_shot};

#[test]
fn a_shot_is_drawn_as_svg_or_png_and_overwritten_only_when_asked() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    for name in ["map.svg", "map.PNG"] {
        let map = ["map", SMALL_SCENE, "--shot", "shot.json", "-o", name];
        data(folder.path(), &map);
        let first = fs::read(folder.path().join(name)).unwrap();
        assert!(first.starts_with(b"<svg") || first.starts_with(b"\x89PNG"));
        assert_eq!(run(folder.path(), &map).status.code(), Some(73));
        assert!(run(folder.path(), &[&map[..], &["--overwrite"]].concat()).status.success());
        assert_eq!(first, fs::read(folder.path().join(name)).unwrap(), "{name}: a second run draws the same");
    }
}

#[test]
fn plan_and_render_write_the_same_map() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("moves.txt"), "left\tpan left\n").unwrap();
    let small = ["--prompts", "moves.txt", "--solve", "off", "--size", "64x36", "--fps", "4"];
    data(folder.path(), &[&["plan", SMALL_SCENE, "--map", "{}.svg"][..], &small].concat());
    let film = ["render", SMALL_SCENE, "-o", "{}.mp4", "--map", "film-{}.svg", "--frames", "0..2"];
    data(folder.path(), &[&film[..], &small].concat());
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("left.svg"), read("film-left.svg"));
    assert!(read("left.svg").contains("pan left"));
}

#[test]
fn a_wrong_name_of_a_map_is_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["plan", "no.ply", "-p", "pan left", "--map", "map.gif"]), @r"
    exit 2
    error[USAGE]: map.gif: the name does not determine the format of the figure, expected .svg, .png or .pdf
    help: name the figure something such as figure.svg
    ");
    let same = ["render", "no.ply", "-p", "pan left", "-o", "a.mp4", "--sheet", "a.png", "--map", "a.png"];
    assert!(answer(folder.path(), &same).contains("--sheet and --map both write this file"));
}
