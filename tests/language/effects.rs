use cinesplat::language::{NamedObject, effects_called_for, link};

fn kinds(prompt: &str) -> Vec<String> {
    let objects = [NamedObject { id: 1, label: "vase".to_owned() }];
    effects_called_for(&link(prompt, &objects).unwrap()).unwrap().into_iter().map(|effect| effect.kind).collect()
}

#[test]
fn effects_are_found_in_the_order_of_the_words() {
    let prompt = "Handheld push-in on the vase with a shallow depth of field and film grain, then add some music";
    assert_eq!(kinds(prompt), ["handheld", "depth-of-field", "film-grain", "music"]);
    assert_eq!(kinds("Rack focus to the vase, black and white"), ["rack-focus", "black-and-white"]);
}

#[test]
fn effects_that_are_denied_are_not_called_for() {
    assert!(kinds("push in on the vase, no motion blur, without music").is_empty());
    assert!(kinds("push in on the vase").is_empty());
}

#[test]
fn the_words_of_an_effect_are_pointed_at() {
    let prompt = "Orbit the vase, with Motion-Blur.";
    let objects = [NamedObject { id: 1, label: "vase".to_owned() }];
    let found = effects_called_for(&link(prompt, &objects).unwrap()).unwrap();
    assert_eq!(found.iter().map(|effect| &prompt[effect.span[0]..effect.span[1]]).collect::<Vec<_>>(), ["Motion-Blur"]);
}
