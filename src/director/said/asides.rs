//! What clauses beside a move say of how the camera is, and no move of their own: `lens just above the tabletop`, `camera at half of
//! the neck`, `hold that two seconds`, `creep in ten percent`, `golden light from the windows`.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_operator::{Amount, Framing, Program, Step};
use cinesplat_trajectory::{Move, ShotAngle};

use super::briefs::is_camera_verb;
use super::directions::is_form;
use crate::direction::Direction;

/// What is at a height, and words by which it is.
const CAMERAS: &str = "lens camera cam";
const LEVELS: &str = "at above level below over around about just a touch bit slightly little inch hair half of the same height as with \
    is in line well";

/// Takes a clause about the height of the camera for no move, and what it names for no subject.
pub(crate) fn drop_camera_heights(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let num_steps = direction.program.steps.len();
        let step = &direction.program.steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some((at, ids)) = height_clause(linked, &words) else { continue };
        let first = words.iter().position(|word| !matches!(*word, "," | "and" | "." | "the" | "with"));
        let is_bare = step.duration_secs.is_none() && step.amount.is_none() && !step.cut;
        if first == Some(at) && num_steps > 1 && is_bare {
            // `Around the table, camera a bit above the plates` goes round at that height.
            match nth.checked_sub(1).map(|before| &direction.program.steps[before]) {
                Some(before) => {
                    let end = Framing { angle: before.end.angle.or(step.end.angle), ..before.end.clone() };
                    let one = Step { end, words: before.joint_words(step), ..before.clone() };
                    direction.join_steps(nth, one);
                }
                None => direction.remove_step(nth),
            }
            continue;
        }
        let step = &mut direction.program.steps[nth];
        let named = words[..at].iter().find_map(|word| linked.slot_at(word)).map(|id| linked.expanded(&[id]));
        let circles = step.movement.is_circular();
        if let Some(named) =
            named.filter(|named| circles && linked.expanded(&step.end.subjects) == ids && *named != ids)
        {
            step.end.subjects = named;
        }
    }
}

/// Takes a clause that compares the camera's height for the angle of the move before it: `orbit the table, higher than the armchairs and
/// looking down at it`, of which the network makes a rise.
pub(crate) fn join_compared_heights(linked: &Linked, direction: &mut Direction) {
    direction.join_pairs(|before, step| {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let mut said =
            words.iter().copied().skip_while(|word| matches!(*word, "," | "and" | "a" | "bit" | "little" | "slightly"));
        let angle = match (said.next()?, said.next()?) {
            ("higher", "than") => ShotAngle::High,
            ("lower", "than") => ShotAngle::Low,
            _ => return None,
        };
        let rises = matches!(
            step.movement,
            Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown | Move::Static | Move::Follow
        );
        let is_bare = step.duration_secs.is_none() && step.amount.is_none() && step.with.is_empty() && !step.cut;
        let keeps = before.end.angle.or(Some(angle));
        let end = Framing { angle: keeps, ..before.end.clone() };
        (rises && is_bare).then(|| Step { end, words: before.joint_words(step), ..before.clone() })
    });
}

/// Takes what the words only compare a height with for no subject: `vase height, push in on the sofa`, `dropping to about shelf height`.
pub(crate) fn drop_height_subjects(linked: &Linked, direction: &mut Direction) {
    let words = linked.texts_in([0, usize::MAX]);
    let is_height = |at: usize| {
        let owned = at + 1 + usize::from(words.get(at + 1) == Some(&"'s"));
        // `At the height of the bench`, `level with the stool`.
        let before = &words[at.saturating_sub(2)..at];
        let is_behind = matches!(before, ["height", "of"] | ["level", "with"]);
        is_behind || words.get(owned).is_some_and(|word| matches!(*word, "height" | "level"))
    };
    let mut heights: Vec<u32> =
        (0..words.len()).filter(|at| is_height(*at)).filter_map(|at| linked.slot_at(words[at])).collect();
    heights.retain(|id| !(0..words.len()).any(|at| linked.slot_at(words[at]) == Some(*id) && !is_height(at)));
    let heights = linked.expanded(&heights);
    let is_only_height = |ids: &[u32]| !ids.is_empty() && linked.expanded(ids).iter().all(|id| heights.contains(id));
    for nth in (0..direction.program.steps.len()).rev() {
        let steps = &direction.program.steps;
        let step = &steps[nth];
        let own = linked.texts_in(step.words.unwrap_or_default());
        let mut others = own.iter().filter_map(|word| linked.slot_at(word)).map(|id| linked.expanded(&[id]));
        let named = others.rfind(|ids| !is_only_height(ids));
        if !is_only_height(&step.end.subjects) {
            begin_without(&mut direction.program.steps[nth], &is_only_height, named);
            continue;
        }
        let is_bare = step.amount.is_none() && step.duration_secs.is_none() && named.is_none();
        if is_bare && steps.len() > 1 && !(0..own.len()).any(|at| is_camera_verb(&own, at)) {
            direction.remove_step(nth);
            continue;
        }
        let before = nth.checked_sub(1).map(|before| steps[before].end.subjects.clone()).unwrap_or_default();
        let shown = Some(step.start.subjects.clone()).filter(|ids| !ids.is_empty()).unwrap_or(before);
        let subjects = named.unwrap_or(shown);
        // `Static at that level` is about what it names, where nothing else is there.
        if subjects.is_empty() {
            continue;
        }
        let step = &mut direction.program.steps[nth];
        step.end.angle = step.end.angle.filter(|angle| *angle != ShotAngle::EyeLevel);
        step.end.subjects = subjects;
    }
}

/// Begins with what a step shows where it was read to begin with what only says how high the camera is.
fn begin_without(step: &mut Step, is_only_height: &dyn Fn(&[u32]) -> bool, named: Option<Vec<u32>>) {
    if !is_only_height(&step.start.subjects) || step.movement == Move::Static {
        return;
    }
    step.start = Framing { size: step.start.size, ..Framing::default() };
    if step.end.subjects.is_empty() {
        step.end.subjects = named.unwrap_or_default();
    }
}

/// Takes a clause about the lens for no picture of its own: `.. then pan right to the shelves. Wide lens so the room looks its best`.
pub(crate) fn drop_lenses(linked: &Linked, direction: &mut Direction) {
    direction.join_pairs(|before, step| {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let of_lens = words.iter().any(|word| matches!(*word, "lens" | "lenses"));
        let is_bare = step.movement == Move::Static
            && step.end.subjects.is_empty()
            && step.duration_secs.is_none()
            && !step.cut
            && step.with.is_empty();
        let is_clause = of_lens && is_bare && !(0..words.len()).any(|at| is_camera_verb(&words, at));
        is_clause.then(|| Step { words: before.joint_words(step), ..before.clone() })
    });
}

/// A clause about the camera's height at its end, without a verb of a move: its first word, and the things that it names.
fn height_clause(linked: &Linked, words: &[&str]) -> Option<(usize, Vec<u32>)> {
    let clause = |at: usize| {
        let begins = at == 0 || matches!(words[at - 1], "," | "and" | "." | "the" | "with");
        let thing = (at + 1..words.len()).find(|at| !is_listed(LEVELS, words[*at]))?;
        let id = linked.slot_at(words[thing])?;
        let is_end = words.get(thing + 1).is_none_or(|word| matches!(*word, "." | "," | ";" | "!" | "so"));
        (begins && is_listed(CAMERAS, words[at]) && thing > at + 1 && is_end).then(|| (at, linked.expanded(&[id])))
    };
    let at = (0..words.len()).find_map(clause)?;
    (!(at.0..words.len()).any(|nth| is_camera_verb(words, nth))).then_some(at)
}

/// Keeps the picture that is there where the words only hold it: `hold that two seconds`.
pub(crate) fn hold_what_is_there(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let before = linked.expanded(&steps[nth - 1].end.subjects);
        let step = &mut steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let holds =
            words.iter().take(3).any(|word| is_form(word, "hold") || is_form(word, "keep") || is_form(word, "stay"))
                && words.iter().take(4).any(|word| is_listed("that it there this", word));
        let names = words.iter().any(|word| linked.slot_at(word).is_some());
        let is_part = linked.expanded(&step.end.subjects).iter().all(|id| before.contains(id));
        let is_same = step.end == Framing { subjects: step.end.subjects.clone(), ..Framing::default() }
            && linked.expanded(&step.end.subjects) == before;
        if holds && !names && is_part && !is_same && step.movement == Move::Static && step.duration_secs.is_some() {
            step.end = Framing::default();
        }
    }
}

/// Goes in or out by a share of the way, which is no size of the subject: `creep in ten percent`.
pub(crate) fn move_by_share(linked: &Linked, steps: &mut [Step]) {
    for step in steps
        .iter_mut()
        .filter(|step| matches!(step.movement, Move::PushIn | Move::PullOut | Move::ZoomIn | Move::ZoomOut))
    {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let share = |at: usize| {
            let quantity = linked.quantity_at(words[at]).filter(|quantity| quantity.kind == QuantityKind::Percent)?;
            let by = words[..at].iter().rev().find(|word| !is_listed("by about roughly maybe just only", word))?;
            let is_last = words.get(at + 1).is_none_or(|word| !is_listed("of full high", word));
            (is_listed("in out closer nearer back forward", by) && is_last).then_some(quantity.value / 100.0)
        };
        let Some(frac) = (0..words.len()).find_map(share) else { continue };
        if step.end.height_frac.is_none_or(|own| (own - frac).abs() < 1e-6) && step.amount.is_none() {
            let nears = matches!(step.movement, Move::PushIn | Move::ZoomIn);
            step.end.height_frac = None;
            step.amount = Some(Amount::Factor(if nears { 1.0 - frac } else { 1.0 + frac }));
        }
    }
}

/// Words of the length of a film, which the network takes for that of its first step.
const FILMS: &str = "trailer teaser film video clip reel spot promo ad opener";

/// Gives a length in a first sentence that names the film to all of it: `trailer, first ten seconds or so. You get up ..`.
pub(crate) fn time_title(linked: &Linked, program: &mut Program) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let end = words.iter().position(|word| matches!(*word, "." | "!")).unwrap_or(words.len());
    let title = &words[..end];
    let is_title = title.iter().any(|word| is_listed(FILMS, word))
        && !title.iter().any(|word| linked.slot_at(word).is_some())
        && !(0..title.len()).any(|at| is_camera_verb(title, at));
    let Some(secs) = title.iter().find_map(|word| linked.secs_at(word)).filter(|_| is_title && end < words.len())
    else {
        return;
    };
    let timed = program.steps.iter().filter(|step| step.duration_secs.is_some()).count();
    if let Some(first) = program.steps.first_mut().filter(|_| timed == 1)
        && first.duration_secs.is_some_and(|own| (own - secs).abs() < 1e-9)
    {
        first.duration_secs = None;
        program.duration_secs = program.duration_secs.or(Some(secs));
    }
}

/// Light and what it comes from.
const LIGHTS: &str = "light sunlight daylight sun glow sunshine moonlight";

/// Takes light that comes from something for no picture of that: `golden light from the windows`.
pub(crate) fn drop_light(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let num_steps = direction.program.steps.len();
        let step = &direction.program.steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let lights = |at: usize| {
            let leads = matches!(words.get(at + 1), Some(&"from" | &"through")) && is_listed(LIGHTS, words[at]);
            leads && words[at + 1..].iter().take(3).any(|word| linked.slot_at(word).is_some())
        };
        let is_picture = step.movement == Move::Static && step.duration_secs.is_none() && words.len() < 9;
        if num_steps > 1
            && is_picture
            && (0..words.len()).any(lights)
            && !(0..words.len()).any(|at| is_camera_verb(&words, at))
        {
            direction.remove_step(nth);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;
    use cinesplat_language::Quantity;

    #[test]
    fn a_height_that_is_compared_is_the_angle_of_the_move_before() {
        let read = |text: &str| {
            let at = text.find(" ,").unwrap();
            let steps = vec![about(Move::OrbitRight, &[5], [0, at]), about(Move::CraneUp, &[7], [at + 1, text.len()])];
            let mut direction = direction(steps);
            join_compared_heights(&linked(text), &mut direction);
            let steps = direction.program.steps;
            (steps.len(), steps[0].end.angle, steps[0].end.subjects.clone())
        };
        let high = (1, Some(ShotAngle::High), vec![5]);
        assert_eq!(read("orbit <obj-0> , higher than <obj-1> and looking down at it"), high);
        assert_eq!(read("orbit <obj-0> , then higher up than <obj-1>").0, 2);
    }

    #[test]
    fn what_a_height_is_compared_with_is_no_subject() {
        let shown = |text: &str, start: &[u32]| {
            let mut step = about(Move::PullOut, &[7], [0, text.len()]);
            step.end.angle = Some(ShotAngle::EyeLevel);
            step.start.subjects = start.to_vec();
            let mut direction = direction(vec![step]);
            drop_height_subjects(&linked(text), &mut direction);
            direction.program.steps[0].end.clone()
        };
        let of = |ids: &[u32]| Framing { subjects: ids.to_vec(), ..Framing::default() };
        assert_eq!(shown("keep <obj-0> centered , back off , dropping to about <obj-1> height", &[]), of(&[5]));
        assert_eq!(shown("back off , dropping to <obj-1> 's level", &[5]), of(&[5]));
        assert_eq!(shown("static at <obj-1> level", &[]).subjects, [7]);
        assert_eq!(shown("slide along <obj-0> , level with <obj-1>", &[]), of(&[5]));
        let text = "crane up before <obj-0> from about the height of <obj-1>";
        let mut step = about(Move::CraneUp, &[], [0, text.len()]);
        step.start = Framing { subjects: vec![7], angle: Some(ShotAngle::EyeLevel), ..Framing::default() };
        let mut risen = direction(vec![step]);
        drop_height_subjects(&linked(text), &mut risen);
        assert_eq!(risen.program.steps[0].end.subjects, [5]);
        assert_eq!(risen.program.steps[0].start, Framing::default());
        // A subject that is at its own height stays.
        assert_eq!(shown("at <obj-1> height , back off from <obj-1>", &[5]).subjects, [7]);
        let text = "<obj-1> height , push in on <obj-0>";
        let steps = vec![about(Move::PushIn, &[7], [0, 14]), about(Move::PushIn, &[5], [17, text.len()])];
        let mut direction = direction(steps);
        drop_height_subjects(&linked(text), &mut direction);
        assert_eq!(direction.program.steps.len(), 1);
    }

    #[test]
    fn the_height_of_a_camera_is_no_move() {
        let left = |text: &str, comma: usize| {
            let steps = vec![about(Move::PushIn, &[5], [0, comma]), about(Move::FlyThrough, &[7], [comma, text.len()])];
            let mut direction = direction(steps);
            drop_camera_heights(&linked(text), &mut direction);
            direction.program.steps.len()
        };
        assert_eq!(left("push on <obj-0> , lens just above <obj-1> .", 15), 1);
        assert_eq!(left("push on <obj-0> , camera moves over <obj-1> .", 15), 2);
        let text = "rotate around <obj-0> , camera at half of <obj-1> .";
        let mut direction = direction(vec![about(Move::ArcRight, &[7], [0, text.len()])]);
        drop_camera_heights(&linked(text), &mut direction);
        assert_eq!(direction.program.steps[0].end.subjects, [5]);
    }

    #[test]
    fn who_holds_that_keeps_the_picture() {
        let text = "pull back from <obj-0> . hold that <qty-0>";
        let held = Step { duration_secs: Some(2.0), ..about(Move::Static, &[5], [25, text.len()]) };
        let mut steps = [about(Move::PullOut, &[5, 7], [0, 24]), held];
        hold_what_is_there(&linked(text), &mut steps);
        assert_eq!(steps[1].end, Framing::default());
    }

    #[test]
    fn a_share_of_the_way_is_no_size() {
        let amount = |text: &str| {
            let ten = Quantity { kind: QuantityKind::Percent, value: 10.0 };
            let linked = Linked { quantities: vec![ten], ..linked(text) };
            let mut steps = [about(Move::PushIn, &[5], [0, text.len()])];
            steps[0].end.height_frac = Some(0.1);
            move_by_share(&linked, &mut steps);
            (steps[0].amount, steps[0].end.height_frac)
        };
        assert_eq!(amount("on <obj-0> , creep in <qty-0> over"), (Some(Amount::Factor(0.9)), None));
        assert_eq!(amount("push in until it takes <qty-0> of the frame"), (None, Some(0.1)));
    }

    #[test]
    fn light_from_a_window_is_no_picture_of_it() {
        let text = "push in on <obj-0> , golden light from <obj-1>";
        let steps = vec![about(Move::PushIn, &[5], [0, 18]), about(Move::Static, &[7], [20, text.len()])];
        let mut direction = direction(steps);
        drop_light(&linked(text), &mut direction);
        assert_eq!(direction.program.steps.len(), 1);
    }

    #[test]
    fn the_length_of_a_title_is_that_of_the_film() {
        let text = "escape room trailer , first <qty-0> or so . pedestal up <obj-0>";
        let ten = Quantity { kind: QuantityKind::Seconds, value: 10.0 };
        let linked = Linked { quantities: vec![ten], ..linked(text) };
        let step = Step { duration_secs: Some(10.0), ..about(Move::PedestalUp, &[5], [0, text.len()]) };
        let mut program = Program { steps: vec![step], ..Program::default() };
        time_title(&linked, &mut program);
        assert_eq!((program.steps[0].duration_secs, program.duration_secs), (None, Some(10.0)));
    }
}
