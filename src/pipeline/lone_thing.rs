//! The one thing of a scan, called by the words of a prompt.
//!
//! A person who scans a skull says `the skull`, whatever description a search gave to it. Where nobody has named the only
//! thing of a scene, what a prompt names and the scene lacks is that thing.

use std::borrow::Cow;
use std::cmp::Reverse;

use super::error::PipelineError;
use super::interpreter::names;
use super::said_parts::{self, HEAD, PEOPLE, PERSON};
use cinesplat_director::{Director, Places};
use cinesplat_language::{
    Linked, Relation, Things, Word, is_listed, own_part_at, part_of, said_parts as said_parts_of, tokenize,
};
use cinesplat_objects::{Object, ObjectSet};
use cinesplat_operator::{Amount, Framing, Program};
use cinesplat_scene::Scene;
use cinesplat_trajectory::Move;

/// What a thing stands on: rarely what a scan is about.
const GROUNDS: [&str; 10] =
    ["soil", "ground", "floor", "earth", "grass", "table", "stand", "pedestal", "plinth", "background"];

/// Labels of parts that are only places.
const PLACES: &str = "top base bottom middle front back";
/// Words that make what follows a part of the thing that was named.
const OWNERS: &str = "its his her their";
/// How a thing is seen.
const VIEWS: &str =
    "profile side view angle close-up closeup silhouette outline detail frame screen lens camera till until hole holes";
/// Words that tell where a thing is by another one.
const BESIDE: &str = "beside near behind under next inside against";
/// Words that say how much of a thing is meant.
const AMOUNTS: &str = "whole entire full complete all";
/// What people call a whole thing, which is no part of it.
const WHOLES: &str = "plant tree palm houseplant flower instrument figure statue thing one";
/// Words that make the name before them one of a kind of shop or film.
const WARES: &str = "shop store brand company catalogue catalog film video clip ad advert commercial shot collection lover fan post \
    reel story page website feed profile picture loop teaser trailer listing auction";

/// A prompt with its mentions, and the objects with the label and the parts that the prompt gives to the only thing.
pub(super) fn link<'a>(
    director: &Director,
    prompt: &str,
    objects: &'a ObjectSet,
    scene: &Scene,
) -> Result<(Linked, Cow<'a, ObjectSet>), PipelineError> {
    let up = scene.up.normalize_or_zero();
    let Some(whole) = objects.unnamed_whole() else {
        let mut divided = Cow::Borrowed(objects);
        let warnings = said_parts::add(scene, prompt, &mut divided)?;
        let places = Places { objects: &divided.objects, up };
        let mut linked = director.link_placed(prompt, &names(&divided.objects), places)?;
        linked.warnings.extend(warnings);
        return Ok((linked, divided));
    };
    let has_head = objects.objects.iter().any(|object| object.parent == Some(whole.id) && object.label == HEAD);
    let name = name_of_whole(director, prompt, objects)?.or_else(|| has_head.then(|| PERSON.to_owned()));
    let (id, description) = (whole.id, &whole.label);
    let mut renamed: Cow<'a, ObjectSet> = Cow::Owned(objects.clone());
    if let Some(name) = &name {
        renamed
            .to_mut()
            .objects
            .iter_mut()
            .filter(|object| object.id == id)
            .for_each(|object| object.label.clone_from(name));
    }
    let parts = said_parts::add(scene, prompt, &mut renamed)?;
    let places = Places { objects: &renamed.objects, up };
    // Words for its parts are known once its name is; `the top of the skull` says where to look at it.
    let is_place = |object: &&Object| object.parent == Some(id) && is_listed(PLACES, &object.label);
    let of_kinds: Vec<Object> = renamed.objects.iter().filter(|object| !is_place(object)).cloned().collect();
    let mut linked = director.link_placed(prompt, &names(&of_kinds), places)?;
    let mut taken: Vec<String> = name.into_iter().filter(|name| name != PERSON).collect();
    for group in linked.groups.iter_mut().filter(|group| group.members.is_empty()) {
        group.members = vec![id];
        taken.push(group.name.clone());
    }
    taken.dedup();
    taken.retain(|name| !tokenize(name).last().is_some_and(|last| is_listed(VIEWS, &last.text)));
    let warnings = taken.iter().map(|name| {
        format!("\"{name}\" is taken for <obj-{id}> {description}, the only thing of this scene that has no name")
    });
    linked.warnings.extend(warnings.chain(parts));
    Ok((linked, renamed))
}

/// Lets what a program says of nothing be about the thing of a scan of one thing: `from the side` is then a side of it.
pub(super) fn show(prompt: &str, program: &mut Program, objects: &ObjectSet) {
    let Some(whole) = objects.only_whole() else { return };
    let names_nothing = program.object_ids().is_empty();
    let mut shown: Vec<u32> = Vec::new();
    for step in &mut program.steps {
        // `Down to the body, then pull out and show it whole` is all of it.
        let says_all = || {
            let words = step.words.and_then(|[from, to]| prompt.get(from..to)).map(tokenize).unwrap_or_default();
            words.windows(3).any(|three| three[0].text == "all" && three[1].text == "of" && three[2].text == "it")
        };
        let is_part =
            |id: &u32| objects.objects.iter().any(|object| object.id == *id && object.parent == Some(whole.id));
        let are_parts = || !step.end.subjects.is_empty() && step.end.subjects.iter().all(is_part);
        let takes_in = step.movement == Move::PullOut
            && step.end.whole
            && (step.end.subjects == shown || are_parts() && says_all());
        // `A full circle, all of it in the frame from headstock to stand` begins at no end of it.
        let is_all_round = matches!(step.amount, Some(Amount::Degrees(degrees)) if degrees >= ALL_ROUND_DEG);
        if takes_in && shown != [whole.id] {
            step.end.subjects = vec![whole.id];
        } else if step.movement.is_circular() && is_all_round && !step.start.subjects.is_empty() {
            step.start = Framing { angle: step.start.angle, side: step.start.side, ..Framing::default() };
            step.end.whole = true;
        }
        let is_view = |framing: &Framing| framing.side.is_some() || framing.angle.is_some() || framing.size.is_some();
        let circles = step.movement.is_circular();
        if step.end.subjects.is_empty() && (names_nothing || circles || is_view(&step.end)) {
            step.end.subjects = vec![whole.id];
        }
        if step.start.subjects.is_empty() && is_view(&step.start) {
            step.start.subjects = vec![whole.id];
        }
        let last = if step.end.subjects.is_empty() { &step.start.subjects } else { &step.end.subjects };
        if !last.is_empty() {
            shown.clone_from(last);
        }
    }
}

/// Angle of a circle that shows a thing from all sides, degrees.
const ALL_ROUND_DEG: f64 = 300.0;

/// What a prompt calls the thing of a scan: of the names that neither it nor its parts have, that of a kind of things, of one
/// thing, and not of what it stands on, the one that is said most often. `None` where every name is known.
fn name_of_whole(director: &Director, prompt: &str, objects: &ObjectSet) -> Result<Option<String>, PipelineError> {
    // Nothing is known without objects.
    let linked = director.link(prompt, &[])?;
    let stems = |text: &str| -> Vec<String> { tokenize(text).into_iter().map(|word| word.stem).collect() };
    let known: Vec<String> = objects.objects.iter().flat_map(|object| stems(&object.label)).collect();
    let is_known = |name: &str| stems(name).last().is_none_or(|head| known.contains(head));
    let words = tokenize(prompt);
    let is_own = |name: &str| {
        let own = stems(name);
        let names = |part: &[Word]| part.iter().zip(&own).all(|(word, stem)| word.stem == *stem);
        let owned = |part: &[Word]| is_listed(OWNERS, &part[0].text) && names(&part[1..]);
        words.windows(own.len() + 1).any(owned)
    };
    // `Close the entire way` names nothing.
    let is_amount = |name: &str| tokenize(name).iter().all(|word| is_listed(AMOUNTS, &word.text));
    let mut found: Vec<String> = linked
        .missing_groups()
        .map(|group| plain_name(&group.name))
        .filter(|name| !is_known(name) && !is_own(name) && !is_amount(name))
        .collect();
    let is_kind = |word: &str| !Things::embedded().kinds_of(word).is_empty() || is_listed(PEOPLE, word);
    let is_determined = |at: usize| {
        let before = words[at.saturating_sub(2)..at].iter();
        before.into_iter().any(|word| is_listed("the a an this that my our your his her", &word.text))
    };
    // `Our plant shop` is a shop.
    let is_alone =
        |at: usize| words.get(at + 1).is_none_or(|next| !is_kind(&next.text) && !is_listed(WARES, &next.text));
    let is_name = |at: &usize| {
        let word = &words[*at].text;
        is_kind(word)
            && !is_listed(WARES, word)
            && !is_listed(VIEWS, word)
            && !is_known(word)
            && is_determined(*at)
            && is_alone(*at)
    };
    for word in (0..words.len()).filter(is_name).map(|at| &words[at]) {
        if !found.iter().any(|name| stems(name).contains(&word.stem)) {
            found.push(word.text.clone());
        }
    }
    // Who says only `the eye socket` names a part, and a part is no name of the whole.
    let mut wholes = Vec::new();
    let mut parts = Vec::new();
    for name in found {
        let named = tokenize(&name);
        let is_said = said_parts_of(&named, "")?.iter().any(|part| part.words.end == named.len());
        if is_said || part_of(&name, "")?.is_some_and(|part| !part.is_small) {
            parts.push(name.clone());
        }
        if !is_part(&name, objects)? {
            wholes.push(name);
        }
    }
    // `Circle the head` is said of a scan of a head; `from the feet to the head` is not.
    let is_whole = |name: &String| !parts.contains(name) || parts.len() == 1 && stands_for_all(&words, name);
    let mut found: Vec<String> = wholes.into_iter().filter(is_whole).collect();
    // `The screen beside the display case` is where the film is shown.
    let is_elsewhere = |head: Option<&Word>| {
        let at = words.iter().position(|word| head.is_some_and(|head| head.stem == word.stem));
        let before = at.map_or(&words[..0], |at| &words[at.saturating_sub(3)..at]);
        before.iter().any(|word| is_listed(BESIDE, &word.text))
    };
    found.sort_by_key(|name| {
        let named = tokenize(name);
        let head = named.last();
        let times = words.iter().filter(|word| head.is_some_and(|head| head.stem == word.stem)).count();
        let is_plural = head.is_some_and(|head| head.stem != head.text);
        let is_ground = named.iter().any(|word| GROUNDS.contains(&word.stem.as_str()));
        (
            parts.contains(name),
            is_ground,
            is_elsewhere(head),
            !head.is_some_and(|head| is_kind(&head.text)),
            is_plural,
            Reverse(times),
        )
    });
    Ok(found.first().cloned())
}

/// Whether words speak of all of a thing by the name of a part: it is nobody's (`its head`), has nothing that is its own (`the foot
/// of the stand`), and nothing leads from it or up to it.
fn stands_for_all(words: &[Word], name: &str) -> bool {
    let stems: Vec<String> = tokenize(name).into_iter().map(|word| word.stem).collect();
    let Some(last) = stems.last() else { return false };
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let is_part = |at: usize| {
        let before = (1..=3).filter_map(|back| at.checked_sub(back)).map(text);
        let leads = before.clone().any(|word| is_listed("from to until till top bottom foot feet side 's", word));
        leads || before.take(2).any(|word| is_listed(OWNERS, word)) || matches!(text(at + 1), "of" | "'s")
    };
    !(0..words.len()).filter(|at| words[*at].stem == *last).any(is_part)
}

/// Whether a name is that of a small part, of how a thing is seen, or of one of the parts that a search has found.
fn is_part(name: &str, objects: &ObjectSet) -> Result<bool, PipelineError> {
    let stems: Vec<String> = tokenize(name).into_iter().map(|word| word.stem).collect();
    let phrase = stems.join(" ");
    let is_named = |object: &Object| Things::embedded().is_related(&object.label, &phrase, &[Relation::Same]);
    let is_view = is_listed(VIEWS, &phrase);
    let found = objects.objects.iter().filter(|object| object.parent.is_some()).any(is_named);
    let is_whole = stems.last().is_some_and(|head| is_listed(WHOLES, head));
    // The helmet of a person is his head's.
    let words = tokenize(name);
    for object in objects.objects.iter().filter(|object| object.parent.is_some() && object.label == HEAD) {
        if own_part_at(&words, &object.label)?.is_some() || part_of(&format!("his {name}"), "")?.is_some() {
            return Ok(true);
        }
    }
    Ok(is_view || found && !is_whole || part_of(name, "")?.is_some_and(|part| part.is_small))
}

/// A name without what says how much of the thing is meant and where it is: `whole guitar on its stand` is the guitar.
fn plain_name(name: &str) -> String {
    let words = tokenize(name);
    let is_amount = |word: &Word| is_listed(AMOUNTS, &word.text);
    // `The man's face` is that of the man.
    let is_place = |word: &Word| is_listed("on in at with from by of under beside 's", &word.text);
    let front = words.iter().skip_while(|word| is_amount(word)).take_while(|word| !is_place(word));
    let front: Vec<&str> = front.map(|word| word.text.as_str()).collect();
    if front.is_empty() { name.to_owned() } else { front.join(" ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_operator::Step;
    use glam::DVec3;

    fn about(id: u32) -> Framing {
        Framing { subjects: vec![id], ..Framing::default() }
    }

    /// The steps as they are filmed in a scan of a guitar (1) with body (2) and neck (3).
    fn shown(steps: Vec<Step>) -> Vec<Step> {
        let object = |id: u32, parent: Option<u32>, count: usize| Object {
            parent,
            num_gaussians: count,
            ..Object::from_box(id, "large brown object", DVec3::ZERO, DVec3::ONE)
        };
        let objects = vec![object(1, None, 90), object(2, Some(1), 60), object(3, Some(1), 30)];
        let mut program = Program { steps, ..Program::default() };
        show("", &mut program, &ObjectSet { objects, labels: Vec::new() });
        program.steps
    }

    #[test]
    fn a_pull_out_to_the_whole_of_the_part_that_is_shown_takes_in_all() {
        let whole = Framing { whole: true, ..about(2) };
        let body = Step { end: about(2), ..Step::of(Move::CraneDown) };
        let out = Step { end: whole, ..Step::of(Move::PullOut) };
        assert_eq!(shown(vec![body, out.clone()])[1].end.subjects, [1]);
        let neck = Step { end: about(3), ..Step::of(Move::CraneUp) };
        assert_eq!(shown(vec![neck, out])[1].end.subjects, [2]);
    }

    #[test]
    fn a_full_circle_begins_at_no_end_of_its_thing() {
        let circle = |degrees: f64| Step {
            start: about(3),
            end: about(1),
            amount: Some(Amount::Degrees(degrees)),
            ..Step::of(Move::OrbitRight)
        };
        let full = &shown(vec![circle(360.0)])[0];
        assert!(full.start.subjects.is_empty() && full.end.whole);
        assert_eq!(shown(vec![circle(90.0)])[0].start.subjects, [3]);
    }
}
