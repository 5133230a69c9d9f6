//! Comparisons as a table for a text: Markdown or LaTeX.

use std::fmt::Write as _;

use super::{BatchRow, Statistics};
use cinesplat_plot::significant;

/// Digits of a number in a table.
const DIGITS: usize = 4;
/// Statistics of a table, the first of which decides which row is best.
const COLUMNS: [&str; 6] = ["rmse", "mean", "median", "std", "min", "max"];

fn cells(statistics: &Statistics) -> [String; 6] {
    let named = statistics.named();
    let value = |name: &str| named.iter().find(|(found, _)| *found == name).map_or(f64::NAN, |(_, value)| *value);
    COLUMNS.map(|name| significant(value(name), DIGITS))
}

/// Index of the row with the smallest root mean square, of at least two.
fn best(rows: &[BatchRow]) -> Option<usize> {
    let rmse = |row: &BatchRow| row.outcome.as_ref().ok().map(|found| found.statistics.rmse);
    let found: Vec<(usize, f64)> = rows.iter().enumerate().filter_map(|(idx, row)| Some((idx, rmse(row)?))).collect();
    found.iter().min_by(|a, b| a.1.total_cmp(&b.1)).filter(|_| found.len() > 1).map(|(idx, _)| *idx)
}

/// What the table measures and in which unit: the first successful comparison says it.
fn caption(rows: &[BatchRow]) -> String {
    let first = rows.iter().find_map(|row| row.outcome.as_ref().ok());
    first.map_or_else(String::new, super::Evaluation::measure)
}

/// A Markdown table under a line that says what is measured; the best row is bold.
pub fn result_markdown(rows: &[BatchRow]) -> String {
    let mut out = format!("{}\n\n| estimate | pairs | {} |\n|---|---:|", caption(rows), COLUMNS.join(" | "));
    out += &("---:|".repeat(COLUMNS.len()) + "\n");
    let best = best(rows);
    for (idx, row) in rows.iter().enumerate() {
        let name = row.name.replace('|', "\\|");
        // Writing to a string cannot fail, here and below.
        let _ = match &row.outcome {
            Ok(found) => {
                let mut cells = cells(&found.statistics);
                if Some(idx) == best {
                    cells[0] = format!("**{}**", cells[0]);
                }
                writeln!(out, "| {name} | {} | {} |", found.errors.len(), cells.join(" | "))
            }
            Err(error) => writeln!(out, "| {name} | | {error} |{}", " |".repeat(COLUMNS.len() - 1)),
        };
    }
    out
}

/// A LaTeX table for the package `booktabs`; the best row is bold.
pub fn result_latex(rows: &[BatchRow]) -> String {
    let mut out = format!("% {}\n\\begin{{tabular}}{{lr{}}}\n\\toprule\n", caption(rows), "r".repeat(COLUMNS.len()));
    let _ = writeln!(out, "estimate & pairs & {} \\\\\n\\midrule", COLUMNS.join(" & "));
    let best = best(rows);
    for (idx, row) in rows.iter().enumerate() {
        let name = latex(&row.name);
        let _ = match &row.outcome {
            Ok(found) => {
                let mut cells = cells(&found.statistics);
                if Some(idx) == best {
                    cells[0] = format!("\\textbf{{{}}}", cells[0]);
                }
                writeln!(out, "{name} & {} & {} \\\\", found.errors.len(), cells.join(" & "))
            }
            Err(error) => {
                writeln!(
                    out,
                    "{name} & \\multicolumn{{{}}}{{l}}{{{}}} \\\\",
                    COLUMNS.len() + 1,
                    latex(&error.to_string())
                )
            }
        };
    }
    out + "\\bottomrule\n\\end{tabular}\n"
}

/// A text with the characters escaped that LaTeX reserves.
fn latex(text: &str) -> String {
    let escaped = |letter: char| match letter {
        '&' | '%' | '$' | '#' | '_' | '{' | '}' => format!("\\{letter}"),
        '~' => "\\textasciitilde{}".to_owned(),
        '^' => "\\textasciicircum{}".to_owned(),
        '\\' => "\\textbackslash{}".to_owned(),
        other => other.to_string(),
    };
    text.chars().map(escaped).collect()
}
