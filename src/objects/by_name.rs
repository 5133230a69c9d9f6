//! Objects by the names that people write in files: `<obj-3>`, or a label.

use super::object::Object;

/// Most objects that a message lists.
const MAX_LISTED: usize = 12;

/// The object that a name means: `<obj-3>` by its id, other names by their label in any case.
///
/// # Errors
/// What was expected instead: the objects there are, or those that share the label.
pub fn named<'a>(objects: &'a [Object], name: &str) -> Result<&'a Object, String> {
    let id = name.trim().strip_prefix("<obj-").and_then(|rest| rest.strip_suffix('>')?.parse::<u32>().ok());
    let is_meant = |object: &&Object| match id {
        Some(id) => object.id == id,
        None => !object.label.is_empty() && object.label.to_lowercase() == name.trim().to_lowercase(),
    };
    let found: Vec<&Object> = objects.iter().filter(is_meant).collect();
    match found[..] {
        [object] => Ok(object),
        [] if objects.is_empty() => Err("a point, because the scene has no objects".to_owned()),
        [] => Err(format!("one of the objects {}", listed(objects.iter()))),
        _ => Err(format!("one object: {}", listed(found.into_iter()))),
    }
}

fn listed<'a>(objects: impl ExactSizeIterator<Item = &'a Object>) -> String {
    let num_more = objects.len().saturating_sub(MAX_LISTED);
    let name = |object: &Object| format!("<obj-{}> {}", object.id, object.label).trim_end().to_owned();
    let names: Vec<String> = objects.take(MAX_LISTED).map(name).collect();
    let more = if num_more > 0 { format!(" and {num_more} more") } else { String::new() };
    names.join(", ") + &more
}
