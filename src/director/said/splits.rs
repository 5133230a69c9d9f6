//! Steps whose words say two moves: `hold on the profile, orbit round till it faces us`, `swing round it, and back off until all
//! of it is in`, `move forward, swing left to face the sofa`.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_operator::{Amount, Framing, Step, SubjectPart, SubjectSide};
use cinesplat_trajectory::Move;

use super::directions::is_form;
use crate::direction::Direction;
use crate::keys::MAX_KEYS;

/// Marks and words before a move of its own.
const JOINTS: [&str; 6] = [",", ";", ".", "then", "and", "before"];
/// Verbs of a way round, and those that lead round only with a word for it.
const CIRCLES: [&str; 3] = ["orbit", "circle", "arc"];
const WALKS: [&str; 9] = ["swing", "go", "come", "move", "walk", "travel", "drift", "glide", "track"];
const ROUND: [&str; 2] = ["round", "around"];
/// Verbs of a way back, before `back`, `off` and `away`.
const LEAVES: [&str; 8] = ["pull", "draw", "ease", "step", "move", "drift", "glide", "dolly"];
const AWAY: [&str; 4] = ["back", "off", "away", "out"];
/// Verbs of a way ahead, and its words.
const GOES: [&str; 9] = ["move", "go", "walk", "come", "push", "glide", "travel", "step", "drive"];
const AHEAD: [&str; 6] = ["forward", "forwards", "ahead", "in", "straight", "into"];
/// Verbs of a turn on the spot, before its side.
const TURNS: [&str; 6] = ["swing", "turn", "pan", "rotate", "pivot", "spin"];
/// Verbs of a way in, before `in`.
const NEARS: [&str; 9] = ["move", "push", "go", "come", "zoom", "dolly", "close", "creep", "drift"];
const WHOLES: [&str; 5] = ["whole", "entire", "full", "all", "complete"];
const SIDES: [(&str, Move, Move); 2] =
    [("left", Move::PanLeft, Move::OrbitLeft), ("right", Move::PanRight, Move::OrbitRight)];

/// Makes two steps of one whose words say a second move that the network has left out.
pub(crate) fn split_moves(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        if direction.program.steps.len() >= MAX_KEYS {
            return;
        }
        let steps = &direction.program.steps;
        let own = |byte: usize| {
            let others = steps.iter().enumerate().filter(|(other, _)| *other != nth);
            !others.filter_map(|(_, step)| step.words).any(|[from, to]| (from..to).contains(&byte))
        };
        let step = &steps[nth];
        let Some((first, second)) = circled(linked, step)
            .or_else(|| backed_off(linked, step))
            .or_else(|| advanced(linked, step))
            .or_else(|| neared(linked, step))
            .or_else(|| rounded(linked, step))
            .or_else(|| walked_round(linked, step))
            .filter(|(_, second)| second.words.is_some_and(|[from, _]| own(from)))
        else {
            continue;
        };
        // The step before tells the first of the two already.
        let is_told = |before: &Step| {
            let [told, from] = [before.words.unwrap_or_default(), first.words.unwrap_or_default()];
            before.movement == first.movement && before.end == first.end && told[0] == from[0] && told[1] <= from[1]
        };
        if let Some(before) = nth.checked_sub(1).and_then(|before| steps.get(before)).filter(|before| is_told(before)) {
            let words = before.words.zip(second.words).map(|(before, own)| [before[1], own[1]]);
            direction.program.steps[nth] = Step { words, ..second };
            continue;
        }
        let certainty = direction.certainty.get(nth).cloned();
        direction.program.steps.splice(nth..=nth, [first, second]);
        if let Some(certainty) = certainty {
            direction.certainty.insert(nth, certainty);
        }
        // The network's cameras are those of both moves together.
        if let Some(cameras) = direction.step_cameras.get(nth).copied() {
            direction.step_cameras.insert(nth, cameras);
        }
    }
}

/// The words of a step and where they stand; none of a step without words.
fn words_of<'a>(linked: &'a Linked, step: &Step) -> Vec<(&'a str, [usize; 2])> {
    linked.words_in(step.words.unwrap_or_default()).collect()
}

/// Whether a move begins at word `at`: it stands behind a mark or a word that joins moves.
fn begins(words: &[(&str, [usize; 2])], at: usize) -> bool {
    at > 0 && words[..at].iter().rev().take(2).any(|(word, _)| JOINTS.contains(word))
}

/// The two parts of a step's words, before and from word `at` on.
fn parted(step: &Step, words: &[(&str, [usize; 2])], at: usize) -> Option<[[usize; 2]; 2]> {
    let [from, to] = step.words?;
    let at = words.get(at)?.1[0];
    (from < at && at < to).then_some([[from, at], [at, to]])
}

/// A rest, and the way round that its words say behind it.
fn circled(linked: &Linked, step: &Step) -> Option<(Step, Step)> {
    if step.movement != Move::Static || !step.with.is_empty() || step.end.subjects.is_empty() {
        return None;
    }
    let words = words_of(linked, step);
    let text = |at: usize| words.get(at).map_or("", |(word, _)| *word);
    let is_walk = |at: usize| WALKS.iter().any(|verb| is_form(text(at), verb)) && ROUND.contains(&text(at + 1));
    let is_circle = |at: &usize| CIRCLES.iter().any(|verb| is_form(text(*at), verb)) || is_walk(*at);
    let at = (0..words.len()).find(|at| is_circle(at) && begins(&words, *at))?;
    let [first, second] = parted(step, &words, at)?;
    let behind = words[at..].iter().map(|(word, _)| *word);
    let way = behind.clone().find_map(|word| SIDES.iter().find(|(side, _, _)| *side == word));
    let degrees = behind.filter_map(|word| linked.quantity_at(word)).find(|q| q.kind == QuantityKind::Degrees);
    let round = Step {
        either_way: way.is_none(),
        end: Framing { subjects: step.end.subjects.clone(), ..Framing::default() },
        amount: degrees.map(|degrees| Amount::Degrees(degrees.value)),
        speed: step.speed,
        words: Some(second),
        ..Step::of(way.map_or(Move::OrbitRight, |(_, _, orbit)| *orbit))
    };
    let mut rest = Step { start: Framing::default(), words: Some(first), ..step.clone() };
    // What the way round ends on is not what it begins with.
    let is_profile = words[..at].iter().any(|(word, _)| *word == "profile");
    rest.end.side = step.start.side.or(if is_profile { Some(SubjectSide::FromSide) } else { rest.end.side });
    Some((rest, round))
}

/// A move, and the way back that its words say behind it.
fn backed_off(linked: &Linked, step: &Step) -> Option<(Step, Step)> {
    let moves = std::iter::once(&step.movement).chain(&step.with);
    let leaves = |movement: &Move| {
        matches!(
            movement,
            Move::PullOut | Move::ZoomOut | Move::DollyZoomIn | Move::DollyZoomOut | Move::CraneUp | Move::Reveal
        )
    };
    if moves.into_iter().any(leaves) || step.returns {
        return None;
    }
    let words = words_of(linked, step);
    let text = |at: usize| words.get(at).map_or("", |(word, _)| *word);
    let is_way_back = |at: &usize| {
        let verb = LEAVES.iter().any(|verb| is_form(text(*at), verb)) && AWAY[..3].contains(&text(at + 1));
        verb || is_form(text(*at), "back") && AWAY[1..].contains(&text(at + 1))
    };
    let at = (0..words.len()).find(|at| is_way_back(at) && begins(&words, *at))?;
    let [first, second] = parted(step, &words, at)?;
    let named = words[at..].iter().find_map(|(word, _)| linked.slot_at(word));
    let subjects = named.map_or_else(|| step.end.subjects.clone(), |id| linked.expanded(&[id]));
    let is_whole = words[at..].iter().any(|(word, span)| WHOLES.contains(word) || linked.wholes.contains(span));
    let back = Step {
        end: Framing { subjects, whole: is_whole, ..Framing::default() },
        speed: step.speed,
        words: Some(second),
        ..Step::of(Move::PullOut)
    };
    let mut stays = Step { words: Some(first), ..step.clone() };
    stays.end.whole &= !is_whole;
    stays.end.part = SubjectPart::default();
    // What only the way back shows.
    if stays.end.subjects.len() > back.end.subjects.len() {
        stays.end.subjects.retain(|id| !back.end.subjects.contains(id));
    }
    (!back.end.subjects.is_empty()).then_some((stays, back))
}

/// A way ahead, and the turn to its subject that its words say behind it.
fn advanced(linked: &Linked, step: &Step) -> Option<(Step, Step)> {
    let goes = matches!(
        step.movement,
        Move::PushIn | Move::Follow | Move::FlyThrough | Move::PanLeft | Move::PanRight | Move::Static
    );
    if !goes || !step.start.subjects.is_empty() || step.end.subjects.is_empty() {
        return None;
    }
    let words = words_of(linked, step);
    let text = |at: usize| words.get(at).map_or("", |(word, _)| *word);
    let is_turn = |at: &usize| TURNS.iter().any(|verb| is_form(text(*at), verb));
    let at = (0..words.len()).find(|at| is_turn(at) && begins(&words, *at))?;
    let (_, pan, _) = SIDES.iter().find(|(side, _, _)| *side == text(at + 1))?;
    let names_end = |at: usize| step.end.subjects.iter().any(|id| linked.names(text(at), *id));
    let is_ahead = |at: usize| GOES.iter().any(|verb| is_form(text(at), verb)) && AHEAD.contains(&text(at + 1));
    let leads = (0..at).any(is_ahead) && (0..at).all(|at| linked.slot_at(text(at)).is_none());
    let [first, second] = parted(step, &words, at).filter(|_| leads && (at..words.len()).any(names_end))?;
    let ahead = Step { speed: step.speed, words: Some(first), ..Step::of(Move::PushIn) };
    let turn = Step { movement: *pan, either_way: false, via: None, words: Some(second), ..step.clone() };
    Some((ahead, turn))
}

/// A turn on the spot, and the way in that its words say behind it: `whip over to the guitar and move in on it`.
fn neared(linked: &Linked, step: &Step) -> Option<(Step, Step)> {
    let turns = step.movement == Move::WhipPan || step.movement.looks_elsewhere();
    if !turns || !step.with.is_empty() || step.end.subjects.is_empty() {
        return None;
    }
    let words = words_of(linked, step);
    let text = |at: usize| words.get(at).map_or("", |(word, _)| *word);
    let nears = |at: &usize| {
        NEARS.iter().any(|verb| is_form(text(*at), verb))
            && (text(at + 1) == "in" || matches!(text(at + 1), "closer" | "nearer"))
            && matches!(text(at + 2), "on" | "to" | "toward" | "towards" | "" | "," | "." | "slowly")
    };
    // `.. the door, creeping towards it`.
    let creeps = |at: &usize| {
        let is_verb = NEARS.iter().chain(&["walk"]).any(|verb| is_form(text(*at), verb));
        is_verb && matches!(text(at + 1), "toward" | "towards") && matches!(text(at + 2), "it" | "them")
    };
    let at = (0..words.len()).find(|at| (nears(at) || creeps(at)) && begins(&words, *at))?;
    let [first, second] = parted(step, &words, at)?;
    let named = words[at..].iter().find_map(|(word, _)| linked.slot_at(word)).map(|id| linked.expanded(&[id]));
    if named.is_some_and(|ids| ids != step.end.subjects) {
        return None;
    }
    let end = Framing { part: SubjectPart::default(), ..step.end.clone() };
    let way = Step { end, words: Some(second), ..Step::of(Move::PushIn) };
    let shown = Framing { subjects: step.end.subjects.clone(), part: step.end.part, ..Framing::default() };
    Some((Step { end: shown, words: Some(first), ..step.clone() }, way))
}

/// A way to a thing, and the way round it that its words say behind it, whose angle they state: `go on to the knot, and finish
/// with a quarter arc around it`.
fn rounded(linked: &Linked, step: &Step) -> Option<(Step, Step)> {
    let degrees = matches!(step.amount, Some(Amount::Degrees(_)));
    let goes = matches!(step.movement, Move::PushIn | Move::Follow) && step.with.is_empty();
    if !degrees || !goes || step.end.subjects.is_empty() {
        return None;
    }
    let words = words_of(linked, step);
    let is_circle = |at: &usize| CIRCLES.iter().any(|verb| is_form(words[*at].0, verb));
    let circle = (0..words.len()).find(is_circle)?;
    let joint = (1..circle).rev().find(|at| JOINTS.contains(&words[*at].0))?;
    let [first, second] = parted(step, &words, joint)?;
    let behind = words[joint..].iter().map(|(word, _)| *word);
    let way = behind.clone().find_map(|word| SIDES.iter().find(|(side, _, _)| *side == word));
    let round = Step {
        either_way: way.is_none(),
        end: step.end.clone(),
        amount: step.amount,
        speed: step.speed,
        words: Some(second),
        ..Step::of(way.map_or(Move::ArcRight, |(_, _, orbit)| *orbit))
    };
    Some((Step { amount: None, words: Some(first), ..step.clone() }, round))
}

/// Words between a verb of a walk and `around`, and how far round each of them leads, degrees.
const FAR: [(&str, f64); 8] = [
    ("half", 180.0),
    ("halfway", 180.0),
    ("quarter", 90.0),
    ("once", 360.0),
    ("twice", 720.0),
    ("fully", 360.0),
    ("full", 360.0),
    ("complete", 360.0),
];
const ON_THE_WAY: &str =
    "half halfway way quarter once right all the slowly gently fully full complete a an turn lap of";

/// How far round the first of some words lead.
fn far_behind(words: &[&str]) -> Option<f64> {
    FAR.iter().find(|(far, _)| words.iter().take(6).any(|word| word == far)).map(|(_, far)| *far)
}

/// Whether a verb at `at` leads round something: `walk half around it`. `go round the corner to the door` is no circle. `is_own`
/// tells the subject.
fn leads_round(words: &[&str], at: usize, is_own: &dyn Fn(&str) -> bool) -> bool {
    let text = |at: usize| words.get(at).copied().unwrap_or_default();
    let between = words[at + 1..].iter().take_while(|word| is_listed(ON_THE_WAY, word)).count();
    let around = at + 1 + between;
    let about = text(around + 1);
    let is_far = far_behind(&words[at + 1..around]).is_some() && !about.starts_with('<');
    ROUND.contains(&text(around)) && (matches!(about, "it" | "him" | "her" | "them") || is_own(about) || is_far)
}

/// Gives a way round the part of a circle that its words say: `walk half around it`.
pub(crate) fn walk_as_far(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement.is_circular() && step.amount.is_none() && !step.returns) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let leads = |at: &usize| {
            let verbs = WALKS.iter().chain(&CIRCLES);
            verbs.into_iter().any(|verb| is_form(words[*at], verb))
                && leads_round(&words, *at, &|word| word.starts_with('<'))
        };
        let far = (0..words.len()).find(leads).and_then(|at| {
            let round = (at..words.len()).find(|nth| ROUND.contains(&words[*nth]))?;
            far_behind(&words[at + 1..round])
        });
        if let Some(far) = far.filter(|_| step.end.side.is_none()) {
            step.amount = Some(Amount::Degrees(far));
        }
    }
}

/// A move, and the way round that its words say behind it: `back out until all of it is visible, and walk half around it`.
fn walked_round(linked: &Linked, step: &Step) -> Option<(Step, Step)> {
    let circles = |movement: &Move| movement.is_circular();
    if std::iter::once(&step.movement).chain(&step.with).any(circles) || step.returns || step.end.subjects.is_empty() {
        return None;
    }
    let words = words_of(linked, step);
    let text = |at: usize| words.get(at).map_or("", |(word, _)| *word);
    let texts: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
    let own = linked.expanded(&step.end.subjects);
    let is_own = |word: &str| linked.stands_for(word, &own);
    let around = |at: usize| leads_round(&texts, at, &is_own);
    let is_walk = |at: &usize| {
        let circles = CIRCLES.iter().any(|verb| is_form(text(*at), verb));
        let walks = WALKS.iter().any(|verb| is_form(text(*at), verb));
        circles && (linked.slot_at(text(at + 1)).is_some() || text(at + 1) == "it" || around(*at))
            || walks && around(*at)
    };
    let at = (1..words.len()).find(|at| is_walk(at) && begins(&words, *at))?;
    let far_at = |at: usize| far_behind(&texts[at..]);
    // `Rise and circle it` may be one move.
    let is_next = words[..at].iter().rev().take(2).any(|(word, _)| JOINTS[..4].contains(word));
    if !is_next && far_at(at).is_none() {
        return None;
    }
    let [first, second] = parted(step, &words, at)?;
    let behind: Vec<&str> = words[at..].iter().map(|(word, _)| *word).collect();
    let stated = behind.iter().filter_map(|word| linked.quantity_at(word)).find(|q| q.kind == QuantityKind::Degrees);
    let way = behind.iter().find_map(|word| SIDES.iter().find(|(side, _, _)| side == word));
    let shown = Framing { subjects: step.end.subjects.clone(), whole: step.end.whole, ..Framing::default() };
    let round = Step {
        either_way: way.is_none(),
        end: shown,
        amount: stated.map(|stated| stated.value).or(far_at(at)).map(Amount::Degrees),
        speed: step.speed,
        words: Some(second),
        ..Step::of(way.map_or(Move::OrbitRight, |(_, _, orbit)| *orbit))
    };
    Some((Step { words: Some(first), ..step.clone() }, round))
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{direction, linked};
    use super::*;

    fn split(text: &str, step: Step) -> Vec<Step> {
        let step = Step { words: Some([0, text.len()]), ..step };
        let mut direction = direction(vec![step]);
        split_moves(&linked(text), &mut direction);
        direction.program.steps
    }

    fn about(id: u32) -> Framing {
        Framing { subjects: vec![id], ..Framing::default() }
    }

    #[test]
    fn a_rest_goes_on_with_a_way_round() {
        let rest = || Step { end: Framing { side: Some(SubjectSide::FromSide), ..about(5) }, ..Step::of(Move::Static) };
        let steps = split("hold on the profile two secs , orbit round to the left till it looks at us", rest());
        assert_eq!([steps[0].movement, steps[1].movement], [Move::Static, Move::OrbitLeft]);
        assert_eq!(steps[1].end, about(5));
        assert_eq!(split("hold on <obj-0> in its orbit", rest()).len(), 1);
    }

    #[test]
    fn a_way_back_behind_a_move_is_a_step() {
        let arc = || Step { end: about(5), ..Step::of(Move::ArcRight) };
        let steps = split("swing round <obj-0> , and back off so the whole <obj-0> is in", arc());
        assert_eq!((steps[1].movement, steps[1].end.whole), (Move::PullOut, true));
        assert_eq!(split("swing round <obj-0> from the back", arc()).len(), 1);
        assert_eq!(split("swing round <obj-0> , back of it in shade", arc()).len(), 1);
    }

    #[test]
    fn a_way_in_behind_a_turn_is_a_step() {
        let whip = || Step { end: about(5), ..Step::of(Move::WhipPan) };
        let steps = split("whip over to <obj-0> and move in on it to finish", whip());
        assert_eq!([steps[0].movement, steps[1].movement], [Move::WhipPan, Move::PushIn]);
        assert_eq!(split("turn to <obj-0> , creeping towards it", whip()).len(), 2);
        assert_eq!(split("whip over to <obj-0> and move in on <obj-1>", whip()).len(), 1);
        let push = Step { end: about(5), amount: Some(Amount::Degrees(90.0)), ..Step::of(Move::PushIn) };
        let steps = split("go on to <obj-0> , and finish with <qty-0> arc around that", push);
        assert_eq!([steps[0].movement, steps[1].movement], [Move::PushIn, Move::ArcRight]);
        assert_eq!((steps[0].amount, steps[1].amount), (None, Some(Amount::Degrees(90.0))));
    }

    #[test]
    fn a_walk_around_behind_a_way_back_is_a_step() {
        let back = || Step { end: about(5), ..Step::of(Move::PullOut) };
        let steps = split("back out until <obj-0> is visible , and walk half around it so buyers see more", back());
        assert_eq!([steps[0].movement, steps[1].movement], [Move::PullOut, Move::OrbitRight]);
        assert_eq!(steps[1].amount, Some(Amount::Degrees(180.0)));
        assert_eq!(split("rise above <obj-0> , then circle it once", back()).len(), 2);
        assert_eq!(split("rise and circle <obj-0>", back()).len(), 1);
        assert_eq!(split("pull back from <obj-0> , walk around the corner", back()).len(), 1);
        assert_eq!(split("go to <obj-1> , turn round to <obj-0> and finish close", back()).len(), 1);
    }

    #[test]
    fn a_way_round_is_as_far_as_the_words_say() {
        let amount = |text: &str| {
            let mut steps = vec![Step { end: about(5), words: Some([0, text.len()]), ..Step::of(Move::OrbitRight) }];
            walk_as_far(&linked(text), &mut steps);
            steps[0].amount
        };
        assert_eq!(amount("and walk half around it so buyers see"), Some(Amount::Degrees(180.0)));
        assert_eq!(amount("go once round <obj-0>"), Some(Amount::Degrees(360.0)));
        assert_eq!(amount("walk around it at half the height"), None);
    }

    #[test]
    fn a_turn_behind_a_way_ahead_is_a_step() {
        let push = || Step { end: about(5), ..Step::of(Move::PushIn) };
        let steps = split("move forward to the middle , swing left to face <obj-0>", push());
        assert_eq!([steps[0].movement, steps[1].movement], [Move::PushIn, Move::PanLeft]);
        assert_eq!((steps[0].end.subjects.len(), &steps[1].end), (0, &about(5)));
        assert_eq!(split("move forward to <obj-0> , turn left at <obj-1>", push()).len(), 1);
    }
}
