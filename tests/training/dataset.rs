//! Writing datasets.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Barrier;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use cinesplat::training::{DatasetSettings, DatasetSummary, write_dataset};

/// A folder with shards that exist already, and settings for which nothing else is to be made.
fn finished_shards(num_shards: u64) -> (tempfile::TempDir, DatasetSettings) {
    let out = tempfile::tempdir().unwrap();
    let settings = DatasetSettings { num_scenes: 8 * num_shards, threads: 2, ..DatasetSettings::default() };
    for shard in 0..num_shards {
        let header = format!(r#"{{"format":"cinesplat.shots","version":1,"seed":{}}}"#, settings.seed);
        std::fs::write(out.path().join(format!("shots-{shard:05}.jsonl")), header).unwrap();
    }
    (out, settings)
}

#[test]
fn existing_shards_are_kept() {
    let (out, settings) = finished_shards(3);
    let summary = write_dataset(&settings, out.path(), &|_, _| {}).unwrap();
    assert_eq!(summary, DatasetSummary { num_shards_kept: 3, ..DatasetSummary::default() });
}

/// The worker thread's result used to be replaced by a success.
#[test]
fn a_panic_on_a_worker_thread_is_a_panic_of_the_call() {
    let (out, settings) = finished_shards(2);
    let caller = thread::current().id();
    let both_threads_work = Barrier::new(2);
    let caller_has_waited = AtomicBool::new(false);
    let report = |_, _| {
        if thread::current().id() != caller {
            both_threads_work.wait();
            panic!("a report that fails on the worker thread");
        }
        if !caller_has_waited.swap(true, Ordering::Relaxed) {
            both_threads_work.wait();
        }
    };
    let result = catch_unwind(AssertUnwindSafe(|| write_dataset(&settings, out.path(), &report)));
    assert!(result.is_err(), "the dataset counts as written: {result:?}");
}

/// NaN used to reach the scene generator, which panicked.
#[test]
fn a_level_of_detail_out_of_range_is_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("shots");
    for detail in [f64::NAN, f64::INFINITY, 0.0, -1.0, 0.0099, 4.1] {
        let settings = DatasetSettings { detail, ..DatasetSettings::default() };
        let error = write_dataset(&settings, &out, &|_, _| {}).unwrap_err();
        assert_eq!(error.code(), "DATASET-SETTING");
        assert_eq!(error.to_string(), format!("detail is {detail}, expected 0.01 to 4"));
        assert!(!out.exists(), "{detail}: a folder was created");
    }
}
