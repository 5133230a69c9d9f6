//! Features of a mention and the objects that it could name.

use std::ops::Range;

use super::sentence::{Matches, NUM_LIST_FEATURES, NUM_MATCHES, PART, Sentence, flag, is_head, lists, number_of};

/// Most words of a mention that count; the first ones.
pub(super) const MAX_SPAN: usize = 12;
/// Number of features of a mention and an object beside the matches of words.
pub(super) const NUM_PAIR_FEATURES: usize = 19;
/// Number of features of a mention.
pub(super) const NUM_MENTION_FEATURES: usize = 14 + NUM_LIST_FEATURES;

/// A mention with its features.
#[derive(Debug, Clone)]
pub struct MentionInput {
    /// Its words in the sentence.
    pub words: Range<usize>,
    /// Match features per word and object: `[words][objects]`
    pub(super) matches: Vec<Vec<Matches>>,
    /// Largest match features of its words: `[objects]`
    pub(super) best: Vec<Matches>,
    /// Further features: `[objects]`
    pub(super) pairs: Vec<[f32; NUM_PAIR_FEATURES]>,
    /// Features of the mention alone.
    pub(super) own: [f32; NUM_MENTION_FEATURES],
}

impl MentionInput {
    /// Whether the words say that several things are meant: a plural, `both`, `and`, a number from two.
    pub(super) fn is_plural(&self) -> bool {
        [0, 1, 2, 4, 5, 6].iter().any(|at| self.own[*at] > 0.0)
    }

    /// The mention at `words` of a sentence. `earlier` are the indices of the objects of each mention before it.
    pub fn new(sentence: &Sentence, words: Range<usize>, earlier: &[Vec<usize>]) -> Self {
        let words = words.start..words.end.min(words.start + MAX_SPAN);
        let num_objects = sentence.scene.objects.len();
        let matches: Vec<Vec<Matches>> = words.clone().map(|i| sentence.matches[i].clone()).collect();
        let best = (0..num_objects).map(|object| best(&matches, object)).collect();
        let own = own_features(sentence, words.clone(), earlier);
        let pairs = (0..num_objects).map(|object| pair_features(sentence, &words, object, earlier)).collect();
        Self { words, matches, best, pairs, own }
    }
}

/// Words before the thing by which another one stands.
const PLACES: [&str; 12] =
    ["by", "near", "next", "behind", "beside", "on", "with", "in", "above", "under", "nearest", "closest"];

/// Whether the words of a mention say where a thing is.
pub(super) fn says_place(sentence: &Sentence, words: &Range<usize>) -> bool {
    sentence.words[words.clone()].iter().any(|word| PLACES.contains(&word.text.as_str()))
}

fn best(matches: &[Vec<Matches>], object: usize) -> Matches {
    let mut out = [0.0; NUM_MATCHES];
    for row in matches {
        for (to, from) in out.iter_mut().zip(row[object]) {
            *to = f32::max(*to, from);
        }
    }
    out
}

/// Numbers that a mention says, ordinals included.
fn numbers(sentence: &Sentence, words: &Range<usize>) -> Vec<u32> {
    sentence.words[words.clone()].iter().filter_map(|word| number_of(&word.text)).collect()
}

fn own_features(sentence: &Sentence, words: Range<usize>, earlier: &[Vec<usize>]) -> [f32; NUM_MENTION_FEATURES] {
    let inside = &sentence.words[words.clone()];
    let any = |list: &[&str]| inside.iter().any(|word| list.contains(&word.text.as_str()));
    let first = |list: &[&str]| inside.first().is_some_and(|word| list.contains(&word.text.as_str()));
    let number = numbers(sentence, &words).first().copied().unwrap_or(0);
    let said = [
        flag(inside.iter().any(|word| word.is_alphabetic() && word.stem != word.text)),
        flag(any(&["all", "both", "each", "every", "pair", "couple", "row", "rows", "group", "set", "line"])),
        flag(any(&["and"])),
        flag(number == 1),
        flag(number == 2),
        flag(number == 3),
        flag(number > 3),
        flag(first(&["its", "their", "his", "her"])),
        flag(first(&["a", "an", "one", "some", "any"])),
        flag(any(&["of"])),
        flag(any(&PLACES)),
        flag(any(&["'s"])),
        flag(earlier.is_empty()),
        inside.len() as f32 / MAX_SPAN as f32,
    ];
    let mut out = [0.0; NUM_MENTION_FEATURES];
    let all = said.into_iter().chain(lists(&sentence.features[words]));
    out.iter_mut().zip(all).for_each(|(to, from)| *to = from);
    out
}

fn pair_features(
    sentence: &Sentence,
    words: &Range<usize>,
    object: usize,
    earlier: &[Vec<usize>],
) -> [f32; NUM_PAIR_FEATURES] {
    let own = &sentence.scene.objects[object];
    let label = &own.label;
    let inside = &sentence.words[words.clone()];
    let is_covered = |stem: &&String| inside.iter().any(|word| word.stem == **stem);
    let covered = label.stems.iter().filter(is_covered).count();
    let share = covered as f32 / label.stems.len().max(1) as f32;
    let last_match = inside.iter().rposition(|word| word.stem == label.head_stem());
    let first_head = words.clone().position(|i| is_head(&sentence.matches[i][object]));
    let first_of_any = words.clone().position(|i| sentence.matches[i].iter().any(is_head));
    let numbers = numbers(sentence, words);
    let rank_said = label.number.is_none() && numbers.contains(&(own.rank as u32 + 1));
    let used = |index: usize| earlier.iter().flatten().filter(|at| **at == index).count();
    let same_used = |(at, other): (usize, &super::scene::SceneObject)| other.label.stems == label.stems && used(at) > 0;
    let num_used = sentence.scene.objects.iter().enumerate().filter(|pair| same_used(*pair)).count();
    [
        share,
        flag(share >= 1.0),
        flag(own.rank == 0),
        flag(own.num_same > 1),
        flag(own.rank + 1 == own.num_same),
        flag(own.num_same > 1 && rank_said),
        flag(own.num_same > 1 && numbers.contains(&(own.num_same as u32))),
        flag(earlier.last().is_some_and(|last| last.contains(&object))),
        flag(used(object) > 0),
        flag(label.plural),
        flag(own.rank == num_used),
        flag(last_match.is_some_and(|at| at + 1 == inside.len())),
        flag(first_head.is_some() && first_head == first_of_any),
        flag(label.number.is_some()),
        flag(earlier.last().is_some_and(|last| last.len() > 1 && last.contains(&object))),
        flag(covered > 1),
        flag(label.related.is_empty()),
        flag(earlier.first().is_some_and(|first| first.contains(&object))),
        flag(is_owner(sentence, words, object)),
    ]
}

/// Whether words of the mention name a part of the object and of no other.
fn is_owner(sentence: &Sentence, words: &Range<usize>, object: usize) -> bool {
    let part = |i: usize, at: usize| sentence.matches[i][at][PART] > 0.0;
    let others = |i: usize| (0..sentence.scene.objects.len()).filter(|at| *at != object).any(|at| part(i, at));
    words.clone().any(|i| part(i, object) && !others(i))
}
