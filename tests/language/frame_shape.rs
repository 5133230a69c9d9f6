//! The shape of the frame that a prompt states.

use cinesplat::language::{NamedObject, frame_shape, without_frame_shape};

fn shape(prompt: &str, label: &str) -> Option<[u32; 2]> {
    let objects = [NamedObject { id: 1, label: label.to_owned() }];
    frame_shape(prompt, &objects).map(|shape| shape.ratio)
}

#[test]
fn portrait_square_and_ratios_are_shapes() {
    for (prompt, ratio) in [
        ("portrait: tilt up from the rug", [9, 16]),
        ("Keep it lively, 8 seconds tops, portrait.", [9, 16]),
        ("the flowers last. ten seconds, square", [1, 1]),
        ("Portrait close-up of the vase.", [9, 16]),
        ("portrait still of the skull, three-quarter view", [9, 16]),
        ("vertical video, slowly toward the vase", [9, 16]),
        ("vertical, the whole vase, crane down", [9, 16]),
        ("9:16 pedestal up along the drawers", [9, 16]),
        ("orbit the vase in 4:5 for the feed", [4, 5]),
        ("a square video of the vase", [1, 1]),
        ("push in on the vase for tiktok", [9, 16]),
    ] {
        assert_eq!(shape(prompt, "vase"), Some(ratio), "{prompt}");
    }
}

#[test]
fn things_lenses_clocks_and_directions_are_no_shapes() {
    for prompt in [
        "push in on the portrait",
        "the portrait of the lady, slowly closer",
        "use a portrait lens on the vase",
        "vertical move up the vase",
        "at 1:1 start moving",
        "0:01-0:04 pan left",
        "around the square table",
        "blur the background in portrait mode",
        "reel back from the vase",
    ] {
        assert_eq!(shape(prompt, "vase"), None, "{prompt}");
    }
    assert_eq!(shape("portrait shot, wide", "portrait shot"), None, "a thing of the scene");
}

#[test]
fn a_shape_has_even_sides_and_the_shorter_one_is_given() {
    let shape = frame_shape("9:16 of the vase", &[]).unwrap();
    assert_eq!((shape.size_px(720), shape.bytes), ([720, 1280], [0, 4]));
    assert_eq!(frame_shape("4:5 of it", &[]).unwrap().size_px(721), [720, 900]);
}

#[test]
fn shapes_leave_blanks_of_their_length() {
    for (prompt, rest) in [
        ("9:16 pedestal up along the chest", "pedestal up along the chest"),
        ("portrait: tilt up from the rug", "tilt up from the rug"),
        ("push in on the vase for tiktok", "push in on the vase"),
        ("vertical video, 4:5, of the vase", "of the vase"),
        ("push in on the vase", "push in on the vase"),
        ("9:16", "9:16"),
    ] {
        let without = without_frame_shape(prompt, &[]);
        assert_eq!(without.len(), prompt.len(), "{prompt}");
        assert!(without.ends_with(rest) || without.trim() == rest, "{prompt}: {without:?}");
    }
    let named = [NamedObject { id: 1, label: "portrait".to_owned() }];
    assert_eq!(without_frame_shape("portrait close-up", &named), "portrait close-up");
}
