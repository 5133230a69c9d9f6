//! What clauses say of the thing right before them, and of how high a way over a table is: `the cup which takes half of the
//! image`, `low, just above the wood`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_objects::Object;
use cinesplat_operator::{Framing, Motion, Pass, Program, Step, Via};
use cinesplat_trajectory::{Move, ShotAngle};

use super::bans::asks_for;
use super::called::is_called;
use super::directions::is_form;

/// Words of a clause about a thing, and verbs of how much of the frame it takes.
const RELATIVES: [&str; 3] = ["which", "that", ","];
const TAKES: [&str; 5] = ["take", "fill", "occupy", "occupie", "cover"];

/// Shows the thing whose clause states its size, where the network shows what is beside it: `the table with the cup which
/// takes half of the image`.
pub(crate) fn show_what_fills(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.end.height_frac.is_some()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_filling = |at: usize| {
            let verb = words.get(at + 2).is_some_and(|word| TAKES.iter().any(|verb| is_form(word, verb)));
            let relative = words.get(at + 1).is_some_and(|word| RELATIVES[..2].contains(word));
            linked.slot_at(words[at]).filter(|_| relative && verb)
        };
        if let Some(id) = (0..words.len()).find_map(is_filling) {
            step.end.subjects = linked.expanded(&[id]);
        }
    }
}

/// Words right above a surface, and surfaces of tables.
const CLOSE: &str = "just barely hardly inches slightly millimeters centimeters";
const OVER: &str = "above over off";
const SURFACES: &str = "tabletop wood surface cloth tablecloth countertop worktop benchtop desktop";
const TABLES: &str = "table desk counter workbench bench island worktop sideboard";

/// Goes along at the level of things on a table, where the words skim its top, and not over it: `follow it low, just above the
/// wood`.
pub(crate) fn skim_tops(linked: &Linked, objects: &[Object], steps: &mut [Step]) {
    let is_table = |id: &u32| is_called(objects, *id, TABLES);
    for step in steps.iter_mut() {
        let Some(via) = step.via.as_ref().filter(|via| via.how == Pass::Over) else { continue };
        let words = linked.texts_in(step.words.unwrap_or_default());
        let text = |at: usize| words.get(at).copied().unwrap_or_default();
        let is_top = |at: usize| {
            let at = at + usize::from(text(at) == "the");
            is_listed(SURFACES, text(at)) || via.objects.iter().any(|id| is_table(id) && linked.names(text(at), *id))
        };
        let skims =
            (1..words.len()).any(|at| is_listed(OVER, text(at)) && is_listed(CLOSE, text(at - 1)) && is_top(at + 1));
        if !skims || step.end.subjects.is_empty() {
            continue;
        }
        step.via = None;
        let says_angle = words.windows(2).any(|pair| matches!(pair, ["low", "angle" | "-"]));
        if !(says_angle && step.end.angle == Some(ShotAngle::Low)) {
            step.end.angle = Some(ShotAngle::EyeLevel);
        }
        if !step.start.subjects.is_empty() {
            step.start.angle = step.start.angle.or(Some(ShotAngle::EyeLevel));
        }
        if step.movement == Move::FlyThrough {
            step.movement = Move::Follow;
        }
    }
}

/// Words of a way close above a surface, besides its height.
const SKIMS: [&str; 6] = ["skim", "skate", "graze", "hug", "brush", "skirt"];

/// Goes along from one thing on a table to the next at their own level, where the words skim the table past them: `skim 10 cm above
/// the wood past the cactus and the bottle`.
pub(crate) fn skim_past(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::FlyThrough | Move::Follow)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let text = |at: usize| words.get(at).copied().unwrap_or_default();
        let is_low = |at: usize| {
            let is_close = is_listed(CLOSE, text(at)) || linked.quantity_at(text(at)).is_some() || text(at) == "low";
            is_listed(OVER, text(at + 1)) && is_close
        };
        let skims = words.iter().any(|word| SKIMS.iter().any(|verb| is_form(word, verb)));
        let Some(past) = words.iter().position(|word| matches!(*word, "past" | "by")) else { continue };
        let listed = words[past + 1..].iter().take_while(|word| {
            matches!(**word, "and" | "," | "the" | "then" | "past") || linked.slot_at(word).is_some()
        });
        let ids: Vec<u32> = listed.filter_map(|word| linked.slot_at(word)).collect();
        let over = step.via.as_ref().filter(|via| via.how == Pass::Over).map(|via| linked.expanded(&via.objects));
        let is_over = over.is_some_and(|over| linked.expanded(&ids).iter().any(|id| over.contains(id)));
        if !is_over || ids.is_empty() || !(skims || (0..words.len()).any(is_low)) {
            continue;
        }
        let level = |ids: Vec<u32>| Framing { subjects: ids, angle: Some(ShotAngle::EyeLevel), ..Framing::default() };
        let mut places: Vec<Vec<u32>> = ids.iter().map(|id| linked.expanded(&[*id])).collect();
        if step.end.subjects.is_empty() || places.contains(&linked.expanded(&step.end.subjects)) {
            step.end = level(places.pop().unwrap_or_default());
        }
        if step.start.subjects.is_empty() && !places.is_empty() {
            step.start = level(places.remove(0));
        }
        let objects = places.concat();
        step.via = (!objects.is_empty()).then_some(Via { how: Pass::Past, objects });
        step.movement = Move::Follow;
    }
}

/// What is kept level, and words behind `level` by which it is a height.
const CAMERAS: &str = "her it camera cam lens him things everything shot frame horizon gimbal head";
const HEIGHTS: &str = "with to at as of height";

/// Words of an angle that is not level.
const ANGLES: &str = "angle looking down low high upward upwards downward downwards overhead";

/// Rules out tilts and rolls where the words keep the camera level: `keep her level`.
pub(crate) fn keep_level(linked: &Linked, program: &mut Program) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let text = |at: usize| words.get(at).copied().unwrap_or_default();
    let is_kept = |at: usize| {
        let keeps = is_form(text(at), "keep") || is_form(text(at), "hold") || is_form(text(at), "stay");
        let thing = at + 1 + usize::from(text(at + 1) == "the");
        let is_stay = is_form(text(at), "stay");
        let level = if is_stay { at + 1 } else { thing + 1 };
        let level = level + usize::from(matches!(text(level), "dead" | "perfectly" | "nice" | "always" | "absolutely"));
        let is_camera = is_stay || is_listed(CAMERAS, text(thing));
        keeps && is_camera && text(level) == "level" && !is_listed(HEIGHTS, text(level + 1))
    };
    let leans = |framing: &Framing| {
        framing.elevation_deg.is_some() || matches!(framing.angle, Some(ShotAngle::Overhead | ShotAngle::Worm))
    };
    let turns = |step: &Step| {
        [Motion::Tilt, Motion::Roll].iter().any(|motion| asks_for(step, *motion))
            || leans(&step.start)
            || leans(&step.end)
    };
    let says_angle = words.iter().any(|word| is_listed(ANGLES, word));
    if !(0..words.len()).any(is_kept) || says_angle || program.steps.iter().any(turns) {
        return;
    }
    for framing in program.steps.iter_mut().flat_map(|step| [&mut step.start, &mut step.end]) {
        framing.angle = framing.angle.filter(|angle| *angle == ShotAngle::EyeLevel);
    }
    for motion in [Motion::Tilt, Motion::Roll] {
        program.forbid(motion);
    }
}

/// Words of a picture from straight above, and words that lead to it.
const OVERHEADS: &str = "overhead topdown top-down bird birds plan";
const LEADS: &str = "into to until till becomes";

/// Ends a rise straight above what its words lead to: `lift straight up into an overhead of the whole table`.
pub(crate) fn rise_to_overhead(linked: &Linked, steps: &mut [Step]) {
    let rises = |step: &&mut Step| matches!(step.movement, Move::CraneUp | Move::PedestalUp);
    for step in steps.iter_mut().filter(rises).filter(|step| step.end.angle.is_none()) {
        let words: Vec<(&str, [usize; 2])> = linked.words_in(step.words.unwrap_or_default()).collect();
        let text = |at: usize| words.get(at).map_or("", |(word, _)| *word);
        let is_overhead = |at: &usize| {
            is_listed(OVERHEADS, text(*at)) && (at.saturating_sub(4)..*at).any(|at| is_listed(LEADS, text(at)))
        };
        let Some(at) = (0..words.len()).find(is_overhead) else { continue };
        let shown = words[at..].iter().take(8).find_map(|(word, span)| Some((linked.slot_at(word)?, *span)));
        step.movement = Move::CraneUp;
        step.end.angle = Some(ShotAngle::Overhead);
        if let Some((id, span)) = shown {
            step.end.subjects = linked.expanded(&[id]);
            step.end.whole |= linked.wholes.contains(&span)
                || words[at..].iter().take(8).any(|(word, _)| matches!(*word, "whole" | "entire" | "all"));
        }
    }
}

/// Fewest things of a row, and most by which they are out of its line, over its length.
const LEAST_ROW: usize = 2;
const MOST_ASIDE: f64 = 0.15;

/// Slides from one end to the other of a row of things that it passes: `past the three pictures over the sofa`.
pub(crate) fn slide_along_rows(objects: &[Object], steps: &mut [Step]) {
    for step in steps {
        let slides = matches!(step.movement, Move::TruckLeft | Move::TruckRight);
        // Which end is the right one depends on where the camera stands.
        let is_open =
            step.either_way && step.start.subjects.is_empty() && step.end.subjects.is_empty() && step.amount.is_none();
        let Some(via) = step.via.as_ref().filter(|via| slides && is_open && via.how == Pass::Past) else { continue };
        let row: Vec<&Object> =
            via.objects.iter().filter_map(|id| objects.iter().find(|object| object.id == *id)).collect();
        if row.len() < LEAST_ROW || row.len() != via.objects.len() {
            continue;
        }
        let pairs = row.iter().flat_map(|a| row.iter().map(move |b| (*a, *b)));
        let apart = |(a, b): &(&Object, &Object)| a.center.distance(b.center);
        let Some((first, last)) = pairs.max_by(|a, b| apart(a).total_cmp(&apart(b))) else { continue };
        let way = last.center - first.center;
        let aside = |object: &&Object| (object.center - first.center).reject_from(way).length();
        // Things that stand apart are passed as they come.
        if way.length() > 0.0 && row.iter().map(aside).fold(0.0, f64::max) < MOST_ASIDE * way.length() {
            (step.start.subjects, step.end.subjects) = (vec![first.id], vec![last.id]);
            step.via = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::linked;
    use super::*;

    fn step(text: &str, movement: Move, subject: u32) -> Step {
        let end = Framing { subjects: vec![subject], ..Framing::default() };
        Step { end, words: Some([0, text.len()]), ..Step::of(movement) }
    }

    #[test]
    fn what_takes_half_of_the_image_is_shown() {
        let shown = |text: &str| {
            let mut steps = [step(text, Move::CraneDown, 5)];
            steps[0].end.height_frac = Some(0.5);
            show_what_fills(&linked(text), &mut steps);
            steps[0].end.subjects.clone()
        };
        assert_eq!(shown("at the height of <obj-0> with <obj-1> which takes half of the image"), [7]);
        assert_eq!(shown("at the height of <obj-0> with <obj-1> , half of the image"), [5]);
    }

    #[test]
    fn a_slide_past_a_row_goes_from_one_end_to_the_other() {
        let at = |id, x: f64, z: f64| Object::from_box(id, "", glam::DVec3::new(x, 1.6, z), glam::DVec3::splat(0.2));
        let slid = |objects: &[Object], either_way: bool| {
            let via = Via { how: Pass::Past, objects: objects.iter().map(|object| object.id).collect() };
            let mut steps = [Step { via: Some(via), either_way, ..Step::of(Move::TruckRight) }];
            slide_along_rows(objects, &mut steps);
            [steps[0].start.subjects.clone(), steps[0].end.subjects.clone()].concat()
        };
        let row = [at(1, 0.0, 0.0), at(2, -0.6, 0.0), at(3, 0.6, 0.0)];
        let mut ends = slid(&row, true);
        ends.sort_unstable();
        assert_eq!(ends, [2, 3]);
        assert!(slid(&row, false).is_empty(), "which end is the right one depends on where the camera stands");
        assert!(slid(&[at(1, 0.0, 0.0), at(2, -0.6, 1.0), at(3, 0.6, 0.0)], true).is_empty());
    }

    #[test]
    fn who_skims_a_table_does_not_go_over_it() {
        let skimmed = |text: &str| {
            let via = Some(Via { how: Pass::Over, objects: vec![7] });
            let mut steps = [Step { via, ..step(text, Move::FlyThrough, 5) }];
            let table = Object::from_box(7, "oak table", glam::DVec3::ZERO, glam::DVec3::ONE);
            skim_tops(&linked(text), &[table], &mut steps);
            (steps[0].movement, steps[0].via.is_none(), steps[0].end.angle)
        };
        let level = (Move::Follow, true, Some(ShotAngle::EyeLevel));
        assert_eq!(skimmed("across <obj-1> to <obj-0> , low , just above the wood"), level);
        assert_eq!(skimmed("to <obj-0> , barely over <obj-1>"), level);
        assert!(!skimmed("to <obj-0> , right over the top of <obj-1>").1);
        assert_eq!(skimmed("fly high over <obj-1> to <obj-0>"), (Move::FlyThrough, false, None));
    }

    #[test]
    fn who_keeps_the_camera_level_does_not_tilt() {
        let banned = |text: &str| {
            let mut program = Program { steps: vec![step(text, Move::CraneUp, 5)], ..Program::default() };
            keep_level(&linked(text), &mut program);
            program.forbidden
        };
        assert_eq!(banned("boom up to <obj-0> . keep her level ."), [Motion::Tilt, Motion::Roll]);
        assert_eq!(banned("boom up to <obj-0> , stay dead level"), [Motion::Tilt, Motion::Roll]);
        assert_eq!(banned("keep the camera level with <obj-0>"), []);
    }

    #[test]
    fn a_rise_ends_over_what_it_leads_to() {
        let text = "lift straight up into an overhead of the whole <obj-1>";
        let mut steps = [step(text, Move::PedestalUp, 5)];
        rise_to_overhead(&linked(text), &mut steps);
        let end = &steps[0].end;
        assert_eq!((end.angle, &end.subjects[..], end.whole), (Some(ShotAngle::Overhead), &[7][..], true));
        let text = "rise over <obj-1>";
        let mut steps = [step(text, Move::PedestalUp, 5)];
        rise_to_overhead(&linked(text), &mut steps);
        assert_eq!(steps[0].end.angle, None);
    }

    #[test]
    fn who_skims_a_table_past_things_goes_from_one_to_the_next() {
        let skimmed = |text: &str| {
            let via = Some(Via { how: Pass::Over, objects: vec![5, 7] });
            let mut steps = [Step { via, words: Some([0, text.len()]), ..Step::of(Move::FlyThrough) }];
            skim_past(&linked(text), &mut steps);
            (steps[0].movement, steps[0].start.subjects.clone(), steps[0].end.subjects.clone())
        };
        let along = (Move::Follow, vec![5], vec![7]);
        assert_eq!(skimmed("skim the wood past <obj-0> and <obj-1> , quite quick"), along);
        assert_eq!(skimmed("fly low over the table past <obj-0> and <obj-1>"), along);
        assert_eq!(skimmed("fly high over <obj-0> and <obj-1>").0, Move::FlyThrough);
    }
}
