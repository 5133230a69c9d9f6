//! Idioms: what people say for a move, and the words of the trade for it.

use cinesplat::language::{Linked, Mention, QuantityKind, link_mentions};

/// A prompt with the mentions of the words in brackets: `let [the mug] slide past`.
fn linked(marked: &str) -> (String, Linked) {
    let (mut prompt, mut mentions) = (String::new(), Vec::new());
    for (nth, part) in marked.split(['[', ']']).enumerate() {
        if nth % 2 == 1 {
            let bytes = [prompt.len(), prompt.len() + part.len()];
            mentions.push(Mention { bytes, ids: vec![nth as u32] });
        }
        prompt.push_str(part);
    }
    let linked = link_mentions(&prompt, &mentions).unwrap();
    (prompt, linked)
}

#[test]
fn idioms_become_words_of_the_trade() {
    for (prompt, plain) in [
        ("let [the mug] slide past us from right to left", "truck right past <obj-0>"),
        ("have [the mug] drift past, left to right", "have <obj-0> drift past , left to right"),
        ("a lateral pass to port", "a lateral pass to the left"),
        ("walk once all the way round [the statue]", "walk around <obj-0> <qty-0>"),
        ("make bigger [the mug] with the lens", "zoom in on <obj-0>"),
        ("from the same height as they are", "at eye level"),
        ("move off [it] until the gap between us and it has doubled", "move off <obj-0> until it is <qty-0>"),
        ("come back out to where you set off from", "pull back to where it started"),
        ("keep facing the way you're facing", "without turning"),
        ("trombone shot on [the mug], travelling closer", "dolly zoom in on <obj-0>"),
        ("back away from [the mug] and zoom in so it stays equally big", "dolly zoom out on <obj-0>"),
        ("translate -0.8 m along camera x (x = right)", "truck left <qty-0>"),
        ("pose B = pose A + 0.5 m right", "then truck right <qty-0> without turning"),
        ("start down by the tiles looking up at [the mug]", "start with a low angle looking up at <obj-0>"),
        ("no [palm] anywhere", "never show <obj-0>"),
        ("circle [it], keep to the left of the [table]", "circle <obj-0> past <obj-1>"),
        ("mind [the stool], don't bump into it", ","),
        ("push in, you're not to climb", "push in , no climbing"),
        ("the last 2 seconds decelerate to a stop", "the last <qty-0> decelerate to a stop"),
        ("push in, the last 2 seconds decelerate to a stop", "push in , easing out"),
    ] {
        assert_eq!(linked(prompt).1.tokens_text, plain, "{prompt}");
    }
    let (_, circled) = linked("walk once all the way round [the statue]");
    assert_eq!((circled.quantities[0].kind, circled.quantities[0].value), (QuantityKind::Degrees, 360.0));
}

#[test]
fn verbs_keep_their_form_and_captures_their_words() {
    let (_, linked) = linked("making [the vase] bigger with the glass");
    assert_eq!(linked.tokens_text, "zooming in on <obj-0>");
}

#[test]
fn a_rewritten_clause_has_the_bytes_of_its_words() {
    let (prompt, linked) = linked("hold. let [the mug] slide past from right to left, then stop");
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    assert_eq!(words.len(), linked.spans.len());
    let truck = words.iter().position(|word| *word == "truck").unwrap();
    let [start, end] = linked.spans[truck];
    assert_eq!(&prompt[start..end], "let the mug slide past from right to left");
    assert_eq!(words.last(), Some(&"stop"));
}

#[test]
fn the_words_of_the_trade_stay_as_they_are() {
    for prompt in [
        "push in on [the mug]",
        "start close on [the mug] , pull back past [the bottles] , end wide on the room",
        "slowly orbit [the mug] to the right",
        "pan left from [the mug] to [the lamp] , then hold",
        "crane up to a high angle of [the table]",
        "truck left along [the counter] while looking at [the mug]",
        "a static wide shot of the room",
        "tilt down to [the floor]",
        "zoom out until [the mug] and [the lamp] are in",
    ] {
        let (prompt, linked) = linked(prompt);
        let expected: Vec<String> = tokens_without_idioms(&prompt, &linked);
        assert_eq!(linked.tokens_text.split(' ').collect::<Vec<_>>(), expected, "{prompt}");
    }
}

/// The words of a prompt by their own bytes, with the placeholders where they stand.
fn tokens_without_idioms(prompt: &str, linked: &Linked) -> Vec<String> {
    let words = linked.tokens_text.split(' ').zip(&linked.spans);
    let word = |(word, span): (&str, &[usize; 2])| {
        if word.starts_with('<') { word.to_owned() } else { prompt[span[0]..span[1]].to_lowercase() }
    };
    words.map(word).collect()
}

#[test]
fn a_sign_is_a_word_and_a_range_is_not() {
    for (prompt, plain) in [
        ("roll -30 degrees", "roll counterclockwise <qty-0>"),
        ("hold 2-3 seconds", "hold <qty-0>"),
        ("hold it -3s", "hold it <qty-0>"),
    ] {
        assert_eq!(linked(prompt).1.tokens_text, plain, "{prompt}");
    }
}

#[test]
fn hostile_prompts_are_read_in_time() {
    for words in ["the background goes all ", "nose down until the ", "make it ", "not ", "half a "] {
        let prompt = words.repeat(8000 / words.len());
        assert!(link_mentions(&prompt, &[]).is_ok(), "{words}");
    }
}
