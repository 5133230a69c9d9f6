//! Parsing of text formats with one pose per line.

use super::ExportError;
use super::json_read::quoted;

/// Lines with data and their numbers from 1, without comments (`#`, and `%` of MATLAB) and empty lines.
pub(super) fn data_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let numbered = all_lines(text).enumerate().map(|(idx, line)| (idx + 1, line));
    numbered.filter(|(_, line)| !line.is_empty() && !is_comment(line))
}

/// Whether a line is a comment.
pub(super) fn is_comment(line: &str) -> bool {
    line.starts_with(['#', '%'])
}

/// A table without its first column, if that has no name and the others have names: the index that pandas writes.
pub(super) fn without_index(text: &str) -> Option<String> {
    let mut lines = data_lines(text);
    let (first, header) = lines.next()?;
    let separator = header.chars().next().filter(|first| [',', ';'].contains(first))?;
    if !is_names(&header[1..]) {
        return None;
    }
    let after_index = |line: &str| line.split_once(separator).map_or("", |(_, rest)| rest).to_owned();
    // The lines keep their numbers.
    let is_whole = |idx: usize, line: &str| idx + 1 < first || is_comment(line);
    let kept = |(idx, line): (usize, &str)| if is_whole(idx, line) { line.to_owned() } else { after_index(line) };
    Some(all_lines(text).enumerate().map(kept).collect::<Vec<_>>().join("\n"))
}

/// All lines without the white space around them. A line ends with `\n`, `\r\n` or `\r`, also in one text.
pub(super) fn all_lines(text: &str) -> impl Iterator<Item = &str> {
    let text = text.trim_start_matches('\u{feff}');
    text.split('\n').flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r')).map(str::trim)
}

/// An error at a line.
pub(super) fn bad_line(line: usize, found: &str, expected: impl Into<String>) -> ExportError {
    ExportError::BadLine { line, found: format!("\"{}\"", quoted(found)), expected: expected.into() }
}

/// The finite number in a column.
pub(super) fn number(line: usize, column: &str) -> Result<f64, ExportError> {
    let value = column.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    value.ok_or_else(|| bad_line(line, column, "a finite number"))
}

/// The columns of a line: between semicolons, commas or white space, whichever is first found in this order. Separators
/// at the end are dropped.
pub(super) fn cells(line: &str) -> Vec<&str> {
    let line = line.trim_end_matches(|c: char| c.is_whitespace() || c == ',' || c == ';');
    match [';', ','].into_iter().find(|separator| line.contains(*separator)) {
        Some(separator) => line.split(separator).map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    }
}

/// Whether a line has at least eight columns and none of them is a number: names of columns.
pub(super) fn is_names(line: &str) -> bool {
    let cells = cells(line);
    cells.len() >= 8 && cells.iter().all(|cell| cell.parse::<f64>().is_err())
}

/// Exactly `N` numbers in the columns of a line.
pub(super) fn numbers<const N: usize>(line: usize, text: &str) -> Result<[f64; N], ExportError> {
    let columns = cells(text);
    if columns.len() != N {
        return Err(bad_line(line, text, format!("{N} columns, not {}", columns.len())));
    }
    let mut values = [0.0; N];
    for (value, column) in values.iter_mut().zip(columns) {
        *value = number(line, column)?;
    }
    Ok(values)
}

/// Numbers joined by a separator, each with enough digits to read back the same value.
pub(super) fn joined(values: impl IntoIterator<Item = f64>, separator: &str) -> String {
    values.into_iter().map(|value| format!("{value}")).collect::<Vec<_>>().join(separator)
}
