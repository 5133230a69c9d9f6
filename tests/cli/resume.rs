//! Films that are stopped, killed or refused, and what the next run makes of it.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use super::{SMALL_SCENE, answer, data, run, write_shot};

const RENDER: [&str; 4] = ["render", SMALL_SCENE, "--shot", "shot.json"];
/// A film of 24 frames.
const SHORT: [&str; 4] = ["--size", "320x180", "--fps", "24"];
/// A film of 300 frames: a signal comes before its end.
pub const LONG: [&str; 4] = ["--size", "320x180", "--fps", "300"];

/// The line that renders the film of most of these tests.
fn render<'a>(output: &'a str, flags: &[&'a str]) -> Vec<&'a str> {
    render_sized(&SHORT, output, flags)
}

fn render_sized<'a>(size: &[&'a str], output: &'a str, flags: &[&'a str]) -> Vec<&'a str> {
    [&RENDER[..], size, &["-o", output], flags].concat()
}

/// The film of an undisturbed run.
fn undisturbed(folder: &Path) -> Vec<u8> {
    undisturbed_sized(folder, &SHORT)
}

fn undisturbed_sized(folder: &Path, size: &[&str]) -> Vec<u8> {
    write_shot(folder);
    data(folder, &render_sized(size, "whole.mp4", &[]));
    let bytes = fs::read(folder.join("whole.mp4")).unwrap();
    fs::remove_file(folder.join("whole.mp4")).unwrap();
    bytes
}

/// Names of the files and folders in a folder.
pub fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Starts the program, and returns once its job folder lists `num_frames` frames, or the film has ended.
pub fn start(folder: &Path, arguments: &[&str], num_frames: usize) -> Child {
    let mut program = Command::new(env!("CARGO_BIN_EXE_cinesplat"));
    program.args(arguments).current_dir(folder).stderr(Stdio::piped());
    let mut film = program.spawn().unwrap();
    let log = folder.join("film.mp4.job/done.log");
    let num_listed = || fs::read_to_string(&log).map_or(0, |text| text.lines().count());
    while num_listed() < num_frames && film.try_wait().unwrap().is_none() {
        std::thread::yield_now();
    }
    film
}

#[test]
fn a_killed_film_goes_on_and_has_the_bytes_of_an_undisturbed_one() {
    let folder = tempfile::tempdir().unwrap();
    let whole = undisturbed(folder.path());
    for num_frames in [1, 4, 11, 23] {
        let mut film = start(folder.path(), &render("film.mp4", &[]), num_frames);
        film.kill().unwrap();
        film.wait().unwrap();
        let listed = fs::read_to_string(folder.path().join("film.mp4.job/done.log")).unwrap_or_default();
        let said = answer(folder.path(), &render("film.mp4", &["--overwrite"]));
        assert!(said.starts_with("exit 0\n"), "{said}");
        // The kill may have come after the last frame; then nothing is left to go on from.
        if !listed.is_empty() {
            let going_on = format!("going on: {} finished frames are in film.mp4.job", listed.lines().count());
            assert!(said.contains(&going_on), "{going_on}: {said}");
        }
        assert!(fs::read(folder.path().join("film.mp4")).unwrap() == whole, "killed after {num_frames} frames");
        assert_eq!(names(folder.path()), ["film.mp4", "shot.json"], "nothing else is left");
        fs::remove_file(folder.path().join("film.mp4")).unwrap();
    }
}

#[cfg(unix)]
#[test]
fn a_stopped_film_says_the_line_that_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let whole = undisturbed_sized(folder.path(), &LONG);
    for signal in ["-INT", "-TERM"] {
        let flags = ["--fresh", "--save-shot", "saved.json", "--sheet", "s.png"];
        let film = start(folder.path(), &render_sized(&LONG, "film.mp4", &flags), 2);
        assert!(Command::new("kill").args([signal, &film.id().to_string()]).status().unwrap().success());
        let output = film.wait_with_output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(75), "{said}");
        assert!(
            said.contains("error[STOPPED]: film.mp4: stopped after ") && said.contains("kept in film.mp4.job"),
            "{said}"
        );
        let line = said.lines().find_map(|line| line.strip_prefix("help: to go on, type: ")).unwrap();
        assert!(!line.contains("--fresh"), "{line}");
        let typed = Command::new("sh").args(["-c", line]).current_dir(folder.path()).output().unwrap();
        assert!(typed.status.success(), "{}", String::from_utf8_lossy(&typed.stderr));
        assert!(fs::read(folder.path().join("film.mp4")).unwrap() == whole, "{signal}");
        assert_eq!(names(folder.path()), ["film.mp4", "s.png", "saved.json", "shot.json"]);
        for name in ["film.mp4", "s.png", "saved.json"] {
            fs::remove_file(folder.path().join(name)).unwrap();
        }
    }
}

#[test]
fn frames_of_another_film_are_refused_field_by_field() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    // A film under a name that is taken meanwhile leaves its job folder.
    let small = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "film.mp4", "--keep-frames"];
    data(folder.path(), &small);
    fs::remove_file(folder.path().join("film.mp4")).unwrap();
    let other = [&small[..], &["--quality", "draft", "--fps", "4", "--crf", "30"]].concat();
    insta::assert_snapshot!(answer(folder.path(), &[&other[..], &["-q"]].concat()), @r"
    exit 65
    error[JOB-MISMATCH]: film.mp4.job: its frames are of another film: fps was 8, now 4; frames was 0..8, now 0..4; quality was standard, now draft; crf was 18, now 30; preset was veryfast, now ultrafast
    help: type the line of that film to go on with it, or pass --fresh to throw its frames away
    ");
    assert_eq!(names(&folder.path().join("film.mp4.job/frames")).len(), 8, "the frames stay");
    data(folder.path(), &[&other[..], &["--fresh"]].concat());
    assert_eq!(names(&folder.path().join("film.mp4.job/frames")).len(), 4);
    assert!(folder.path().join("film.mp4").exists());
}

#[test]
fn one_program_works_on_a_film_and_a_lock_without_a_holder_is_none() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    fs::create_dir(folder.path().join("film.mp4.job")).unwrap();
    let lock = fs::File::create(folder.path().join("film.mp4.job/lock")).unwrap();
    lock.lock().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["render", "no.ply", "-p", "x", "-o", "film.mp4"]), @r"
    exit 75
    error[JOB-LOCKED]: film.mp4.job: another cinesplat is working on this film
    help: wait until it ends, or give this film another name
    ");
    drop(lock);
    data(folder.path(), &["render", SMALL_SCENE, "--shot", "shot.json", "-o", "film.mp4"]);
    assert_eq!(names(folder.path()), ["film.mp4", "shot.json"]);
}

/// A disk without locks used to end the film. Programs there write a file each, which is heeded on every disk.
#[cfg(unix)]
#[test]
fn the_file_of_a_program_without_locks_is_heeded_until_it_is_old() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let holders = folder.path().join("film.mp4.job/holders");
    fs::create_dir_all(&holders).unwrap();
    fs::write(folder.path().join("film.mp4.job/lock"), "").unwrap();
    let holder = fs::File::create(holders.join("elsewhere.1-7-0")).unwrap();
    fs::write(holders.join("elsewhere.1-7-0"), "shared").unwrap();
    let line = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "film.mp4"];
    let said = answer(folder.path(), &line);
    assert!(said.starts_with("exit 75\n") && said.contains("error[JOB-LOCKED]"), "{said}");
    data(folder.path(), &[&line[..], &["--part", "--frames", "0..2"]].concat());
    assert_eq!(names(&holders), ["elsewhere.1-7-0"], "a part works beside a part");
    holder.set_modified(std::time::SystemTime::now() - std::time::Duration::from_mins(10)).unwrap();
    data(folder.path(), &line);
    assert_eq!(names(folder.path()), ["film.mp4", "shot.json"]);
}

/// Two programs used to write one film where one of them was halted so long that the other one took over.
#[cfg(unix)]
#[test]
fn a_program_that_lost_its_folder_makes_no_film() {
    let folder = tempfile::tempdir().unwrap();
    let whole = undisturbed(folder.path());
    let film = start(folder.path(), &render("film.mp4", &[]), 1);
    let holders = folder.path().join("film.mp4.job/holders");
    assert_eq!(names(&holders).len(), 1, "locks or not, a program shows itself");
    fs::remove_file(holders.join(&names(&holders)[0])).unwrap();
    let ended = film.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(ended.status.code() == Some(75) && said.contains("error[JOB-LOST]: film.mp4.job"), "{said}");
    assert_eq!(names(folder.path()), ["film.mp4.job", "shot.json"]);
    data(folder.path(), &render("film.mp4", &[]));
    assert!(fs::read(folder.path().join("film.mp4")).unwrap() == whole);
    assert_eq!(names(folder.path()), ["film.mp4", "shot.json"]);
}

/// It used to be parsed whatever its size in memory.
#[test]
fn the_description_of_a_film_is_bounded_as_all_json_is() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    fs::create_dir(folder.path().join("film.mp4.job")).unwrap();
    let many = format!("[{}{{}}]", "{},".repeat(900_000));
    fs::write(folder.path().join("film.mp4.job/job.json"), many).unwrap();
    let said = answer(folder.path(), &["render", SMALL_SCENE, "--shot", "shot.json", "-o", "film.mp4"]);
    assert!(
        said.starts_with("exit 65\n") && said.contains("error[JOB-READ]: film.mp4.job/job.json: values that take"),
        "{said}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn places_that_cannot_be_written_are_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let long = format!("{}.mp4", "a".repeat(250));
    fs::write(folder.path().join("taken.mp4.job"), "a file").unwrap();
    for (output, code) in [("/proc/film.mp4", "77"), (&long, "73"), ("new.mp4/", "73"), ("taken.mp4", "73")] {
        // The scene does not exist, but the output is checked first.
        let said = answer(folder.path(), &["render", "no.ply", "-p", "x", "-o", output]);
        assert!(said.starts_with(&format!("exit {code}\nerror[OUTPUT-CREATE]: ")), "{output}: {said}");
    }
    assert_eq!(names(folder.path()), ["taken.mp4.job"]);
}

/// A full disk used to throw the whole film away.
#[cfg(target_os = "linux")]
#[test]
fn a_film_that_does_not_fit_in_its_place_is_kept_and_put_there_later() {
    let folder = tempfile::tempdir().unwrap();
    let whole = undisturbed(folder.path());
    let output = folder.path().join("film.mp4");
    std::os::unix::fs::symlink("/dev/full", &output).unwrap();
    let said = answer(folder.path(), &render("film.mp4", &[]));
    let expected = "error[JOB-NAME]: film.mp4: cannot write: No space left on device (os error 28); the finished film is film.mp4.job/film.mp4\nhelp: ";
    assert!(said.starts_with("exit 74\n") && said.contains(expected), "{said}");
    assert!(fs::read(folder.path().join("film.mp4.job/film.mp4")).unwrap() == whole);
    fs::remove_file(&output).unwrap();
    data(folder.path(), &render("film.mp4", &[]));
    assert!(fs::read(&output).unwrap() == whole);
    assert_eq!(names(folder.path()), ["film.mp4", "shot.json"]);
}

/// The limit used to end the program without a word.
#[cfg(target_os = "linux")]
#[test]
fn a_limit_on_file_sizes_is_an_error_that_keeps_the_frames() {
    let folder = tempfile::tempdir().unwrap();
    // A frame takes 3.4 KB, the film more than the 12.8 KB of its index. The unit of bash's limit is 1024 bytes.
    let size = ["--size", "64x36", "--fps", "96"];
    let whole = undisturbed_sized(folder.path(), &size);
    assert!(whole.len() > 16 << 10);
    let mut shell = Command::new("bash");
    shell.args(["-c", r#"ulimit -f 14; exec "$0" "$@""#, env!("CARGO_BIN_EXE_cinesplat")]);
    let output = shell.args(render_sized(&size, "film.mp4", &[])).current_dir(folder.path()).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(74), "{said}");
    assert!(said.contains("File too large") && said.contains("then go on with: "), "{said}");
    assert!(said.contains("help: raise the limit on file sizes (ulimit -f)"), "{said}");
    let said = answer(folder.path(), &render_sized(&size, "film.mp4", &[]));
    assert!(said.starts_with("exit 0\n"), "{said}");
    assert!(fs::read(folder.path().join("film.mp4")).unwrap() == whole);
    assert_eq!(names(folder.path()), ["film.mp4", "shot.json"]);
}

/// Typing the line of a stopped list of prompts again used to be refused, because its first films exist.
#[cfg(unix)]
#[test]
fn a_list_of_prompts_goes_on_at_the_film_that_was_stopped() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("moves.txt"), "one\tpan left\nfilm\tpan right\n").unwrap();
    let line = ["render", SMALL_SCENE, "--prompts", "moves.txt", "-o", "{}.mp4", "--size", "640x360", "--solve", "off"];
    let film = start(folder.path(), &line, 3);
    assert!(Command::new("kill").args(["-INT", &film.id().to_string()]).status().unwrap().success());
    assert_eq!(film.wait_with_output().unwrap().status.code(), Some(75));
    let first = fs::metadata(folder.path().join("one.mp4")).unwrap().modified().unwrap();
    let said = answer(folder.path(), &line);
    assert!(said.starts_with("exit 0\n") && said.contains("one.mp4: exists already, left as it is"), "{said}");
    assert_eq!(fs::metadata(folder.path().join("one.mp4")).unwrap().modified().unwrap(), first);
    assert_eq!(names(folder.path()), ["film.mp4", "moves.txt", "one.mp4"]);
}

#[test]
fn without_a_job_folder_a_stopped_film_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let whole = undisturbed(folder.path());
    data(folder.path(), &render("film.mp4", &["--no-job"]));
    assert!(fs::read(folder.path().join("film.mp4")).unwrap() == whole, "the same film");
    let output = run(folder.path(), &render("other.mp4", &["--no-job", "--fresh"]));
    assert_eq!(output.status.code(), Some(2));
}

#[cfg(unix)]
#[test]
fn several_programs_render_one_film() {
    let folder = tempfile::tempdir().unwrap();
    let whole = undisturbed(folder.path());
    let mut parts = ["0..16", "8..24"].map(|frames| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_cinesplat"));
        program.args(render("film.mp4", &["--part", "--frames", frames])).current_dir(folder.path());
        program.stderr(Stdio::null()).spawn().unwrap()
    });
    for part in &mut parts {
        assert!(part.wait().unwrap().success());
    }
    let listed = fs::read_to_string(folder.path().join("film.mp4.job/done.log")).unwrap();
    let mut frames: Vec<usize> = listed.lines().map(|line| line.split_once(' ').unwrap().0.parse().unwrap()).collect();
    frames.sort_unstable();
    assert_eq!(frames, (0..24).collect::<Vec<_>>(), "every frame once");
    data(folder.path(), &render("film.mp4", &[]));
    assert!(fs::read(folder.path().join("film.mp4")).unwrap() == whole);
    data(folder.path(), &[&["farm", "--local", "2"], &render("farmed.mp4", &[])[1..]].concat());
    assert!(fs::read(folder.path().join("farmed.mp4")).unwrap() == whole);
    assert_eq!(names(folder.path()), ["farmed.mp4", "film.mp4", "shot.json"]);
}

/// The frames of the longer film used to stay behind the shorter one, as if they belonged to it.
#[test]
fn a_shorter_sequence_leaves_no_pictures_of_the_longer_one() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let sequence = |flags: &[&str]| {
        let line = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "p/%03d.png", "--effects", "off"];
        answer(folder.path(), &[&line[..], flags].concat())
    };
    assert!(sequence(&[]).starts_with("exit 0\n"));
    for name in ["p/7.png", "p/0007.png", "p/007.png.txt", "p/x007.png"] {
        fs::write(folder.path().join(name), "another's").unwrap();
    }
    let part = sequence(&["--frames", "2..4", "--overwrite"]);
    assert!(part.starts_with("exit 0\n") && !part.contains("were removed"), "{part}");
    assert_eq!(names(&folder.path().join("p")).len(), 12, "the pictures around a part stay");
    let shorter = sequence(&["--duration", "0.5", "--overwrite"]);
    assert!(shorter.contains("4 pictures of a longer film were removed"), "{shorter}");
    let left = ["000.png", "0007.png", "001.png", "002.png", "003.png", "007.png.txt", "7.png", "x007.png"];
    assert_eq!(names(&folder.path().join("p")), left);
}

/// A temporary name that was longer than its target's used to fail after rendering.
#[cfg(target_os = "linux")]
#[test]
fn the_longest_names_are_written_and_longer_ones_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let name = |num_bytes: usize| format!("{}.mp4", "a".repeat(num_bytes - 4));
    let line = |name: &str, flag: &str| {
        answer(folder.path(), &["render", SMALL_SCENE, "--shot", "shot.json", "-o", name, flag])
    };
    assert!(line(&name(251), "--overwrite").starts_with("exit 0\n"), "with a job folder of four more letters");
    assert!(line(&name(255), "--no-job").starts_with("exit 0\n"));
    let refused = answer(folder.path(), &["render", "no.ply", "-p", "x", "-o", &name(256), "--no-job"]);
    assert!(refused.starts_with("exit 73\n") && refused.contains("longer than the file system allows"), "{refused}");
    assert!(refused.ends_with("help: choose a shorter name\n"), "{refused}");
}

#[test]
fn a_part_says_the_line_that_makes_the_film() {
    let folder = tempfile::tempdir().unwrap();
    let whole = undisturbed(folder.path());
    for flags in [["--part", "--frames", "20..24"], ["--frames=0..8", "--part=2/3", "--overwrite"]] {
        let said = answer(folder.path(), &render("film.mp4", &flags));
        let line = said.split("this makes the film: ").nth(1).unwrap_or_default().trim();
        assert!(line.contains("film.mp4") && !line.contains("--part") && !line.contains(".."), "{said}");
    }
    let listed = fs::read_to_string(folder.path().join("film.mp4.job/done.log")).unwrap();
    let frames: Vec<&str> = listed.lines().map(|line| line.split_once(' ').unwrap().0).collect();
    assert_eq!(
        frames,
        ["20", "21", "22", "23", "2", "3", "4", "5", "6", "7", "0", "1"],
        "2/3 begins at the second third"
    );
    data(folder.path(), &render("film.mp4", &[]));
    assert!(fs::read(folder.path().join("film.mp4")).unwrap() == whole);
    let wrong = run(folder.path(), &render("film.mp4", &["--part=4/3"]));
    assert_eq!(wrong.status.code(), Some(2));
}
