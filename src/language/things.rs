//! Kinds of things: synonyms, broader kinds and parts. `prompts/things.txt` describes its own format.
//!
//! Enters: the name of an object. Leaves: all phrases that are related to it, each with its relations. Names are compared by
//! the stems of their words.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use super::list_lines::list_lines;
use super::tokenizer::tokenize;

static TEXT: &str = include_str!("../../prompts/things.txt");
/// Words after which the name of a thing is over (`stack of plates`).
const TAIL_PREPOSITIONS: [&str; 8] = ["of", "with", "on", "in", "for", "from", "at", "under"];
/// Generations of broader kinds that count.
const MAX_GENERATIONS: usize = 3;
/// Most words of a phrase.
pub const MAX_PHRASE_WORDS: usize = 4;

/// Relation of a phrase to an object's name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::VariantArray)]
pub enum Relation {
    /// Another name: `couch` for `sofa`.
    Same,
    /// A broader kind: `machine` for `coffee machine`.
    Broader,
    /// A narrower kind: `armchair` for `chair`.
    Narrower,
    /// A part: `lid` for `kettle`.
    Part,
    /// A kind beside it: `stool` for `chair`.
    Sibling,
}

impl Relation {
    const fn bit(self) -> u8 {
        1 << self as u8
    }

    /// Whether a set of relations holds this one.
    pub const fn is_in(self, relations: u8) -> bool {
        relations & self.bit() != 0
    }
}

/// A line of the file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Kind {
    /// Names that may stand for one another, as written.
    pub names: Vec<String>,
    /// Broader kinds, as written.
    pub broader: Vec<String>,
    /// Parts, as written.
    pub parts: Vec<String>,
}

/// The stems of a line, with what it inherits.
#[derive(Debug, Default)]
struct Stems {
    names: BTreeSet<String>,
    own_broader: BTreeSet<String>,
    broader: BTreeSet<String>,
    parts: BTreeSet<String>,
}

/// All kinds.
#[derive(Debug, Default)]
pub struct Things {
    kinds: Vec<Kind>,
    stems: Vec<Stems>,
    by_name: BTreeMap<String, Vec<usize>>,
    phrases: BTreeMap<String, u8>,
}

impl Things {
    /// The kinds that the program ships, read once.
    pub fn embedded() -> &'static Self {
        static THINGS: OnceLock<Things> = OnceLock::new();
        THINGS.get_or_init(|| Self::parse(TEXT))
    }

    fn parse(text: &str) -> Self {
        let lines = list_lines(text).map(|(_, line)| line);
        let mut things = Self { kinds: lines.map(kind).collect(), ..Self::default() };
        let mut firsts: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (at, kind) in things.kinds.iter().enumerate() {
            let set = |entries: &[String]| entries.iter().map(|entry| stems_of(entry)).collect::<BTreeSet<_>>();
            let stems = Stems {
                names: set(&kind.names),
                own_broader: set(&kind.broader),
                broader: set(&kind.broader),
                parts: set(&kind.parts),
            };
            for name in &stems.names {
                things.by_name.entry(name.clone()).or_default().push(at);
            }
            if let Some(first) = kind.names.first() {
                firsts.entry(stems_of(first)).or_default().push(at);
            }
            things.stems.push(stems);
        }
        for _ in 0..MAX_GENERATIONS {
            for at in 0..things.stems.len() {
                let parents: Vec<usize> =
                    things.stems[at].broader.iter().filter_map(|name| firsts.get(name)).flatten().copied().collect();
                for parent in parents.into_iter().filter(|parent| *parent != at) {
                    let (broader, parts) = (things.stems[parent].broader.clone(), things.stems[parent].parts.clone());
                    things.stems[at].broader.extend(broader);
                    things.stems[at].parts.extend(parts);
                }
            }
        }
        for stems in &things.stems {
            for (set, relation) in
                [(&stems.names, Relation::Same), (&stems.broader, Relation::Broader), (&stems.parts, Relation::Part)]
            {
                for phrase in set {
                    *things.phrases.entry(phrase.clone()).or_default() |= relation.bit();
                }
            }
        }
        things
    }

    /// All kinds, in the order of the file.
    pub fn kinds(&self) -> &[Kind] {
        &self.kinds
    }

    /// What a phrase (stems, separated by spaces) is for any kind: [`Relation::Same`] a name, [`Relation::Broader`],
    /// [`Relation::Part`]; 0 for an unknown phrase.
    pub fn roles(&self, phrase: &str) -> u8 {
        self.phrases.get(phrase).copied().unwrap_or(0)
    }

    /// Kinds of an object by its name: those of the longest end of the name that is known, or of any word of it.
    pub fn kinds_of(&self, label: &str) -> Vec<usize> {
        let words = tokenize(label);
        let is_named = |word: &&super::tokenizer::Word| word.is_alphabetic();
        let is_link = |text: &str| TAIL_PREPOSITIONS.contains(&text);
        let mut found = BTreeSet::new();
        for part in words.split(|word| is_link(&word.text)) {
            let stems: Vec<&str> = part.iter().filter(is_named).map(|word| word.stem.as_str()).collect();
            let mut ends = (0..stems.len()).map(|start| stems[start..].join(" "));
            let known = ends.find_map(|end| self.by_name.get(&end));
            let last = stems.last().copied().unwrap_or_default();
            let inside = || stems.iter().rev().find_map(|stem| self.by_name.get(*stem));
            found.extend(known.or_else(|| self.compound(last)).or_else(inside).into_iter().flatten().copied());
        }
        found.into_iter().collect()
    }

    /// Kinds of the longest known name that a word ends in: `lighthouse` for `bluelighthouse`.
    fn compound(&self, word: &str) -> Option<&Vec<usize>> {
        let mut starts = word.char_indices().skip(2).map(|(at, _)| at).filter(|at| word.len() - at >= 4);
        starts.find_map(|at| self.by_name.get(&word[at..]))
    }

    /// Whether a phrase (stems, separated by spaces) has one of some relations to what a label names.
    pub fn is_related(&self, label: &str, phrase: &str, relations: &[Relation]) -> bool {
        let related = self.related(&self.kinds_of(label));
        related.get(phrase).is_some_and(|set| relations.iter().any(|relation| relation.is_in(*set)))
    }

    /// All phrases (stems, separated by spaces) that are related to kinds, each with its set of [`Relation`]s.
    pub fn related(&self, kinds: &[usize]) -> BTreeMap<String, u8> {
        let mut related: BTreeMap<String, u8> = BTreeMap::new();
        let mut add = |phrases: &BTreeSet<String>, relation: Relation| {
            for phrase in phrases {
                *related.entry(phrase.clone()).or_default() |= relation.bit();
            }
        };
        let own: Vec<&Stems> = kinds.iter().filter_map(|kind| self.stems.get(*kind)).collect();
        for stems in &own {
            add(&stems.names, Relation::Same);
            add(&stems.broader, Relation::Broader);
            add(&stems.parts, Relation::Part);
        }
        for other in &self.stems {
            if own.iter().any(|stems| !stems.names.is_disjoint(&other.broader)) {
                add(&other.names, Relation::Narrower);
            }
            if own.iter().any(|stems| !stems.own_broader.is_disjoint(&other.own_broader)) {
                add(&other.names, Relation::Sibling);
            }
        }
        related
    }
}

/// `NAME, NAME < BROADER : PART`.
fn kind(line: &str) -> Kind {
    let entries = |text: &str| {
        text.split(',').map(str::trim).filter(|entry| !entry.is_empty()).map(str::to_owned).collect::<Vec<_>>()
    };
    let (front, parts) = line.split_once(" : ").unwrap_or((line, ""));
    let (names, broader) = front.split_once(" < ").unwrap_or((front, ""));
    Kind { names: entries(names), broader: entries(broader), parts: entries(parts) }
}

fn stems_of(entry: &str) -> String {
    tokenize(entry).into_iter().map(|word| word.stem).collect::<Vec<_>>().join(" ")
}
