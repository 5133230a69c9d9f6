//! What programs leave that are killed while they clean up, job folders of other builds, and folders that are made for outputs.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::resume::names;
use super::{SMALL_SCENE, answer, data, write_shot};

const FILM: [&str; 6] = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "film.mp4"];

/// A whole film with its job folder.
fn with_folder(folder: &Path) {
    write_shot(folder);
    data(folder, &[&FILM[..], &["--keep-frames"]].concat());
}

/// The same line used to be refused for its film, and to leave the frames for ever.
#[test]
fn a_folder_whose_removal_was_cut_off_is_removed_by_the_next_run() {
    for removed in [&["job.json"][..], &["job.json", "done.log"], &["job.json", "done.log", "lock"]] {
        for (flags, code) in [(&[][..], "exit 73\n"), (&["--overwrite"], "exit 0\n"), (&["--fresh"], "exit 73\n")] {
            let folder = tempfile::tempdir().unwrap();
            with_folder(folder.path());
            let film = fs::read(folder.path().join("film.mp4")).unwrap();
            for name in removed {
                fs::remove_file(folder.path().join("film.mp4.job").join(name)).unwrap();
            }
            let said = answer(folder.path(), &[&FILM[..], flags].concat());
            assert!(said.starts_with(code), "without {removed:?}, {flags:?}: {said}");
            assert_eq!(names(folder.path()), ["film.mp4", "shot.json"], "without {removed:?}, {flags:?}");
            assert!(fs::read(folder.path().join("film.mp4")).unwrap() == film);
        }
    }
}

/// The film has its name, and the program is killed before it has removed anything.
#[cfg(unix)]
#[test]
fn a_folder_that_says_that_its_film_is_placed_is_removed() {
    use std::os::unix::fs::MetadataExt;
    let folder = tempfile::tempdir().unwrap();
    with_folder(folder.path());
    let job = folder.path().join("film.mp4.job");
    let film = fs::metadata(folder.path().join("film.mp4")).unwrap();
    let time = film.modified().unwrap().duration_since(std::time::UNIX_EPOCH).unwrap().as_nanos();
    fs::write(job.join("placed"), format!("{} {} {time}", film.ino() + 1, film.len())).unwrap();
    assert!(answer(folder.path(), &FILM).starts_with("exit 73\n"));
    assert!(job.join("job.json").exists(), "the frames of another film that is to be replaced");
    fs::write(job.join("placed"), format!("{} {} {time}", film.ino(), film.len())).unwrap();
    assert!(answer(folder.path(), &FILM).starts_with("exit 73\n"));
    assert_eq!(names(folder.path()), ["film.mp4", "shot.json"]);
}

/// The pictures of a sequence used to be at risk with the log that lists them: they are the output.
#[test]
fn pictures_stay_when_their_folder_has_lost_its_description() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let line = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "%02d.png"];
    data(folder.path(), &[&line[..], &["--keep-frames"]].concat());
    fs::remove_file(folder.path().join("%02d.png.job/job.json")).unwrap();
    assert!(answer(folder.path(), &line).starts_with("exit 73\n"));
    let is_picture = |name: &&String| name.contains(".png") && !name.contains(".job");
    assert_eq!(names(folder.path()).iter().filter(is_picture).count(), 8);
}

/// Scripts of tasks that have not begun yet are no leftover.
#[test]
fn a_folder_of_tasks_that_wait_stays() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    fs::write(folder.path().join("film.mp4"), "mine").unwrap();
    fs::create_dir_all(folder.path().join("film.mp4.job/tasks")).unwrap();
    fs::write(folder.path().join("film.mp4.job/tasks/part.sh"), "").unwrap();
    assert!(answer(folder.path(), &FILM).starts_with("exit 73\n"));
    assert!(folder.path().join("film.mp4.job/tasks/part.sh").exists());
}

/// Two builds of one version used to share a folder, whatever pictures each of them makes.
#[cfg(unix)]
#[test]
fn frames_of_another_build_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    with_folder(folder.path());
    fs::remove_file(folder.path().join("film.mp4")).unwrap();
    let copy = "cp \"$0\" other && chmod +x other && echo >> other";
    let words = ["-c", copy, env!("CARGO_BIN_EXE_cinesplat")];
    assert!(Command::new("sh").args(words).current_dir(&folder).status().unwrap().success());
    let other = Command::new(folder.path().join("other")).args(FILM).current_dir(&folder).output().unwrap();
    let said = String::from_utf8(other.stderr).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    assert_eq!(other.status.code(), Some(65), "{said}");
    assert!(said.contains(&format!("its frames are of another film: engine was {version} build ")), "{said}");
    assert!(said.contains(&format!(", now {version} build ")) && said.contains("pass --fresh"), "{said}");
    let kept = answer(folder.path(), &FILM);
    assert!(kept.starts_with("exit 0\n") && kept.contains("8 of 8 frames were kept"), "{kept}");
}

/// One field of the film is changed at a time. The frames stay, and the first line goes on from them.
#[test]
fn another_scene_prompt_or_objects_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let small = ["--size", "64x36", "--fps", "8", "--duration", "1", "--solve", "off", "-o", "film.mp4"];
    let object = |label: &str| format!(r#"{{"id":1,"label":"{label}","center":[0,1,0],"half_extents":[1,1,1]}}"#);
    let write = |label: &str| {
        let text = format!(r#"{{"format":"cinesplat.objects","version":1,"objects":[{}]}}"#, object(label));
        fs::write(folder.path().join("o.json"), text).unwrap();
    };
    let line = |scene: &'static str, prompt: &'static str| {
        [&["render", scene, "-p", prompt, "--objects", "o.json"][..], &small].concat()
    };
    write("lamp");
    data(folder.path(), &[&line(SMALL_SCENE, "pan left")[..], &["--keep-frames"]].concat());
    fs::remove_file(folder.path().join("film.mp4")).unwrap();
    for (scene, prompt, label, field) in [
        ("synth:tabletop:2:0.02", "pan left", "lamp", "scene was synth:tabletop:1:0.02, now synth:tabletop:2:0.02"),
        (SMALL_SCENE, "pan right", "lamp", "prompt was pan left, now pan right"),
        (SMALL_SCENE, "pan left", "vase", "objects was "),
    ] {
        write(label);
        let said = answer(folder.path(), &line(scene, prompt));
        assert!(
            said.starts_with("exit 65\n") && said.contains("error[JOB-MISMATCH]: ") && said.contains(field),
            "{said}"
        );
    }
    write("lamp");
    let again = answer(folder.path(), &line(SMALL_SCENE, "pan left"));
    assert!(again.starts_with("exit 0\n") && again.contains("8 of 8 frames were kept"), "{again}");
}

/// The folder is made for the pictures, and used to be missing for what goes beside them.
#[test]
fn further_outputs_go_into_the_folder_that_is_made_for_the_pictures() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let line = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "p/%04d.png", "--frames", "0..2"];
    let further = ["--save-shot", "p/s.json", "--sheet", "./p/sheet.png", "--map", "p/map.svg"];
    data(folder.path(), &[&line[..], &further].concat());
    assert_eq!(names(&folder.path().join("p")), ["0000.png", "0001.png", "map.svg", "s.json", "sheet.png"]);
    let said = answer(folder.path(), &[&line[..], &["--save-shot", "q/s.json", "--overwrite"]].concat());
    assert!(said.starts_with("exit 73\n") && said.contains("q/s.json: cannot create: its folder"), "{said}");
}
