//! `describe`, `eval`, `import` and `export` on files of camera paths.

use cinesplat::export::shot_json;
use cinesplat::geometry::Pose;
use cinesplat::trajectory::{Easing, KeyOptics, Keyframe};
use glam::{DQuat, DVec3};
use serde_json::Value;

use super::{SMALL_SCENE, answer, data, run};
use crate::support::shot_over;

/// Writes moves.shot.json: a push toward -z, a pause, and a pan to the right by 40 degrees.
fn write_moves(folder: &std::path::Path) {
    let key = |time_secs: f64, z: f64, right_deg: f64| Keyframe {
        time_secs,
        pose: Pose::new(
            DVec3::new(0.0, 1.2, z),
            DQuat::from_rotation_y(-right_deg.to_radians()) * DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0),
        ),
        fov_y_rad: 0.8,
        focus_distance: None,
        optics: KeyOptics::default(),
        easing: Easing::Smooth,
        cut: false,
        intent: None,
    };
    let keys = vec![key(0.0, 3.0, 0.0), key(2.0, 1.0, 0.0), key(4.0, 1.0, 0.0), key(6.0, 1.0, 40.0)];
    std::fs::write(folder.join("moves.shot.json"), shot_json::write(&shot_over(keys))).unwrap();
}

/// The moves in the JSON of `describe` or `read`, under `list`.
fn moves(json: &str, list: &str) -> Vec<String> {
    let value: Value = serde_json::from_str(json).unwrap();
    value[list].as_array().unwrap().iter().map(|item| item["move"].as_str().unwrap_or("-").to_owned()).collect()
}

#[test]
fn a_path_is_described_in_words_that_read_understands() {
    let folder = tempfile::tempdir().unwrap();
    write_moves(folder.path());
    let json = data(folder.path(), &["describe", "moves.shot.json", "--json"]);
    assert_eq!(moves(&json, "moves"), ["push-in", "static", "pan-right"]);
    let value: Value = serde_json::from_str(&json).unwrap();
    let sentence = value["sentence"].as_str().unwrap();
    assert_eq!(
        moves(&data(folder.path(), &["read", "-p", sentence, "--json"]), "steps"),
        ["push-in", "static", "pan-right"]
    );
    // The same path from a file of another program, which names no cuts and no lens.
    data(folder.path(), &["export", "moves.shot.json", "--to", "tum", "-o", "moves.tum"]);
    let from_tum = data(folder.path(), &["describe", "moves.tum", "--up", "0,1,0", "--json"]);
    assert_eq!(moves(&from_tum, "moves"), ["push-in", "static", "pan-right"]);
}

/// Path of a golden trajectory.
fn golden(name: &str) -> String {
    format!("{}/tests/evaluation/golden/{name}.tum", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn several_estimates_make_one_table_and_one_figure() {
    let folder = tempfile::tempdir().unwrap();
    let [reference, near, far] = ["repeated_reference", "repeated_reference", "repeated_estimate"].map(golden);
    let three = ["eval", &reference, &near, &far, "--max-diff", "0.03", "--align", "sim3"];
    let table = data(folder.path(), &[&three[..], &["--table", "markdown", "--plot-errors", "e.pdf"]].concat());
    assert!(
        table.contains("| repeated_reference.tum | 160 | **") && table.contains("| repeated_estimate.tum | 41 |"),
        "{table}"
    );
    assert!(std::fs::read(folder.path().join("e.pdf")).unwrap().starts_with(b"%PDF-1.4"));
    let csv = data(folder.path(), &[&three[..], &["--csv"]].concat());
    assert_eq!(csv.lines().count(), 3);
    let merged = data(folder.path(), &[&three[..], &["--merge", "--json"]].concat());
    let merged: Value = serde_json::from_str(&merged).unwrap();
    assert!(merged["pairs"].as_u64().unwrap() > 100 && merged["rmse"].is_f64());
    let refused = answer(folder.path(), &[&three[..], &["--plot-errors", "e.gif"]].concat());
    assert!(refused.starts_with("exit 2\n") && refused.contains("expected .svg, .png or .pdf"), "{refused}");
}

#[test]
fn a_note_says_that_evo_trims_the_reference_alone() {
    let folder = tempfile::tempdir().unwrap();
    let [reference, estimate] = ["repeated_reference", "repeated_estimate"].map(golden);
    let trimmed =
        ["eval", &reference, &estimate, "--align", "se3", "--max-diff", "0.1", "--start", "1", "--end", "2.5"];
    let own = run(folder.path(), &trimmed);
    assert!(String::from_utf8_lossy(&own.stderr).contains("evo trims the reference alone"), "{own:?}");
    let evo = run(folder.path(), &[&trimmed[..], &["--like-evo"]].concat());
    assert!(!String::from_utf8_lossy(&evo.stderr).contains("evo trims"), "{evo:?}");
    // By `evo_ape tum .. --align --t_start 1 --t_end 2.5 --t_max_diff 0.1`, evo 1.38.1.
    assert!(String::from_utf8_lossy(&evo.stdout).contains("rmse    0.072690852"), "{evo:?}");
}

#[test]
fn a_span_of_time_of_a_path_without_times_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.kitti"), "1 0 0 0 0 1 0 0 0 0 1 0\n".repeat(3)).unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["eval", "a.kitti", "a.kitti", "--start", "1"]), @r"
    exit 65
    error[EVAL-NO-TIMES]: a.kitti: a path has no times, expected times for a span of time
    help: leave out a span of time, or give files with times
    ");
}

#[test]
fn a_format_that_is_only_read_is_not_written() {
    let folder = tempfile::tempdir().unwrap();
    write_moves(folder.path());
    let refused = answer(folder.path(), &["export", "moves.shot.json", "--to", "re10k", "-o", "a.txt"]);
    assert!(
        refused.starts_with("exit 2\nerror[USAGE]: re10k is read and not written\nhelp: choose one of tum"),
        "{refused}"
    );
    data(folder.path(), &["export", "moves.shot.json", "-o", "cameras.json", "--fps", "2"]);
    assert!(run(folder.path(), &["import", "cameras.json", "-o", "back.shot.json"]).status.success());
}

#[test]
fn an_eval_of_which_every_estimate_failed_is_a_failure_with_each_reason() {
    let folder = tempfile::tempdir().unwrap();
    let line = |time: f64, x: f64| format!("{time} {x} 0 0 0 0 0 1\n");
    let path = |start: f64| (0..5).map(|k| line(start + f64::from(k), f64::from(k * k))).collect::<String>();
    for (name, start) in [("ref.tum", 0.0), ("a.tum", 100.0), ("b.tum", 200.0), ("good.tum", 0.0)] {
        std::fs::write(folder.path().join(name), path(start)).unwrap();
    }
    let failed = answer(folder.path(), &["eval", "ref.tum", "a.tum", "b.tum", "--plot", "p.svg"]);
    assert!(failed.starts_with("exit 65\n"), "{failed}");
    let last = failed.lines().find(|line| line.starts_with("error[EVAL-NONE]")).unwrap();
    assert!(last.contains("a.tum: ") && last.contains("b.tum: "), "{last}");
    assert!(!folder.path().join("p.svg").exists());
    // One that succeeded is a success, and the other one is named.
    let mixed = answer(folder.path(), &["eval", "ref.tum", "good.tum", "b.tum", "--plot", "p.svg"]);
    assert!(mixed.starts_with("exit 0\n") && mixed.contains("warning: b.tum: "), "{mixed}");
    assert!(folder.path().join("p.svg").exists());
}

#[test]
fn two_figures_of_one_name_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let golden = golden("repeated_reference");
    let refused = answer(folder.path(), &["eval", &golden, &golden, "--plot", "a.svg", "--plot-errors", "./a.svg"]);
    assert!(refused.starts_with("exit 2\n") && refused.contains("--plot and --plot-errors both write"), "{refused}");
}

#[test]
fn a_figure_of_several_estimates_does_not_tell_the_number_of_errors_of_the_first_as_that_of_all() {
    let folder = tempfile::tempdir().unwrap();
    let [reference, near, far] = ["repeated_reference", "repeated_reference", "repeated_estimate"].map(golden);
    let figures = ["--plot", "p.svg", "--plot-errors", "e.svg", "--max-diff", "0.03"];
    data(folder.path(), &[&["eval", &reference, &near, &far][..], &figures].concat());
    for name in ["p.svg", "e.svg"] {
        let svg = std::fs::read_to_string(folder.path().join(name)).unwrap();
        let title = svg.split("<title>").nth(1).and_then(|rest| rest.split("</title>").next()).unwrap_or_default();
        assert!(!title.contains(" errors"), "{name}: {title}");
    }
}

#[test]
fn a_sheet_of_objects_under_a_name_of_another_format_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["objects", SMALL_SCENE, "--sheet", "sheet.svg"]), @r"
    exit 2
    error[USAGE]: sheet.svg: a sheet is a picture or a page, expected .png or .html
    help: name the sheet something such as sheet.png or sheet.html
    ");
}
