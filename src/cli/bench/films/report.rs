use std::fmt::Write as _;

use super::measure::FilmRow;

/// Header line of the CSV.
pub(super) const CSV_HEADER: &str =
    "scene,width,height,frames,quality,measure,secs,ms_a_frame,busy_secs,against,percent\n";

/// The rows as CSV with a header.
pub(super) fn to_csv(rows: &[FilmRow]) -> String {
    rows.iter().fold(CSV_HEADER.to_owned(), |csv, row| csv + &csv_line(row))
}

/// One row as a line of the CSV; cells without a meaning are empty.
pub(super) fn csv_line(row: &FilmRow) -> String {
    let busy = row.cpu_secs.map_or(String::new(), |secs| format!("{secs:.2}"));
    let (against, percent) = row.against.map_or_else(Default::default, |(what, p)| (what, format!("{p:.1}")));
    format!(
        "{},{},{},{},{},{},{:.3},{:.2},{busy},{against},{percent}\n",
        row.scene,
        row.size_px[0],
        row.size_px[1],
        row.num_frames,
        row.quality,
        row.measure,
        row.secs,
        ms_per_frame(row)
    )
}

/// The rows as a Markdown table.
pub(super) fn to_table(rows: &[FilmRow]) -> String {
    let mut table = String::from(
        "| scene | size | frames | quality | measure | s | ms per frame | against |\n|---|---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let against = row.against.map_or(String::new(), |(what, percent)| format!("{what}: {percent:+.1} %"));
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "| {} | {}x{} | {} | {} | {} | {:.2} | {:.1} | {against} |",
            row.scene,
            row.size_px[0],
            row.size_px[1],
            row.num_frames,
            row.quality,
            row.measure,
            row.secs,
            ms_per_frame(row)
        );
    }
    table
}

fn ms_per_frame(row: &FilmRow) -> f64 {
    row.secs * 1e3 / row.num_frames.max(1) as f64
}
