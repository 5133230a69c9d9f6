//! Wishes, asides, corrections and lists in training.

use std::sync::LazyLock;

use cinesplat::language::{Linked, program_to_notation};
use cinesplat::operator::Program;
use cinesplat::training::{Modifiers, Position, drawn_sentences};
use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::support::corpus;

/// Drawn once, because it takes a while.
fn drawn() -> &'static [(Linked, Program)] {
    static DRAWN: LazyLock<Vec<(Linked, Program)>> = LazyLock::new(|| drawn_sentences(corpus(), 12_000, 5));
    &DRAWN
}

#[test]
fn every_drawn_word_has_its_bytes_and_every_placeholder_its_value() {
    for (linked, _) in &drawn()[..4000] {
        let words: Vec<&str> = linked.tokens_text.split(' ').collect();
        assert_eq!(words.len(), linked.spans.len(), "{}", linked.tokens_text);
        let number = |word: &str, prefix: &str| word.strip_prefix(prefix)?.strip_suffix('>')?.parse::<usize>().ok();
        for word in words {
            assert!(number(word, "<obj-").is_none_or(|slot| slot < linked.slots.len()), "{}", linked.tokens_text);
            assert!(number(word, "<qty-").is_none_or(|idx| idx < linked.quantities.len()), "{}", linked.tokens_text);
        }
        assert!(linked.spans.is_sorted_by_key(|[start, _]| *start), "{}", linked.tokens_text);
    }
}

#[test]
fn numbers_of_drawn_programs_are_quantities_of_their_words() {
    let (mut stated, mut found) = (0, 0);
    for (linked, program) in drawn() {
        let Some(secs) = program.duration_secs else { continue };
        stated += 1;
        found += usize::from(linked.quantities.iter().any(|quantity| (quantity.value - secs).abs() < 1e-9));
    }
    assert!(stated > 100 && found * 100 >= stated * 95, "{found} of {stated}");
}

#[test]
fn a_wish_reaches_the_program_with_its_number_and_object() {
    let text = "= dur=#s\n> for # seconds\n= keep=1\n> without losing [X]\n= | no=zoom\n< no zoom,\n= correction\n~ , no wait,";
    let modifiers = Modifiers::parse(text);
    assert_eq!((modifiers.steps.len(), modifiers.films.len(), modifiers.corrections.len()), (2, 1, 1));
    let mut rng = Pcg64::seed_from_u64(1);
    let wish = modifiers.steps[0].draw(Position::After, &mut rng).expect("a phrase");
    assert_eq!(wish.step, format!("dur={}s", wish.linked.quantities[0].value));
    let wish = modifiers.steps[1].draw(Position::After, &mut rng).expect("a phrase");
    assert_eq!((wish.linked.tokens_text.as_str(), wish.linked.slots.as_slice()), ("without losing <obj-0>", &[1][..]));
    assert_eq!(modifiers.films[0].draw(Position::Before, &mut rng).expect("a phrase").film, "no=zoom");
    assert_eq!(modifiers.films[0].draw(Position::After, &mut rng), None);
}

#[test]
fn all_wishes_of_the_repository_are_drawn() {
    let programs: String = drawn().iter().map(|(_, program)| program_to_notation(program) + " \n").collect();
    for wish in ["at-upper", "avoid=", "ease=ease-in ", "ease=ease-out ", "look=back ", "with=roll", "135mm"] {
        assert!(programs.contains(wish), "{wish}");
    }
}
