//! Directions that stand beside the verb.

use cinesplat::director::{Director, SceneContext};
use cinesplat::language::NamedObject;
use cinesplat::objects::Object;
use cinesplat::trajectory::Move;
use glam::DVec3;

fn moves(prompt: &str) -> Vec<(Move, bool)> {
    let object = Object::from_box(1, "microwave", DVec3::new(0.0, 0.5, -1.0), DVec3::new(0.3, 0.5, 0.2));
    let director = Director::embedded().unwrap();
    let linked = director.link(prompt, &[NamedObject { id: 1, label: object.label.clone() }]).unwrap();
    let objects = [object];
    let context = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::new(0.0, 1.0, -1.5), size: 7.0 };
    let steps = director.direct(&linked, &context).unwrap().program.steps;
    steps.iter().map(|step| (step.movement, step.either_way)).collect()
}

#[test]
fn a_direction_beside_the_verb_is_the_direction_of_the_move() {
    for (prompt, movement) in [
        ("truck left along the counter, keep looking at the microwave the whole time", Move::TruckLeft),
        ("truck right along the counter, keep looking at the microwave the whole time", Move::TruckRight),
        ("tilt slowly up the microwave", Move::TiltUp),
        ("orbit to the left around the microwave", Move::OrbitLeft),
        ("crabbing right past the microwave", Move::TruckRight),
    ] {
        assert_eq!(moves(prompt).first(), Some(&(movement, false)), "{prompt}");
    }
}

#[test]
fn a_direction_that_nobody_said_is_open() {
    for prompt in ["circle the microwave", "slide along the microwave", "sweep your gaze across the microwave"] {
        let found = moves(prompt);
        assert!(found[0].0.opposite().is_some() && found[0].1, "{prompt}: {found:?}");
    }
}

#[test]
fn a_way_back_goes_against_the_way_there() {
    let found =
        moves("Rotate round the microwave 30 degrees to the left, freeze for 2 seconds, then retrace the same curve.");
    assert_eq!(
        found.iter().map(|(movement, _)| *movement).collect::<Vec<_>>(),
        [Move::OrbitLeft, Move::Static, Move::OrbitRight]
    );
}

#[test]
fn where_a_thing_is_says_no_way_past_it() {
    let director = Director::embedded().unwrap();
    let boxed =
        |id: u32, label: &str, y: f64| Object::from_box(id, label, DVec3::new(0.0, y, -1.0), DVec3::new(0.5, 0.3, 0.2));
    let objects = [boxed(1, "cupboard", 0.4), boxed(2, "television", 1.4)];
    let names: Vec<NamedObject> =
        objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
    let context = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::new(0.0, 1.0, -1.5), size: 7.0 };
    let linked = director.link("7 second move in on the cupboard under the television", &names).unwrap();
    let program = director.direct(&linked, &context).unwrap().program;
    assert_eq!((program.steps[0].movement, program.steps[0].via.as_ref()), (Move::PushIn, None));
}

#[test]
fn film_grain_is_no_bench() {
    let director = Director::embedded().unwrap();
    let linked = |label: &str, prompt: &str| {
        director.link(prompt, &[NamedObject { id: 1, label: label.to_owned() }]).unwrap().tokens_text
    };
    let text = linked("bench", "Truck along the bench with film grain, but no motion blur");
    assert_eq!(text, "truck along <obj-0> with film grain , but no motion blur");
    assert!(linked("green screen", "orbit the green screen").contains("<obj-0>"));
}

#[test]
fn a_number_of_the_shutter_is_no_amount_of_a_move() {
    let director = Director::embedded().unwrap();
    let linked = director.link("orbit the vase with a 180 degree shutter, 35mm film grain", &[]).unwrap();
    assert_eq!(linked.quantities, []);
}
