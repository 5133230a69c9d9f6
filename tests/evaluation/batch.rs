use cinesplat::evaluation::{BatchRow, EvalSettings, EvaluationError, evaluate, summary_csv, summary_json};
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
}
