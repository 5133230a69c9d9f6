use std::fs;

use super::{SMALL_SCENE, answer, data, run, write_shot};

#[test]
fn a_shot_becomes_a_film_with_its_sheet() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let output =
        run(folder.path(), &["render", SMALL_SCENE, "--shot", "shot.json", "-o", "film.mp4", "--sheet", "sheet.png"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{said}");
    assert!(output.stdout.is_empty(), "a film prints nothing on stdout");
    for stage in ["load", "render", "encode", "8 frames", "reproduce with: cinesplat render"] {
        assert!(said.contains(stage), "{stage}: {said}");
    }
    assert!(fs::metadata(folder.path().join("film.mp4")).unwrap().len() > 500);
    assert!(folder.path().join("sheet.png").exists());
    let names = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(names, 3, "only shot, film and sheet remain");
}

#[test]
fn a_range_of_frames_equals_those_of_the_whole_film() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let render = |pattern: &str, frames: &str| {
        data(folder.path(), &["render", SMALL_SCENE, "--shot", "shot.json", "-o", pattern, "--frames", frames]);
    };
    render("all/%02d.png", "..");
    render("part/%02d.png", "3..5");
    let read = |path: &str| fs::read(folder.path().join(path)).unwrap();
    assert_eq!(fs::read_dir(folder.path().join("all")).unwrap().count(), 8);
    assert_eq!(fs::read_dir(folder.path().join("part")).unwrap().count(), 2);
    for frame in ["03", "04"] {
        assert!(read(&format!("all/{frame}.png")) == read(&format!("part/{frame}.png")), "frame {frame}");
    }
    assert!(read("all/00.png") != read("all/07.png"), "the camera moves");
}

#[test]
fn a_film_has_the_same_bytes_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let film = |name: &str, threads: &str| {
        data(folder.path(), &["render", SMALL_SCENE, "--shot", "shot.json", "-o", name, "--threads", threads]);
        fs::read(folder.path().join(name)).unwrap()
    };
    assert!(film("one.mp4", "1") == film("three.mp4", "3"));
}

#[test]
fn a_sentence_becomes_a_shot_that_renders_again() {
    let folder = tempfile::tempdir().unwrap();
    let objects = data(folder.path(), &["objects", SMALL_SCENE, "--json"]);
    let objects: serde_json::Value = serde_json::from_str(&objects).unwrap();
    let prompt = format!("push in on <obj-{}> with film grain and background music", objects[0]["id"]);
    let plan =
        ["plan", SMALL_SCENE, "-p", &prompt, "-o", "shot.json", "--solve", "fast", "--size", "64x36", "--explain"];
    let output = run(folder.path(), &plan);
    let (explained, said) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(output.status.success(), "{said}");
    assert!(explained.contains("push-in") && explained.contains("music requested by"), "{explained}");
    assert!(
        said.contains(
            "effect: music requested by 'background music': not an effect of the camera, rendered without it"
        ),
        "{said}"
    );
    let text = fs::read_to_string(folder.path().join("shot.json")).unwrap();
    let shot: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(shot["scene"]["path"], SMALL_SCENE);
    assert!(
        shot["report"].as_array().unwrap().iter().any(|line| line["met"] == false),
        "the report says that the music is missing"
    );
    let again = ["plan", SMALL_SCENE, "-p", &prompt, "--json", "--solve", "fast", "--size", "64x36"];
    assert_eq!(data(folder.path(), &again), text, "the same sentence gives the same shot");
    let said =
        answer(folder.path(), &["render", SMALL_SCENE, "--shot", "shot.json", "-o", "f.mp4", "--frames", "0..2"]);
    assert!(said.contains("film grain: on 2 of 2 frames"), "{said}");
}

#[test]
fn takes_are_numbered_shots_that_differ_with_one_sheet_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let objects: serde_json::Value =
        serde_json::from_str(&data(folder.path(), &["objects", SMALL_SCENE, "--json"])).unwrap();
    let prompt = format!("a static shot of <obj-{}>", objects[0]["id"]);
    let plan = ["plan", SMALL_SCENE, "-p", &prompt, "-o", "shot.json", "--solve", "fast", "--takes", "2", "--explain"];
    let explained = data(folder.path(), &plan);
    assert!(explained.contains("films that clearly differ") && explained.contains("runner-up"), "{explained}");
    let shot = |number: u32| -> serde_json::Value {
        serde_json::from_str(&fs::read_to_string(folder.path().join(format!("shot.{number}.json"))).unwrap()).unwrap()
    };
    let place = |shot: &serde_json::Value| shot["keyframes"][0]["position"].clone();
    assert_ne!(place(&shot(1)), place(&shot(2)));
    for shot in [shot(1), shot(2)] {
        let lines = shot["report"].as_array().unwrap().clone();
        assert!(lines.iter().any(|line| line["clause"] == "picture: sharpness"), "{lines:?}");
    }
    let sheet = image::open(folder.path().join("shot.takes.png")).unwrap();
    assert_eq!((sheet.width(), sheet.height()), (6 + 2 * 326, 28 + 5 * 186));
    let refused = answer(folder.path(), &plan);
    assert!(refused.starts_with("exit 73") && refused.contains("shot.takes.png"), "{refused}");
    let one = data(folder.path(), &["plan", SMALL_SCENE, "-p", &prompt, "--json", "--solve", "fast"]);
    let one: serde_json::Value = serde_json::from_str(&one).unwrap();
    assert!(one["keyframes"].is_array());
    let several = answer(folder.path(), &["plan", SMALL_SCENE, "-p", &prompt, "-o", "-", "--takes", "2"]);
    assert!(several.starts_with("exit 2") && several.contains("several shots and one stdout"), "{several}");
}

#[test]
fn the_reproducing_command_names_the_quality_that_was_chosen() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let shot = folder.path().join("the cat's shot.json");
    fs::rename(folder.path().join("shot.json"), shot).unwrap();
    let render = ["render", SMALL_SCENE, "--shot", "the cat's shot.json", "--budget=100s", "-o", "f.mp4"];
    let said = answer(folder.path(), &render);
    let command = said.lines().find_map(|line| line.strip_prefix("reproduce with: ")).unwrap();
    let start = format!(r"cinesplat render {SMALL_SCENE} --shot 'the cat'\''s shot.json' -o f.mp4 ");
    assert!(command.starts_with(&start), "{command}");
    assert!(command.contains("--quality ") && !command.contains("--budget"), "{command}");
    assert!(command.contains("--size 64x36") && command.contains("--seed 0"), "{command}");
}

/// Both used to be made without a word.
#[test]
fn a_black_film_and_keys_after_its_end_are_warnings() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let text = fs::read_to_string(folder.path().join("shot.json")).unwrap();
    fs::write(folder.path().join("shot.json"), text.replace(r#""duration_secs":1"#, r#""duration_secs":0.5"#)).unwrap();
    let render = ["render", SMALL_SCENE, "--shot", "shot.json", "--overwrite", "-o", "f.mp4"];
    let late = "warning: 1 of 2 keyframes lie after the end of the film and are not shown: the last is at 1 s";
    let black = "warning: no sampled frame shows a Gaussian";
    let said = answer(folder.path(), &render);
    assert!(said.contains(late) && !said.contains(black), "{said}");
    let said = answer(folder.path(), &[&render[..], &["--near", "1000"]].concat());
    assert!(said.starts_with("exit 0\n") && said.contains(black) && said.contains("--near (now 1000)"), "{said}");
    let said = answer(folder.path(), &["export", "shot.json", "-o", "s.tum"]);
    assert!(said.contains(late), "{said}");
}

#[test]
fn cases_of_generated_scenes_and_of_a_data_folder_become_shots() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("data")).unwrap();
    let objects = r#"{"format":"cinesplat.objects","version":1,
        "objects":[{"id":4,"label":"dial","center":[0,0.9,0],"half_extents":[0.1,0.1,0.1]}]}"#;
    fs::write(folder.path().join("data/dial.json"), objects).unwrap();
    let case = |id: &str, objects: &str, prompt: &str| {
        format!(
            "{{\"id\":\"{id}\",\"scene\":\"{SMALL_SCENE}\",{objects}\"prompt\":\"{prompt}\",\"expect\":\"a film\"}}\n"
        )
    };
    let cases = case("a", "", "push in on the globe") + &case("b", "\"objects\":\"dial.json\",", "push in on the dial");
    fs::write(folder.path().join("cases.jsonl"), cases).unwrap();
    let films =
        ["bench", "operator", "films", "--cases", "cases.jsonl", "--data", "data", "--solve", "off", "-o", "out"];
    data(folder.path(), &films);
    for (id, subject) in [("a", 10), ("b", 4)] {
        let shot = fs::read(folder.path().join(format!("out/{id}.shot.json"))).unwrap();
        let shot: serde_json::Value = serde_json::from_slice(&shot).unwrap();
        assert_eq!(shot["keyframes"][0]["intent"]["subjects"][0], subject, "{id}");
    }
}

#[test]
fn the_projects_film_prompts_have_unique_ids_and_say_what_to_expect() {
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/prompts/films.jsonl")).unwrap();
    let cases: Vec<serde_json::Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let ids: std::collections::BTreeSet<&str> = cases.iter().map(|case| case["id"].as_str().unwrap()).collect();
    assert_eq!((cases.len(), ids.len()), (60, 60));
    for case in &cases {
        assert!(["scene", "prompt", "expect"].iter().all(|key| !case[key].as_str().unwrap().is_empty()), "{case}");
        assert!(case["scene"].as_str().unwrap().starts_with("synth:") != case["objects"].is_string(), "{case}");
    }
}

/// The shot that `--save-shot` writes had the effects of `standard`, whatever quality the requirements chose.
#[test]
fn a_saved_shot_has_the_effects_of_another_quality_than_its_film() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let render = [
        "render",
        SMALL_SCENE,
        "--shot",
        "shot.json",
        "--budget=100s",
        "--effects",
        "motion-blur",
        "--save-shot",
        "saved.json",
        "-o",
        "f.mp4",
    ];
    let said = answer(folder.path(), &render);
    let quality = said.split("--quality ").nth(1).and_then(|rest| rest.split_whitespace().next()).unwrap();
    let allowed = match quality {
        "draft" => 1.0,
        "standard" => 0.5,
        "final" => 0.25,
        "reference" => 0.125,
        other => panic!("{other}: {said}"),
    };
    let saved: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("saved.json")).unwrap()).unwrap();
    assert_eq!(saved["effects"][0]["allowed"], allowed, "{quality}");
}

/// A 360 film, and one per eye, say so to players; a transparent film is `ProRes` 4444 with its alpha.
#[test]
fn players_know_what_kind_of_film_it_is() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let text = fs::read_to_string(folder.path().join("shot.json")).unwrap();
    let background = r#""effects":[{"kind":"background","alpha":1,"because":"the test"}],"keyframes""#;
    fs::write(folder.path().join("alpha.json"), text.replace("\"keyframes\"", background)).unwrap();
    let probed = |shot: &str, effects: &str, name: &str| {
        let film = ["render", SMALL_SCENE, "--shot", shot, "--effects", effects, "-o", name, "--frames", "0..3"];
        let said = answer(folder.path(), &film);
        assert!(said.starts_with("exit 0"), "{said}");
        let entries = "stream=codec_name,profile,pix_fmt:stream_side_data:stream_tags=stereo_mode";
        let mut ffprobe = std::process::Command::new("ffprobe");
        ffprobe.args(["-v", "error", "-of", "default=nw=1", "-show_entries", entries]);
        let output = ffprobe.arg(folder.path().join(name)).output().ok()?;
        Some(String::from_utf8(output.stdout).unwrap())
    };
    let Some(alpha) = probed("alpha.json", "auto", "alpha.mov") else {
        crate::support::report_skip("ffprobe");
        return;
    };
    // FFmpeg decodes ProRes 4444 to 12 bits.
    assert!(alpha.contains("codec_name=prores\nprofile=4444\n") && alpha.contains("pix_fmt=yuva444p1"), "{alpha}");
    let round = probed("shot.json", "panorama", "round.mp4").unwrap();
    assert!(round.contains("projection=equirectangular"), "{round}");
    for name in ["eyes.mp4", "eyes.mov", "eyes.mkv", "eyes.webm"] {
        let eyes = probed("shot.json", "stereo", name).unwrap();
        assert!(eyes.contains("type=side by side") || eyes.contains("stereo_mode=left_right"), "{name}: {eyes}");
    }
}

/// Such films were written without a word, and opened as flat ones.
#[test]
fn a_360_video_that_no_player_recognizes_is_made_without_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let film = |effects: &str, name: &str| {
        let film = ["render", SMALL_SCENE, "--shot", "shot.json", "--effects", effects, "-o", name, "--frames", "0..2"];
        let said = answer(folder.path(), &film);
        assert!(said.starts_with("exit 0"), "{said}");
        said
    };
    for name in ["a.mkv", "a.webm"] {
        let extension = name.trim_start_matches('a');
        let warning = format!("warning: players do not recognize a 360 video in a {extension}: write a .mp4 or a .mov");
        let said = film("panorama", name);
        assert!(said.contains(&warning), "{name}: {said}");
    }
    for (effects, name) in [("panorama", "a.mp4"), ("panorama", "a.mov"), ("panorama", "%02d.png"), ("stereo", "b.mkv")]
    {
        assert!(!film(effects, name).contains("do not recognize"), "{name}");
    }
}

/// What the error said was said again by its help.
#[test]
fn the_help_of_a_distortion_that_folds_the_picture_repeats_its_error() {
    let folder = tempfile::tempdir().unwrap();
    write_shot(folder.path());
    let text = fs::read_to_string(folder.path().join("shot.json")).unwrap();
    let effects = r#""effects":[{"kind":"lens-distortion","k1":-0.9,"because":"the test"}],"keyframes""#;
    fs::write(folder.path().join("shot.json"), text.replace("\"keyframes\"", effects)).unwrap();
    let said = answer(folder.path(), &["render", SMALL_SCENE, "--shot", "shot.json", "-o", "f.mp4"]);
    let error: Vec<&str> = said.lines().filter(|line| line.starts_with("error") || line.starts_with("help")).collect();
    insta::assert_snapshot!(error.join("\n"), @r"
    error[RENDER-FOLD]: the distortion of the lens folds the picture within 37 px of its middle, expected no fold inside the frame
    help: bring the k1, k2, k3, p1 and p2 of lens-distortion nearer to 0, or narrow the field of view
    ");
}

/// From a thing near the edge of a table the way back may go over the table: there is a window behind it.
#[test]
fn a_crane_from_a_thing_to_the_table_that_bears_it_stays_in_the_room() {
    let folder = tempfile::tempdir().unwrap();
    let prompt = "begin with a tight shot of the teal teapot, then crane up and back to reveal the whole table";
    let output = run(folder.path(), &["plan", "synth:tabletop:3:0.3", "-p", prompt, "-o", "shot.json", "--explain"]);
    let said = String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{said}");
    assert!(said.contains("crane-up") && !said.contains("captured region"), "{said}");
}
