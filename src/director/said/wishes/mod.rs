//! Messages that say what should be seen, in which order and with what feeling, and little of what a camera does: `They get
//! clues first, up close, the flowers and the mug, and only right at the end do we see the whole room.`
//!
//! The network makes up moves from the story around the wishes. The film visits what is wanted, one thing after the other.

mod lengths;
mod lone;
mod stations;
mod steps;
mod text;
mod things;

use cinesplat_language::{Linked, QuantityKind, Senses, is_listed};
use cinesplat_objects::Object;
use cinesplat_operator::{Amount, Framing, Speed, Step, SubjectSide};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};

use super::briefs::{denied, is_camera_verb, is_loose, pace};
use super::directions::{is_form, says_any};
use crate::direction::Direction;
use stations::{Rank, Station, Subject};
use steps::Manner;
use text::{Text, is_object};
use things::Things;

/// Fewest words of such a message.
const FEWEST_WORDS: usize = 12;
/// Most stations of a film.
const MOST_STATIONS: usize = 7;
/// Verbs of cameras that say no way.
const STOPS: [&str; 12] =
    ["hold", "rest", "pause", "linger", "stop", "start", "begin", "finish", "land", "settle", "frame", "focus"];
/// Words of people who know cameras.
const TRADE: &str = "sideways backward backwards forward forwards overhead top-down topdown handheld steadicam drone gimbal lens \
    degrees clockwise counterclockwise anticlockwise pov profile foreground close-up closeup cu ecu mcu ws ms shot shots angle low high \
    bird's tripod static locked planted snap frame picture view rotation stroll strolls join joins put together";
/// Verbs of a camera that goes somewhere, and their ways.
const GOES: [&str; 11] = ["go", "come", "step", "back", "get", "bring", "ease", "pull", "draw", "edge", "inch"];
const WAYS: &str = "in over from across down up back out away off closer";
/// Words before `move` where it is a name: `one continuous move`.
const KINDS: &str = "a one single continuous long slow gentle smooth simple unbroken";
/// Most words of an instruction, in which `go to` is a way: who tells more tells a story.
const SHORT: usize = 40;
/// Words that rule out what follows, and words of a way past a thing.
const NOT: &str = "not never 't no without dont";
const PASSES: &str = "over under behind through past between around along across above beneath below";
/// Senses of words that say how a camera goes or turns.
const WAY_SENSES: [&str; 10] =
    ["around", "circle", "sideways", "lift", "turn", "nod", "curve", "along", "vertigo", "whip"];
/// Words of growth.
const GROWS: &str = "bigger larger wider grows expands unfolds";
/// Words of time to look.
const LINGERS: [&[&str]; 8] = [
    &["time", "to", "look"],
    &["empty", "time"],
    &["linger"],
    &["lingers"],
    &["pauses"],
    &["your", "time"],
    &["let", "them", "look"],
    &["dwell"],
];
/// Words of a thing that is to seem large, and of one that is to seem harmless.
const GRAND: &str = "tall giant towering heroic monumental imposing mighty powerful colossal gigantic huge";
const CUTE: &str = "cute sweet friendly adorable harmless lovable";

/// Films what a message wants seen. Says whether it is such a message.
pub(crate) fn film_wishes(linked: &Linked, objects: &[Object], direction: &mut Direction) -> bool {
    let text = Text::of(linked);
    // A picture of nothing is none.
    let is_nothing = |step: &Step| {
        step.movement == Move::Static
            && step.end == Framing::default()
            && step.via.is_none()
            && step.duration_secs.is_none()
    };
    let is_loose = is_loose(direction, &text.words) || direction.program.steps.iter().any(is_nothing);
    if !is_loose || linked.timeline.is_some() || !is_wish(&text, linked) {
        return false;
    }
    let things = Things::new(objects);
    let denied = denied(linked, &text.words);
    let times = lengths::times(linked, &text);
    let lingers = says_any(&text.words, &LINGERS).then_some(lengths::LINGER_SECS);
    let mut quantities = text.words.iter().filter_map(|word| linked.quantity_at(word));
    let percent = quantities.find(|quantity| quantity.kind == QuantityKind::Percent).map(|quantity| quantity.value);
    let height = direction.program.steps.iter().find_map(|step| step.end.height);
    let manner = Manner {
        speed: pace(&text.words),
        rest_secs: times.each_secs.or(lingers),
        last_secs: times.last_secs,
        share: percent,
        grows: text.has(0..text.words.len(), GROWS),
        height,
    };
    let lone = things.lone();
    let steps = match lone {
        Some(thing) => of_lone(&text, linked, (thing, &things), manner.speed),
        None => of_scene(stations::stations(&text, linked, &things, &denied), &things, (&manner, &linked.spans)),
    };
    let Some(mut steps) = steps else { return false };
    let ends_whole = !linked.wholes.is_empty() || text.has(0..text.words.len(), "whole entire full complete");
    if let Some(one) = one_move(&text.words, &steps, manner.speed).filter(|_| ends_whole) {
        steps = vec![one];
    }
    let span = direction.span();
    let shown: Vec<u32> = steps.iter().flat_map(|step| step.end.subjects.clone()).collect();
    for step in &mut steps {
        step.words = step.words.or(span);
        step.avoid.extend(denied.iter().filter(|id| !shown.contains(id)));
    }
    direction.replace_steps(steps);
    direction.program.duration_secs = times.total_secs.or(direction.program.duration_secs);
    true
}

/// One way out from the first picture to the last one, which shows all of something, where the words want a single move: `bread on the
/// plates, the lamps over it. One continuous move. End with the whole table`.
fn one_move(words: &[&str], steps: &[Step], speed: Speed) -> Option<Step> {
    let is_one = |at: usize| {
        matches!(words[at], "move" | "shot" | "take")
            && words[..at].iter().rev().take(2).any(|word| is_listed("one continuous single unbroken", word))
    };
    let [first, .., last] = steps else { return None };
    let is_wide = last.end.whole || last.end.size.is_some_and(|size| size >= ShotSize::Long);
    let near = first.end.subjects.first()?;
    if !(0..words.len()).any(is_one) || !is_wide || last.end.subjects.contains(near) || last.via.is_some() {
        return None;
    }
    let start = Framing { subjects: vec![*near], size: Some(ShotSize::CloseUp), ..Framing::default() };
    Some(Step { start, end: last.end.clone(), speed, ..Step::of(Move::PullOut) })
}

/// Least angle of a turn that ends where it began, degrees.
const FULL_TURN_DEG: f64 = 350.0;

/// Turns evenly round a thing in a film that is to loop: at rest at its ends it would stop at every repetition.
pub(crate) fn turn_evenly(linked: &Linked, steps: &mut [Step]) {
    let [step] = steps else { return };
    let is_round = matches!(step.movement, Move::OrbitLeft | Move::OrbitRight);
    let is_full = match step.amount {
        Some(Amount::Degrees(degrees)) => degrees >= FULL_TURN_DEG,
        Some(Amount::Large) => true,
        _ => false,
    };
    if is_round && is_full && step.easing.is_none() && repeats(&Text::of(linked).words) {
        step.easing = Some(Easing::Linear);
    }
}

/// Whether a film is to be repeated without a break, as in `it should loop on my website`. `Loop around it` is a circle.
fn repeats(words: &[&str]) -> bool {
    let is_circle = |at: usize| {
        let next = words.get(at + 1).copied().unwrap_or_default();
        is_listed("around round about back over it", next) || is_object(next)
    };
    let is_one = |at: usize| at > 0 && is_listed("a one full single whole big wide slow complete", words[at - 1]);
    let is_denied = |at: usize| at > 0 && is_listed("no not n't never without", words[at - 1]);
    (0..words.len()).any(|at| lone::is_of_loop(words[at]) && !is_circle(at) && !is_one(at) && !is_denied(at))
}

/// The film of the one thing of a scan; `None` where less than two views of it are wanted.
fn of_lone(
    text: &Text<'_>,
    linked: &Linked,
    (thing, things): (&Object, &Things<'_>),
    speed: Speed,
) -> Option<Vec<Step>> {
    let has = |list: &str| text.has(0..text.words.len(), list);
    if lone::loops(text) {
        return Some(lone::loop_steps(thing, speed));
    }
    let views = lone::views(text, linked, thing, things);
    if views.len() > 1 {
        return Some(lone::steps(&views, thing, things, speed));
    }
    // Large at first, harmless at last.
    let seen = |angle: ShotAngle| Framing { subjects: vec![thing.id], angle: Some(angle), ..Framing::default() };
    let start = Framing { whole: true, ..seen(ShotAngle::Low) };
    let end = Framing { whole: true, side: Some(SubjectSide::FromFront), ..seen(ShotAngle::EyeLevel) };
    let rises = Step { end, ..Step::of(Move::CraneUp) };
    let nears =
        Step { start, end: Framing { height_frac: Some(0.9), ..seen(ShotAngle::Low) }, ..Step::of(Move::PushIn) };
    // `As if it is ten metres tall`.
    let is_long = |word: &&str| {
        linked.quantity_at(word).is_some_and(|quantity| quantity.kind == QuantityKind::Units && quantity.value >= 3.0)
    };
    let is_grand = has(GRAND) || has("if like seem seems") && text.words.iter().any(is_long);
    (is_grand && has(CUTE)).then(|| vec![nears, rises])
}

/// The film of some stations; `None` where they are no way.
fn of_scene(mut stations: Vec<Station>, things: &Things<'_>, manner: (&Manner, &[[usize; 2]])) -> Option<Vec<Step>> {
    stations.truncate(MOST_STATIONS);
    let is_place_only = matches!(&stations[..], [Station { subject: Subject::Place, rank: Rank::Last, .. }]);
    if is_place_only {
        stations.insert(0, Station::nothing());
    }
    (stations.len() > 1).then(|| steps::steps(&stations, things, manner))
}

/// Whether words say what is to be seen, and no way of a camera.
fn is_wish(text: &Text<'_>, linked: &Linked) -> bool {
    let words = &text.words;
    let is_way = |at: usize| {
        let before = || words[..at].iter().rev();
        let is_denied = before().take(4).any(|word| is_listed(NOT, word));
        // `Where she is going to sit down`.
        let is_told = before().take(6).any(|word| *word == "where");
        let is_kind = words[at] == "move" && before().take(1).any(|word| is_listed(KINDS, word));
        let stops = STOPS.iter().any(|verb| is_form(words[at], verb));
        // `The last frame matches the first`.
        let is_end = is_listed("frame picture shot", words[at])
            && before().take(2).any(|word| is_listed("first last opening closing same", word));
        // `One continuous shot` is no picture.
        let is_noun = is_kind
            || matches!(words[at], "shot" | "take")
                && before().take(2).any(|word| is_listed("one continuous single unbroken", word));
        is_camera_verb(words, at) && !stops && !is_denied && !is_told && !is_noun
            || is_listed(TRADE, words[at]) && !is_denied && !is_end && !is_noun
    };
    let passes = |at: usize| {
        let next = words[at + 1..].iter().find(|word| !is_listed("the a an my our", word));
        // `The doors under the worktop` only says where they are.
        let locates = at > 0 && is_object(words[at - 1]);
        is_listed(PASSES, words[at]) && next.is_some_and(|word| is_object(word)) && !locates
    };
    // `Step back`, `and from there it goes to the palm`.
    let goes = |at: usize| {
        let next = words.get(at + 1).copied().unwrap_or_default();
        let is_verb = GOES.iter().any(|verb| is_form(words[at], verb));
        let to_thing = words.len() < SHORT
            && next == "to"
            && is_form(words[at], "go")
            && words[at + 1..].iter().take(3).any(|word| is_object(word));
        let is_close = words[at] == "up" || matches!(words.get(at + 2), Some(&"close" | &"amongst" | &"among"));
        is_verb && (is_listed(WAYS, next) && !is_close || to_thing)
    };
    let is_measured = |at: usize| {
        // `As if it is ten metres tall` is no length of the film's.
        let as_if = words[..at].iter().rev().take(5).any(|word| is_listed("if like seem seems though", word));
        let seems = as_if || words.get(at + 1).is_some_and(|word| is_listed("tall high long wide big old", word));
        let kind = linked.quantity_at(words[at]).map(|quantity| quantity.kind);
        let is_length = kind == Some(QuantityKind::Units) && !seems;
        is_length || matches!(kind, Some(QuantityKind::Degrees | QuantityKind::Factor | QuantityKind::Millimeters))
    };
    let says = |at: usize| !text.is_likeness(at) && (is_way(at) || goes(at) || passes(at) || is_measured(at));
    // `No movement whatsoever` is one picture.
    let rests =
        words.windows(2).any(|two| matches!(two, ["no" | "without", "movement" | "motion" | "moves" | "moving"]));
    // A damaged list of senses has been told of before.
    let ways = Senses::named(&WAY_SENSES).unwrap_or_default();
    let senses = linked.senses().unwrap_or_default();
    let has_way = |at: usize| {
        // `Where she's going to stand`, `so that it loops`.
        let is_told = words[..at].iter().rev().take(6).any(|word| *word == "where") || is_form(words[at], "loop");
        let is_way = senses.get(at).is_some_and(|senses| senses.overlaps(ways));
        is_way && !is_told && !is_object(words[at]) && !text.is_likeness(at)
    };
    words.len() >= FEWEST_WORDS && !rests && !(0..words.len()).any(|at| says(at) || has_way(at))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wish(text: &str) -> bool {
        let linked = Linked { tokens_text: text.to_owned(), ..Linked::default() };
        is_wish(&Text::of(&linked), &linked)
    }

    #[test]
    fn a_film_that_repeats_is_no_circle() {
        let is_said = |text: &str| repeats(&text.split(' ').collect::<Vec<&str>>());
        assert!(is_said("one full slow turn around <obj-0> , 12 seconds , it should loop on my website"));
        assert!(is_said("a 360 of <obj-0> that loops"));
        assert!(!is_said("loop around <obj-0> once"));
        assert!(!is_said("do a full loop about it"));
        assert!(!is_said("all around <obj-0> , no loop"));
    }

    #[test]
    fn a_wish_says_no_way_of_the_camera() {
        assert!(wish(
            "i 'd like them to get clues first , up close , <obj-0> and <obj-1> , and only then the whole room"
        ));
        assert!(wish(
            "you know in games when the camera flies around ? that . <obj-0> , then <obj-1> , and rest by <obj-2>"
        ));
        assert!(wish(
            "people should see <obj-0> and how crazy it goes , ideally it loops so the last frame matches it"
        ));
        assert!(wish("begin from <obj-0> , little by little , last is <obj-1> . do not move fast , please"));
        assert!(wish("leave us where she 's going to pedestal down and <obj-0> . nothing has started yet"));
        assert!(!wish(
            "no movement whatsoever . <obj-0> at the left edge , <obj-1> at the right edge , level with them"
        ));
        assert!(!wish("begin on <obj-0> , then pan over to <obj-1> and hold there until the end of the film"));
        assert!(wish(
            "people should be hungry . <obj-0> and <obj-1> , one continuous move if you can , end with <obj-2>"
        ));
        assert!(!wish("open on <obj-0> and stay there . then ease back and up until <obj-1> and <obj-2> are all in"));
        assert!(!wish(
            "hey can you get <obj-0> , well just go round it whichever way , then go wide so we see its in the shop"
        ));
        assert!(!wish("a wide shot of the room first , then <obj-0> and at last <obj-1> , please"));
        assert!(wish("people buy it for the hair , so get in amongst those long leaves . leave them with <obj-0>"));
        assert!(!wish("the film begins at <obj-0> and from there it goes to <obj-1> , which must be seen whole"));
        assert!(!wish("have a look at <obj-0> here and now everybody back up so you can see <obj-1>"));
        assert!(!wish("<obj-0> , <obj-1> and <obj-2> , all of them in one picture , and the last one in the middle"));
        assert!(!wish("we start at <obj-0> and come in over <obj-1> until we see the whole of <obj-2> , please"));
    }

    #[test]
    fn a_single_move_leads_out_to_the_last_picture() {
        let about = |ids: &[u32], whole| Step {
            end: Framing { subjects: ids.to_vec(), whole, ..Framing::default() },
            ..Step::of(Move::PushIn)
        };
        let steps = [about(&[1, 2], false), about(&[3], false), about(&[7], true)];
        let one = one_move(&["one", "continuous", "move"], &steps, Speed::Normal).unwrap();
        assert_eq!((one.movement, &one.start.subjects[..], &one.end.subjects[..]), (Move::PullOut, &[1][..], &[7][..]));
        assert_eq!(one_move(&["one", "thing"], &steps, Speed::Normal), None);
    }
}
