//! Parts of things, pictures that they fill, things that are told to act, and times apart from their moves.

use super::beats::program;
use super::plain_words::program_of;

#[test]
fn what_is_all_that_is_seen_fills_the_frame() {
    for prompt in [
        "push in until the vase is the only thing in the picture",
        "move in on the vase till it's all you can see",
        "push in on the vase until nothing else is visible",
        "go closer to the vase until there is nothing but the vase in the frame",
    ] {
        let found = program(prompt);
        assert!(found.contains("end=1:extreme-close-up"), "{prompt}: {found}");
    }
}

#[test]
fn what_is_lost_in_the_room_is_far_away() {
    for prompt in ["pull back until the vase is lost in the room", "pull out until the vase is barely visible"] {
        let found = program(prompt);
        assert!(found.contains("1:extreme-long"), "{prompt}: {found}");
    }
}

#[test]
fn small_parts_are_seen_close() {
    let found = program_of(&["running shoe", "box"], "push in until the sole fills the frame");
    assert!(found.contains("extreme-close-up") && found.contains("bottom"), "{found}");
    let found = program_of(&["headphones", "stand"], "creep in to the left earcup");
    assert!(found.contains("end=1:close-up:left"), "{found}");
}

#[test]
fn what_is_told_to_act_is_no_move() {
    for (prompt, expected) in [
        ("Make the bear turn its head toward the sign, then push in on its face.", "push-in end=1"),
        ("the bear waves at us. push in on the bear", "push-in end=1"),
        ("tell the bear to dance and circle round it", "orbit-right end=1"),
    ] {
        let found = program_of(&["bear", "sign"], prompt);
        assert!(found.starts_with(expected) && !found.contains(" / "), "{prompt}: {found}");
    }
}

#[test]
fn smooth_as_silk_is_no_scarf() {
    let found = program_of(&["bottle", "silk scarf"], "a full 360 around the bottle, silky smooth");
    assert!(found.contains("end=1") && !found.contains('2'), "{found}");
}

#[test]
fn a_list_of_times_is_one_of_each_step() {
    let found = program("push in on the vase, pan to the television, tilt down to the sideboard. 3s 2s 4s");
    for secs in ["dur=3s", "dur=2s", "dur=4s"] {
        assert!(found.contains(secs), "{found}");
    }
}

#[test]
fn keyframes_are_as_far_apart_as_their_frames() {
    let found = program("Keyframe 1 at frame 0: wide on the vase. Keyframe 2 at frame 72: close on the vase.");
    assert!(found.contains("dur=3s"), "{found}");
}

#[test]
fn panning_only_is_a_pan() {
    let found = program("Rack the view from the vase over to the television, by panning only.");
    assert!(found.starts_with("pan"), "{found}");
}
