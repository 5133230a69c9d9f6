//! What the words say of the first picture.

use cinesplat_language::{LanguageError, Linked, Senses};
use cinesplat_operator::{Framing, Look, Pass, Step, SubjectPart};
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

use super::directions::is_form;
use super::senses::says;

/// Abbreviations of shot sizes.
const SIZES: [(&str, ShotSize); 14] = [
    ("ecu", ShotSize::ExtremeCloseUp),
    ("xcu", ShotSize::ExtremeCloseUp),
    ("bcu", ShotSize::ExtremeCloseUp),
    ("cu", ShotSize::CloseUp),
    ("mcu", ShotSize::MediumCloseUp),
    ("ms", ShotSize::Medium),
    ("mls", ShotSize::MediumLong),
    ("mws", ShotSize::MediumLong),
    ("ls", ShotSize::Long),
    ("ws", ShotSize::Long),
    ("fs", ShotSize::Long),
    ("els", ShotSize::ExtremeLong),
    ("ews", ShotSize::ExtremeLong),
    ("vws", ShotSize::ExtremeLong),
];

/// The size that a word abbreviates.
pub(crate) fn abbreviated_size(word: &str) -> Option<ShotSize> {
    SIZES.iter().find(|(name, _)| *name == word).map(|(_, size)| *size)
}

/// Opens and ends a travel or a zoom on the sizes that an arrow between them says: `MCU > CU on the cup`.
pub(crate) fn take_sizes(linked: &Linked, steps: &mut [Step]) {
    let changes_size = |step: &&mut Step| {
        matches!(step.movement, Move::PushIn | Move::PullOut | Move::ZoomIn | Move::ZoomOut | Move::Follow)
    };
    for step in steps.iter_mut().filter(changes_size) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_arrow = |word: &&&str| matches!(**word, "to" | "into" | "-" | ">" | "\u{2192}" | "\u{2013}");
        let sizes = words.iter().enumerate().filter_map(|(at, word)| Some((at, abbreviated_size(word)?)));
        let pairs = sizes.filter_map(|(at, first)| {
            let arrows = words[at + 1..].iter().take(3).take_while(is_arrow).count();
            let second = words.get(at + 1 + arrows).and_then(|word| abbreviated_size(word)).filter(|_| arrows > 0)?;
            Some([first, second])
        });
        let nears = matches!(step.movement, Move::PushIn | Move::ZoomIn);
        let leaves = matches!(step.movement, Move::PullOut | Move::ZoomOut);
        // Sizes are listed from the closest to the widest.
        let fits = |[first, second]: &[ShotSize; 2]| !(nears && second > first || leaves && second < first);
        // `ECU > MCU > WS` ends on the last one.
        let pairs: Vec<[ShotSize; 2]> = pairs.filter(fits).collect();
        let is_chain = pairs.windows(2).all(|two| two[0][1] == two[1][0]);
        if let Some((first, last)) = pairs.first().zip(pairs.last()).filter(|_| is_chain) {
            (step.start.size, step.end.size) = (Some(first[0]), Some(last[1]));
            if step.start.subjects.is_empty() {
                step.start.subjects.clone_from(&step.end.subjects);
            }
        }
    }
}

/// Shows a picture that rests as large as the only abbreviation in its words says, and what stands behind it: `00:00 EWS
/// ship`.
pub(crate) fn size_rests(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Static) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let sizes = words.iter().enumerate();
        let mut sizes = sizes.filter_map(|(at, word)| Some((at, abbreviated_size(word)?)));
        let (Some((at, size)), None) = (sizes.next(), sizes.next()) else { continue };
        let shown = words[at + 1..].iter().find(|word| !matches!(**word, "on" | "of" | "the" | "a"));
        let shown = shown.and_then(|word| linked.slot_at(word));
        if let Some(id) = shown.filter(|_| step.end.subjects.is_empty() && step.start == Framing::default()) {
            step.end.subjects = linked.expanded(&[id]);
            step.via = step.via.take().filter(|via| via.objects != step.end.subjects);
        }
        step.end.size = step.end.size.or(Some(size));
    }
}

/// Words that open the film, and the size of the picture that they open on.
pub(super) const OPENS: [&str; 9] =
    ["start", "starts", "starting", "begin", "begins", "beginning", "open", "opens", "opening"];
const OPENING_SIZES: [(&str, ShotSize); 5] = [
    ("tight", ShotSize::CloseUp),
    ("close", ShotSize::CloseUp),
    ("tightly", ShotSize::CloseUp),
    ("wide", ShotSize::Long),
    ("medium", ShotSize::Medium),
];

/// Opens on a picture as large as the words say beside their first one, where another detail of it is all that was read:
/// `start tight on the table from above`.
pub(crate) fn open_as_said(linked: &Linked, steps: &mut [Step]) {
    // What is said before may be a story, and no step of the film.
    let opens = |step: &&mut Step| {
        let words = linked.texts_in(step.words.unwrap_or_default());
        words.iter().any(|word| OPENS.contains(word))
    };
    let Some(step) = steps.iter_mut().find(opens) else { return };
    let framing = if step.movement == Move::Static { &mut step.end } else { &mut step.start };
    let words = linked.texts_in(step.words.unwrap_or_default());
    let said = words.windows(3).find_map(|three| {
        let size = OPENING_SIZES.iter().find(|(word, _)| *word == three[1]).map(|(_, size)| *size)?;
        (OPENS.contains(&three[0]) && matches!(three[2], "on" | "in")).then_some(size)
    });
    if framing.size.is_none() && framing.height_frac.is_none() && !framing.subjects.is_empty() && !framing.whole {
        framing.size = said;
    }
}

/// Words of a picture from straight above, and words by which it is only the last one.
const OVERHEADS: [&str; 6] = ["bird", "birds", "birdseye", "bird's-eye", "topdown", "overhead"];
const LEADS: [&str; 12] =
    ["until", "till", "to", "end", "ends", "ending", "into", "finish", "then", "become", "becomes", "reach"];

/// Begins a rise straight above its subject where nothing leads there: `straight up bird's eye over the keep, looking down`.
pub(crate) fn rise_overhead(linked: &Linked, steps: &mut [Step]) {
    let lifts = |step: &&mut Step| {
        matches!(step.movement, Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown)
    };
    for step in steps.iter_mut().filter(lifts) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_open = step.start == Framing::default() && step.end.angle == Some(ShotAngle::Overhead);
        let says = |list: &[&str]| words.iter().any(|word| list.contains(word));
        // `Up over the plant and look down on it like a bird`.
        let looks_last = words.windows(2).any(|pair| matches!(pair, ["and" | ",", "look"]));
        if is_open && !step.end.subjects.is_empty() && says(&OVERHEADS) && !says(&LEADS) && !looks_last {
            step.start.angle = step.end.angle;
            step.start.subjects.clone_from(&step.end.subjects);
        }
    }
}

/// Words of an angle that looks up.
const FROM_BELOW: [&str; 11] =
    ["low", "below", "under", "worm", "beneath", "ground", "up", "upward", "upwards", "knee", "waist"];

/// Takes an angle back that `hero shot` was read as, where the words look straight at the subject: `hero shot, head-on`.
pub(crate) fn level_frontal_views(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_frontal = words.windows(2).any(|pair| matches!(pair, ["head" | "straight" | "face" | "square", "on"]));
        if !is_frontal || !words.contains(&"hero") || words.iter().any(|word| FROM_BELOW.contains(word)) {
            continue;
        }
        for framing in [&mut step.start, &mut step.end] {
            framing.angle = framing.angle.filter(|angle| *angle != ShotAngle::Low);
        }
    }
}

/// Words by which a thing that is not to go out of view stays in it.
const STAYS: [&str; 7] = ["leaving", "leaves", "leave", "losing", "lose", "out", "ever"];

/// Begins straight above what the first words look straight down on: `look straight down on the skull, then come down in
/// front of it`.
pub(crate) fn begin_straight_above(linked: &Linked, steps: &mut [Step]) {
    let Some(step) = steps.first_mut() else { return };
    let words = linked.texts_in(step.words.unwrap_or_default());
    let opening = words.iter().take_while(|word| !matches!(**word, "," | "." | ";" | "then" | "and"));
    let opening: Vec<&str> = opening.copied().collect();
    let looks = opening.iter().any(|word| is_form(word, "look") || is_form(word, "start") || is_form(word, "begin"));
    let is_straight = opening
        .windows(2)
        .any(|pair| matches!(pair, ["straight" | "directly" | "vertically", "down" | "above" | "overhead"]));
    let sinks = matches!(step.movement, Move::CraneDown | Move::PedestalDown);
    let is_open = step.start.angle.is_none() && step.start.elevation_deg.is_none() && step.start.height.is_none();
    if sinks && looks && is_straight && is_open && step.end.angle != Some(ShotAngle::Overhead) {
        (step.movement, step.start.angle) = (Move::CraneDown, Some(ShotAngle::Overhead));
        step.start.part = SubjectPart::Middle;
        if step.start.subjects.is_empty() {
            step.start.subjects.clone_from(&step.end.subjects);
        }
    }
}

/// Takes a look back at a wall that the lens is only square to: `crab left, lens square to the wall`.
pub(crate) fn square_to_walls(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.look.is_some()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_square = words.windows(2).any(|pair| {
            matches!(pair, ["square" | "squared" | "perpendicular" | "parallel" | "flat", "to" | "on" | "against"])
        });
        let looks = words.iter().any(|word| ["look", "face", "aim", "point"].iter().any(|verb| is_form(word, verb)));
        if is_square && !looks {
            step.look = None;
        }
    }
}

/// Words of a lens that does not turn, what it points at, and words between the two.
const LOCKED: [&str; 12] = [
    "locked", "fixed", "lock", "dead", "straight", "square", "pointed", "pointing", "points", "aimed", "always",
    "directly",
];
const AHEAD: [&str; 5] = ["ahead", "forward", "forwards", "front", "on"];
const LENSES: [&str; 4] = ["lens", "camera", "cam", "optics"];

/// Takes a look along a sideways slide back where the lens is only locked ahead: `crab left, lens locked dead ahead`. A person
/// who slides to one side with the lens straight ahead does not turn to that side.
pub(crate) fn slide_square(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::TruckLeft | Move::TruckRight)) {
        let [from, to] = step.words.unwrap_or_default();
        let behind = linked.words_in([to, usize::MAX]).map(|(word, _)| word).take(8);
        let words: Vec<&str> = linked.texts_in([from, to]).into_iter().chain(behind).collect();
        let faces = step.look.as_ref().is_some_and(|look| faces_along(linked, &words, look)) && leads(step);
        if step.look == Some(Look::Ahead) && locks_ahead(&words) || faces {
            step.look = None;
        }
    }
}

/// Whether a slide leads along something, or from one thing to another.
fn leads(step: &Step) -> bool {
    let is_along = step.via.as_ref().is_some_and(|via| via.how == Pass::Along);
    is_along || !step.start.subjects.is_empty() && !step.end.subjects.is_empty()
}

/// Whether words face what a slide looks at: `along the counter, from the fridge to the stove, facing the units`.
fn faces_along(linked: &Linked, words: &[&str], look: &Look) -> bool {
    let Look::At(ids) = look else { return false };
    let looked = linked.expanded(ids);
    let faced = |at: usize| {
        let thing = words[at + 1..].iter().take(2).find_map(|word| linked.slot_at(word))?;
        Some(linked.expanded(&[thing]))
    };
    (0..words.len()).any(|at| words[at] == "facing" && faced(at).is_some_and(|ids| ids == looked))
}

/// Whether words lock the lens straight ahead.
fn locks_ahead(words: &[&str]) -> bool {
    let is_way = |word: &&str| ["go", "travel", "move", "head", "walk"].iter().any(|verb| is_form(word, verb));
    (0..words.len()).any(|at| {
        let behind = &words[at + 1..words.len().min(at + 7)];
        let locks = behind.windows(2).any(|pair| LOCKED.contains(&pair[0]) && AHEAD.contains(&pair[1]))
            || behind.iter().any(|word| LOCKED[..3].contains(word))
                && behind.iter().any(|word| AHEAD[..3].contains(word));
        LENSES.contains(&words[at]) && locks && !behind.iter().any(is_way)
    })
}

/// Hides what the first picture lacks by its words and a slide shows at its end: `only the curtain, no chair in sight. Then
/// we slide to the right and the armchair enters`.
pub(crate) fn hide_at_first(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let gone = (0..words.len()).filter_map(|at| {
        let is_gone = matches!(words[at], "no" | "without" | "hidden");
        let id = words[at + 1..].iter().take(2).find_map(|word| linked.slot_at(word))?;
        let behind = words[at + 1..].iter().take(6);
        let is_seen = behind.into_iter().any(|word| matches!(*word, "sight" | "view" | "yet" | "visible" | "seen"));
        let stays = words[at + 1..].iter().take(6).any(|word| STAYS.contains(word));
        (is_gone && is_seen && !stays).then_some(id)
    });
    let gone = linked.expanded(&gone.collect::<Vec<_>>());
    let shows = |step: &&mut Step| {
        matches!(step.movement, Move::TruckLeft | Move::TruckRight)
            && step.via.is_none()
            && !step.either_way
            && step.end.subjects.iter().any(|id| gone.contains(id))
            && !step.start.subjects.iter().any(|id| gone.contains(id))
    };
    if let Some(step) = steps.iter_mut().find(shows) {
        (step.movement, step.with) = (Move::Reveal, vec![step.movement]);
    }
}

/// What lies below everything.
const GROUND: [&str; 5] = ["floor", "ground", "carpet", "rug", "grass"];
/// Words that may stand between `from` and the ground.
const NEARBY: [&str; 11] = ["near", "close", "to", "right", "at", "just", "by", "the", "down", "on", "next"];

/// Shows the first picture at rest where the network has read the second step's turn into it, and its words say none:
/// `have a look at the wall and then whip round to the television`. `senses` has one entry per word.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of senses.
pub(crate) fn rest_on_first_picture(
    linked: &Linked,
    senses: &[Senses],
    steps: &mut [Step],
) -> Result<(), LanguageError> {
    let [first, second, ..] = steps else { return Ok(()) };
    let Some(own) = senses_of_turn(first.movement) else { return Ok(()) };
    let (own, any) = (Senses::named(own)?, Senses::named(&["turn", "left", "right", "whip", "nod"])?);
    let says = |step: &Step, turns: Senses| says(linked, senses, step, turns);
    // `The guitar first: its head, then tilt down` rests on the head.
    let (start, end) = (linked.expanded(&first.start.subjects), linked.expanded(&first.end.subjects));
    let is_within = !end.is_empty() && end.iter().all(|id| start.contains(id));
    let is_opening = (first.start == Framing::default() || is_within) && !first.end.subjects.is_empty();
    if is_opening
        && first.movement == second.movement
        && first.words != second.words
        && !says(first, own)
        && !says(first, any)
        && says(second, own)
    {
        (first.movement, first.either_way, first.amount) = (Move::Static, false, None);
        first.with.clear();
        if is_within {
            first.end = Framing { subjects: end, ..std::mem::take(&mut first.start) };
        }
    }
    Ok(())
}

/// Begins with nothing that no words name: `and then you lift your head` begins where the step before ends.
pub(crate) fn drop_unnamed_starts(linked: &Linked, steps: &mut [Step]) {
    let named = linked.expanded(&linked.slots);
    for step in steps.iter_mut().filter(|step| !step.start.subjects.is_empty()) {
        if !step.start.subjects.iter().any(|id| named.contains(id) || linked.missing(*id).is_some()) {
            step.start =
                Framing { subjects: Vec::new(), part: SubjectPart::Middle, whole: false, ..step.start.clone() };
        }
    }
    // `Open wide on the whole studio, glide to the easel, hold on the painting` does not begin on the painting.
    let Some(first) = steps.first_mut() else { return };
    let texts = linked.texts_in(first.words.unwrap_or_default());
    let own = linked.named_by(&texts);
    let says_all = texts.iter().any(|word| ALL.contains(word));
    if says_all && !own.is_empty() && !first.start.subjects.iter().any(|id| own.contains(id)) {
        first.start.subjects.clear();
    }
}

/// Words of the whole of what a film is about.
const ALL: [&str; 4] = ["whole", "entire", "full", "wide"];

/// Passes only what the words of a step name where they name some of it: `come in by the door, pass the sideboard` comes in by
/// the door alone.
pub(crate) fn drop_unnamed_passes(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let Some((words, via)) = step.words.zip(step.via.as_mut()) else { continue };
        let named = linked.named_by(&linked.texts_in(words));
        if via.objects.iter().any(|id| named.contains(id)) {
            via.objects.retain(|id| named.contains(id));
        }
    }
}

/// The senses of words that ask for a turn on the spot; `None` for other moves.
fn senses_of_turn(movement: Move) -> Option<&'static [&'static str]> {
    match movement {
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => {
            Some(&["around", "turn", "left", "right", "full", "half", "quarter"])
        }
        Move::PanLeft | Move::PanRight => Some(&["turn", "left", "right", "whip", "around", "curve"]),
        Move::WhipPan => Some(&["turn", "left", "right", "whip", "fast"]),
        Move::TiltUp => Some(&["nod", "up", "lift"]),
        Move::TiltDown => Some(&["nod", "down"]),
        _ => None,
    }
}

/// Begins a rise low where the words say so: `rise up from near the floor until we look over it`.
pub(crate) fn rise_from_ground(linked: &Linked, steps: &mut [Step]) {
    let rises = |step: &&mut Step| matches!(step.movement, Move::CraneUp | Move::PedestalUp);
    for step in steps.iter_mut().filter(rises) {
        let Some(bytes) = step.words else { continue };
        let words = linked.texts_in(bytes);
        let froms = words.iter().enumerate().filter(|(_, word)| **word == "from").map(|(at, _)| at + 1);
        let mut ends = froms.map(|at| words[at..].iter().find(|word| !NEARBY.contains(word)));
        let is_open = step.start.angle.is_none() && step.start.height.is_none() && step.start.elevation_deg.is_none();
        if is_open && ends.any(|word| word.is_some_and(|word| GROUND.contains(word))) {
            step.start.angle = Some(ShotAngle::Low);
            if step.start.subjects.is_empty() {
                step.start.subjects.clone_from(&step.end.subjects);
            }
        }
    }
}

/// Words by which a close-up is an extreme one.
const EXTREMES: [&str; 18] = [
    "extreme",
    "extremely",
    "very",
    "super",
    "ultra",
    "really",
    "macro",
    "ecu",
    "xcu",
    "bcu",
    "inch",
    "inches",
    "big",
    "x",
    "touching",
    "nearly",
    "hair",
    "closest",
];

/// Makes a close-up of an extreme one that nobody asked for: `begin at the vase, quite near`. `senses` has one entry per
/// word.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of senses.
pub(crate) fn temper_closeness(linked: &Linked, senses: &[Senses], steps: &mut [Step]) -> Result<(), LanguageError> {
    let details = Senses::named(&["detail", "fill"])?;
    for step in steps {
        let words = step.words.unwrap_or_default();
        let is_extreme = linked.words_in(words).any(|(word, _)| EXTREMES.contains(&word));
        if is_extreme || says(linked, senses, step, details) {
            continue;
        }
        for framing in [&mut step.start, &mut step.end] {
            if framing.size == Some(ShotSize::ExtremeCloseUp) {
                framing.size = Some(ShotSize::CloseUp);
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use cinesplat_operator::Via;

    use super::super::fixture::{about, linked};
    use super::*;

    #[test]
    fn a_lens_that_is_locked_ahead_does_not_look_along() {
        let locks = |text: &str| locks_ahead(&text.split(' ').collect::<Vec<_>>());
        assert!(locks("crab left past <obj-0> , lens locked dead ahead"));
        assert!(locks("slide right , camera pointing straight ahead the whole time"));
        assert!(locks("truck left with the lens fixed forward"));
        assert!(!locks("slide right , camera looking ahead to where we are going"));
        assert!(!locks("truck left , the camera moves straight on"));
    }

    #[test]
    fn a_slide_that_faces_the_units_does_not_turn_to_them() {
        let looks = |text: &str| {
            let via = Some(Via { how: Pass::Along, objects: vec![5] });
            let look = Some(Look::At(vec![7]));
            let mut step = Step { via, look, ..about(Move::TruckRight, &[9], [0, text.len()]) };
            slide_square(&linked(text), std::slice::from_mut(&mut step));
            step.look.is_some()
        };
        assert!(!looks("track right along <obj-0> , facing <obj-1>"));
        assert!(looks("track right along <obj-0> , always looking at <obj-1>"));
    }
}
