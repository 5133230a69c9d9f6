//! Pictures that planners describe at a moment, ranges, tolerances, constant heights and bans.

use super::beats::program;

fn reads(cases: &[(&str, &str)]) {
    for (prompt, expected) in cases {
        let found = program(prompt);
        assert!(found.starts_with(expected), "{prompt}\n expected {expected}\n found    {found}");
    }
}

#[test]
fn opening_and_closing_pictures_are_the_ends_of_one_move() {
    reads(&[
        (
            "One continuous 7 s take, no zoom. Opening composition: the vase dead centre, 15 % of frame height. Closing \
             composition: the vase on the upper left thirds intersection, 30 % of frame height.",
            "push-in start=1:15%:at-center end=1:30%:at-upper-left | total=7s no=zoom",
        ),
        (
            "Move on the vase: elevation 25° above it at the start, 0° at the end, same distance throughout (±10 %), \
             always centred, initially 60 % of the frame height. Six seconds.",
            "crane-down start=1:60%:25deg:at-center end=1:0deg:at-center | total=6s",
        ),
        (
            "Begins on the television, fully in frame; ends on the vase, fully in frame. Camera position fixed, 6 s.",
            "pan-right start=2! end=1! either",
        ),
    ]);
}

#[test]
fn a_thing_that_is_only_named_is_seen_as_the_one_before() {
    let found = program("the vase is centred in the first frame, the television in the last, 6 s, no rotation");
    assert!(found.contains("start=1:at-center") && found.contains("end=2:at-center"), "{found}");
    assert!(!found.contains(" / "), "{found}");
}

#[test]
fn one_sentence_describes_both_ends() {
    let found =
        program("The vase must be centred in the first frame and on the right third in the last. Lens fixed, 5 s.");
    assert!(found.starts_with("pan-left start=1:at-center end=1:at-right"), "{found}");
}

#[test]
fn several_things_that_are_in_make_one_picture() {
    let found = program(
        "First frame: only the vase. Orbit it 90° to the right at constant height. Last frame: vase and television both in.",
    );
    assert!(found.starts_with("orbit-right start=1 end=1+2! amount=90deg"), "{found}");
}

#[test]
fn a_last_picture_of_the_room_is_not_of_the_thing_before() {
    let found = program("First frame: the vase. Pull back. Last frame: a wide shot of the room.");
    assert!(found.starts_with("pull-out start=1") && !found.contains("end=1"), "{found}");
}

#[test]
fn a_whole_thing_at_a_moment_is_wholly_in_the_frame() {
    let found = program(
        "Rotation about the vertical axis only, camera position fixed, 6 s. First frame: the whole curtain in, \
         television completely out. Last frame: the whole television in, curtain completely out.",
    );
    assert!(found.starts_with("pan-right start=5! end=2! either"), "{found}");
    assert!(found.contains("tilt"), "{found}");
}

#[test]
fn a_start_frame_before_steps_is_no_step() {
    let found =
        program("Start frame: the vase centred, one third of frame height. 1. Pull back 0.5 m. 2. Tilt up 10°.");
    assert_eq!(found.matches(" / ").count(), 1, "{found}");
    assert!(found.contains("start=1:33."), "{found}");
}

#[test]
fn what_is_in_frame_at_the_end_of_a_hold_is_what_the_move_before_shows() {
    let found = program(
        "00:00-00:03 locked on the vase. 00:03-00:08 truck left 1.0 m. 00:08-00:10 hold. The television has to be \
         completely in frame at 00:10.",
    );
    assert!(found.contains("truck-left end=2!") && found.ends_with("static dur=2s"), "{found}");
}

#[test]
fn a_slide_to_what_is_out_of_the_first_picture_is_a_reveal() {
    let found = program(
        "Lateral reveal, 8 s, no rotation and no zoom at all. At t = 0 only the vase is in shot: curtain and television \
         must be outside the frame. Camera slides to its left; at t = 8 s curtain and television are both fully in frame.",
    );
    assert!(found.starts_with("reveal with=truck-left start=1 end=5+2!"), "{found}");
}

#[test]
fn places_of_two_things_on_every_frame_are_one_picture() {
    let found = program(
        "Back away from the vase, 1.6 m -> 2.4 m in 6 s, fixed FOV. Vase in the upper half and curtain in the lower half \
         of the image on every frame, neither touching an edge.",
    );
    assert!(found.starts_with("pull-out start=1+5:d1.6u! end=1+5:d2.4u!") && !found.contains(" / "), "{found}");
}

#[test]
fn ends_of_moves_are_no_descriptions() {
    for prompt in [
        "start on the vase, then pan right to the television",
        "pan right 30 degrees and finish with the television in the centre of the frame",
        "1. Open on the vase. 2. Tilt down to the sideboard.",
    ] {
        let found = program(prompt);
        assert!(found.contains("pan-right") || found.contains("tilt-down"), "{prompt}: {found}");
    }
}

#[test]
fn lenses_and_distances_with_an_arrow_are_the_first_and_the_last() {
    for (prompt, expected) in [
        ("Tripod. Vertical FOV 50° at 00:00 to 25° at 00:06, on the vase.", ["start=1:50fov", "25fov"]),
        ("vertical FOV from 60 to 30 degrees in 4 s, framing the vase, tripod", ["60fov", "30fov"]),
        ("Zoom from 24 mm to 70 mm on the vase over 5 s", ["24mm", "70mm"]),
    ] {
        let found = program(prompt);
        assert!(found.starts_with("zoom-in") && expected.iter().all(|lens| found.contains(lens)), "{prompt}: {found}");
    }
    let found = program("Back away from the vase, 1.6 m -> 2.4 m in 6 s, fixed FOV.");
    assert!(found.contains("start=1:d1.6u end=1:d2.4u") && !found.contains(":h"), "{found}");
}

#[test]
fn a_tolerance_is_no_height_and_no_amount() {
    for prompt in [
        "Orbit the vase by 60° clockwise, constant radius ±10 %, vase centred in frame, 6 seconds.",
        "Orbit the vase 60° to the right (+/- 5°), radius constant within 10 %.",
    ] {
        let found = program(prompt);
        assert!(found.contains("amount=60deg") && !found.contains('%'), "{prompt}: {found}");
    }
}

#[test]
fn a_constant_height_rules_out_a_rise() {
    for (prompt, height) in [
        ("Push in on the vase at constant height, 4 s.", ""),
        ("Orbit the vase 45° to the left. Camera height must not change.", ""),
        ("Arc right 45° around the vase, same altitude throughout.", ""),
        ("Truck left 0.5 m past the sideboard. Lens height constant at 1.2 m.", ":h1.2u"),
    ] {
        let found = program(prompt);
        assert!(found.contains("no=rise") && found.contains(height), "{prompt}: {found}");
    }
    for prompt in [
        "Dolly back from the vase while zooming in so that it keeps the same height in frame",
        "crane up over the vase, then push in on the television at constant height",
    ] {
        let found = program(prompt);
        assert!(!found.contains("rise"), "{prompt}: {found}");
    }
}

#[test]
fn a_ban_holds_where_it_is_said() {
    let found = program("Step 1: tilt down 15°, no pan. Step 2: pan right until the television is centred, no tilt.");
    assert!(found.contains("tilt-down") && found.contains("pan-right") && !found.contains("no="), "{found}");
    let found = program("Tilt down 30° from the vase. Nodal point does not move. Heading locked (no pan), lens fixed.");
    assert!(found.starts_with("tilt-down") && found.contains("pan") && !found.contains("+tilt"), "{found}");
}

#[test]
fn a_way_on_the_same_lens_is_no_dolly_zoom() {
    let found = program("dolly back on the same lens until the television and the curtain are also entirely in frame");
    assert!(found.starts_with("pull-out"), "{found}");
}
