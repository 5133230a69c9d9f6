//! Renaming: other names for things, in the scene and in the sentence.

use std::ops::Range;

use cinesplat_director::names::{Label, NameWord};
use cinesplat_language::{Kind, NamedObject, Relation, Things, tokenize};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

use super::example::{Labels, Piece, RawExample};

/// A label without its number, and the number.
pub(super) fn split_number(label: &str) -> (&str, &str) {
    let base = label.trim_end_matches(|c: char| c.is_ascii_digit());
    if base.len() == label.len() || !base.ends_with([' ', '-', '#']) {
        (label, "")
    } else {
        (base, &label[base.len()..])
    }
}

/// Stems of words as a phrase.
pub(super) fn phrase(words: &[NameWord]) -> String {
    words.iter().map(|word| word.stem.as_str()).collect::<Vec<_>>().join(" ")
}

/// The words of a mention that name a thing: words of its label, or a phrase for its kind.
pub(super) fn core(words: &[NameWord], label: &Label) -> Option<Range<usize>> {
    let mut named = vec![false; words.len()];
    for (i, word) in words.iter().enumerate() {
        named[i] = word.is_alphabetic() && label.stems().contains(&word.stem);
    }
    for start in 0..words.len() {
        for end in start + 1..=words.len().min(start + 4) {
            let relations = label.relations(&phrase(&words[start..end]));
            if [Relation::Same, Relation::Broader, Relation::Narrower].iter().any(|r| r.is_in(relations)) {
                named[start..end].fill(true);
            }
        }
    }
    let start = named.iter().position(|is| *is)?;
    let len = named[start..].iter().take_while(|is| **is).count();
    Some(start..start + len)
}

/// Whether two labels could be mistaken for one another.
pub(super) fn collides(a: &Label, b: &Label) -> bool {
    let shares = a.stems().iter().any(|stem| b.stems().contains(stem));
    let related = |a: &Label, b: &Label| {
        let stems = b.stems();
        let is_near = |phrase: &str| {
            let relations = a.relations(phrase);
            [Relation::Same, Relation::Broader, Relation::Narrower].iter().any(|r| r.is_in(relations))
        };
        (0..stems.len()).any(|start| is_near(&stems[start..].join(" ")))
    };
    shares || related(a, b) || related(b, a)
}

/// Whether words could name a thing of this label.
pub(super) fn could_name(words: &[NameWord], label: &Label) -> bool {
    let by_phrase = |start: usize| {
        (start + 1..=words.len().min(start + 4)).any(|end| label.relations(&phrase(&words[start..end])) != 0)
    };
    words.iter().any(|word| label.stems().contains(&word.stem)) || (0..words.len()).any(by_phrase)
}

fn words_of(text: &str) -> Vec<NameWord> {
    tokenize(text).into_iter().map(|word| NameWord::new(&word.text)).collect()
}

/// Words as a plural: the last one gets its ending.
fn plural(mut words: Vec<NameWord>) -> Vec<NameWord> {
    if let Some(last) = words.last_mut().filter(|last| last.is_alphabetic() && last.stem == last.text) {
        let text = match last.text.as_str() {
            text if text.ends_with('f') => format!("{}ves", text.trim_end_matches('f')),
            text if text.ends_with(['x', 's']) || text.ends_with("ch") || text.ends_with("sh") => format!("{text}es"),
            text if text.ends_with('y') && !text.ends_with("ay") && !text.ends_with("ey") => {
                format!("{}ies", text.trim_end_matches('y'))
            }
            text => format!("{text}s"),
        };
        *last = NameWord::new(&text);
    }
    words
}

/// Replaces the words `range` by others, as a plural if they were one.
fn replace(words: &mut Vec<NameWord>, range: Range<usize>, with: &str) {
    let was_plural = words.get(range.end - 1).is_some_and(|word| word.stem != word.text && word.is_alphabetic());
    let new = words_of(with);
    if new.is_empty() {
        return;
    }
    let new = if was_plural { plural(new) } else { new };
    words.splice(range, new);
}

/// Another name for a thing of this label: its label, the last words of it, a synonym, a broader kind.
pub(super) fn other_name(label: &str, rng: &mut Pcg64) -> String {
    let things = Things::embedded();
    let kinds: Vec<&Kind> = things.kinds_of(label).into_iter().filter_map(|kind| things.kinds().get(kind)).collect();
    let base = split_number(label).0.trim().to_owned();
    let draw = rng.random_range(0..100);
    let from = |list: Option<&String>| list.cloned().unwrap_or_else(|| base.clone());
    match kinds.choose(rng) {
        Some(kind) if draw < 35 => from(kind.names.choose(rng)),
        Some(kind) if draw < 41 => from(kind.broader.choose(rng)),
        _ if draw < 65 => base.rsplit(' ').next().unwrap_or(&base).to_owned(),
        _ => base,
    }
}

/// A name for a new thing, from the corpus or from the list of kinds.
pub(super) fn new_label(pool: &[String], rng: &mut Pcg64) -> String {
    const LOOKS: [&str; 24] = [
        "red", "blue", "green", "old", "wooden", "white", "black", "small", "big", "brass", "steel", "leather",
        "glass", "yellow", "antique", "rusty", "round", "tall", "broken", "marble", "folding", "plastic", "golden",
        "striped",
    ];
    // The parts that anything may have are no thing.
    let kinds: Vec<&Kind> = Things::embedded().kinds().iter().filter(|kind| kind.names[0] != "*").collect();
    let draw = rng.random_range(0..100);
    let name = match draw {
        0..50 => pool.choose(rng).map(|label| split_number(label).0.trim().to_owned()),
        50..70 => kinds.choose(rng).and_then(|kind| kind.names.first().cloned()),
        _ => kinds.choose(rng).and_then(|kind| kind.names.choose(rng).cloned()),
    };
    let name = name.unwrap_or_else(|| "box".to_owned());
    if draw >= 50 && rng.random_range(0..8) == 0 {
        format!("{} {name}", LOOKS.choose(rng).unwrap_or(&"old"))
    } else {
        name
    }
}

/// Rewrites a mention of a thing of label `old` for the label `new`.
fn rewrite(words: &mut Vec<NameWord>, old: &Label, new: &str, rng: &mut Pcg64) {
    if words.iter().any(|word| word.tag.is_some()) {
        return;
    }
    if let Some(range) = core(words, old) {
        replace(words, range, &other_name(new, rng));
        return;
    }
    // A part or a description: the whole becomes a part or a name of the new thing.
    let first = words.first().filter(|word| ["the", "its", "a", "an", "that", "this", "their"].contains(&&*word.text));
    let mut out: Vec<NameWord> = first.cloned().into_iter().collect();
    out.extend(words_of(&part_of(new, rng).unwrap_or_else(|| other_name(new, rng))));
    *words = out;
}

/// A part of a thing of this label.
pub(super) fn part_of(label: &str, rng: &mut Pcg64) -> Option<String> {
    let things = Things::embedded();
    let kinds: Vec<&Kind> = things.kinds_of(label).into_iter().filter_map(|kind| things.kinds().get(kind)).collect();
    kinds.choose(rng)?.parts.choose(rng).cloned()
}

/// Gives the things of one name another name, in the scene and in the sentence.
pub(super) fn rename(example: &mut RawExample, pool: &[String], labels: &mut Labels, rng: &mut Pcg64) {
    let Some(object) = example.objects.choose(rng) else { return };
    let old_base = split_number(&object.label).0.to_owned();
    let old = labels.get(&old_base);
    let new = new_label(pool, rng);
    let new_label = labels.get(&new);
    let is_own = |object: &NamedObject| split_number(&object.label).0 == old_base;
    let collides = |object: &NamedObject| !is_own(object) && collides(&labels_of(labels, &object.label), &new_label);
    if example.objects.iter().any(collides) {
        return;
    }
    let ids: Vec<u32> = example.objects.iter().filter(|object| is_own(object)).map(|object| object.id).collect();
    let foreign = example.pieces.iter().any(|piece| match piece {
        Piece::Mention { words, ids: named } => {
            !named.iter().any(|id| ids.contains(id)) && could_name(words, &new_label)
        }
        Piece::Word(_) => false,
    });
    if foreign {
        return;
    }
    for object in &mut example.objects {
        if ids.contains(&object.id) {
            let number = split_number(&object.label).1;
            object.label = if number.is_empty() { new.clone() } else { format!("{new} {number}") };
        }
    }
    for piece in &mut example.pieces {
        if let Piece::Mention { words, ids: named } = piece
            && named.iter().any(|id| ids.contains(id))
        {
            rewrite(words, &old, &new, rng);
        }
    }
}

fn labels_of(labels: &mut Labels, label: &str) -> std::sync::Arc<Label> {
    labels.get(label)
}

/// Says one mention in another way: a synonym, or a part of the thing.
pub(super) fn resay(example: &mut RawExample, labels: &mut Labels, rng: &mut Pcg64) {
    let mentions: Vec<usize> =
        (0..example.pieces.len()).filter(|at| matches!(example.pieces[*at], Piece::Mention { .. })).collect();
    let Some(at) = mentions.choose(rng).copied() else { return };
    let Piece::Mention { words, ids } = &example.pieces[at] else { return };
    let Some(label) = ids.first().and_then(|id| example.label(*id)).map(str::to_owned) else { return };
    let mut new_words = words.clone();
    if new_words.iter().any(|word| word.tag.is_some()) {
        return;
    }
    let own = labels.get(split_number(&label).0);
    let Some(range) = core(&new_words, &own) else { return };
    if ids.len() == 1 && rng.random_range(0..5) == 0 {
        let Some(part) = part_of(&label, rng) else { return };
        let lead = if rng.random_bool(0.7) { "the" } else { "its" };
        let owner = other_name(&label, rng);
        new_words = words_of(&match rng.random_range(0..3) {
            0 => format!("{lead} {part}"),
            1 => format!("the {part} of the {owner}"),
            _ => format!("the {owner}'s {part}"),
        });
    } else {
        replace(&mut new_words, range, &other_name(&label, rng));
    }
    let ids = ids.clone();
    let is_other =
        |object: &&NamedObject| !ids.contains(&object.id) && split_number(&object.label).0 != split_number(&label).0;
    let mistaken =
        example.objects.iter().filter(is_other).any(|object| could_name(&new_words, &labels.get(&object.label)));
    if !mistaken {
        example.pieces[at] = Piece::Mention { words: new_words, ids };
    }
}

/// Puts a thing that the scene lacks in place of a mention's thing.
pub(super) fn absent(example: &mut RawExample, pool: &[String], labels: &mut Labels, rng: &mut Pcg64) {
    let mentions: Vec<usize> =
        (0..example.pieces.len()).filter(|at| matches!(example.pieces[*at], Piece::Mention { .. })).collect();
    let Some(at) = mentions.choose(rng).copied() else { return };
    let Piece::Mention { words, ids } = &example.pieces[at] else { return };
    let Some(label) = ids.first().and_then(|id| example.label(*id)).map(str::to_owned) else { return };
    let old = labels.get(split_number(&label).0);
    let Some(range) = core(words, &old).filter(|_| words.iter().all(|word| word.tag.is_none())) else { return };
    let mut new_words = words.clone();
    let new = new_label(pool, rng);
    replace(&mut new_words, range, &other_name(&new, rng));
    let rest = example.objects.iter().any(|object| could_name(&new_words, &labels.get(&object.label)));
    if !rest {
        example.pieces[at] = Piece::Mention { words: new_words, ids: Vec::new() };
    }
}
