//! What the words of a prompt state outright, over what the network reads into them.
//!
//! Enters: a prompt and the program that the network read. Leaves: the program with the directions and the times that the
//! words state. A timeline (`0-3s wide on the table, 3-6s the lamp close`) lists pictures by their times: an entry that
//! is read as a picture is one to show, at first a still one, and then one to which the camera travels.

use cinesplat_language::{Beat, Timeline, is_listed};
use cinesplat_operator::{Framing, Program, Step};
use cinesplat_trajectory::Move;

/// Words of an entry of a timeline that holds a picture.
const HOLDS: &str = "sit sits park parked motionless unmoving hold holds holding freeze freezes frozen stay stays staying \
    still static lock locked pause pauses wait waits rest rests land lands settle settles stop stops \
    keep keeps remain linger lingers";

/// Corrects a program by what the words of its steps state. Says for each step whether it stays: a picture that several
/// steps describe is one step.
pub(super) fn apply(prompt: &str, timeline: Option<&Timeline>, program: &mut Program) -> Vec<bool> {
    for step in &mut program.steps {
        let words = step.words.and_then(|[from, to]| prompt.get(from..to)).unwrap_or_default();
        step.either_way &= !states_direction(step.movement, words);
    }
    let beats = timeline.map_or(&[][..], |timeline| &timeline.beats);
    // The times of a timeline are those of the film: what lies between two parts takes its time from them.
    let lengths: Option<Vec<f64>> = program.steps.iter().map(|step| step.duration_secs).collect();
    if let Some(lengths) = lengths.filter(|_| !beats.is_empty()) {
        program.duration_secs = program.duration_secs.or(Some(lengths.iter().sum()));
    }
    follow_timeline(prompt, beats, &mut program.steps)
}

/// Whether words contain the direction of a move, and not the opposite one.
fn states_direction(movement: Move, words: &str) -> bool {
    const DIRECTIONS: [[&[&str]; 2]; 3] = [
        [&["in", "into", "inward", "inwards", "closer"], &["out", "back", "outward", "outwards", "away"]],
        [&["left"], &["right"]],
        [&["up", "upward", "upwards"], &["down", "downward", "downwards"]],
    ];
    // `Right here` is no direction.
    let words = words.to_lowercase().replace("right where", "").replace("right here", "").replace("right there", "");
    let has = |list: &[&str]| words.split(|c: char| !c.is_alphanumeric()).any(|word| list.contains(&word));
    let (axis, end) = match movement {
        Move::PushIn | Move::ZoomIn | Move::DollyZoomIn => (0, 0),
        Move::PullOut | Move::ZoomOut | Move::DollyZoomOut => (0, 1),
        Move::PanLeft | Move::TruckLeft | Move::OrbitLeft | Move::ArcLeft => (1, 0),
        Move::PanRight | Move::TruckRight | Move::OrbitRight | Move::ArcRight => (1, 1),
        Move::TiltUp | Move::PedestalUp | Move::CraneUp => (2, 0),
        Move::TiltDown | Move::PedestalDown | Move::CraneDown => (2, 1),
        _ => return false,
    };
    has(DIRECTIONS[axis][end]) && !has(DIRECTIONS[axis][1 - end])
}

/// Turns the entries of a timeline that name no move into the pictures that they describe. Only where every step belongs
/// to an entry, and every entry has one.
fn follow_timeline(prompt: &str, beats: &[Beat], steps: &mut [Step]) -> Vec<bool> {
    let mut stays = vec![true; steps.len()];
    let within = |step: &Step, beat: &Beat| {
        step.words.is_some_and(|[from, to]| (beat.start..beat.bytes[1]).contains(&from.midpoint(to)))
    };
    let beat_of = |step: &Step| beats.iter().position(|beat| within(step, beat));
    let places: Option<Vec<usize>> = steps.iter().map(beat_of).collect();
    let Some(places) = places.filter(|places| (0..beats.len()).all(|i| places.contains(&i))) else { return stays };
    for (index, beat) in beats.iter().enumerate() {
        let text = prompt.get(beat.bytes[0]..beat.bytes[1]).unwrap_or_default();
        let own: Vec<usize> = (0..steps.len()).filter(|&i| places[i] == index).collect();
        let moves = |&i: &usize| steps[i].cut || !matches!(steps[i].movement, Move::Static | Move::Follow);
        if beat.length.is_none() || holds(text) || own.iter().any(moves) {
            continue;
        }
        let others: Vec<Framing> = own[1..].iter().map(|&i| steps[i].end.clone()).collect();
        let lengths = own.iter().filter_map(|&i| steps[i].duration_secs);
        let secs = lengths.reduce(|sum, secs| sum + secs);
        own[1..].iter().for_each(|&i| stays[i] = false);
        show(&mut steps[own[0]], &others, index > 0, secs);
    }
    stays
}

/// Makes a step show the picture of an entry: a still one, or where there is one before it, one to which the camera
/// travels. `others` are framings that describe the same picture.
fn show(step: &mut Step, others: &[Framing], travels: bool, secs: Option<f64>) {
    for other in others {
        if step.end.subjects.is_empty() {
            step.end.subjects.clone_from(&other.subjects);
        }
        step.end.size = step.end.size.or(other.size);
        step.end.angle = step.end.angle.or(other.angle);
        step.end.whole |= other.whole;
    }
    let shows = !step.end.subjects.is_empty() || step.end.size.is_some();
    step.movement = if travels && shows { Move::Follow } else { Move::Static };
    step.with.clear();
    step.amount = None;
    step.either_way = false;
    step.duration_secs = secs;
}

fn holds(text: &str) -> bool {
    let text = text.to_lowercase();
    text.split(|c: char| !c.is_alphanumeric()).any(|word| is_listed(HOLDS, word))
}
