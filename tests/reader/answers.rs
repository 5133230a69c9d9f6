//! Decoding held to the notation, with scores that are drawn instead of computed.

use cinesplat::language::{
    Automaton, NamedObject, Pattern, program_from_notation, program_pattern, program_to_notation,
};
use cinesplat::reader::{Answer, Question, ReaderError, Vocabulary, decode};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Pieces of the notation and of other texts that a vocabulary may have as tokens besides the bytes.
const PIECES: [&str; 26] = [
    "push",
    "-in",
    " orbit",
    "-left",
    " end",
    "=",
    " end=1",
    ":close",
    "-up",
    "1-",
    "12",
    " / ",
    " |",
    " | total=",
    "s",
    "s no",
    "none",
    "deg",
    "0.",
    " slow\n",
    "the",
    " camera",
    "=room:",
    "u ",
    "+2",
    " with=pan-",
];

/// All bytes, the pieces, and a token that ends the answer.
fn vocabulary() -> (Vocabulary, Vec<Vec<u8>>, u32) {
    let bytes = (0..=u8::MAX).map(|byte| vec![byte]);
    let mut tokens: Vec<Vec<u8>> = bytes.chain(PIECES.iter().map(|piece| piece.as_bytes().to_vec())).collect();
    tokens.push(b"<end>".to_vec());
    let end = tokens.len() as u32 - 1;
    (Vocabulary::new(&tokens, &[end]), tokens, end)
}

fn drawn(rng: &mut Pcg64, num_tokens: usize) -> Vec<f32> {
    (0..num_tokens).map(|_| rng.random_range(-9.0_f32..9.0)).collect()
}

fn answer(automaton: &Automaton, max_tokens: usize, rng: &mut Pcg64) -> Result<Answer, ReaderError> {
    let (vocabulary, tokens, _) = vocabulary();
    let first = drawn(rng, tokens.len());
    decode(&vocabulary, automaton, max_tokens, first, &mut |_| Ok(drawn(rng, tokens.len())))
}

#[test]
fn two_thousand_answers_with_drawn_scores_parse_and_print_themselves() {
    let automaton = Automaton::new(&program_pattern(&[1, 2, 30], &Pattern::text("")));
    let mut rng = Pcg64::seed_from_u64(11);
    let mut longest = 0;
    for _ in 0..2_000 {
        let max_tokens = rng.random_range(30..70);
        let answer = answer(&automaton, max_tokens, &mut rng).unwrap();
        assert!(answer.tokens.len() <= max_tokens);
        assert!(answer.tokens.iter().all(|(_, probability)| *probability > 0.0 && *probability <= 1.0));
        let program = program_from_notation(&answer.text).unwrap_or_else(|error| panic!("{}: {error}", answer.text));
        assert_eq!(program_to_notation(&program), answer.text);
        longest = longest.max(program.steps.len());
    }
    assert!(longest > 1, "no answer had two steps");
}

#[test]
fn an_answer_to_a_question_has_the_words_before_each_step() {
    let objects = [NamedObject { id: 4, label: "vase".to_owned() }];
    let question = Question::new("circle the vase, then stop", &objects, &[]);
    let automaton = Automaton::new(&question.answers());
    assert!(automaton.accepts("1-3 orbit-right end=4 either / 4-5 static"));
    assert!(automaton.accepts(" 5-1 static | no=cut") && automaton.accepts("none"));
    assert!(
        !automaton.accepts("orbit-right") && !automaton.accepts("1-6 static") && !automaton.accepts("1-2 static end=5")
    );
    let mut rng = Pcg64::seed_from_u64(5);
    for _ in 0..200 {
        let text = answer(&automaton, 60, &mut rng).unwrap().text;
        assert!(automaton.accepts(&text), "{text}");
    }
}

#[test]
fn the_most_likely_allowed_token_is_taken_and_its_share_is_that_of_the_allowed_ones() {
    let (vocabulary, tokens, end) = vocabulary();
    let automaton = Automaton::new(&Pattern::one_of(["none", "no"]));
    // Only `n` and `none` may come first; what must not follow scores highest and does not count.
    let mut first = vec![50.0_f32; tokens.len()];
    let id = |text: &str| tokens.iter().position(|token| token == text.as_bytes()).unwrap();
    (first[id("n")], first[id("none")]) = (1.0, 3.0);
    let mut asked = Vec::new();
    let mut next = |token: u32| {
        asked.push(token);
        let mut scores = vec![0.0; tokens.len()];
        scores[end as usize] = -4.0;
        Ok(scores)
    };
    let answer = decode(&vocabulary, &automaton, 9, first, &mut next).unwrap();
    assert_eq!(answer.text, "none");
    assert_eq!(asked, [id("none") as u32]);
    let share = 1.0 / (1.0 + (-2.0_f64).exp());
    assert!((answer.tokens[0].1 - share).abs() < 1e-9, "{:?}", answer.tokens);
    assert_eq!(answer.tokens[1], (4, 1.0), "nothing but the end may follow");
}

#[test]
fn scores_that_are_not_finite_and_answers_without_room_are_errors() {
    let automaton = Automaton::new(&Pattern::one_of(["none"]));
    let (vocabulary, tokens, _) = vocabulary();
    let code = |max_tokens: usize, score: f32| {
        let scores = || vec![score; tokens.len()];
        decode(&vocabulary, &automaton, max_tokens, scores(), &mut |_| Ok(scores())).map_err(|error| error.code())
    };
    assert_eq!(code(9, f32::NAN).unwrap_err(), "READER-NOT-FINITE");
    assert_eq!(code(9, f32::INFINITY).unwrap_err(), "READER-NOT-FINITE");
    assert_eq!(code(1, 0.0).unwrap_err(), "READER-TOO-LONG");
    assert_eq!(code(9, f32::NEG_INFINITY).unwrap().text, "none", "what is impossible to the model is a tie");
}
