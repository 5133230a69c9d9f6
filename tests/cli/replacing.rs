//! Outputs that are inputs.

use std::fs;

use super::{SMALL_SCENE, answer, data, write_shot};

/// The scene used to be replaced by its film, and the shot by its path.
#[test]
fn an_output_that_is_an_input_is_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let shot = fs::read(folder.path().join("shot.json")).unwrap();
    fs::write(folder.path().join("own.mp4"), "a scene").unwrap();
    fs::write(folder.path().join("one.txt"), "one\tpan left\n").unwrap();
    let refused = |line: &[&str]| answer(folder.path(), &[line, &["--overwrite"]].concat());
    insta::assert_snapshot!(refused(&["render", "own.mp4", "--shot", "shot.json", "-o", "own.mp4"]), @r"
    exit 2
    error[USAGE]: own.mp4: --output would replace the scene, expected another file
    help: give the output a name of its own
    ");
    insta::assert_snapshot!(refused(&["export", "shot.json", "--to", "tum", "-o", "./shot.json"]), @r"
    exit 2
    error[USAGE]: ./shot.json: --output would replace the shot, expected another file
    help: give the output a name of its own
    ");
    let lines: [(&[&str], &str); 9] = [
        (&["render", "x.ply", "--shot", "shot.json", "-o", "f.mp4", "--save-shot", "shot.json"], "--save-shot"),
        (&["plan", "x.ply", "--prompts", "one.txt", "-o", "{}.txt"], "--output"),
        (&["farm", "--local", "2", "own.mp4", "--shot", "shot.json", "-o", "own.mp4"], "--output"),
        (&["plan", "own.mp4", "-p", "pan left", "-o", "own.mp4"], "--output"),
        (&["plan", "x.ply", "-p", "pan left", "--objects", "own.mp4", "-o", "own.mp4"], "--output"),
        (&["import", "shot.json", "-o", "shot.json"], "--output"),
        (&["export", "shot.json", "--objects", "own.mp4", "--to", "tum", "-o", "own.mp4"], "--output"),
        (&["objects", "own.mp4", "-o", "own.mp4"], "--output"),
        (&["objects", "x.ply", "--rename", "own.mp4", "-o", "own.mp4"], "--output"),
    ];
    for (line, flag) in lines {
        let said = refused(line);
        let expected = format!("{flag} would replace the ");
        assert!(said.starts_with("exit 2\n") && said.contains(&expected), "{line:?}: {said}");
    }
    assert_eq!(fs::read(folder.path().join("own.mp4")).unwrap(), b"a scene");
    assert_eq!(fs::read(folder.path().join("shot.json")).unwrap(), shot);
}

#[cfg(unix)]
#[test]
fn an_output_that_is_an_input_by_another_name_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    fs::hard_link(folder.path().join("shot.json"), folder.path().join("hard.json")).unwrap();
    std::os::unix::fs::symlink("shot.json", folder.path().join("soft.json")).unwrap();
    for name in ["hard.json", "soft.json"] {
        let said = answer(folder.path(), &["export", "shot.json", "--to", "tum", "-o", name, "--overwrite"]);
        assert!(said.starts_with("exit 2\n") && said.contains("--output would replace the shot"), "{name}: {said}");
    }
}

/// New names are written over the old ones: the line that the help of `objects` shows.
#[test]
fn an_objects_file_may_be_written_over_itself() {
    let folder = tempfile::tempdir().unwrap();
    data(folder.path(), &["objects", SMALL_SCENE, "-o", "objects.json"]);
    let rename = ["objects", SMALL_SCENE, "--objects", "objects.json", "--name", "1=mug", "-o", "objects.json"];
    data(folder.path(), &[&rename[..], &["--overwrite"]].concat());
    assert!(fs::read_to_string(folder.path().join("objects.json")).unwrap().contains("\"mug\""));
}

/// Names used to be lost without a word.
#[test]
fn names_and_corrections_that_no_file_keeps_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    data(folder.path(), &["objects", SMALL_SCENE, "-o", "objects.json"]);
    for edit in [["--name", "1=mug"], ["--merge", "1,2"], ["--drop", "1"]] {
        let line = [&["objects", SMALL_SCENE, "--objects", "objects.json"][..], &edit].concat();
        let said = answer(folder.path(), &line);
        assert!(said.starts_with("exit 2\n") && said.contains("without a file to write"), "{said}");
    }
    let line = ["objects", SMALL_SCENE, "--objects", "objects.json", "--detail", "2"];
    assert!(answer(folder.path(), &line).starts_with("exit 2\n"));
}

/// A file that does not exist used to be passed over where the shot names no objects.
#[test]
fn an_objects_file_that_a_shot_does_not_need_is_checked() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let line = ["render", SMALL_SCENE, "--shot", "shot.json", "--objects", "nothing.json", "-o", "f.mp4"];
    insta::assert_snapshot!(answer(folder.path(), &line), @r"
    exit 66
    error[FILE-READ]: nothing.json: cannot read: No such file or directory (os error 2)
    help: check the path
    ");
    fs::write(folder.path().join("nothing.json"), "{}").unwrap();
    assert!(answer(folder.path(), &line).starts_with("exit 65\n"));
}
