//! Comparisons of many files: pairs of files by name, and one table of the results.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use super::{Evaluation, EvaluationError};
use cinesplat_export::json_write::{Json, object};

/// One comparison of many.
#[derive(Debug, Clone)]
pub struct BatchRow {
    /// Name of the pair.
    pub name: String,
    /// The result.
    pub outcome: Result<Evaluation, EvaluationError>,
}

/// The files of two folders, paired by stem: the name up to the first dot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FilePairs {
    /// Stem, reference and estimate of each pair, in order of the stems.
    pub pairs: Vec<(String, [PathBuf; 2])>,
    /// References without an estimate of the same stem.
    pub lone_references: Vec<PathBuf>,
    /// Estimates without a reference of the same stem.
    pub lone_estimates: Vec<PathBuf>,
}

/// Pairs references with estimates of the same stem. Files whose name has no stem (`.hidden`) are skipped.
///
/// # Errors
/// [`EvaluationError::SameStem`] for two files of one list with the same stem, because the pair is ambiguous.
pub fn pair_files(references: &[PathBuf], estimates: &[PathBuf]) -> Result<FilePairs, EvaluationError> {
    let (references, mut estimates) = (by_stem(references)?, by_stem(estimates)?);
    let (mut pairs, mut lone_references) = (Vec::new(), Vec::new());
    for (stem, reference) in references {
        match estimates.remove(&stem) {
            Some(estimate) => pairs.push((stem, [reference, estimate])),
            None => lone_references.push(reference),
        }
    }
    Ok(FilePairs { pairs, lone_references, lone_estimates: estimates.into_values().collect() })
}

fn by_stem(paths: &[PathBuf]) -> Result<BTreeMap<String, PathBuf>, EvaluationError> {
    let stem = |path: &Path| {
        let name = path.file_name()?.to_str()?;
        name.split('.').next().filter(|stem| !stem.is_empty()).map(str::to_owned)
    };
    let mut found: BTreeMap<String, PathBuf> = BTreeMap::new();
    for path in paths {
        let Some(stem) = stem(path) else { continue };
        if let Some(first) = found.insert(stem.clone(), path.clone()) {
            return Err(EvaluationError::SameStem { stem, files: [first, path.clone()] });
        }
    }
    Ok(found)
}

const COLUMNS: &str =
    "name,pairs,matched,dropped_reference,dropped_estimate,scale,rmse,mean,median,std,min,max,sse,error\n";

/// A CSV table, one line per comparison. A failed one has only a name and the error.
pub fn summary_csv(rows: &[BatchRow]) -> String {
    let mut out = COLUMNS.to_owned();
    for row in rows {
        let name = quoted(&row.name);
        match &row.outcome {
            Ok(result) => {
                let counts = [
                    result.errors.len(),
                    result.matches.reference.len(),
                    result.matches.dropped_reference,
                    result.matches.dropped_estimate,
                ];
                let counts = counts.map(|count| count.to_string()).join(",");
                let numbers = result.statistics.named().map(|(_, value)| value.to_string()).join(",");
                let _ = writeln!(out, "{name},{counts},{},{numbers},", result.alignment.scale);
            }
            Err(error) => {
                let _ = writeln!(out, "{name},,,,,,,,,,,,,{}", quoted(&error.to_string()));
            }
        }
    }
    out
}

/// The comparisons as aligned text, under a line that says what is measured and in which unit, with a summary line.
pub fn summary_text(rows: &[BatchRow]) -> String {
    let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0).max(6);
    let first = rows.iter().find_map(|row| row.outcome.as_ref().ok());
    let mut out = first.map_or_else(String::new, |found| found.measure() + "\n");
    let _ = write!(out, "{:<width$} {:>7}", "name", "pairs");
    for name in ["rmse", "mean", "median", "std", "min", "max"] {
        let _ = write!(out, " {name:>12}");
    }
    out.push('\n');
    for row in rows {
        let _ = write!(out, "{:<width$} ", row.name);
        match &row.outcome {
            Ok(result) => {
                let _ = write!(out, "{:>7}", result.errors.len());
                for (_, value) in result.statistics.named().iter().filter(|(name, _)| *name != "sse") {
                    let _ = write!(out, " {value:>12.6}");
                }
            }
            Err(error) => out.push_str(&error.to_string()),
        }
        out.push('\n');
    }
    let all = rmse_sorted(rows);
    let show = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.6}"));
    let (mean, worst) = (show(mean_of(&all)), show(all.last().copied()));
    let failed = rows.len() - all.len();
    let _ = writeln!(
        out,
        "{} compared, {failed} failed; rmse mean {mean}, median {}, worst {worst}",
        all.len(),
        show(median_of(&all))
    );
    out
}

/// The comparisons as JSON text: a list of objects under `pairs`, and under `over_all` the mean, median and largest
/// of their root mean squares.
pub fn summary_json(rows: &[BatchRow]) -> String {
    let row = |row: &BatchRow| match &row.outcome {
        Ok(result) => {
            let mut fields =
                vec![("name".to_owned(), row.name.as_str().into()), ("pairs".to_owned(), result.errors.len().into())];
            fields.extend(result.statistics.named().map(|(name, value)| (name.to_owned(), value.into())));
            fields.extend(result.settings_json());
            let counts = [
                ("matched", result.matches.reference.len()),
                ("dropped_reference", result.matches.dropped_reference),
                ("dropped_estimate", result.matches.dropped_estimate),
            ];
            fields.extend(counts.map(|(name, count)| (name.to_owned(), count.into())));
            fields.push(("notes".to_owned(), Json::list(result.notes.iter().map(String::as_str))));
            Json::Object(fields)
        }
        Err(error) => object([("name", row.name.as_str().into()), ("error", error.to_string().as_str().into())]),
    };
    let all = rmse_sorted(rows);
    let over_all = object([
        ("compared", all.len().into()),
        ("failed", (rows.len() - all.len()).into()),
        ("mean_rmse", mean_of(&all).into()),
        ("median_rmse", median_of(&all).into()),
        ("worst_rmse", all.last().copied().into()),
    ]);
    object([("pairs", Json::list(rows.iter().map(row))), ("over_all", over_all)]).pretty()
}

/// Sorted root mean squares of the successful comparisons.
fn rmse_sorted(rows: &[BatchRow]) -> Vec<f64> {
    let mut all: Vec<f64> = rows.iter().filter_map(|row| Some(row.outcome.as_ref().ok()?.statistics.rmse)).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn mean_of(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

fn median_of(sorted: &[f64]) -> Option<f64> {
    let upper = sorted.get(sorted.len() / 2)?;
    sorted.get((sorted.len() - 1) / 2).map(|lower| f64::midpoint(*lower, *upper))
}

/// A CSV cell, in quotes if it contains a separator, a quote or a line feed.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
