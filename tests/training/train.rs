//! The training loop: gradients, repeatability, stopping and resuming.

use std::ops::ControlFlow;

use cinesplat::director::ModelFiles;
use cinesplat::training::{TrainSettings, TrainingProgress, check_gradients, train};

/// candle silently drops the gradients of some of its operations, and several operations have hand-written gradients.
#[test]
fn every_parameter_has_the_gradient_that_finite_differences_give() {
    let check = check_gradients(5, 16, 8).unwrap();
    assert!(check.parameters.len() > 60);
    for parameter in &check.parameters {
        // Long enough for a relative tolerance: differences of f32 losses are good to about 1e-4.
        assert!(parameter.backward > 5e-3, "{} has no gradient", parameter.name);
        let off = (parameter.backward - parameter.numeric).abs();
        assert!(
            off < 0.02 * parameter.backward,
            "{}: {} by backpropagation, {} by finite differences",
            parameter.name,
            parameter.backward,
            parameter.numeric
        );
    }
}

#[test]
fn padding_and_other_examples_in_a_batch_do_not_change_the_loss() {
    let check = check_gradients(6, 12, 12).unwrap();
    let off = (check.batch_loss - check.single_losses).abs();
    assert!(off < 1e-4 * check.batch_loss, "{} in one batch, {} one by one", check.batch_loss, check.single_losses);
}

fn short_training() -> TrainSettings {
    TrainSettings {
        steps: 4,
        batch: 6,
        warm_up: 2,
        corpus: 100,
        vocabulary: 300,
        checkpoint_every: 100,
        evaluation_prompts: 0,
        ..TrainSettings::default()
    }
}

#[test]
fn a_stopped_training_resumes_to_the_same_weights() {
    let whole = tempfile::tempdir().unwrap();
    let through = train(&short_training(), whole.path(), &mut |_| ControlFlow::Continue(())).unwrap();
    let parted = tempfile::tempdir().unwrap();
    let stopping = TrainSettings { report_every: 2, threads: 1, ..short_training() };
    let stopped = train(&stopping, parted.path(), &mut |_| ControlFlow::Break(())).unwrap_err();
    assert_eq!(stopped.code(), "TRAIN-STOPPED");
    let resumed = TrainSettings { resume: true, ..short_training() };
    let resumed = train(&resumed, parted.path(), &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(resumed.sha256, through.sha256, "the weights depend on the stop or on the number of threads");
}

#[test]
fn a_text_encoder_trained_beforehand_is_trained_on_and_goes_into_the_model() {
    let out = tempfile::tempdir().unwrap();
    let base = TrainSettings { base: Some("tests/director/bert".into()), steps: 2, ..short_training() };
    train(&base, out.path(), &mut |_| ControlFlow::Continue(())).unwrap();
    let files = ModelFiles::read(out.path()).unwrap();
    assert_eq!(files.config().unwrap().bert.map(|bert| bert.layers), Some(2));
    assert!(files.vocabulary().unwrap().pieces().contains_key("##ly"));
    // A training from that model needs the folder no longer.
    let next = tempfile::tempdir().unwrap();
    let from = TrainSettings { base: None, from: Some(out.path().to_owned()), ..base };
    train(&from, next.path(), &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(ModelFiles::read(next.path()).unwrap().config().unwrap(), files.config().unwrap());
}

#[test]
fn the_loss_falls_and_progress_reports_count_the_steps() {
    let out = tempfile::tempdir().unwrap();
    let (mut steps, mut losses) = (Vec::new(), Vec::new());
    let settings = TrainSettings { steps: 24, warm_up: 4, report_every: 8, evaluation_prompts: 3, ..short_training() };
    let summary = train(&settings, out.path(), &mut |progress| {
        if let TrainingProgress::Steps { done, total, choice_loss, .. } = progress {
            steps.push((*done, *total));
            losses.push(*choice_loss);
        }
        ControlFlow::Continue(())
    });
    assert!(summary.unwrap().num_parameters > 100_000);
    assert_eq!(steps, [(8, 24), (16, 24), (24, 24)]);
    assert!(losses.last().unwrap() < &(0.75 * losses[0]), "{losses:?}");
}

#[test]
fn a_checkpoint_of_other_settings_is_rejected() {
    let out = tempfile::tempdir().unwrap();
    let short = TrainSettings { steps: 1, ..short_training() };
    train(&short, out.path(), &mut |_| ControlFlow::Continue(())).unwrap();
    let other = TrainSettings { seed: 9, resume: true, ..short };
    let error = train(&other, out.path(), &mut |_| ControlFlow::Continue(())).unwrap_err();
    assert_eq!(error.code(), "TRAIN-CHECKPOINT");
}
