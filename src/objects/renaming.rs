//! Names that a person gives: `41=mug`, one per line of a file or one per flag.

use std::str::FromStr;

use super::object::ObjectSet;

/// A name for an object.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Renaming {
    /// Id of the object.
    pub id: u32,
    /// Its new name, not empty.
    pub name: String,
}

impl FromStr for Renaming {
    type Err = String;

    /// Parses `ID=NAME`; spaces around both are dropped, and so are quotes around the name.
    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || format!("expected ID=NAME such as 41=mug, found `{}`", text.trim());
        let (id, name) = text.split_once('=').ok_or_else(expected)?;
        let id = typed_id(id).ok_or_else(expected)?;
        let name = name.trim().trim_matches('"').trim();
        if name.is_empty() || name.chars().any(char::is_control) {
            return Err(expected());
        }
        Ok(Self { id, name: name.to_owned() })
    }
}

/// The id of an object as people type it: `41` or `<obj-41>`.
pub fn typed_id(text: &str) -> Option<u32> {
    let id = text.trim().trim_start_matches("<obj-").trim_end_matches('>');
    id.parse().ok().filter(|id| (1..=65535).contains(id))
}

impl Renaming {
    /// The names in a text, one per line. Empty lines and lines that start with `#` are skipped.
    ///
    /// # Errors
    /// The number of the first other line that is no `ID=NAME`, and what was expected.
    pub fn parse_lines(text: &str) -> Result<Vec<Self>, String> {
        // Editors of Windows begin a text with this mark.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
        let named = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        named.map(|(number, line)| line.parse().map_err(|error| format!("line {number}: {error}"))).collect()
    }
}

/// Gives objects their names; of several names of one object the last one stays.
///
/// # Errors
/// The first id that no object has.
pub fn rename(set: &mut ObjectSet, renamings: &[Renaming]) -> Result<(), u32> {
    for renaming in renamings {
        let object = set.objects.iter_mut().find(|object| object.id == renaming.id);
        object.ok_or(renaming.id)?.label.clone_from(&renaming.name);
    }
    Ok(())
}
