//! What the words of a prompt say plainly, over what the network reads into them.

use cinesplat::director::{Director, SceneContext};
use cinesplat::language::NamedObject;
use cinesplat::objects::Object;
use cinesplat::trajectory::Move;
use glam::DVec3;

use super::beats::program;

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
fn things_that_the_words_join_are_in_one_picture() {
    for (prompt, expected) in [
        ("Back away from the armchair untill I can see also the curtain and the sideboard.", "end=4+3+5!"),
        ("truck right from the vase to the television, then dolly back to a wide with both in frame", "end=1+2:long!"),
        ("the vase, the armchair and the television must all be visible the whole time while you rise", "keep=1+4+2"),
    ] {
        let found = program(prompt);
        assert!(found.contains(expected), "{prompt}: {found}");
    }
}

#[test]
fn what_is_never_to_be_seen_together_is_not_kept() {
    for prompt in [
        "the vase and the armchair should never be visible at the same time while you push in on the vase",
        "the vase and the armchair must never be visible during the whole move, push in on the television",
    ] {
        let found = program(prompt);
        assert!(!found.contains("keep=1+4") && !found.contains("1+4:"), "{prompt}: {found}");
    }
}

#[test]
fn both_moves_are_not_both_things() {
    let found = program("push in on the vase, then pan to the armchair, do both in slow motion");
    assert!(!found.contains("1+4"), "{found}");
}

#[test]
fn a_pair_is_passed_and_not_gone_along() {
    let found = program("truck right past the vase and the television");
    assert!(!found.contains("along="), "{found}");
}

#[test]
fn what_a_move_goes_on_to_show_is_its_end() {
    let found = program("Back away from the vase until I can see also the curtain and the television.");
    assert_eq!(found.matches(" / ").count(), 0, "{found}");
}

#[test]
fn sizes_with_an_arrow_are_the_first_and_the_last() {
    let found = program("slow push, MCU > CU on the vase. straight in");
    assert!(found.contains("start=1:medium-close-up end=1:close-up"), "{found}");
}

#[test]
fn a_look_before_a_whip_is_at_rest() {
    let director = Director::embedded().unwrap();
    let named = |id: u32, label: &str| NamedObject { id, label: label.to_owned() };
    let names = [named(1, "vase"), named(2, "brick wall")];
    let prompt = "Look at the brick wall outside and then whip round really quick to the vase";
    let context = SceneContext { objects: &[], up: DVec3::Y, center: DVec3::new(0.0, 1.0, -1.5), size: 7.0 };
    let steps = director.direct(&director.link(prompt, &names).unwrap(), &context).unwrap().program.steps;
    assert_eq!(steps.iter().map(|step| step.movement).collect::<Vec<_>>(), [Move::Static, Move::WhipPan]);
}

#[test]
fn a_rise_from_the_floor_begins_low() {
    let found = program("rise up from near the floor till we are higher than the armchair");
    assert!(found.contains("start=4:low"), "{found}");
}

#[test]
fn half_a_meter_of_rise_is_no_height() {
    let found = program("rise up about half a meter with the vase in frame");
    assert!(found.contains("amount=0.5u") && !found.contains(":h0.5u"), "{found}");
    let found = program("lower the camera to 1 meter");
    assert!(found.contains(":h1u") && !found.contains("amount"), "{found}");
}

#[test]
fn a_shorter_name_is_the_thing_named_before() {
    let director = Director::embedded().unwrap();
    let named = |id: u32, label: &str| NamedObject { id, label: label.to_owned() };
    let objects = [named(1, "drawer chest"), named(2, "pink drawers"), named(3, "plates")];
    let slots = |prompt: &str| director.link(prompt, &objects).unwrap().slots;
    assert_eq!(slots("tilt down from the plates to the pink drawers, then push in on the drawers"), [3, 2]);
    assert_eq!(slots("pan from the pink drawers to the drawer chest"), [2, 1]);
    assert_eq!(slots("push in on <obj-3> on <obj-1>, then pan to <obj-2>"), [3, 1, 2]);
    let objects = [named(1, "table lamp"), named(2, "wooden table")];
    assert_eq!(director.link("pan from the table lamp to the table", &objects).unwrap().slots, [1, 2]);
    let objects = [named(1, "tool wall"), named(2, "pink toolbox"), named(3, "yellow toolbox")];
    let fills = "push in on the tool wall until the tools fill the frame, then pan to the pink toolbox";
    assert_eq!(director.link(fills, &objects).unwrap().slots, [1, 2]);
}

#[test]
fn a_place_that_tells_which_thing_is_meant_is_no_thing() {
    let director = Director::embedded().unwrap();
    let named = |id: u32, label: &str| NamedObject { id, label: label.to_owned() };
    let objects = [named(1, "teal base cabinet"), named(2, "red teapot"), named(3, "wooden table")];
    let slots = |prompt: &str| director.link(prompt, &objects).unwrap().slots;
    assert_eq!(slots("drift towards the teapot on the shelf and finish tight on it"), [2]);
    assert_eq!(slots("push in on the teapot on the table"), [2]);
    assert_eq!(slots("pan from the teapot to the table"), [2, 3]);
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

#[test]
fn what_stands_still_neither_shakes_nor_walks() {
    let found = program("pan right from the armchair to the television, tripod");
    assert!(!found.contains("handheld"), "{found}");
    let found = program("He stays where he is. Only his gaze wanders from the curtain over to the armchair.");
    assert!(found.starts_with("pan") && found.contains("either"), "{found}");
    let found = program("dutch-angle close-up of the vase, horizon tipped, camera frozen");
    assert!(found.starts_with("static") && !found.contains("roll"), "{found}");
}

#[test]
fn a_spiral_goes_around() {
    for prompt in [
        "look down on the vase, leaves like fireworks, then the camera spirals down around it until it is level with it",
        "spiral up around the armchair",
    ] {
        let found = program(prompt);
        assert!(found.contains("orbit") && found.contains("crane") && found.contains("with="), "{prompt}: {found}");
    }
}

#[test]
fn a_length_behind_all_moves_is_that_of_the_film() {
    let found = program("truck right past the curtain, then a slow zoom in on the vase, airy loft, 12 seconds");
    assert!(found.ends_with("total=12s"), "{found}");
    let found = program("push in on the vase, then hold on it, 2 seconds");
    assert!(!found.contains("total"), "{found}");
}

#[test]
fn a_close_view_is_no_extreme_one() {
    let found = program("We begin at the vase, quite near, then we drift backwards away from it");
    assert!(!found.contains("extreme"), "{found}");
    let found = program("extreme close-up of the vase, then pull back");
    assert!(found.contains("extreme-close-up"), "{found}");
}

#[test]
fn light_and_mood_are_no_steps() {
    let found = program("circle the armchair a quarter turn. Powdery dawn, 8 seconds, sunlight sliding slowly upward.");
    assert_eq!(found.matches(" / ").count(), 0, "{found}");
    assert!(found.contains("orbit") && !found.contains("pedestal"), "{found}");
}

#[test]
fn the_colors_of_a_look_are_no_things() {
    for prompt in [
        "push in on the television, moody gold and black palette",
        "rain on the window, dust swirling, push in on the television",
        "flour floating upwards, push in on the television, god rays from above",
    ] {
        let found = program(prompt);
        assert!(found.starts_with("push-in") && !found.contains(" / ") && found.contains("end=2"), "{prompt}: {found}");
    }
}

#[test]
fn a_field_of_view_is_no_angle_from_above() {
    let found = program("Dolly in 0.8 m toward the armchair, no pan, no tilt. Vertical FOV fixed at 40°.");
    assert!(found.contains("40fov") && !found.contains("40deg"), "{found}");
}

#[test]
fn a_fixed_position_rules_travel_out_beside_described_pictures() {
    let found = program(
        "Start frame: television centered at 20 % of frame height. End frame: television centered at 60 %. Camera position \
         locked.",
    );
    assert!(found.starts_with("zoom-in") && found.contains("no=travel"), "{found}");
    let found = program("The camera stays put. Go from the curtain over to the television and then down to the vase.");
    assert!(found.contains("tilt-down") && found.contains("no=travel") && !found.contains("crane"), "{found}");
}

#[test]
fn what_is_taken_back_is_in_no_step() {
    let found = program("Dolly in on the vase, strike that, on the armchair");
    assert!(found.contains("end=4") && !found.contains("end=1"), "{found}");
    let found = program("Start on the vase (not the sideboard!) and end on the armchair.");
    assert!(!found.contains('3') && found.contains("end=4"), "{found}");
    let found = program("Crane up while orbiting the vase; actually leave out the orbit.");
    assert!(found.contains("crane-up") && !found.contains("orbit"), "{found}");
}

#[test]
fn a_gaze_that_goes_on_does_not_walk() {
    let found = program("your eyes travel from the curtain over to the television and finally settle on the vase");
    assert_eq!(found.matches("pan-").count(), 2, "{found}");
    let found = program("With your eyes follow the line from the curtain to the armchair, feet still");
    assert!(found.starts_with("pan-"), "{found}");
}

#[test]
fn a_zoom_back_to_the_first_lens_ends_where_it_began() {
    let found = program(
        "zoom in on the vase, hold 2 s, then zoom out to the original framing, back to the initial focal length",
    );
    assert!(found.contains("returns"), "{found}");
}

#[test]
fn a_range_from_far_to_near_is_a_distance() {
    let found =
        program("Approach to the armchair: from 1.5 m down to 0.6 m range, error under 8% of the frame, 9 seconds");
    assert!(found.contains("d1.5u") && found.contains("d0.6u") && !found.contains("8%"), "{found}");
}

#[test]
fn a_tripod_does_not_tremble_with_the_curtain() {
    let found = program("locked tripod, curtain breathing in the wind, nothing moves");
    assert!(!found.contains("handheld"), "{found}");
}

#[test]
fn still_at_first_is_at_rest() {
    let found = program("Camera: static at first, then a slow push toward the television.");
    assert!(found.starts_with("static") && found.contains("push-in"), "{found}");
}

#[test]
fn a_nod_goes_down_and_comes_back() {
    let found = program("please pretend to nod yes at the vase");
    assert!(found.starts_with("tilt-down") && found.contains("returns"), "{found}");
}

#[test]
fn half_way_around_is_half_a_circle() {
    let found = program("can u go round the vase like half way and then stop");
    assert!(found.contains("amount=180deg"), "{found}");
}

#[test]
fn a_camera_on_the_spot_turns_and_zooms() {
    let found = program("No walking: start at the vase and go up to the television, just the head moves.");
    assert!(found.contains("tilt-up") && found.contains("no=travel"), "{found}");
    let found =
        program("Television. Then down to the vase. All from one spot, and then make the vase bigger with the lens.");
    assert!(!found.contains("push-in") && !found.contains("crane") && !found.contains("follow"), "{found}");
    let found = program("Rotate in place clockwise from the vase to the armchair.");
    assert!(found.starts_with("pan-right"), "{found}");
}

#[test]
fn a_look_straight_down_begins_overhead() {
    let found = program("Look straight down on the vase, then come down in front of it and stop face to face");
    assert!(found.contains("overhead"), "{found}");
}

#[test]
fn every_side_is_a_full_circle() {
    let found =
        program("Visitors can't walk round the vase, so the film must do it. Every side legible, neutral, no drama.");
    assert!(found.contains("orbit") && (found.contains("360") || found.contains("large")), "{found}");
}

#[test]
fn the_verb_says_whether_the_camera_travels() {
    let found = program("From the foot of the curtain we float up to its top.");
    assert!(found.contains("pedestal-up") || found.contains("crane-up"), "{found}");
    let found =
        program("Swing round the vase to the left, a quarter turn, then let go of it and pan across to the armchair.");
    assert!(found.contains("pan-right") && !found.contains("follow"), "{found}");
    let found = program("Vertigo effect on the vase with the camera travelling backwards.");
    assert!(found.starts_with("dolly-zoom-out"), "{found}");
}

#[test]
fn a_list_without_cuts_goes_from_picture_to_picture() {
    let found = program("SHOT LIST (one continuous take, no cuts): 1) sideboard, wide 2) vase, tight");
    assert!(found.contains("follow end=") && !found.contains("cut /"), "{found}");
}
