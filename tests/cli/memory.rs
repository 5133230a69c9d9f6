//! Memory that is not there is exit code 71, with the flag that helps, and never an abort.

use std::fs;

use super::{SMALL_SCENE, answer, write_shot};

/// A cameras file with one camera.
fn write_cameras(folder: &std::path::Path, side: u32) {
    let middle = f64::from(side) / 2.0;
    let text = format!(
        r#"{{"cameras":[{{"name":"c","width":{side},"height":{side},"fx":{middle},"fy":{middle},"cx":{middle},"cy":{middle},
            "world_from_camera":[[1,0,0,0],[0,-1,0,1.2],[0,0,-1,1.5],[0,0,0,1]]}}]}}"#
    );
    fs::write(folder.join("cameras.json"), text).unwrap();
}

/// It used to abort: the picture was allocated before its size was compared with the limit.
#[test]
fn a_picture_that_fits_no_memory_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    write_cameras(folder.path(), 65535);
    let said = answer(folder.path(), &["still", SMALL_SCENE, "--cameras", "cameras.json", "-o", "stills"]);
    assert!(said.starts_with("exit 71\n") && said.contains("error[RENDER-MEMORY]: "), "{said}");
    assert!(said.contains("help: raise --max-memory"), "{said}");
    assert!(!said.contains("--size"), "a flag that `still` has not: {said}");
}

/// It used to abort, or to take hours.
#[test]
fn a_film_of_too_many_frames_is_refused_before_it_is_planned() {
    let folder = tempfile::tempdir().unwrap();
    let long = ["--fps", "1000", "--duration", "86400"];
    insta::assert_snapshot!(answer(folder.path(), &[&["plan", SMALL_SCENE, "-p", "pan left", "-o", "s.json"], &long[..]].concat()), @r"
    exit 71
    up: 0.000 1.000 0.000 (the scene file: generated with y up)
    error[SHOT-KEYS]: a film of 86400000 frames (duration_secs times fps), expected at most 4000000
    help: make it shorter, or lower --fps
    ");
    write_shot(folder.path());
    let render = [&["render", SMALL_SCENE, "--shot", "shot.json", "-o", "f.mp4"], &long[..]].concat();
    assert!(answer(folder.path(), &render).starts_with("exit 71\n"));
    let shot = fs::read_to_string(folder.path().join("shot.json")).unwrap();
    fs::write(folder.path().join("shot.json"), shot.replace("\"duration_secs\":1,", "\"duration_secs\":86400,"))
        .unwrap();
    assert!(answer(folder.path(), &["export", "shot.json", "--fps", "1000", "-o", "s.tum"]).starts_with("exit 71\n"));
}

#[test]
fn a_bound_on_memory_is_kept_by_bands_or_by_refusal() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let render = |name: &str, most: &str| {
        answer(folder.path(), &["render", SMALL_SCENE, "--shot", "shot.json", "-o", name, "--max-memory", most])
    };
    let (enough, little) = (render("a.mp4", "1G"), render("b.mp4", "24M"));
    assert!(enough.starts_with("exit 0\n"), "{enough}");
    assert!(little.starts_with("exit 71\n") && little.contains("help: raise --max-memory"), "{little}");
    assert!(!folder.path().join("b.mp4").exists());
    let said = answer(folder.path(), &["info", SMALL_SCENE, "--max-memory", "much"]);
    assert!(said.contains("expected a size of at least 1M, such as 512M or 4G"), "{said}");
}

/// Allocations of less than a megabyte used to abort under `ulimit -v`.
#[cfg(target_os = "linux")]
#[test]
fn a_limit_on_address_space_ends_in_an_error_and_never_in_an_abort() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let program = env!("CARGO_BIN_EXE_cinesplat");
    for kilobytes in [280_000, 300_000, 400_000, 800_000] {
        let line = format!(
            "ulimit -v {kilobytes}; exec {program} render {SMALL_SCENE} --shot shot.json --overwrite --fresh -o f.mp4"
        );
        let output = std::process::Command::new("sh").args(["-c", &line]).current_dir(&folder).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        // Below its own size the program does not even start: that is the system's loader.
        assert!(matches!(output.status.code(), Some(0 | 71 | 127)), "{kilobytes} KB: {:?} {said}", output.status);
        assert!(output.status.code() != Some(71) || said.contains("help: "), "{kilobytes} KB: {said}");
    }
}

/// Exit code and stderr of a line in which `$0` is the program, under a limit on address space.
#[cfg(target_os = "linux")]
fn under_limit(folder: &std::path::Path, kilobytes: usize, line: &str) -> (Option<i32>, String) {
    let line = format!("ulimit -v {kilobytes}; exec \"$0\" {line}");
    let words = ["-c", &line, env!("CARGO_BIN_EXE_cinesplat")];
    let output = std::process::Command::new("sh").args(words).current_dir(folder).output().unwrap();
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Where the program barely starts, it said 71 and died of a signal: mimalloc frees at the end what it could not take.
#[cfg(target_os = "linux")]
#[test]
fn a_program_that_barely_starts_ends_with_its_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let info = |kilobytes| under_limit(folder.path(), kilobytes, &format!("info {SMALL_SCENE}"));
    // Below that, the system's loader ends it, or a library that aborts while it is loaded, or the C library, or there is no
    // room for a stack.
    let is_of_library = |said: &str| said.contains("GLib") || said.starts_with("Fatal glibc error");
    let aborts = |code: Option<i32>, said: &str| code.is_none() && (said.is_empty() || is_of_library(said));
    let starts = |code: Option<i32>, said: &str| code != Some(127) && !aborts(code, said);
    let is_above = |kilobytes: &usize| {
        let (code, said) = info(*kilobytes);
        starts(code, &said)
    };
    let above = (150_000..2_000_000).step_by(5_000).find(is_above).unwrap();
    for kilobytes in (above - 5_000..above + 15_000).step_by(500) {
        let (code, said) = info(kilobytes);
        if starts(code, &said) {
            assert!(matches!(code, Some(0 | 71)), "{kilobytes} KB: {code:?} {said}");
            assert!(code == Some(0) || said.contains("\nhelp: "), "{kilobytes} KB: {said}");
        }
    }
}

/// It used to be a fault of the program: a library panics where the system refuses it a thread.
#[cfg(target_os = "linux")]
#[test]
fn a_library_that_gets_no_thread_is_a_lack_of_memory() {
    let folder = tempfile::tempdir().unwrap();
    for kilobytes in (280_000..=560_000).step_by(40_000) {
        let plan = format!("plan {SMALL_SCENE} -p push_in -o plan.json --overwrite -q --solve fast");
        let (code, said) = under_limit(folder.path(), kilobytes, &plan);
        assert!(matches!(code, Some(0 | 71 | 127)), "{kilobytes} KB: {code:?} {said}");
    }
}

/// It used to abort after minutes.
#[test]
fn more_threads_than_any_machine_has_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_cinesplat"));
    let output =
        program.args(["info", SMALL_SCENE]).env("RAYON_NUM_THREADS", "5000").current_dir(&folder).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("RAYON_NUM_THREADS is 5000, expected at most 1024"), "{said}");
}
