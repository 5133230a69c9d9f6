use cinesplat::language::{EffectMention, NamedObject, effect_mentions, link};

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
