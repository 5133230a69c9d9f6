//! JSON reading with errors that name the place: `keyframes[3].position: found "x", expected 3 finite numbers`.

use std::str::FromStr;

use cinesplat_files::{Limits, UnknownKeys, json_excess, misspelling};
use glam::{DMat4, DVec3};
use serde_json::Value;
use strum::VariantNames;

use super::ExportError;

/// Longest piece of a file in an error message, characters.
const MAX_QUOTED_CHARS: usize = 60;

/// A JSON value and its place in the file.
#[derive(Debug, Clone)]
pub(super) struct Node<'a> {
    value: &'a Value,
    place: String,
}

/// Parses JSON text. Depth and memory are limited ([`Limits`]), and numbers to `f64`.
pub(super) fn parse(text: &str) -> Result<Value, ExportError> {
    if let Some(reason) = json_excess(text.as_bytes(), &Limits::DEFAULT) {
        return Err(ExportError::NotJson { reason });
    }
    serde_json::from_str(text.trim_start_matches('\u{feff}'))
        .map_err(|error| ExportError::NotJson { reason: error.to_string() })
}

/// Text for an error message: on one line, shortened to the maximum length.
pub(super) fn quoted(text: &str) -> String {
    let mut short: String = text.chars().take(MAX_QUOTED_CHARS).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if short.len() < text.len() {
        short.push_str("..");
    }
    short
}

impl<'a> Node<'a> {
    pub(super) fn root(value: &'a Value) -> Self {
        Self { value, place: String::new() }
    }

    /// An error at this place.
    pub(super) fn error(&self, expected: impl Into<String>) -> ExportError {
        let place = if self.place.is_empty() { "top level".to_owned() } else { self.place.clone() };
        ExportError::BadField { place, found: quoted(&self.value.to_string()), expected: expected.into() }
    }

    fn place_of(&self, name: &str) -> String {
        if self.place.is_empty() { name.to_owned() } else { format!("{}.{name}", self.place) }
    }

    /// The field of an object; `null` counts as absent.
    pub(super) fn optional(&self, name: &str) -> Option<Self> {
        let value = self.value.get(name).filter(|value| !value.is_null())?;
        Some(Self { value, place: self.place_of(name) })
    }

    pub(super) fn field(&self, name: &str, expected: &str) -> Result<Self, ExportError> {
        if !self.value.is_object() {
            return Err(self.error("an object"));
        }
        self.optional(name).ok_or_else(|| {
            let misspelled = misspelling(name, self.keys());
            let found = misspelled.map_or_else(|| "nothing".to_owned(), |key| format!("nothing but the key {key}"));
            ExportError::BadField { place: self.place_of(name), found, expected: expected.into() }
        })
    }

    fn keys(&self) -> impl Iterator<Item = &'a str> {
        self.value.as_object().into_iter().flat_map(|object| object.keys().map(String::as_str))
    }

    /// Notes the keys of an object that its reader does not know.
    pub(super) fn note_unknown(&self, known: &[&str], unknown: &mut UnknownKeys) {
        unknown.check(&self.place, self.keys(), known);
    }

    /// The place for a message, such as `keyframes[3].position`.
    pub(super) fn place(&self) -> &str {
        &self.place
    }

    pub(super) fn items(&self) -> Result<Vec<Self>, ExportError> {
        let items = self.value.as_array().ok_or_else(|| self.error("a list"))?;
        let place = |idx: usize| format!("{}[{idx}]", self.place);
        Ok(items.iter().enumerate().map(|(idx, value)| Self { value, place: place(idx) }).collect())
    }

    /// Name and value of every field of an object, in the parser's order.
    pub(super) fn fields(&self) -> Vec<(&'a str, Self)> {
        let object = self.value.as_object();
        let node = |(name, value): (&'a String, &'a Value)| (name.as_str(), Self { value, place: self.place_of(name) });
        object.map(|fields| fields.iter().map(node).collect()).unwrap_or_default()
    }

    pub(super) fn number(&self) -> Result<f64, ExportError> {
        self.value.as_f64().filter(|v| v.is_finite()).ok_or_else(|| self.error("a finite number"))
    }

    pub(super) fn whole(&self, max: u64) -> Result<u64, ExportError> {
        let whole = self.value.as_u64().or_else(|| {
            // Other programs write 1280.0 for 1280.
            self.value.as_f64().filter(|v| v.fract() == 0.0 && (0.0..9.0e15).contains(v)).map(|v| v as u64)
        });
        whole.filter(|v| *v <= max).ok_or_else(|| self.error(format!("a whole number 0..{max}")))
    }

    pub(super) fn pixels(&self) -> Result<u32, ExportError> {
        self.whole(u64::from(u32::MAX)).map(|v| v as u32)
    }

    pub(super) fn text(&self) -> Result<&'a str, ExportError> {
        self.value.as_str().ok_or_else(|| self.error("a string"))
    }

    /// The choice that a string names.
    pub(super) fn choice<T: FromStr + VariantNames>(&self) -> Result<T, ExportError> {
        self.text()?.parse().map_err(|_| self.error(format!("one of {}", T::VARIANTS.join(", "))))
    }

    pub(super) fn flag(&self) -> Result<bool, ExportError> {
        self.value.as_bool().ok_or_else(|| self.error("true or false"))
    }

    /// A list of exactly `N` finite numbers.
    pub(super) fn numbers<const N: usize>(&self) -> Result<[f64; N], ExportError> {
        let expected = || self.error(format!("{N} finite numbers"));
        let numbers = self.number_list().map_err(|_| expected())?;
        numbers.try_into().map_err(|_| expected())
    }

    /// A flat list of finite numbers of any length.
    pub(super) fn number_list(&self) -> Result<Vec<f64>, ExportError> {
        self.items()?.iter().map(Self::number).collect()
    }

    pub(super) fn vector(&self) -> Result<DVec3, ExportError> {
        self.numbers::<3>().map(DVec3::from_array)
    }

    /// A 4 x 4 or 3 x 4 matrix, nested rows or flat, row-major.
    pub(super) fn matrix(&self) -> Result<DMat4, ExportError> {
        let expected = || self.error("a 4 x 4 or 3 x 4 matrix, row-major");
        let rows = self.items().map_err(|_| expected())?;
        let mut flat = Vec::with_capacity(16);
        for row in &rows {
            match row.value {
                Value::Array(_) => flat.extend(row.number_list().map_err(|_| expected())?),
                _ => flat.push(row.number().map_err(|_| expected())?),
            }
        }
        matrix_from_rows(&flat).ok_or_else(expected)
    }
}

/// The matrix of 12 or 16 numbers in row-major order; `None` for another count or a last row that is not 0 0 0 1.
pub(super) fn matrix_from_rows(rows: &[f64]) -> Option<DMat4> {
    let mut full = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    if rows.len() != 12 && rows.len() != 16 {
        return None;
    }
    full.get_mut(..rows.len())?.copy_from_slice(rows);
    let bottom = [full[12], full[13], full[14], full[15]];
    let is_affine = bottom.iter().zip([0.0, 0.0, 0.0, 1.0]).all(|(found, wanted)| (found - wanted).abs() < 1e-9);
    is_affine.then(|| DMat4::from_cols_array(&full).transpose())
}
