//! What objects are called.

use cinesplat_language::is_listed;
use cinesplat_objects::Object;

/// Whether the label of an object has one of some words.
pub(super) fn is_called(objects: &[Object], id: u32, kinds: &str) -> bool {
    let object = objects.iter().find(|object| object.id == id);
    object.is_some_and(|object| object.label.split(' ').any(|word| is_listed(kinds, word)))
}
