//! What people who do not know the trade's words say for starts, ends, amounts and rests.

use cinesplat::director::{Director, SceneContext};
use cinesplat::language::{NamedObject, program_to_notation};
use cinesplat::objects::Object;
use glam::DVec3;

use super::beats::program;

/// The program for a prompt in a scene of these things.
pub(super) fn program_of(labels: &[&str], prompt: &str) -> String {
    let placed = |(idx, label): (usize, &&str)| {
        let center = DVec3::new(idx as f64 - 2.0, 0.5, -1.0 - (idx % 2) as f64);
        Object::from_box(1 + idx as u32, label, center, DVec3::new(0.3, 0.5, 0.2))
    };
    let objects: Vec<Object> = labels.iter().enumerate().map(placed).collect();
    let named: Vec<NamedObject> =
        objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
    let director = Director::embedded().unwrap();
    let context = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::new(0.0, 1.0, -1.5), size: 7.0 };
    program_to_notation(&director.direct(&director.link(prompt, &named).unwrap(), &context).unwrap().program)
}

#[test]
fn a_tilt_up_and_back_down_comes_back() {
    let found = program("tilt up to the ceiling and back down, camera stays put");
    assert!(found.starts_with("tilt-up") && found.contains("tilt-down") && found.contains("returns"), "{found}");
}

#[test]
fn a_look_up_after_a_stop_turns_the_camera() {
    let found = program("camera around 60 cm off the floor, wander a bit, stop, look up.");
    assert!(found.contains(":h0.6u") && found.ends_with("tilt-up"), "{found}");
}

#[test]
fn a_part_of_a_circle_is_said_in_many_ways() {
    for (prompt, degrees) in [
        ("Go round the armchair, well not all the way, say a third, anticlockwise.", "amount=120deg"),
        ("make a half moon around the vase", "amount=180deg"),
        ("the vase, slightly from above, quarter orbit to the left", "amount=90deg"),
        ("Circle the vase patiently, and come home where you began.", "amount=360deg"),
    ] {
        let found = program(prompt);
        assert!(found.contains("orbit") && found.contains(degrees) && !found.contains(" / "), "{prompt}: {found}");
    }
}

#[test]
fn an_extent_stays_with_the_words_that_state_it() {
    let found = program("low cam, slow push, 360 spin around the vase");
    assert_eq!(found.matches("360deg").count(), 1, "{found}");
}

#[test]
fn a_way_round_ends_at_the_side_that_is_named() {
    let found = program("the armchair in profile, drift round to the front over 12 seconds, very slow");
    assert!(found.contains("end=4:from-front"), "{found}");
    let found = program("I need profile from left, then front, then profile from right, in one movement only");
    assert!(found.starts_with("orbit") && found.contains("either"), "{found}");
}

#[test]
fn an_end_of_a_thing_that_has_a_word_of_its_own_is_looked_at() {
    let found = program_of(&["guitar", "vase"], "walk half way around the guitar and end on the headstock");
    assert!(found.contains("end=1:top"), "{found}");
    let found = program_of(&["skull"], "eye to eye with it, come nearer, until the two sockets fill the frame");
    assert!(found.contains("end=1") && found.contains("from-front"), "{found}");
}

#[test]
fn the_green_one_is_of_the_kind_named_before() {
    let labels = ["red vase", "green vase", "green bottle", "sideboard"];
    let found =
        program_of(&labels, "Both vases on the sideboard, straight on. Then closer till only the green one is left.");
    assert!(found.contains("end=2") && !found.contains("end=3"), "{found}");
}

#[test]
fn what_a_thing_is_is_no_picture() {
    let found = program("This armchair is a 10 out of 10! Slow tilt up the curtain, then push in on the vase");
    assert!(found.starts_with("tilt-up") && !found.contains("static"), "{found}");
}

#[test]
fn things_that_follow_one_another_are_passed_in_one_move() {
    let found = program("Track past the curtain, then the vase, then the sideboard.");
    assert!(!found.contains(" / ") && found.contains("start=5 end=3 past=1"), "{found}");
}

#[test]
fn a_rest_on_each_is_one_on_each() {
    let found =
        program("turn from the curtain to the armchair and then to the sideboard, dwelling on each for 2 seconds");
    assert_eq!(found.matches("static").count(), 3, "{found}");
    assert_eq!(found.matches("dur=2s").count(), 3, "{found}");
}

#[test]
fn a_hold_that_names_nothing_shows_what_the_move_before_arrives_at() {
    let found = program("Zoom out from the television until armchair and sideboard are both in, then just hold.");
    assert!(found.ends_with("/ static") || found.ends_with("/ static end=4+3!"), "{found}");
}

#[test]
fn only_focus_pulls_focus() {
    let found = program("slow mo glide, armchair to vase, aesthetic vibes");
    assert!(!found.contains("rack-focus"), "{found}");
}

#[test]
fn a_tilt_on_a_tripod_is_a_tilt() {
    let found = program("on a 35 mm, tilt from the sideboard up to the television; the tripod doesn't budge.");
    assert!(found.starts_with("tilt-up"), "{found}");
}

#[test]
fn a_chain_of_sizes_ends_on_the_last() {
    let found = program("ECU → MCU → WS of the vase, one continuous pull-out");
    assert!(found.contains("start=1:extreme-close-up end=1:long"), "{found}");
}

#[test]
fn labels_of_measuring_people_are_pictures() {
    let found = program("t0: <obj-4> = 25 % of frame height; t_end: 60 %. Zoom disabled");
    assert!(found.starts_with("push-in start=4:25% end=4:60%") && found.contains("no=zoom"), "{found}");
    let found = program("Initial elevation 0°, final elevation 60°, distance 3 m, target: the vase");
    assert!(found.contains(":0deg") && found.contains(":60deg"), "{found}");
}

#[test]
fn a_length_that_is_put_right_is_the_last_one() {
    let found = program("move toward the vase over 5 seconds, make that 7");
    assert!(found.contains("7s") && !found.contains("5s"), "{found}");
}

#[test]
fn a_thing_that_is_not_to_be_hit_may_be_seen() {
    let found = program("fly over to the armchair, don't clip the vase");
    assert!(!found.contains("avoid=1"), "{found}");
}

#[test]
fn a_stated_speed_is_a_length() {
    for (prompt, expected) in [
        ("pan right 90 degrees at 15 deg/s", "amount=90deg dur=6s"),
        ("dolly in 1.2 m at 0.3 m/s toward the vase", "amount=1.2u dur=4s"),
        ("rise at 10 cm per second for 5 seconds", "amount=0.5u"),
    ] {
        let found = program(prompt);
        assert!(found.contains(expected), "{prompt}: {found}");
    }
}

#[test]
fn a_second_move_is_the_one_that_is_said() {
    let found = program("push in on the vase while tilting down a little");
    assert!(found.starts_with("push-in") && found.contains("with=tilt-down"), "{found}");
}
