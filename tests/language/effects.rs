use cinesplat::language::{EffectMention, NamedObject, effect_mentions, forbidding_words, link};

fn mentions(prompt: &str) -> Vec<EffectMention> {
    let objects = [NamedObject { id: 1, label: "vase".to_owned() }];
    effect_mentions(prompt, &link(prompt, &objects).unwrap()).unwrap()
}

fn kinds(prompt: &str) -> Vec<String> {
    mentions(prompt).into_iter().filter(|mention| !mention.is_forbidden).map(|mention| mention.call.name).collect()
}

#[test]
fn effects_are_found_in_the_order_of_the_words() {
    let prompt = "Handheld push-in on the vase with a shallow depth of field and film grain, then add some music";
    assert_eq!(kinds(prompt), ["handheld", "depth-of-field", "film-grain", "music"]);
    assert_eq!(kinds("Rack focus to the vase, black and white"), ["rack-focus", "black-and-white"]);
}

#[test]
fn negated_effects_are_left_out() {
    assert!(kinds("push in on the vase, no motion blur, without music").is_empty());
    assert!(kinds("push in on the vase").is_empty());
}

#[test]
fn a_mention_has_the_bytes_of_its_words() {
    let prompt = "Orbit the vase, with Motion-Blur.";
    let spans: Vec<&str> = mentions(prompt).iter().map(|mention| &prompt[mention.span[0]..mention.span[1]]).collect();
    assert_eq!(spans, ["Motion-Blur"]);
}

/// `left out, the words 'motion blur' forbid it` was said of `without motion blur`.
#[test]
fn the_words_that_ask_for_an_effect_are_said_to_forbid_it() {
    for (prompt, wanted) in [
        ("Whip pan to the vase, without motion blur", vec!["without motion blur"]),
        ("no depth of field, push in on the vase", vec!["no depth of field"]),
        ("push in on the vase, don't use any motion blur", vec!["don't use any motion blur"]),
        (
            "without fog, film grain or a vignette",
            vec!["without fog", "without fog, film grain", "without fog, film grain or a vignette"],
        ),
        ("push in on the vase, keep it free of grain", vec!["free of grain"]),
        ("push in on the vase, film grain off", vec!["film grain off"]),
        ("never stop, the motion blur has to go, and orbit", vec!["motion blur has to go"]),
        ("push in on the vase with film grain", vec!["film grain"]),
    ] {
        let mentions = mentions(prompt);
        let found = mentions.iter().map(|mention| forbidding_words(prompt, mention, &mentions));
        let found: Vec<&str> = found.map(|[start, end]| &prompt[start..end]).collect();
        assert_eq!(found, wanted, "{prompt}");
    }
}
