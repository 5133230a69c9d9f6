//! From scores to mentions.

use std::ops::Range;

use super::batch::{MentionBatch, SentenceBatch};
use super::files::WEIGHTS_FILE;
use super::mention_input::{MentionInput, says_place};
use super::network::{NUM_TAGS, NamesNetwork};
use super::sentence::Sentence;
use crate::error::DirectorError;
use crate::network::Dropout;
use crate::tensor_file::check_finite;

/// Least probability that a mention's thing is missing.
const MISSING_THRESHOLD: f64 = 0.5;
/// Least probability of a mention of a missing thing as a whole: a wrong refusal is worse than an overlooked one.
const REFUSAL_THRESHOLD: f64 = 0.8;
/// Objects whose probabilities differ by less are equally probable.
const TIE: f64 = 0.1;
/// Least probability of each object of a group.
const OBJECT_THRESHOLD: f64 = 0.5;

/// A mention in words and objects of the scene by index.
#[derive(Debug, Clone, PartialEq)]
pub struct DecodedMention {
    /// Its words.
    pub words: Range<usize>,
    /// Indices of its objects, ascending; empty for a thing that the scene lacks.
    pub objects: Vec<usize>,
    /// Probability, 0..=1.
    pub probability: f64,
}

/// The mentions of a sentence, in order.
///
/// # Errors
/// [`DirectorError::NotFinite`] when the weights are damaged · [`DirectorError::Compute`] when a tensor operation fails.
pub fn decode(network: &NamesNetwork, sentence: &Sentence) -> Result<Vec<DecodedMention>, DirectorError> {
    if sentence.words.is_empty() {
        return Ok(Vec::new());
    }
    let batch = SentenceBatch::new(&[sentence])?;
    let states = network.states(&batch, &Dropout::off())?;
    let tags = network.tags(&states)?.to_vec2::<f32>()?;
    tags.iter().try_for_each(|scores| check_finite(WEIGHTS_FILE, "tags", scores))?;
    let mut found: Vec<DecodedMention> = Vec::new();
    for (words, tagged) in spans(&tags, sentence) {
        let earlier: Vec<Vec<usize>> = found.iter().map(|mention| mention.objects.clone()).collect();
        let input = MentionInput::new(sentence, words.clone(), &earlier);
        let mention_batch = MentionBatch::new(&[(0, &input)], &[sentence], &batch)?;
        let scores = network.point(&states, &mention_batch, &Dropout::off())?;
        let (objects, missing) = (scores.objects.to_vec2::<f32>()?, scores.missing.to_vec2::<f32>()?);
        objects.iter().chain(&missing).try_for_each(|row| check_finite(WEIGHTS_FILE, "scores of objects", row))?;
        let scored: Vec<f64> = objects.iter().take(sentence.scene.objects.len()).map(|row| yes(row)).collect();
        let missing = missing.first().map_or(0.0, |row| yes(row));
        let (objects, pointed) = choose(&scored, missing);
        let objects = if input.is_plural() { objects } else { one_of(sentence, objects, &scored) };
        let objects = named_one(sentence, &words, objects);
        let mention = by_number(sentence, DecodedMention { words, objects, probability: tagged * pointed });
        if !mention.objects.is_empty() || mention.probability >= REFUSAL_THRESHOLD {
            found.push(mention);
        }
    }
    Ok(found)
}

/// Of several objects of different names the most probable, of equally probable ones the first. A group of one name stays.
fn one_of(sentence: &Sentence, objects: Vec<usize>, scored: &[f64]) -> Vec<usize> {
    let stems = |at: &usize| sentence.scene.objects[*at].label.stems();
    if objects.windows(2).all(|pair| stems(&pair[0]) == stems(&pair[1])) {
        return objects;
    }
    let top = objects.iter().map(|at| scored[*at]).fold(0.0, f64::max);
    objects.into_iter().find(|at| scored[*at] > top - TIE).into_iter().collect()
}

/// The one object whose head a mention ends with, instead of an object that the words have nothing in common with. What
/// stands behind `by` or `near` is where the thing is.
fn named_one(sentence: &Sentence, words: &Range<usize>, chosen: Vec<usize>) -> Vec<usize> {
    match chosen[..] {
        [one] if !sentence.touches(words.clone(), one) && !says_place(sentence, words) => {
            sentence.only_named(words.end - 1).map_or(chosen, |named| vec![named])
        }
        _ => chosen,
    }
}

/// The objects of a mention and their probability. Without any: a thing that the scene lacks.
fn choose(objects: &[f64], missing: f64) -> (Vec<usize>, f64) {
    let best = objects.iter().enumerate().fold(None, |best: Option<(usize, f64)>, (at, p)| match best {
        Some((_, top)) if top >= *p => best,
        _ => Some((at, *p)),
    });
    let Some((best, top)) = best.filter(|_| missing <= MISSING_THRESHOLD) else { return (Vec::new(), missing) };
    let chosen: Vec<usize> = (0..objects.len()).filter(|at| objects[*at] > OBJECT_THRESHOLD).collect();
    if chosen.is_empty() {
        return (vec![best], top * (1.0 - missing));
    }
    let least = chosen.iter().map(|at| objects[*at]).fold(1.0, f64::min);
    (chosen, least * (1.0 - missing))
}

/// A mention by number is what it says: one that begins a mention, and any that the pointer has read as another thing.
fn by_number(sentence: &Sentence, mention: DecodedMention) -> DecodedMention {
    let Some(at) = mention.words.clone().find(|i| sentence.words[*i].tag.is_some()) else { return mention };
    let tag = sentence.words[at].tag.flatten();
    let object = sentence.scene.objects.iter().position(|object| Some(object.id) == tag);
    let names_more = sentence.words[mention.words.start..at].iter().filter(|word| word.text.len() > 3).count() > 0;
    match object {
        Some(object) if mention.objects.contains(&object) => mention,
        _ if names_more && !mention.objects.is_empty() => mention,
        Some(object) => DecodedMention { objects: vec![object], probability: 1.0, ..mention },
        None => DecodedMention { objects: Vec::new(), probability: 1.0, ..mention },
    }
}

/// The most probable words of mentions, each with the least probability of its tags. A mention by number that no tag
/// covers is a mention of its own.
fn spans(tags: &[Vec<f32>], sentence: &Sentence) -> Vec<(Range<usize>, f64)> {
    let rows: Vec<[f64; NUM_TAGS]> = tags.iter().take(sentence.words.len()).map(|row| log_softmax(row)).collect();
    let mut path = best_path(&rows);
    for (i, word) in sentence.words.iter().enumerate() {
        if word.tag.is_some() && path[i] == 0 {
            path[i] = 1;
        }
    }
    let mut out: Vec<(Range<usize>, f64)> = Vec::new();
    for (i, tag) in path.iter().enumerate() {
        let probability = if sentence.words[i].tag.is_some() { 1.0 } else { rows[i][*tag].exp() };
        match (*tag, out.last_mut()) {
            (0, _) => {}
            (2, Some((words, least))) if words.end == i => {
                words.end = i + 1;
                *least = least.min(probability);
            }
            _ => out.push((i..i + 1, probability)),
        }
    }
    out.iter_mut().for_each(|(words, _)| trim(words, sentence));
    out.retain(|(words, _)| !words.is_empty());
    out
}

/// Leaves out words at the end of a mention that name nothing, and a mention of only such words.
fn trim(words: &mut Range<usize>, sentence: &Sentence) {
    const NOTHING: [&str; 26] = [
        "the", "a", "an", "of", "with", "and", "above", "under", "below", "behind", "beside", "by", "near", "nearest",
        "on", "in", "at", "to", "from", "that", "all", "next", "over", "for", "its", "is",
    ];
    let is_nothing = |word: &super::words::NameWord| {
        word.tag.is_none() && (NOTHING.contains(&word.text.as_str()) || !word.text.starts_with(char::is_alphanumeric))
    };
    // `Until the locker stands in the middle`: what it does, and no stand.
    let text = |at: usize| sentence.words.get(at).map_or("", |word| word.text.as_str());
    let is_verb = words.len() > 1
        && matches!(text(words.end - 1), "stands" | "sits" | "lies" | "hangs" | "rests" | "looks" | "shows" | "fills")
        && matches!(text(words.end), "in" | "at" | "on" | "there" | "dead" | "right" | "exactly" | "alone");
    // `Gliding to the lectern, tip the camera`.
    let is_tipped = words.len() > 1
        && text(words.end - 1) == "tip"
        && text(words.end) == "the"
        && matches!(text(words.end + 1), "camera" | "frame" | "view" | "picture" | "horizon");
    words.end -= usize::from(is_verb || is_tipped);
    while words.end > words.start && is_nothing(&sentence.words[words.end - 1]) {
        words.end -= 1;
    }
}

/// The most probable tags in which a further word follows a word of a mention (Viterbi 1967).
fn best_path(rows: &[[f64; NUM_TAGS]]) -> Vec<usize> {
    let mut scores = [0.0, 0.0, f64::NEG_INFINITY];
    let mut from: Vec<[usize; NUM_TAGS]> = Vec::with_capacity(rows.len());
    for (i, row) in rows.iter().enumerate() {
        let any = (0..NUM_TAGS).fold(0, |best, tag| if scores[tag] > scores[best] { tag } else { best });
        let inside = if scores[1] >= scores[2] { 1 } else { 2 };
        let before = if i == 0 { [0, 0, 0] } else { [any, any, inside] };
        let start = |tag: usize| match (i, tag) {
            (0, 2) => f64::NEG_INFINITY,
            (0, _) => 0.0,
            _ => scores[before[tag]],
        };
        scores = [0, 1, 2].map(|tag| start(tag) + row[tag]);
        from.push(before);
    }
    let mut tag = (0..NUM_TAGS).fold(0, |best, tag| if scores[tag] > scores[best] { tag } else { best });
    let mut path = vec![0; rows.len()];
    for i in (0..rows.len()).rev() {
        path[i] = tag;
        tag = from[i][tag];
    }
    path
}

fn log_softmax(row: &[f32]) -> [f64; NUM_TAGS] {
    let top = row.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let sum: f32 = row.iter().map(|score| (score - top).exp()).sum();
    let mut out = [0.0; NUM_TAGS];
    out.iter_mut().zip(row).for_each(|(to, score)| *to = f64::from(score - top - sum.ln()));
    out
}

/// Probability of yes of a row `[no, yes]`.
fn yes(row: &[f32]) -> f64 {
    let (no, yes) = (row.first().copied().unwrap_or(0.0), row.get(1).copied().unwrap_or(0.0));
    1.0 / (1.0 + f64::from(no - yes).exp())
}
