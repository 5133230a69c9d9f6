//! JSON text in the order it is built, short lists and objects on one line: files that people read and edit.

use std::fmt::Write as _;

/// Longest object or list that stays on one line, in characters.
const MAX_LINE_CHARS: usize = 112;

/// A JSON value to be written. Numbers that are not finite become `null`.
#[derive(Debug, Clone)]
pub enum Json {
    /// A finished token: number, string, `true`, `null`.
    Token(String),
    /// A list.
    List(Vec<Json>),
    /// An object, fields in this order.
    Object(Vec<(String, Json)>),
}

/// An object from names and values.
pub fn object<const N: usize>(fields: [(&str, Json); N]) -> Json {
    Json::Object(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
}

impl Json {
    /// Makes `null`.
    pub const NULL: fn() -> Json = || Json::Token("null".to_owned());

    /// A list of values.
    pub fn list(items: impl IntoIterator<Item = impl Into<Json>>) -> Self {
        Self::List(items.into_iter().map(Into::into).collect())
    }

    /// The value's text; ends with a line feed.
    pub fn pretty(&self) -> String {
        let mut out = String::new();
        self.lay_out(0, &mut out);
        out.push('\n');
        out
    }

    fn compact(&self, out: &mut String) {
        match self {
            Self::Token(token) => out.push_str(token),
            Self::List(items) => {
                out.push('[');
                for (idx, item) in items.iter().enumerate() {
                    out.push_str(if idx == 0 { "" } else { ", " });
                    item.compact(out);
                }
                out.push(']');
            }
            Self::Object(fields) => {
                out.push('{');
                for (idx, (name, value)) in fields.iter().enumerate() {
                    let separator = if idx == 0 { "" } else { ", " };
                    let _ = write!(out, "{separator}{}: ", escaped(name));
                    value.compact(out);
                }
                out.push('}');
            }
        }
    }

    /// Characters left of `room` after the value on one line; `None` if it does not fit.
    fn fits(&self, room: usize) -> Option<usize> {
        match self {
            Self::Token(token) => room.checked_sub(token.len()),
            Self::List(items) => {
                items.iter().try_fold(room.checked_sub(2)?, |room, item| item.fits(room)?.checked_sub(2))
            }
            Self::Object(fields) => fields
                .iter()
                .try_fold(room.checked_sub(2)?, |room, (name, value)| value.fits(room)?.checked_sub(name.len() + 6)),
        }
    }

    fn lay_out(&self, indent: usize, out: &mut String) {
        let (open, close, len) = match self {
            Self::List(items) => ('[', ']', items.len()),
            Self::Object(fields) => ('{', '}', fields.len()),
            Self::Token(token) => return out.push_str(token),
        };
        if self.fits(MAX_LINE_CHARS.saturating_sub(indent)).is_some() {
            return self.compact(out);
        }
        if let Self::List(items) = self
            && items.iter().all(|item| matches!(item, Self::Token(_)))
        {
            return fill(items, indent + 2, out);
        }
        out.push(open);
        for idx in 0..len {
            let separator = if idx == 0 { "" } else { "," };
            let _ = write!(out, "{separator}\n{:indent$}", "", indent = indent + 2);
            match self {
                Self::List(items) => items[idx].lay_out(indent + 2, out),
                Self::Object(fields) => {
                    let _ = write!(out, "{}: ", escaped(&fields[idx].0));
                    fields[idx].1.lay_out(indent + 2, out);
                }
                Self::Token(_) => {}
            }
        }
        let _ = write!(out, "\n{:indent$}{close}", "");
    }
}

/// A list of tokens, as many on a line as fit.
fn fill(items: &[Json], indent: usize, out: &mut String) {
    let mut room = 0;
    out.push('[');
    for (idx, item) in items.iter().enumerate() {
        let Json::Token(token) = item else { continue };
        let separator = if idx == 0 { "" } else { "," };
        if token.len() + 2 > room {
            let _ = write!(out, "{separator}\n{:indent$}{token}", "");
            room = MAX_LINE_CHARS.saturating_sub(indent + token.len());
        } else {
            let _ = write!(out, "{separator} {token}");
            room -= token.len() + 2;
        }
    }
    let _ = write!(out, "\n{:1$}]", "", indent - 2);
}

/// A JSON string with quotes.
fn escaped(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

impl From<f64> for Json {
    fn from(value: f64) -> Self {
        // `{:?}` is the shortest text that reads back to the same bits, and always valid JSON for finite numbers.
        Self::Token(if value.is_finite() { format!("{value:?}") } else { "null".to_owned() })
    }
}

impl From<u64> for Json {
    fn from(value: u64) -> Self {
        Self::Token(value.to_string())
    }
}

impl From<u32> for Json {
    fn from(value: u32) -> Self {
        Self::Token(value.to_string())
    }
}

impl From<usize> for Json {
    fn from(value: usize) -> Self {
        Self::Token(value.to_string())
    }
}

impl From<bool> for Json {
    fn from(value: bool) -> Self {
        Self::Token(value.to_string())
    }
}

impl From<&str> for Json {
    fn from(value: &str) -> Self {
        Self::Token(escaped(value))
    }
}

impl<T: Into<Json>> From<Option<T>> for Json {
    fn from(value: Option<T>) -> Self {
        value.map_or_else(Json::NULL, Into::into)
    }
}

impl From<glam::DVec3> for Json {
    fn from(value: glam::DVec3) -> Self {
        Self::list(value.to_array())
    }
}

impl From<glam::DQuat> for Json {
    /// In the order x, y, z, w.
    fn from(value: glam::DQuat) -> Self {
        Self::list(value.to_array())
    }
}

/// A 4 x 4 matrix as nested rows.
pub fn matrix_rows(matrix: glam::DMat4) -> Json {
    Json::list((0..4).map(|row| Json::list(matrix.row(row).to_array())))
}

/// The 16 numbers of a 4 x 4 matrix, row by row.
pub fn matrix_flat(matrix: glam::DMat4) -> Json {
    Json::list(matrix.transpose().to_cols_array())
}
