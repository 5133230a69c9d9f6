//! One key from its scores, under rules that make every sequence of keys a valid program.
//!
//! Rules: the first key begins a step, a cut is followed by a step, the last key stops. Objects are those that the text
//! names (any object when it names none), each at most once. An amount or a duration is a quantity of the right kind. The
//! first word of a span is not behind its last.

use strum::VariantArray;

use super::choice::Choice;
use cinesplat_language::QuantityKind;

use crate::codes::{
    AMOUNT_QUANTITY, AVOID_POINTER, Field, KEEP_POINTER, KeyCode, LENS_FOCAL, LENS_FOV, LOOK_AT, LOOK_POINTER,
    MAX_SUBJECTS, NEXT_CUT, NEXT_SEGMENT, NEXT_STOP, OBJECT_POINTERS, QUANTITY_POINTERS, QuantityRole,
};
use crate::error::DirectorError;
use crate::inputs::Prompt;
use crate::keys::MAX_KEYS;
use crate::network::Scores;
use crate::tensor_file::{WEIGHTS_FILE, check_finite};

/// Weight of the word span of a key in its log-likelihood, as in the training loss.
const WORDS_WEIGHT: f64 = 0.3;

/// Certainty of one key: each choice that applies, with its probability.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct KeyCertainty {
    pub(crate) choices: Vec<(Choice, f64)>,
}

/// Facts about the text that do not depend on the network.
#[derive(Debug, Clone, Default)]
pub(crate) struct WordRules {
    /// Kind of each quantity.
    pub(crate) kinds: Vec<QuantityKind>,
    /// For each token, whether it begins a word that names a camera move (`push`, `holding`).
    pub(crate) is_move: Vec<bool>,
}

/// A chosen key.
#[derive(Debug, Clone)]
pub(super) struct ChosenKey {
    pub(super) key: KeyCode,
    pub(super) certainty: KeyCertainty,
    /// Sum of the log-probabilities of all its choices.
    pub(super) log_likelihood: f64,
    /// For the first key: index of the quantity that is the length of the film.
    pub(super) film_length: Option<usize>,
}

/// Scores of one key, as [`Scores`] has them.
pub(super) struct ScoreRow {
    classes: Vec<f32>,
    objects: Vec<Vec<f32>>,
    quantities: Vec<Vec<f32>>,
    words: Vec<Vec<f32>>,
    film_length: Vec<f32>,
}

impl ScoreRow {
    /// The row of a batch of one prompt and one key.
    ///
    /// # Errors
    /// [`DirectorError::NotFinite`] · [`DirectorError::Compute`]
    pub(super) fn of(scores: &Scores) -> Result<Self, DirectorError> {
        let row = Self {
            classes: scores.classes.flatten_all()?.to_vec1()?,
            objects: scores.objects.reshape((OBJECT_POINTERS, ()))?.to_vec2()?,
            quantities: scores.quantities.reshape((QUANTITY_POINTERS, ()))?.to_vec2()?,
            words: scores.words.reshape((2, ()))?.to_vec2()?,
            film_length: scores.film_length.flatten_all()?.to_vec1()?,
        };
        let pointers = row.objects.iter().chain(&row.quantities).chain(&row.words);
        for scores in pointers.chain([&row.classes, &row.film_length]) {
            check_finite(WEIGHTS_FILE, "scores of a key", scores)?;
        }
        Ok(row)
    }
}

/// The most likely key after the keys `before`.
pub(super) fn best_key(prompt: &Prompt, rules: &WordRules, row: &ScoreRow, before: &[KeyCode]) -> ChosenKey {
    Chooser::new(prompt, rules, None).run(row, before).0
}

/// The most likely key, then up to `count` alternatives, most likely first. An alternative takes the second best option of
/// one choice and the best options of the choices after it.
pub(super) fn best_keys(
    prompt: &Prompt,
    rules: &WordRules,
    row: &ScoreRow,
    before: &[KeyCode],
    count: usize,
) -> Vec<ChosenKey> {
    let (best, num_choices) = Chooser::new(prompt, rules, None).run(row, before);
    let alternatives = (0..num_choices).map(|nth| Chooser::new(prompt, rules, Some(nth)).run(row, before).0);
    let mut others: Vec<ChosenKey> = alternatives.filter(|other| other.key != best.key).collect();
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
    /// Number of the choice that takes its second best option.
    second_best_at: Option<usize>,
    num_choices: usize,
}

impl<'a> Chooser<'a> {
    fn new(prompt: &'a Prompt, rules: &'a WordRules, second_best_at: Option<usize>) -> Self {
        Self { prompt, rules, certainty: KeyCertainty::default(), log_likelihood: 0.0, second_best_at, num_choices: 0 }
    }

    /// The key, and the number of choices that were made for it.
    fn run(mut self, row: &ScoreRow, before: &[KeyCode]) -> (ChosenKey, usize) {
        let film_length = match before {
            [] => {
                let pointer = self.quantity(Choice::FilmLength, &row.film_length, true, is_time);
                pointer.and_then(|pointer| pointer.checked_sub(1))
            }
            _ => None,
        };
        let key = self.key(row, before);
        let Self { certainty, log_likelihood, num_choices, .. } = self;
        (ChosenKey { key, certainty, log_likelihood, film_length }, num_choices)
    }

    /// Counts a choice, and returns whether it takes its second best option.
    fn next_is_second_best(&mut self) -> bool {
        self.num_choices += 1;
        self.second_best_at == Some(self.num_choices - 1)
    }

    /// The best allowed option, or the second best; `None` when no option is allowed. The reported probability is the
    /// option's softmax over all options, allowed or not.
    fn choose(&mut self, choice: Choice, scores: &[f32], allowed: impl Fn(usize) -> bool) -> Option<usize> {
        let among = |skipped: Option<usize>| {
            let fits = (0..scores.len()).filter(|idx| allowed(*idx) && Some(*idx) != skipped);
            fits.max_by(|a, b| scores[*a].total_cmp(&scores[*b]))
        };
        let best = among(None)?;
        let chosen = if self.next_is_second_best() { among(Some(best)).unwrap_or(best) } else { best };
        let probability = log_softmax(scores, chosen).exp();
        self.certainty.choices.push((choice, probability));
        self.log_likelihood += probability.max(f64::MIN_POSITIVE).ln();
        Some(chosen)
    }

    fn key(&mut self, row: &ScoreRow, before: &[KeyCode]) -> KeyCode {
        let mut key = KeyCode::default();
        let next = self.next(&row.classes, before);
        let is_first = before.is_empty();
        let mut offset = 0;
        for (field_idx, field) in Field::VARIANTS.iter().copied().enumerate() {
            let scores = &row.classes[offset..offset + field.num_classes()];
            offset += field.num_classes();
            if field == Field::Next {
                key.classes[field_idx] = Some(next);
            } else if field.applies(next, is_first) {
                let has = |fits: fn(QuantityKind) -> bool| self.rules.kinds.iter().any(|kind| fits(*kind));
                let has_object = !self.prompt.objects.is_empty();
                let allowed = |class: usize| match (field, class as u8) {
                    (Field::Amount, AMOUNT_QUANTITY) => has(is_extent),
                    (Field::Via, class) => has_object || class == 0,
                    (Field::Look, LOOK_AT) => has_object,
                    (Field::ArriveLens | Field::DepartLens, LENS_FOCAL) => has(is_focal_length),
                    (Field::ArriveLens | Field::DepartLens, LENS_FOV) => has(is_angle),
                    _ => true,
                };
                key.classes[field_idx] = self.choose(Choice::Class(field), scores, allowed).map(|class| class as u8);
            }
        }
        self.point(row, &mut key, is_first);
        key
    }

    /// Class of [`Field::Next`].
    fn next(&mut self, classes: &[f32], before: &[KeyCode]) -> u8 {
        let room = MAX_KEYS - before.len();
        let after_cut = before.last().is_some_and(|key| key.class(Field::Next) == NEXT_CUT);
        let must_move = before.is_empty() || after_cut;
        let allowed = |class: usize| match class as u8 {
            NEXT_SEGMENT => room >= 2,
            NEXT_CUT => room >= 3 && !must_move,
            // A prompt may ask for nothing that a camera could do.
            _ => before.is_empty() || !must_move || room < 2,
        };
        let scores = &classes[..Field::Next.num_classes()];
        self.choose(Choice::Class(Field::Next), scores, allowed).map_or(NEXT_STOP, |class| class as u8)
    }

    /// Sets the pointers of a key whose classes are set.
    fn point(&mut self, row: &ScoreRow, key: &mut KeyCode, is_first: bool) {
        if !is_first {
            self.objects(Choice::EndSubjects, &row.objects, 0..MAX_SUBJECTS, false, key);
            self.quantities(row, key, true);
        }
        if key.class(Field::Next) != NEXT_SEGMENT {
            return;
        }
        self.objects(Choice::StartSubjects, &row.objects, MAX_SUBJECTS..2 * MAX_SUBJECTS, false, key);
        if key.class(Field::Via) > 0 {
            self.objects(Choice::PassedObjects, &row.objects, 2 * MAX_SUBJECTS..3 * MAX_SUBJECTS, true, key);
        }
        if key.class(Field::Look) == LOOK_AT {
            self.objects(Choice::Look, &row.objects, LOOK_POINTER..LOOK_POINTER + 1, true, key);
        }
        self.objects(Choice::Keep, &row.objects, KEEP_POINTER..KEEP_POINTER + 1, false, key);
        self.objects(Choice::Avoid, &row.objects, AVOID_POINTER..AVOID_POINTER + 1, false, key);
        self.quantities(row, key, false);
        key.span = self.words(&row.words);
    }

    /// Sets the pointers at the quantities that describe the arrival at the key, or what departs from it.
    fn quantities(&mut self, row: &ScoreRow, key: &mut KeyCode, arrival: bool) {
        for role in QuantityRole::VARIANTS.iter().copied().filter(|role| role.is_arrival() == arrival) {
            let lens = |field| match key.class(field) {
                LENS_FOCAL => Some(is_focal_length as fn(QuantityKind) -> bool),
                LENS_FOV => Some(is_angle as fn(QuantityKind) -> bool),
                _ => None,
            };
            let (fits, optional) = match role {
                QuantityRole::Amount if key.class(Field::Amount) == AMOUNT_QUANTITY => (Some(is_extent as _), false),
                QuantityRole::Amount => (None, false),
                QuantityRole::Duration => (Some(is_time as _), true),
                QuantityRole::ArriveHeightFrac | QuantityRole::DepartHeightFrac => (Some(is_share as _), true),
                QuantityRole::ArriveElevation | QuantityRole::DepartElevation => (Some(is_angle as _), true),
                QuantityRole::ArriveLens => (lens(Field::ArriveLens), false),
                QuantityRole::DepartLens => (lens(Field::DepartLens), false),
                _ => (Some(is_length as _), true),
            };
            if let Some(fits) = fits {
                let pointer = self.quantity(Choice::Quantity(role), &row.quantities[role as usize], optional, fits);
                key.quantities[role as usize] = pointer.map(|pointer| pointer as u8);
            }
        }
    }

    /// Sets the pointers of a range to different objects; `needed` requires at least one.
    fn objects(
        &mut self,
        choice: Choice,
        scores: &[Vec<f32>],
        pointers: std::ops::Range<usize>,
        needed: bool,
        key: &mut KeyCode,
    ) {
        let named = self.prompt.num_named;
        let limit = if named > 0 { named } else { self.prompt.objects.len() };
        let mut taken: Vec<usize> = Vec::new();
        for (rank, place) in pointers.clone().enumerate() {
            let must = needed && rank == 0 && limit > 0;
            let allowed = |pointer: usize| match pointer {
                0 => !must,
                pointer => pointer <= limit && !taken.contains(&pointer),
            };
            let pointer = self.choose(choice, &scores[place], allowed).unwrap_or(0);
            if pointer == 0 {
                break;
            }
            taken.push(pointer);
        }
        for (rank, place) in pointers.enumerate() {
            key.objects[place] = Some(taken.get(rank).map_or(0, |pointer| *pointer as u8));
        }
    }

    /// Pointer at a quantity of a kind that `fits`; `optional` allows none (pointer 0).
    fn quantity(
        &mut self,
        choice: Choice,
        scores: &[f32],
        optional: bool,
        fits: impl Fn(QuantityKind) -> bool,
    ) -> Option<usize> {
        let kinds = &self.rules.kinds;
        if optional && !kinds.iter().any(|kind| fits(*kind)) {
            return Some(0);
        }
        let allowed = |pointer: usize| match pointer.checked_sub(1) {
            None => optional,
            Some(idx) => kinds.get(idx).is_some_and(|kind| fits(*kind)),
        };
        self.choose(choice, scores, allowed)
    }

    /// The most likely first and last token with first <= last, without the token that begins the text; or the most likely
    /// pair with another last token.
    fn words(&mut self, scores: &[Vec<f32>]) -> Option<[usize; 2]> {
        let num_tokens = self.prompt.tokens.len();
        let best = best_span(scores, num_tokens, None)?;
        let second = if self.next_is_second_best() { best_span(scores, num_tokens, Some(best[1])) } else { None };
        let [first, last] = second.unwrap_or(best);
        self.log_likelihood += WORDS_WEIGHT * (log_softmax(&scores[0], first) + log_softmax(&scores[1], last));
        Some([first, last])
    }
}

fn is_time(kind: QuantityKind) -> bool {
    kind == QuantityKind::Seconds
}

fn is_angle(kind: QuantityKind) -> bool {
    kind == QuantityKind::Degrees
}

fn is_length(kind: QuantityKind) -> bool {
    kind == QuantityKind::Units
}

fn is_share(kind: QuantityKind) -> bool {
    kind == QuantityKind::Percent
}

fn is_focal_length(kind: QuantityKind) -> bool {
    kind == QuantityKind::Millimeters
}

/// Whether a quantity can be the extent of a move.
fn is_extent(kind: QuantityKind) -> bool {
    matches!(kind, QuantityKind::Degrees | QuantityKind::Units | QuantityKind::Factor)
}

/// Log-probability of one option.
fn log_softmax(scores: &[f32], chosen: usize) -> f64 {
    let top = scores.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let sum: f64 = scores.iter().map(|score| f64::from(score - top).exp()).sum();
    f64::from(scores[chosen] - top) - sum.ln()
}

/// The span of the highest score whose last token is not `not_last`.
fn best_span(scores: &[Vec<f32>], num_tokens: usize, not_last: Option<usize>) -> Option<[usize; 2]> {
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
