use std::path::PathBuf;

use cinesplat::evaluation::{BatchRow, EvalSettings, EvaluationError, evaluate, pair_files, summary_csv, summary_json};
use glam::{DQuat, DVec3};

use super::paths::through;

fn rows() -> Vec<BatchRow> {
    let path = |shift: f64| through((0..10).map(move |k| DVec3::new(f64::from(k), shift, 0.0)), DQuat::IDENTITY);
    let compared = |shift: f64| evaluate(&path(0.0), &path(shift), &EvalSettings::default());
    vec![
        BatchRow { name: "near".into(), outcome: compared(1.0) },
        BatchRow { name: "far, far".into(), outcome: compared(3.0) },
        BatchRow { name: "none".into(), outcome: Err(EvaluationError::Empty { which: "estimate" }) },
    ]
}

#[test]
fn the_table_keeps_failures() {
    insta::assert_snapshot!(summary_csv(&rows()), @r#"
    name,pairs,matched,dropped_reference,dropped_estimate,scale,rmse,mean,median,std,min,max,sse,error
    near,10,10,0,0,1,1,1,1,0,1,1,10,
    "far, far",10,10,0,0,1,3,3,3,0,3,3,90,
    none,,,,,,,,,,,,,"the estimate has no poses, expected at least one"
    "#);
}

#[test]
fn the_json_sums_up() {
    let json: serde_json::Value = serde_json::from_str(&summary_json(&rows())).unwrap();
    let over_all = &json["over_all"];
    assert_eq!((over_all["compared"].as_u64(), over_all["failed"].as_u64()), (Some(2), Some(1)));
    assert_eq!((over_all["mean_rmse"].as_f64(), over_all["worst_rmse"].as_f64()), (Some(2.0), Some(3.0)));
    assert_eq!(json["pairs"].as_array().unwrap().len(), 3);
    // What was measured and how the estimate was scaled used to be in the JSON of one estimate alone.
    let first = &json["pairs"][0];
    assert_eq!((first["relation"].as_str(), first["unit"].as_str()), (Some("trans"), Some("scene units")));
    assert_eq!((first["metric"]["name"].as_str(), first["scale"].as_f64()), (Some("ape"), Some(1.0)));
    assert_eq!((first["matched"].as_u64(), first["notes"].as_array().map(Vec::len)), (Some(10), Some(0)));
}

#[test]
fn files_are_paired_by_the_name_up_to_the_first_dot() {
    let paths = |names: &[&str]| names.iter().map(PathBuf::from).collect::<Vec<_>>();
    let found =
        pair_files(&paths(&["r/a.shot.json", "r/b.tum", "r/.hidden"]), &paths(&["e/c.tum", "e/a.csv"])).unwrap();
    assert_eq!(found.pairs, [("a".to_owned(), ["r/a.shot.json".into(), "e/a.csv".into()])]);
    assert_eq!((found.lone_references, found.lone_estimates), (paths(&["r/b.tum"]), paths(&["e/c.tum"])));
    let error = pair_files(&paths(&["r/a.tum"]), &paths(&["e/a.csv", "e/a.tum"])).unwrap_err();
    insta::assert_snapshot!(error, @r#"e/a.csv and e/a.tum have the same stem "a", expected one file per stem"#);
}
