//! Which moves there are, whatever the network reads: a camera on a tripod does not shake, a person who only looks does
//! not walk, a spiral goes around.

use cinesplat_language::{LanguageError, Linked, Senses, is_listed};
use cinesplat_operator::{Amount, Framing, Motion, Pass, Program, Step};
use cinesplat_trajectory::Move;

use super::directions::is_form;
use super::senses::says;
use crate::direction::Direction;

/// Takes a shake away that the words do not say: `pan from the armchair to the television, tripod`. `senses` has one entry
/// per word.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of senses.
pub(crate) fn drop_unsaid_shake(linked: &Linked, senses: &[Senses], steps: &mut [Step]) -> Result<(), LanguageError> {
    let shake = Senses::named(&["shake"])?;
    for step in steps {
        if step.with.contains(&Move::Handheld) && !says(linked, senses, step, shake) {
            step.with.retain(|movement| *movement != Move::Handheld);
        }
    }
    Ok(())
}

/// Holds a camera still that the words put on a tripod and that only the thing's own trembling shakes: `locked tripod,
/// curtain breathing in the wind`.
pub(crate) fn hold_tripods(linked: &Linked, program: &mut Program) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let has = |list: &[&str]| words.iter().any(|word| list.contains(word));
    let stands = has(&["tripod", "locked", "sticks", "static"]) && program.forbidden.contains(&Motion::Shake);
    if !stands || has(&["handheld", "shaky", "shake", "wobble", "jitter"]) {
        return;
    }
    for step in program.steps.iter_mut().filter(|step| step.movement == Move::Handheld) {
        step.movement = Move::Static;
    }
}

/// What wanders while its owner stays.
const GAZES: [&str; 7] = ["gaze", "gazes", "glance", "glances", "eyes", "stare", "eye"];
/// Words before it that say whose it is.
const OWNERS: [&str; 12] = ["his", "her", "our", "my", "your", "their", "the", "its", "only", "a", "let", "just"];
/// How it goes.
const WANDERS: [&str; 34] = [
    "goes",
    "go",
    "travel",
    "travels",
    "run",
    "runs",
    "follow",
    "follows",
    "leave",
    "leaves",
    "shifting",
    "sweeping",
    "wander",
    "wanders",
    "wandering",
    "drift",
    "drifts",
    "drifting",
    "move",
    "moves",
    "moving",
    "slide",
    "slides",
    "glide",
    "glides",
    "shift",
    "shifts",
    "sweep",
    "sweeps",
    "roam",
    "roams",
    "stray",
    "strays",
    "jumps",
];

/// Whether a word is a way that no gaze goes.
fn is_travel(word: &str) -> bool {
    ["walk", "fly", "step", "run", "dolly", "push", "truck", "crane", "orbit", "circle"]
        .iter()
        .any(|verb| is_form(word, verb))
}

/// Turns a way from one thing to another that only a gaze goes into a turn on the spot: `his gaze wanders from the wall
/// over to the chair`.
pub(crate) fn turn_gazes(linked: &Linked, steps: &mut [Step]) {
    let (mut before, mut was_gaze) = (0, false);
    for step in steps {
        let [_, end] = step.words.unwrap_or_default();
        // The words between two steps belong to neither: `only his gaze wanders: ..`.
        let words = linked.texts_in([before, end]);
        before = before.max(end);
        let by_eye =
            words.windows(3).any(|three| matches!(three, ["with", "your" | "our" | "the" | "my", "eyes" | "gaze"]));
        let is_owned = |at: &usize| GAZES.contains(&words[*at]) && *at > 0 && OWNERS.contains(&words[at - 1]);
        let wanders = |at: usize| words[at + 1..].iter().take(2).any(|word| WANDERS.contains(word));
        // The gaze goes on in the same sentence.
        let is_gaze = (0..words.len()).filter(is_owned).any(wanders)
            || by_eye
            || was_gaze && !words.iter().any(|word| matches!(*word, "camera" | "we" | "you") || is_travel(word));
        let goes_on = was_gaze;
        was_gaze = is_gaze && !words.last().is_some_and(|word| matches!(*word, "." | ";"));
        let leads = (goes_on || !step.start.subjects.is_empty()) && step.start.subjects != step.end.subjects;
        match &step.via {
            None if is_gaze && leads && step.movement == Move::Follow => {
                (step.movement, step.either_way) = (Move::PanRight, true);
                step.end.angle = None;
            }
            // `From the chair across the cabinet ..`
            Some(via)
                if is_gaze
                    && matches!(step.movement, Move::Static | Move::Follow)
                    && via.how == Pass::Past
                    && !step.start.subjects.is_empty() =>
            {
                if step.end.subjects.is_empty() {
                    step.end.subjects.clone_from(&via.objects);
                }
                (step.movement, step.either_way, step.via) = (Move::PanRight, true, None);
            }
            _ => {}
        }
    }
}

/// Words by which a camera stands still.
const STILL: [&str; 9] =
    ["frozen", "still", "static", "motionless", "locked", "fixed", "immobile", "unmoving", "stationary"];

/// Words of a picture that is slanted, and words of a camera that rolls.
const SLANTS: [&str; 9] = ["dutch", "canted", "cant", "tilted", "slanted", "tipped", "crooked", "askew", "lopsided"];
const ROLLS: [&str; 11] =
    ["roll", "rolls", "rolling", "rotate", "rotates", "rotating", "spin", "spins", "turn", "twist", "clockwise"];

/// Holds a slanted picture that stands still: `dutch-angle close-up of the skull, camera frozen`. The slant is an effect.
pub(crate) fn hold_slants(linked: &Linked, steps: &mut [Step]) {
    let rolls = |movement: &Move| matches!(movement, Move::RollCw | Move::RollCcw);
    for step in steps.iter_mut().filter(|step| rolls(&step.movement)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let has = |list: &[&str]| words.iter().any(|word| list.contains(word));
        let is_open = matches!(step.amount, None | Some(Amount::Slight)) && step.with.iter().all(rolls);
        if is_open && has(&STILL) && has(&SLANTS) && !has(&ROLLS) {
            (step.movement, step.either_way, step.amount) = (Move::Static, false, None);
            step.with.clear();
        }
    }
}

/// Turns a camera up or down that the network holds still: `tilt from the bottom shelf up to the top one; the tripod doesn't
/// budge`, `stop, look up`.
pub(crate) fn turn_tripods(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Static && step.with.is_empty()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let looks = |at: usize| {
            // `Look up at the lamp` may be an angle.
            matches!(words[at], "look" | "looks" | "looking")
                && words.get(at + 1).is_some_and(|word| matches!(*word, "up" | "down"))
                && words.get(at + 2).is_none_or(|word| matches!(*word, "." | "," | ";" | "!"))
        };
        let is_verb = |at: &usize| matches!(words[*at], "tilt" | "tilts" | "tilting") || looks(*at);
        let Some(at) = (0..words.len()).find(is_verb) else { continue };
        let before = &words[at.saturating_sub(3)..at];
        let behind = || words[at + 1..].iter().take_while(|word| !matches!(**word, "." | ";"));
        let says = |list: &[&str]| behind().any(|word| list.contains(word));
        let (up, down) = (says(&["up", "upward", "upwards"]), says(&["down", "downward", "downwards"]));
        let is_banned = before.iter().any(|word| DENIALS.contains(word) || SLANTS.contains(word));
        if up != down && !is_banned && step.duration_secs.is_none() {
            step.movement = if up { Move::TiltUp } else { Move::TiltDown };
        }
    }
}

/// Flies where the words lead on a way that the network holds still: `a mouse running under the table to the sofa`.
pub(crate) fn travel_ways(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Static && step.with.is_empty()) {
        let leads = step.via.as_ref().is_some_and(|via| matches!(via.how, Pass::Under | Pass::Over | Pass::Between));
        let words = linked.texts_in(step.words.unwrap_or_default());
        let runs = |word: &&str| {
            is_travel(word)
                || ["crawl", "slip", "dart", "scurry", "creep", "zip", "race"].iter().any(|v| is_form(word, v))
        };
        if leads && !step.end.subjects.is_empty() && words.iter().any(runs) {
            step.movement = Move::FlyThrough;
        }
    }
}

/// Words that name nothing and may stand in for a thing.
const PRONOUNS: [&str; 12] =
    ["it", "them", "both", "that", "this", "those", "everything", "all", "one", "him", "her", "there"];

/// Holds what the move before arrives at where the words of a hold name nothing: `then just hold`.
pub(crate) fn hold_arrivals(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let (before, step) = (&steps[nth - 1], &steps[nth]);
        let words = linked.texts_in(step.words.unwrap_or_default());
        let names = words.iter().any(|word| linked.slot_at(word).is_some() || PRONOUNS.contains(word));
        let shown = Framing { subjects: step.end.subjects.clone(), ..Framing::default() };
        let is_plain = step.movement == Move::Static
            && step.start == Framing::default()
            && step.end == shown
            && step.via.is_none()
            && step.with.is_empty()
            && !step.cut;
        let arrives = before.movement != Move::Static
            && before.words != step.words
            && !before.end.subjects.is_empty()
            && before.end.subjects != step.end.subjects;
        if is_plain && arrives && !names && !words.is_empty() {
            steps[nth].end = Framing::default();
        }
    }
}

/// Words of a pull of focus.
const FOCUSES: [&str; 14] = [
    "focus",
    "focuses",
    "focusing",
    "focussing",
    "refocus",
    "rack",
    "racks",
    "racking",
    "blur",
    "blurred",
    "sharp",
    "sharpness",
    "pull",
    "focal",
];

/// Makes a way of a pull of focus that nobody asked for: `slow glide, sofa to plant`.
pub(crate) fn move_without_focus(linked: &Linked, steps: &mut [Step]) {
    let is_said = linked.tokens_text.split(' ').any(|word| FOCUSES.contains(&word));
    for step in steps.iter_mut().filter(|step| step.movement == Move::RackFocus && !is_said) {
        (step.movement, step.either_way) = (Move::Follow, false);
    }
}

/// Words that deny what follows.
const DENIALS: [&str; 5] = ["no", "not", "never", "'t", "without"];
/// Lines that go around while they rise or sink.
const SPIRALS: [&str; 15] = [
    "spiral",
    "spirals",
    "spiraling",
    "spiralling",
    "corkscrew",
    "corkscrews",
    "corkscrewing",
    "helix",
    "helical",
    "coil",
    "coils",
    "coiling",
    "circling",
    "encircling",
    "orbiting",
];

/// Makes a rise or a descent go around its subject where the words say so: `spirals down around it`.
pub(crate) fn circle_spirals(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| !step.end.subjects.is_empty()) {
        let lift = match step.movement {
            Move::CraneUp | Move::PedestalUp => Move::CraneUp,
            Move::CraneDown | Move::PedestalDown => Move::CraneDown,
            _ => continue,
        };
        let lifts = step.with.iter().all(|with| *with == step.movement || *with == lift);
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_said = |at: usize| {
            let before = &words[at.saturating_sub(3)..at];
            SPIRALS.contains(&words[at]) && !before.iter().any(|word| DENIALS.contains(word))
        };
        if lifts && (0..words.len()).any(is_said) {
            // A rise to a stated angle is a crane first, because an orbit keeps its angle.
            if step.end.angle.is_some() {
                (step.movement, step.with) = (lift, vec![Move::OrbitRight]);
            } else {
                (step.movement, step.either_way, step.with) = (Move::OrbitRight, true, vec![lift]);
            }
        }
    }
}

/// Words of what has to be in a picture, and before it.
const NEEDS: &str = "need needs want wants must should make with including keep";
const IN_PICTURE: [&[&str]; 6] = [
    &["in", "frame"],
    &["in", "shot"],
    &["in", "the", "frame"],
    &["in", "the", "shot"],
    &["in", "the", "picture"],
    &["in", "view"],
];

/// Shows in one picture at rest what the words behind it say has to be in it: `overhead shot of the desk, don't move. I need the laptop
/// and the lamp in frame`.
pub(crate) fn show_needed(linked: &Linked, direction: &mut Direction) {
    direction.join_pairs(|first, second| {
        let words = linked.texts_in(second.words?);
        let needs = words.iter().take(4).any(|word| is_listed(NEEDS, word))
            && words.iter().take(4).all(|word| *word != "then")
            && IN_PICTURE.iter().any(|phrase| words.windows(phrase.len()).any(|said| said == *phrase));
        let plain = Step {
            words: second.words,
            end: Framing { subjects: second.end.subjects.clone(), whole: second.end.whole, ..Framing::default() },
            ..Step::of(Move::Static)
        };
        let rest = first.movement == Move::Static && first.duration_secs.is_none() && first.end.size.is_none();
        let is_one = rest && needs && *second == plain && !second.end.subjects.is_empty();
        is_one.then(|| Step {
            end: Framing { subjects: second.end.subjects.clone(), whole: true, ..first.end.clone() },
            words: first.joint_words(second),
            ..first.clone()
        })
    });
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked, seen};
    use super::*;

    #[test]
    fn what_a_picture_at_rest_needs_is_in_it() {
        let read = |text: &str| {
            let at = text.find('.').unwrap() + 2;
            let mut needed = about(Move::Static, &[7, 9], [at, text.len()]);
            needed.end.whole = true;
            let mut direction = direction(vec![about(Move::Static, &[5], [0, at - 1]), needed]);
            show_needed(&linked(text), &mut direction);
            seen(&direction.program.steps)
        };
        let one = vec![(Move::Static, vec![7, 9])];
        assert_eq!(read("overhead shot of <obj-0> . i need <obj-1> and the lamp in frame"), one);
        assert_eq!(read("overhead shot of <obj-0> . then show <obj-1> in frame").len(), 2);
    }
}
