//! The grammar file, read: lists of wordings and clause families. Its format is told in `prompts/grammar.txt`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use super::LanguageError;
use super::words::words;

const FILE: &str = "prompts/grammar.txt";
static TEXT: &str = include_str!("../../prompts/grammar.txt");

/// One way to say something, and what it adds to the meaning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wording {
    pub parts: Vec<Part>,
    pub meaning: Vec<String>,
    pub weight: f64,
    pub held_out: bool,
}

/// A piece of a wording.
#[derive(Debug, Clone, PartialEq)]
pub enum Part {
    /// Words as they stand, markers included (`*verb`, `A`, `A.it`).
    Text(String),
    /// A wording of this list.
    List(String),
    /// One of several.
    Choice(Vec<Wording>),
}

/// The form of a clause.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Verb phrase.
    Verb,
    /// Noun phrase without its article.
    Noun,
    /// A statement that stands by itself.
    Statement,
}

/// All wordings of one meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Family {
    pub weight: f64,
    /// Tokens of each of its steps.
    pub steps: Vec<Vec<String>>,
    /// It speaks of what the camera looks at already: there has to be such a thing.
    pub needs_focus: bool,
    /// It speaks of a way back: there has to be a move before it.
    pub needs_move: bool,
    /// It goes on from something: not the first thing said.
    pub needs_before: bool,
    pub clauses: Vec<(Form, Wording)>,
}

impl Family {
    /// The letters among A, B, C that the meaning speaks of.
    pub fn letters(&self) -> Vec<char> {
        let tokens =
            self.steps.iter().flatten().filter_map(|token| token.split_once(['=', '+']).map(|(_, names)| names));
        let own = self.steps.iter().flatten().filter(|token| !token.contains('=')).map(String::as_str);
        let mut letters: Vec<char> =
            tokens.chain(own).flat_map(str::chars).filter(|c| matches!(c, 'A'..='C')).collect();
        letters.sort_unstable();
        letters.dedup();
        letters
    }
}

/// The whole grammar.
#[derive(Debug, Default)]
pub struct Grammar {
    pub lists: BTreeMap<String, Vec<Wording>>,
    pub families: Vec<Family>,
    pub framings: Vec<Family>,
    vocabulary: BTreeSet<String>,
}

/// Where the lines of the file go.
enum Section {
    Nowhere,
    List(String),
    Family,
    Framing,
}

impl Grammar {
    /// The grammar that the program ships, read once.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] naming the first line that is not as the format says.
    pub fn embedded() -> Result<&'static Self, LanguageError> {
        static GRAMMAR: OnceLock<Result<Grammar, LanguageError>> = OnceLock::new();
        GRAMMAR.get_or_init(|| Self::parse(TEXT)).as_ref().map_err(Clone::clone)
    }

    fn parse(text: &str) -> Result<Self, LanguageError> {
        let mut grammar = Self::default();
        let mut section = Section::Nowhere;
        for (index, line) in text.lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            grammar.take(&mut section, line).map_err(|what| LanguageError::BadData {
                file: FILE,
                line: index + 1,
                what,
            })?;
        }
        grammar.check_lists()?;
        Ok(grammar)
    }

    fn take(&mut self, section: &mut Section, line: &str) -> Result<(), String> {
        if let Some(name) = line.strip_prefix("= ") {
            *section = Section::List(name.to_owned());
            self.lists.entry(name.to_owned()).or_default();
        } else if let Some(header) = line.strip_prefix("@ ") {
            *section = Section::Family;
            self.families.push(family(header)?);
        } else if let Some(header) = line.strip_prefix("! ") {
            *section = Section::Framing;
            self.framings.push(family(header)?);
        } else {
            self.learn(line);
            match section {
                Section::Nowhere => return Err("a line before any section".to_owned()),
                Section::List(name) => self.lists.entry(name.clone()).or_default().push(wording(line)?),
                Section::Family => push_clause(self.families.last_mut(), line)?,
                Section::Framing => push_clause(self.framings.last_mut(), line)?,
            }
        }
        Ok(())
    }

    /// Every `{list}` has to exist: a misspelled one would only show when it is drawn.
    fn check_lists(&self) -> Result<(), LanguageError> {
        let clauses = self.families.iter().chain(&self.framings).flat_map(|f| f.clauses.iter().map(|(_, w)| w));
        for wording in self.lists.values().flatten().chain(clauses) {
            if let Some(name) = missing_list(&self.lists, wording) {
                return Err(LanguageError::BadData { file: FILE, line: 0, what: format!("no list {{{name}}}") });
            }
        }
        Ok(())
    }

    fn learn(&mut self, line: &str) {
        let text = line.split("=>").next().unwrap_or_default();
        let without_lists = text.split('{').map(|part| part.split_once('}').map_or(part, |(_, after)| after));
        for word in without_lists.flat_map(words) {
            self.vocabulary.extend(super::inflection::forms(&word.text));
            self.vocabulary.insert(word.text);
        }
    }

    /// Whether the phrasebook uses the word, in any form.
    pub fn knows(&self, word: &str) -> bool {
        self.vocabulary.contains(word)
    }
}

fn missing_list<'a>(lists: &BTreeMap<String, Vec<Wording>>, wording: &'a Wording) -> Option<&'a str> {
    wording.parts.iter().find_map(|part| match part {
        Part::Text(_) => None,
        Part::List(name) => (!lists.contains_key(name) && !is_figure(name)).then_some(name.as_str()),
        Part::Choice(options) => options.iter().find_map(|option| missing_list(lists, option)),
    })
}

fn family(header: &str) -> Result<Family, String> {
    let (weight, meaning) = header.split_once(' ').ok_or("a header without meaning")?;
    let weight = weight.parse().map_err(|_| format!("weight \"{weight}\""))?;
    let tokens: Vec<Vec<String>> =
        meaning.split(" / ").map(|step| step.split_whitespace().map(str::to_owned).collect()).collect();
    let needs = |what: &str| tokens.iter().flatten().any(|token| token == what);
    let [needs_focus, needs_move, needs_before] = ["need=focus", "need=moved", "need=before"].map(needs);
    let steps = tokens.into_iter().map(|step| step.into_iter().filter(|t| !t.starts_with("need=")).collect()).collect();
    Ok(Family { weight, steps, needs_focus, needs_move, needs_before, clauses: Vec::new() })
}

fn push_clause(family: Option<&mut Family>, line: &str) -> Result<(), String> {
    let (held_out, line) = line.strip_prefix("~ ").map_or((false, line), |rest| (true, rest));
    let (form, text) = line.split_once(' ').ok_or("a clause without text")?;
    let form = match form {
        "v" => Form::Verb,
        "n" => Form::Noun,
        "s" => Form::Statement,
        other => return Err(format!("form \"{other}\"")),
    };
    let clause = Wording { held_out, ..wording(text)? };
    family.ok_or("a clause before its family")?.clauses.push((form, clause));
    Ok(())
}

/// `[%WEIGHT] [~] text [=> meaning]`.
fn wording(line: &str) -> Result<Wording, String> {
    let mut rest = line.trim();
    let mut weight = 1.0;
    if let Some(after) = rest.strip_prefix('%') {
        let (number, after) = after.split_once(' ').unwrap_or((after, ""));
        weight = number.parse().map_err(|_| format!("weight \"{number}\""))?;
        rest = after.trim();
    }
    let (held_out, rest) = rest.strip_prefix('~').map_or((false, rest), |after| (true, after.trim()));
    Ok(Wording { weight, held_out, ..meant(rest)? })
}

/// `text [=> meaning]`, the arrow outside brackets.
fn meant(text: &str) -> Result<Wording, String> {
    let mut depth = 0i32;
    let arrow = text.char_indices().find(|(at, c)| {
        depth += i32::from(*c == '[') - i32::from(*c == ']');
        depth == 0 && text.get(*at..).is_some_and(|rest| rest.starts_with("=>"))
    });
    let (said, meaning) = match arrow {
        Some((at, _)) => (text.get(..at).unwrap_or_default(), text.get(at + 2..).unwrap_or_default()),
        None => (text, ""),
    };
    let meaning = meaning.split_whitespace().map(str::to_owned).collect();
    Ok(Wording { parts: parts(said)?, meaning, weight: 1.0, held_out: false })
}

fn parts(text: &str) -> Result<Vec<Part>, String> {
    let mut parts = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find(['[', '{']) {
        let (before, from) = rest.split_at(at);
        push_text(&mut parts, before);
        let close = if from.starts_with('[') { ']' } else { '}' };
        let end = closing(from, close).ok_or_else(|| format!("no {close} in \"{text}\""))?;
        let inside = from.get(1..end).unwrap_or_default();
        if close == '}' {
            parts.push(Part::List(inside.to_owned()));
        } else {
            let options: Result<Vec<Wording>, String> = options(inside).into_iter().map(meant).collect();
            parts.push(Part::Choice(options?));
        }
        rest = from.get(end + 1..).unwrap_or_default();
    }
    push_text(&mut parts, rest);
    Ok(parts)
}

fn push_text(parts: &mut Vec<Part>, text: &str) {
    if !text.trim().is_empty() {
        parts.push(Part::Text(text.trim().to_owned()));
    }
}

/// Byte of the bracket that closes the one at the start.
fn closing(text: &str, close: char) -> Option<usize> {
    let open = text.chars().next()?;
    let mut depth = 0i32;
    text.char_indices()
        .find(|(_, c)| {
            depth += i32::from(*c == open) - i32::from(*c == close);
            depth == 0
        })
        .map(|(at, _)| at)
}

/// Splits at `|` outside inner brackets.
fn options(text: &str) -> Vec<&str> {
    let mut depth = 0i32;
    let mut found = Vec::new();
    let mut start = 0;
    for (at, c) in text.char_indices() {
        depth += i32::from(matches!(c, '[' | '{')) - i32::from(matches!(c, ']' | '}'));
        if c == '|' && depth == 0 {
            found.push(text.get(start..at).unwrap_or_default());
            start = at + 1;
        }
    }
    found.push(text.get(start..).unwrap_or_default());
    found
}

/// Whether `{name}` makes a quantity.
pub fn is_figure(name: &str) -> bool {
    matches!(name, "SECS" | "SECS0" | "SECSADJ" | "DEG" | "UNITS" | "NEARER" | "FARTHER" | "LENS")
}
