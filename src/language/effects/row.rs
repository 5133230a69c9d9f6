//! What the phrases of one line of the table mean.

/// What a phrase does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    /// It calls for its effects; negated it forbids them.
    Calls,
    /// It calls for its effects unless other words forbid them.
    Suggests,
    /// It forbids its effects.
    Forbids,
    /// Negated it forbids its effects.
    ForbidsIfNegated,
    /// It only looks like an effect.
    Nothing,
}

/// One line of the table, without its phrases.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) meaning: Meaning,
    /// Names of its effects.
    pub(super) names: Vec<String>,
    /// Settings; `None` takes the number in the phrase, times the sign beside it.
    pub(super) settings: Vec<(String, Option<f64>, f64)>,
}

/// The meaning of the part of a line before its colon: `-NAME -NAME x=1 y=-#`.
///
/// # Errors
/// A reason for a setting without a number.
pub(super) fn row_of(head: &str) -> Result<Row, &'static str> {
    let mut row = Row { meaning: Meaning::Calls, names: Vec::new(), settings: Vec::new() };
    for part in head.split_whitespace() {
        if let Some((name, value)) = part.split_once('=') {
            let sign = if value.starts_with('-') { -1.0 } else { 1.0 };
            let digits = value.trim_start_matches('-');
            let fixed =
                if digits == "#" { None } else { Some(digits.parse().map_err(|_| "a setting without a number")?) };
            row.settings.push((name.to_owned(), fixed, sign));
            continue;
        }
        let (meaning, name) = match part.split_at(1) {
            ("!", "") => (Meaning::Nothing, ""),
            ("~", name) => (Meaning::Suggests, name),
            ("-", name) => (Meaning::Forbids, name),
            ("?", name) => (Meaning::ForbidsIfNegated, name),
            _ => (Meaning::Calls, part),
        };
        row.meaning = meaning;
        row.names.extend((!name.is_empty()).then(|| name.to_owned()));
    }
    Ok(row)
}
