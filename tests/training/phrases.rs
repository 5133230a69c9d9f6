use std::collections::BTreeSet;

use cinesplat::language::link_mentions;
use cinesplat::training::Phrases;
use rand::SeedableRng;
use rand_pcg::Pcg64;

#[test]
fn an_exchanged_phrase_keeps_the_bytes_of_the_old_one() {
    let phrases = Phrases::parse("[in] push in on | creep up to\n# remark\nslowly | at a crawl\npush | slowly\n");
    let linked = link_mentions("push in on it slowly", &[]).unwrap();
    let mut seen = BTreeSet::new();
    for seed in 0..64 {
        let new = phrases.exchange(&linked, 0.5, &mut Pcg64::seed_from_u64(seed));
        assert_eq!(new.tokens_text.split(' ').count(), new.spans.len());
        assert_eq!((new.spans[0][0], new.spans[new.spans.len() - 1]), (0, [14, 20]));
        seen.insert(new.tokens_text);
    }
    // `slowly` is in two sets, so it stays.
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), ["creep up to it slowly", "push in on it slowly"]);
}

#[test]
fn a_command_is_kept_where_it_is_a_noun() {
    let phrases = Phrases::parse("[in, imperative] push in | dolly in\n[size] close-up | tight shot\n");
    for text in ["a slow push in", "close-up of it"] {
        let linked = link_mentions(text, &[]).unwrap();
        for seed in 0..16 {
            let new = phrases.exchange(&linked, 1.0, &mut Pcg64::seed_from_u64(seed));
            assert_eq!(new.tokens_text, linked.tokens_text);
        }
    }
}

#[test]
fn nearly_every_line_of_the_repository_is_a_set() {
    let text = include_str!("../../prompts/phrases.txt");
    let lines = text.lines().filter(|line| !line.trim().is_empty() && !line.trim().starts_with('#')).count();
    // The sets of angles and shares, such as `half a turn`, hold quantities only.
    let sets = Phrases::embedded().num_sets();
    assert!(sets <= lines && 100 * sets > 95 * lines, "{sets} sets of {lines} lines");
}
