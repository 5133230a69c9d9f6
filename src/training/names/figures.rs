//! How well names are found in the sentences of writers.

use std::collections::BTreeMap;

use cinesplat_director::Names;
use cinesplat_language::{Mention, NamedObject};

use crate::corpus::Writer;
use crate::train::{Tally, TrainError};

/// Finds the mentions of a prompt about named objects.
type FindMentions<'a> = dyn FnMut(&str, &[NamedObject]) -> Result<Vec<Mention>, TrainError> + 'a;

/// A sentence whose mentions are not all right.
#[derive(Debug, Clone, PartialEq)]
pub struct NameMistake {
    /// The sentence.
    pub prompt: String,
    /// Mentions that were not found, as they are meant.
    pub lost: Vec<String>,
    /// Mentions that nobody meant, as they were found.
    pub invented: Vec<String>,
}

/// Figures of the network of names.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NameFigures {
    /// Sentences whose mentions all have the right objects.
    pub sentences: Tally,
    /// Sentences whose mentions all have the right objects and the right words.
    pub exact: Tally,
    /// Mentions with the right objects.
    pub mentions: Tally,
    /// Sentences that name nothing missing and are not said to.
    pub accepted: Tally,
    /// Missing things that are found.
    pub missing: Tally,
    /// The mistakes.
    pub mistakes: Vec<NameMistake>,
}

/// Figures of a network over all sentences of the writers.
///
/// # Errors
/// [`TrainError::Director`] when the network fails.
pub fn examine_names(names: &Names, writers: &[Writer]) -> Result<NameFigures, TrainError> {
    examine_mentions(writers, &mut |prompt, objects| {
        Ok(names.mentions(prompt, objects)?.into_iter().map(|found| found.mention).collect())
    })
}

/// Figures of the mentions that `find` finds in a prompt, over all sentences of the writers. A mention is right if a found
/// one with the same objects overlaps it.
///
/// # Errors
/// Those of `find`.
pub fn examine_mentions(writers: &[Writer], find: &mut FindMentions<'_>) -> Result<NameFigures, TrainError> {
    let mut figures = NameFigures::default();
    for writer in writers {
        for sentence in &writer.sentences {
            let objects = writer.scenes.get(&sentence.scene).map_or(&[][..], Vec::as_slice);
            let found = find(&sentence.prompt, objects)?;
            let labels = objects.iter().map(|object| (object.id, object.label.clone())).collect();
            figures.add(&sentence.prompt, &sentence.mentions, &found, &labels);
        }
    }
    Ok(figures)
}

impl NameFigures {
    fn add(&mut self, prompt: &str, meant: &[Mention], found: &[Mention], labels: &BTreeMap<u32, String>) {
        // A name for things of one label may mean any of them: the lowest stands for all.
        let lowest =
            |id: &u32| labels.iter().find(|(_, label)| Some(*label) == labels.get(id)).map_or(*id, |(id, _)| *id);
        let ids = |mention: &Mention| match mention.ids[..] {
            [id] => vec![lowest(&id)],
            _ => mention.ids.clone(),
        };
        let same = |a: &Mention, b: &Mention| ids(a) == ids(b) && a.bytes[0] < b.bytes[1] && b.bytes[0] < a.bytes[1];
        let lost: Vec<&Mention> = meant.iter().filter(|m| !found.iter().any(|f| same(m, f))).collect();
        let invented: Vec<&Mention> = found.iter().filter(|f| !meant.iter().any(|m| same(m, f))).collect();
        let right = lost.is_empty() && invented.is_empty();
        self.sentences.add(right);
        self.exact.add(right && meant.len() == found.len() && meant.iter().zip(found).all(|(m, f)| m.bytes == f.bytes));
        meant.iter().for_each(|m| self.mentions.add(!lost.contains(&m)));
        let refuses = |mentions: &[Mention]| mentions.iter().any(|mention| mention.ids.is_empty());
        if !refuses(meant) {
            self.accepted.add(!refuses(found));
        }
        for mention in meant.iter().filter(|mention| mention.ids.is_empty()) {
            self.missing.add(!lost.contains(&mention));
        }
        if !right {
            let show = |mention: &&Mention| {
                let words = prompt.get(mention.bytes[0]..mention.bytes[1]).unwrap_or_default();
                let names: Vec<String> = mention
                    .ids
                    .iter()
                    .map(|id| format!("{id} {}", labels.get(id).map_or("", String::as_str)))
                    .collect();
                format!("{words} = {}", if names.is_empty() { "?".to_owned() } else { names.join(" + ") })
            };
            self.mistakes.push(NameMistake {
                prompt: prompt.to_owned(),
                lost: lost.iter().map(show).collect(),
                invented: invented.iter().map(show).collect(),
            });
        }
    }
}
