//! Timelines that the shipped weights read part by part.

use cinesplat::director::{Director, SceneContext};
use cinesplat::language::{NamedObject, program_to_notation};
use cinesplat::objects::Object;
use glam::DVec3;

fn program(prompt: &str) -> String {
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
