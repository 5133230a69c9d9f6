//! Pictures that planners describe at a moment of the film: `Opening composition: the skull dead centre, 15 % of frame
//! height`, `the ladles are centred in the first frame, the knives in the last`.
//!
//! Enters: a linked prompt. Leaves: the direction of the words that are left without such descriptions, with each picture
//! written into the start or the end of the step that it belongs to. A description is no step of its own. Where nothing
//! but a first and a last picture is left, the move is the one that leads from one to the other.

mod clauses;
mod instants;
mod moments;
mod moves;
mod picture;
mod words;

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

use crate::direction::Direction;
use crate::error::DirectorError;
use clauses::{Clause, clauses};
use instants::without_instants;
use moments::Moment;
pub(crate) use moves::leading_move;
use moves::{has_words, names_move, turns_towards};
use picture::Picture;

/// A picture at a moment, with its bytes of the prompt.
struct Described {
    clause: Clause,
    picture: Picture,
}

/// Reads a prompt; pronouns at its start stand for the given objects.
type Read<'a> = &'a dyn Fn(&Linked, &[u32]) -> Result<Direction, DirectorError>;

/// The direction of a prompt, read with `read` without the pictures that it describes.
///
/// # Errors
/// Those of `read`.
pub(crate) fn direct_composed(linked: &Linked, read: Read<'_>) -> Result<Direction, DirectorError> {
    let linked = &without_instants(linked);
    let described = removable(linked, described(linked));
    let has = |moment: Moment| described.iter().any(|described| described.clause.moment == moment);
    let bytes: Vec<[usize; 2]> = described.iter().map(|described| described.clause.bytes).collect();
    let mut subjects = described.iter().map(|described| &described.picture.framing.subjects);
    let subjects = subjects.find(|subjects| !subjects.is_empty()).cloned().unwrap_or_default();
    let rest = linked.without(&bytes, linked.id_of(&subjects));
    let is_led = linked.timeline.is_none() && !names_move(&rest);
    if described.is_empty() || is_led && !(has(Moment::Start) && has(Moment::End)) {
        return read(linked, &[]);
    }
    let mut direction = if has_words(&rest) { read(&rest, &subjects)? } else { read(linked, &[])? };
    if direction.program.steps.is_empty() {
        direction = read(linked, &[])?;
    }
    if is_led {
        lead(linked, &described, &mut direction);
    } else {
        described.iter().for_each(|described| write(linked, described, &mut direction));
        turns_towards(&mut direction.program.steps);
        reveal(&described, &mut direction.program.steps);
    }
    let end_secs = described.iter().filter_map(|described| described.clause.end_secs).reduce(f64::max);
    if linked.timeline.is_none() && direction.program.steps.iter().all(|step| step.duration_secs.is_none()) {
        direction.program.duration_secs = direction.program.duration_secs.or(end_secs);
    }
    Ok(direction)
}

/// The pictures without those that are all there is of a part of a timeline, and without those that alone name what stays
/// in the picture throughout.
fn removable(linked: &Linked, mut described: Vec<Described>) -> Vec<Described> {
    // `.. and finish with the ladles centred` is the end of a move, unless a first picture is described as well.
    let moments: Vec<Moment> = described.iter().map(|described| described.clause.moment).collect();
    let is_pair = moments.contains(&Moment::Start) && moments.contains(&Moment::End);
    described.retain(|described| is_pair || !described.clause.is_verb);
    let bytes: Vec<[usize; 2]> = described.iter().map(|described| described.clause.bytes).collect();
    let rest = linked.without(&bytes, None);
    let beats = linked.timeline.iter().flat_map(|timeline| &timeline.beats);
    let emptied: Vec<[usize; 2]> = beats
        .map(|beat| beat.bytes)
        .filter(|bytes| !rest.words_in(*bytes).any(|(word, _)| word.starts_with(char::is_alphabetic)))
        .collect();
    described
        .retain(|Described { clause, .. }| !emptied.iter().any(|[from, to]| (*from..*to).contains(&clause.bytes[0])));
    let of_moment = |described: &&Described| described.clause.moment != Moment::Throughout;
    let framed = described.iter().filter(of_moment).flat_map(|described| described.picture.framing.subjects.clone());
    let named: Vec<u32> = linked.expanded(&rest.slots).into_iter().chain(framed).collect();
    let is_named = |id: &u32| named.contains(id);
    let has_moment = described.iter().any(|described| of_moment(&described));
    described.retain(|Described { clause, picture }| {
        let subjects = &picture.framing.subjects;
        let is_of_all =
            if picture.is_shared { subjects.iter().any(is_named) } else { has_moment && subjects.iter().all(is_named) };
        clause.moment != Moment::Throughout || is_of_all
    });
    described
}

/// The pictures that the words describe. One without a subject is of the subject before, and one that says only which
/// thing or how much is built like the one before: `the knives in the last`.
fn described(linked: &Linked) -> Vec<Described> {
    let mut all: Vec<Described> = Vec::new();
    for clause in clauses(linked) {
        let before = all.iter().rev().find(|before| before.clause.moment != Moment::Throughout);
        let Some(mut picture) = Picture::of(linked, &clause, before.map(|before| &before.picture)) else { continue };
        if picture.framing.subjects.is_empty() && !picture.is_room && clause.moment != Moment::Throughout {
            let described = before.map(|before| before.picture.framing.subjects.clone());
            picture.framing.subjects = named_before(linked, &clause).or(described).unwrap_or_default();
        }
        all.push(Described { clause, picture });
    }
    all
}

/// The thing that the sentence of a clause names last before it: `the skull never leaves the frame and ends up centred`.
fn named_before(linked: &Linked, clause: &Clause) -> Option<Vec<u32>> {
    let before = linked.texts_in([0, clause.bytes[0]]);
    let mut sentence = before.iter().rev().take_while(|word| !matches!(**word, "." | ";" | "!" | "?"));
    sentence.find_map(|word| linked.slot_at(word)).map(|id| linked.expanded(&[id]))
}

/// Puts the one move in the place of all steps that leads from the first picture to the last.
fn lead(linked: &Linked, described: &[Described], direction: &mut Direction) {
    while direction.program.steps.len() > 1 {
        direction.remove_step(1);
    }
    let [mut start, mut end] = [Framing::default(), Framing::default()];
    for Described { clause, picture } in described {
        if clause.moment != Moment::End {
            picture.write(linked, &mut start);
        }
        if clause.moment != Moment::Start {
            picture.write(linked, &mut end);
        }
    }
    let program = &mut direction.program;
    let Some(step) = program.steps.first_mut() else { return };
    let lists = [&start.subjects, &end.subjects, &step.end.subjects, &step.start.subjects];
    let shown = lists.into_iter().find(|subjects| !subjects.is_empty()).cloned().unwrap_or_default();
    for (framing, moment) in [(&mut start, Moment::Start), (&mut end, Moment::End)] {
        let is_room = described.iter().any(|other| other.clause.moment == moment && other.picture.is_room);
        if framing.subjects.is_empty() && !is_room {
            framing.subjects.clone_from(&shown);
        }
    }
    // What the words say of the whole film is stated at its start.
    start.height = start.height.or(step.start.height);
    let (movement, either_way) = leading_move(&start, &end, &program.forbidden);
    *step = Step {
        movement,
        either_way,
        start,
        end,
        keep: std::mem::take(&mut step.keep),
        amount: None,
        duration_secs: step.duration_secs,
        speed: step.speed,
        easing: step.easing,
        words: linked.spans.first().zip(linked.spans.last()).map(|(first, last)| [first[0], last[1]]),
        ..Step::of(movement)
    };
    if let Some(certainty) = direction.certainty.first_mut() {
        certainty.words = step.words;
    }
}

/// Makes a slide a reveal that shows at its end what is out of the frame at its start.
fn reveal(described: &[Described], steps: &mut [Step]) {
    let [step] = steps else { return };
    let first = described.iter().filter(|described| described.clause.moment == Moment::Start);
    let hidden = first.flat_map(|described| &described.picture.gone);
    let slides = matches!(step.movement, Move::TruckLeft | Move::TruckRight | Move::PedestalUp | Move::PedestalDown);
    if slides && step.with.is_empty() && hidden.into_iter().any(|id| step.end.subjects.contains(id)) {
        step.with = if step.either_way { Vec::new() } else { vec![step.movement] };
        (step.movement, step.either_way) = (Move::Reveal, false);
    }
}

/// Writes a picture into the steps that it belongs to.
fn write(linked: &Linked, Described { clause, picture }: &Described, direction: &mut Direction) {
    let steps = &mut direction.program.steps;
    let [first, end] = steps_of(linked, clause, steps);
    let Some(last) = end.checked_sub(1).filter(|last| first <= *last) else { return };
    match clause.moment {
        Moment::Start => {
            let Some(step) = steps.get_mut(first) else { return };
            // What holds has one picture.
            picture.write(linked, if step.movement == Move::Static { &mut step.end } else { &mut step.start });
            join_words(direction, first, clause);
        }
        Moment::End => {
            let arrives = arriving(steps, last);
            if arrives < last {
                steps[last].end = Framing::default();
            }
            picture.write(linked, &mut steps[arrives].end);
            join_words(direction, last, clause);
        }
        Moment::Throughout => {
            for step in &mut steps[first..end] {
                picture.write_throughout(linked, step);
            }
            if end == first + 1 {
                join_words(direction, first, clause);
            }
        }
    }
}

/// The steps of the part of a timeline in which a clause stands, as a range; all steps where it stands in none.
fn steps_of(linked: &Linked, clause: &Clause, steps: &[Step]) -> [usize; 2] {
    let beats = linked.timeline.iter().flat_map(|timeline| &timeline.beats);
    let beat = beats.into_iter().find(|beat| (beat.start..beat.bytes[1]).contains(&clause.bytes[0]));
    let is_own = |step: &Step| beat.is_some_and(|beat| step.words.is_some_and(|words| words[0] == beat.start));
    let first = steps.iter().position(is_own);
    let last = steps.iter().rposition(is_own);
    first.zip(last).map_or([0, steps.len()], |(first, last)| [first, last + 1])
}

/// The step that arrives at the last picture of step `last`: a hold shows what the move before it arrives at.
fn arriving(steps: &[Step], last: usize) -> usize {
    let holds = |step: &Step| step.movement == Move::Static && !step.cut;
    let moving = (0..=last).rev().find(|nth| !holds(&steps[*nth]));
    moving.filter(|nth| !steps[*nth + 1..=last].iter().any(|step| step.cut)).unwrap_or(last)
}

/// Adds the words of a picture to those of its step, where no other step's words lie between.
fn join_words(direction: &mut Direction, nth: usize, clause: &Clause) {
    let steps = &mut direction.program.steps;
    let Some(own) = steps[nth].words else { return };
    let joint = [own[0].min(clause.bytes[0]), own[1].max(clause.bytes[1])];
    let overlaps = |words: [usize; 2]| words != own && words[0] < joint[1] && joint[0] < words[1];
    if !steps.iter().filter_map(|step| step.words).any(overlaps) {
        steps[nth].words = Some(joint);
    }
}
