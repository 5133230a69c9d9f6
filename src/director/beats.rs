//! Reads a timeline part by part.
//!
//! Enters: a linked prompt with its timeline. Leaves: one direction of all parts in order. A part without a subject is
//! about the subject of the part before, and its steps last as long as the timeline says.

use cinesplat_language::{Beat, BeatLength, Linked, Timeline};
use cinesplat_operator::{Framing, Motion, Program, Step};
use cinesplat_trajectory::{Move, ShotSize};

use crate::compositions::leading_move;
use crate::direction::Direction;
use crate::error::DirectorError;
use crate::said::{asks_for, is_form};

/// Words that begin a part that holds where the part before arrives.
const LANDS: [&str; 6] = ["land", "lands", "settle", "settles", "rest", "rests"];

/// Words that begin a part where the way of the part before ends.
const ARRIVES: [&str; 3] = ["arrive", "arrives", "arriving"];

/// Words of a part that only says that the camera is on its way.
const ON_THE_WAY: [&str; 8] = ["moving", "move", "moves", "travel", "traveling", "travelling", "travels", "transit"];

/// Words of a part that rests.
const HOLDS: [&str; 8] = ["hold", "static", "stay", "still", "rest", "pause", "freeze", "lock"];

/// Reads the parts of `linked`, which is a timeline, each with `read`. The first part is about `subjects`, unless it or
/// the introduction names others.
///
/// # Errors
/// Those of `read`.
pub(crate) fn direct_beats(
    linked: &Linked,
    timeline: &Timeline,
    subjects: &[u32],
    read: &dyn Fn(&Linked) -> Result<Direction, DirectorError>,
) -> Result<Direction, DirectorError> {
    let mut whole =
        Direction { program: Program::default(), step_cameras: Vec::new(), certainty: Vec::new(), unmet: Vec::new() };
    let (mut subjects, mut opening) = (subjects.to_vec(), Framing::default());
    if linked.words_in(timeline.introduction).any(|(word, _)| word.starts_with(char::is_alphabetic)) {
        let introduction = read(&linked.part(timeline.introduction, None))?;
        let steps = &introduction.program.steps;
        // A move before the first part is not of the list: the times are about something else.
        if steps.iter().any(|step| step.movement != Move::Static) {
            return read(linked);
        }
        opening = steps.last().map(|step| step.end.clone()).filter(|end| end.size.is_some()).unwrap_or_default();
        if let Some(shown) = steps.last().map(|step| &step.end.subjects).filter(|shown| !shown.is_empty()) {
            subjects.clone_from(shown);
        }
        whole.program = Program { steps: Vec::new(), ..introduction.program };
        whole.unmet = introduction.unmet;
    }
    let mut lengths = Vec::with_capacity(timeline.beats.len());
    let mut bans = Vec::new();
    let is_by_cuts = timeline.beats.iter().skip(1).all(|beat| beat.cut && beat.length.is_none());
    for beat in &timeline.beats {
        let mut direction = read_beat(linked, beat, linked.id_of(&subjects), read)?;
        // `The camera cuts to the vase` has nothing before its cut.
        if is_by_cuts && (direction.program.steps.is_empty() || says_nothing(linked, beat)) {
            return read(linked);
        }
        rest_on_arrival(linked, beat, &whole.program.steps, &mut direction.program.steps);
        land(&mut whole.program.steps, &direction.program.steps);
        carry_on(&mut direction, &mut subjects);
        if is_moment(linked, timeline, beat, &direction.program.steps) && arrive(&mut whole, &direction, beat) {
            bans.extend(direction.program.forbidden.into_iter().map(|motion| (motion, lengths.len())));
            if timeline.beats.last() == Some(beat) {
                lead_between_pictures(&mut whole.program.steps);
            }
            lengths.push((whole.program.steps.len(), Some(0.0)));
            continue;
        }
        let stated = direction.program.duration_secs;
        if let Some(BeatLength::Share(share)) = beat.length {
            // The last part may state the length of the film, any other one its own.
            let is_last = lengths.len() + 1 == timeline.beats.len();
            let total = stated.map(|secs| if is_last { secs } else { secs / share });
            whole.program.duration_secs = whole.program.duration_secs.or(total);
        }
        let first = whole.program.steps.len();
        if let Some(step) = direction.program.steps.first_mut() {
            step.cut |= beat.cut;
            if step.start == Framing::default() && step.movement != Move::Static {
                step.start = std::mem::take(&mut opening);
            }
            opening = Framing::default();
        }
        for step in &mut direction.program.steps {
            step.words = Some([beat.start, beat.bytes[1]]);
        }
        whole.program.steps.append(&mut direction.program.steps);
        bans.extend(direction.program.forbidden.into_iter().map(|motion| (motion, lengths.len())));
        whole.step_cameras.append(&mut direction.step_cameras);
        whole.certainty.append(&mut direction.certainty);
        whole.unmet.append(&mut direction.unmet);
        let is_of_film = is_by_cuts && states_film_length(linked, beat);
        if is_of_film {
            whole.program.duration_secs = whole.program.duration_secs.or(stated);
        }
        lengths.push((first, stated.filter(|_| !is_of_film)));
    }
    for (motion, beat) in bans {
        let is_of_beat = |nth: usize| nth >= lengths[beat].0 && lengths.get(beat + 1).is_none_or(|next| nth < next.0);
        let mut steps = whole.program.steps.iter().enumerate();
        // A ban holds where it is said: another part may ask for that very motion.
        let is_asked = steps.any(|(nth, step)| !is_of_beat(nth) && asks_for(step, motion));
        if !is_asked {
            whole.program.forbid(motion);
        }
    }
    turn_in_place(&mut whole.program);
    time_beats(linked, timeline, &lengths, &mut whole.program);
    Ok(whole)
}

/// Gives the steps of each part their lengths: `lengths` are the first step of each part and the length that its words state.
fn time_beats(linked: &Linked, timeline: &Timeline, lengths: &[(usize, Option<f64>)], program: &mut Program) {
    let total_secs = program.duration_secs.or_else(|| secs_of_shares(timeline));
    let (mut all_timed, mut on_the_way_secs) = (true, 0.0);
    for (nth, (beat, (first, stated))) in timeline.beats.iter().zip(lengths).enumerate() {
        let end = lengths.get(nth + 1).map_or(program.steps.len(), |next| next.0);
        let secs = secs_of(beat, *stated, total_secs).map(|secs| secs + std::mem::take(&mut on_the_way_secs));
        all_timed &= secs.is_some();
        // The next part says where to.
        if *first == end && is_on_the_way(linked, beat) {
            on_the_way_secs = secs.unwrap_or_default();
            continue;
        }
        if let Some(secs) = secs.filter(|secs| *secs > 0.0) {
            spread(&mut program.steps[*first..end], secs);
        }
    }
    // The parts decide how long the film is.
    if all_timed {
        program.duration_secs = None;
    }
}

/// Whether a part is a picture of one moment, and no rest: `t=0 wide of the vase, t=4 close on it`. Its steps are given.
fn is_moment(linked: &Linked, timeline: &Timeline, beat: &Beat, steps: &[Step]) -> bool {
    let holds = linked.words_in(beat.bytes).any(|(word, _)| HOLDS.iter().any(|verb| is_form(word, verb)));
    let is_last_code = timeline.beats.last() == Some(beat)
        && beat.length.is_none()
        && timeline.beats.iter().all(|other| !other.cut && (other == beat || other.secs().is_some()));
    let rests = matches!(steps, [step] if step.movement == Move::Static && step.with.is_empty());
    beat.secs() == Some(0.0) || is_last_code && rests && !holds
}

/// Ends the picture of the part before, which rests, at the picture of a moment: the way between them takes the time of that
/// part. Says whether it does.
fn arrive(whole: &mut Direction, moment: &Direction, beat: &Beat) -> bool {
    let (Some(before), Some(picture)) = (whole.program.steps.last_mut(), moment.program.steps.last()) else {
        return false;
    };
    let (start, end) = (&before.end, &picture.end);
    let rests = before.movement == Move::Static && before.with.is_empty() && before.start == Framing::default();
    if !rests || start.subjects.is_empty() || end.subjects.is_empty() || start == end {
        return false;
    }
    let other = start.subjects != end.subjects;
    let (movement, either_way) = leading_move(start, end, &whole.program.forbidden);
    if !other && movement == Move::Static {
        return false;
    }
    (before.movement, before.either_way) = if other { (Move::Follow, false) } else { (movement, either_way) };
    before.start = std::mem::replace(&mut before.end, end.clone());
    before.words = before.words.map(|[from, _]| [from, beat.bytes[1]]);
    if let Some(certainty) = whole.certainty.last_mut() {
        certainty.words = before.words;
    }
    true
}

/// Turns from one thing to the next where the words rule out that the camera travels.
fn turn_in_place(program: &mut Program) {
    if !program.forbidden.contains(&Motion::Travel) {
        return;
    }
    for step in program.steps.iter_mut().filter(|step| step.movement == Move::Follow && step.via.is_none()) {
        (step.movement, step.either_way) = (Move::PanRight, true);
    }
}

/// Makes ways of all rests before a picture at which the film ends: `t=0 the chair, t=2.5 the television, t=5 the vase` says where the
/// camera looks at each moment. Where a part does more than to show something, its rests are rests.
fn lead_between_pictures(steps: &mut [Step]) {
    let Some((last, before)) = steps.split_last_mut() else { return };
    let plain = |step: &Step| Step { end: step.end.clone(), words: step.words, ..Step::of(Move::Static) };
    let is_picture = |step: &Step| *step == plain(step) && !step.end.subjects.is_empty();
    if before.is_empty() || !before.iter().all(is_picture) {
        return;
    }
    let mut next = std::mem::take(&mut last.start);
    for step in before.iter_mut().rev() {
        step.movement = Move::Follow;
        let own = std::mem::replace(&mut step.end, next);
        next = own.clone();
        step.start = own;
    }
    for step in before.iter_mut().skip(1) {
        step.start = Framing::default();
    }
}

/// Reads one part; pronouns stand for `antecedent`.
fn read_beat(
    linked: &Linked,
    beat: &Beat,
    antecedent: Option<u32>,
    read: &dyn Fn(&Linked) -> Result<Direction, DirectorError>,
) -> Result<Direction, DirectorError> {
    let mut part = linked.part(beat.bytes, antecedent);
    let mut direction = read(&part)?;
    // `start rising` is a rise.
    if let Some(bytes) = without_start(linked, beat.bytes).filter(|_| direction.program.steps.is_empty()) {
        part = linked.part(bytes, antecedent);
        direction = read(&part)?;
    }
    if let Some(first) = direction.program.steps.first_mut().filter(|first| first.movement == Move::Follow) {
        let opening = part.tokens_text.split(' ').find(|word| word.starts_with(char::is_alphabetic));
        if opening.is_some_and(|word| LANDS.contains(&word)) {
            first.movement = Move::Static;
        }
    }
    Ok(direction)
}

/// Whether the words of a part are only about the camera or the film.
fn says_nothing(linked: &Linked, beat: &Beat) -> bool {
    const EMPTY: [&str; 10] = ["the", "a", "camera", "we", "then", "it", "film", "shot", "video", "clip"];
    linked
        .words_in(beat.bytes)
        .all(|(word, _)| EMPTY.contains(&word) || !word.starts_with(char::is_alphanumeric) && !word.starts_with('<'))
}

/// Whether a part between cuts states the length of the film, not its own: `10 second film: ..`, `.. Eight seconds.`
fn states_film_length(linked: &Linked, beat: &Beat) -> bool {
    const WHOLES: [&str; 10] =
        ["film", "clip", "video", "reel", "spot", "total", "overall", "altogether", "movie", ":"];
    const ENDS: [&str; 5] = ["", ".", ";", "!", ":"];
    let words = linked.texts_in(beat.bytes);
    let word = |at: usize| words.get(at).copied().unwrap_or_default();
    let is_film = |at: usize| {
        let before = at.checked_sub(1).map_or("", word);
        let opens = words[..at].iter().all(|word| linked.slot_at(word).is_none()) && beat.bytes[0] == 0;
        let is_sentence = ENDS.contains(&before) && (at > 0 || opens) && ENDS.contains(&word(at + 1));
        is_sentence || WHOLES.contains(&word(at + 1)) || WHOLES.contains(&before) || opens && word(at + 1) == "."
    };
    (0..words.len()).any(|at| linked.is_quantity(words[at]) && is_film(at))
}

/// The bytes of a part after the word by which it starts: `start rising`. `None` for other parts.
fn without_start(linked: &Linked, [from, to]: [usize; 2]) -> Option<[usize; 2]> {
    let mut words = linked.words_in([from, to]);
    let (first, _) = words.next()?;
    let starts = matches!(first, "start" | "starts" | "starting" | "begin" | "begins" | "beginning");
    words.next().filter(|_| starts).map(|(_, span)| [span[0], to])
}

/// Shortest part of a film that states only shares, and the longest such film; seconds.
const LEAST_SHARE_SECS: f64 = 3.0;
const MOST_SHARED_SECS: f64 = 30.0;

/// The length of a film of which all parts are shares: the shortest part has time enough.
fn secs_of_shares(timeline: &Timeline) -> Option<f64> {
    let share = |beat: &Beat| match beat.length {
        Some(BeatLength::Share(share)) if share > 0.0 => Some(share),
        _ => None,
    };
    let shares: Option<Vec<f64>> = timeline.beats.iter().map(share).collect();
    let least = shares?.into_iter().reduce(f64::min)?;
    Some((LEAST_SHARE_SECS / least).min(MOST_SHARED_SECS))
}

/// The length of a part. `stated_secs` is what its own words say, `total_secs` the length of the film.
fn secs_of(beat: &Beat, stated_secs: Option<f64>, total_secs: Option<f64>) -> Option<f64> {
    match beat.length {
        Some(BeatLength::Secs(secs)) => Some(secs),
        Some(BeatLength::Share(share)) => total_secs.map(|total| total * share),
        None => stated_secs,
    }
}

/// Spreads the length of a part over its steps: those with a length of their own keep it where that leaves room for the
/// others, and the rest is shared evenly. Lengths that leave no room are scaled.
fn spread(steps: &mut [Step], secs: f64) {
    let stated: f64 = steps.iter().filter_map(|step| step.duration_secs).sum();
    let num_open = steps.iter().filter(|step| step.duration_secs.is_none()).count();
    let (scale, rest) = match num_open {
        0 => (secs / stated.max(1e-9), 0.0),
        _ if stated < 0.9 * secs => (1.0, (secs - stated) / num_open as f64),
        _ => {
            let even = secs / steps.len().max(1) as f64;
            (even * (steps.len() - num_open) as f64 / stated, even)
        }
    };
    for step in steps {
        step.duration_secs = Some(step.duration_secs.map_or(rest, |own| own * scale));
    }
}

/// Rests where the way of the part before ends: `0:07 passing the jar | 0:10 arrive at the ladles`.
fn rest_on_arrival(linked: &Linked, beat: &Beat, before: &[Step], part: &mut [Step]) {
    let opening = linked.words_in(beat.bytes).map(|(word, _)| word).find(|word| word.starts_with(char::is_alphabetic));
    let arrives = beat.secs().is_some() && opening.is_some_and(|word| ARRIVES.contains(&word));
    let is_open = |step: &Step| step.movement != Move::Static && step.end == Framing::default();
    let first = part.first_mut().filter(|first| matches!(first.movement, Move::Follow | Move::PushIn));
    if let Some(first) = first.filter(|_| arrives && before.last().is_some_and(is_open)) {
        first.movement = Move::Static;
    }
}

/// Whether a part only says that the camera moves: `0:03 moving.`
fn is_on_the_way(linked: &Linked, beat: &Beat) -> bool {
    let words = linked.texts_in(beat.bytes);
    !words.is_empty() && words.iter().all(|word| ON_THE_WAY.contains(word) || !word.starts_with(char::is_alphanumeric))
}

/// A turn or a travel without an end goes to what the next part holds on: `0:03 pan right | 0:06 land on the vase`.
fn land(before: &mut [Step], part: &[Step]) {
    let (Some(last), Some(first)) = (before.last_mut(), part.first()) else { return };
    if first.movement == Move::Static && last.movement != Move::Static && last.end == Framing::default() {
        last.end.subjects.clone_from(&first.end.subjects);
    }
}

/// Gives steps without a subject that of the step before, where the move has one; `subjects` are those of the part
/// before, and become those of this part.
fn carry_on(direction: &mut Direction, subjects: &mut Vec<u32>) {
    let steps = &mut direction.program.steps;
    for step in steps {
        let is_open = step.end.subjects.is_empty() && step.start.subjects.is_empty() && step.via.is_none();
        if is_open && takes_subject(step.movement) && !frames_room(&step.end) {
            step.end.subjects.clone_from(subjects);
        }
        // A turn begins at the picture that is there.
        if step.movement.looks_elsewhere()
            && !step.end.subjects.is_empty()
            && !subjects.is_empty()
            && step.start.subjects != *subjects
        {
            step.start = Framing::default();
        }
        if !step.end.subjects.is_empty() {
            subjects.clone_from(&step.end.subjects);
        }
    }
}

/// Whether a move is about a subject even where its words name none.
fn takes_subject(movement: Move) -> bool {
    !matches!(
        movement,
        Move::PanLeft
            | Move::PanRight
            | Move::TiltUp
            | Move::TiltDown
            | Move::RollCw
            | Move::RollCcw
            | Move::TruckLeft
            | Move::TruckRight
            | Move::PedestalUp
            | Move::PedestalDown
            | Move::FlyThrough
            | Move::Follow
            | Move::WhipPan
            | Move::Reveal
    )
}

/// Whether a framing without subjects is one of the room.
fn frames_room(framing: &Framing) -> bool {
    matches!(framing.size, Some(ShotSize::Long | ShotSize::ExtremeLong | ShotSize::MediumLong))
}
