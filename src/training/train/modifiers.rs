//! Phrases that add one wish to any sentence, or none at all.
//!
//! Enters: `prompts/modifiers.txt`. Leaves: [`Modifiers`], whose phrases training glues to the sentences of the corpus.
//!
//! # Format
//!
//! ```text
//! = end:#mm
//! > , on the # mm lens
//! < # mm:
//! = correction
//! ~ , no wait,
//! ```
//!
//! `= EDIT` begins a section. An edit is what the phrases below it add to a step in the notation of programs, then, after
//! `|`, to the film; `#` is a number that training draws, `1` and `2` are the objects `[X]` and `[Y]`. A line `>` follows a
//! sentence, `<` comes before it, `~` stands between two sentences. The sections `opening`, `closing`, `correction`, `link`,
//! `cut link` and `simple order words` add nothing to the program.

use std::sync::OnceLock;

use cinesplat_language::{Linked, link_mentions, tokenize};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

use crate::corpus::parse_marked;

static TEXT: &str = include_str!("../../../prompts/modifiers.txt");

/// A wish with the phrases that say it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Modifier {
    /// Tokens that the wish adds to a step.
    pub step: String,
    /// Tokens that it adds to the film.
    pub film: String,
    /// Phrases before a sentence.
    pub before: Vec<String>,
    /// Phrases behind a sentence.
    pub after: Vec<String>,
    /// Phrases between two sentences.
    pub between: Vec<String>,
}

/// All wishes, and the phrases that mean nothing to the camera.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Modifiers {
    /// Wishes for a step.
    pub steps: Vec<Modifier>,
    /// Wishes for the film.
    pub films: Vec<Modifier>,
    /// Phrases before a request and behind it.
    pub asides: Modifier,
    /// Phrases between something wrong and its replacement.
    pub corrections: Vec<String>,
    /// Phrases between one move and the next.
    pub links: Vec<String>,
    /// Phrases between two moves with a cut between them.
    pub cuts: Vec<String>,
    /// For a list of moves: words of the first, of those after it and of the last.
    pub orders: Vec<[String; 3]>,
}

/// Side of the sentence on which a phrase stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Position {
    /// Before the sentence.
    Before,
    /// Behind the sentence.
    After,
}

/// A phrase with its number and placeholders.
#[derive(Debug, Clone, PartialEq)]
pub struct Wish {
    /// The phrase; its objects are 1 and 2.
    pub linked: Linked,
    /// What it adds to a step, with its number.
    pub step: String,
    /// What it adds to the film.
    pub film: String,
}

impl Modifiers {
    /// The modifiers of the repository.
    pub fn embedded() -> &'static Self {
        static MODIFIERS: OnceLock<Modifiers> = OnceLock::new();
        MODIFIERS.get_or_init(|| Self::parse(TEXT))
    }

    /// Reads the format of the module; lines that are no phrases of a section are skipped.
    pub fn parse(text: &str) -> Self {
        let mut modifiers = Self::default();
        let mut section = (String::new(), Modifier::default());
        for line in text.lines() {
            match (line.split_once(' '), &mut section) {
                (Some(("=", heading)), _) => {
                    modifiers.add(std::mem::replace(&mut section, (heading.trim().to_owned(), Modifier::default())));
                }
                (Some(("<", phrase)), (_, modifier)) => modifier.before.push(phrase.trim().to_owned()),
                (Some((">", phrase)), (_, modifier)) => modifier.after.push(phrase.trim().to_owned()),
                (Some(("~", phrase)), (_, modifier)) => modifier.between.push(phrase.trim().to_owned()),
                _ => {}
            }
        }
        modifiers.add(section);
        modifiers
    }

    /// All phrases, as the linked text has them.
    pub(super) fn texts(&self) -> impl Iterator<Item = String> {
        let sections = self.steps.iter().chain(&self.films).chain([&self.asides]);
        let phrases = sections.flat_map(|section| section.before.iter().chain(&section.after));
        let between = self.corrections.iter().chain(&self.links).chain(&self.cuts).chain(self.orders.iter().flatten());
        phrases.chain(between).map(|phrase| {
            let words: Vec<String> = tokenize(phrase).into_iter().map(|word| word.text).collect();
            words.join(" ")
        })
    }

    fn add(&mut self, (heading, mut modifier): (String, Modifier)) {
        match heading.as_str() {
            "" => {}
            "opening" => self.asides.before.append(&mut modifier.before),
            "closing" => self.asides.after.append(&mut modifier.after),
            "correction" => self.corrections = modifier.between,
            "link" => self.links = modifier.between,
            "cut link" => self.cuts = modifier.between,
            "simple order words" => self.orders = modifier.between.iter().filter_map(|line| triple(line)).collect(),
            edit => {
                let (step, film) = edit.split_once('|').unwrap_or((edit, ""));
                (modifier.step, modifier.film) = (step.trim().to_owned(), film.trim().to_owned());
                if modifier.step.starts_with("total=") {
                    modifier.film = std::mem::take(&mut modifier.step);
                }
                let list = if modifier.step.is_empty() { &mut self.films } else { &mut self.steps };
                list.push(modifier);
            }
        }
    }
}

impl Modifier {
    /// One of the phrases with a number in place of `#`; `None` without phrases on that side, or for one without words.
    pub fn draw(&self, position: Position, rng: &mut Pcg64) -> Option<Wish> {
        let phrases = match position {
            Position::Before => &self.before,
            Position::After => &self.after,
        };
        let phrase = phrases.choose(rng)?;
        let number = number_for(if self.step.contains('#') { &self.step } else { &self.film }, rng);
        let text = phrase.replace('#', number).replace("[X]", "[it|1]").replace("[Y]", "[it|2]");
        let marked = parse_marked(&text).ok()?;
        let linked = link_mentions(&marked.text, &marked.mentions).ok()?;
        Some(Wish { linked, step: self.step.replace('#', number), film: self.film.replace('#', number) })
    }
}

/// A number that fits the unit behind `#` in an edit.
fn number_for(edit: &str, rng: &mut Pcg64) -> &'static str {
    let unit = edit.split_once('#').map_or("", |(_, unit)| unit);
    let values: &[&str] = match unit {
        "s" => &["2", "3", "4", "5", "6", "7", "8", "10", "12", "15", "20", "30"],
        "deg" => &["15", "20", "25", "30", "40", "45", "50", "60", "70"],
        "mm" => &["18", "24", "28", "35", "50", "75", "85", "100", "135"],
        "u" => &["0.5", "1", "1.2", "1.5", "1.6", "2", "2.5", "3"],
        "%" => &["15", "20", "25", "30", "40", "50", "60", "70", "80", "90"],
        _ => return "",
    };
    values[rng.random_range(0..values.len())]
}

fn triple(line: &str) -> Option<[String; 3]> {
    let parts: Vec<String> = line.split('|').map(|part| part.trim().to_owned()).collect();
    parts.try_into().ok()
}
