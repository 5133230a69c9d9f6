//! Sentences of the corpus as training data, alone or joined.
//!
//! Two or three sentences of one step each, joined by a connective, give a sentence of several steps: their clauses are
//! people's, only their order is random.

use cinesplat_language::Linked;
use cinesplat_operator::Program;
use rand::seq::{IndexedRandom, SliceRandom};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::corpus::{CorpusSentence, Split, Writer};

/// Fraction of the draws that join sentences.
const JOINED_FRAC: f64 = 0.2;
/// Words between joined sentences, each one token of the linked text.
const CONNECTIVES: [&str; 14] = [
    ", then",
    ". then",
    "then",
    ", and then",
    "and then",
    ".",
    ". next ,",
    ", after that",
    "and",
    ",",
    ";",
    "- >",
    "/",
    ", followed by",
];
/// Distance between the ids of joined sentences.
const ID_STEP: u32 = 100_000;

/// A sentence with its meaning, in which groups stand for their members.
#[derive(Debug, Clone)]
pub(super) struct Sentence {
    pub(super) linked: Linked,
    pub(super) program: Program,
    /// Bytes that the notation cannot say.
    pub(super) unmet: Vec<[usize; 2]>,
}

/// The sentences that training draws from.
#[derive(Debug, Clone, Default)]
pub(super) struct Sentences {
    all: Vec<Sentence>,
    /// Indices of the sentences of one step.
    single: Vec<usize>,
}

impl Sentences {
    /// The sentences of the training writers, or that many of them, drawn with a seed.
    pub(super) fn of(writers: &[Writer], limit: Option<usize>, seed: u64) -> Self {
        let training = writers.iter().filter(|writer| writer.split == Split::Training);
        let mut all: Vec<Sentence> = training.flat_map(|writer| writer.sentences.iter().map(sentence)).collect();
        if let Some(limit) = limit {
            all.shuffle(&mut Pcg64::seed_from_u64(seed));
            all.truncate(limit);
        }
        let is_single = |sentence: &Sentence| {
            sentence.program.steps.len() == 1
                && sentence.program.forbidden.is_empty()
                && sentence.unmet.is_empty()
                && sentence.linked.groups.is_empty()
                && sentence.linked.spans.len() <= 24
        };
        let single = (0..all.len()).filter(|idx| is_single(&all[*idx])).collect();
        Self { all, single }
    }

    /// The texts with placeholders.
    pub(super) fn texts(&self) -> impl Iterator<Item = &str> {
        self.all.iter().map(|sentence| sentence.linked.tokens_text.as_str())
    }

    /// Number of sentences.
    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    /// A random sentence, or several of one step joined; `None` without sentences.
    pub(super) fn draw(&self, rng: &mut Pcg64) -> Option<Sentence> {
        if self.single.len() < 2 || !rng.random_bool(JOINED_FRAC) {
            return self.all.choose(rng).cloned();
        }
        let count = if rng.random_bool(0.3) { 3 } else { 2 };
        let mut joined = self.all.get(*self.single.choose(rng)?)?.clone();
        own_duration(&mut joined);
        for _ in 1..count {
            let mut next = self.all.get(*self.single.choose(rng)?)?.clone();
            own_duration(&mut next);
            let connective = CONNECTIVES.choose(rng).copied().unwrap_or_default();
            joined = join(joined, connective, &next);
        }
        Some(joined)
    }
}

fn sentence(sentence: &CorpusSentence) -> Sentence {
    Sentence {
        linked: sentence.linked.clone(),
        program: sentence.program.clone().with_ids(&|ids| sentence.linked.grouped(ids)),
        unmet: sentence.unmet.clone(),
    }
}

/// Turns the length of a film of one step into the duration of that step.
fn own_duration(sentence: &mut Sentence) {
    if let ([step], Some(secs)) = (&mut sentence.program.steps[..], sentence.program.duration_secs.take()) {
        step.duration_secs = Some(secs);
    }
}

/// `first`, the connective, then `second` with other ids.
fn join(mut first: Sentence, connective: &str, second: &Sentence) -> Sentence {
    let linked = &mut first.linked;
    let trimmed = linked.tokens_text.trim_end_matches([' ', '.', '!']).len();
    let num_words = linked.tokens_text[..trimmed].split(' ').count();
    linked.tokens_text.truncate(trimmed);
    linked.spans.truncate(num_words);
    let offset = linked.spans.last().map_or(0, |[_, end]| *end) + 1;
    for (nth, word) in connective.split(' ').enumerate() {
        linked.tokens_text.push(' ');
        linked.tokens_text.push_str(word);
        linked.spans.push([offset + nth, offset + nth + 1]);
    }
    let offset = offset + 16;
    let (num_slots, num_quantities) = (linked.slots.len(), linked.quantities.len());
    for word in second.linked.tokens_text.split(' ') {
        let shifted = |prefix: &str, by: usize| {
            let number: usize = word.strip_prefix(prefix)?.strip_suffix('>')?.parse().ok()?;
            Some(format!("{prefix}{}>", number + by))
        };
        let word = shifted("<obj-", num_slots).or_else(|| shifted("<qty-", num_quantities)).unwrap_or(word.to_owned());
        linked.tokens_text.push(' ');
        linked.tokens_text.push_str(&word);
    }
    linked.spans.extend(second.linked.spans.iter().map(|span| span.map(|byte| byte + offset)));
    let id_offset = ID_STEP * (linked.slots.iter().max().copied().unwrap_or(0) / ID_STEP + 1);
    linked.slots.extend(second.linked.slots.iter().map(|id| id + id_offset));
    linked.quantities.extend(second.linked.quantities.iter().copied());
    let program = second.program.clone().with_ids(&|ids| ids.iter().map(|id| id + id_offset).collect());
    for mut step in program.steps {
        step.words = step.words.map(|words| words.map(|byte| byte + offset));
        first.program.steps.push(step);
    }
    first
}
