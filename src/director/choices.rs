//! The choices of one key out of its scores, under rules: what comes out can always be carried out.
//!
//! Rules: the first key begins a step, a cut is followed by a step, the last key stops; objects are those that the text
//! names (any where it names none), each once; an amount or a duration is a quantity of the right kind; words run forward.

use super::codes::{
    AMOUNT_QUANTITY, Field, KeyCode, NEXT_CUT, NEXT_SEGMENT, NEXT_STOP, NUM_FIELDS, OBJECT_POINTERS, PLACES,
};
use super::keys::MAX_KEYS;
use super::model::{Prompt, Scores};

/// Weight of the words of a key in its likelihood, as in training.
const WORDS_WEIGHT: f64 = 0.3;

/// How sure the network is of one key: the probability of each choice that it made.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct KeyCertainty {
    /// `(what, probability)`, only choices that apply.
    pub choices: Vec<(&'static str, f64)>,
}

/// What is known of the words before the network reads them.
#[derive(Debug, Clone, Default)]
pub struct WordRules {
    /// Quantities that are times.
    pub is_time: Vec<bool>,
    /// Tokens that surely tell of a move: `push`, `holding`.
    pub is_move: Vec<bool>,
}

/// A key that was chosen.
#[derive(Debug, Clone)]
pub(super) struct ChosenKey {
    pub(super) key: KeyCode,
    pub(super) certainty: KeyCertainty,
    /// Logarithm of the likelihood of all its choices.
    pub(super) log_likelihood: f64,
    /// For the first key: place of the film's length among the quantities.
    pub(super) film: Option<usize>,
}

/// Scores of one key.
pub(super) struct ScoreRow {
    classes: Vec<f32>,
    objects: Vec<Vec<f32>>,
    quantities: Vec<Vec<f32>>,
    words: Vec<Vec<f32>>,
    film: Vec<f32>,
}

impl ScoreRow {
    /// The only row of scores of one prompt and one key.
    pub(super) fn of(scores: &Scores) -> candle_core::Result<Self> {
        Ok(Self {
            classes: scores.classes.flatten_all()?.to_vec1()?,
            objects: scores.objects.reshape((OBJECT_POINTERS, ()))?.to_vec2()?,
            quantities: scores.quantities.reshape((2, ()))?.to_vec2()?,
            words: scores.words.reshape((2, ()))?.to_vec2()?,
            film: scores.film.flatten_all()?.to_vec1()?,
        })
    }
}

/// The likeliest key after those `before`.
pub(super) fn likeliest(prompt: &Prompt, rules: &WordRules, row: &ScoreRow, before: &[KeyCode]) -> ChosenKey {
    Chooser::new(prompt, rules, None).run(row, before).0
}

/// The likeliest key, and the keys that take the second best of one choice, at most `count` of them, best first.
pub(super) fn alternatives(
    prompt: &Prompt,
    rules: &WordRules,
    row: &ScoreRow,
    before: &[KeyCode],
    count: usize,
) -> Vec<ChosenKey> {
    let (best, num_choices) = Chooser::new(prompt, rules, None).run(row, before);
    let twisted = (0..num_choices).map(|nth| Chooser::new(prompt, rules, Some(nth)).run(row, before).0);
    let mut others: Vec<ChosenKey> = twisted.filter(|other| other.key != best.key).collect();
    others.sort_by(|a, b| b.log_likelihood.total_cmp(&a.log_likelihood));
    others.truncate(count);
    others.insert(0, best);
    others
}

struct Chooser<'a> {
    prompt: &'a Prompt,
    rules: &'a WordRules,
    certainty: KeyCertainty,
    log_likelihood: f64,
    /// Which choice takes the second best.
    twist: Option<usize>,
    num_choices: usize,
}

impl<'a> Chooser<'a> {
    fn new(prompt: &'a Prompt, rules: &'a WordRules, twist: Option<usize>) -> Self {
        Self { prompt, rules, certainty: KeyCertainty::default(), log_likelihood: 0.0, twist, num_choices: 0 }
    }

    /// The key, and how many choices it took.
    fn run(mut self, row: &ScoreRow, before: &[KeyCode]) -> (ChosenKey, usize) {
        let film = match before {
            [] => self.quantity("film length", &row.film, true).and_then(|place| place.checked_sub(1)),
            _ => None,
        };
        let key = self.key(row, before);
        let Self { certainty, log_likelihood, num_choices, .. } = self;
        (ChosenKey { key, certainty, log_likelihood, film }, num_choices)
    }

    /// Whether the choice that is due now takes the second best.
    fn twists(&mut self) -> bool {
        self.num_choices += 1;
        self.twist == Some(self.num_choices - 1)
    }

    /// The best choice among those allowed (or the second best), with its probability among all.
    fn choose(&mut self, what: &'static str, scores: &[f32], allowed: impl Fn(usize) -> bool) -> Option<usize> {
        let among = |skipped: Option<usize>| {
            let fits = (0..scores.len()).filter(|idx| allowed(*idx) && Some(*idx) != skipped);
            fits.max_by(|a, b| scores[*a].total_cmp(&scores[*b]))
        };
        let best = among(None)?;
        let chosen = if self.twists() { among(Some(best)).unwrap_or(best) } else { best };
        let probability = log_softmax(scores, chosen).exp();
        self.certainty.choices.push((what, probability));
        self.log_likelihood += probability.max(f64::MIN_POSITIVE).ln();
        Some(chosen)
    }

    fn key(&mut self, row: &ScoreRow, before: &[KeyCode]) -> KeyCode {
        let mut key = KeyCode::default();
        let next = self.next(&row.classes, before);
        let is_first = before.is_empty();
        let mut offset = 0;
        for field_idx in 0..NUM_FIELDS {
            let field = Field::ALL[field_idx];
            let scores = &row.classes[offset..offset + field.num_classes()];
            offset += field.num_classes();
            if field == Field::Next {
                key.classes[field_idx] = Some(next);
            } else if field.applies(next, is_first) {
                let has_quantity = self.rules.is_time.iter().any(|is_time| !is_time);
                let has_object = !self.prompt.objects.is_empty();
                let allowed = |class: usize| match field {
                    Field::Amount => has_quantity || class != usize::from(AMOUNT_QUANTITY),
                    Field::Via => has_object || class == 0,
                    _ => true,
                };
                key.classes[field_idx] = self.choose(field.name(), scores, allowed).map(|class| class as u8);
            }
        }
        self.point(row, &mut key, is_first);
        key
    }

    fn next(&mut self, classes: &[f32], before: &[KeyCode]) -> u8 {
        let room = MAX_KEYS - before.len();
        let after_cut = before.last().is_some_and(|key| key.class(Field::Next) == NEXT_CUT);
        let must_move = before.is_empty() || after_cut;
        let allowed = |class: usize| match class as u8 {
            NEXT_SEGMENT => room >= 2,
            NEXT_CUT => room >= 3 && !must_move,
            _ => !must_move || room < 2,
        };
        let scores = &classes[..Field::Next.num_classes()];
        self.choose(Field::Next.name(), scores, allowed).map_or(NEXT_STOP, |class| class as u8)
    }

    /// Sets the pointers of a key whose classes are set.
    fn point(&mut self, row: &ScoreRow, key: &mut KeyCode, is_first: bool) {
        if !is_first {
            self.objects("end subjects", &row.objects, 0, false, key);
        }
        if key.class(Field::Next) != NEXT_SEGMENT {
            return;
        }
        self.objects("start subjects", &row.objects, PLACES, false, key);
        if key.class(Field::Via) > 0 {
            self.objects("objects on the way", &row.objects, 2 * PLACES, true, key);
        }
        if key.class(Field::Amount) == AMOUNT_QUANTITY {
            key.quantities[0] = self.quantity("amount", &row.quantities[0], false).map(|place| place as u8);
        }
        key.quantities[1] = self.quantity("duration", &row.quantities[1], true).map(|place| place as u8);
        key.span = self.words(&row.words);
    }

    /// Up to [`PLACES`] different objects; `needed`: at least one.
    fn objects(&mut self, what: &'static str, scores: &[Vec<f32>], first: usize, needed: bool, key: &mut KeyCode) {
        let named = self.prompt.num_named;
        let limit = if named > 0 { named } else { self.prompt.objects.len() };
        let mut taken: Vec<usize> = Vec::new();
        for rank in 0..PLACES {
            let must = needed && rank == 0 && limit > 0;
            let allowed = |place: usize| match place {
                0 => !must,
                place => place <= limit && !taken.contains(&place),
            };
            let place = self.choose(what, &scores[first + rank], allowed).unwrap_or(0);
            if place == 0 {
                break;
            }
            taken.push(place);
        }
        for rank in 0..PLACES {
            key.objects[first + rank] = Some(taken.get(rank).map_or(0, |place| *place as u8));
        }
    }

    /// A quantity that is a time, or that is none; for a time also nothing (0).
    fn quantity(&mut self, what: &'static str, scores: &[f32], time: bool) -> Option<usize> {
        let is_time = &self.rules.is_time;
        let allowed = |place: usize| match place.checked_sub(1) {
            None => time,
            Some(place) => is_time.get(place) == Some(&time),
        };
        self.choose(what, scores, allowed)
    }

    /// The likeliest first and last token with first <= last, never the token that begins the text; or the likeliest
    /// that ends elsewhere.
    fn words(&mut self, scores: &[Vec<f32>]) -> Option<[usize; 2]> {
        let best = likeliest_span(scores, self.prompt.tokens.len(), None)?;
        let twisted =
            if self.twists() { likeliest_span(scores, self.prompt.tokens.len(), Some(best[1])) } else { None };
        let [first, last] = twisted.unwrap_or(best);
        self.log_likelihood += WORDS_WEIGHT * (log_softmax(&scores[0], first) + log_softmax(&scores[1], last));
        Some([first, last])
    }
}

/// Logarithm of the probability of one of several choices.
fn log_softmax(scores: &[f32], chosen: usize) -> f64 {
    let top = scores.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let sum: f64 = scores.iter().map(|score| f64::from(score - top).exp()).sum();
    f64::from(scores[chosen] - top) - sum.ln()
}

fn likeliest_span(scores: &[Vec<f32>], num_tokens: usize, not_last: Option<usize>) -> Option<[usize; 2]> {
    let mut best: Option<([usize; 2], f32)> = None;
    let mut first = 1;
    for last in 1..num_tokens {
        if scores[0][last] > scores[0][first] {
            first = last;
        }
        let score = scores[0][first] + scores[1][last];
        if Some(last) != not_last && best.is_none_or(|(_, top)| score > top) {
            best = Some(([first, last], score));
        }
    }
    best.map(|(span, _)| span)
}
