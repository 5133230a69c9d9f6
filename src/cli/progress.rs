use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::console;

/// Interval of progress lines where no terminal shows a bar.
const LINE_INTERVAL: Duration = Duration::from_secs(5);

/// Progress of frames or rows with rate and time left: a bar on a terminal, a line every five seconds elsewhere.
pub(super) struct FrameProgress {
    /// Name of the counted item, and the unit of its rate.
    names: [&'static str; 2],
    bar: Option<ProgressBar>,
    start: Instant,
    last_line: Instant,
}

impl FrameProgress {
    pub(super) fn new() -> Self {
        Self::of(["frame", "fps"])
    }

    /// Progress of the rows of a bench.
    pub(super) fn of_rows() -> Self {
        Self::of(["row", "rows/s"])
    }

    /// Progress of masks that are lifted.
    pub(super) fn of_masks() -> Self {
        Self::of(["mask", "masks/s"])
    }

    /// Progress of objects whose points are described.
    pub(super) fn of_objects() -> Self {
        Self::of(["object", "objects/s"])
    }

    fn of(names: [&'static str; 2]) -> Self {
        let start = Instant::now();
        Self { names, bar: console::is_watched().then(|| new_bar(names)), start, last_line: start }
    }

    /// Shows that `done` of `total` are done.
    pub(super) fn show(&mut self, done: usize, total: usize) {
        if let Some(bar) = &self.bar {
            bar.set_length(total as u64);
            bar.set_position(done as u64);
        } else if self.last_line.elapsed() >= LINE_INTERVAL || done == total {
            self.last_line = Instant::now();
            console::note(&line(self.names, (done, total), self.start.elapsed()));
        }
    }

    /// Removes the bar.
    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn new_bar([name, unit]: [&'static str; 2]) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::stderr_with_hz(10));
    let template = format!("{name} {{pos}}/{{len}} {{bar:30}} {{per_sec}}, {{eta}} left");
    match ProgressStyle::with_template(&template) {
        Ok(style) => bar.with_style(style.with_key(
            "per_sec",
            move |state: &indicatif::ProgressState, out: &mut dyn std::fmt::Write| {
                // A failed write of the bar does not stop the film.
                let _ = write!(out, "{:.1} {unit}", state.per_sec());
            },
        )),
        Err(_) => bar,
    }
}

fn line([name, unit]: [&str; 2], (done, total): (usize, usize), elapsed: Duration) -> String {
    let rate = done as f64 / elapsed.as_secs_f64().max(1e-9);
    let left_secs = total.saturating_sub(done) as f64 / rate.max(1e-9);
    format!("{name} {done}/{total}, {rate:.1} {unit}, {left_secs:.0} s left")
}
