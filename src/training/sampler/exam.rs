//! The exam: hand-written sentences, labeled with their programs, never used for training.

use super::labeled_prompt::LabeledPrompt;
use cinesplat_language::{LanguageError, NamedObject, program_from_notation};

const FILE: &str = "prompts/heldout.txt";
static TEXT: &str = include_str!("../../../prompts/heldout.txt");

/// The objects of the exam's sentences.
///
/// # Errors
/// [`LanguageError::BadData`] with the first malformed line of the embedded file.
pub fn exam_objects() -> Result<Vec<NamedObject>, LanguageError> {
    lines()
        .filter_map(|(line, text)| text.strip_prefix("object ").map(|rest| (line, rest)))
        .map(|(line, rest)| {
            let bad = || LanguageError::BadData { file: FILE, line, what: format!("object \"{rest}\"") };
            let (id, label) = rest.split_once(' ').unwrap_or((rest, ""));
            Ok(NamedObject { id: id.parse().map_err(|_| bad())?, label: label.to_owned() })
        })
        .collect()
}

/// The sentences of the exam; their programs use the ids of [`exam_objects`].
///
/// # Errors
/// [`LanguageError::BadData`] with the first line of the embedded file that is not `prompt => program`.
pub fn exam() -> Result<Vec<LabeledPrompt>, LanguageError> {
    lines()
        .filter(|(_, text)| !text.starts_with("object "))
        .map(|(line, text)| {
            let bad = |what: String| LanguageError::BadData { file: FILE, line, what };
            let (prompt, program) = text.rsplit_once(" => ").ok_or_else(|| bad("no => in the line".to_owned()))?;
            let program = program_from_notation(program.trim()).map_err(|error| bad(error.to_string()))?;
            Ok(LabeledPrompt { prompt: prompt.trim().to_owned(), program })
        })
        .collect()
}

/// Numbers, from 1, and text of the lines that are neither empty nor comments.
fn lines() -> impl Iterator<Item = (usize, &'static str)> {
    let numbered = TEXT.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    numbered.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}
