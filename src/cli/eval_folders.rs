use std::path::{Path, PathBuf};

use super::console;
use super::failure::{Exit, Failure};
use cinesplat::evaluation::{BatchRow, EvalSettings, EvaluationError, Role, Trajectory, evaluate, pair_files};

/// Compares the files of two folders that have the same name up to the first dot.
pub(super) fn compare(
    [reference, estimate]: [&Path; 2],
    settings: &EvalSettings,
    read: impl Fn(&Path, Role) -> Result<Trajectory, Failure>,
) -> Result<Vec<BatchRow>, Failure> {
    let found = pair_files(&files_in(reference)?, &files_in(estimate)?)?;
    for (lone, other) in [(&found.lone_references, estimate), (&found.lone_estimates, reference)] {
        for path in lone {
            console::note(&format!("note: {} has no partner in {}", path.display(), other.display()));
        }
    }
    let unreadable = |failure: Failure| EvaluationError::Unreadable { reason: failure.to_string().replace('\n', "; ") };
    let mut rows = Vec::with_capacity(found.pairs.len());
    for (name, [reference, estimate]) in found.pairs {
        let outcome = read(&reference, Role::Reference)
            .and_then(|reference| Ok((reference, read(&estimate, Role::Estimate)?)))
            .map_err(unreadable)
            .and_then(|(reference, estimate)| evaluate(&reference, &estimate, settings));
        rows.push(BatchRow { name, outcome });
    }
    if rows.is_empty() {
        let found =
            format!("{} and {}: no files with the same name, expected pairs", reference.display(), estimate.display());
        return Err(Failure::new(
            "NO-PAIRS",
            found,
            "files are paired by their names up to the first dot",
            Exit::BadData,
        ));
    }
    Ok(rows)
}

/// The files of a folder, sorted by path.
fn files_in(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let failed = |error: std::io::Error| Failure::io(&folder.display().to_string(), &error);
    let entries = std::fs::read_dir(folder).map_err(failed)?.collect::<Result<Vec<_>, _>>().map_err(failed)?;
    let mut paths: Vec<PathBuf> = entries.into_iter().map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    paths.sort();
    Ok(paths)
}
