//! Training: gradients, the same run twice, stop and go on.

use std::ops::ControlFlow;

use cinesplat::training::{TrainSettings, TrainingProgress, check_gradients, train};

/// candle drops the gradients of some of its operations silently; ours are written by hand.
#[test]
fn every_parameter_has_the_gradient_that_finite_differences_give() {
    let check = check_gradients(5, 16, 8).unwrap();
    assert!(check.parameters.len() > 60);
    for parameter in &check.parameters {
        assert!(parameter.backward > 1e-7, "{} has no gradient", parameter.name);
        let off = (parameter.backward - parameter.numeric).abs();
        assert!(
            off < 0.02 * parameter.backward + 2e-3,
            "{}: {} by backpropagation, {} by differences",
            parameter.name,
            parameter.backward,
            parameter.numeric
        );
    }
}

#[test]
fn padding_and_company_in_a_batch_change_no_loss() {
    let check = check_gradients(6, 12, 12).unwrap();
    let off = (check.batch_loss - check.single_losses).abs();
    assert!(off < 1e-4 * check.batch_loss, "{} together, {} one by one", check.batch_loss, check.single_losses);
}

fn settings() -> TrainSettings {
    TrainSettings {
        steps: 4,
        batch: 6,
        warm_up: 2,
        corpus: 100,
        vocabulary: 300,
        checkpoint_every: 100,
        evaluation_prompts: 3,
        ..TrainSettings::default()
    }
}

#[test]
fn a_stopped_training_goes_on_to_the_very_same_weights() {
    let whole = tempfile::tempdir().unwrap();
    let through = train(&settings(), whole.path(), &mut |_| ControlFlow::Continue(())).unwrap();
    let parted = tempfile::tempdir().unwrap();
    let stopping = TrainSettings { report_every: 2, threads: 1, ..settings() };
    let stopped = train(&stopping, parted.path(), &mut |_| ControlFlow::Break(())).unwrap_err();
    assert_eq!(stopped.code(), "TRAIN-STOPPED");
    let resumed = TrainSettings { resume: true, ..settings() };
    let resumed = train(&resumed, parted.path(), &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(resumed.sha256, through.sha256, "the weights depend on the stop or on the number of threads");
}

#[test]
fn the_loss_falls_and_the_report_says_where_training_stands() {
    let out = tempfile::tempdir().unwrap();
    let mut losses = Vec::new();
    let settings = TrainSettings { steps: 24, warm_up: 4, report_every: 8, ..settings() };
    let summary = train(&settings, out.path(), &mut |progress| {
        if let TrainingProgress::Steps { done, total, choice_loss, .. } = progress {
            assert!(*done <= *total);
            losses.push(*choice_loss);
        }
        ControlFlow::Continue(())
    });
    assert!(summary.unwrap().num_parameters > 100_000);
    assert!(losses.last().unwrap() < &(0.75 * losses[0]), "{losses:?}");
}

#[test]
fn a_checkpoint_of_other_settings_is_refused() {
    let out = tempfile::tempdir().unwrap();
    let short = TrainSettings { steps: 1, ..settings() };
    train(&short, out.path(), &mut |_| ControlFlow::Continue(())).unwrap();
    let other = TrainSettings { seed: 9, resume: true, ..short };
    let error = train(&other, out.path(), &mut |_| ControlFlow::Continue(())).unwrap_err();
    assert_eq!(error.code(), "TRAIN-CHECKPOINT");
}
