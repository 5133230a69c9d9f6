use std::collections::BTreeSet;
use std::sync::OnceLock;

use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

use super::compose::{Composed, Composer};
use cinesplat_language::NamedObject;
use cinesplat_language::grammar::Grammar;
use cinesplat_language::lexicon::Lexicon;
use cinesplat_language::{LanguageError, Linked, link};

use super::{exam, exam_objects};
use cinesplat_operator::{Framing, Program, Step};
use cinesplat_trajectory::Move;

/// A prompt and what it means.
#[derive(Debug, Clone, PartialEq)]
pub struct LabeledPrompt {
    /// The sentence.
    pub prompt: String,
    /// Its meaning, with the objects' ids and every step's bytes of the prompt.
    pub program: Program,
}

/// Which wordings a phrasebook uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum TemplateSplit {
    /// Without those that the grammar reserves.
    #[default]
    Train,
    /// At least one reserved wording in every prompt.
    HeldOut,
}

/// Invents prompts with their meaning.
#[derive(Debug, Clone, Copy)]
pub struct PromptSampler {
    grammar: &'static Grammar,
    lexicon: &'static Lexicon,
    split: TemplateSplit,
}

impl PromptSampler {
    /// The phrasebook that the program ships, for training.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] when an embedded file is damaged.
    pub fn embedded() -> Result<Self, LanguageError> {
        Ok(Self { grammar: Grammar::embedded()?, lexicon: Lexicon::embedded()?, split: TemplateSplit::Train })
    }

    /// The same phrasebook on another side of the split.
    #[must_use]
    pub fn with_split(self, split: TemplateSplit) -> Self {
        Self { split, ..self }
    }

    /// A prompt about some of `objects` with its program; the same state of `rng` gives the same prompt.
    ///
    /// Never a sentence of the [`exam()`], whatever its objects. The prompt links to exactly the program's objects and quantities: draws whose words could be taken otherwise are
    /// thrown away.
    pub fn sample(&self, objects: &[NamedObject], rng: &mut Pcg64) -> LabeledPrompt {
        for attempt in 0..400 {
            let Some(composed) = Composer::new(self.grammar, self.split, objects, rng).compose() else { continue };
            let reserved = self.split == TemplateSplit::Train || composed.held_out || attempt > 300;
            let Ok(linked) = link(&composed.sample.prompt, objects) else { continue };
            if reserved && is_as_meant(&linked, &composed) && !exam_sentences().contains(bare(&linked)) {
                return composed.sample;
            }
        }
        plain_sample(objects, rng)
    }

    /// A cast of `count` invented objects with different ids: nouns, most with one or two adjectives, some without a name.
    pub fn invent_objects(&self, count: usize, rng: &mut Pcg64) -> Vec<NamedObject> {
        let mut objects: Vec<NamedObject> = Vec::new();
        let adjectives: Vec<&String> = self.lexicon.adjectives.iter().collect();
        while objects.len() < count.min(60_000) {
            let id = rng.random_range(1..=if count < 60 { 99 } else { 65_535 });
            if objects.iter().any(|object| object.id == id) {
                continue;
            }
            objects.push(NamedObject { id, label: self.invent_label(&adjectives, rng) });
        }
        objects
    }

    fn invent_label(&self, adjectives: &[&String], rng: &mut Pcg64) -> String {
        if rng.random_bool(0.06) {
            return String::new();
        }
        let noun = self.lexicon.nouns.choose(rng).cloned().unwrap_or_default();
        let count = match rng.random_range(0..10) {
            0..3 => 0,
            3..9 => 1,
            _ => 2,
        };
        let mut words: Vec<&str> =
            (0..count).filter_map(|_| adjectives.choose(rng).map(|word| word.as_str())).collect();
        words.dedup();
        words.push(&noun);
        words.join(" ")
    }
}

/// Whether the linker found in the prompt exactly the objects and quantities that were put there.
fn is_as_meant(linked: &Linked, composed: &Composed) -> bool {
    let values = quantities_of(&composed.sample.program);
    let found = |value: &f64| linked.quantities.iter().any(|quantity| (quantity.value - value).abs() < 1e-9);
    let num_mentions = linked.tokens_text.matches("<obj-").count();
    linked.slots == composed.mentioned
        && num_mentions == composed.num_mentions
        && linked.unknown.is_empty()
        && linked.quantities.len() == values.len()
        && values.iter().all(found)
}

/// The exam's sentences as the model reads them, without a full stop.
fn exam_sentences() -> &'static BTreeSet<String> {
    static SENTENCES: OnceLock<BTreeSet<String>> = OnceLock::new();
    SENTENCES.get_or_init(|| {
        // A damaged exam shows where it is read; here it only means that nothing has to be kept out.
        let (Ok(items), Ok(objects)) = (exam(), exam_objects()) else { return BTreeSet::new() };
        items.iter().filter_map(|item| Some(bare(&link(&item.prompt, &objects).ok()?).to_owned())).collect()
    })
}

fn bare(linked: &Linked) -> &str {
    linked.tokens_text.trim_end_matches([' ', '.', '!'])
}

fn quantities_of(program: &Program) -> Vec<f64> {
    use cinesplat_operator::Amount::{Degrees, Factor, Units};
    let amount = |step: &Step| match step.amount {
        Some(Degrees(value) | Units(value) | Factor(value)) => Some(value),
        _ => None,
    };
    let steps = program.steps.iter().flat_map(|step| [amount(step), step.duration_secs]);
    steps.chain([program.duration_secs]).flatten().collect()
}

/// What is left when nothing else could be said: `orbit <obj-7>.` or `pan left.`
fn plain_sample(objects: &[NamedObject], rng: &mut Pcg64) -> LabeledPrompt {
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
