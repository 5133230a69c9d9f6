//! How high the camera is by what people compare it with: `at knee height`, `from a cat's point of view`, `camera two meters
//! up`, `level with the bottle`, `aerial`.

use cinesplat_language::{LanguageError, Linked, QuantityKind, SpokenHeight};
use cinesplat_operator::{Amount, Framing, Motion, Step};
use cinesplat_trajectory::{Move, ShotAngle};

use super::bans::{SENTENCE_ENDS, asks_for};
use super::directions::is_form;
use crate::direction::Direction;
use crate::director::SceneContext;

/// What is as high as the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Height {
    /// Above the floor, scene units.
    Units(f64),
    /// From above, at no height of its own.
    Air,
    /// As high as an object, by its id.
    Object(u32),
    /// As high as what it looks at.
    Subject,
}

/// Words of a height, with their positions.
#[derive(Debug, Clone, Copy)]
struct Mention {
    words: [usize; 2],
    height: Height,
}

/// Writes the heights of the words into the steps that they are about: those in whose words they stand, or all of them. It is
/// no part of [`Director::direct`](crate::Director::direct): the sentences of training give such heights no meters.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of heights.
pub fn take_levels(linked: &Linked, scene: &SceneContext<'_>, direction: &mut Direction) -> Result<(), LanguageError> {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    if words.len() != linked.spans.len() {
        return Ok(());
    }
    let mentions = mentions(linked, &words)?;
    let of_step = |step: &Step, mention: &Mention| {
        let byte = linked.spans[mention.words[0]][0];
        step.words.is_some_and(|[from, to]| (from..to).contains(&byte))
    };
    let steps = &mut direction.program.steps;
    let stands_apart = |mention: &Mention, steps: &[Step]| {
        holds_throughout(&words, mention.words[0]) || !steps.iter().any(|step| of_step(step, mention))
    };
    let apart: Vec<bool> = mentions.iter().map(|mention| stands_apart(mention, steps)).collect();
    for step in steps.iter_mut() {
        let own = mentions.iter().zip(&apart).filter(|(mention, apart)| !**apart && of_step(step, mention));
        let own: Vec<Mention> = own.map(|(mention, _)| above_floor(linked, scene, step, mention)).collect();
        let throughout = mentions.iter().zip(&apart).filter(|(_, apart)| **apart).map(|(mention, _)| *mention).next();
        if own.is_empty() {
            throughout.into_iter().for_each(|mention| hold(linked, step, mention.height));
        } else {
            take(linked, &words, step, &own);
        }
    }
    let is_met = |span: &[usize; 2]| {
        let bytes = |mention: &Mention| [linked.spans[mention.words[0]][0], linked.spans[mention.words[1] - 1][1]];
        mentions.iter().map(bytes).any(|[from, to]| from <= span[0] && span[1] <= to)
    };
    direction.unmet.retain(|span| !is_met(span));
    mentions
        .iter()
        .zip(&apart)
        .filter(|(_, apart)| **apart)
        .for_each(|(mention, _)| own_words(linked, direction, mention));
    Ok(())
}

/// A mention of a height that is another thing's than those that the step shows, above the floor: `up along the shelf, starting level
/// with the stool`.
fn above_floor(linked: &Linked, scene: &SceneContext<'_>, step: &Step, mention: &Mention) -> Mention {
    let Height::Object(id) = mention.height else { return *mention };
    let [id] = linked.expanded(&[id])[..] else { return *mention };
    let is_shown = [&step.start, &step.end].into_iter().any(|framing| framing.subjects.contains(&id));
    let top = top_above_floor(scene, id).filter(|_| !is_shown);
    Mention { height: top.map_or(mention.height, Height::Units), ..*mention }
}

/// Least number of things that stand on a floor, and how far apart, over the scene size, their lower ends are at most.
const STANDING: usize = 3;
const UNEVEN_FRAC: f64 = 0.02;

/// How high the upper end of a thing is above the floor, where other things show where that is.
fn top_above_floor(scene: &SceneContext<'_>, id: u32) -> Option<f64> {
    let spans: Vec<[f64; 2]> = scene.objects.iter().map(|object| object.span_along(scene.up)).collect();
    let floor = spans.iter().map(|[bottom, _]| *bottom).fold(f64::INFINITY, f64::min);
    let standing = spans.iter().filter(|[bottom, _]| bottom - floor <= UNEVEN_FRAC * scene.size).count();
    // Boxes that are all as high are made up.
    let differ = spans.windows(2).any(|two| (two[0][1] - two[1][1]).abs() > UNEVEN_FRAC * scene.size);
    let own = scene.objects.iter().position(|object| object.id == id)?;
    (standing >= STANDING && differ).then(|| spans[own][1] - floor)
}

/// Adds the words of a height that holds throughout to those of the first step behind it, or the last one before it.
fn own_words(linked: &Linked, direction: &mut Direction, mention: &Mention) {
    let steps = &mut direction.program.steps;
    let [from, to] = [linked.spans[mention.words[0]][0], linked.spans[mention.words[1] - 1][1]];
    let covered = |step: &Step| step.words.is_some_and(|words| words[0] <= from && to <= words[1]);
    if steps.iter().any(covered) {
        return;
    }
    let behind = steps.iter().position(|step| step.words.is_some_and(|words| words[0] >= to));
    let before = steps.iter().rposition(|step| step.words.is_some_and(|words| words[1] <= from));
    let Some(own) = behind.or(before).and_then(|nth| steps.get_mut(nth)?.words.as_mut()) else { return };
    *own = [own[0].min(from), own[1].max(to)];
}

/// Words that make a height that of the whole film.
const THROUGHOUT: [&str; 9] =
    ["throughout", "always", "constantly", "permanently", "whole", "entire", "stays", "times", "never"];
/// Marks that end a clause.
const MARKS: [&str; 4] = [",", ":", "(", ")"];

/// Whether the clause at word `at` speaks of the whole film.
fn holds_throughout(words: &[&str], at: usize) -> bool {
    let ends = |word: &&&str| SENTENCE_ENDS.contains(*word) || MARKS.contains(*word);
    let before = words[..at].iter().rev().take_while(|word| !ends(word)).take(6);
    let behind = words[at..].iter().take_while(|word| !ends(word)).take(8);
    before.chain(behind).any(|word| THROUGHOUT.contains(word))
}

/// Words before a length by which it is a height, behind `camera`, and words of a place above something behind it.
const AT: [&str; 12] =
    ["at", "from", "camera", "cam", "lens", "about", "around", "roughly", "only", "just", "with", "is"];
const GROUND: [&str; 5] = ["floor", "ground", "carpet", "deck", "grass"];
/// Words of one height and another's.
const SAME: [&str; 4] = ["level", "same", "flush", "high"];

/// The heights that the words name, in order.
fn mentions(linked: &Linked, words: &[&str]) -> Result<Vec<Mention>, LanguageError> {
    let spoken = linked.spoken_heights()?.into_iter().map(|(words, height)| {
        let height = match height {
            SpokenHeight::Meters(meters) => Height::Units(meters),
            SpokenHeight::Air => Height::Air,
        };
        Mention { words, height }
    });
    let mut found: Vec<Mention> = spoken.collect();
    for at in 0..words.len() {
        let mention = stated_at(linked, words, at).or_else(|| compared_at(linked, words, at));
        found.extend(mention.filter(|_| !found.iter().any(|other| (other.words[0]..other.words[1]).contains(&at))));
    }
    found.sort_by_key(|mention| mention.words[0]);
    Ok(found)
}

/// A height in scene units: `camera two meters up`, `from a height of 3 m`, `1.6 m off the floor`.
fn stated_at(linked: &Linked, words: &[&str], at: usize) -> Option<Mention> {
    let word = |at: usize| words.get(at).copied().unwrap_or_default();
    let quantity = linked.quantity_at(words[at]).filter(|quantity| quantity.kind == QuantityKind::Units)?;
    let before = at.checked_sub(1).map_or(",", word);
    let is_above = matches!(word(at + 1), "above" | "off" | "over" | "from")
        && (GROUND.contains(&word(at + 2)) || word(at + 2) == "the" && GROUND.contains(&word(at + 3)));
    let ends = !word(at + 2).starts_with(|c: char| c == '<' || c.is_alphanumeric())
        || matches!(word(at + 2), "in" | "and" | "while");
    let is_high = matches!(word(at + 1), "up" | "high") && (AT.contains(&before) || before == "," && ends);
    let is_named = before == "of" && at > 1 && matches!(word(at - 2), "height" | "altitude")
        || matches!(before, "height" | "altitude") && at > 1 && matches!(word(at - 2), "camera" | "lens" | "cam")
        || AT[..2].contains(&before) && matches!(word(at + 1), "height" | "altitude");
    let end = at + 1 + usize::from(is_high) + if is_above { 2 } else { 0 };
    (is_above || is_high || is_named)
        .then_some(Mention { words: [at, end.min(words.len())], height: Height::Units(quantity.value) })
}

/// A height that is an object's: `at bottle height`, `level with the bottle`, `the same height as it`, `at eye level`.
fn compared_at(linked: &Linked, words: &[&str], at: usize) -> Option<Mention> {
    let word = |at: usize| words.get(at).copied().unwrap_or_default();
    let before = |n: usize| at.checked_sub(n).map_or("", word);
    let found = |words: [usize; 2], height: Height| Some(Mention { words, height });
    // `Eye height 1.2 m` is a length.
    let is_length = linked.is_quantity(word(at + 2)) || linked.is_quantity(word(at + 3));
    if word(at) == "eye" && matches!(word(at + 1), "level" | "height" | "line") && !is_length {
        return found([at, at + 2], Height::Subject);
    }
    let id = linked.slot_at(words[at])?;
    let owned = at + 1 + usize::from(word(at + 1) == "'s");
    if matches!(word(owned), "height" | "level")
        && (AT.contains(&before(1)) || before(1) == "the" && AT.contains(&before(2)))
    {
        return found([at, owned + 1], Height::Object(id));
    }
    let is_same =
        matches!(before(1), "with" | "as") && (SAME.contains(&before(2)) || matches!(before(2), "height" | "level"));
    let is_of = before(1) == "of"
        && matches!(before(2), "height" | "level")
        && (AT.contains(&before(4)) || AT.contains(&before(3)));
    (is_same || is_of).then_some(Mention { words: [at - 2, at + 1], height: Height::Object(id) })
}

/// Words that lead to a height, and words that lead from one.
const TO: [&str; 15] = [
    "to",
    "until",
    "till",
    "into",
    "reach",
    "reaches",
    "reaching",
    "ends",
    "ending",
    "finish",
    "finishes",
    "finishing",
    "landing",
    "settling",
    "stopping",
];
const FROM: [&str; 7] = ["from", "start", "starting", "begin", "beginning", "open", "opening"];
/// Verbs of a camera that rises, and of one that sinks.
const RISES: [&str; 10] = ["rise", "lift", "climb", "crane", "boom", "ascend", "raise", "float", "come", "up"];
const SINKS: [&str; 9] = ["sink", "drop", "lower", "descend", "fall", "down", "dip", "duck", "crouch"];
/// How far before a height its words stand.
const REACH: usize = 4;

/// Writes the heights in a step's own words into it.
fn take(linked: &Linked, words: &[&str], step: &mut Step, mentions: &[Mention]) {
    let near = |mention: &Mention| {
        // `Finishing at about the height of a standing person`.
        let is_between =
            |word: &&&str| matches!(**word, "at" | "about" | "the" | "height" | "of" | "a" | "an" | "level");
        let end = mention.words[0];
        let end = end - words[..end].iter().rev().take_while(is_between).count();
        &words[end.saturating_sub(REACH)..mention.words[0]]
    };
    let says = |mention: &Mention, list: &[&str]| near(mention).iter().any(|word| list.contains(word));
    let leads = |mention: &&Mention| says(mention, &TO) && !says(mention, &FROM[..1]);
    let first = mentions.iter().find(|mention| !leads(mention)).map(|mention| mention.height);
    let last = mentions.iter().rev().find(leads);
    let rises = asks_for(step, Motion::Rise);
    // `Move the camera 12 cm up` says how far.
    let is_way = |height: Height| match (height, step.amount) {
        (Height::Units(units), Some(Amount::Units(way))) => rises && (units - way).abs() < 1e-9,
        _ => false,
    };
    let first = first.filter(|height| !is_way(*height));
    match (first, last) {
        (Some(height), None) if rises => begin(linked, step, height),
        (Some(height), None) => hold(linked, step, height),
        (first, Some(mention)) => {
            let verb = |verbs: &[&str]| near(mention).iter().any(|word| verbs.iter().any(|verb| is_form(word, verb)));
            let (Height::Units(to), up) = (mention.height, verb(&RISES)) else {
                if rises {
                    end(linked, step, mention.height);
                }
                return;
            };
            let from = first.and_then(|height| if let Height::Units(units) = height { Some(units) } else { None });
            let is_way = !rises && (up || verb(&SINKS) || from.is_some());
            if is_way && step.movement != Move::Static && step.with.len() < 2 {
                let goes_up = from.map_or(up, |from| to > from);
                step.with.push(if goes_up { Move::CraneUp } else { Move::CraneDown });
            }
            if rises || is_way || step.movement == Move::Static {
                first.into_iter().for_each(|height| begin(linked, step, height));
                end(linked, step, mention.height);
            } else {
                hold(linked, step, mention.height);
            }
        }
        (None, None) => {}
    }
}

/// Holds a height during a step that does not rise or sink.
fn hold(linked: &Linked, step: &mut Step, height: Height) {
    if asks_for(step, Motion::Rise) {
        return;
    }
    // A turn on the spot begins at what the step before shows.
    let travels = step.movement != Move::Static && !step.movement.looks_elsewhere() && step.movement != Move::Follow;
    // A circle begins as high as it ends.
    let circles = step.movement.is_circular() && step.start == Framing::default();
    if travels && !circles || !step.start.subjects.is_empty() {
        begin(linked, step, height);
    }
    if !step.end.subjects.is_empty() || step.movement == Move::Static {
        end(linked, step, height);
    }
}

fn begin(linked: &Linked, step: &mut Step, height: Height) {
    let is_new = step.start == Framing::default();
    let subjects = if is_new { step.end.subjects.clone() } else { step.start.subjects.clone() };
    let mut start = Framing { subjects, ..step.start.clone() };
    // What a circle or a way in begins with is as high as its end, which states it.
    if (!is_new || matches!(height, Height::Units(_))) && write(linked, step, &mut start, height) {
        step.start = start;
    }
}

fn end(linked: &Linked, step: &mut Step, height: Height) {
    let mut framing = step.end.clone();
    if write(linked, step, &mut framing, height) {
        step.end = framing;
    }
    if let Height::Units(units) = height {
        step.amount = step.amount.filter(|amount| !matches!(amount, Amount::Units(way) if (way - units).abs() < 1e-9));
    }
}

/// Writes a height into a framing that has none.
fn write(linked: &Linked, step: &Step, framing: &mut Framing, height: Height) -> bool {
    let is_free = framing.angle.is_none()
        && framing.elevation_deg.is_none()
        && framing.height.is_none()
        && !framing.subjects.is_empty();
    match height {
        Height::Units(units) if framing.height.is_none() => {
            framing.height = Some(units);
            let says_angle = linked.texts_in(step.words.unwrap_or_default()).iter().any(|word| ANGLES.contains(word));
            framing.angle = framing
                .angle
                .filter(|angle| says_angle || !matches!(angle, ShotAngle::EyeLevel | ShotAngle::Low | ShotAngle::Worm));
        }
        Height::Air if is_free => framing.angle = Some(ShotAngle::High),
        Height::Object(id) if is_free && linked.expanded(&[id]) == framing.subjects && framing.height.is_none() => {
            framing.angle = Some(ShotAngle::EyeLevel);
        }
        Height::Subject if is_free && framing.height.is_none() => framing.angle = Some(ShotAngle::EyeLevel),
        _ => return false,
    }
    true
}

/// Words of an angle beside a height, which is one of its own.
const ANGLES: [&str; 7] = ["low", "angle", "worm", "upward", "upwards", "overhead", "skyward"];
