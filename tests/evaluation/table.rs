use cinesplat::evaluation::{Trajectory, keyframe_table, table_json, table_text};
use cinesplat::geometry::{LevelAngles, LevelFrame, Pose};
use glam::DVec3;

use super::paths::at_30_fps;

fn angled(degrees: &[(f64, f64, f64)]) -> Trajectory {
    let level = LevelFrame::new(DVec3::NEG_Y).unwrap();
    let pose = |&(roll, pitch, yaw): &(f64, f64, f64)| {
        let angles = LevelAngles {
            yaw_rad: f64::to_radians(yaw),
            pitch_rad: f64::to_radians(pitch),
            roll_rad: f64::to_radians(roll),
        };
        Pose::new(DVec3::new(yaw / 100.0, -1.0, 0.5), level.rotation(angles))
    };
    Trajectory { up: Some(DVec3::NEG_Y), ..at_30_fps(&degrees.iter().map(pose).collect::<Vec<_>>()) }
}

#[test]
fn yaw_starts_at_0_and_runs_on() {
    let rows =
        keyframe_table(&angled(&[(0.0, 0.0, 100.0), (5.0, -20.0, 220.0), (5.0, -20.0, 340.0), (0.0, 0.0, 460.0)]));
    let yaws: Vec<f64> = rows.iter().map(|row| (row.yaw_deg * 1e6).round() / 1e6).collect();
    assert_eq!(yaws, [0.0, 120.0, 240.0, 360.0]);
    assert!((rows[1].roll_deg - 5.0).abs() < 1e-9 && (rows[1].pitch_deg + 20.0).abs() < 1e-9);
}

#[test]
fn text_and_json_hold_the_same_numbers() {
    let rows = keyframe_table(&angled(&[(0.0, 0.0, 10.0), (1.5, -20.0, 40.0)]));
    let lines: Vec<String> = table_text(&rows).lines().map(|line| format!("|{line}")).collect();
    insta::assert_snapshot!(lines.join("\n"), @r"
    |    time s          x          y          z   roll deg  pitch deg    yaw deg    fov deg
    |     0.000      0.100     -1.000      0.500      0.000      0.000      0.000          -
    |     0.033      0.400     -1.000      0.500      1.500    -20.000     30.000          -
    ");
    let json: serde_json::Value = serde_json::from_str(&table_json(&rows)).unwrap();
    assert!((json[1]["yaw_deg"].as_f64().unwrap() - 30.0).abs() < 1e-9 && json[1]["fov_y_deg"].is_null());
}
