//! Shorthand, slips of dictation and misspelled words of command.

use cinesplat::language::{Mention, link_mentions};

fn tokens(prompt: &str) -> String {
    link_mentions(prompt, &[]).unwrap_or_else(|error| panic!("{prompt}: {error}")).tokens_text
}

#[test]
fn shorthand_is_written_out() {
    for (prompt, plain) in [
        ("Z/I 24-70 on it", "zoom in <qty-0> <qty-1> on it"),
        ("jib dn, O/H to low angle, :07", "jib down , overhead to low angle , <qty-0>"),
        ("dolly L w/ pan R", "dolly left with pan right"),
        ("L-to-R trk thru it", "left to right track through it"),
        ("wide > CU", "wide to cu"),
        ("wide -> CU", "wide to cu"),
    ] {
        assert_eq!(tokens(prompt), plain, "{prompt}");
    }
}

#[test]
fn slips_of_dictation_and_typing_are_mended() {
    for (prompt, plain) in [
        ("pan write from it period hold", "pan right from it . hold"),
        ("peddle stool up until you can sea it", "pedestal up until you can see it"),
        ("then hold for to seconds", "then hold for <qty-0>"),
        ("zom out utnil it is centerd", "zoom out until it is centred"),
        ("slwoly orbti", "slowly orbit"),
    ] {
        assert_eq!(tokens(prompt), plain, "{prompt}");
    }
}

#[test]
fn real_words_and_names_stay() {
    for prompt in
        ["the pane", "a crate", "stow it", "the bull", "a small l", "tele lens", "nave", "the slider doesn t move"]
    {
        assert_eq!(tokens(prompt), prompt, "{prompt}");
    }
    // A capital R is a direction, but not inside the name of an object.
    let prompt = "orbit speaker R";
    let mention = Mention { bytes: [6, 15], ids: vec![3] };
    assert_eq!(link_mentions(prompt, &[mention]).unwrap().tokens_text, "orbit <obj-0>");
}

#[test]
fn written_out_words_keep_their_bytes() {
    let linked = link_mentions("slowly P/O fast", &[]).unwrap();
    assert_eq!(linked.tokens_text, "slowly pull out fast");
    assert_eq!(linked.spans, [[0, 6], [7, 10], [7, 10], [11, 15]]);
}
