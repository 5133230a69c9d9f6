//! The tree of paths: each is a name below another path.

use super::super::super::bytes::Bytes;
use super::damage::damaged;
use super::packing::{count, whole_numbers};
use crate::ExportError;

/// Entries of the jumps that are no distance: without siblings, and a leaf without siblings.
const CHILD_ALONE: i32 = -1;
const LAST_LEAF: i32 = -2;

/// A path: a name below another path. The root has no parent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PathEntry {
    pub(super) parent: Option<u32>,
    /// Index of its token.
    pub(super) name: u32,
    pub(super) is_property: bool,
}

/// The paths by index; `None` where the file names none.
pub(super) fn read(section: &mut Bytes<'_>, most_bytes: u64) -> Result<Vec<Option<PathEntry>>, ExportError> {
    let mut paths = vec![None; count(section, 4, most_bytes)?];
    let num = count(section, 4, most_bytes)?;
    let offset = section.position();
    let (indices, names, jumps) =
        (whole_numbers(section, num)?, whole_numbers(section, num)?, whole_numbers(section, num)?);
    let wrong = |what: &str| damaged(offset, what, "a tree of paths");
    // First entries of lists of siblings, with their parent.
    let mut lists: Vec<(usize, Option<u32>)> = if num > 0 { vec![(0, None)] } else { Vec::new() };
    while let Some((mut at, mut parent)) = lists.pop() {
        loop {
            let (Some(&idx), Some(&name), Some(&jump)) = (indices.get(at), names.get(at), jumps.get(at)) else {
                return Err(wrong("an entry behind the last"));
            };
            let (name, jump) = (name.cast_signed(), jump.cast_signed());
            let entry = paths.get_mut(idx as usize).filter(|entry| entry.is_none());
            let entry = entry.ok_or_else(|| wrong("a path twice, or behind the last"))?;
            *entry = Some(PathEntry { parent, name: name.unsigned_abs(), is_property: name < 0 });
            let has_child = jump > 0 || jump == CHILD_ALONE;
            let has_sibling = jump >= 0;
            if jump < LAST_LEAF {
                return Err(wrong("a jump backwards"));
            }
            if has_child && has_sibling {
                lists.push((at + jump as usize, parent));
            }
            if has_child {
                parent = Some(idx);
            } else if !has_sibling {
                break;
            }
            at += 1;
        }
    }
    Ok(paths)
}
