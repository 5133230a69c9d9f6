//! Heights of the camera in words, and where it stands when the film begins.

use cinesplat::director::{Director, SceneContext, take_levels};
use cinesplat::language::{NamedObject, program_to_notation};
use cinesplat::objects::Object;
use glam::DVec3;

/// The program with the heights that the words name, about five things.
fn program(prompt: &str) -> String {
    let named = |(id, label): (u32, &str)| NamedObject { id, label: label.to_owned() };
    let named = [(1, "vase"), (2, "television"), (3, "sideboard"), (4, "armchair"), (5, "curtain")].map(named);
    let director = Director::embedded().unwrap();
    let context = SceneContext { objects: &[], up: DVec3::Y, center: DVec3::new(0.0, 1.0, -1.5), size: 7.0 };
    let linked = director.link(prompt, &named).unwrap();
    let mut direction = director.direct(&linked, &context).unwrap();
    take_levels(&linked, &context, &mut direction).unwrap();
    program_to_notation(&direction.program)
}

#[test]
fn heights_by_what_people_compare_them_with_are_meters() {
    for (prompt, height) in [
        ("drift toward the armchair with the lens at hip height", ":h0.95u"),
        ("circle the vase at shoulder height", ":h1.45u"),
        ("from a cat's point of view, creep towards the armchair", ":h0.25u"),
        ("push in on the armchair from the height of a seated person", ":h1.2u"),
        ("at table height, push in on the vase", ":h0.75u"),
        ("skimming the floor, move in on the sideboard", ":h0.1u"),
    ] {
        let found = program(prompt);
        assert!(found.contains(height), "{prompt}: {found}");
    }
}

#[test]
fn a_height_throughout_is_that_of_every_move() {
    let found = program("Camera stays at waist level throughout. Push in on the vase, then push in on the armchair.");
    assert_eq!(found.matches(":h1u").count(), 4, "{found}");
}

#[test]
fn a_height_of_the_subject_is_level_with_it() {
    let found = program("180 around the vase clockwise, camera at vase height the whole time");
    assert!(found.contains("end=1:eye-level"), "{found}");
}

#[test]
fn a_view_from_the_air_looks_down() {
    for prompt in ["aerial orbit around the armchair", "from the air, orbit the armchair once"] {
        let found = program(prompt);
        assert!(found.contains("end=4:high"), "{prompt}: {found}");
    }
}

#[test]
fn a_three_quarter_view_is_from_the_front() {
    let found = program("three-quarter view of the armchair, slow push in");
    assert!(found.contains("from-front"), "{found}");
}

#[test]
fn an_opening_that_looks_away_from_a_thing_stands_at_it() {
    let found = program("start at the curtain looking in, slow pan left to the sideboard");
    assert!(found.contains("from=5") && !found.contains("start=5"), "{found}");
}

#[test]
fn the_height_of_another_thing_is_that_of_its_top() {
    let objects = [("workbench", 0.0, 0.45), ("stool", 2.0, 0.25), ("shelf", 4.0, 0.9)];
    let objects: Vec<Object> = (1..)
        .zip(objects)
        .map(|(id, (label, x, half))| Object::from_box(id, label, DVec3::new(x, half, 0.0), DVec3::splat(half)))
        .collect();
    let named: Vec<NamedObject> =
        objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
    let director = Director::embedded().unwrap();
    let context = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::new(2.0, 1.0, 0.0), size: 7.0 };
    let prompt = "push in on the shelf from the height of the stool";
    let linked = director.link(prompt, &named).unwrap();
    let mut direction = director.direct(&linked, &context).unwrap();
    take_levels(&linked, &context, &mut direction).unwrap();
    let found = program_to_notation(&direction.program);
    assert!(found.contains(":h0.5u"), "{found}");
}
