//! Parts of the only thing of a scan that a prompt names and that no search has found, as objects of their own: the crest of a
//! chair, the boots of a man. `prompts/parts.txt` says how high they sit.

use std::borrow::Cow;

use cinesplat_critic::Subjects;
use cinesplat_geometry::LevelFrame;
use cinesplat_language::{Relation, SaidPart, Things, Word, is_listed, said_parts, tokenize};
use cinesplat_objects::{Object, ObjectSet, Region, is_description};
use cinesplat_scene::Scene;
use glam::DVec3;

use super::error::PipelineError;

/// The part that only people have.
pub(super) const HEAD: &str = "head";
/// People whom the list of kinds of things lacks.
pub(super) const PEOPLE: &str = "biker rider motorcyclist cyclist photographer dancer model player driver runner athlete mannequin singer \
    musician fellow dude gentleman chap monk bride groom fighter boxer skater surfer hiker farmer sailor statue sculpture";
/// What a thing with a head is called where the words do not say it.
pub(super) const PERSON: &str = "person";
/// Depth of a part of the front or the back, and reach of one at a side, as shares of the thing.
const FRONT: [f64; 2] = [0.4, 1.0];
/// Depth of a small part of the front: teeth, eyes.
const FACE: [f64; 2] = [0.6, 1.0];
const BACK: [f64; 2] = [0.0, 0.6];
const RIGHT: [f64; 2] = [0.7, 1.0];
const LEFT: [f64; 2] = [0.0, 0.3];
/// Share of a head with its neck of the height of a standing person from head to toe (Bammes, *Die Gestalt des Menschen*), and that
/// from which on he is not there down to his feet.
const HEAD_FRAC: f64 = 0.155;
const CROPPED_FRAC: f64 = 0.2;
/// Words between a name and `the other`.
const NEAR: usize = 6;

/// Adds the parts of the only thing of a scan that a prompt names, and returns a warning for each. Heights of parts hold for what
/// is there from end to end; of a person who is not there down to the feet they are measured in heads.
///
/// # Errors
/// [`PipelineError::Language`] for a damaged list of parts, [`PipelineError::Render`] when the thing cannot be looked at.
pub(super) fn add(scene: &Scene, prompt: &str, objects: &mut Cow<'_, ObjectSet>) -> Result<Vec<String>, PipelineError> {
    let mut warnings = Vec::new();
    let Some(whole) = objects.only_whole().cloned() else { return Ok(warnings) };
    let Ok(frame) = LevelFrame::new(scene.up) else { return Ok(warnings) };
    if objects.labels.is_empty() {
        return Ok(warnings);
    }
    let below = missing_below(objects, &whole, frame.up);
    let mut taken: Vec<Region> = Vec::new();
    let words = tokenize(prompt);
    let stems = |text: &str| -> Vec<String> { tokenize(text).into_iter().map(|word| word.stem).collect() };
    let mut front = None;
    for part in said_parts(&words, &whole.label)? {
        let Some([low, high]) = part.place.heights_percent else { continue };
        let up = [low, high].map(|percent| (f64::from(percent) / 100.0 * (1.0 + below) - below).max(0.0));
        if up[0] >= up[1] {
            continue;
        }
        let ahead = match (part.place.place, front) {
            ("top" | "bottom" | "middle", _) => None,
            (_, Some(known)) => known,
            _ => *front.insert(front_of(scene, objects.as_ref(), whole.id, &frame)?),
        };
        for (label, along) in places(&words, &part, ahead, frame.up) {
            let is_known = |object: &Object| stems(&object.label) == stems(&label);
            if objects.objects.iter().any(is_known) {
                continue;
            }
            // Two names of one part are one object.
            let region = Region { up, along };
            if taken.contains(&region) {
                continue;
            }
            taken.push(region);
            if let Some(id) = objects.to_mut().cut_part(&scene.gaussians, whole.id, &frame, &region, &label) {
                let id_of_whole = whole.id;
                warnings.push(format!(
                    "\"{label}\" is taken for what lies at {low} to {high} % of the height of <obj-{id_of_whole}>, as <obj-{id}>"
                ));
            }
        }
    }
    Ok(warnings)
}

/// The front of a thing, as the judge of films sees it.
fn front_of(scene: &Scene, objects: &ObjectSet, id: u32, frame: &LevelFrame) -> Result<Option<DVec3>, PipelineError> {
    Ok(Subjects::new(&scene.gaussians, objects, &[id]).front(id, frame)?)
}

/// A level axis and the shares along it that a part takes.
type Along = Option<(DVec3, [f64; 2])>;

/// The label of a part and where it sits on the level; two for one on each side.
fn places(words: &[Word], part: &SaidPart, ahead: Option<DVec3>, up: DVec3) -> Vec<(String, Along)> {
    let name = &part.name;
    let Some(ahead) = ahead else { return vec![(name.clone(), None)] };
    // Right is that of somebody who sees the front.
    let right = up.cross(ahead);
    let before = &words[part.words.start.saturating_sub(4)..part.words.start];
    let behind = &words[part.words.end..words.len().min(part.words.end + NEAR)];
    let says = |list: &str| before.iter().any(|word| is_listed(list, &word.text));
    let is_plural = words[part.words.end - 1].text != words[part.words.end - 1].stem;
    let sided = |side: &str, shares| (format!("{side} {name}"), Some((right, shares)));
    match part.place.place {
        "front" if part.place.is_small => vec![(name.clone(), Some((ahead, FACE)))],
        "front" => vec![(name.clone(), Some((ahead, FRONT)))],
        "back" => vec![(name.clone(), Some((ahead, BACK)))],
        "left" => vec![(name.clone(), Some((right, LEFT)))],
        "right" => vec![(name.clone(), Some((right, RIGHT)))],
        "sides" if says("left") => vec![sided("left", LEFT)],
        "sides" if says("right") => vec![sided("right", RIGHT)],
        "sides" if behind.iter().any(|word| word.text == "other") => vec![sided("left", LEFT), sided("right", RIGHT)],
        "sides" if !is_plural || says("one") => vec![(name.clone(), Some((right, RIGHT)))],
        _ => vec![(name.clone(), None)],
    }
}

/// How much of a person is missing below what is there, in heights of what is there; 0 for other things.
fn missing_below(objects: &ObjectSet, whole: &Object, up: DVec3) -> f64 {
    let height = |object: &Object| {
        let [low, high] = object.span_along(up);
        high - low
    };
    // A robot's head may be half of it.
    if !is_person(&whole.label) && !is_description(&whole.label) {
        return 0.0;
    }
    let is_head = |object: &&Object| object.parent == Some(whole.id) && object.label == HEAD;
    let head = objects.objects.iter().find(is_head).map_or(0.0, height);
    let share = head / height(whole).max(f64::MIN_POSITIVE);
    if share > CROPPED_FRAC { share / HEAD_FRAC - 1.0 } else { 0.0 }
}

/// Whether a label is one of a person.
fn is_person(label: &str) -> bool {
    let is_listed_one = tokenize(label).last().is_some_and(|head| is_listed(PEOPLE, &head.stem));
    is_listed_one || Things::embedded().is_related(label, PERSON, &[Relation::Same, Relation::Broader])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(head_height: f64) -> ObjectSet {
        let part = |id, label: &str, y: f64, half: f64, parent| Object {
            parent,
            ..Object::from_box(id, label, DVec3::Y * y, DVec3::new(0.3, half, 0.3))
        };
        let head = part(2, HEAD, 2.0 - head_height / 2.0, head_height / 2.0, Some(1));
        ObjectSet { objects: vec![part(1, "man", 1.0, 1.0, None), head], labels: Vec::new() }
    }

    #[test]
    fn a_bust_lacks_what_is_below_it() {
        let missing = |head_height: f64| {
            let set = set(head_height);
            missing_below(&set, &set.objects[0], DVec3::Y)
        };
        assert!(missing(0.3).abs() < 1e-9, "from head to toe");
        // A head with its neck of half of the height: two of six and a half of them.
        assert!((missing(1.0) - (0.5 / HEAD_FRAC - 1.0)).abs() < 1e-9);
        let mut robot = set(1.0);
        robot.objects[0].label = "robot".to_owned();
        let missing = missing_below(&robot, &robot.objects[0], DVec3::Y);
        assert!(missing.abs() < 1e-9, "its head may be half of it");
    }

    #[test]
    fn parts_at_the_sides_are_told_by_their_words() {
        let labels = |prompt: &str| -> Vec<String> {
            let words = tokenize(prompt);
            let parts = said_parts(&words, "armchair").unwrap();
            let places = parts.iter().flat_map(|part| places(&words, part, Some(DVec3::Z), DVec3::Y));
            places.map(|(label, along)| format!("{label}{}", if along.is_some() { " there" } else { "" })).collect()
        };
        assert_eq!(labels("close on the left armrest"), ["left armrest there"]);
        assert_eq!(labels("close on one of the armrests"), ["armrests there"]);
        assert_eq!(labels("swing from one armrest to the other"), ["left armrest there", "right armrest there"]);
        assert_eq!(labels("both armrests in the picture"), ["armrests"]);
        assert_eq!(labels("up to the crest"), ["crest"]);
    }
}
