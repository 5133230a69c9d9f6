//! The grammar file: lists of templates, and groups of templates of one meaning. `prompts/grammar.txt` describes its own
//! format.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::template::{ObjectPlaceholder, Template};
use cinesplat_language::{GRAMMAR_TEXT, LanguageError};
use strum::VariantArray;

const FILE: &str = "prompts/grammar.txt";

/// All templates.
#[derive(Debug, Default)]
pub(crate) struct Grammar {
    pub(crate) lists: BTreeMap<String, Vec<Template>>,
    /// Groups of clauses, each with a move.
    pub(crate) clauses: Vec<TemplateGroup>,
    /// Groups of framings without a move.
    pub(crate) framings: Vec<TemplateGroup>,
}

/// All templates of one meaning.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TemplateGroup {
    /// Relative frequency among the groups.
    pub(crate) weight: f64,
    /// The meaning: tokens of the notation, per step.
    pub(crate) steps: Vec<Vec<String>>,
    pub(crate) requirements: Vec<Requirement>,
    /// Object placeholders of the meaning, in order, each once.
    pub(crate) placeholders: Vec<ObjectPlaceholder>,
    pub(crate) templates: Vec<(ClauseForm, Template)>,
}

/// Context that the clauses of a group need.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::EnumString)]
#[strum(serialize_all = "kebab-case")]
pub(crate) enum Requirement {
    /// The camera already looks at exactly one object.
    Focus,
    /// The camera has moved before.
    Moved,
    /// It is not the first clause.
    Before,
}

/// Syntactic form of a clause.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ClauseForm {
    VerbPhrase,
    /// Without its article.
    NounPhrase,
    /// A whole sentence.
    Statement,
}

/// The section of the file that a line belongs to.
enum Section {
    Nowhere,
    List(String),
    Clauses,
    Framings,
}

impl Grammar {
    /// The grammar that the program ships, read once.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] with the first malformed line.
    pub(crate) fn embedded() -> Result<&'static Self, LanguageError> {
        static GRAMMAR: OnceLock<Result<Grammar, LanguageError>> = OnceLock::new();
        GRAMMAR.get_or_init(|| Self::parse(GRAMMAR_TEXT)).as_ref().map_err(Clone::clone)
    }

    fn parse(text: &str) -> Result<Self, LanguageError> {
        let mut grammar = Self::default();
        let mut section = Section::Nowhere;
        for (index, line) in text.lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let bad = |what| LanguageError::BadData { file: FILE, line: index + 1, what };
            grammar.parse_line(&mut section, line).map_err(bad)?;
        }
        grammar.check_lists()?;
        Ok(grammar)
    }

    fn parse_line(&mut self, section: &mut Section, line: &str) -> Result<(), String> {
        if let Some(name) = line.strip_prefix("= ") {
            *section = Section::List(name.to_owned());
            self.lists.entry(name.to_owned()).or_default();
        } else if let Some(header) = line.strip_prefix("@ ") {
            *section = Section::Clauses;
            self.clauses.push(TemplateGroup::parse_header(header)?);
        } else if let Some(header) = line.strip_prefix("! ") {
            *section = Section::Framings;
            self.framings.push(TemplateGroup::parse_header(header)?);
        } else {
            match section {
                Section::Nowhere => return Err("a line before any section".to_owned()),
                Section::List(name) => self.lists.entry(name.clone()).or_default().push(Template::parse(line)?),
                Section::Clauses => add_template(self.clauses.last_mut(), line)?,
                Section::Framings => add_template(self.framings.last_mut(), line)?,
            }
        }
        Ok(())
    }

    /// Rejects a reference to a list that does not exist, which would otherwise show only in some draws.
    fn check_lists(&self) -> Result<(), LanguageError> {
        let groups = self.clauses.iter().chain(&self.framings);
        let grouped = groups.flat_map(|group| group.templates.iter().map(|(_, template)| template));
        let mut referred = self.lists.values().flatten().chain(grouped).flat_map(Template::lists);
        match referred.find(|name| !self.lists.contains_key(*name)) {
            Some(name) => Err(LanguageError::BadData { file: FILE, line: 0, what: format!("no list {{{name}}}") }),
            None => Ok(()),
        }
    }
}

impl TemplateGroup {
    /// Reads `WEIGHT MEANING`, where tokens `need=..` of the meaning are requirements.
    fn parse_header(header: &str) -> Result<Self, String> {
        let (weight, meaning) = header.split_once(' ').ok_or("a header without meaning")?;
        let weight = weight.parse().map_err(|_| format!("weight \"{weight}\""))?;
        let mut requirements = Vec::new();
        let mut steps = Vec::new();
        for step in meaning.split(" / ") {
            let mut tokens = Vec::new();
            for token in step.split_whitespace() {
                match token.strip_prefix("need=") {
                    Some(need) => requirements.push(need.parse().map_err(|_| format!("requirement \"{need}\""))?),
                    None => tokens.push(token.to_owned()),
                }
            }
            steps.push(tokens);
        }
        let placeholders = placeholders(&steps);
        Ok(Self { weight, steps, requirements, placeholders, templates: Vec::new() })
    }

    /// Whether its clauses need a certain context.
    pub(crate) fn requires(&self, requirement: Requirement) -> bool {
        self.requirements.contains(&requirement)
    }

    /// Whether a step begins with a cut.
    pub(crate) fn cuts(&self) -> bool {
        self.steps.iter().flatten().any(|token| token == "cut")
    }
}

/// The object placeholders in tokens such as `end=A+B`, `end+B` or `A`.
fn placeholders(steps: &[Vec<String>]) -> Vec<ObjectPlaceholder> {
    let values =
        || steps.iter().flatten().map(|token| token.split_once('=').map_or(token.as_str(), |(_, value)| value));
    let is_named = |placeholder: &ObjectPlaceholder| values().any(|value| value.contains(placeholder.as_ref()));
    ObjectPlaceholder::VARIANTS.iter().copied().filter(is_named).collect()
}

/// Adds a line `[~] FORM TEMPLATE` to a group.
fn add_template(group: Option<&mut TemplateGroup>, line: &str) -> Result<(), String> {
    let (held_out, line) = line.strip_prefix("~ ").map_or((false, line), |rest| (true, rest));
    let (form, text) = line.split_once(' ').ok_or("a clause without text")?;
    let form = match form {
        "v" => ClauseForm::VerbPhrase,
        "n" => ClauseForm::NounPhrase,
        "s" => ClauseForm::Statement,
        other => return Err(format!("form \"{other}\"")),
    };
    let template = Template { held_out, ..Template::parse(text)? };
    group.ok_or("a clause before its group")?.templates.push((form, template));
    Ok(())
}
