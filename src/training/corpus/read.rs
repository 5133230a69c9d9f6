//! Reading of corpus files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use cinesplat_language::{Linked, Mention, NamedObject, link_mentions, program_from_notation};
use cinesplat_operator::{Pass, Program};

use super::marks::parse_marked;

/// One writer of the corpus.
#[derive(Debug, Clone, PartialEq)]
pub struct Writer {
    /// Name of the file without its extension.
    pub name: String,
    /// What the writer's sentences are for.
    pub split: Split,
    /// Objects of each scene.
    pub scenes: BTreeMap<String, Vec<NamedObject>>,
    /// The sentences, in order.
    pub sentences: Vec<CorpusSentence>,
}

/// What the sentences of a writer are for; the second line of a file, `split exam`, says it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString)]
#[strum(serialize_all = "kebab-case")]
pub enum Split {
    /// Training.
    #[default]
    Training,
    /// Choices between models and settings.
    Development,
    /// The final figures only.
    Exam,
}

/// Kind of a sentence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::VariantArray)]
pub enum SentenceKind {
    /// One clause.
    #[strum(serialize = "s", to_string = "one clause")]
    Single,
    /// Several clauses.
    #[strum(serialize = "m", to_string = "several clauses")]
    Several,
    /// Free.
    #[strum(serialize = "f", to_string = "free")]
    Free,
}

/// A sentence of the corpus with its meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct CorpusSentence {
    /// Line of the file, from 1.
    pub line: usize,
    /// Scene of the writer that it is about.
    pub scene: String,
    /// Kind.
    pub kind: SentenceKind,
    /// Whether it asks for what cannot be done.
    pub impossible: bool,
    /// The sentence.
    pub prompt: String,
    /// Its mentions of objects.
    pub mentions: Vec<Mention>,
    /// The sentence with placeholders.
    pub linked: Linked,
    /// Byte ranges of words that the notation cannot say.
    pub unmet: Vec<[usize; 2]>,
    /// What a second reader, who saw the sentence alone, says it asks for, where that differs.
    pub second: Option<Program>,
    /// What it asks for. Groups stand for what the scene lacks; all other ids are objects.
    pub program: Program,
}

/// Error of a corpus file.
#[derive(Debug, thiserror::Error)]
pub enum CorpusError {
    /// The file or folder cannot be read.
    #[error(transparent)]
    Read(#[from] cinesplat_files::FileError),
    /// The folder cannot be listed.
    #[error("cannot list the folder {}: {source}", .folder.display())]
    List {
        /// The folder.
        folder: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
    /// A line is malformed.
    #[error("line {line}: {problem}: {}", .path.display())]
    BadLine {
        /// The file.
        path: PathBuf,
        /// Line from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
}

impl CorpusError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Read(error) => error.code(),
            Self::List { .. } => "CORPUS-LIST",
            Self::BadLine { .. } => "CORPUS-LINE",
        }
    }
}

/// The writers of all `.txt` files of a folder, by name.
///
/// # Errors
/// [`CorpusError`] of the first file that cannot be read.
pub fn read_folder(folder: &Path) -> Result<Vec<Writer>, CorpusError> {
    let list = |source| CorpusError::List { folder: folder.to_owned(), source };
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(list)? {
        paths.push(entry.map_err(list)?.path());
    }
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "txt"));
    paths.sort();
    paths.iter().map(|path| read_writer(path)).collect()
}

/// The writer of one file.
///
/// # Errors
/// [`CorpusError::Read`] · [`CorpusError::BadLine`] for the first malformed line.
pub fn read_writer(path: &Path) -> Result<Writer, CorpusError> {
    let bytes = cinesplat_files::read(path, cinesplat_files::Limits::DEFAULT.text_bytes)?;
    let text = String::from_utf8_lossy(&bytes);
    let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut writer = Writer { name, split: Split::default(), scenes: BTreeMap::new(), sentences: Vec::new() };
    for (number, line) in (1..).zip(text.lines()) {
        let bad = |problem| CorpusError::BadLine { path: path.to_owned(), line: number, problem };
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        if let Some(split) = line.strip_prefix("split ") {
            writer.split = split.trim().parse().map_err(|_| bad(format!("unknown split \"{split}\"")))?;
        } else if let Some(object) = line.strip_prefix("object ") {
            let (scene, object) = named_object(object).ok_or_else(|| bad("expected object SCENE ID LABEL".into()))?;
            writer.scenes.entry(scene).or_default().push(object);
        } else {
            writer.sentences.push(sentence(line, number).map_err(bad)?);
        }
    }
    Ok(writer)
}

fn named_object(text: &str) -> Option<(String, NamedObject)> {
    let mut parts = text.splitn(3, ' ');
    let (scene, id, label) = (parts.next()?, parts.next()?.parse().ok()?, parts.next()?);
    Some((scene.to_owned(), NamedObject { id, label: label.to_owned() }))
}

fn sentence(line: &str, number: usize) -> Result<CorpusSentence, String> {
    let (scene, rest) = line.split_once(" | ").ok_or("expected SCENE | KIND | SENTENCE | PROGRAM")?;
    let (kind, rest) = rest.split_once(" | ").ok_or("no kind")?;
    let (rest, second) = match rest.split_once(" || ") {
        Some((rest, second)) => (rest, Some(second)),
        None => (rest, None),
    };
    let (marked, notation) = split_program(rest).ok_or("no program")?;
    let marked = parse_marked(marked.trim())?;
    let linked = link_mentions(&marked.text, &marked.mentions).map_err(|error| error.to_string())?;
    let missing = linked.missing_groups().next();
    let parse = |notation: &str| {
        let notation = match missing {
            Some(group) => notation.replace('?', &group.id.to_string()),
            None => notation.to_owned(),
        };
        program_from_notation(&one_pass(&notation)).map_err(|error| format!("{error} in {notation}"))
    };
    let mut program = parse(notation)?;
    let second = second.map(parse).transpose()?;
    for (step, number) in program.steps.iter_mut().zip(1..) {
        step.words = marked.words_of(number);
    }
    let impossible = kind.ends_with('!');
    let kind = kind.trim_end_matches('!').parse().map_err(|_| format!("unknown kind \"{kind}\""))?;
    Ok(CorpusSentence {
        line: number,
        scene: scene.to_owned(),
        kind,
        impossible,
        prompt: marked.text,
        mentions: marked.mentions,
        linked,
        unmet: marked.unmet,
        second,
        program,
    })
}

/// The marked sentence and the program of a line. Both may contain ` | `: the program of a line begins after the first one
/// behind which everything is a program.
fn split_program(rest: &str) -> Option<(&str, &str)> {
    let ends = rest.match_indices(" | ").map(|(at, _)| (&rest[..at], &rest[at + 3..]));
    let mut all: Vec<_> = ends.collect();
    let is_program = |text: &str| program_from_notation(&one_pass(&text.replace('?', "1"))).is_ok();
    let first = all.iter().position(|(_, program)| is_program(program));
    match first {
        Some(first) => Some(all.swap_remove(first)),
        None => all.into_iter().next(),
    }
}

/// A program with only the first of several passes of each step: a step of the notation has one.
fn one_pass(notation: &str) -> String {
    let steps = notation.split(" / ").map(|step| {
        let mut has_pass = false;
        let keep = |token: &&str| {
            let is_pass = token.split_once('=').is_some_and(|(key, _)| key.parse::<Pass>().is_ok());
            let is_kept = !(has_pass && is_pass);
            has_pass |= is_pass;
            is_kept
        };
        step.split_whitespace().filter(keep).collect::<Vec<_>>().join(" ")
    });
    steps.collect::<Vec<_>>().join(" / ")
}
