//! Briefs: what a film is about and how it should feel, with no word of what the camera does: `A teaser for a pottery brand.
//! The orange vase is the product, everything else is set dressing.`
//!
//! Nobody who writes a brief wants a photo, or what the network makes up from words of other things. The film goes slowly
//! towards what the brief is about.

use cinesplat_language::{Linked, Quantity, QuantityKind, is_listed};
use cinesplat_objects::Object;
use cinesplat_operator::{Amount, Framing, Speed, Step};
use cinesplat_trajectory::Move;

use super::bans::SENTENCE_ENDS;
use super::directions::is_form;
use crate::direction::{Direction, StepCertainty};

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
    toward around round past along through cut cuts camera stills photo photograph picture snapshot frozen motionless \
    first then next finally backwards forwards backward forward sideways left right away";
/// Verbs whose `up` or `down` is no way: `somewhere you'd never get up`.
const NO_WAYS: &str = "get got getting wake woke waking give gave pick picked picking set sit sits sitting lie lying grow \
    stand stands hang make made dress dressed tidy tidied grown let calm slow settle";
/// Words with which another word is one of cameras: `look at`, `open on`, `come closer`.
const LEADS: [(&str, &str); 10] = [
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
];
/// Fewest words of a brief: `show me the sofa` is a picture of the sofa.
const FEWEST_WORDS: usize = 8;
/// Certainty of a step below which a reading of a brief is made up.
const MADE_UP: f64 = 0.2;
/// The same where it is one step.
const ONE_MADE_UP: f64 = 0.3;
/// Certainty of what a brief leaves open.
const OPEN_PROBABILITY: f64 = 0.25;

/// Words that make one thing what the brief is about: `the bed is the hero`.
const HEROES: &str = "hero product star subject main focal centerpiece centrepiece point protagonist mostly";
/// Words by which a thing comes last.
const SECRETS: &str = "secret surprise payoff";
/// Angle of a turn to a thing that is out of the picture at first, degrees.
const SURPRISE_DEG: f64 = 80.0;
/// Words of a thing that is to be seen from more than one side.
const WARES: &str = "product shop store brand catalogue catalog webshop sell selling sale bestseller customers customer buyers sculpture \
    statue figurine model toy";
/// Words that show one thing after the other.
const IN_TURN: &str = "each every turn another";
/// Words of a place as a whole.
const PLACES: &str =
    "room bedroom kitchen bathroom lounge space flat apartment studio house home office interior place";
const SPACES: &str = "space light spacious airy roomy bright layout size big large";
/// Words of a calm film, and of a lively one.
const CALM: &str = "slow slowly calm calmly lazy soft softly gentle gently quiet quietly moody elegant elegantly dreamy peaceful \
    serene cosy cozy tender sleepy hush hushed intimate";
const LIVELY: &str = "fast punchy energetic dynamic snappy lively quick action";
const NOT: &str = "not never 't without no hide avoid nobody nothing";

/// Replaces a picture at rest, or a reading that is hardly sure, of a brief.
pub(crate) fn film_briefs(linked: &Linked, objects: &[Object], direction: &mut Direction) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let is_rest = |step: &Step| step.movement == Move::Static && step.with.is_empty() && !step.end.whole;
    let rests = matches!(&direction.program.steps[..], [step] if is_rest(step));
    let least = if direction.program.steps.len() == 1 { ONE_MADE_UP } else { MADE_UP };
    let is_made_up = direction.certainty.iter().any(|step| step.probability < least);
    let is_loose = rests || is_made_up && !direction.program.steps.is_empty();
    // Angles and lengths are what a camera keeps.
    let measures = |quantity: &Quantity| quantity.kind != QuantityKind::Seconds;
    let is_measured = linked.quantities.iter().any(measures);
    if !is_loose || linked.timeline.is_some() || is_measured || !is_brief(&said(linked, &words)) {
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
    let of_place = has(PLACES) && (subjects.is_empty() || has(SPACES));
    let mut steps = if of_place || subjects.is_empty() { vec![Step::look_around()] } else { about(&subjects, &words) };
    // The same move, of which the network may have read more.
    if let ([read], [brief]) = (&direction.program.steps[..], &steps[..])
        && read.movement == brief.movement
        && read.end.subjects == brief.end.subjects
    {
        return;
    }
    let speed = match (has(CALM), has(LIVELY)) {
        (true, false) => Speed::Slow,
        (false, true) => Speed::Fast,
        _ => Speed::Normal,
    };
    let from = direction.program.steps.iter().filter_map(|step| step.words).map(|[from, _]| from).min();
    let to = direction.program.steps.iter().filter_map(|step| step.words).map(|[_, to]| to).max();
    for step in &mut steps {
        (step.speed, step.words) = (speed, from.zip(to).map(|(from, to)| [from, to]));
        step.avoid.extend(denied.iter().filter(|id| !subjects.contains(id)));
    }
    let certainty = |step: &Step| StepCertainty {
        probability: OPEN_PROBABILITY,
        weakest: ("move", OPEN_PROBABILITY),
        words: step.words,
    };
    direction.certainty = steps.iter().map(certainty).collect();
    // The network's cameras belong to other steps.
    direction.step_cameras.clear();
    direction.program.steps = steps;
}

/// The words but those that stand for a part of a thing: `the back` of an armchair is no way.
fn said<'a>(linked: &Linked, words: &[&'a str]) -> Vec<&'a str> {
    let spans = &linked.spans;
    let stands_for_part = |at: usize| {
        (at + 1..words.len().min(at + 5)).any(|next| spans.get(next) == spans.get(at) && words[next].starts_with('<'))
    };
    (0..words.len()).filter(|at| !stands_for_part(*at)).map(|at| words[at]).collect()
}

/// Whether words say nothing of what a camera does, and are enough for a brief.
fn is_brief(words: &[&str]) -> bool {
    words.len() >= FEWEST_WORDS && !directs(words)
}

/// Whether words say something of what a camera does.
pub(super) fn directs(words: &[&str]) -> bool {
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
        // `Arm rests` are no rest.
        let is_part = word == "rests"
            && at > 0
            && (is_listed("arm head foot back", words[at - 1]) || words[at - 1].starts_with('<'));
        let is_verb = VERBS.iter().any(|verb| is_form(word, verb)) && !is_listed("resting movement", word) && !is_part;
        let before = words[at.saturating_sub(2)..at].iter();
        let is_way = matches!(word, "up" | "down") && !before.into_iter().any(|word| is_listed(NO_WAYS, word));
        is_verb || is_listed(WORDS, word) || leads(at) || is_way
    };
    (0..words.len()).any(is_camera)
}

/// What a brief is about, in order of mention: the thing that it calls the hero, or else all that it names but what is `denied`.
fn subjects(linked: &Linked, words: &[&str], denied: &[u32]) -> Vec<u32> {
    let sentences = words.split(|word| SENTENCE_ENDS.contains(word) || *word == ",");
    let named = |words: &[&str]| -> Vec<u32> {
        let slots: Vec<u32> = words.iter().filter_map(|word| linked.slot_at(word)).collect();
        linked.expanded(&slots)
    };
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

/// What a sentence says is not to be seen.
fn denied(linked: &Linked, words: &[&str]) -> Vec<u32> {
    let slots = (0..words.len()).filter_map(|at| {
        let id = linked.slot_at(words[at])?;
        let before = words[..at].iter().rev().take_while(|word| !SENTENCE_ENDS.contains(word)).take(4);
        before.into_iter().any(|word| is_listed(NOT, word)).then_some(id)
    });
    linked.expanded(&slots.collect::<Vec<_>>())
}

/// The steps of a film about some things.
fn about(subjects: &[u32], words: &[&str]) -> Vec<Step> {
    let has = |list: &str| words.iter().any(|word| is_listed(list, word));
    let until_end = words.windows(3).any(|three| three == ["until", "the", "end"]);
    let framed = |ids: &[u32]| Framing { subjects: ids.to_vec(), ..Framing::default() };
    match subjects {
        // From beside it, far enough that it comes last.
        [id] if has(SECRETS) || until_end => {
            let amount = Some(Amount::Degrees(SURPRISE_DEG));
            vec![Step { end: framed(&[*id]), either_way: true, amount, ..Step::of(Move::PanRight) }]
        }
        [id] if has(WARES) => vec![Step { end: framed(&[*id]), either_way: true, ..Step::of(Move::ArcRight) }],
        [id] => vec![Step { end: framed(&[*id]), ..Step::of(Move::PushIn) }],
        [_, _] if !has(IN_TURN) => {
            vec![Step { end: Framing { whole: true, ..framed(subjects) }, ..Step::of(Move::PushIn) }]
        }
        [first, rest @ ..] => {
            let to = |(nth, id): (usize, &u32)| {
                let start = if nth == 0 { framed(&[*first]) } else { Framing::default() };
                Step { start, end: framed(&[*id]), ..Step::of(Move::Follow) }
            };
            rest.iter().take(4).enumerate().map(to).collect()
        }
        [] => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert!(!brief("no wait not <obj-0> , <obj-1> first and then <obj-0> and nice and slow"));
        assert!(!brief("show <obj-0>"));
        assert!(!brief("i want you to come closer to <obj-0> , moody and slow"));
        assert!(!brief("a moody wide shot of <obj-0> in the morning light"));
        assert!(!brief("we open on <obj-0> , which has been waiting for its owner"));
        assert!(!brief("the room feels quiet as we are circling <obj-0> like a ghost"));
    }
}
