//! Steps that say the step before once more: `crane up, look down on the boat, done, 6 s`.
//!
//! The network sometimes takes the details of a move (its length, its extent, its subject) for a second move of the same
//! kind. Such a step is one with the step before, unless the words repeat the move.

use cinesplat_language::{LanguageError, Linked, Senses, add_ids, is_listed};
use cinesplat_operator::{Amount, Framing, Look, Pass, Speed, Step};
use cinesplat_trajectory::Move;

use super::briefs::is_camera_verb;
use super::open::as_orbit;
use super::senses::says;
use crate::direction::Direction;

/// Senses of words that make a second move of it: `again`, `back`, `the other way`, `twice`, `then`.
const REPEATS: [&str; 5] = ["again", "back", "other", "double", "then"];

/// Makes one step of two in a row of which the second only adds a detail to the first. `senses` has one entry per word.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of senses.
pub(crate) fn merge_repeated(
    linked: &Linked,
    senses: &[Senses],
    direction: &mut Direction,
) -> Result<(), LanguageError> {
    let repeats = Senses::named(&REPEATS)?;
    direction
        .join_pairs(|first, second| merged(linked, first, second).filter(|_| !says(linked, senses, second, repeats)));
    Ok(())
}

/// The first of two steps with the details that only the second one states: its length, a stated angle, its speed profile.
/// `None` where the second states anything else, no detail, or an extent of its own.
fn merged(linked: &Linked, first: &Step, second: &Step) -> Option<Step> {
    if arrives_again(linked, first, second) {
        return Some(Step { words: first.joint_words(second), ..first.clone() });
    }
    if first.movement == Move::Static || second.cut || second.returns || !is_same_move(first, second) {
        return None;
    }
    let is_once =
        |secs: f64| linked.quantities.iter().filter(|other| other.value.to_bits() == secs.to_bits()).count() < 2;
    let length = match (first.duration_secs, second.duration_secs) {
        (Some(a), Some(b)) if a.to_bits() != b.to_bits() || !is_once(a) => return None,
        (a, b) => a.or(b),
    };
    let amount = match (first.amount, second.amount) {
        (None, Some(Amount::Degrees(degrees))) => Some(Amount::Degrees(degrees)),
        (Some(Amount::Degrees(a)), Some(Amount::Degrees(b))) if a.to_bits() == b.to_bits() && is_once(a) => {
            first.amount
        }
        (amount, None) => amount,
        _ => return None,
    };
    if second.duration_secs.is_none() && second.amount.is_none() && second.easing.is_none() {
        return None;
    }
    let stated = if first.either_way { second } else { first };
    let one = Step {
        movement: stated.movement,
        either_way: stated.either_way,
        duration_secs: length,
        amount,
        easing: first.easing.or(second.easing),
        words: first.joint_words(second),
        ..first.clone()
    };
    (with_all_of(&one, second) == one).then_some(one)
}

/// Words by which a circle is another one.
const AGAIN: &str = "again another second twice more then next after reverse back opposite";
/// Verbs of circles, and words that lead around a thing.
const CIRCLES: &str = "circle orbit orbits circling orbiting go goes going walk around round about arc arcing move";

/// Joins a circle with the words that only say again how far it goes: `circle the table once, full 360, always looking at the
/// vase`. What they look at is no other center.
pub(crate) fn join_told_circles(linked: &Linked, direction: &mut Direction) {
    let mut nth = 1;
    while nth < direction.program.steps.len() {
        let [first, second] = &direction.program.steps[nth - 1..=nth] else { break };
        let words = linked.texts_in(second.words.unwrap_or_default());
        let is_told = !words.iter().any(|word| is_listed(AGAIN, word) || is_listed(CIRCLES, word));
        let is_same = first.movement.is_circular()
            && first.movement == second.movement
            && first.amount.is_some()
            && first.amount == second.amount
            && second.words.is_some()
            && second.words != first.words
            && !second.cut
            && !second.returns;
        if !is_told || !is_same {
            nth += 1;
            continue;
        }
        let others = (!second.end.subjects.is_empty() && second.end.subjects != first.end.subjects)
            .then(|| Look::At(second.end.subjects.clone()));
        let own = Framing { subjects: first.end.subjects.clone(), ..second.end.clone() };
        let one = Step {
            end: framing_of(&first.end, &own),
            look: second.look.clone().or(others).or_else(|| first.look.clone()),
            easing: first.easing.or(second.easing),
            duration_secs: first.duration_secs.or(second.duration_secs),
            words: first.joint_words(second),
            ..first.clone()
        };
        direction.join_steps(nth, one);
    }
}

/// Verbs of a first picture.
const OPENS: &str = "start starts starting begin begins beginning open opens opening";

/// Makes one step of a move and of the picture before it from which it starts, which the network reads as the same move twice: `start:
/// floor level in front of the palm / move: jib up to eye height`.
pub(crate) fn join_opening(linked: &Linked, direction: &mut Direction) {
    let [first, second, ..] = &direction.program.steps[..] else { return };
    let words = linked.texts_in(first.words.unwrap_or_default());
    let opens = words.iter().any(|word| is_listed(OPENS, word));
    let moves = (0..words.len()).any(|at| !is_listed(OPENS, words[at]) && is_camera_verb(&words, at));
    let is_picture =
        first.end == Framing { subjects: first.end.subjects.clone(), lens: first.end.lens, ..Framing::default() };
    let same = first.movement == second.movement
        && first.movement != Move::Static
        && first.with == second.with
        && first.end.subjects == second.end.subjects;
    let goes_on =
        !second.cut && second.start == Framing::default() && first.amount.is_none() && first.duration_secs.is_none();
    // `Keyframe 1: wide on the vase. Keyframe 2: close on the vase`.
    let later = linked.texts_in(second.words.unwrap_or_default());
    let sizes = first.start.size.zip(second.end.size).is_some_and(|(from, to)| from != to);
    let is_list = sizes && !(0..later.len()).any(|at| later[at] != "frame" && is_camera_verb(&later, at));
    if (opens && !moves || is_list) && is_picture && same && goes_on && first.start != Framing::default() {
        let lens = second.end.lens.or(first.end.lens);
        let one = Step {
            start: first.start.clone(),
            end: Framing { lens, ..second.end.clone() },
            words: first.joint_words(second),
            ..second.clone()
        };
        direction.join_steps(1, one);
    }
}

/// Removes a bare move that the next step says again with all that belongs to it (`pan right. Pan right, from the guitar to the
/// palm`), and a step that only says again, in the same words, what the one before passes.
pub(crate) fn drop_restated(direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [first, second] = [&direction.program.steps[nth - 1], &direction.program.steps[nth]];
        let same = first.movement == second.movement && !second.cut && !second.returns;
        let bare =
            |step: &Step| Step { words: step.words, either_way: step.either_way, ..Step::of(step.movement) } == *step;
        let travels = matches!(first.movement, Move::Static | Move::Follow);
        let leads = !second.start.subjects.is_empty() && !second.end.subjects.is_empty();
        let passes = Step { via: second.via.clone(), ..first.clone() };
        let is_echo = first.words == second.words
            && second.via.is_some()
            && (first.via.is_none() || first.via == second.via)
            && bare(&Step { via: None, ..second.clone() });
        let vertigo =
            matches!(first.movement, Move::DollyZoomIn | Move::DollyZoomOut) && !second.end.subjects.is_empty();
        let holds = first.words.is_some()
            && first.words == second.words
            && first.movement == Move::Static
            && first.end.subjects == second.end.subjects
            && first.duration_secs == second.duration_secs
            && first.with == second.with;
        // What the picture of a dolly zoom looks like is said of the same one.
        let is_told_again =
            vertigo && (first.either_way || second.either_way) && first.end.subjects == second.end.subjects;
        // `.. from the skull to the lamp; rotate to the right` only says which way.
        let is_family = same || first.movement.opposite() == Some(second.movement);
        let is_turn = matches!(
            first.movement,
            Move::PanLeft | Move::PanRight | Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight
        );
        let says_way =
            is_turn && is_family && first.either_way && !second.either_way && bare(second) && !second.returns;
        if says_way && !(first.start.subjects.is_empty() && first.end.subjects.is_empty()) {
            let one = Step {
                movement: second.movement,
                either_way: false,
                words: first.joint_words(second),
                ..first.clone()
            };
            direction.join_steps(nth, one);
        } else if is_family && is_told_again && !second.cut && !second.returns {
            let stated = if first.either_way { second } else { first };
            let (movement, either_way) = (stated.movement, stated.either_way);
            let one = Step { movement, either_way, words: first.joint_words(second), ..first.clone() };
            direction.join_steps(nth, one);
        } else if same && holds {
            let end = framing_of(&second.end, &first.end);
            direction.join_steps(nth, Step { end, ..first.clone() });
        } else if same && is_echo {
            direction.join_steps(nth, passes);
        } else if same && !travels && bare(first) && (leads || vertigo) {
            let words = first.joint_words(second);
            let one = Step { words, ..second.clone() };
            direction.join_steps(nth, one);
        }
    }
}

/// Words between things that are passed one after the other.
const NEXT: [&str; 18] = [
    "then", "the", "and", ",", "past", "next", "after", "that", "finally", ".", "lastly", ";", "on", "by", "a", "to",
    "in", "turn",
];

/// Makes one way of steps that only name what is passed next: `track past the knives, then the plates, then the ladles`
/// leads from the first of them to the last, and so does `track past the knives, the plates and the ladles in turn`.
pub(crate) fn pass_one_after_another(linked: &Linked, direction: &mut Direction) {
    let (mut nth, mut is_chain) = (1, false);
    while nth <= direction.program.steps.len() {
        let steps = &mut direction.program.steps;
        let one = steps.get(nth).and_then(|second| passing_both(linked, &steps[nth - 1], second));
        if let Some(one) = one {
            direction.join_steps(nth, one);
            is_chain = true;
            continue;
        }
        if std::mem::take(&mut is_chain) {
            lead_along(&mut steps[nth - 1]);
        }
        nth += 1;
    }
}

/// Begins a way at the first thing that it passes and ends it at the last one.
fn lead_along(step: &mut Step) {
    let Some(mut via) = step.via.take() else { return };
    if let Some(last) = via.objects.pop() {
        step.end.subjects = vec![last];
    }
    if step.start.subjects.is_empty() && !via.objects.is_empty() {
        step.start.subjects = vec![via.objects.remove(0)];
    }
    step.via = Some(via).filter(|via| !via.objects.is_empty());
}

/// One way past what two steps pass, where the second one's words only name it.
fn passing_both(linked: &Linked, first: &Step, second: &Step) -> Option<Step> {
    let shown = Framing { subjects: second.end.subjects.clone(), ..Framing::default() };
    let is_plain = second.start == Framing::default()
        && second.end == shown
        && first.end == Framing::default()
        && second.amount.is_none()
        && second.duration_secs.is_none()
        && !second.cut
        && !second.returns;
    let words = linked.texts_in(second.words?);
    let only_names = words.iter().all(|word| NEXT.contains(word) || linked.slot_at(word).is_some());
    // A list goes on; `to` and `on` lead to its end.
    let lists = second.movement == Move::Follow
        && matches!(first.movement, Move::TruckLeft | Move::TruckRight)
        && !words.iter().any(|word| matches!(*word, "to" | "on" | "then"))
        && says_past(linked, first);
    let goes_on = lists || is_same_move(first, second);
    if !is_plain || !only_names || !goes_on || first.words == second.words {
        return None;
    }
    let mut via = first.via.clone().filter(|via| matches!(via.how, Pass::Past | Pass::Along))?;
    let next = second.via.as_ref().map_or(&second.end.subjects, |next| &next.objects);
    via.how = Pass::Past;
    add_ids(&mut via.objects, next);
    Some(Step { via: Some(via), words: first.joint_words(second), ..first.clone() })
}

/// Whether a step's words pass what it goes along.
fn says_past(linked: &Linked, step: &Step) -> bool {
    linked.texts_in(step.words.unwrap_or_default()).iter().any(|word| matches!(*word, "past" | "by" | "passing"))
}

/// Whether the second step turns to what the first one has just turned to, and says nothing else: `look at the lamp, then
/// the vase, then ..`.
fn arrives_again(linked: &Linked, first: &Step, second: &Step) -> bool {
    let plain = Step {
        end: second.end.clone(),
        words: second.words,
        either_way: second.either_way,
        ..Step::of(second.movement)
    };
    let names_once = |id: &u32| {
        let words = linked.texts_in([0, usize::MAX]);
        words.iter().filter(|word| linked.names(word, *id)).count() < 2
    };
    matches!(second.movement, Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown)
        && *second == plain
        && is_same_move(first, second)
        && !first.start.subjects.is_empty()
        && first.end == second.end
        && !second.end.subjects.is_empty()
        && second.end.subjects.iter().all(names_once)
}

/// Whether both steps make one move in one direction, which one of them may leave open; a circle and an arc are one.
fn is_same_move(first: &Step, second: &Step) -> bool {
    let (a, b) = (as_orbit(first.movement), as_orbit(second.movement));
    a == b || first.either_way && a.opposite() == Some(b)
}

/// The first step with everything that the second one states in place of its own.
fn with_all_of(first: &Step, second: &Step) -> Step {
    let or = |own: &Vec<u32>, other: &Vec<u32>| if other.is_empty() { own.clone() } else { other.clone() };
    Step {
        with: if second.with.is_empty() { first.with.clone() } else { second.with.clone() },
        start: framing_of(&first.start, &second.start),
        end: framing_of(&first.end, &second.end),
        via: second.via.clone().or_else(|| first.via.clone()),
        look: second.look.clone().or_else(|| first.look.clone()),
        keep: or(&first.keep, &second.keep),
        avoid: or(&first.avoid, &second.avoid),
        amount: second.amount.or(first.amount),
        speed: if second.speed == Speed::Normal { first.speed } else { second.speed },
        easing: second.easing.or(first.easing),
        ..first.clone()
    }
}

/// A framing with everything that another one states in place of its own.
fn framing_of(own: &Framing, other: &Framing) -> Framing {
    let part = if other.part == Framing::default().part { own.part } else { other.part };
    Framing {
        subjects: if other.subjects.is_empty() { own.subjects.clone() } else { other.subjects.clone() },
        size: other.size.or(own.size),
        angle: other.angle.or(own.angle),
        part,
        whole: own.whole || other.whole,
        height_frac: other.height_frac.or(own.height_frac),
        elevation_deg: other.elevation_deg.or(own.elevation_deg),
        height: other.height.or(own.height),
        distance: other.distance.or(own.distance),
        lens: other.lens.or(own.lens),
        side: other.side.or(own.side),
        place: other.place.or(own.place),
        hidden: own.hidden || other.hidden,
        backdrop: if other.backdrop.is_empty() { own.backdrop.clone() } else { other.backdrop.clone() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(end: u32, change: impl FnOnce(&mut Step)) -> Step {
        let mut step = Step::of(Move::OrbitRight);
        step.end.subjects = vec![end];
        change(&mut step);
        step
    }

    fn read(first: &Step, second: &Step) -> Option<Step> {
        merged(&Linked::default(), first, second)
    }

    #[test]
    fn the_picture_that_a_move_starts_from_is_no_second_one() {
        use super::super::fixture::{about, direction, linked};
        let text = "start : low in front of <obj-0> / move : jib up to eye height";
        let at = text.find(" /").unwrap();
        let start =
            Framing { angle: Some(cinesplat_trajectory::ShotAngle::Worm), ..about(Move::Static, &[5], [0, 1]).end };
        let first = Step { start: start.clone(), ..about(Move::CraneUp, &[5], [0, at]) };
        let mut direction = direction(vec![first, about(Move::CraneUp, &[5], [at + 3, text.len()])]);
        join_opening(&linked(text), &mut direction);
        assert_eq!(direction.program.steps.len(), 1);
        assert_eq!(direction.program.steps[0].start, start);
    }

    #[test]
    fn details_of_a_move_are_no_second_move() {
        let high = step(1, |step| step.end.angle = Some(cinesplat_trajectory::ShotAngle::High));
        let timed = step(1, |step| {
            step.movement = Move::ArcRight;
            step.duration_secs = Some(6.0);
        });
        let one = read(&high, &timed).unwrap();
        assert_eq!((one.end, one.duration_secs), (high.end.clone(), Some(6.0)));
        // Another height, thing, speed or way; a move without details; an extent of its own.
        assert_eq!(read(&timed, &high), None);
        for change in [
            (|step| step.end.subjects = vec![2]) as fn(&mut Step),
            |step| step.speed = Speed::Fast,
            |step| step.movement = Move::OrbitLeft,
            |step| step.duration_secs = None,
            |step| step.amount = Some(Amount::Slight),
        ] {
            let mut other = timed.clone();
            change(&mut other);
            assert_eq!(read(&high, &other), None, "{other:?}");
        }
    }

    #[test]
    fn a_stated_way_is_kept() {
        let open = step(1, |step| step.either_way = true);
        let left = step(1, |step| {
            step.movement = Move::OrbitLeft;
            step.duration_secs = Some(4.0);
        });
        let one = read(&open, &left).unwrap();
        assert_eq!((one.movement, one.either_way), (Move::OrbitLeft, false));
        assert_eq!(read(&left, &open), None);
    }
}
