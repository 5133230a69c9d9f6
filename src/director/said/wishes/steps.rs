//! The film of some stations.

use cinesplat_operator::{Amount, Framing, Pass, Speed, Step, Via};
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

use super::stations::{Station, Subject};
use super::things::Things;

/// How the film goes.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Manner {
    pub(super) speed: Speed,
    /// Seconds of a rest at each station, and at the last one.
    pub(super) rest_secs: Option<f64>,
    pub(super) last_secs: Option<f64>,
    /// Share of the height of the frame of what is visited, percent.
    pub(super) share: Option<f64>,
    /// From small things to large ones.
    pub(super) grows: bool,
    /// Height of a standing person, scene units.
    pub(super) height: Option<f64>,
}

/// How long the last picture from a place is held.
const LAST_SECS: f64 = 3.0;
const STOP_SECS: f64 = 1.5;
/// A little way round a thing.
const CIRCLED_DEG: f64 = 40.0;
/// A canvas is about two thirds of its easel.
const CANVAS: f64 = 1.5;

/// The steps of a film that goes from station to station.
pub(super) fn steps(stations: &[Station], things: &Things<'_>, (manner, spans): (&Manner, &[[usize; 2]])) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    for (nth, station) in stations.iter().enumerate() {
        let first = steps.len();
        add(&mut steps, (nth, station), stations, things, manner);
        let own = spans.get(station.words.clone()).unwrap_or_default();
        let words = own.first().zip(own.last()).map(|(first, last)| [first[0], last[1].max(first[1])]);
        steps[first..].iter_mut().for_each(|step| step.words = words);
    }
    steps
}

/// Adds the steps to a station and on it.
fn add(
    steps: &mut Vec<Step>,
    (nth, station): (usize, &Station),
    stations: &[Station],
    things: &Things<'_>,
    manner: &Manner,
) {
    let is_last = nth + 1 == stations.len();
    let end = match &station.subject {
        // What was shown one by one is complete at last.
        Subject::Things(ids) if is_shown(ids, &stations[..nth]) => {
            Framing { subjects: ids.clone(), whole: true, ..Framing::default() }
        }
        Subject::Things(ids) => framing(ids, station, things, manner),
        Subject::Place => Framing { size: Some(ShotSize::Long), ..Framing::default() },
        Subject::From { eye, seen, stands } => {
            steps.push(from_place(eye, seen, stations, things, manner.height.filter(|_| *stands)));
            return;
        }
    };
    let rest = manner.rest_secs.or(station.rests.then_some(STOP_SECS));
    let rest = if is_last { manner.last_secs.or(rest) } else { rest };
    let mut step =
        Step { end: end.clone(), speed: manner.speed, ..Step::of(movement((nth, station), stations, things, manner)) };
    if nth == 0 && rest.is_some() && step.movement == Move::PushIn {
        // The first rest is the opening.
        steps.push(Step { duration_secs: rest, end, ..Step::of(Move::Static) });
        return;
    }
    if step.movement == Move::PanRight {
        (step.end, step.either_way) = (Framing::default(), true);
    }
    steps.push(step);
    if station.is_circled {
        let amount = Some(Amount::Degrees(CIRCLED_DEG));
        steps.push(Step {
            end: end.clone(),
            amount,
            either_way: true,
            speed: manner.speed,
            ..Step::of(Move::ArcRight)
        });
    }
    if let Some(secs) = rest.filter(|_| station.subject != Subject::Place) {
        steps.push(Step { duration_secs: Some(secs), end, ..Step::of(Move::Static) });
    }
}

/// The move that leads to a station.
fn movement((nth, station): (usize, &Station), stations: &[Station], things: &Things<'_>, manner: &Manner) -> Move {
    match &station.subject {
        Subject::Place if nth == 0 => Move::PanRight,
        Subject::Place => Move::PullOut,
        _ if nth > 0 && (manner.grows || manner.share.is_some()) => Move::Follow,
        _ if nth == 0 && manner.grows => Move::Static,
        Subject::Things(ids) if nth > 0 && is_shown(ids, &stations[..nth]) => Move::PullOut,
        // A way in to a table ends under it.
        Subject::Things(ids) if nth > 0 && is_table(ids, things) && !station.is_close => Move::Follow,
        _ => Move::PushIn,
    }
}

/// Whether a thing is one that others stand on.
fn is_table(ids: &[u32], things: &Things<'_>) -> bool {
    let is_one = |id: &u32| things.is_called(*id, "desk table workbench counter bench");
    ids.len() == 1 && ids.iter().all(is_one)
}

/// Whether all of some things were shown one by one.
fn is_shown(ids: &[u32], before: &[Station]) -> bool {
    let shown =
        |id: &u32| before.iter().any(|station| matches!(&station.subject, Subject::Things(own) if own.contains(id)));
    ids.len() > 1 && ids.iter().all(shown)
}

/// The picture of the things of a station.
fn framing(ids: &[u32], station: &Station, things: &Things<'_>, manner: &Manner) -> Framing {
    let framing = Framing { subjects: ids.to_vec(), ..Framing::default() };
    let is_one = ids.len() == 1;
    if let Some(share) = manner.share.filter(|_| is_one) {
        let is_easel = things.get(ids[0]).is_some_and(|object| object.label.contains("easel"));
        let frac = if is_easel { (share * CANVAS / 100.0).min(1.2) } else { share / 100.0 };
        return Framing { height_frac: Some(frac), angle: Some(ShotAngle::EyeLevel), ..framing };
    }
    match (station.is_close && things.are_small(ids), is_one) {
        (true, _) => Framing { size: Some(ShotSize::CloseUp), ..framing },
        _ if station.is_close && is_one => Framing { size: Some(ShotSize::CloseUp), ..framing },
        (_, false) if things.are_small(ids) && ids.len() <= 3 => Framing { size: Some(ShotSize::Medium), ..framing },
        _ => Framing { whole: true, ..framing },
    }
}

/// The view from a thing.
fn from_place(eye: &[u32], seen: &[u32], stations: &[Station], things: &Things<'_>, height: Option<f64>) -> Step {
    let mut subjects = seen.to_vec();
    if subjects.is_empty() {
        let large = stations.iter().filter_map(|station| match &station.subject {
            Subject::Things(ids) if !things.are_small(ids) => Some(ids.clone()),
            _ => None,
        });
        let largest = large.max_by(|a, b| things.radius(a).total_cmp(&things.radius(b)));
        subjects = largest.unwrap_or_default();
    }
    let whole = !subjects.is_empty();
    let size = (!whole).then_some(ShotSize::Long);
    Step {
        end: Framing { subjects, whole, size, height, ..Framing::default() },
        via: Some(Via { how: Pass::From, objects: eye.to_vec() }),
        duration_secs: Some(LAST_SECS),
        ..Step::of(Move::Static)
    }
}

#[cfg(test)]
mod tests {
    use super::super::stations::Rank;
    use super::*;
    use cinesplat_objects::Object;
    use glam::DVec3;

    fn film(subjects: &[Subject], manner: &Manner) -> Vec<(Move, Vec<u32>)> {
        let at = |id: u32, label: &str, half: f64| {
            Object::from_box(id, label, DVec3::new(f64::from(id), 0.0, 0.0), DVec3::splat(half))
        };
        let objects = [at(1, "mug", 0.05), at(2, "desk", 0.6), at(3, "armchair", 0.5), at(9, "door", 0.5)];
        let station = |subject: &Subject| Station {
            subject: subject.clone(),
            is_close: false,
            rank: Rank::Between,
            rests: false,
            is_circled: false,
            words: 0..0,
        };
        let stations: Vec<Station> = subjects.iter().map(station).collect();
        let steps = steps(&stations, &Things::new(&objects), (manner, &[]));
        steps.into_iter().map(|step| (step.movement, step.end.subjects)).collect()
    }

    #[test]
    fn a_film_goes_from_station_to_station() {
        let subjects = [Subject::Things(vec![1]), Subject::Things(vec![2]), Subject::Place];
        let plain = film(&subjects, &Manner::default());
        assert_eq!(plain, [(Move::PushIn, vec![1]), (Move::Follow, vec![2]), (Move::PullOut, vec![])]);
        let rests = film(&subjects[..2], &Manner { rest_secs: Some(2.0), ..Manner::default() });
        let moves: Vec<Move> = rests.iter().map(|(movement, _)| *movement).collect();
        assert_eq!(moves, [Move::Static, Move::Follow, Move::Static]);
    }

    #[test]
    fn who_stands_at_a_door_sees_the_largest_of_what_was_visited() {
        let from = Subject::From { eye: vec![9], seen: Vec::new(), stands: true };
        let film = film(&[Subject::Things(vec![3]), Subject::Things(vec![1]), from], &Manner::default());
        assert_eq!(film.last(), Some(&(Move::Static, vec![3])));
    }
}
