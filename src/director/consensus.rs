//! Which of several networks' readings of a prompt counts: the one that agrees best with all of them.
//!
//! Networks that were trained apart misread different sentences, so that what two of them read is right more often than what one of
//! them is sure of. The choice is that of the least Bayes risk among the readings (Kumar and Byrne 2004, "Minimum Bayes-risk decoding"):
//! each stands for a share of the truth by its certainty, and what is lost with another is one minus their likeness.

use std::collections::BTreeMap;

use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

use crate::direction::{Direction, Voices};
use crate::said::as_orbit;

/// Likeness of moves that lead to pictures of one kind: a push in and a way to a thing, an orbit and an arc.
const KINDRED: f64 = 0.7;
/// Share of the likeness of two steps that is that of their moves; the rest is that of their things.
const OF_MOVES: f64 = 0.3;

/// The reading with the greatest likeness to all readings, each by its certainty; the first one of several. Without a reading there are no
/// steps.
pub(crate) fn consensus(mut readings: Vec<Direction>) -> Direction {
    let certainties: Vec<f64> = readings.iter().map(Direction::mean_certainty).collect();
    let support = |steps: &[Step]| -> f64 {
        let pairs = readings.iter().zip(&certainties);
        pairs.map(|(other, certainty)| certainty * likeness(steps, &other.program.steps)).sum()
    };
    let supports: Vec<f64> = readings.iter().map(|reading| support(&reading.program.steps)).collect();
    let mut best = 0;
    for (nth, support) in supports.iter().enumerate() {
        if *support > supports[best] {
            best = nth;
        }
    }
    let voices = readings.get(best).map(|chosen| voices(chosen, &readings, &certainties)).unwrap_or_default();
    let mut chosen = if readings.is_empty() { Direction::default() } else { readings.swap_remove(best) };
    for (certainty, voices) in chosen.certainty.iter_mut().zip(voices) {
        certainty.voices = Some(voices);
    }
    chosen
}

/// What the readings, of these certainties, say of each step of the chosen one; nothing if it is the only one.
fn voices(chosen: &Direction, readings: &[Direction], certainties: &[f64]) -> Vec<Voices> {
    let all: f64 = certainties.iter().sum();
    if readings.len() < 2 || all <= 0.0 {
        return Vec::new();
    }
    let of = |step: &Step| {
        let (mut agreement, mut others) = (0.0, BTreeMap::<Move, f64>::new());
        for (reading, certainty) in readings.iter().zip(certainties) {
            let steps = &reading.program.steps;
            let likeness = steps.iter().map(|other| step_likeness(step, other)).fold(0.0, f64::max);
            agreement += certainty * likeness / all;
            let other = steps.iter().find(|other| share_words(step, other)).map(|other| other.movement);
            if let Some(other) = other.filter(|other| likeness == 0.0 && *other != step.movement) {
                *others.entry(other).or_default() += certainty;
            }
        }
        let otherwise = others.into_iter().max_by(|one, other| one.1.total_cmp(&other.1)).map(|(movement, _)| movement);
        Voices { agreement, otherwise }
    };
    chosen.program.steps.iter().map(of).collect()
}

/// Whether two steps come from some of the same words.
fn share_words(one: &Step, other: &Step) -> bool {
    one.words.zip(other.words).is_some_and(|([from, to], [start, end])| start < to && from < end)
}

/// Likeness of programs, 0..=1: the steps that they have in common in this order, over those of the longer one.
fn likeness(some: &[Step], others: &[Step]) -> f64 {
    let longer = some.len().max(others.len());
    if longer == 0 {
        return 1.0;
    }
    let mut before = vec![0.0_f64; others.len() + 1];
    for step in some {
        let mut row = vec![0.0_f64; others.len() + 1];
        for (nth, other) in others.iter().enumerate() {
            row[nth + 1] = row[nth].max(before[nth + 1]).max(before[nth] + step_likeness(step, other));
        }
        before = row;
    }
    before[others.len()] / longer as f64
}

/// Likeness of steps, 0..=1, by their moves and what they are about.
fn step_likeness(one: &Step, other: &Step) -> f64 {
    let is_either = (one.either_way || other.either_way) && one.movement.opposite() == Some(other.movement);
    // A picture at rest is what it shows.
    if one.movement == Move::Static && other.movement == Move::Static && differ_in_size(&one.end, &other.end) {
        return 0.0;
    }
    let of_moves = match (one.movement, other.movement) {
        (own, others) if own == others || is_either => 1.0,
        (own, others) if kind(own) == kind(others) => KINDRED,
        _ => return 0.0,
    };
    let (some, others) = (one.about(), other.about());
    let shared = some.iter().filter(|id| others.contains(id)).count();
    let all = some.len() + others.len() - shared;
    let of_things = if all == 0 { 1.0 } else { shared as f64 / all as f64 };
    of_moves * (OF_MOVES + (1.0 - OF_MOVES) * of_things)
}

/// Whether both of two pictures state a size, and not the same.
fn differ_in_size(one: &Framing, other: &Framing) -> bool {
    let frac = |framing: &Framing| framing.height_frac.map(f64::to_bits);
    one.size.zip(other.size).is_some_and(|(own, other)| own != other)
        || frac(one).zip(frac(other)).is_some_and(|(own, other)| own != other)
}

/// The move that stands for all that lead to pictures of its kind.
fn kind(movement: Move) -> Move {
    match movement {
        Move::PedestalUp => Move::CraneUp,
        Move::PedestalDown => Move::CraneDown,
        Move::Follow | Move::FlyThrough => Move::PushIn,
        other => as_orbit(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::StepCertainty;
    use crate::said::fixture::{about, direction};

    fn reading(steps: &[(Move, &[u32])], probability: f64) -> Direction {
        let mut reading = direction(steps.iter().map(|(movement, ids)| about(*movement, ids, [0, 1])).collect());
        reading.certainty = vec![StepCertainty::of(probability, None); steps.len()];
        reading
    }

    fn chosen(readings: &[Direction]) -> Vec<Move> {
        consensus(readings.to_vec()).program.steps.iter().map(|step| step.movement).collect()
    }

    #[test]
    fn two_that_agree_outvote_a_surer_one() {
        let arc = || reading(&[(Move::ArcLeft, &[1])], 0.4);
        let pan = reading(&[(Move::PanLeft, &[1])], 0.6);
        assert_eq!(chosen(&[pan.clone(), arc(), arc()]), [Move::ArcLeft]);
        assert_eq!(chosen(&[pan.clone(), arc()]), [Move::PanLeft], "the surer one of two");
        assert_eq!(chosen(&[reading(&[(Move::PanLeft, &[1])], 0.9), arc(), arc()]), [Move::PanLeft]);
    }

    #[test]
    fn readings_that_differ_a_little_support_each_other() {
        let long = reading(&[(Move::RackFocus, &[1, 2]), (Move::TruckLeft, &[])], 0.3);
        let longer = reading(&[(Move::Static, &[1]), (Move::RackFocus, &[1, 2]), (Move::TruckLeft, &[])], 0.3);
        let short = reading(&[(Move::RackFocus, &[1, 2])], 0.35);
        assert_eq!(chosen(&[short, long, longer]), [Move::RackFocus, Move::TruckLeft]);
        let orbit = reading(&[(Move::OrbitRight, &[7])], 0.3);
        let arc = reading(&[(Move::ArcRight, &[7])], 0.35);
        let other = reading(&[(Move::OrbitRight, &[8])], 0.4);
        assert_eq!(chosen(&[other, orbit, arc]), [Move::OrbitRight]);
    }

    #[test]
    fn pictures_at_rest_of_other_sizes_are_not_alike() {
        let sized = |frac| {
            let mut reading = reading(&[(Move::Static, &[1])], 0.4);
            reading.program.steps[0].end.height_frac = Some(frac);
            reading
        };
        let push = reading(&[(Move::PushIn, &[1])], 0.5);
        assert_eq!(chosen(&[push.clone(), sized(0.25), sized(0.6)]), [Move::PushIn]);
        assert_eq!(chosen(&[push, sized(0.25), sized(0.25)]), [Move::Static]);
    }

    #[test]
    fn one_reading_or_none_stays_as_it_is() {
        assert_eq!(chosen(&[reading(&[(Move::PanLeft, &[1])], 0.1)]), [Move::PanLeft]);
        assert_eq!(consensus(Vec::new()), Direction::default());
        let nothing = reading(&[], 0.0);
        assert_eq!(chosen(&[nothing, reading(&[(Move::PanLeft, &[1])], 0.1)]), [Move::PanLeft]);
    }

    #[test]
    fn each_step_knows_who_agrees_and_what_others_take_it_for() {
        let chosen = consensus(vec![
            reading(&[(Move::ArcLeft, &[1]), (Move::Static, &[1])], 0.4),
            reading(&[(Move::ArcLeft, &[1]), (Move::PushIn, &[1])], 0.2),
            reading(&[(Move::ArcLeft, &[1])], 0.2),
        ]);
        let voices: Vec<Voices> = chosen.certainty.iter().filter_map(|certainty| certainty.voices).collect();
        assert_eq!(voices.len(), 2);
        assert!((voices[0].agreement - 1.0).abs() < 1e-9 && voices[0].otherwise.is_none(), "{voices:?}");
        assert!((voices[1].agreement - 0.5).abs() < 1e-9, "{voices:?}");
        assert_eq!(voices[1].otherwise, Some(Move::ArcLeft), "the fixture's steps share their words");
        let alone = consensus(vec![reading(&[(Move::ArcLeft, &[1])], 0.4)]);
        assert_eq!(alone.certainty[0].voices, None);
    }

    #[test]
    fn a_way_that_is_open_is_like_both() {
        let either = |mut reading: Direction| {
            reading.program.steps[0].either_way = true;
            reading
        };
        let open = either(reading(&[(Move::PanRight, &[1])], 0.3));
        assert!(likeness(&open.program.steps, &reading(&[(Move::PanLeft, &[1])], 0.3).program.steps) > 0.99);
        let shut = reading(&[(Move::PanRight, &[1])], 0.3);
        assert!(likeness(&shut.program.steps, &reading(&[(Move::PanLeft, &[1])], 0.3).program.steps) < 0.01);
    }
}
