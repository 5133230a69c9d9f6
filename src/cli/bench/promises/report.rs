use std::fmt::Write as _;
use strum::VariantArray;

use cinesplat::pipeline::FilmReport;
use cinesplat::render::Quality;

/// Header line of the CSV.
pub(super) const CSV_HEADER: &str = "scene,promise,asked,got,qualities,load,outcome\n";

/// One film and its promise: decibels, or seconds.
#[derive(Debug, Clone)]
pub(super) struct PromiseRow {
    pub(super) scene: String,
    pub(super) promise: &'static str,
    pub(super) asked: f64,
    /// When another process takes a core.
    pub(super) load: &'static str,
    pub(super) outcome: Outcome,
}

/// What became of a promise.
#[derive(Debug, Clone)]
pub(super) enum Outcome {
    /// Refused before the film began.
    Refused,
    /// Filmed; with a doubt the film said before that it has no reserve.
    Filmed { got: f64, is_kept: bool, is_doubted: bool, report: Box<FilmReport> },
}

impl PromiseRow {
    /// Whether the promise was made and is not kept.
    pub(super) fn is_broken(&self) -> bool {
        matches!(self.outcome, Outcome::Filmed { is_kept: false, is_doubted: false, .. })
    }

    fn cells(&self) -> [String; 7] {
        let (got, qualities, outcome) = match &self.outcome {
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
        let asked = format!("{:.2}", self.asked);
        [self.scene.clone(), self.promise.to_owned(), asked, got, qualities, self.load.to_owned(), outcome.to_owned()]
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
    row.cells().join(",") + "\n"
}

/// The rows as a Markdown table.
pub(super) fn to_table(rows: &[PromiseRow]) -> String {
    let mut table = String::from(
        "| scene | promise | asked | got | frames | other process | outcome |\n|---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(table, "| {} |", row.cells().join(" | "));
    }
    table
}
