//! Words that say at which moment of the film a picture is seen.

use cinesplat_language::{Beat, Linked, QuantityKind};

/// A moment of the film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Moment {
    /// Its first picture.
    Start,
    /// Its last picture.
    End,
    /// All its pictures.
    Throughout,
}

/// Words of a moment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mark {
    /// Number of its words.
    pub(super) len: usize,
    /// The moment.
    pub(super) moment: Moment,
    /// Whether it heads a description: `Opening composition:`.
    pub(super) heads: bool,
    /// Whether it is the verb of a clause, which may be about a move: `ends on ..`.
    pub(super) is_verb: bool,
    /// The time of the end, where it is stated so: `at t = 8 s`.
    pub(super) end_secs: Option<f64>,
}

impl Mark {
    /// A mark within a description.
    const fn of(len: usize, moment: Moment) -> Self {
        Self { len, moment, heads: false, is_verb: false, end_secs: None }
    }
}

const FIRST: [&str; 8] = ["start", "starting", "opening", "first", "initial", "beginning", "begin", "t0"];
const LAST: [&str; 8] = ["end", "ending", "closing", "last", "final", "finishing", "finish", "tend"];
/// What is seen at one moment.
const FRAMES: [&str; 7] = ["frame", "composition", "picture", "image", "framing", "keyframe", "pose"];

/// Phrases within or at the edge of a description.
const PHRASES: [(&[&str], Moment); 22] = [
    (&["at", "the", "start"], Moment::Start),
    (&["at", "the", "beginning"], Moment::Start),
    (&["at", "the", "outset"], Moment::Start),
    (&["at", "start"], Moment::Start),
    (&["in", "the", "beginning"], Moment::Start),
    (&["to", "begin", "with"], Moment::Start),
    (&["to", "start", "with"], Moment::Start),
    (&["initially"], Moment::Start),
    (&["at", "t", "0"], Moment::Start),
    (&["at", "the", "end"], Moment::End),
    (&["at", "the", "finish"], Moment::End),
    (&["by", "the", "end"], Moment::End),
    (&["in", "the", "end"], Moment::End),
    (&["at", "end"], Moment::End),
    (&["in", "the", "last"], Moment::End),
    (&["in", "the", "final"], Moment::End),
    (&["finally"], Moment::End),
    (&["throughout"], Moment::Throughout),
    (&["always"], Moment::Throughout),
    (&["at", "all", "times"], Moment::Throughout),
    (&["on", "every", "frame"], Moment::Throughout),
    (&["in", "every", "frame"], Moment::Throughout),
];
/// Verbs that begin a description where it goes on with `on` or `with`.
const BEGINS: [&str; 8] = ["start", "starts", "begin", "begins", "open", "opens", "starting", "beginning"];
const ENDS: [&str; 8] = ["end", "ends", "finish", "finishes", "close", "closes", "ending", "finishing"];
const WITHS: [&str; 6] = ["with", "w", "on", "w/", "up", "having"];

/// The words of a moment at word `i` of a prompt whose words are `words`.
pub(super) fn mark_at(linked: &Linked, words: &[&str], i: usize) -> Option<Mark> {
    frame_at(words, i)
        .or_else(|| time_at(linked, words, i))
        .or_else(|| {
            let found = PHRASES.iter().find(|(phrase, _)| words[i..].starts_with(phrase));
            found.map(|(phrase, moment)| Mark::of(phrase.len(), *moment))
        })
        .or_else(|| verb_at(words, i))
}

/// `Opening composition:`, `in the first frame`, `last frame`, `Start:`.
fn frame_at(words: &[&str], i: usize) -> Option<Mark> {
    let word = |at: usize| words.get(at).copied().unwrap_or_default();
    let leads = usize::from(matches!(word(i), "in" | "on" | "at" | "for"));
    let leads = leads + usize::from(word(i + leads) == "the");
    let moment = moment_of(word(i + leads))?;
    let is_frame = FRAMES.contains(&word(i + leads + 1));
    let end = i + leads + 1 + usize::from(is_frame);
    let heads = matches!(word(end), ":");
    let is_label = heads && leads == 0;
    if !(is_frame || is_label) || word(end) == "of" {
        return None;
    }
    Some(Mark { heads: heads && is_frame, ..Mark::of(end - i + usize::from(heads), moment) })
}

fn moment_of(word: &str) -> Option<Moment> {
    let is_first = FIRST.contains(&word).then_some(Moment::Start);
    is_first.or_else(|| LAST.contains(&word).then_some(Moment::End))
}

/// `at t = 8 s`, and a time that nothing in the prompt lies behind: `at 00:10`.
fn time_at(linked: &Linked, words: &[&str], i: usize) -> Option<Mark> {
    let names_time = words.get(i + 1) == Some(&"t");
    let at = i + 1 + usize::from(names_time);
    let secs = |word: &str| {
        let quantity = linked.quantity_at(word)?;
        (quantity.kind == QuantityKind::Seconds).then_some(quantity.value)
    };
    let time = words.get(at).and_then(|word| secs(word)).filter(|_| words[i] == "at")?;
    let beats = linked.timeline.iter().flat_map(|timeline| &timeline.beats);
    let total: f64 = beats.filter_map(Beat::secs).sum();
    let is_last = words.iter().filter_map(|word| secs(word)).all(|other| other <= time) && time >= total - 1e-6;
    // A time alone may be that of a move: `at 4 s pan left`.
    let mark = Mark { end_secs: Some(time), ..Mark::of(at + 1 - i, Moment::End) };
    (is_last && (names_time || total > 0.0)).then_some(mark)
}

/// `begins on ..`, `finish with ..`, `ends up ..`.
fn verb_at(words: &[&str], i: usize) -> Option<Mark> {
    let moment = match () {
        () if BEGINS.contains(&words[i]) => Moment::Start,
        () if ENDS.contains(&words[i]) => Moment::End,
        () => return None,
    };
    let with = words.get(i + 1).filter(|word| WITHS.contains(word))?;
    (*with != "up" || moment == Moment::End).then_some(Mark { is_verb: true, ..Mark::of(2, moment) })
}
