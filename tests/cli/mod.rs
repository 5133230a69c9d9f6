//! Runs the program and checks its output, its files and its exit code.

mod commands;
mod errors;
mod farm;
mod films;
mod leftovers;
mod lone_thing;
mod map;
mod memory;
mod paths;
mod read;
mod replacing;
mod resume;
mod stopping;
mod surroundings;

use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Output};

/// A generated scene of few Gaussians.
pub const SMALL_SCENE: &str = "synth:tabletop:1:0.02";

/// Runs the program in a folder.
pub fn run(folder: &Path, arguments: &[impl AsRef<OsStr>]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_cinesplat"));
    program.args(arguments).current_dir(folder).env_remove("RUST_BACKTRACE").output().unwrap()
}

/// Runs the program and returns exit code, stdout and stderr as one text.
pub fn answer(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let code = output.status.code().map_or("none".to_owned(), |code| code.to_string());
    format!("exit {code}\n{}{}", text(output.stdout), text(output.stderr))
}

/// Runs the program, asserts that it succeeds, and returns its stdout.
pub fn data(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Writes shot.json for the small scene: two keys, 1 second at 8 frames per second, 64 x 36 pixels.
pub fn write_shot(folder: &Path) {
    let key = |time: f64, x: f64| {
        format!(
            r#"{{"time_secs":{time},"position":[{x},1.2,1.5],"rotation_xyzw":[1,0,0,0],"fov_y_deg":50,"easing":"smooth"}}"#
        )
    };
    let shot = format!(
        r#"{{"format":"cinesplat.shot","version":1,"width":64,"height":36,"fps":8,"duration_secs":1,
            "scene":{{"path":"{SMALL_SCENE}","up":[0,1,0]}},"keyframes":[{},{}]}}"#,
        key(0.0, 0.0),
        key(1.0, 0.2)
    );
    std::fs::write(folder.join("shot.json"), shot).unwrap();
}
