//! Films of the only thing of a scan, and films that would lead through a wall.

use serde_json::Value;

use super::{data, run};
use crate::support::shared;

#[test]
fn the_only_thing_of_a_scan_is_called_by_any_name() {
    let Some(scan) = shared("data/palm/centered_lastchance.splat") else { return };
    let folder = tempfile::tempdir().unwrap();
    let scan = scan.to_str().unwrap();
    let output = run(folder.path(), &["plan", scan, "-p", "push in on the palm", "--solve", "fast", "-o", "shot.json"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && said.contains("\"palm\" is taken for <obj-1>"), "{said}");
    let shot: Value = serde_json::from_str(&std::fs::read_to_string(folder.path().join("shot.json")).unwrap()).unwrap();
    let subjects = &shot["keyframes"][0]["intent"]["subjects"];
    assert_eq!(subjects, &serde_json::json!([1]), "{shot}");
}

/// The guitar stands before a wall: the way behind it led through the wall and out of the room.
#[test]
fn no_film_goes_through_a_wall() {
    let folder = tempfile::tempdir().unwrap();
    let prompt = "orbit the guitar and end behind it";
    data(folder.path(), &["plan", "synth:room:150:0.1", "-p", prompt, "--solve", "fast", "-o", "shot.json"]);
    let shot: Value = serde_json::from_str(&std::fs::read_to_string(folder.path().join("shot.json")).unwrap()).unwrap();
    assert!(shot["clearance"]["failure"].is_null(), "{}", shot["clearance"]);
    let report = shot["report"].as_array().unwrap();
    let given_up = |line: &Value| line["note"].as_str().is_some_and(|note| note.starts_with("given up"));
    assert!(report.iter().any(given_up), "{report:?}");
}
