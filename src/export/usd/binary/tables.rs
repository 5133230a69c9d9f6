//! The tables of a layer in the binary form.

use std::cell::Cell;

use cinesplat_files::Limits;

use super::super::super::bytes::Bytes;
use super::damage::damaged;
use super::packing::{count, unpacked, whole_numbers};
use super::paths::{self, PathEntry};
use crate::ExportError;

/// Where the version and the place of the list of sections stand.
const VERSION_AT: usize = 8;
const SECTIONS_AT: usize = 16;
/// Versions 0.x that are read. Older ones have other tables.
const MINORS: std::ops::RangeInclusive<u8> = 4..=13;
/// Ends a list of fields.
const END_OF_FIELDS: u32 = u32::MAX;
/// Most numbers that all values may be decoded to: a million poses as matrices.
const MAX_NUMBERS: u64 = 17_000_000;

/// What a path holds: an index into the lists of fields, and its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Spec {
    pub(super) fields: u32,
    pub(super) kind: u32,
}

impl Spec {
    pub(super) const ATTRIBUTE: u32 = 1;
    pub(super) const PRIM: u32 = 6;
    pub(super) const LAYER: u32 = 7;
}

/// The tables of a layer.
pub(super) struct Tables<'a> {
    pub(super) bytes: &'a [u8],
    /// The version is 0.`minor`.
    pub(super) minor: u8,
    /// All tokens.
    text: String,
    /// Where each token ends; a zero follows.
    token_ends: Vec<u32>,
    /// Strings as indices of tokens.
    strings: Vec<u32>,
    /// Names as indices of tokens, and values.
    fields: Vec<(u32, u64)>,
    field_lists: Vec<u32>,
    pub(super) paths: Vec<Option<PathEntry>>,
    /// By path.
    pub(super) specs: Vec<Option<Spec>>,
    /// Numbers that may still be decoded: values may share their bytes.
    numbers_left: Cell<u64>,
}

impl<'a> Tables<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, ExportError> {
        let [major, minor] = Bytes::at(bytes, VERSION_AT).array()?;
        if major != 0 || !MINORS.contains(&minor) {
            let reason = format!(
                "version {major}.{minor} of the binary form is not read: `usdcat in.usdc -o out.usda` (of usd-core) makes \
                 the text form, which is"
            );
            return Err(ExportError::NotReadable { format: "usd", reason });
        }
        let most = Limits::DEFAULT.unpacked(bytes.len());
        let section = |name: &str| section(bytes, name);
        let mut tokens = section("TOKENS")?;
        let num_tokens = count(&mut tokens, 1, most)?;
        let length = tokens.u64()?.min(most);
        let offset = tokens.position();
        // A zero byte stands in no character of several bytes: each token is text where all of them are.
        let text = String::from_utf8(unpacked(&mut tokens, length as usize)?);
        let text = text.map_err(|error| damaged(offset, error.to_string(), "names in UTF-8"))?;
        let ends = text.bytes().zip(0_u32..).filter(|(byte, _)| *byte == 0).map(|(_, at)| at);
        let token_ends = ends.take(num_tokens).collect();
        let mut strings = section("STRINGS")?;
        let strings = (0..count(&mut strings, 4, most)?).map(|_| strings.u32()).collect::<Result<_, _>>()?;
        let mut fields = section("FIELDS")?;
        let num_fields = count(&mut fields, 8, most)?;
        let names = whole_numbers(&mut fields, num_fields)?;
        let values = unpacked(&mut fields, 8 * num_fields)?;
        let values = values.as_chunks::<8>().0.iter().map(|value| u64::from_le_bytes(*value));
        let mut field_lists = section("FIELDSETS")?;
        let num_lists = count(&mut field_lists, 4, most)?;
        let paths = paths::read(&mut section("PATHS")?, most)?;
        Ok(Self {
            bytes,
            minor,
            text,
            token_ends,
            strings,
            fields: names.into_iter().zip(values).collect(),
            field_lists: whole_numbers(&mut field_lists, num_lists)?,
            specs: specs(&mut section("SPECS")?, paths.len(), most)?,
            paths,
            numbers_left: Cell::new((most / 8).min(MAX_NUMBERS)),
        })
    }

    /// The token of an index.
    pub(super) fn token(&self, idx: u32) -> Result<&str, ExportError> {
        let idx = idx as usize;
        let text = self.token_ends.get(idx).and_then(|end| {
            let start = idx.checked_sub(1).map_or(0, |before| self.token_ends[before] as usize + 1);
            self.text.get(start..*end as usize)
        });
        let text =
            text.ok_or_else(|| damaged(0, format!("token {idx}"), format!("one of {} texts", self.token_ends.len())))?;
        self.spend(text.len() as u64 / 64)?;
        Ok(text)
    }

    /// The string of an index.
    pub(super) fn string(&self, idx: u32) -> Result<&str, ExportError> {
        let token = self.strings.get(idx as usize).copied();
        self.token(token.ok_or_else(|| damaged(0, format!("string {idx}"), format!("one of {}", self.strings.len())))?)
    }

    /// Counts numbers that are decoded.
    pub(super) fn spend(&self, num: u64) -> Result<(), ExportError> {
        let left = self.numbers_left.get().checked_sub(num);
        self.numbers_left.set(left.ok_or_else(|| damaged(0, "more values", "values that fit the size of the file"))?);
        Ok(())
    }

    /// The names and values of a spec's fields.
    pub(super) fn fields(&self, spec: Spec) -> Result<Vec<(&str, u64)>, ExportError> {
        let list = self.field_lists.get(spec.fields as usize..).unwrap_or_default();
        let mut fields = Vec::new();
        for idx in list.iter().take_while(|idx| **idx != END_OF_FIELDS) {
            self.spend(1)?;
            let field = self.fields.get(*idx as usize);
            let (name, value) = field
                .ok_or_else(|| damaged(0, format!("field {idx}"), format!("one of {} fields", self.fields.len())))?;
            fields.push((self.token(*name)?, *value));
        }
        Ok(fields)
    }

    /// The value of a spec's field.
    pub(super) fn field(&self, spec: Spec, name: &str) -> Result<Option<u64>, ExportError> {
        Ok(self.fields(spec)?.into_iter().find(|(found, _)| *found == name).map(|(_, value)| value))
    }
}

/// The bytes of a section.
fn section<'a>(bytes: &'a [u8], name: &str) -> Result<Bytes<'a>, ExportError> {
    let at = Bytes::at(bytes, SECTIONS_AT).u64()?;
    let mut list = Bytes::at(bytes, usize::try_from(at).unwrap_or(usize::MAX));
    for _ in 0..list.u64()? {
        let found: [u8; 16] = list.array()?;
        let (start, size) = (list.u64()?, list.u64()?);
        if found.strip_prefix(name.as_bytes()).is_some_and(|rest| rest.iter().all(|byte| *byte == 0)) {
            let mut from_start = Bytes::at(bytes, usize::try_from(start).unwrap_or(usize::MAX));
            from_start.take(size)?;
            return Ok(Bytes::at(bytes, start as usize));
        }
    }
    Err(damaged(at as usize, "a list without it", format!("the section {name}")))
}

/// The specs by path.
fn specs(section: &mut Bytes<'_>, num_paths: usize, most: u64) -> Result<Vec<Option<Spec>>, ExportError> {
    let num = count(section, 4, most)?;
    let (paths, fields, kinds) =
        (whole_numbers(section, num)?, whole_numbers(section, num)?, whole_numbers(section, num)?);
    let mut specs = vec![None; num_paths];
    for ((path, fields), kind) in paths.into_iter().zip(fields).zip(kinds) {
        let spec = specs.get_mut(path as usize);
        *spec.ok_or_else(|| damaged(section.position(), format!("path {path}"), format!("one of {num_paths}")))? =
            Some(Spec { fields, kind });
    }
    Ok(specs)
}
