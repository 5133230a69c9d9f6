//! Briefs: what a film is about and how it should feel, with no word of what the camera does: `A teaser for a pottery brand.
//! The orange vase is the product, everything else is set dressing.`
//!
//! Nobody who writes a brief wants a photo, or what the network makes up from words of other things. The film goes slowly
//! towards what the brief is about.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_objects::Object;
use cinesplat_operator::{Amount, Framing, Pass, Speed, Step, Via};
use cinesplat_trajectory::{Move, ShotAngle};

use super::bans::SENTENCE_ENDS;
use super::directions::is_form;
use crate::direction::Direction;

/// Verbs of what a camera does, in any form.
const VERBS: [&str; 78] = [
    "soar", "dive", "plunge", "skim", "hover", "sail", "dart", "chase", "skate", "ride", "push", "pull", "dolly",
    "zoom", "pan", "tilt", "truck", "track", "crane", "boom", "jib", "pedestal", "orbit", "circle", "arc", "roll",
    "fly", "glide", "drift", "slide", "sweep", "swoop", "travel", "rise", "climb", "ascend", "descend", "sink",
    "lower", "raise", "lift", "approach", "retreat", "follow", "walk", "enter", "move", "float", "creep", "crawl",
    "pivot", "swing", "spin", "rotate", "revolve", "turn", "whirl", "reveal", "hold", "rest", "pause", "linger",
    "stop", "start", "begin", "finish", "land", "fade", "focus", "rack", "widen", "frame", "whip", "settle", "nudge",
    "wander", "sneak", "tiptoe",
];
/// Other words of cameras, pictures and ways.
const WORDS: &str = "shot shots close-up closeup closeups close-ups cu ecu mcu ws ms wide wider medium tight tighter macro \
    angle view views overhead bird's top-down eye-level low high framing static tripod locked lock-off lockoff fixed off-axis front side profile foreground sharp handheld steadicam drone \
    gimbal lens zoom pov establishing turntable degrees clockwise anticlockwise counterclockwise closer nearer towards \
    toward around round past along through cut cuts planted camera stills photo photograph picture snapshot frozen motionless \
    first then next finally backwards forwards backward forward sideways left right away";
/// Verbs whose `up` or `down` is no way: `somewhere you'd never get up`.
const NO_WAYS: &str = "turns turned \
    get got getting wake woke waking give gave pick picked picking set sit sits sitting lie lying grow \
    stand stands hang make made dress dressed tidy tidied grown let calm slow settle";
/// Words with which another word is one of cameras: `look at`, `open on`, `come closer`.
const LEADS: [(&str, &str); 14] = [
    ("head", "for over to towards toward into off out"),
    ("dutch", "angle angles tilt"),
    ("look", "at into out over back"),
    ("open", "on with wide"),
    ("come", "in over to"),
    ("go", "in over to from across"),
    ("get", "in close"),
    ("end", "on with at"),
    ("still", "of on from"),
    ("close", "on to in up"),
    ("draw", "back in away closer near nearer up"),
    ("ease", "in into back out off over up down"),
    ("back", "off away out up"),
    ("widen", "from out to until"),
];
/// Fewest words of a brief: `show me the sofa` is a picture of the sofa.
const FEWEST_WORDS: usize = 8;
/// Certainty of a step below which a reading of a brief is made up.
const MADE_UP: f64 = 0.2;
/// The same where it is one step.
const ONE_MADE_UP: f64 = 0.3;

/// Words that make one thing what the brief is about: `the bed is the hero`.
const HEROES: &str = "hero product star subject main focal centerpiece centrepiece point protagonist mostly";
/// Words by which a thing comes last.
const SECRETS: &str = "secret surprise payoff";
/// Angle of a turn to a thing that is out of the picture at first, degrees.
const SURPRISE_DEG: f64 = 80.0;
/// Words of a thing that is to be seen from more than one side.
const WARES: &str = "product shop store brand catalogue catalog webshop sell selling sale bestseller sculpture statue \
    figurine model toy";
/// Words that show one thing after the other.
const IN_TURN: &str = "each every turn another";
/// Words of a place as a whole.
const PLACES: &str =
    "room bedroom kitchen bathroom lounge space flat apartment studio house home office interior place";
const SPACES: &str = "space light spacious airy roomy bright layout size";
/// Words of a thing that is to look large: it is seen from below.
const GRAND: &str = "giant towering heroic hero-like monumental imposing mighty powerful colossal gigantic";
/// Words of a calm film, and of a lively one.
const CALM: &str = "slow slowly calm calmly lazy soft softly gentle gently quiet quietly moody elegant elegantly dreamy peaceful \
    serene cosy cozy tender sleepy hush hushed intimate restful unhurried warm";
const LIVELY: &str = "fast punchy energetic dynamic snappy lively quick action";
/// Words of haste, which are calm where they are denied.
const HURRIES: &str = "fast hurry rush rushed jerky jerks hurried disco quick quickly";
const NOT: &str = "not never 't without no hide avoid nobody nothing";

/// Replaces a picture at rest, or a reading that is hardly sure, of a brief.
pub(crate) fn film_briefs(linked: &Linked, objects: &[Object], direction: &mut Direction) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let rests = rests(direction, &words);
    let is_loose = is_loose(direction, &words);
    // Angles and lengths are what a camera keeps, and no size that a thing is to seem.
    let measures = |at: usize| {
        let seems = words.get(at + 1).is_some_and(|word| is_listed("tall high long wide big old", word))
            && words[..at].iter().rev().take(4).any(|word| is_listed("is was are were look looks like as", word));
        linked.quantity_at(words[at]).is_some_and(|quantity| quantity.kind != QuantityKind::Seconds) && !seems
    };
    let is_measured = (0..words.len()).any(measures);
    let said = said(linked, &words);
    // Who sells a thing says what is to be seen of it: `wants the front, both sides and the back`.
    let is_ware = rests && words.iter().any(|word| is_listed(WARES, word)) && !moves(&said);
    if !is_loose || linked.timeline.is_some() || is_measured || !(is_brief(&said) || is_ware) {
        return;
    }
    let denied = denied(linked, &words);
    let subjects = without_parts(subjects(linked, &words, &denied), objects);
    let has = |list: &str| words.iter().any(|word| is_listed(list, word));
    let (missing, subjects): (Vec<u32>, Vec<u32>) = subjects.iter().partition(|id| linked.missing(**id).is_some());
    // `I scanned the flat before I gave the keys back` is about the flat; what else is missing cannot be filmed.
    if !missing.is_empty() && subjects.is_empty() && !has(PLACES) {
        return;
    }
    // `Lots of space around it` is no place.
    let is_air = |at: usize| {
        matches!(words[at], "space" | "room") && words.get(at + 1).is_some_and(|word| is_listed(AROUND, word))
    };
    let has_place = |list: &str| (0..words.len()).any(|at| is_listed(list, words[at]) && !is_air(at));
    let of_place = has_place(PLACES) && (subjects.is_empty() || has_place(SPACES));
    let mut steps = match seen_from(linked, &words, &subjects) {
        Some(place) => vec![Step { via: Some(Via { how: Pass::From, objects: place }), ..Step::look_around() }],
        None if of_place || subjects.is_empty() => vec![Step::look_around()],
        None => about(&mentioned(linked, &subjects), &words),
    };
    // The same move, of which the network may have read more.
    if let ([read], [brief]) = (&direction.program.steps[..], &steps[..])
        && read.movement == brief.movement
        && read.end.subjects == brief.end.subjects
    {
        return;
    }
    let speed = pace(&words);
    let span = direction.span();
    for step in &mut steps {
        (step.speed, step.words) = (speed, span);
        step.avoid.extend(denied.iter().filter(|id| !subjects.contains(id)));
    }
    direction.replace_steps(steps);
}

/// Words behind `space` that is left about a thing.
const AROUND: &str = "around above beside behind below beneath to for left";

/// Words of a mood, besides those of a calm film.
const MOODS: &str = "romantic romance moody nostalgic nostalgia melancholy melancholic mysterious mystery eerie spooky tense tension \
    uneasy joyful joy happy festive lonely loneliness sad hopeful epic majestic dramatic cinematic atmospheric atmosphere vibe vibes \
    mood feeling magical whimsical playful luxurious nightmare haunting suspense wistful bittersweet";
/// Fewest words of a wish for a mood.
const FEWEST_OF_MOOD: usize = 3;

/// Looks around a place of which the words only say the mood: `something romantic about dinner for two`.
pub(crate) fn film_moods(linked: &Linked, direction: &mut Direction) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let is_mood = words.iter().any(|word| is_listed(MOODS, word) || is_listed(CALM, word));
    let names = words.iter().any(|word| linked.slot_at(word).is_some());
    let spans = linked.spans.first().zip(linked.spans.last());
    let Some((first, last)) = spans.filter(|_| is_mood && !names && words.len() >= FEWEST_OF_MOOD) else { return };
    if direction.program.steps.is_empty() && linked.timeline.is_none() && direction.unmet.is_empty() {
        let speed = if pace(&words) == Speed::Fast { Speed::Normal } else { Speed::Slow };
        direction.replace_steps(vec![Step { speed, words: Some([first[0], last[1]]), ..Step::look_around() }]);
    }
}

/// Words of a picture that does not move, and fewest things that are shown all round.
const PICTURES: &str =
    "still static photo photograph picture image portrait frame hold locked tripod fixed poster thumbnail shot";
const FEWEST_SHOWN: usize = 3;

/// Goes around many things that one picture shows: `show me what's on the table`.
pub(crate) fn show_many(linked: &Linked, direction: &mut Direction) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let shows = words.iter().any(|word| is_listed("show shows see", word));
    let [step] = &mut direction.program.steps[..] else { return };
    let is_open = step.movement == Move::Static
        && step.with.is_empty()
        && step.via.is_none()
        && step.start == Framing::default()
        && step.duration_secs.is_none()
        && step.end.size.is_none()
        && step.end.subjects.len() >= FEWEST_SHOWN;
    if shows && is_open && !words.iter().any(|word| is_listed(PICTURES, word)) && !directs(&without_shows(&words)) {
        (step.movement, step.either_way, step.end.whole) = (Move::ArcRight, true, true);
    }
}

/// The words without those that only ask to see something.
fn without_shows<'a>(words: &[&'a str]) -> Vec<&'a str> {
    words.iter().filter(|word| !is_listed("show shows see all", word)).copied().collect()
}

/// Whether all steps rest.
fn rests(direction: &Direction, words: &[&str]) -> bool {
    let is_rest = |step: &Step| {
        let is_timed = step.duration_secs.is_some() && direction.program.steps.len() > 1;
        let holds_one = step.movement == Move::Static && step.with.is_empty() && !is_timed;
        // One picture of several things may be meant, but not by who sells them.
        holds_one && (!step.end.whole || words.iter().any(|word| is_listed(WARES, word)))
    };
    !direction.program.steps.is_empty() && direction.program.steps.iter().all(is_rest)
}

/// Whether a reading rests on everything, or is hardly sure of something.
pub(super) fn is_loose(direction: &Direction, words: &[&str]) -> bool {
    let least = if direction.program.steps.len() == 1 { ONE_MADE_UP } else { MADE_UP };
    let is_made_up = direction.certainty.iter().any(|step| step.probability < least);
    rests(direction, words) || is_made_up && !direction.program.steps.is_empty()
}

/// The pace that the words wish for.
pub(super) fn pace(words: &[&str]) -> Speed {
    // `Not fast` is no wish for speed.
    let is_denied = |at: usize| words[..at].iter().rev().take(3).any(|word| is_listed(NOT, word));
    let is_calm = words.iter().any(|word| is_listed(CALM, word));
    let is_lively = (0..words.len()).any(|at| is_listed(LIVELY, words[at]) && !is_denied(at));
    let is_unhurried = (0..words.len()).any(|at| is_listed(HURRIES, words[at]) && is_denied(at));
    match (is_calm || is_unhurried, is_lively) {
        (true, false) => Speed::Slow,
        (false, true) => Speed::Fast,
        _ => Speed::Normal,
    }
}

/// The one thing that a brief is about where its words only say that it is seen from there: `just lie there staring at
/// stuff. From the bed.`
fn seen_from(linked: &Linked, words: &[&str], subjects: &[u32]) -> Option<Vec<u32>> {
    let is_place = |at: usize| {
        let id = linked.slot_at(words[at])?;
        let begins = at < 2 || SENTENCE_ENDS.contains(&words[at - 2]);
        let ends = words.get(at + 1).is_none_or(|word| SENTENCE_ENDS.contains(word) || *word == ",");
        (at > 0 && words[at - 1] == "from" && begins && ends).then(|| linked.expanded(&[id]))
    };
    (0..words.len()).find_map(is_place).filter(|place| place == subjects)
}

/// The things by their mentions: several that one mention names are one picture.
fn mentioned(linked: &Linked, subjects: &[u32]) -> Vec<Vec<u32>> {
    linked.grouped(subjects).into_iter().map(|id| linked.expanded(&[id])).collect()
}

/// The words but those that stand for a part of a thing: `the back` of an armchair is no way.
fn said<'a>(linked: &Linked, words: &[&'a str]) -> Vec<&'a str> {
    let spans = &linked.spans;
    // The words of an idiom stand for the same bytes as well: `spin round the guitar`.
    let is_idiom =
        |at: usize| (0..words.len()).any(|other| spans.get(other) == spans.get(at) && is_camera_verb(words, other));
    let stands_for_part = |at: usize| {
        (at + 1..words.len().min(at + 5)).any(|next| spans.get(next) == spans.get(at) && words[next].starts_with('<'))
            && !is_idiom(at)
    };
    (0..words.len()).filter(|at| !stands_for_part(*at)).map(|at| words[at]).collect()
}

/// Whether words say nothing of what a camera does, and are enough for a brief.
fn is_brief(words: &[&str]) -> bool {
    words.len() >= FEWEST_WORDS && !directs(words)
}

/// Whether words have a verb of what a camera does.
fn moves(words: &[&str]) -> bool {
    (0..words.len()).any(|at| is_camera_verb(words, at))
}

/// Whether the word at `at` is a verb of what a camera does.
pub(super) fn is_camera_verb(words: &[&str], at: usize) -> bool {
    let word = words[at];
    // `Arm rests` are no rest.
    let is_part =
        word == "rests" && at > 0 && (is_listed("arm head foot back", words[at - 1]) || words[at - 1].starts_with('<'));
    // `Before everybody turns up`.
    let comes = is_form(word, "turn") && words.get(at + 1).is_some_and(|next| is_listed("up out", next));
    let is_verb = VERBS.iter().any(|verb| is_form(word, verb));
    is_verb && !is_listed("resting movement", word) && !is_part && !comes
}

/// Whether words say something of what a camera does.
pub(crate) fn directs(words: &[&str]) -> bool {
    let leads = |at: usize| {
        let next = words.get(at + 1).copied().unwrap_or_default();
        // `A proper look at it` is no way of the camera.
        let is_noun = words[..at].iter().rev().take(2).any(|word| is_listed("a an the proper good better", word));
        LEADS
            .iter()
            .any(|(word, ways)| is_form(words[at], word) && is_listed(ways, next) && !(is_noun && *word == "look"))
    };
    let is_camera = |at: usize| {
        let word = words[at];
        let before = words[at.saturating_sub(2)..at].iter();
        let is_way = matches!(word, "up" | "down") && !before.into_iter().any(|word| is_listed(NO_WAYS, word));
        is_camera_verb(words, at) || is_listed(WORDS, word) || leads(at) || is_way
    };
    (0..words.len()).any(is_camera)
}

/// What a brief is about, in order of mention: the thing that it calls the hero, or else all that it names but what is `denied`.
fn subjects(linked: &Linked, words: &[&str], denied: &[u32]) -> Vec<u32> {
    let sentences = words.split(|word| SENTENCE_ENDS.contains(word) || *word == ",");
    let named = |words: &[&str]| linked.named_by(words);
    let is_hero = |words: &&[&str]| words.iter().any(|word| is_listed(HEROES, word)) && !named(words).is_empty();
    let heroes = sentences.clone().find(is_hero).map(named);
    let mut all = heroes.unwrap_or_else(|| named(words));
    all.retain(|id| !denied.contains(id));
    all
}

/// The things but those that are parts of another one of them: a palm, its pot and its leaves are the palm.
fn without_parts(mut subjects: Vec<u32>, objects: &[Object]) -> Vec<u32> {
    let all = subjects.clone();
    let whole_of = |id: u32| objects.iter().find(|object| object.id == id).and_then(|object| object.parent);
    subjects.retain(|id| !whole_of(*id).is_some_and(|whole| all.contains(&whole)));
    subjects
}

/// What a sentence says is not to be seen, and no other one names: `he can't try it` says nothing of what is seen.
pub(super) fn denied(linked: &Linked, words: &[&str]) -> Vec<u32> {
    let is_denied = |at: usize| {
        let before = words[..at].iter().rev().take_while(|word| !SENTENCE_ENDS.contains(word)).take(4);
        before.into_iter().any(|word| is_listed(NOT, word))
    };
    let named = |wanted: bool| {
        let slots = (0..words.len()).filter(|at| is_denied(*at) == wanted).filter_map(|at| linked.slot_at(words[at]));
        linked.expanded(&slots.collect::<Vec<_>>())
    };
    let shown = named(false);
    named(true).into_iter().filter(|id| !shown.contains(id)).collect()
}

/// Most things that one picture brings together.
const MOST_TOGETHER: usize = 4;

/// Whether words keep what they are about back: `don't show it too early`.
fn is_held_back(words: &[&str]) -> bool {
    let is_early =
        |at: usize| words[at] == "too" && words.get(at + 1).is_some_and(|word| is_listed("early soon", word));
    let is_denied = |at: usize| words[..at].iter().rev().take(6).any(|word| is_listed(NOT, word));
    (0..words.len()).any(|at| is_early(at) && is_denied(at))
}

/// The steps of a film about some things, each of one or of several that are one picture.
fn about(subjects: &[Vec<u32>], words: &[&str]) -> Vec<Step> {
    let has = |list: &str| words.iter().any(|word| is_listed(list, word));
    let until_end = words.windows(3).any(|three| three == ["until", "the", "end"]);
    let framed = |ids: &[u32]| Framing { subjects: ids.to_vec(), ..Framing::default() };
    let together = || Framing { whole: true, ..framed(&subjects.concat()) };
    let angle = has(GRAND).then_some(ShotAngle::Low);
    match subjects {
        // From beside it, far enough that it comes last.
        [ids] if has(SECRETS) || until_end || is_held_back(words) => {
            let amount = Some(Amount::Degrees(SURPRISE_DEG));
            vec![Step { end: framed(ids), either_way: true, amount, ..Step::of(Move::PanRight) }]
        }
        [ids] if has(WARES) => vec![Step { end: framed(ids), either_way: true, ..Step::of(Move::ArcRight) }],
        [ids] => vec![Step { end: Framing { angle, ..framed(ids) }, ..Step::of(Move::PushIn) }],
        [_, ..] if has(WARES) && !has(IN_TURN) => {
            vec![Step { end: together(), either_way: true, ..Step::of(Move::ArcRight) }]
        }
        [_, _] if !has(IN_TURN) && subjects.concat().len() <= MOST_TOGETHER => {
            vec![Step { end: together(), ..Step::of(Move::PushIn) }]
        }
        [first, rest @ ..] => {
            let to = |(nth, ids): (usize, &Vec<u32>)| {
                let start = if nth == 0 { framed(first) } else { Framing::default() };
                Step { start, end: framed(ids), ..Step::of(Move::Follow) }
            };
            rest.iter().take(4).enumerate().map(to).collect()
        }
        [] => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::{about as step, direction, linked};

    fn brief(text: &str) -> bool {
        is_brief(&text.split(' ').collect::<Vec<_>>())
    }

    #[test]
    fn a_brief_says_nothing_of_the_camera() {
        assert!(brief("it 's a teaser for a pottery brand . <obj-0> is the product , everything else is dressing"));
        assert!(brief("make <obj-0> and <obj-1> look like the best place on earth to get work done"));
        assert!(brief("the opening of the spot : <obj-0> should look irresistible , like a still life"));
        assert!(brief("like it 's been waiting there for its owner to come back , moody , about <obj-0>"));
        assert!(brief("a still life in the dutch manner : let the eye discover <obj-0> one after another ."));
        assert!(brief(
            "i want the bedroom to feel like somewhere you 'd never get up on a sunday . <obj-0> is the hero"
        ));
        assert!(brief("half an hour before everybody turns up for lunch , <obj-0> is on , people should miss her"));
        assert!(!brief("no wait not <obj-0> , <obj-1> first and then <obj-0> and nice and slow"));
        assert!(!brief("show <obj-0>"));
        assert!(!brief("i want you to come closer to <obj-0> , moody and slow"));
        assert!(!brief("a moody wide shot of <obj-0> in the morning light"));
        assert!(!brief("we open on <obj-0> , which has been waiting for its owner"));
        assert!(!brief("the room feels quiet as we are circling <obj-0> like a ghost"));
    }

    #[test]
    fn what_is_sold_is_gone_around_and_a_group_is_one_picture() {
        let moves = |subjects: &[Vec<u32>], text: &str| -> Vec<Move> {
            let steps = about(subjects, &text.split(' ').collect::<Vec<_>>());
            steps.iter().map(|step| step.movement).collect()
        };
        assert_eq!(moves(&[vec![1]], "<obj-0> is our bestseller"), [Move::ArcRight]);
        assert_eq!(moves(&[vec![1], vec![2, 3]], "<obj-0> and <obj-1> from our shop"), [Move::ArcRight]);
        assert_eq!(moves(&[vec![1]], "<obj-0> at rest"), [Move::PushIn]);
        assert_eq!(moves(&[vec![1], vec![2, 3]], "<obj-0> and <obj-1> , each on its own"), [Move::Follow]);
    }
    #[test]
    fn a_mood_without_a_thing_is_a_look_around() {
        let films = |text: &str| {
            let mut direction = direction(Vec::new());
            film_moods(&linked(text), &mut direction);
            direction.program.steps.iter().map(|step| step.movement).collect::<Vec<Move>>()
        };
        assert_eq!(films("something romantic about dinner for two"), [Move::PanRight]);
        assert_eq!(films("good morning to you all"), []);
        assert_eq!(films("something romantic about <obj-0>"), []);
    }

    #[test]
    fn many_things_are_shown_all_round() {
        let shown = |text: &str, ids: &[u32]| {
            let mut direction = direction(vec![step(Move::Static, ids, [0, 1])]);
            show_many(&linked(text), &mut direction);
            direction.program.steps[0].movement
        };
        assert_eq!(shown("show me all that is on <obj-0>", &[1, 2, 3]), Move::ArcRight);
        assert_eq!(shown("show me <obj-0> and <obj-1>", &[1, 2]), Move::Static);
        assert_eq!(shown("show me a still of <obj-0>", &[1, 2, 3]), Move::Static);
    }
}
