//! Films at one height: `camera height constant`, `at constant altitude 1.6 m`, `same height throughout`.

use cinesplat_language::{Linked, QuantityKind};
use cinesplat_operator::{Amount, Motion, Step};
use cinesplat_trajectory::Move;

use super::bans::asks_for;
use super::directions::is_form;
use crate::direction::Direction;

const HEIGHTS: [&str; 2] = ["height", "altitude"];
/// What the camera's height is called after.
const CAMERAS: [&str; 6] = ["camera", "lens", "cam", "eye", "flight", "head"];
const CONSTANT: [&str; 9] =
    ["constant", "fixed", "unchanged", "unchanging", "locked", "steady", "same", "one", "level"];
/// Words between `height` and what says that it is constant.
const BETWEEN: [&str; 14] =
    ["is", "stays", "stay", "remains", "kept", "held", "at", "a", "the", "of", "to", "be", "must", "should"];
const THROUGHOUT: [&str; 5] = ["throughout", "whole", "always", "way", "times"];
/// Words that say what else has a height.
const OTHERS: [&str; 7] = ["frame", "picture", "image", "screen", "as", "its", "their"];

/// Rules out that the camera rises or sinks where the words say that its height is constant and no step asks for it.
pub(crate) fn hold_height(linked: &Linked, direction: &mut Direction) {
    let program = &mut direction.program;
    let rises = |step: &Step| asks_for(step, Motion::Rise);
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let heights = (0..words.len()).filter(|at| HEIGHTS.contains(&words[*at]));
    let Some(held) = heights.into_iter().find_map(|at| held_height(linked, &words, at)) else { return };
    if program.steps.iter().any(rises) {
        return;
    }
    program.forbid(Motion::Rise);
    let is_met = |word: &str| HEIGHTS.contains(&word) || CONSTANT.contains(&word) || CAMERAS.contains(&word);
    direction.unmet.retain(|span| !linked.words_in(*span).all(|(word, _)| is_met(word)));
    let Some(height) = held.units else { return };
    if let Some(step) = program.steps.first_mut().filter(|step| step.start.height.is_none()) {
        step.start.height = Some(height);
    }
    for step in &mut program.steps {
        step.amount =
            step.amount.filter(|amount| !matches!(amount, Amount::Units(units) if units.to_bits() == height.to_bits()));
    }
}

/// Words before a height at which a camera is, and words of the ground behind it.
const AT: [&str; 6] = ["at", "around", "about", "only", "roughly", "just"];
const GROUND: [&str; 4] = ["floor", "ground", "carpet", "deck"];

/// Verbs of ways without a goal.
const WANDERS: [&str; 9] = ["wander", "walk", "explore", "roam", "drift", "move", "fly", "float", "glide"];
/// Words of a rise or a descent.
const RISES: [&str; 14] = [
    "rise", "rises", "up", "down", "lower", "lift", "climb", "descend", "sink", "drop", "crane", "pedestal", "boom",
    "raise",
];

/// Begins at the height at which the words say the camera is, which is no way up: `camera around 60 cm off the floor, wander
/// a bit`.
pub(crate) fn begin_at_height(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement != Move::Static) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        if asks_for(step, Motion::Rise) && words.iter().any(|word| RISES.contains(word)) {
            continue;
        }
        let is_camera = |at: usize| {
            let before = words[..at].iter().rev().find(|word| !AT.contains(*word) && **word != "is");
            before.is_some_and(|word| CAMERAS.contains(word))
        };
        let is_over = |at: usize| words[at + 1..].iter().take(3).any(|word| GROUND.contains(word));
        let heights = words.iter().enumerate().filter_map(|(at, word)| Some((at, linked.quantity_at(word)?)));
        let mut held = heights.filter(|(at, q)| q.kind == QuantityKind::Units && is_camera(*at) && is_over(*at));
        let Some((_, height)) = held.next() else { continue };
        let is_height = |units: f64| (units - height.value).abs() < 1e-9;
        let is_way = matches!(step.amount, Some(Amount::Units(units)) if is_height(units));
        if is_way && asks_for(step, Motion::Rise) && step.with.is_empty() {
            let wanders = words.iter().any(|word| WANDERS.iter().any(|verb| is_form(word, verb)));
            step.movement = if wanders { Move::FlyThrough } else { Move::Static };
            (step.amount, step.end.height) = (None, Some(height.value));
        }
        if step.end.height.is_some_and(is_height) && step.start.height.is_none() && step.movement != Move::Static {
            step.start.height = Some(height.value);
        }
    }
}

/// A height that the words hold constant.
struct Held {
    /// Scene units, where they are stated.
    units: Option<f64>,
}

/// What the word `height` at word `at` says of one height of the camera; `None` where it is about something else.
fn held_height(linked: &Linked, words: &[&str], at: usize) -> Option<Held> {
    let units = |word: &&str| linked.quantity_at(word).filter(|q| q.kind == QuantityKind::Units).map(|q| q.value);
    let is_link = |word: &&&str| BETWEEN.contains(*word) || units(word).is_some();
    let named = usize::from(at > 0 && CAMERAS.contains(&words[at - 1]));
    let first = at - named;
    let num_before = words[..first].iter().rev().take(3).take_while(is_link).count();
    let num_behind = words[at + 1..].iter().take(4).take_while(is_link).count();
    let word = |at: Option<usize>| at.and_then(|at| words.get(at)).copied().unwrap_or_default();
    let (before, after) = (word((first - num_before).checked_sub(1)), at + 1 + num_behind);
    let behind = word(Some(after));
    let is_stated_behind = CONSTANT.contains(&behind) || never_changes(&words[at + 1..]);
    // `the same height` may be that of something else.
    let is_vague = matches!(before, "same" | "one" | "fixed") && named == 0 && !is_stated_behind;
    let goes_on = words[at + 1..].iter().take(4).any(|word| THROUGHOUT.contains(word));
    let belongs = word(first.checked_sub(1));
    let is_other = words[after.min(words.len())..].iter().take(3).any(|word| OTHERS.contains(word))
        || named == 0 && (OTHERS.contains(&belongs) || matches!(belongs, "'s" | "shoulder"));
    if !(CONSTANT.contains(&before) || is_stated_behind) || is_other || is_vague && !goes_on {
        return None;
    }
    let mut near = words[first - num_before..words.len().min(after + 3)].iter();
    Some(Held { units: near.find_map(units) })
}

/// Whether words begin so that something does not change: `must not change`.
fn never_changes(words: &[&str]) -> bool {
    let words: Vec<&str> = words.iter().take(4).copied().collect();
    words.windows(2).any(|pair| {
        matches!(pair[0], "not" | "never" | "'t" | "no") && matches!(pair[1], "change" | "changes" | "vary" | "varies")
    })
}
