//! Object names in running words: which words of a sentence mean which object.

use std::collections::BTreeMap;

use super::inflection::stem;
use super::lexicon::Lexicon;
use super::words::{Word, words};

/// An object as a prompt can name it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedObject {
    /// Identity, `<obj-N>`.
    pub id: u32,
    /// Name such as `golden skull`; empty when it has none.
    pub label: String,
}

/// Words `start..start + len` mean these objects.
#[derive(Debug, Clone, PartialEq)]
pub struct NameMatch {
    pub len: usize,
    /// Indices into the objects. Several when a plural takes them all.
    pub objects: Vec<usize>,
    /// Other objects of the same name: the words did not decide.
    pub rivals: Vec<usize>,
}

/// How well words fit a label; later is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fit {
    Synonym,
    Tail,
    Head,
    Qualified,
    Full,
}

/// A label taken apart, in stems: `stack of teal plates` has the head `stack` and the tail `teal plate`.
#[derive(Debug)]
struct Label {
    full: Vec<String>,
    head: String,
    /// Last qualifier and head in one word: `armchair` for `arm chair`.
    joined: String,
    qualifiers: Vec<String>,
    tail: Vec<String>,
    /// The name is a plural itself.
    plural: bool,
}

/// Labels by the stems of the words that can end a mention of them.
pub struct NameIndex<'a> {
    labels: Vec<Label>,
    by_last: BTreeMap<String, Vec<usize>>,
    lexicon: &'a Lexicon,
    longest: usize,
}

const LINKS: [&str; 8] = ["of", "with", "on", "in", "for", "from", "at", "under"];

impl<'a> NameIndex<'a> {
    pub fn new(objects: &[NamedObject], lexicon: &'a Lexicon) -> Self {
        let labels: Vec<Label> = objects.iter().map(|object| take_apart(&object.label)).collect();
        let mut by_last: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (index, label) in labels.iter().enumerate() {
            for last in ends(label) {
                by_last.entry(last).or_default().push(index);
            }
        }
        let longest = labels.iter().map(|label| label.full.len()).max().unwrap_or(0).clamp(2, 8);
        Self { labels, by_last, lexicon, longest }
    }

    /// The longest and best fitting name that begins at word `start`.
    pub fn match_at(&self, words: &[Word], start: usize) -> Option<NameMatch> {
        let longest = self.longest.min(words.len().saturating_sub(start));
        (1..=longest).rev().find_map(|len| self.match_of(words.get(start..start + len)?, words.get(start + len)))
    }

    fn match_of(&self, segment: &[Word], next: Option<&Word>) -> Option<NameMatch> {
        let last = segment.last().filter(|word| word.is_alphabetic())?;
        let second_last = segment.len().checked_sub(2).and_then(|i| segment.get(i));
        let joined = second_last.map(|word| stem(&format!("{}{}", word.text, last.text)));
        let mut fits: Vec<(Fit, usize)> = Vec::new();
        for (key, used) in [(Some(last.stem.clone()), 1), (joined, 2)] {
            let Some(key) = key else { continue };
            let before = segment.get(..segment.len() - used).unwrap_or_default();
            fits.extend(self.candidates(&key).filter_map(|i| Some((self.fit(i, before, &key, segment)?, i))));
        }
        for used in 1..=segment.len().min(3) {
            let (before, name) = segment.split_at(segment.len() - used);
            fits.extend(self.synonymous(&stems(name), before));
            if let [first, second] = name {
                fits.extend(self.synonymous(&stem(&format!("{}{}", first.text, second.text)), before));
            }
        }
        let best = fits.iter().map(|(fit, _)| *fit).max()?;
        let mut chosen: Vec<usize> = fits.iter().filter(|(fit, _)| *fit == best).map(|(_, i)| *i).collect();
        chosen.sort_unstable();
        chosen.dedup();
        // `the chairs` of a scene with two chairs; a label that is a plural itself is one object.
        let plural = last.text.ends_with('s') && last.stem != last.text;
        let all_singular = chosen.iter().filter_map(|i| self.labels.get(*i)).all(|label| !label.plural);
        if chosen.len() > 1 && plural && all_singular && next.is_none_or(|word| word.text != "'s") {
            return Some(NameMatch { len: segment.len(), objects: chosen, rivals: Vec::new() });
        }
        let rivals = chosen.split_off(1);
        Some(NameMatch { len: segment.len(), objects: chosen, rivals })
    }

    fn candidates(&self, key: &str) -> impl Iterator<Item = usize> {
        self.by_last.get(key).into_iter().flatten().copied()
    }

    fn fit(&self, index: usize, before: &[Word], key: &str, segment: &[Word]) -> Option<Fit> {
        let label = self.labels.get(index)?;
        if label.full.len() == segment.len() && label.full.iter().zip(segment).all(|(a, b)| *a == b.stem) {
            // Words of camera talk never name an object alone.
            let talk = self.lexicon.camera.contains(key) || self.lexicon.function.contains(key);
            return (segment.len() > 1 || !talk).then_some(Fit::Full);
        }
        if self.lexicon.camera.contains(key) || self.lexicon.function.contains(key) {
            return None;
        }
        let within = |word: &Word, of: &[String]| of.contains(&word.stem);
        if head_is(label, key) {
            return match before {
                [] => Some(Fit::Head),
                _ if before.iter().all(|word| within(word, &label.qualifiers)) => Some(Fit::Qualified),
                _ => None,
            };
        }
        before.iter().all(|word| within(word, &label.tail)).then_some(Fit::Tail)
    }

    /// Objects that another name of the same meaning names.
    fn synonymous(&self, name: &str, before: &[Word]) -> Vec<(Fit, usize)> {
        let mut found = Vec::new();
        for other in self.lexicon.synonyms.get(name).into_iter().flatten() {
            let last = other.rsplit(' ').next().unwrap_or(other);
            found
                .extend(self.candidates(last).filter(|i| self.is_called(*i, other, before)).map(|i| (Fit::Synonym, i)));
        }
        found
    }

    /// Whether the label ends its front in `name` and `before` are others of its words.
    fn is_called(&self, index: usize, name: &str, before: &[Word]) -> bool {
        let Some(label) = self.labels.get(index) else { return false };
        let front: Vec<&String> = label.qualifiers.iter().chain([&label.head]).collect();
        let name: Vec<&str> = name.split(' ').collect();
        front.len() >= name.len()
            && front.iter().rev().zip(name.iter().rev()).all(|(a, b)| *a == b)
            && before.iter().all(|word| front.contains(&&word.stem))
    }

    /// Labels by nearness to some words, best first, at most three.
    pub fn nearest(&self, name: &[String], objects: &[NamedObject]) -> Vec<String> {
        let text = name.join(" ");
        let last = name.last().map(|word| stem(word)).unwrap_or_default();
        let mut scored: Vec<(f64, u32, String)> = Vec::new();
        for (object, label) in objects.iter().zip(&self.labels) {
            let shared = label.full.iter().filter(|word| name.iter().any(|n| stem(n) == **word)).count() as f64;
            let whole = relative_distance(&text, &label.full.join(" "));
            let head = relative_distance(&last, &label.head);
            scored.push((whole.min(head) - shared, object.id, shown(object)));
        }
        scored.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        scored.into_iter().take(3).map(|(_, _, text)| text).collect()
    }

    /// The one object whose head is a letter or two away from the last of some words.
    pub fn misspelled(&self, word: &str) -> Option<usize> {
        let count = word.chars().count();
        if count < 4 {
            return None;
        }
        let allowed = if count < 7 { 1 } else { 2 };
        let near = |label: &Label| label.head.chars().count() > 3 && distance(word, &label.head) <= allowed;
        let mut found = self.labels.iter().enumerate().filter(|(_, label)| near(label)).map(|(i, _)| i);
        found.next().filter(|_| found.next().is_none())
    }
}

fn head_is(label: &Label, key: &str) -> bool {
    label.head == key || label.joined == key
}

fn stems(words: &[Word]) -> String {
    words.iter().map(|word| word.stem.as_str()).collect::<Vec<_>>().join(" ")
}

/// Words that a mention of the label can end in.
fn ends(label: &Label) -> Vec<String> {
    let mut ends = vec![label.head.clone(), label.joined.clone()];
    ends.extend(label.full.last().cloned());
    ends.extend(label.tail.last().cloned());
    ends.retain(|end| !end.is_empty());
    ends.sort_unstable();
    ends.dedup();
    ends
}

fn take_apart(label: &str) -> Label {
    let words = words(label);
    let link = words.iter().position(|word| LINKS.contains(&word.text.as_str())).filter(|at| *at > 0);
    let (front, rest) = words.split_at(link.unwrap_or(words.len()));
    let stems = |words: &[Word]| words.iter().map(|word| word.stem.clone()).collect::<Vec<_>>();
    let (head, qualifiers) = front.split_last().map_or((None, &[][..]), |(head, before)| (Some(head), before));
    let joined = head.zip(qualifiers.last()).map(|(head, last)| stem(&format!("{}{}", last.text, head.text)));
    Label {
        full: stems(&words),
        head: head.map(|word| word.stem.clone()).unwrap_or_default(),
        joined: joined.unwrap_or_default(),
        qualifiers: stems(qualifiers),
        tail: stems(rest.get(1..).unwrap_or_default()),
        plural: head.is_some_and(|word| word.stem != word.text),
    }
}

/// An object for a list of names.
pub fn shown(object: &NamedObject) -> String {
    if object.label.is_empty() {
        format!("<obj-{}>", object.id)
    } else {
        format!("<obj-{}> {}", object.id, object.label)
    }
}

fn relative_distance(a: &str, b: &str) -> f64 {
    distance(a, b) as f64 / a.chars().count().max(b.chars().count()).max(1) as f64
}

/// Edits (insert, delete, replace, swap neighbors) from one word to another; words beyond 40 letters count as far.
pub fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().take(41).collect(), b.chars().take(41).collect());
    if a.len() > 40 || b.len() > 40 {
        return usize::from(a != b) * 41;
    }
    let width = b.len() + 1;
    let mut table = vec![0usize; (a.len() + 1) * width];
    let cell = |table: &[usize], i: usize, j: usize| table.get(i * width + j).copied().unwrap_or(0);
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            let value = if i == 0 || j == 0 {
                i + j
            } else {
                let replace = cell(&table, i - 1, j - 1) + usize::from(a.get(i - 1) != b.get(j - 1));
                let shift = cell(&table, i - 1, j).min(cell(&table, i, j - 1)) + 1;
                let swapped = i > 1 && j > 1 && a.get(i - 1) == b.get(j - 2) && a.get(i - 2) == b.get(j - 1);
                let swap = if swapped { cell(&table, i - 2, j - 2) + 1 } else { usize::MAX };
                replace.min(shift).min(swap)
            };
            if let Some(slot) = table.get_mut(i * width + j) {
                *slot = value;
            }
        }
    }
    table.last().copied().unwrap_or(0)
}
