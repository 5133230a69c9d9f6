use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::console;
use super::failure::{Exit, Failure};
use cinesplat::evaluation::{BatchRow, EvalSettings, EvaluationError, Trajectory, evaluate};

/// Compares the files of two folders that have the same name up to the first dot.
pub(super) fn compare(
    [reference, estimate]: [&Path; 2],
    settings: &EvalSettings,
    read: impl Fn(&Path) -> Result<Trajectory, Failure>,
) -> Result<Vec<BatchRow>, Failure> {
    let (references, mut estimates) = (by_stem(reference)?, by_stem(estimate)?);
    let mut rows = Vec::new();
    for (stem, path) in &references {
        let Some(partner) = estimates.remove(stem) else {
            console::note(&format!("note: {} has no partner in {}", path.display(), estimate.display()));
            continue;
        };
        let unreadable =
            |failure: Failure| EvaluationError::Unreadable { reason: failure.to_string().replace('\n', "; ") };
        let outcome = read(path)
            .and_then(|reference| Ok((reference, read(&partner)?)))
            .map_err(unreadable)
            .and_then(|(reference, estimate)| evaluate(&reference, &estimate, settings));
        rows.push(BatchRow { name: stem.clone(), outcome });
    }
    for path in estimates.values() {
        console::note(&format!("note: {} has no partner in {}", path.display(), reference.display()));
    }
    if rows.is_empty() {
        let found = format!("{} and {}: no files of one name, expected pairs", reference.display(), estimate.display());
        return Err(Failure::new(
            "NO-PAIRS",
            found,
            "files are paired by their names up to the first dot",
            Exit::BadData,
        ));
    }
    Ok(rows)
}

/// Files of a folder by their names up to the first dot; of two with one name the later in the alphabet.
fn by_stem(folder: &Path) -> Result<BTreeMap<String, PathBuf>, Failure> {
    let failed = |error: std::io::Error| Failure::io(&folder.display().to_string(), &error);
    let entries = std::fs::read_dir(folder).map_err(failed)?.collect::<Result<Vec<_>, _>>().map_err(failed)?;
    let mut paths: Vec<PathBuf> = entries.into_iter().map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    paths.sort();
    let stem = |path: &PathBuf| {
        let name = path.file_name()?.to_str()?;
        name.split('.').next().filter(|stem| !stem.is_empty()).map(str::to_owned)
    };
    Ok(paths.into_iter().filter_map(|path| Some((stem(&path)?, path))).collect())
}
