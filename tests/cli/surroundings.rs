//! What surrounds the program: strange file names, other locales and time zones, closed streams, a missing home.

use std::fs;
use std::process::{Command, Stdio};

use super::{SMALL_SCENE, answer, data, run, write_shot};

fn program(folder: &std::path::Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cinesplat"));
    command.current_dir(folder);
    command
}

/// A million keys used to take over a minute and 3.4 GB.
#[test]
fn a_million_keys_are_refused_in_time() {
    let folder = tempfile::tempdir().unwrap();
    let key =
        |i: usize| format!(r#"{{"time_secs":{i},"position":[0,0,{i}],"rotation_xyzw":[1,0,0,0],"fov_y_deg":50}}"#);
    let keys: Vec<String> = (0..1_000_000).map(key).collect();
    let shot = format!(r#"{{"format":"cinesplat.shot","version":1,"keyframes":[{}]}}"#, keys.join(","));
    fs::write(folder.path().join("many.json"), shot).unwrap();
    let said = answer(folder.path(), &["export", "many.json", "-o", "s.tum"]);
    assert!(said.starts_with("exit 71\n") && said.contains("error[FILE-SIZE]"), "{said}");
    // Short keys fit into a file of the largest size; their number is refused.
    let keys = vec![r#"{"time_secs":1,"position":[0,0,0]}"#; 1_000_000];
    let shot = format!(r#"{{"format":"cinesplat.shot","version":1,"keyframes":[{}]}}"#, keys.join(","));
    fs::write(folder.path().join("many.json"), shot).unwrap();
    let said = answer(folder.path(), &["export", "many.json", "-o", "s.tum"]);
    assert!(said.starts_with("exit 65\n") && said.contains("bytes of memory"), "{said}");
}

#[cfg(unix)]
#[test]
fn strange_names_of_outputs_are_names() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let shot = fs::read(folder.path().join("shot.json")).unwrap();
    for name in [&b"file:x.tum"[..], b"concat:a|b.tum", b"%05d.tum", b"a b\n.tum", b"\xff\xfe.tum", b"./-x.tum"] {
        let name = OsStr::from_bytes(name);
        let words = [OsStr::new("export"), OsStr::new("shot.json"), OsStr::new("--to=tum"), OsStr::new("-o"), name];
        let output = run(folder.path(), &words);
        assert!(output.status.success(), "{name:?}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(folder.path().join(name).is_file(), "{name:?}");
    }
    let long = "x".repeat(255) + ".tum";
    let said = answer(folder.path(), &["export", "shot.json", "-o", &long]);
    assert!(said.starts_with("exit 73\n"), "{said}");
    assert_eq!(fs::read(folder.path().join("shot.json")).unwrap(), shot);
}

#[test]
fn other_locales_and_time_zones_change_no_byte() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let render = |name: &str, locale: &str, zone: &str| {
        let mut command = program(folder.path());
        command.env("LC_ALL", locale).env("LANG", locale).env("TZ", zone);
        let output = command.args(["render", SMALL_SCENE, "--shot", "shot.json", "-o", name]).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        fs::read(folder.path().join(name)).unwrap()
    };
    let here = render("a.mp4", "C", "UTC");
    assert!(here == render("b.mp4", "de_DE.UTF-8", "Pacific/Apia"));
    let list = data(folder.path(), &["export", "shot.json", "--to", "tum", "-o", "-"]);
    assert!(list.contains('.') && !list.contains(','), "{list}");
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_and_a_missing_home_are_no_faults() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let name = env!("CARGO_BIN_EXE_cinesplat");
    for line in [
        // The reader of stdout, of stderr and of both is gone.
        format!("{name} export shot.json --fps 1000 --to csv -o - | head -n 1"),
        format!("{name} objects {SMALL_SCENE} 2>&1 >out.txt | head -c 1"),
        format!("{name} info {SMALL_SCENE} 2>&- >out.txt"),
        format!("env -i {name} render {SMALL_SCENE} --shot shot.json -o film.mp4"),
        format!("TMPDIR=/nowhere HOME=/nowhere {name} export shot.json -o s.glb"),
    ] {
        let words = ["-c", &format!("set -o pipefail; {line}")];
        let output = Command::new("bash").args(words).current_dir(&folder).stdin(Stdio::null()).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{line}: {:?} {said}", output.status);
        assert!(!said.contains("panicked"), "{line}: {said}");
    }
    // A full disk behind stdout is an error of reading and writing.
    let full = Command::new("bash")
        .args(["-c", &format!("{name} info {SMALL_SCENE} > /dev/full")])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(full.status.code(), Some(74), "{}", String::from_utf8_lossy(&full.stderr));
}
