//! What the words say of the whole film, of its last pictures and of how large things are.

use super::beats::program;

#[test]
fn a_ban_in_a_sentence_of_its_own_holds_for_the_film() {
    let found = program("don't show the television pls. go from the vase to the armchair, then circle the armchair");
    assert_eq!(found.matches("avoid=2").count(), 2, "{found}");
}

#[test]
fn a_sentence_that_keeps_it_slow_slows_every_move() {
    let found =
        program("Push in on the vase, then pan right to the armchair. Keep it slow so that one can look around.");
    assert_eq!(found.matches("slow").count(), 2, "{found}");
}

#[test]
fn a_size_of_each_is_that_of_all() {
    let found = program(
        "Visit the vase, the armchair and the television in this order, 2 s on each one, medium close framing.",
    );
    assert_eq!(found.matches("medium-close-up").count(), found.matches("end=").count(), "{found}");
}

#[test]
fn a_thing_that_must_not_be_cut_off_stays_in_view() {
    let found = program("Once around the armchair. The vase must not be cut off in the picture.");
    assert!(!found.contains("avoid=1"), "{found}");
}

#[test]
fn all_the_way_round_is_a_full_circle() {
    for prompt in
        ["orbit all the way round the vase", "one complete turn around the vase", "a full circle around the vase"]
    {
        let found = program(prompt);
        assert!(found.contains("amount=360deg"), "{prompt}: {found}");
    }
    for prompt in ["half a circle around the vase", "orbit the vase 90 degrees"] {
        let found = program(prompt);
        assert!(!found.contains("360deg"), "{prompt}: {found}");
    }
}

#[test]
fn a_circle_leads_from_the_first_side_to_the_second() {
    let found = program("orbit the armchair from the front to the rear");
    assert!(found.contains("from-front") && found.contains("from-back"), "{found}");
}

#[test]
fn abbreviations_of_sizes_are_taken_as_they_stand() {
    let found = program("slow push on the vase, MWS to CU");
    assert!(found.contains("start=1:medium-long end=1:close-up"), "{found}");
    let found = program("00:00 EWS television. 00:03 begin arc R 90deg.");
    assert!(found.starts_with("static end=2:extreme-long"), "{found}");
}

#[test]
fn a_chain_of_moves_is_one_after_the_other() {
    let found = program("MCU vase > truck L > armchair WS > hold 3 > PI to CU television");
    assert!(found.contains("truck-left") && found.contains("3s") && found.contains("2:close-up"), "{found}");
}

#[test]
fn what_is_included_is_seen_beside_what_was_seen() {
    let found = program("Shot 1: ECU vase, hold 1s. Shot 2: crane up + pull back to WS incl. armchair.");
    assert!(found.contains("end=1+4:long"), "{found}");
}

#[test]
fn a_whole_thing_is_seen_whole() {
    let found = program("Show the whole sideboard from the front, then push in on the vase");
    assert!(found.starts_with("static end=3!") || found.starts_with("static end=3:from-front!"), "{found}");
}

#[test]
fn a_zoom_out_again_is_as_wide_as_the_film_began() {
    let found = program("start wide on the armchair, get in real close, then zoom out again");
    assert!(found.ends_with("zoom-out end=4:long"), "{found}");
}

#[test]
fn a_camera_that_hovers_and_glides_moves() {
    let found = program("Let the camera hover at child's height and glide backwards away from the armchair");
    assert!(found.starts_with("pull-out"), "{found}");
}

#[test]
fn a_word_of_one_name_alone_names_it() {
    let objects = ["sushi platter", "soy dish", "paper lantern"];
    let objects: Vec<_> =
        (1..).zip(objects).map(|(id, label)| cinesplat::language::NamedObject { id, label: label.into() }).collect();
    let director = cinesplat::director::Director::embedded().unwrap();
    let linked = director.link("pull back from the sushi until the whole table is visible", &objects).unwrap();
    assert_eq!(linked.slots.first(), Some(&1), "{}", linked.tokens_text);
}

#[test]
fn what_is_never_lost_stays_in_view() {
    let found = program("slowly orbit around the vase from high up, never losing the armchair");
    assert!(found.contains("keep=4") && !found.contains("avoid=4"), "{found}");
}

#[test]
fn a_way_in_ends_close() {
    let found = program("get in really close to the vase, like you can almost touch it, then back off slowly");
    assert!(found.starts_with("push-in end=1:extreme-close-up"), "{found}");
}
