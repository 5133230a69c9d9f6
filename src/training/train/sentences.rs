//! Sentences of the corpus as training data: alone, joined, with wishes, corrections and asides.
//!
//! What people add to a request (`no zoom`, `keep it in the middle`, `8 seconds`, `no wait, the other one`) they add to any
//! request. So training glues the phrases of `prompts/modifiers.txt` to the sentences of the corpus, and sentences to each
//! other as lists: the clauses are people's, only their combination is random.

use cinesplat_language::{Linked, Mention, link_mentions};
use cinesplat_operator::Program;
use rand::seq::{IndexedRandom, SliceRandom};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::joining::join;
use super::modifiers::{Modifier, Modifiers, Position, Wish};
use super::sentence::Sentence;
use super::slips::with_slip;
use super::wishes::with_wish;
use crate::corpus::{CorpusSentence, Split, Writer};

/// Fraction of the draws that join sentences.
const JOINED_FRAC: f64 = 0.3;
/// Fraction of the sentences of one step that get a wish; a third of them get two.
const WISH_FRAC: f64 = 0.3;
/// Fraction of all draws that get a wish for the film.
const FILM_WISH_FRAC: f64 = 0.15;
/// Fraction of all draws with an aside before them, and the same behind.
const ASIDE_FRAC: f64 = 0.15;
/// Fraction of the sentences of one step that follow a request that is taken back.
const CORRECTION_FRAC: f64 = 0.03;
/// Fraction of the sentences of one step in which a direction is said wrongly first.
const SLIP_FRAC: f64 = 0.06;
/// Words between joined sentences besides those of the modifiers.
const CONNECTIVES: [&str; 12] =
    [", then", ". then", "then", ", and then", ".", ". next,", ", after that", "and", ",", ";", "->", "/"];
/// Most words of a joined sentence.
const MAX_WORDS: usize = 90;

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

    /// The texts with placeholders, those of the modifiers too.
    pub(super) fn texts(&self) -> impl Iterator<Item = &str> {
        self.all.iter().map(|sentence| sentence.linked.tokens_text.as_str())
    }

    /// Number of sentences.
    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    /// A random sentence as somebody might type it; `None` without sentences.
    pub(super) fn draw(&self, rng: &mut Pcg64) -> Option<Sentence> {
        let joined = if rng.random_bool(JOINED_FRAC) { self.draw_list(rng) } else { None };
        let mut drawn = match joined {
            Some(joined) => joined,
            None => self.draw_one(rng)?,
        };
        let modifiers = Modifiers::embedded();
        if rng.random_bool(FILM_WISH_FRAC) {
            drawn = wished(drawn, &modifiers.films, rng);
        }
        if rng.random_bool(ASIDE_FRAC) {
            drawn = beside(drawn, modifiers.asides.draw(Position::Before, rng), Position::Before);
        }
        if rng.random_bool(ASIDE_FRAC) {
            drawn = beside(drawn, modifiers.asides.draw(Position::After, rng), Position::After);
        }
        Some(drawn)
    }

    /// A sentence of the corpus; one of one step perhaps with wishes or slips.
    fn draw_one(&self, rng: &mut Pcg64) -> Option<Sentence> {
        let idx = (!self.all.is_empty()).then(|| rng.random_range(0..self.all.len()))?;
        if self.single.binary_search(&idx).is_err() {
            return self.all.get(idx).cloned();
        }
        let mut drawn = with_wishes(self.all.get(idx)?.clone(), rng);
        if rng.random_bool(SLIP_FRAC) {
            drawn = with_slip(drawn, &Modifiers::embedded().corrections, rng);
        }
        if rng.random_bool(CORRECTION_FRAC) {
            drawn = self.corrected(drawn, rng);
        }
        Some(drawn)
    }

    /// Another request, which the correction behind it takes back, and the sentence.
    fn corrected(&self, sentence: Sentence, rng: &mut Pcg64) -> Sentence {
        let wrong = self.single.choose(rng).and_then(|idx| self.all.get(*idx));
        let mark = Modifiers::embedded().corrections.choose(rng);
        let (Some(wrong), Some(mark)) = (wrong, mark) else { return sentence };
        let wrong = Sentence { program: Program::default(), ..wrong.clone() };
        let joined = join(wrong, &phrase(mark)).and_then(|(both, _)| join(both, &sentence));
        joined.map_or(sentence, |(joined, _)| joined)
    }

    /// Two to five sentences of one step as a list; `None` without enough sentences.
    fn draw_list(&self, rng: &mut Pcg64) -> Option<Sentence> {
        let count = 2 + [0.5, 0.4, 0.4].iter().take_while(|more| rng.random_bool(**more)).count();
        let form = Form::draw(rng);
        let mut list: Option<Sentence> = None;
        for number in 0..count {
            let mut next = with_wishes(self.all.get(*self.single.choose(rng)?)?.clone(), rng);
            own_duration(&mut next);
            let so_far = list.as_ref().map_or(0, |list| list.linked.spans.len());
            if so_far + next.linked.spans.len() > MAX_WORDS {
                break;
            }
            let words = phrase(&form.words(number, count, &mut next, rng));
            let begun = match list.take() {
                Some(list) => join(list, &words)?.0,
                None => words,
            };
            list = Some(join(begun, &next)?.0);
        }
        list
    }
}

/// How the parts of a list are told apart.
enum Form {
    /// Words between the parts.
    Links,
    /// Number or words at each part.
    Orders([String; 3]),
    /// A number and this sign at each part.
    Numbers(&'static str),
    /// Times at each part, counted from the start of the film so far.
    Times(std::cell::Cell<u32>),
}

impl Form {
    fn draw(rng: &mut Pcg64) -> Self {
        let orders = Modifiers::embedded().orders.choose(rng).cloned();
        match rng.random_range(0..10) {
            0 => Self::Numbers([".", ")", ":", " -"][rng.random_range(0..4)]),
            1 => Self::Times(0.into()),
            2 => orders.map_or(Self::Links, Self::Orders),
            _ => Self::Links,
        }
    }

    /// Words before part `number`, whose step they may cut to or time.
    fn words(&self, number: usize, count: usize, part: &mut Sentence, rng: &mut Pcg64) -> String {
        let modifiers = Modifiers::embedded();
        let Some(step) = part.program.steps.first_mut() else { return String::new() };
        match self {
            Self::Links if number == 0 => String::new(),
            Self::Links if rng.random_bool(0.12) && !modifiers.cuts.is_empty() => {
                step.cut = true;
                modifiers.cuts.choose(rng).cloned().unwrap_or_default()
            }
            Self::Links if rng.random_bool(0.5) => modifiers.links.choose(rng).cloned().unwrap_or_default(),
            Self::Links => CONNECTIVES.choose(rng).copied().unwrap_or_default().to_owned(),
            Self::Orders([first, ..]) if number == 0 => first.clone(),
            Self::Orders([.., last]) if number + 1 == count => format!(", {last}"),
            Self::Orders([_, next, _]) => format!(", {next}"),
            Self::Numbers(sign) => format!("{}{}{sign}", if number == 0 { "" } else { ". " }, number + 1),
            Self::Times(now) if step.duration_secs.is_none() => {
                let secs = rng.random_range(2..=8);
                let (start, end) = (now.get(), now.get() + secs);
                now.set(end);
                step.duration_secs = Some(f64::from(secs));
                let clock = |at: u32| format!("{}:{:02}", at / 60, at % 60);
                format!("{}{}-{}", if number == 0 { "" } else { ", " }, clock(start), clock(end))
            }
            Self::Times(_) => ",".to_owned(),
        }
    }
}

/// The words without steps; an empty sentence for words that are none.
fn phrase(text: &str) -> Sentence {
    let padded = link_mentions(&format!("{text} x"), &[] as &[Mention]).unwrap_or_default();
    let mut linked = padded;
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let kept = words.len().saturating_sub(1);
    linked.tokens_text = words[..kept].join(" ");
    linked.spans.truncate(kept);
    Sentence { linked, ..Sentence::default() }
}

/// The sentence perhaps with one wish or two for its step.
fn with_wishes(mut sentence: Sentence, rng: &mut Pcg64) -> Sentence {
    if rng.random_bool(WISH_FRAC) {
        sentence = wished(sentence, &Modifiers::embedded().steps, rng);
        if rng.random_bool(0.33) {
            sentence = wished(sentence, &Modifiers::embedded().steps, rng);
        }
    }
    sentence
}

/// The sentence with one of the wishes, or as it is where the wish does not fit.
fn wished(sentence: Sentence, wishes: &[Modifier], rng: &mut Pcg64) -> Sentence {
    let position = if rng.random_bool(0.25) { Position::Before } else { Position::After };
    let Some(wish) = wishes.choose(rng).and_then(|modifier| modifier.draw(position, rng)) else { return sentence };
    let Some((mut joined, id_offset)) = glued(&sentence, &wish, position) else { return sentence };
    let Some(program) = with_wish(&joined.program, &wish, [1 + id_offset, 2 + id_offset]) else { return sentence };
    joined.program = program;
    if !wish.step.is_empty() {
        let whole =
            joined.linked.spans.first().zip(joined.linked.spans.last()).map(|([start, _], [_, end])| [*start, *end]);
        if let [step] = &mut joined.program.steps[..] {
            step.words = step.words.and(whole);
        }
    }
    joined
}

/// The sentence with a phrase that means nothing to the camera.
fn beside(sentence: Sentence, wish: Option<Wish>, position: Position) -> Sentence {
    let Some(wish) = wish else { return sentence };
    glued(&sentence, &wish, position).map_or(sentence, |(joined, _)| joined)
}

/// The sentence with the words of a wish, and how much the ids of these words grew; `None` as [`join`].
fn glued(sentence: &Sentence, wish: &Wish, position: Position) -> Option<(Sentence, u32)> {
    let words = Sentence { linked: wish.linked.clone(), ..Sentence::default() };
    match position {
        Position::Before => join(words, sentence).map(|(joined, _)| (joined, 0)),
        Position::After => join(sentence.clone(), &words),
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

/// Sentences as training draws them: words with placeholders, and the program.
pub fn drawn_sentences(writers: &[Writer], count: usize, seed: u64) -> Vec<(Linked, Program)> {
    let sentences = Sentences::of(writers, None, seed);
    let mut rng = Pcg64::seed_from_u64(seed);
    let drawn = std::iter::repeat_with(|| sentences.draw(&mut rng)).map_while(|drawn| drawn);
    drawn.take(count).map(|Sentence { linked, program, .. }| (linked, program)).collect()
}
