use std::fs;

use super::{SMALL_SCENE, answer, write_shot};

#[test]
fn a_missing_scene() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["info", "no/room.spz"]), @r"
    exit 66
    error[SCENE-NOT-FOUND]: no/room.spz: no such file or folder
    help: check the path; an unbundled SOG is named by its folder or its meta.json
    ");
}

#[test]
fn a_file_that_is_not_a_scene() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("room.ply"), "not a ply\n").unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["info", "room.ply"]), @r"
    exit 65
    error[SCENE-FORMAT]: room.ply: begins with 6e 6f 74 20 61 20 70 6c, expected .ply, .splat, .spz, .sog, .ksplat, .glb or .pcd
    help: export the scene again as one of these; the content decides, not the extension
    ");
    fs::write(folder.path().join("cut.ply"), "ply\nformat binary_little_endian 1.0\nelement vertex 9\n").unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["info", "cut.ply"]), @r"
    exit 65
    error[PLY-HEADER]: cut.ply: header line 3: the file ends at byte 53 without end_header
    help: a scene needs x y z, scale_*, rot_*, opacity and f_dc_* (or red green blue); a plain point cloud has no Gaussians
    ");
}

#[test]
fn an_unknown_generated_scene() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["info", "synth:castle:1"]), @r"
    exit 66
    error[SCENE-SYNTH]: synth:castle:1: unknown generated scene, expected synth:demo, synth:room:SEED or synth:tabletop:SEED
    help: name one such as synth:room:7, or write ./ before the name of a file
    ");
}

#[test]
fn invalid_arguments() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["inof"]), @r"
    exit 2
    error[USAGE]: unrecognized subcommand 'inof'
    help: a similar subcommand exists: 'info'; Usage: cinesplat [OPTIONS] <COMMAND>; see --help
    ");
    insta::assert_snapshot!(answer(folder.path(), &["info"]), @r"
    exit 2
    error[USAGE]: the following required arguments were not provided: <SCENE>
    help: Usage: cinesplat info <SCENE>; see --help
    ");
    insta::assert_snapshot!(answer(folder.path(), &["info", "a.ply", "--jsno"]), @r"
    exit 2
    error[USAGE]: unexpected argument '--jsno' found
    help: a similar argument exists: '--json'; Usage: cinesplat info --json <SCENE>; see --help
    ");
    insta::assert_snapshot!(answer(folder.path(), &["render", "a.ply", "-p", "x", "--shot", "s.json", "-o", "a.mp4"]), @r"
    exit 2
    error[USAGE]: the argument '--prompt <PROMPT>' cannot be used with '--shot <SHOT.JSON>'
    help: Usage: cinesplat render --output <OUT> <--prompt <PROMPT>|--prompts <FILE>|--shot <SHOT.JSON>> <SCENE>; see --help
    ");
    insta::assert_snapshot!(answer(folder.path(), &["render", "a.ply", "-p", "x", "-o", "a.mp4", "--size", "0x9"]), @r"
    exit 2
    error[USAGE]: invalid value '0x9' for '--size <WxH>': expected WIDTHxHEIGHT in pixels such as 1280x720, each 1 to 16384
    help: see --help
    ");
    insta::assert_snapshot!(answer(folder.path(), &["plan", "a.ply", "-p", "x", "-o", "s.json", "--effects", "blur"]), @r#"
    exit 2
    error[USAGE]: invalid value 'blur' for '--effects <LIST>': no effect is named "blur", expected auto, off, or a list of: film-grain bloom exposure stereo lens-flare anamorphic tilt-shift vignette chromatic-aberration lens-distortion fisheye panorama rolling-shutter motion-blur rack-focus depth-of-field fog background handheld
    help: see --help
    "#);
}

#[test]
fn outputs_are_checked_before_the_scene_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |arguments: &[&str]| answer(folder.path(), arguments);
    fs::write(folder.path().join("film.mp4"), "mine").unwrap();
    // The scene does not exist, but the outputs are checked before it is opened.
    insta::assert_snapshot!(refused(&["render", "no.ply", "-p", "x", "-o", "film.mp4"]), @r"
    exit 73
    error[OUTPUT-EXISTS]: film.mp4: exists already, expected a new name
    help: choose another name, or pass --overwrite
    ");
    insta::assert_snapshot!(refused(&["render", "no.ply", "-p", "x", "-o", "no/film.mp4"]), @r"
    exit 73
    error[OUTPUT-CREATE]: no/film.mp4: cannot create: its folder does not exist
    help: create the folder, or choose one that you may write to
    ");
    insta::assert_snapshot!(refused(&["render", "no.ply", "-p", "x", "-o", "film.gif"]), @r#"
    exit 2
    error[VIDEO-FORMAT]: film.gif: the name ends in "gif", expected .mp4 .mkv .webm .mov, or a pattern such as frames/%05d.png
    help: name the output film.mp4, or frames/%05d.png for one picture per frame
    "#);
    insta::assert_snapshot!(refused(&["render", "no.ply", "-p", "x", "-o", "frames/f.png"]), @r"
    exit 2
    error[VIDEO-PATTERN]: frames/f.png: none or several frame numbers, expected exactly one %d
    help: write one %05d in the file name, such as frames/%05d.png; %% is a percent sign
    ");
    insta::assert_snapshot!(refused(&["plan", "no.ply", "-p", "x", "-o", "film.mp4"]), @r"
    exit 73
    error[OUTPUT-EXISTS]: film.mp4: exists already, expected a new name
    help: choose another name, or pass --overwrite
    ");
    insta::assert_snapshot!(refused(&["import", "no.tum", "-o", "."]), @r"
    exit 73
    error[OUTPUT-CREATE]: .: cannot create: it is a folder, expected a file name
    help: name a file in it
    ");
    assert_eq!(fs::read(folder.path().join("film.mp4")).unwrap(), b"mine");
}

/// It used to be called a folder that does not exist.
#[cfg(target_os = "linux")]
#[test]
fn links_that_lead_to_each_other_are_no_missing_folder() {
    let folder = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink("b", folder.path().join("a")).unwrap();
    std::os::unix::fs::symlink("a", folder.path().join("b")).unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["render", "no.ply", "-p", "x", "-o", "a/film.mp4"]), @r"
    exit 73
    error[OUTPUT-CREATE]: a/film.mp4: cannot create: Too many levels of symbolic links (os error 40)
    help: mend the links of that folder, or choose another one
    ");
}

#[test]
fn models_and_shards_of_other_settings_are_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let answer = |arguments: &[&str]| answer(folder.path(), arguments);
    fs::create_dir(folder.path().join("model")).unwrap();
    fs::write(folder.path().join("model/director.json"), "mine").unwrap();
    insta::assert_snapshot!(answer(&["train", "-o", "model", "--steps", "1"]), @r"
    exit 73
    error[OUTPUT-EXISTS]: model/director.json: exists already, expected a new name
    help: choose another name, or pass --overwrite
    ");
    fs::create_dir(folder.path().join("shots")).unwrap();
    let header = r#"{"format":"cinesplat.shots","version":1,"seed":3,"num_scenes":8}"#;
    fs::write(folder.path().join("shots/shots-00000.jsonl"), header).unwrap();
    insta::assert_snapshot!(answer(&["dataset", "-o", "shots", "--scenes", "9"]), @r"
    exit 65
    error[DATASET-SETTINGS]: shots/shots-00000.jsonl: made with seed 3, expected seed 8
    help: write into another folder, or give the settings that it was made with
    ");
    insta::assert_snapshot!(answer(&["dataset", "-o", "shots", "--seed", "3", "--scenes", "5"]), @r"
    exit 65
    error[DATASET-SETTINGS]: shots/shots-00000.jsonl: made with number of scenes 8, expected number of scenes 5
    help: write into another folder, or give the settings that it was made with
    ");
    let kept = answer(&["dataset", "-o", "shots", "--seed", "3", "--scenes", "8"]);
    assert!(kept.starts_with("exit 0\n") && kept.contains("1 shards kept"), "{kept}");
}

#[test]
fn a_prompt_that_names_an_unknown_object() {
    let folder = tempfile::tempdir().unwrap();
    let object =
        |id: u8, label: &str| format!(r#"{{"id":{id},"label":"{label}","center":[0,{id},0],"half_extents":[1,1,1]}}"#);
    let objects = [object(1, "table lamp"), object(2, "sofa"), object(3, "green vase")].join(",");
    let text = format!(r#"{{"format":"cinesplat.objects","version":1,"objects":[{objects}]}}"#);
    fs::write(folder.path().join("o.json"), text).unwrap();
    let plan = |prompt: &str| {
        answer(folder.path(), &["plan", SMALL_SCENE, "-p", prompt, "--objects", "o.json", "-o", "shot.json"])
    };
    insta::assert_snapshot!(plan("push in on <obj-99>"), @r#"
    exit 65
    up: 0.000 1.000 0.000 (the scene file: generated with y up)
    error[OBJ-UNKNOWN]: the prompt names "<obj-99>", which is no object of this scene, expected one of its objects
    help: nearest names: <obj-3> green vase, <obj-2> sofa, <obj-1> table lamp
    "#);
    insta::assert_snapshot!(plan("orbit the elephant"), @r#"
    exit 65
    up: 0.000 1.000 0.000 (the scene file: generated with y up)
    error[OBJ-UNKNOWN]: the prompt names "elephant", which is no object of this scene, expected one of its objects
    help: nearest names: <obj-1> table lamp, <obj-3> green vase, <obj-2> sofa
    "#);
    insta::assert_snapshot!(plan("  "), @r#"
    exit 65
    up: 0.000 1.000 0.000 (the scene file: generated with y up)
    error[PROMPT-EMPTY]: prompt without words, expected a sentence such as "push in on <obj-3>"
    help: say what the camera does, for example -p "orbit <obj-3> to the left"
    "#);
    assert!(!folder.path().join("shot.json").exists());
}

#[test]
fn a_malformed_shot() {
    let folder = tempfile::tempdir().unwrap();
    let render = |text: &str| {
        fs::write(folder.path().join("shot.json"), text).unwrap();
        answer(folder.path(), &["export", "shot.json", "--to", "tum", "-o", "out.tum"])
    };
    insta::assert_snapshot!(render("{"), @r"
    exit 65
    error[EXCHANGE-JSON]: shot.json: not JSON: EOF while parsing an object at line 1 column 1
    help: check the file with a JSON validator; it may be cut off
    ");
    insta::assert_snapshot!(render(r#"{"format":"cinesplat.shot","version":7}"#), @r"
    exit 65
    error[EXCHANGE-VERSION]: shot.json: cinesplat.shot version 7, expected 1
    help: write the file with a version listed above
    ");
    let text = r#"{"format":"cinesplat.shot","version":1,"keyframes":[]}"#;
    insta::assert_snapshot!(render(text), @r"
    exit 65
    error[EXCHANGE-FIELD]: shot.json: width: found nothing, expected a number of pixels
    help: set width to a number of pixels
    ");
    assert!(!folder.path().join("out.tum").exists());
}

#[test]
fn frames_beyond_the_film() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let render = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "f.mp4", "--frames", "4..9"];
    insta::assert_snapshot!(answer(folder.path(), &render), @r"
    exit 2
    up: 0.000 1.000 0.000 (the shot)
    error[SHOT-FRAMES]: frames 4..9 of a film of 8, expected a range within 0..8
    help: give --frames A..B with B one after the last frame
    ");
}

#[test]
fn every_kind_of_failure_has_its_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    fs::write(folder.path().join("no-objects.json"), r#"{"format":"other"}"#).unwrap();
    let plan = ["plan", SMALL_SCENE, "-p", "push in on <obj-1>", "--json"];
    let render = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "f.mp4"];
    let eval = ["eval", "shot.json", "shot.json"];
    let failures: [(&[&str], &[&str], i32, &str); 12] = [
        (&render, &["--crf", "99"], 2, "VIDEO-SETTING"),
        (&eval, &["--rpe", "--delta", "0"], 2, "EVAL-SETTING"),
        (&eval, &["--align-poses", "0"], 2, "EVAL-SETTING"),
        (&plan, &["--objects", "no-objects.json"], 65, "OBJ-VERSION"),
        (&eval, &["--rpe", "--delta", "100"], 65, "EVAL-NO-PAIRS"),
        (&plan, &["--objects", "none.json"], 66, "FILE-READ"),
        (&plan, &["--model", "none"], 66, "MODEL-READ"),
        (&["import", "none.tum", "-o", "s.json"], &[], 66, "FILE-READ"),
        (&["export", "none.json", "-o", "s.tum"], &[], 66, "FILE-READ"),
        (&render, &["--budget", "1ms"], 71, "COST-BUDGET"),
        (&render, &["--save-shot", "shot.json"], 73, "OUTPUT-EXISTS"),
        (&["export", "shot.json", "-o", "no/s.tum"], &[], 73, "OUTPUT-CREATE"),
    ];
    for (command, flags, exit_code, code) in failures {
        let said = answer(folder.path(), &[command, flags].concat());
        let expected = (format!("exit {exit_code}\n"), format!("error[{code}]: "));
        assert!(said.starts_with(&expected.0) && said.contains(&expected.1), "{command:?} {flags:?}: {said}");
        assert!(said.lines().last().unwrap().starts_with("help: "), "{said}");
    }
}

#[test]
fn a_level_of_detail_that_is_not_a_number_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["dataset", "-o", "shots", "--detail", "nan"]), @r"
    exit 2
    error[USAGE]: invalid value 'nan' for '--detail <FRAC>': expected 0.01 to 4
    help: see --help
    ");
    assert!(!folder.path().join("shots").exists());
}

/// A FIFO without a writer used to hang every command that reads a file beside the scene.
#[cfg(unix)]
#[test]
fn pipes_devices_and_folders_in_place_of_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let made = std::process::Command::new("mkfifo").arg(folder.path().join("fifo")).status().unwrap();
    assert!(made.success());
    fs::create_dir(folder.path().join("dir")).unwrap();
    let commands: [&[&str]; 6] = [
        &["plan", SMALL_SCENE, "-p", "pan left", "--json", "--objects", "FILE"],
        &["objects", SMALL_SCENE, "--labels", "FILE"],
        &["still", SMALL_SCENE, "-o", "stills", "--cameras", "FILE"],
        &["render", SMALL_SCENE, "-o", "f.mp4", "--shot", "FILE"],
        &["eval", "shot.json", "FILE"],
        &["export", "-o", "s.tum", "FILE"],
    ];
    for command in commands {
        for (file, kind) in [("fifo", "a pipe"), ("/dev/zero", "a device"), ("dir", "a folder")] {
            if command[0] == "eval" && file == "dir" {
                // A folder may hold a capture of another program.
                continue;
            }
            let arguments: Vec<&str> = command.iter().map(|&word| if word == "FILE" { file } else { word }).collect();
            let said = answer(folder.path(), &arguments);
            let expected = format!("error[FILE-KIND]: {file}: it is {kind}, expected a regular file\nhelp: ");
            assert!(said.starts_with("exit 65\n") && said.contains(&expected), "{command:?} {file}: {said}");
        }
    }
}

#[test]
fn two_outputs_of_one_name_are_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["render", "no.ply", "-p", "x", "-o", "f.mp4", "--sheet", "./f.mp4"]), @r"
    exit 2
    error[USAGE]: ./f.mp4: --output and --sheet both write this file, expected two files
    help: give each output a name of its own
    ");
    let render = ["render", "no.ply", "-p", "x", "-o", "f.mp4", "--save-shot", "a.png", "--sheet", "a.png"];
    assert!(answer(folder.path(), &render).contains("a.png: --save-shot and --sheet both write this file"));
}

/// Escape sequences of labels and prompts used to reach the terminal.
#[test]
fn control_characters_of_files_are_replaced_in_texts() {
    let folder = tempfile::tempdir().unwrap();
    let label = r"red\u001b[31m\u009b2J\u0007\nlamp";
    let object = format!(r#"{{"id":1,"label":"{label}","center":[0,1,0],"half_extents":[1,1,1]}}"#);
    let text = format!(r#"{{"format":"cinesplat.objects","version":1,"objects":[{object}]}}"#);
    fs::write(folder.path().join("o.json"), text).unwrap();
    let objects = answer(folder.path(), &["objects", SMALL_SCENE, "--objects", "o.json"]);
    assert!(objects.contains("red\u{FFFD}[31m\u{FFFD}2J\u{FFFD}\u{FFFD}lamp"), "{objects:?}");
    let plan = ["plan", SMALL_SCENE, "-p", "push in on <obj-1>", "--objects", "o.json", "--explain", "--solve", "off"];
    write_shot(folder.path());
    let shot = fs::read_to_string(folder.path().join("shot.json")).unwrap();
    let effect = r#""effects":[{"kind":"\u001b]0;title\u0007","because":"\u001b[2J"}],"keyframes""#;
    fs::write(folder.path().join("shot.json"), shot.replace(r#""keyframes""#, effect)).unwrap();
    let render = ["render", SMALL_SCENE, "--shot", "shot.json", "-o", "f.mp4", "--frames", "0..1"];
    for said in [objects, answer(folder.path(), &plan), answer(folder.path(), &render)] {
        assert!(said.starts_with("exit 0\n"), "{said:?}");
        assert!(!said.contains(|c: char| c.is_control() && c != '\n'), "{said:?}");
    }
}
