//! The order of names of pictures: numbers in them count as numbers, so that `frame_9.png` is before `frame_10.png`.

use std::cmp::Ordering;

/// Compares two names part by part; equal ones by their text.
pub(super) fn by_name(a: &str, b: &str) -> Ordering {
    let (mut rest_a, mut rest_b) = (a, b);
    while !rest_a.is_empty() && !rest_b.is_empty() {
        let ((part_a, after_a), (part_b, after_b)) = (first_part(rest_a), first_part(rest_b));
        let is_number = |part: &str| part.starts_with(|c: char| c.is_ascii_digit());
        let order = if is_number(part_a) && is_number(part_b) {
            let [a, b] = [part_a, part_b].map(|part| part.trim_start_matches('0'));
            a.len().cmp(&b.len()).then(a.cmp(b))
        } else {
            part_a.cmp(part_b)
        };
        if order != Ordering::Equal {
            return order;
        }
        (rest_a, rest_b) = (after_a, after_b);
    }
    rest_a.len().cmp(&rest_b.len()).then(a.cmp(b))
}

/// A line for poses without times that are not in the order of their names.
pub(super) fn out_of_order<'a>(names: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let names: Vec<&str> = names.into_iter().collect();
    let back = names.windows(2).find(|pair| by_name(pair[0], pair[1]) == Ordering::Greater)?;
    let quoted = |name: &str| super::json_read::quoted(name);
    let (before, after) = (quoted(back[0]), quoted(back[1]));
    Some(format!("the poses are in the order of the file, and not in that of their names ({after} is behind {before})"))
}

/// The digits or the other characters at the start of a text, and the rest.
fn first_part(text: &str) -> (&str, &str) {
    let is_digit = text.starts_with(|c: char| c.is_ascii_digit());
    let end = text.find(|c: char| c.is_ascii_digit() != is_digit).unwrap_or(text.len());
    text.split_at(end)
}
