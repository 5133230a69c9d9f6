//! Values at the start and at the end of a move: `vertical FOV 50° at 0:00 to 25° at 0:06`, `back away, 1.6 m -> 2.4 m`,
//! `elevation 25° .. 0°`.

use cinesplat_language::{Linked, Quantity, QuantityKind};
use cinesplat_operator::{Amount, Framing, Lens, Step};
use cinesplat_trajectory::Move;

use super::directions::is_form;
use crate::direction::Direction;

/// Words between the two values besides `to` and arrows.
const BETWEEN: [&str; 11] = ["at", "down", "up", "all", "the", "way", "vertical", "\u{B0}", "degrees", ":", "00"];
/// Words about lenses and about where a subject is seen from, and how far from the values they stand.
const LENSES: [&str; 5] = ["fov", "vfov", "hfov", "field", "lens"];
const ELEVATIONS: [&str; 2] = ["elevation", "elevated"];
const REACH: [usize; 2] = [5, 3];
/// Words between a field of view and its value.
const LENS_LINKS: [&str; 15] = [
    "fixed",
    "constant",
    "at",
    "of",
    "is",
    "=",
    ":",
    "vertical",
    "horizontal",
    "locked",
    "to",
    "set",
    "held",
    "stays",
    "kept",
];
/// Words beside two lengths that are heights.
const HEIGHTS: [&str; 6] = ["height", "high", "altitude", "floor", "ground", "above"];

/// Two values of one kind in a row.
struct Range {
    kind: QuantityKind,
    values: [f64; 2],
    /// Positions of their words.
    at: [usize; 2],
}

/// Writes ranges of the words into the starts and ends of the steps that they stand in.
pub(crate) fn take_ranges(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    for range in (0..words.len()).filter_map(|at| range_at(linked, &words, at)) {
        let near = &words[range.at[0].saturating_sub(REACH[0])..words.len().min(range.at[1] + 1 + REACH[1])];
        let says = |list: &[&str]| near.iter().any(|word| list.contains(word));
        let byte = linked.spans.get(range.at[0]).map_or(0, |span| span[0]);
        let Some(step) = step_at(steps, byte) else { continue };
        match range.kind {
            QuantityKind::Degrees if says(&LENSES) && !says(&ELEVATIONS) => {
                take_lenses(step, range.values.map(Lens::FovDeg), range.values);
            }
            QuantityKind::Millimeters => {
                take_lenses(step, range.values.map(Lens::FocalMm), range.values.map(|mm| -mm));
            }
            QuantityKind::Degrees if says(&ELEVATIONS) => take_elevations(step, range.values),
            QuantityKind::Units if !says(&HEIGHTS) => take_distances(step, range.values),
            _ => {}
        }
    }
}

/// Words of a picture that rests for a while before a zoom.
const HOLDS: [&str; 8] = ["hold", "rest", "stay", "wait", "pause", "linger", "static", "still"];

/// Begins a zoom to a focal length at the one that the picture before it states, where nobody asks for a rest: `24 mil, the vase
/// in the middle. Then zoom to an 85`.
pub(crate) fn zoom_between_lenses(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [picture, zoom] = &direction.program.steps[nth - 1..=nth] else { continue };
        let holds = linked.texts_in(picture.words.unwrap_or_default());
        let holds = holds.iter().any(|word| HOLDS.iter().any(|verb| is_form(word, verb)));
        let is_opening = picture.movement == Move::Static
            && picture.with.is_empty()
            && picture.start == Framing::default()
            && picture.duration_secs.is_none()
            && picture.end.lens.is_some()
            && !holds;
        let zooms = matches!(zoom.movement, Move::ZoomIn | Move::ZoomOut)
            && zoom.end.lens.is_some()
            && zoom.start == Framing::default()
            && zoom.end.subjects == picture.end.subjects
            && !zoom.cut;
        if is_opening && zooms {
            let one =
                Step { start: picture.end.clone(), cut: picture.cut, words: picture.joint_words(zoom), ..zoom.clone() };
            direction.join_steps(nth, one);
        }
    }
}

/// The step whose words hold a byte, or the only step.
fn step_at(steps: &mut [Step], byte: usize) -> Option<&mut Step> {
    let is_alone = steps.len() == 1;
    steps.iter_mut().find(|step| is_alone || step.words.is_some_and(|[from, to]| (from..to).contains(&byte)))
}

/// The range that begins at word `at`. The second angle may be 0, which is no quantity.
fn range_at(linked: &Linked, words: &[&str], at: usize) -> Option<Range> {
    let is_zero =
        |at: usize| words.get(at) == Some(&"0") && matches!(words.get(at + 1), Some(&("\u{B0}" | "degrees" | "deg")));
    let zero = Quantity { kind: QuantityKind::Degrees, value: 0.0 };
    let first = linked.quantity_at(words[at]).or_else(|| is_zero(at).then_some(zero))?;
    let is_time = |word: &str| linked.quantity_at(word).is_some_and(|other| other.kind == QuantityKind::Seconds);
    let links =
        |word: &&&str| matches!(**word, "to" | ">" | "." | "\u{2192}") || BETWEEN.contains(*word) || is_time(word);
    let num_between = words[at + 1..].iter().take(6).take_while(links).count();
    let between = &words[at + 1..at + 1 + num_between];
    let dots = between.iter().filter(|word| **word == ".").count();
    if dots == 1 || dots == 0 && !between.iter().any(|word| matches!(*word, "to" | ">" | "\u{2192}")) {
        return None;
    }
    let end = at + 1 + num_between;
    let second = words.get(end)?;
    let value = match linked.quantity_at(second) {
        Some(quantity) if quantity.kind == first.kind => quantity.value,
        _ if is_zero(end) && first.kind == QuantityKind::Degrees => 0.0,
        _ => return None,
    };
    Some(Range { kind: first.kind, values: [first.value, value], at: [at, end] })
}

/// Gives the first picture the field of view that the words state for the whole film: `vertical FOV fixed at 40°`. It is no
/// angle from which anything is seen.
pub(crate) fn take_field_of_view(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let degrees = |at: &usize| {
        words.get(*at).and_then(|word| linked.quantity_at(word)).filter(|q| q.kind == QuantityKind::Degrees)
    };
    let is_link = |at: &usize| words.get(*at).is_some_and(|word| LENS_LINKS.contains(word));
    let stated = (0..words.len()).filter(|at| LENSES[..3].contains(&words[*at]) || is_field_of_view(&words, *at));
    let mut values = stated.filter_map(|at| {
        let behind = at + 1 + (at + 1..words.len()).take_while(is_link).count();
        let begin = if is_field_of_view(&words, at) { at.saturating_sub(2) } else { at };
        let is_kind = begin > 0 && matches!(words[begin - 1], "vertical" | "horizontal");
        let before = begin.checked_sub(1 + usize::from(is_kind));
        degrees(&behind).or_else(|| before.as_ref().and_then(degrees)).map(|quantity| quantity.value)
    });
    let (Some(value), None) = (values.next(), values.next()) else { return };
    let has_lens = |step: &Step| step.start.lens.is_some() || step.end.lens.is_some();
    if steps.iter().any(has_lens) {
        return;
    }
    let is_value = |degrees: f64| (degrees - value).abs() < 1e-9;
    let is_once = linked.quantities.iter().filter(|quantity| is_value(quantity.value)).count() == 1;
    for step in steps.iter_mut().filter(|_| is_once) {
        for framing in [&mut step.start, &mut step.end] {
            framing.elevation_deg = framing.elevation_deg.filter(|degrees| !is_value(*degrees));
        }
        step.amount = step.amount.filter(|amount| !matches!(amount, Amount::Degrees(degrees) if is_value(*degrees)));
    }
    if let Some(step) = steps.first_mut() {
        let leads = matches!(
            step.movement,
            Move::Static
                | Move::PanLeft
                | Move::PanRight
                | Move::TiltUp
                | Move::TiltDown
                | Move::WhipPan
                | Move::Follow
        );
        if step.start.subjects.is_empty() && !leads {
            step.start.subjects.clone_from(&step.end.subjects);
        }
        let framing = if step.movement == Move::Static { &mut step.end } else { &mut step.start };
        framing.lens = Some(Lens::FovDeg(value));
    }
}

/// `field of view`, at its last word.
fn is_field_of_view(words: &[&str], at: usize) -> bool {
    at > 1 && words[at - 2..=at] == ["field", "of", "view"]
}

/// Lenses at both ends; `widths` grow with the field of view. What only holds its picture zooms.
fn take_lenses(step: &mut Step, [first, last]: [Lens; 2], widths: [f64; 2]) {
    let zoom = if widths[1] < widths[0] { Move::ZoomIn } else { Move::ZoomOut };
    if matches!(step.movement, Move::Static | Move::Follow | Move::ZoomIn | Move::ZoomOut) {
        (step.movement, step.either_way, step.amount) = (zoom, false, None);
        step.with.retain(|movement| !matches!(movement, Move::ZoomIn | Move::ZoomOut));
    } else if !matches!(step.movement, Move::DollyZoomIn | Move::DollyZoomOut) && !step.with.contains(&zoom) {
        return;
    }
    (step.start.lens, step.end.lens) = (Some(first), Some(last));
    if step.start.subjects.is_empty() {
        step.start.subjects.clone_from(&step.end.subjects);
    }
    // The first value is none of a turn or of a height in the frame.
    step.start.elevation_deg = None;
    step.end.elevation_deg = None;
}

fn take_elevations(step: &mut Step, [first, last]: [f64; 2]) {
    (step.start.elevation_deg, step.end.elevation_deg) = (Some(first), Some(last));
    if step.start.subjects.is_empty() {
        step.start.subjects.clone_from(&step.end.subjects);
    }
    if matches!(step.movement, Move::Static | Move::Follow) {
        step.movement = if last > first { Move::CraneUp } else { Move::CraneDown };
        step.either_way = false;
    }
}

/// Distances at both ends of a way toward the subject or away from it.
fn take_distances(step: &mut Step, [first, last]: [f64; 2]) {
    let fits = match step.movement {
        Move::PushIn | Move::DollyZoomIn => last < first,
        Move::PullOut | Move::DollyZoomOut => last > first,
        _ => false,
    };
    if !fits {
        return;
    }
    let is_value = |units: f64| [first, last].iter().any(|value| value.to_bits() == units.to_bits());
    for framing in [&mut step.start, &mut step.end] {
        framing.height = framing.height.filter(|height| !is_value(*height));
    }
    step.amount = step.amount.filter(|amount| !matches!(amount, Amount::Units(units) if is_value(*units)));
    (step.start.distance, step.end.distance) = (Some(first), Some(last));
    let missing = |framing: &Framing| framing.subjects.is_empty();
    if missing(&step.start) {
        step.start.subjects.clone_from(&step.end.subjects);
    } else if missing(&step.end) {
        step.end.subjects.clone_from(&step.start.subjects);
    }
}
