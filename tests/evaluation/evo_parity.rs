//! Errors of recorded paths against evo 1.38.1, whose results are in `expected_evo_1.38.1.json`.

use cinesplat::evaluation::{Align, EvalSettings, Evaluation, Metric, PairSettings, evaluate};
use serde_json::Value;

use super::paths::recorded;
use crate::support::shared;

/// Relative difference that counts as equal.
const TOLERANCE: f64 = 1e-9;

/// Compares one block of statistics and returns the number of compared values.
fn compare(result: &Evaluation, expected: &Value, where_: &str) -> usize {
    // Exact zeros differ by rounding, so the tolerance is relative to the largest error of the block.
    let scale = expected["max"].as_f64().unwrap();
    for (name, got) in result.statistics.named() {
        let wanted = expected[name].as_f64().unwrap();
        let room = TOLERANCE * wanted.abs() + if name == "min" { TOLERANCE * scale } else { 0.0 };
        assert!((got - wanted).abs() <= room, "{where_} {name}: got {got}, evo {wanted}");
    }
    result.statistics.named().len()
}

#[test]
fn every_statistic_relation_and_alignment() {
    let Some(path) = shared("data/trajectories/expected_evo_1.38.1.json") else { return };
    let cases: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let mut compared = 0;
    for case in cases.as_array().unwrap() {
        let reference = recorded(case["reference"].as_str().unwrap()).unwrap();
        let estimate = recorded(case["estimate"].as_str().unwrap()).unwrap();
        for (metric, block) in [(Metric::Ape, "ape"), (rpe(), "rpe_1_frame")] {
            for (align, relations) in case[block].as_object().unwrap() {
                for (relation, expected) in relations.as_object().unwrap() {
                    let settings = EvalSettings {
                        metric,
                        align: align.parse().unwrap(),
                        relation: relation.parse().unwrap(),
                        max_diff_secs: case["max_diff"].as_f64().unwrap(),
                        ..EvalSettings::default()
                    };
                    let where_ = format!("{} {block} {align} {relation}", case["name"]);
                    let result = evaluate(&reference, &estimate, &settings).unwrap();
                    assert_eq!(result.matches.reference.len() as u64, case["pairs"].as_u64().unwrap());
                    compared += compare(&result, expected, &where_);
                }
            }
        }
    }
    // 4 pairs of paths, 2 metrics, 5 alignments, 4 relations, 7 statistics.
    assert_eq!(compared, 4 * 2 * 5 * 4 * 7);
}

fn rpe() -> Metric {
    Metric::Rpe { pairs: PairSettings::default(), pairs_from_reference: false }
}

#[test]
fn scales_of_the_alignment() {
    let Some(path) = shared("data/trajectories/expected_evo_1.38.1.json") else { return };
    let cases: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    for case in cases.as_array().unwrap() {
        let reference = recorded(case["reference"].as_str().unwrap()).unwrap();
        let estimate = recorded(case["estimate"].as_str().unwrap()).unwrap();
        for align in [Align::Sim3, Align::Scale] {
            let settings = EvalSettings { align, ..EvalSettings::default() };
            let got = evaluate(&reference, &estimate, &settings).unwrap().alignment.scale;
            let wanted = case["scale"][align.as_ref()].as_f64().unwrap();
            assert!((got / wanted - 1.0).abs() < TOLERANCE, "{} {}", case["name"], align.as_ref());
        }
    }
}

#[test]
fn an_alignment_of_the_first_poses_only() {
    let Some(reference) = recorded("freiburg1_xyz-groundtruth.txt") else { return };
    let estimate = recorded("freiburg1_xyz-rgbdslam_drift.txt").unwrap();
    let settings = EvalSettings { align: Align::Sim3, align_poses: Some(50), ..EvalSettings::default() };
    let result = evaluate(&reference, &estimate, &settings).unwrap();
    // evo's `--n_to_align 50 -as`.
    assert!((result.statistics.rmse / 0.026_236_638_068_983_614 - 1.0).abs() < TOLERANCE);
}

#[test]
fn nothing_is_aligned_unless_asked() {
    assert_eq!(EvalSettings::default().align, Align::None);
}

#[test]
fn the_json_result_has_the_promised_keys_at_its_top_level() {
    let Some(reference) = recorded("freiburg1_xyz-groundtruth.txt") else { return };
    let estimate = recorded("freiburg1_xyz-ORB_kf_mono.txt").unwrap();
    let settings = EvalSettings { align: Align::Sim3, ..EvalSettings::default() };
    let result = evaluate(&reference, &estimate, &settings).unwrap();
    let json: Value = serde_json::from_str(&result.to_json()).unwrap();
    for key in ["rmse", "mean", "median", "std", "min", "max", "sse", "scale"] {
        assert!(json[key].is_f64(), "{key}");
    }
    assert_eq!(
        (json["pairs"].as_u64(), json["relation"].as_str(), json["align"].as_str()),
        (Some(32), Some("trans"), Some("sim3"))
    );
    assert_eq!((json["rotation"][2].as_array().unwrap().len(), json["translation"].as_array().unwrap().len()), (3, 3));
    // The alignment in the JSON maps the mean of the estimate to the mean of the reference: R s p + t.
    let row =
        |idx: usize| json["rotation"][idx].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect::<Vec<_>>();
    let original = evaluate(&reference, &estimate, &EvalSettings::default()).unwrap().matches;
    let mean = |points: &[glam::DVec3]| points.iter().sum::<glam::DVec3>() / 32.0;
    let (from, to) = (mean(&original.estimate.positions), mean(&original.reference.positions));
    for axis in 0..3 {
        let turned: f64 = row(axis).iter().zip(from.to_array()).map(|(r, p)| r * p).sum();
        let moved = json["scale"].as_f64().unwrap() * turned + json["translation"][axis].as_f64().unwrap();
        assert!((moved - to[axis]).abs() < 1e-12);
    }
}
