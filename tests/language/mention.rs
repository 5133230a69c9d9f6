//! Linking with known mentions, and groups.

use cinesplat::language::{Mention, QuantityKind, link_mentions};

fn mention(prompt: &str, words: &str, ids: &[u32]) -> Mention {
    let start = prompt.find(words).unwrap();
    Mention { bytes: [start, start + words.len()], ids: ids.to_vec() }
}

#[test]
fn a_mention_becomes_one_placeholder_and_numbers_become_quantities() {
    let prompt = "Circle the big couch twice over 8 s, then hold on the couch.";
    let mentions = [mention(prompt, "the big couch", &[7]), mention(prompt, "the couch", &[7])];
    let linked = link_mentions(prompt, &mentions).unwrap();
    assert_eq!(linked.tokens_text, "circle <obj-0> <qty-0> over <qty-1> , then hold on <obj-0> .");
    assert_eq!(linked.slots, [7]);
    assert_eq!(linked.quantities[1].kind, QuantityKind::Seconds);
    let words: Vec<&str> = linked.spans.iter().map(|[start, end]| &prompt[*start..*end]).collect();
    assert_eq!(words[1], "the big couch");
}

#[test]
fn several_objects_are_a_group_and_expand_to_their_members() {
    let prompt = "Show both chairs, then the red one.";
    let mentions = [mention(prompt, "both chairs", &[2, 5]), mention(prompt, "the red one", &[5])];
    let linked = link_mentions(prompt, &mentions).unwrap();
    let group = &linked.groups[0];
    assert_eq!(linked.slots, [group.id, 5]);
    assert_eq!(linked.expanded(&[group.id, 9]), [2, 5, 9]);
    assert_eq!(linked.grouped(&[9, 2, 5]), [9, group.id]);
    assert_eq!(linked.grouped(&[2, 9]), [2, 9]);
    assert!(linked.missing(group.id).is_none());
}

#[test]
fn things_that_the_scene_lacks_are_the_same_if_their_words_are() {
    let prompt = "From the fountain to the statue, back to The Fountain";
    let mentions = [
        mention(prompt, "the fountain", &[]),
        mention(prompt, "the statue", &[]),
        mention(prompt, "The Fountain", &[]),
    ];
    let linked = link_mentions(prompt, &mentions).unwrap();
    assert_eq!(linked.groups.len(), 2);
    assert_eq!(linked.missing(linked.slots[0]).unwrap().name, "fountain");
    assert_eq!(linked.tokens_text.matches("<obj-0>").count(), 2);
}

#[test]
fn the_words_for_a_part_of_a_thing_stay_words() {
    for (words, plain) in [
        ("the top of the pipes", "tilt to the top of <obj-0>"),
        ("the left side of the desk", "tilt to the left side of <obj-0>"),
        ("the upper half of the bed", "tilt to the upper half of <obj-0>"),
        ("the chair's back", "tilt to <obj-0> 's back"),
        // No parts: one of several things, and a name with `of`.
        ("the middle of the three", "tilt to <obj-0>"),
        ("the middle of the 3 chairs", "tilt to <obj-0>"),
        ("the third of the lamps", "tilt to <obj-0>"),
        ("the stack of plates", "tilt to <obj-0>"),
    ] {
        let prompt = format!("tilt to {words}");
        let linked = link_mentions(&prompt, &[mention(&prompt, words, &[3])]).unwrap();
        assert_eq!(linked.tokens_text, plain);
    }
    let prompt = "the top of the three lamps";
    let several = link_mentions(prompt, &[mention(prompt, prompt, &[1, 2, 3])]).unwrap();
    assert_eq!(several.tokens_text, "<obj-0>");
}

#[test]
fn a_number_with_its_point_first_is_a_word() {
    assert_eq!(link_mentions(".0-", &[]).unwrap().tokens_text, ".0");
    assert!(link_mentions(" -, !", &[]).is_err());
}

#[test]
fn a_side_with_a_pronoun_is_a_side_of_the_thing() {
    let prompt = "Orbit the skull from the front to its left side, slowly.";
    let mentions = [mention(prompt, "the skull", &[3]), mention(prompt, "its left side", &[3])];
    let linked = link_mentions(prompt, &mentions).unwrap();
    assert_eq!(linked.tokens_text, "orbit <obj-0> from the front to the left side of <obj-0> , slowly .");
    assert_eq!(linked.tokens_text.split(' ').count(), linked.spans.len());
}
