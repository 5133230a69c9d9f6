//! Signals before the first frame, and to a farm.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use super::resume::{LONG, names, start};
use super::{SMALL_SCENE, write_shot};

/// Starts the program, and returns once it handles SIGTERM.
fn started(folder: &Path, arguments: &[&str]) -> Child {
    let mut program = Command::new(env!("CARGO_BIN_EXE_cinesplat"));
    let mut child = program.args(arguments).current_dir(folder).stderr(Stdio::piped()).spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    let handles_term = || {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let caught = text.lines().find_map(|line| line.strip_prefix("SigCgt:")).map(str::trim).unwrap_or_default();
        u64::from_str_radix(caught, 16).is_ok_and(|caught| (caught >> 14) & 1 == 1)
    };
    while !handles_term() && child.try_wait().unwrap().is_none() {
        std::thread::yield_now();
    }
    child
}

fn signal(name: &str, child: &Child) {
    assert!(Command::new("kill").args([name, &child.id().to_string()]).status().unwrap().success());
}

/// The program used to end by the signal, without a word.
#[test]
fn a_signal_before_the_first_frame_says_that_nothing_was_begun() {
    let folder = tempfile::tempdir().unwrap();
    let render = ["render", "synth:demo", "-p", "orbit the sofa by 300 degrees", "-o", "film.mp4"];
    let plan = ["plan", "synth:demo", "-p", "orbit the sofa by 300 degrees", "-o", "shot.json"];
    for (line, name, far) in [
        (&render[..], "-TERM", "stopped before the first frame was begun"),
        (&render, "-INT", "stopped before the first frame was begun"),
        (&plan, "-TERM", "stopped before the plan was whole"),
    ] {
        let child = started(folder.path(), line);
        signal(name, &child);
        let ended = child.wait_with_output().unwrap();
        let said = String::from_utf8(ended.stderr).unwrap();
        assert_eq!(ended.status.code(), Some(75), "{name}: {said}");
        let expected = format!("error[STOPPED]: {far}\nhelp: to start again, type: ");
        assert!(said.contains(&expected) && said.contains("'orbit the sofa by 300 degrees'"), "{name}: {said}");
    }
    assert_eq!(names(folder.path()), [""; 0], "nothing is left");
}

/// Each of its programs used to print the line that goes on with its own part.
#[test]
fn a_stopped_farm_says_one_line_to_go_on() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let film = [&["farm", "--local", "2", SMALL_SCENE, "--shot", "shot.json", "-o", "film.mp4"][..], &LONG].concat();
    let farm = start(folder.path(), &film, 2);
    signal("-INT", &farm);
    let ended = farm.wait_with_output().unwrap();
    let said = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(75), "{said}");
    assert_eq!(said.matches("to go on, type: ").count(), 1, "{said}");
    assert_eq!(said.matches("error[").count(), 1, "{said}");
    assert!(said.contains(" farm --local 2 "), "{said}");
}
