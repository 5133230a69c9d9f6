//! Features of the words of a sentence: what each of them has to do with each object of the scene.

use cinesplat_language::{Lexicon, MAX_PHRASE_WORDS, NamedObject, Relation, Things, Word, WordList, edit_distance};
use strum::VariantArray;

use super::scene::{Label, SceneNames};
use super::words::NameWord;
use crate::error::DirectorError;

/// Number of match features of a word and an object.
pub(super) const NUM_MATCHES: usize = 16;
/// Number of features of a word.
pub(super) const NUM_WORD_FEATURES: usize = NUM_MATCHES + 5 + NUM_LISTS + 3 + 9;
const NUM_LISTS: usize = WordList::VARIANTS.len();
/// Number of features of the lists and roles that a word is in.
pub(super) const NUM_LIST_FEATURES: usize = NUM_LISTS + 3;

const HEAD: usize = 0;
const QUALIFIER: usize = 1;
const TAIL: usize = 2;
const LIKE_HEAD: usize = 3;
const LIKE_OTHER: usize = 4;
const COMPOUND: usize = 5;
/// The first of five: one per [`Relation`].
const RELATIONS: usize = 6;
/// The relation of a part.
pub(super) const PART: usize = RELATIONS + Relation::Part as usize;
const NUMBER: usize = 11;
const OTHER_NUMBER: usize = 12;
const TAG: usize = 13;
const ABBREVIATION: usize = 14;
/// The head in the very same form.
const SAME_FORM: usize = 15;

/// Match features of a word and an object.
pub(super) type Matches = [f32; NUM_MATCHES];

/// A sentence with its scene, as the network reads it.
#[derive(Debug, Clone)]
pub struct Sentence {
    /// Its words.
    pub words: Vec<NameWord>,
    /// The objects of the scene.
    pub scene: SceneNames,
    /// `[words][objects]`
    pub(super) matches: Vec<Vec<Matches>>,
    /// `[words]`
    pub(super) features: Vec<[f32; NUM_WORD_FEATURES]>,
}

impl Sentence {
    /// Compares words and objects.
    ///
    /// # Errors
    /// [`DirectorError::Language`] when the embedded lexicon is malformed.
    pub fn new(words: Vec<NameWord>, scene: SceneNames) -> Result<Self, DirectorError> {
        let lexicon = Lexicon::embedded()?;
        let mut matches: Vec<Vec<Matches>> =
            (0..words.len()).map(|i| scene.objects.iter().map(|object| matches(&words, i, object)).collect()).collect();
        let roles = relate(&words, &scene, &mut matches);
        matches.iter_mut().for_each(|row| prefer_names(row));
        let features = (0..words.len()).map(|i| features(&words, i, &matches[i], roles[i], lexicon)).collect();
        Ok(Self { words, scene, matches, features })
    }

    /// A sentence about named objects.
    ///
    /// # Errors
    /// [`DirectorError::Language`] when the embedded lexicon is malformed.
    pub fn about(words: Vec<NameWord>, objects: &[NamedObject]) -> Result<Self, DirectorError> {
        Self::new(words, SceneNames::new(objects, &mut |label| std::sync::Arc::new(Label::new(label))))
    }

    /// Whether any word has a strong or weak relation to an object, among the words `range`.
    pub fn touches(&self, range: std::ops::Range<usize>, object: usize) -> bool {
        let any = |i: usize| self.matches[i].get(object).is_some_and(|m| m[..=ABBREVIATION].iter().any(|m| *m > 0.0));
        range.into_iter().any(any)
    }

    /// The only object whose label has a word, in the very same form, as its head.
    pub(super) fn only_named(&self, word: usize) -> Option<usize> {
        let is_named = |object: &usize| self.matches[word][*object][SAME_FORM] > 0.0;
        let mut named = (0..self.scene.objects.len()).filter(is_named);
        named.next().filter(|_| named.next().is_none())
    }

    /// Whether a word is part of an object's name, its synonym or broader kind.
    pub fn names(&self, word: usize, object: usize) -> bool {
        let Some(m) = self.matches.get(word).and_then(|row| row.get(object)) else { return false };
        [HEAD, QUALIFIER, TAIL, COMPOUND, RELATIONS, RELATIONS + 1, RELATIONS + 2, LIKE_HEAD, ABBREVIATION]
            .iter()
            .any(|at| m[*at] > 0.0)
    }
}

/// Features of one word and one object, without the relations of kinds.
fn matches(words: &[NameWord], i: usize, object: &super::scene::SceneObject) -> Matches {
    let mut out = [0.0; NUM_MATCHES];
    let (word, label) = (&words[i], &object.label);
    if let Some(tag) = word.tag {
        out[TAG] = f32::from(u8::from(tag == Some(object.id)));
        return out;
    }
    if let Some(number) = number_of(&word.text) {
        if let Some(own) = label.number {
            out[if own == number { NUMBER } else { OTHER_NUMBER }] = 1.0;
        }
        return out;
    }
    if !word.is_alphabetic() {
        return out;
    }
    for (at, stem) in label.stems.iter().enumerate() {
        let place = if at == label.head {
            HEAD
        } else if at >= label.tail {
            TAIL
        } else {
            QUALIFIER
        };
        if *stem == word.stem {
            out[place] = 1.0;
            out[SAME_FORM] = flag(place == HEAD && label.texts[at] == word.text).max(out[SAME_FORM]);
            continue;
        }
        let like = if at == label.head { LIKE_HEAD } else { LIKE_OTHER };
        out[like] = likeness(&word.stem, stem).max(out[like]);
        if stem.len() > word.text.len() && word.text.len() >= 3 && stem.starts_with(&word.text) {
            out[ABBREVIATION] = 1.0;
        }
        let (long, short) = if stem.len() > word.stem.len() { (stem, &word.stem) } else { (&word.stem, stem) };
        if short.len() >= 4 && (long.ends_with(short.as_str()) || long.starts_with(short.as_str())) {
            out[COMPOUND] = 1.0;
        }
    }
    let is_label_word = |joined: &str| label.stems.iter().any(|stem| stem == joined);
    let next = words.get(i + 1).is_some_and(|next| is_label_word(&format!("{}{}", word.text, next.stem)));
    let previous = i.checked_sub(1).is_some_and(|at| is_label_word(&format!("{}{}", words[at].text, word.stem)));
    if next || previous || label.joined.contains(&word.stem) {
        out[COMPOUND] = 1.0;
    }
    out
}

/// 1 less the share of edited letters, if that is 0.6 and more; 0 otherwise.
fn likeness(a: &str, b: &str) -> f32 {
    let (short, long) = (a.len().min(b.len()), a.len().max(b.len()));
    if short < 3 || long - short > 2 {
        return 0.0;
    }
    let likeness = 1.0 - edit_distance(a, b) as f32 / long as f32;
    if likeness >= 0.6 { likeness } else { 0.0 }
}

/// Adds the relations of kinds of all phrases to the matches of their words, and returns the roles of each word's phrases.
fn relate(words: &[NameWord], scene: &SceneNames, matches: &mut [Vec<Matches>]) -> Vec<u8> {
    let things = Things::embedded();
    let mut roles = vec![0; words.len()];
    for start in 0..words.len() {
        let mut phrase = String::new();
        for end in start..words.len().min(start + MAX_PHRASE_WORDS) {
            if !words[end].is_alphabetic() {
                break;
            }
            if end > start {
                phrase.push(' ');
            }
            phrase.push_str(&words[end].stem);
            let found = things.roles(&phrase);
            if found == 0 {
                continue;
            }
            roles[start..=end].iter_mut().for_each(|role| *role |= found);
            for (at, object) in scene.objects.iter().enumerate() {
                let relations = object.label.related.get(&phrase).copied().unwrap_or(0);
                for (offset, relation) in Relation::VARIANTS.iter().enumerate() {
                    if relation.is_in(relations) {
                        matches[start..=end].iter_mut().for_each(|row| row[at][RELATIONS + offset] = 1.0);
                    }
                }
            }
        }
    }
    roles
}

/// A word that names an object, exactly or by a synonym, is no part of another.
fn prefer_names(row: &mut [Matches]) {
    if row.iter().any(is_head) {
        row.iter_mut().for_each(|matches| matches[PART] = 0.0);
    }
}

fn features(
    words: &[NameWord],
    i: usize,
    matches: &[Matches],
    roles: u8,
    lexicon: &Lexicon,
) -> [f32; NUM_WORD_FEATURES] {
    let word = &words[i];
    let mut out = Vec::with_capacity(NUM_WORD_FEATURES);
    for at in 0..NUM_MATCHES {
        out.push(matches.iter().map(|m| m[at]).fold(0.0, f32::max));
    }
    let count = matches.iter().filter(|m| m[HEAD] > 0.0 || m[RELATIONS] > 0.0).count();
    out.extend((1..=3).map(|least| flag(count >= least)));
    out.push(flag(matches.iter().any(|m| m[HEAD] + m[QUALIFIER] + m[TAIL] + m[COMPOUND] + m[RELATIONS] > 0.0)));
    out.push(flag(matches.is_empty()));
    let plain = Word { text: word.text.clone(), stem: word.stem.clone(), span: word.bytes, after_hyphen: false };
    out.extend(lexicon.lists_of(&plain).map(flag));
    out.extend([Relation::Same, Relation::Broader, Relation::Part].map(|relation| flag(relation.is_in(roles))));
    let text = word.text.as_str();
    out.extend([
        flag(word.is_alphabetic() && word.stem != word.text),
        flag(number_of(text).is_some()),
        flag(!word.is_alphabetic() && word.tag.is_none()),
        flag(i == 0),
        flag(text.ends_with("ing")),
        flag(text.ends_with("ly")),
        flag(text.ends_with("ed")),
        flag(word.tag.is_some()),
        flag(text.chars().count() < 4),
    ]);
    let mut row = [0.0; NUM_WORD_FEATURES];
    row.iter_mut().zip(out).for_each(|(to, from)| *to = from);
    row
}

/// Features of the lists and roles of words, the largest of each.
pub(super) fn lists(features: &[[f32; NUM_WORD_FEATURES]]) -> [f32; NUM_LIST_FEATURES] {
    const FIRST: usize = NUM_MATCHES + 5;
    let mut out = [0.0; NUM_LIST_FEATURES];
    for row in features {
        out.iter_mut().zip(&row[FIRST..]).for_each(|(to, from)| *to = f32::max(*to, *from));
    }
    out
}

pub(super) fn flag(value: bool) -> f32 {
    f32::from(u8::from(value))
}

/// A number up to twelve in digits or words, also an ordinal (`second`, `3rd` is two words).
pub(super) fn number_of(text: &str) -> Option<u32> {
    const ORDINALS: [&str; 7] = ["zeroth", "first", "second", "third", "fourth", "fifth", "sixth"];
    let ordinal = ORDINALS.iter().position(|ordinal| *ordinal == text).filter(|at| *at > 0).map(|at| at as u32);
    let word = || (1..=12).find(|number| cinesplat_language::number_word(*number) == Some(text));
    text.parse().ok().or(ordinal).or_else(word)
}

/// Whether a word of the sentence names the head of an object, exactly or by a synonym.
pub(super) fn is_head(matches: &Matches) -> bool {
    matches[HEAD] > 0.0 || matches[RELATIONS] > 0.0
}
