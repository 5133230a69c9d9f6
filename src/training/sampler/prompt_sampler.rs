//! Samples labeled prompts, and objects for them to mention.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

use super::compose::{Composed, compose};
use super::exam::{exam, exam_objects};
use super::expansion::TemplateSplit;
use super::grammar::Grammar;
use super::labeled_prompt::LabeledPrompt;
use cinesplat_language::{LanguageError, Lexicon, Linked, NamedObject, link};
use cinesplat_operator::{Amount, Framing, Program, Step};
use cinesplat_trajectory::Move;

/// Samples prompts labeled with their meaning.
#[derive(Debug, Clone, Copy)]
pub struct PromptSampler {
    grammar: &'static Grammar,
    lexicon: &'static Lexicon,
    split: TemplateSplit,
}

impl PromptSampler {
    /// The sampler of the grammar and lexicon that the program ships, on the train split.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] when an embedded file is malformed.
    pub fn embedded() -> Result<Self, LanguageError> {
        Ok(Self { grammar: Grammar::embedded()?, lexicon: Lexicon::embedded()?, split: TemplateSplit::Train })
    }

    /// The same sampler on another split of the templates.
    #[must_use]
    pub fn with_split(self, split: TemplateSplit) -> Self {
        Self { split, ..self }
    }

    /// A prompt about some of `objects`; the same state of `rng` gives the same prompt.
    ///
    /// Rejection sampling: a draw is kept only if linking its prompt finds exactly the objects and quantities of its
    /// program, and if it is not a sentence of the [`exam()`], with any objects. The held-out split also rejects a draw
    /// without a held-out template, up to the 301st draw. After 400 rejected draws the prompt is `Push in on <obj-N>.`
    /// or `Pan left.`
    pub fn sample(&self, objects: &[NamedObject], rng: &mut Pcg64) -> LabeledPrompt {
        for attempt in 0..400 {
            let Some(composed) = compose(self.grammar, self.split, objects, rng) else { continue };
            let fits_split = self.split == TemplateSplit::Train || composed.held_out || attempt > 300;
            let Ok(linked) = link(&composed.labeled.prompt, objects) else { continue };
            if fits_split && links_as_meant(&linked, &composed) && !exam_sentences().contains(unpunctuated(&linked)) {
                return composed.labeled;
            }
        }
        fallback(objects, rng)
    }

    /// `count` invented objects, at most 60,000, with different ids. A label is a noun of the lexicon after up to two
    /// adjectives; some objects have none.
    pub fn invent_objects(&self, count: usize, rng: &mut Pcg64) -> Vec<NamedObject> {
        let mut objects: Vec<NamedObject> = Vec::new();
        let adjectives: Vec<&str> = self.lexicon.adjectives().collect();
        while objects.len() < count.min(60_000) {
            let id = rng.random_range(1..=if count < 60 { 99 } else { 65_535 });
            if objects.iter().any(|object| object.id == id) {
                continue;
            }
            objects.push(NamedObject { id, label: self.invent_label(&adjectives, rng) });
        }
        objects
    }

    fn invent_label(&self, adjectives: &[&str], rng: &mut Pcg64) -> String {
        if rng.random_bool(0.06) {
            return String::new();
        }
        let noun = self.lexicon.nouns().choose(rng).cloned().unwrap_or_default();
        let count = match rng.random_range(0..10) {
            0..3 => 0,
            3..9 => 1,
            _ => 2,
        };
        let mut words: Vec<&str> = (0..count).filter_map(|_| adjectives.choose(rng).copied()).collect();
        words.dedup();
        words.push(&noun);
        words.join(" ")
    }
}

/// Whether linking found exactly the mentions and quantities that the composer wrote.
fn links_as_meant(linked: &Linked, composed: &Composed) -> bool {
    let values = quantities_of(&composed.labeled.program);
    let is_found = |value: &f64| linked.quantities.iter().any(|quantity| (quantity.value - value).abs() < 1e-9);
    let num_mentions = linked.tokens_text.matches("<obj-").count();
    linked.slots == composed.mentioned
        && num_mentions == composed.num_mentions
        && linked.unknown.is_empty()
        && linked.quantities.len() == values.len()
        && values.iter().all(is_found)
}

/// The linked sentences of the exam, without their final punctuation mark.
fn exam_sentences() -> &'static BTreeSet<String> {
    static SENTENCES: OnceLock<BTreeSet<String>> = OnceLock::new();
    SENTENCES.get_or_init(|| {
        // `exam` reports a malformed exam to its callers; the sampler then rejects no sentences.
        let (Ok(items), Ok(objects)) = (exam(), exam_objects()) else { return BTreeSet::new() };
        items.iter().filter_map(|item| Some(unpunctuated(&link(&item.prompt, &objects).ok()?).to_owned())).collect()
    })
}

fn unpunctuated(linked: &Linked) -> &str {
    linked.tokens_text.trim_end_matches([' ', '.', '!'])
}

/// All numbers of a program: amounts, durations of steps, duration of the film.
fn quantities_of(program: &Program) -> Vec<f64> {
    let amount = |step: &Step| match step.amount {
        Some(Amount::Degrees(value) | Amount::Units(value) | Amount::Factor(value)) => Some(value),
        _ => None,
    };
    let steps = program.steps.iter().flat_map(|step| [amount(step), step.duration_secs]);
    steps.chain([program.duration_secs]).flatten().collect()
}

fn fallback(objects: &[NamedObject], rng: &mut Pcg64) -> LabeledPrompt {
    let (prompt, mut step) = match objects.choose(rng) {
        Some(object) => {
            let end = Framing { subjects: vec![object.id], ..Framing::default() };
            (format!("Push in on <obj-{}>.", object.id), Step { end, ..Step::of(Move::PushIn) })
        }
        None => ("Pan left.".to_owned(), Step::of(Move::PanLeft)),
    };
    step.words = Some([0, prompt.len()]);
    LabeledPrompt { prompt, program: Program { steps: vec![step], ..Program::default() } }
}
