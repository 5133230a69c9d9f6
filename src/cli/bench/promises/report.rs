use strum::VariantArray;

use cinesplat::pipeline::FilmReport;
use cinesplat::render::Quality;

/// Header line of the CSV.
pub(super) const CSV_HEADER: &str = "scene,promise,wanted,load,settings,asked,got,qualities,outcome\n";
/// Cells of a line that name a film, and all cells.
const NUM_NAMES: usize = 5;
const NUM_CELLS: usize = 9;

/// The cells that name a film: scene, promise, what is wanted, when another process takes a core, and
/// the settings of the bench: size, frames and flags.
pub(super) type Film = [String; NUM_NAMES];

/// A film, its promise in decibels or seconds, and what became of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PromiseRow([String; NUM_CELLS]);

/// What became of a promise.
#[derive(Debug, Clone)]
pub(super) enum Outcome {
    /// Refused before the film began.
    Refused,
    /// Filmed; with a doubt the film said before that it has no reserve.
    Filmed { got: f64, is_kept: bool, is_doubted: bool, report: Box<FilmReport> },
}

impl PromiseRow {
    pub(super) fn new([scene, promise, wanted, load, settings]: Film, asked: f64, outcome: &Outcome) -> Self {
        let (got, qualities, outcome) = match outcome {
            Outcome::Refused => (String::new(), String::new(), "refused"),
            Outcome::Filmed { got, is_kept, is_doubted, report } => {
                let outcome = match (is_kept, is_doubted) {
                    (true, _) => "kept",
                    (false, true) => "late as warned",
                    (false, false) => "broken",
                };
                (format!("{got:.2}"), qualities(report), outcome)
            }
        };
        Self([scene, promise, wanted, load, settings, format!("{asked:.2}"), got, qualities, outcome.to_owned()])
    }

    /// Whether the row is that of a film.
    pub(super) fn is_of(&self, film: &Film) -> bool {
        self.0[..NUM_NAMES] == film[..]
    }

    /// Whether the promise was made and is not kept.
    pub(super) fn is_broken(&self) -> bool {
        self.0[NUM_CELLS - 1] == "broken"
    }
}

/// Number of frames at each quality.
fn qualities(report: &FilmReport) -> String {
    let of = |quality: &Quality| report.qualities.iter().filter(|(_, other)| other == quality).count();
    let counts = Quality::VARIANTS.iter().map(|quality| (quality, of(quality))).filter(|(_, num)| *num > 0);
    counts.map(|(quality, num)| format!("{num} {}", quality.as_ref())).collect::<Vec<_>>().join(" + ")
}

/// The rows as CSV with a header.
pub(super) fn to_csv(rows: &[PromiseRow]) -> String {
    rows.iter().fold(CSV_HEADER.to_owned(), |csv, row| csv + &csv_line(row))
}

/// One row as a line of the CSV; cells without a meaning are empty.
pub(super) fn csv_line(row: &PromiseRow) -> String {
    row.0.join(",") + "\n"
}

/// The rows of a CSV of [`to_csv`]; `None` for any other text.
pub(super) fn from_csv(text: &str) -> Option<Vec<PromiseRow>> {
    let row = |line: &str| Some(PromiseRow(line.split(',').map(str::to_owned).collect::<Vec<_>>().try_into().ok()?));
    text.strip_prefix(CSV_HEADER)?.lines().map(row).collect()
}

/// The rows as a Markdown table.
pub(super) fn to_table(rows: &[PromiseRow]) -> String {
    let header = "| scene | promise | wanted | other process | settings | asked | got | frames | outcome |\n|---|---|---|---|---|---|---|---|---|\n";
    rows.iter().fold(header.to_owned(), |table, row| table + "| " + &row.0.join(" | ") + " |\n")
}
