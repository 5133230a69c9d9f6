//! Timelines that the shipped weights read part by part.

use cinesplat::director::{Director, SceneContext};
use cinesplat::language::{NamedObject, program_to_notation};
use cinesplat::objects::Object;
use glam::DVec3;

/// The program that the shipped weights read, about five things.
pub(super) fn program(prompt: &str) -> String {
    let labels = ["vase", "television", "sideboard", "armchair", "curtain"];
    let placed = |(idx, label): (usize, &&str)| {
        let center = DVec3::new(idx as f64 - 2.0, 0.5, -1.0 - (idx % 2) as f64);
        Object::from_box(1 + idx as u32, label, center, DVec3::new(0.3, 0.5, 0.2))
    };
    let objects: Vec<Object> = labels.iter().enumerate().map(placed).collect();
    let named: Vec<NamedObject> =
        objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
    let director = Director::embedded().unwrap();
    let context = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::new(0.0, 1.0, -1.5), size: 7.0 };
    let direction = director.direct(&director.link(prompt, &named).unwrap(), &context).unwrap();
    assert_eq!(direction.certainty.len(), direction.program.steps.len(), "{prompt}");
    program_to_notation(&direction.program)
}

#[test]
fn beats_last_as_long_as_their_times_say() {
    for (prompt, expected) in [
        (
            "0:00-0:03 static on the vase\n0:03-0:07 tilt up to the television\n0:07-0:10 push in on it",
            "static end=1 dur=3s / tilt-up end=2 dur=4s / push-in end=2 dur=3s",
        ),
        (
            "3s orbit the armchair to the right, 3s push in on it, 2s hold",
            "orbit-right end=4 dur=3s / push-in end=4 dur=3s / static end=4 dur=2s",
        ),
    ] {
        assert_eq!(program(prompt), expected, "{prompt}");
    }
}

#[test]
fn a_turn_ends_on_what_the_next_beat_lands_on() {
    let program = program("T+0 static on the vase | T+3 pan right | T+6 land on the television | T+8 out");
    assert!(program.contains("pan-right end=2 dur=3s"), "{program}");
}

#[test]
fn pictures_on_both_sides_of_a_cut_are_kept() {
    for (prompt, expected) in [
        (
            "Establishing shot of the sideboard, then cut to a close-up of the vase. Eight seconds.",
            "static end=3:extreme-long / static end=1:close-up cut | total=8s",
        ),
        ("push in on the armchair, smash cut to the television", "push-in end=4 / static end=2 cut"),
        ("10 second film: push in on the vase, cut to the armchair", "push-in end=1 / static end=4 cut | total=10s"),
    ] {
        assert_eq!(program(prompt), expected, "{prompt}");
    }
}

#[test]
fn numbers_of_a_list_are_no_objects() {
    let expected = "static end=1 / orbit-right end=4 / push-in end=2";
    assert_eq!(
        program("#1 static on the vase. #2 orbit the armchair to the right. #3 push in on the television"),
        expected
    );
    assert_eq!(
        program("1. static on the vase 2. orbit the armchair to the right 3. push in on the television"),
        expected
    );
}

#[test]
fn a_beat_may_start_with_start() {
    let program = program("0:00 static on the vase / 0:02 start rising / 0:06 hold on the television");
    assert!(program.starts_with("static end=1 dur=2s / pedestal-up"), "{program}");
}

#[test]
fn a_denied_cut_is_none_and_lengths_of_pictures_stay_theirs() {
    for prompt in
        ["please don't cut to anything else, just orbit the vase", "the camera cuts to the vase after panning"]
    {
        assert!(!program(prompt).contains(" / static"), "{prompt}: {}", program(prompt));
    }
    let found = program("push in on the vase for 3 seconds, cut to the armchair for 5 seconds");
    assert!(!found.contains("total=5s"), "{found}");
}
