//! Lines of the lists in `prompts`.

/// The lines of a list that say something, trimmed, each with its number from 1: neither empty nor a comment (`# ..`).
pub(crate) fn list_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}
