//! Programs that give up what leads a camera through matter or out of the room.
//!
//! Enters: a program whose films are not safe. Leaves: the same program without the words that say from which side, over
//! which way, how far around a thing or from how steep an angle, the fewest given up first, with report lines that say what was given
//! up.

use super::program::{Amount, Program, Step};
use super::report::clause;
use cinesplat_trajectory::{Move, ReportLine, ShotAngle};

/// Longest circle around a thing that stands at a wall, degrees, one try after the other.
const ARCS_DEG: [f64; 2] = [120.0, 60.0];

/// Gives up some words of a step; what, or `None` where the step has none of them.
type GiveUp = dyn Fn(&mut Step) -> Option<&'static str>;

/// Programs in the order in which they are to be tried, each with what it gives up. Each gives up more than the one before;
/// ones that change nothing are left out.
pub(super) fn safer_programs(program: &Program, prompt: &str) -> Vec<(Program, Vec<ReportLine>)> {
    let ways: [&GiveUp; 7] = [
        &drop_last_height,
        &drop_reveal,
        &drop_places,
        &|step| shorten(step, ARCS_DEG[0]),
        &|step| shorten(step, ARCS_DEG[1]),
        &drop_pass,
        &drop_angles,
    ];
    let (mut safer, mut lines) = (program.clone(), Vec::new());
    let mut tries = Vec::new();
    for way in ways {
        let given_up = give_up(&mut safer, prompt, way);
        if !given_up.is_empty() {
            lines.extend(given_up);
            tries.push((safer.clone(), lines.clone()));
        }
    }
    tries
}

/// Gives up some words of every step that has them; the lines of what.
fn give_up(program: &mut Program, prompt: &str, way: &GiveUp) -> Vec<ReportLine> {
    program.steps.iter_mut().filter_map(|step| way(step).map(|what| line(prompt, step, what))).collect()
}

/// Begins a way in at the height that the words state, and ends it at any: `at ankle height, go up to the plant`.
fn drop_last_height(step: &mut Step) -> Option<&'static str> {
    let is_one = step.movement == Move::PushIn && step.start.height.is_some() && step.start.height == step.end.height;
    if is_one {
        step.end.height = None;
    }
    is_one.then_some("the height that the words state, up to the end")
}

/// Goes up to a subject that no place hides and shows.
fn drop_reveal(step: &mut Step) -> Option<&'static str> {
    let is_open = step.movement == Move::Reveal && step.via.is_none() && !step.end.subjects.is_empty();
    if is_open {
        (step.movement, step.with) = (Move::PushIn, Vec::new());
    }
    is_open.then_some("a reveal")
}

/// Gives up the sides, heights and distances from which a step sees its subjects.
fn drop_places(step: &mut Step) -> Option<&'static str> {
    let mut is_dropped = false;
    for framing in [&mut step.start, &mut step.end] {
        is_dropped |= framing.side.take().is_some();
        is_dropped |= framing.height.take().is_some();
        is_dropped |= framing.distance.take().is_some();
        is_dropped |= !std::mem::take(&mut framing.backdrop).is_empty();
    }
    is_dropped.then_some("the side, height, distance or background that the words state")
}

/// Goes less far around a thing.
fn shorten(step: &mut Step, most_deg: f64) -> Option<&'static str> {
    let is_long = match step.amount {
        Some(Amount::Degrees(degrees)) => degrees > most_deg,
        Some(Amount::Large) => true,
        None => matches!(step.movement, Move::OrbitLeft | Move::OrbitRight),
        Some(_) => false,
    };
    if !step.movement.is_circular() || !is_long {
        return None;
    }
    step.amount = Some(Amount::Degrees(most_deg));
    Some("the angle that the words state")
}

/// Goes straight where the words lead past, over or through something.
fn drop_pass(step: &mut Step) -> Option<&'static str> {
    step.via.take().map(|_| "the way that the words state")
}

/// Looks from where there is room for a camera, where the words ask for a steep view.
fn drop_angles(step: &mut Step) -> Option<&'static str> {
    let mut is_dropped = false;
    for framing in [&mut step.start, &mut step.end] {
        let is_steep = matches!(framing.angle, Some(ShotAngle::Worm | ShotAngle::Low | ShotAngle::Overhead));
        is_dropped |= is_steep;
        framing.angle = framing.angle.filter(|_| !is_steep);
    }
    is_dropped.then_some("the angle from below or from above")
}

/// Shows the first of several things that no place in the room shows together.
fn show_first(step: &mut Step) -> Option<&'static str> {
    let mut is_dropped = false;
    for framing in [&mut step.start, &mut step.end] {
        is_dropped |= framing.subjects.len() > 1 || framing.whole;
        framing.subjects.truncate(1);
        framing.whole = false;
    }
    is_dropped.then_some("all of the things in one picture")
}

/// Sees its subjects at any size.
fn drop_sizes(step: &mut Step) -> Option<&'static str> {
    let mut is_dropped = false;
    for framing in [&mut step.start, &mut step.end].into_iter().filter(|framing| !framing.subjects.is_empty()) {
        is_dropped |= framing.size.take().is_some();
        is_dropped |= framing.height_frac.take().is_some();
    }
    is_dropped.then_some("the size that the words state")
}

/// Programs for films that go through a wall or stay outside whatever else is given up, each with the lines of what it gives
/// up: the first of several things, then the sizes that the words state, and then a look around the room.
pub(super) fn indoor_programs(program: &Program, prompt: &str) -> Vec<(Program, Vec<ReportLine>)> {
    let (mut safer, mut lines) = (program.clone(), Vec::new());
    let mut tries = Vec::new();
    let ways: [&GiveUp; 2] = [&show_first, &drop_sizes];
    for way in ways {
        let given_up = give_up(&mut safer, prompt, way);
        if !given_up.is_empty() {
            lines.extend(given_up);
            tries.push((safer.clone(), lines.clone()));
        }
    }
    tries.push(look_around(program, prompt));
    tries
}

fn look_around(program: &Program, prompt: &str) -> (Program, Vec<ReportLine>) {
    let lines = program.steps.iter().map(|step| line(prompt, step, "a camera in the room")).collect();
    (Program { steps: vec![Step::look_around()], duration_secs: program.duration_secs, ..Program::default() }, lines)
}

fn line(prompt: &str, step: &Step, what: &str) -> ReportLine {
    ReportLine {
        clause: clause(prompt, step.words, step.movement),
        wanted: what.to_owned(),
        got: 0.0,
        met: false,
        note: "given up: it leads through matter or out of what was captured".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Framing, SubjectSide};

    #[test]
    fn each_safer_program_gives_up_more_and_says_so() {
        let end = Framing { subjects: vec![3], side: Some(SubjectSide::FromBack), ..Framing::default() };
        let step = Step { end, amount: Some(Amount::Degrees(360.0)), ..Step::of(Move::OrbitLeft) };
        let program = Program { steps: vec![step, Step::of(Move::PushIn)], ..Program::default() };
        let tries = safer_programs(&program, "");
        let found: Vec<(bool, Option<Amount>, usize)> = tries
            .iter()
            .map(|(safer, lines)| (safer.steps[0].end.side.is_some(), safer.steps[0].amount, lines.len()))
            .collect();
        assert_eq!(
            found,
            [
                (false, Some(Amount::Degrees(360.0)), 1),
                (false, Some(Amount::Degrees(120.0)), 2),
                (false, Some(Amount::Degrees(60.0)), 3),
            ]
        );
        assert!(tries.iter().all(|(safer, _)| safer.steps[1] == program.steps[1]));
    }

    #[test]
    fn a_reveal_is_given_up_for_a_way_in() {
        let end = Framing { subjects: vec![3], ..Framing::default() };
        let step = Step { end: end.clone(), with: vec![Move::PanRight], ..Step::of(Move::Reveal) };
        let tries = safer_programs(&Program { steps: vec![step], ..Program::default() }, "");
        assert_eq!(tries.len(), 1);
        assert_eq!(tries[0].0.steps[0], Step { end, ..Step::of(Move::PushIn) });
        assert!(!tries[0].1[0].met);
    }

    #[test]
    fn a_way_in_gives_up_its_last_height_first() {
        let at = |height: Option<f64>| Framing { subjects: vec![3], height, ..Framing::default() };
        let step = Step { start: at(Some(0.1)), end: at(Some(0.1)), ..Step::of(Move::PushIn) };
        let tries = safer_programs(&Program { steps: vec![step], ..Program::default() }, "");
        let heights = |program: &Program| [program.steps[0].start.height, program.steps[0].end.height];
        let found: Vec<[Option<f64>; 2]> = tries.iter().map(|(safer, _)| heights(safer)).collect();
        assert_eq!(found, [[Some(0.1), None], [None, None]]);
    }

    #[test]
    fn the_last_one_shows_a_single_thing_and_then_the_room() {
        let end = Framing { subjects: vec![3, 8], whole: true, ..Framing::default() };
        let program = Program { steps: vec![Step { end, ..Step::of(Move::PushIn) }], ..Program::default() };
        assert!(safer_programs(&program, "").is_empty());
        let tries = indoor_programs(&program, "");
        let [(single, lines), (around, given_up)] = &tries[..] else { panic!("{tries:?}") };
        assert_eq!((&single.steps[0].end.subjects[..], single.steps[0].end.whole, lines.len()), (&[3][..], false, 1));
        assert!(around.object_ids().is_empty() && around.steps[0].either_way && !given_up[0].met);
    }
}
