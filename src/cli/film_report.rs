//! What `render` says about a film that is finished or stopped.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::{Duration, Instant};
use strum::VariantArray;

use serde_json::{Value, json};

use super::failure::{Exit, Failure};
use super::{console, reproduce};
use cinesplat::pipeline::{self, FilmReport, FilmSettings, Forecast, PhaseTimes};
use cinesplat::render::Quality;

/// Prints the wall time per phase. Encoding runs beside rendering, so the phases sum to more than the total.
pub(super) fn print_times(times: &PhaseTimes, report: &FilmReport, total: Duration) {
    let phases: Vec<String> =
        times.iter().map(|(phase, time)| format!("{phase} {:.2} s", time.as_secs_f64())).collect();
    let rate_fps = report.num_frames as f64 / report.total_time.as_secs_f64().max(1e-9);
    console::note(&format!(
        "{}: {} frames; {} (parallel to render); total {:.2} s, film {rate_fps:.1} fps",
        report.path.display(),
        report.num_frames,
        phases.join(", "),
        total.as_secs_f64()
    ));
}

/// Prints what became of the requirements: frames at other qualities than the first one, and a deadline that was missed.
pub(super) fn print_promise(settings: &FilmSettings, report: &FilmReport) {
    let Some(promise) = &settings.promise else { return };
    let counts: Vec<String> =
        counts_of(report).into_iter().map(|(quality, num)| format!("{num} frames at {}", quality.as_ref())).collect();
    if counts.len() > 1 {
        console::note(&format!("to keep the requirements: {}", counts.join(", ")));
    }
    if report.num_finest > 0 {
        let num = report.num_finest;
        console::note(&format!("to keep the requirements: {num} frames at `final` with the samples of `reference`"));
    }
    let late = promise.deadline.map(|deadline| Instant::now().saturating_duration_since(deadline).as_secs_f64());
    if let Some(late) = late.filter(|late| *late > 0.0) {
        console::warnings([format!("the film ended {late:.2} s after its budget")]);
    }
}

/// Frames that were rendered, per quality that was used.
fn counts_of(report: &FilmReport) -> Vec<(Quality, usize)> {
    let of = |quality: Quality| report.qualities.iter().filter(|(_, other)| *other == quality).count();
    Quality::VARIANTS.iter().map(|quality| (*quality, of(*quality))).filter(|(_, num)| *num > 0).collect()
}

/// Prints where each effect of the film ran, and why; nothing for a film without effects.
pub(super) fn print_effects(report: &FilmReport) {
    if !report.effects.effects.is_empty() {
        report.effects.sentences().iter().for_each(|line| console::note(line));
    }
}

/// Prints predicted and measured figures side by side, and returns them for programs.
pub(super) fn compare(predicted: &Forecast, report: &FilmReport, psnr_db: f64) -> Value {
    let measured = report.total_time.as_secs_f64();
    let film_secs = predicted.film_time.as_secs_f64();
    let quality = predicted.quality.as_ref();
    let against = if report.num_kept == 0 {
        let off_percent = (measured / film_secs.max(1e-9) - 1.0) * 100.0;
        format!("predicted {film_secs:.2} s: {off_percent:+.0} %")
    } else {
        // Frames that were kept cost no time now.
        format!("{} of {} frames were kept", report.num_kept, report.num_wanted)
    };
    let counts = counts_of(report);
    let of_first = if counts.len() > 1 { format!(" of frames at {quality}") } else { String::new() };
    let named: Vec<String> = counts.iter().map(|(quality, num)| format!("{num} {}", quality.as_ref())).collect();
    let mix = if counts.len() > 1 { named.join(" + ") } else { quality.to_owned() };
    console::note(&format!(
        "{mix}: filmed in {measured:.2} s ({against}), {psnr_db:.1} dB{of_first} (predicted {:.1} dB)",
        predicted.psnr_db
    ));
    // JSON has no infinity: null stands for an exact picture. Predicted render and encode times are those of each alone,
    // measured ones are parallel.
    let frames_per_quality: BTreeMap<&str, usize> =
        counts.iter().map(|(quality, num)| (quality.as_ref(), *num)).collect();
    json!({
        "frames_per_quality": frames_per_quality,
        "path": report.path.to_string_lossy(), "frames": report.num_frames, "kept_frames": report.num_kept, "quality": quality,
        "predicted": {"film_secs": film_secs, "render_secs": predicted.render_time.as_secs_f64(),
            "encode_secs": predicted.encode_time.as_secs_f64(), "psnr_db": predicted.psnr_db,
            "worst_psnr_db": predicted.worst_psnr_db, "memory_bytes": predicted.memory_bytes},
        "measured": {"film_secs": measured, "render_secs": report.render_time.as_secs_f64(),
            "keep_secs": report.keep_time.as_secs_f64(), "encode_secs": report.encode_time.as_secs_f64(),
            "psnr_db": psnr_db},
    })
}

/// A stopped film is a failure; its finished frames are kept, unless the user did not want that.
pub(super) fn stopped(report: &FilmReport, output: &Path, is_kept: bool) -> Failure {
    let (place, done, wanted) = (output.display(), report.num_frames, report.num_wanted);
    let found = format!("{place}: stopped after {done} of {wanted} frames");
    let line = reproduce::line_to_go_on();
    let (found, help) = if is_kept {
        let folder = pipeline::job_folder(output);
        (format!("{found}, which are kept in {}", folder.display()), format!("to go on, type: {line}"))
    } else {
        (found, format!("without --no-job the finished frames are kept; to start over, type: {line}"))
    };
    Failure::stopped(found, help)
}

/// The failure, and the line to type once its cause is mended, where finished frames are kept.
pub(super) fn with_line_to_go_on(failure: Failure, output: &Path) -> Failure {
    if failure.exit() != Exit::Io || !pipeline::has_job(output) {
        return failure;
    }
    failure.with_further_help(&format!("then go on with: {}", reproduce::line_to_go_on()))
}
