use std::collections::BTreeSet;

use cinesplat::language::{Automaton, MAX_STEPS, Pattern, program_from_notation, program_pattern, program_to_notation};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::support::corpus;

/// The notation over some objects.
fn notation(ids: &[u32]) -> Automaton {
    Automaton::new(&program_pattern(ids, &Pattern::text("")))
}

/// Whether all numbers of a notation have at most four digits before the point and two after it.
fn has_short_numbers(text: &str) -> bool {
    let numbers = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    numbers.map(|number| number.split_once('.').unwrap_or((number, ""))).all(|(a, b)| a.len() <= 4 && b.len() <= 2)
}

#[test]
fn every_printed_program_of_the_corpus_is_accepted() {
    let programs: Vec<_> = corpus().iter().flat_map(|writer| &writer.sentences).map(|s| s.program.clone()).collect();
    // What a scene lacks has a large id; here it is one more object.
    let small = |ids: &[u32]| ids.iter().map(|id| (*id).min(999)).collect::<Vec<u32>>();
    let programs: Vec<_> = programs.into_iter().map(|program| program.with_ids(&small)).collect();
    let ids: BTreeSet<u32> = programs.iter().flat_map(cinesplat::operator::Program::object_ids).collect();
    let automaton = notation(&ids.into_iter().collect::<Vec<_>>());
    let texts = programs.iter().map(program_to_notation);
    // `over=room` means to pass nothing in particular, which no answer says.
    let is_said = |text: &String| has_short_numbers(text) && !text.contains("= ") && !text.ends_with('=');
    let (said, others): (Vec<String>, Vec<String>) = texts.partition(is_said);
    let refused: Vec<&String> = said.iter().filter(|text| !automaton.accepts(text)).collect();
    assert!(refused.is_empty(), "{refused:#?}");
    assert!(said.len() > 8000 && 400 * others.len() < said.len(), "{} said, not {others:#?}", said.len());
}

#[test]
fn a_program_with_every_token_is_accepted() {
    let text = "orbit-left with=crane-up+zoom-in start=3+5:long:40%:low:-30.5deg:h1.6u:d0.5u:35mm:top:from-back:at-upper-left! end=room:close-up:wide-lens:hidden between=1+2 look=4 keep=6+7 avoid=8 amount=45deg dur=2.5s slow ease=ease-in cut returns either / static look=ahead amount=large | total=8s no=zoom+roll+rise";
    assert_eq!(program_to_notation(&program_from_notation(text).unwrap()), text);
    let automaton = notation(&[1, 2, 3, 4, 5, 6, 7, 8]);
    assert!(automaton.accepts(text));
    assert!(automaton.accepts("none") && automaton.accepts("none | no=pan"));
}

#[test]
fn what_is_not_canonical_or_about_other_objects_is_not_accepted() {
    let automaton = notation(&[1, 30]);
    assert!(automaton.accepts("push-in end=30 slow") && automaton.accepts("push-in end=room:long"));
    for text in [
        "",
        "push-in end=3",
        "push-in end=",
        "push-in end=room",
        "push-in slow end=1",
        "push-in end=1:low:close-up",
        "push-in  slow",
        "push-in amount=01x",
        "push-in amount=1.50x",
        "push-in amount=12345x",
        "push-in end=1:-0deg",
        "pan",
        "push-in normal",
        "push-in / none",
        "push-in |",
        "push-in | no=roll+zoom",
        "push-in with=pan-left+pan-right+roll-cw",
    ] {
        assert!(!automaton.accepts(text), "{text}");
    }
    let long = vec!["push-in"; MAX_STEPS + 1].join(" / ");
    assert!(!automaton.accepts(&long) && automaton.accepts(&long[" / push-in".len()..]));
}

#[test]
fn ten_thousand_random_walks_through_the_notation_parse_and_print_themselves() {
    let automaton = notation(&[1, 2, 30]);
    let mut rng = Pcg64::seed_from_u64(7);
    for _ in 0..10_000 {
        let mut states = automaton.start();
        let mut text = Vec::new();
        // Once the text is long enough, only bytes that lead to its end.
        let enough = rng.random_range(0..120);
        loop {
            let left = states.bytes_to_end().unwrap();
            let mut bytes = states.next_bytes();
            if text.len() >= enough {
                bytes.retain(|byte| automaton.after(&states, *byte).bytes_to_end().is_some_and(|after| after < left));
            }
            if bytes.is_empty() {
                break;
            }
            let byte = bytes[rng.random_range(0..bytes.len())];
            text.push(byte);
            states = automaton.after(&states, byte);
        }
        let text = String::from_utf8(text).unwrap();
        assert!(states.may_end(), "{text}");
        let program = program_from_notation(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(program_to_notation(&program), text);
    }
}

#[test]
fn the_distance_to_the_end_is_that_of_the_shortest_text() {
    let pattern = Pattern::Sequence(vec![
        Pattern::one_of(["abc", "de"]),
        Pattern::text("x").up_to(3),
        Pattern::Choice(Vec::new()).optional(),
    ]);
    let automaton = Automaton::new(&pattern);
    assert_eq!(automaton.start().bytes_to_end(), Some(2));
    let after_a = automaton.after(&automaton.start(), b'a');
    assert_eq!((after_a.bytes_to_end(), after_a.next_bytes()), (Some(2), vec![b'b']));
    assert!(automaton.accepts("dexxx") && !automaton.accepts("dexxxx") && !automaton.accepts("ab"));
    assert!(automaton.after(&automaton.start(), b'z').is_empty());
    let nothing = Automaton::new(&Pattern::Choice(Vec::new()));
    assert!(nothing.start().is_empty() && nothing.start().bytes_to_end().is_none());
}
