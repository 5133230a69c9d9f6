//! Augmentation: random changes of examples, so that the network depends on no single word or identifier.

use cinesplat_director::codes::PoseCode;
use cinesplat_director::inputs::{NUM_OBJECT_SLOTS, Prompt, object_token};
use cinesplat_language::{LanguageError, Linked, Senses};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

use super::phrases::Phrases;

/// Stands for a word that cannot be read: no vocabulary has this character.
const HIDDEN: &str = "\u{fffd}";

/// Rates of augmentation. All fractions are 0..=1.
#[allow(clippy::struct_field_names, reason = "fractions carry their unit")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Augmentation {
    /// Fraction of the examples whose words are changed.
    pub(super) examples_frac: f64,
    /// Fraction of the words that are changed in such an example.
    pub(super) words_frac: f64,
    /// Fraction of the words with senses that are hidden in such an example.
    pub(super) hidden_frac: f64,
    /// Fraction of the examples whose objects get random identifiers instead of 0, 1, ..
    pub(super) slots_frac: f64,
    /// Fraction of the examples in which phrases are exchanged for others of the same meaning.
    pub(super) exchanged_frac: f64,
    /// Fraction of the phrases that are exchanged in such an example.
    pub(super) phrases_frac: f64,
}

impl Augmentation {
    /// No change.
    pub(super) const NONE: Self = Self {
        examples_frac: 0.0,
        words_frac: 0.0,
        hidden_frac: 0.0,
        slots_frac: 0.0,
        exchanged_frac: 0.0,
        phrases_frac: 0.0,
    };
}

impl Default for Augmentation {
    fn default() -> Self {
        Self {
            examples_frac: 0.6,
            words_frac: 0.06,
            hidden_frac: 0.15,
            slots_frac: 0.2,
            exchanged_frac: 0.6,
            phrases_frac: 0.5,
        }
    }
}

impl Augmentation {
    /// The linked prompt with some words misspelled, replaced or made unreadable, and the senses of its words. The number of
    /// words stays the same. `known_words` are the source of invented words. A word that is hidden keeps its senses, so that
    /// the network learns to read words by their senses alone; other changed words keep none.
    pub(super) fn words(
        &self,
        linked: &Linked,
        known_words: &[String],
        rng: &mut Pcg64,
    ) -> Result<(Linked, Vec<Senses>), LanguageError> {
        let mut senses = linked.senses()?;
        if !rng.random_bool(self.examples_frac) {
            return Ok((linked.clone(), senses));
        }
        let words = linked.tokens_text.split(' ').zip(&mut senses).map(|(word, senses)| {
            let plain = word.chars().all(char::is_alphabetic);
            if plain && !senses.is_empty() && rng.random_bool(self.hidden_frac) {
                return if rng.random_bool(0.5) { HIDDEN.to_owned() } else { invented_word(word, known_words, rng) };
            }
            if plain && rng.random_bool(self.words_frac) {
                *senses = Senses::default();
                return changed_word(word, known_words, rng);
            }
            word.to_owned()
        });
        let tokens_text = words.collect::<Vec<_>>().join(" ");
        Ok((Linked { tokens_text, ..linked.clone() }, senses))
    }

    /// The linked prompt with some phrases exchanged for others of the same meaning.
    pub(super) fn phrases(&self, linked: &Linked, rng: &mut Pcg64) -> Linked {
        if !rng.random_bool(self.exchanged_frac) {
            return linked.clone();
        }
        Phrases::embedded().exchange(linked, self.phrases_frac, rng)
    }

    /// Gives the objects of some examples random identifiers, so that the network learns all identifiers.
    pub(super) fn slots(&self, prompt: &mut Prompt, rng: &mut Pcg64) {
        if !rng.random_bool(self.slots_frac) {
            return;
        }
        let mut slots: Vec<usize> = (0..NUM_OBJECT_SLOTS).collect();
        for idx in 0..prompt.objects.len().min(slots.len()) {
            let other = rng.random_range(idx..slots.len());
            slots.swap(idx, other);
        }
        let id_of = |idx: usize| slots.get(idx).map(|slot| object_token(*slot));
        for (idx, object) in prompt.objects.iter_mut().enumerate() {
            object.slot_token = id_of(idx).unwrap_or(object.slot_token);
        }
        for token in &mut prompt.tokens {
            if let Some(id) = token.object.and_then(id_of) {
                token.id = id;
            }
        }
    }
}

fn changed_word(word: &str, known_words: &[String], rng: &mut Pcg64) -> String {
    match rng.random_range(0..4) {
        0 | 1 => HIDDEN.to_owned(),
        2 => invented_word(word, known_words, rng),
        _ => misspelled(word, rng),
    }
}

/// An unknown word: the front half of one known word and the back half of another. Its meaning has to come from the words
/// around it, as with verbs that the grammar lacks.
fn invented_word(word: &str, known_words: &[String], rng: &mut Pcg64) -> String {
    let mut half = |back: bool| {
        let letters: Vec<char> = known_words.choose(rng).map_or(word, String::as_str).chars().collect();
        let middle = letters.len().div_ceil(2);
        if back { letters.into_iter().skip(middle).collect() } else { letters.into_iter().take(middle).collect() }
    };
    let (front, back): (String, String) = (half(false), half(true));
    front + &back
}

/// The word with two letters swapped, or one removed. Words of fewer than three letters are unchanged.
fn misspelled(word: &str, rng: &mut Pcg64) -> String {
    let mut letters: Vec<char> = word.chars().collect();
    if letters.len() < 3 {
        return word.to_owned();
    }
    let at = rng.random_range(0..letters.len() - 1);
    if rng.random_bool(0.5) {
        letters.swap(at, at + 1);
    } else {
        letters.remove(at);
    }
    letters.into_iter().collect()
}

/// The pose with noise, as the decoder's own earlier poses have errors.
pub(super) fn noisy_pose(pose: PoseCode, rng: &mut Pcg64) -> PoseCode {
    let mut off = |value: f32, by: f32| value + rng.random_range(-by..by);
    PoseCode {
        position: pose.position.map(|value| off(value, 0.05)),
        rotation_6d: pose.rotation_6d.map(|value| off(value, 0.1)),
        log_fov: off(pose.log_fov, 0.05),
        log_wait: off(pose.log_wait, 0.1),
    }
}
