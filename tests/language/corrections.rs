//! What a person who corrects himself means.

use cinesplat::language::{Mention, link_mentions};

/// The words of a prompt after its last correction; `[..]` are things.
fn corrected(prompt: &str) -> Option<String> {
    let mut plain = String::new();
    let mut mentions = Vec::new();
    for (nth, piece) in prompt.split(['[', ']']).enumerate() {
        let start = plain.len();
        plain.push_str(piece);
        if nth % 2 == 1 {
            let ids = vec![u32::from(piece.bytes().next().unwrap_or_default())];
            mentions.push(Mention { bytes: [start, plain.len()], ids });
        }
    }
    link_mentions(&plain, &mentions).unwrap().corrected().map(|linked| linked.tokens_text)
}

#[test]
fn what_follows_a_correction_replaces_what_is_built_alike() {
    for (prompt, expected) in [
        ("finish CU on [jar], no wait, MS on [skull]", "finish ms on <obj-0>"),
        ("start on [mug]... no, scratch that, on [plates]. then pan left", "start on <obj-0> . then pan left"),
        ("push in on [mug], sorry I mean [jar], and hold", "push in on <obj-0> , and hold"),
    ] {
        assert_eq!(corrected(prompt).as_deref(), Some(expected), "{prompt}");
    }
}

#[test]
fn words_without_a_correction_stay() {
    for prompt in
        ["push in on [mug]", "pan to [sink], actually no, make it slower", "no wait, push in on [mug]", "scratch that"]
    {
        assert_eq!(corrected(prompt), None, "{prompt}");
    }
}
