//! Errors of paths against evo 1.38.1. `tests/evaluation/golden` holds two paths and evo's figures and is part of every
//! clone; `../shared/data/trajectories` holds recorded paths that only some machines have.

use std::path::{Path, PathBuf};

use cinesplat::evaluation::{
    Align, Delta, DeltaUnit, EvalSettings, Evaluation, Metric, PairSettings, Trajectory, evaluate,
};
use cinesplat::export::read;
use serde_json::Value;

use super::paths::recorded;
use crate::support::shared;

/// Relative difference that counts as equal.
const TOLERANCE: f64 = 1e-9;

/// One pair of paths and what evo computed for it.
struct Case {
    reference: Trajectory,
    estimate: Trajectory,
    /// Matching settings given to evo; no alignment.
    settings: EvalSettings,
    expected: Value,
}

/// The cases of a file of evo's figures, whose paths lie beside it.
fn cases(file: &Path) -> Vec<Case> {
    let json: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let path = |name: &Value| {
        let file = file.with_file_name(name.as_str().unwrap());
        Trajectory::from(&read(&file, None).unwrap().track)
    };
    let case = |expected: &Value| Case {
        reference: path(&expected["reference"]),
        estimate: path(&expected["estimate"]),
        settings: EvalSettings {
            max_diff_secs: expected["max_diff"].as_f64().unwrap(),
            estimate_offset_secs: expected.get("time_offset").map_or(0.0, |secs| secs.as_f64().unwrap()),
            ..EvalSettings::default()
        },
        expected: expected.clone(),
    };
    json.as_array().unwrap().iter().map(case).collect()
}

fn own() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/evaluation/golden/expected_evo.json")
}

fn recordings() -> Option<PathBuf> {
    shared("data/trajectories/expected_evo_1.38.1.json")
}

fn rpe(delta: f64, unit: DeltaUnit) -> Metric {
    let pairs = PairSettings { delta: Delta::new(delta, unit).unwrap(), ..PairSettings::default() };
    Metric::Rpe { pairs, pairs_from_reference: false }
}

/// Compares one block of statistics. Returns the number of compared values and their largest relative difference.
fn compare(result: &Evaluation, expected: &Value, label: &str) -> (usize, f64) {
    let largest = expected["max"].as_f64().unwrap();
    let mut difference = 0.0_f64;
    for (name, got) in result.statistics.named() {
        let wanted = expected[name].as_f64().unwrap();
        // The smallest error may be zero up to rounding, so its tolerance is relative to the largest error of the block.
        let unit = wanted.abs() + if name == "min" { largest } else { 0.0 };
        assert!((got - wanted).abs() <= TOLERANCE * unit, "{label} {name}: got {got}, evo {wanted}");
        difference = difference.max((got - wanted).abs() / unit);
    }
    (result.statistics.named().len(), difference)
}

/// Compares every figure of the named blocks and returns the number of compared values.
fn compare_all(cases: &[Case], blocks: &[(&str, Metric)]) -> usize {
    let (mut compared, mut difference) = (0, 0.0_f64);
    for case in cases {
        for (block, metric) in blocks {
            for (align, relations) in case.expected[block].as_object().unwrap() {
                for (relation, expected) in relations.as_object().unwrap() {
                    let settings = EvalSettings {
                        metric: *metric,
                        align: align.parse().unwrap(),
                        relation: relation.parse().unwrap(),
                        ..case.settings.clone()
                    };
                    let label = format!("{} {block} {align} {relation}", case.expected["name"]);
                    let result = evaluate(&case.reference, &case.estimate, &settings).unwrap();
                    assert_eq!(result.matches.reference.len() as u64, case.expected["pairs"].as_u64().unwrap());
                    let (count, worst) = compare(&result, expected, &label);
                    compared += count;
                    difference = difference.max(worst);
                }
            }
        }
    }
    eprintln!("{compared} figures of evo, largest relative difference {difference:.1e}");
    compared
}

fn compare_scales(cases: &[Case]) {
    for case in cases {
        for align in [Align::Sim3, Align::Scale] {
            let settings = EvalSettings { align, ..case.settings.clone() };
            let got = evaluate(&case.reference, &case.estimate, &settings).unwrap().alignment.scale;
            let wanted = case.expected["scale"][align.as_ref()].as_f64().unwrap();
            assert!((got / wanted - 1.0).abs() < TOLERANCE, "{} {}", case.expected["name"], align.as_ref());
        }
    }
}

#[test]
fn every_statistic_relation_and_alignment() {
    let blocks = [
        ("ape", Metric::Ape),
        ("rpe_1_frame", rpe(1.0, DeltaUnit::Frames)),
        ("rpe_quarter_unit", rpe(0.25, DeltaUnit::Distance)),
    ];
    // 5 alignments, 6 or 7 relations, 7 statistics.
    assert_eq!(compare_all(&cases(&own()), &blocks), 5 * (6 + 7 + 7) * 7);
}

#[test]
fn every_statistic_relation_and_alignment_of_recorded_paths() {
    let Some(file) = recordings() else { return };
    let blocks = [("ape", Metric::Ape), ("rpe_1_frame", rpe(1.0, DeltaUnit::Frames))];
    // 4 pairs of paths, 2 metrics, 5 alignments, 4 relations, 7 statistics.
    assert_eq!(compare_all(&cases(&file), &blocks), 4 * 2 * 5 * 4 * 7);
}

#[test]
fn scales_of_the_alignment() {
    compare_scales(&cases(&own()));
}

#[test]
fn scales_of_the_alignment_of_recorded_paths() {
    let Some(file) = recordings() else { return };
    compare_scales(&cases(&file));
}

#[test]
fn an_alignment_of_the_first_poses_only() {
    let case = cases(&own()).remove(0);
    let settings = EvalSettings { align: Align::Sim3, align_poses: Some(50), ..case.settings.clone() };
    let result = evaluate(&case.reference, &case.estimate, &settings).unwrap();
    compare(&result, &case.expected["sim3_of_50_poses"], "sim3 of 50 poses");
}

#[test]
fn an_alignment_of_the_first_poses_only_of_a_recorded_path() {
    let Some(reference) = recorded("freiburg1_xyz-groundtruth.txt") else { return };
    let estimate = recorded("freiburg1_xyz-rgbdslam_drift.txt").unwrap();
    let settings = EvalSettings { align: Align::Sim3, align_poses: Some(50), ..EvalSettings::default() };
    let result = evaluate(&reference, &estimate, &settings).unwrap();
    // evo's `--n_to_align 50 -as`.
    assert!((result.statistics.rmse / 0.026_236_638_068_983_614 - 1.0).abs() < TOLERANCE);
}

#[test]
fn nothing_is_aligned_unless_asked() {
    let case = cases(&own()).remove(0);
    let result = evaluate(&case.reference, &case.estimate, &case.settings).unwrap();
    let unaligned = case.expected["ape"]["none"]["trans"]["rmse"].as_f64().unwrap();
    assert!((result.statistics.rmse / unaligned - 1.0).abs() < TOLERANCE, "{}", result.statistics.rmse);
}

#[test]
fn the_json_result_has_the_promised_keys_at_its_top_level() {
    let case = cases(&own()).remove(0);
    let settings = EvalSettings { align: Align::Sim3, ..case.settings.clone() };
    let result = evaluate(&case.reference, &case.estimate, &settings).unwrap();
    let json: Value = serde_json::from_str(&result.to_json()).unwrap();
    for key in ["rmse", "mean", "median", "std", "min", "max", "sse", "scale"] {
        assert!(json[key].is_f64(), "{key}");
    }
    assert_eq!(
        (json["pairs"].as_u64(), json["relation"].as_str(), json["align"].as_str()),
        (Some(177), Some("trans"), Some("sim3"))
    );
    assert_eq!((json["rotation"][2].as_array().unwrap().len(), json["translation"].as_array().unwrap().len()), (3, 3));
    // The alignment in the JSON maps the mean of the estimate to the mean of the reference: R s p + t.
    let row =
        |idx: usize| json["rotation"][idx].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect::<Vec<_>>();
    let original = evaluate(&case.reference, &case.estimate, &case.settings).unwrap().matches;
    let mean = |points: &[glam::DVec3]| points.iter().sum::<glam::DVec3>() / 177.0;
    let (from, to) = (mean(&original.estimate.positions), mean(&original.reference.positions));
    for axis in 0..3 {
        let turned: f64 = row(axis).iter().zip(from.to_array()).map(|(r, p)| r * p).sum();
        let moved = json["scale"].as_f64().unwrap() * turned + json["translation"][axis].as_f64().unwrap();
        assert!((moved - to[axis]).abs() < 1e-12);
    }
}
