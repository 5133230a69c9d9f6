//! Keys in the project's own JSON files that no reader knows.
//!
//! Enters: the keys of every JSON object of a file, and the keys that its reader knows. Leaves: one line per unknown key
//! with its first place and the nearest known key. An unknown key is never an error.

use std::collections::BTreeMap;

/// The unknown keys of a file. A key that many entries of a list share is one finding.
#[derive(Debug, Clone, Default)]
pub struct UnknownKeys {
    /// By the place without its indices, and the key.
    findings: BTreeMap<(String, String), Finding>,
}

#[derive(Debug, Clone)]
struct Finding {
    first_place: String,
    num_others: usize,
    nearest: String,
}

impl UnknownKeys {
    /// Compares the keys of the object at `place` with those that its reader knows. The place of the top level is empty.
    pub fn check<'a>(&mut self, place: &str, keys: impl IntoIterator<Item = &'a str>, known: &[&str]) {
        for key in keys.into_iter().filter(|key| !known.contains(key)) {
            let list: String = place.chars().filter(|c| !c.is_ascii_digit()).collect();
            let finding = self.findings.entry((list, key.to_owned()));
            finding.and_modify(|finding| finding.num_others += 1).or_insert_with(|| Finding {
                first_place: if place.is_empty() { shown(key) } else { format!("{place}.{}", shown(key)) },
                num_others: 0,
                nearest: nearest(key, known).unwrap_or_default().to_owned(),
            });
        }
    }

    /// One line per unknown key, such as `keyframes[1].easng: unknown key, the nearest known key is easing`.
    pub fn into_notes(self) -> Vec<String> {
        self.findings.into_values().map(Finding::into_note).collect()
    }
}

impl Finding {
    fn into_note(self) -> String {
        let Self { first_place, num_others, nearest } = self;
        let others = match num_others {
            0 => String::new(),
            1 => " (here and in 1 other place)".to_owned(),
            _ => format!(" (here and in {num_others} other places)"),
        };
        if nearest.is_empty() {
            return format!("{first_place}: unknown key{others}");
        }
        format!("{first_place}: unknown key{others}, the nearest known key is {nearest}")
    }
}

/// The name with the fewest edits from `key`; `None` without names.
fn nearest<'a>(key: &str, names: &[&'a str]) -> Option<&'a str> {
    let key: String = key.chars().take(MAX_SHOWN_CHARS).collect();
    names.iter().copied().min_by_key(|name| strsim::osa_distance(&key, name))
}

/// Fewest edits between two names, or between one word of each.
pub fn edits_between(name: &str, other: &str) -> usize {
    let short = |text: &str| text.chars().take(MAX_SHOWN_CHARS).collect::<String>().to_lowercase();
    let (name, other) = (short(name), short(other));
    let by_word =
        name.split_whitespace().flat_map(|a| other.split_whitespace().map(move |b| strsim::osa_distance(a, b)));
    by_word.chain([strsim::osa_distance(&name, &other)]).min().unwrap_or(usize::MAX)
}

/// Longest part of a key in a line and in a comparison, characters.
const MAX_SHOWN_CHARS: usize = 40;

/// A key on one line.
fn shown(key: &str) -> String {
    let short: String = key.chars().take(MAX_SHOWN_CHARS).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if short.len() < key.len() { format!("{short}..") } else { short }
}

/// The key that is most likely a misspelling of `name`: at most one edit per four letters away; `None` without one.
pub fn misspelling<'a>(name: &str, keys: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let allowed = name.len() / 4;
    let near = keys.into_iter().filter(|key| key.len() <= 2 * name.len());
    let distances = near.map(|key| (strsim::osa_distance(key, name), key));
    distances.filter(|(distance, _)| (1..=allowed).contains(distance)).min().map(|(_, key)| key)
}
