use cinesplat::language::{Automaton, NamedObject, program_from_notation, program_to_notation};
use cinesplat::reader::Question;

fn named(id: u32, label: &str) -> NamedObject {
    NamedObject { id, label: label.to_owned() }
}

#[test]
fn a_question_lists_the_objects_and_numbers_the_words() {
    let objects = [named(3, "red\nsofa"), named(17, "lamp")];
    let missing = [named(1 << 20, "grand piano")];
    let question = Question::new("Push-in, (slowly) on\tthe 3.5 m \"sofa\"...", &objects, &missing);
    insta::assert_snapshot!(question.text(), @r#"
    Objects: 3 red sofa, 17 lamp
    Not in the scene: 18 grand piano
    Sentence: 1:Push-in, (2:slowly) 3:on 4:the 5:3.5 6:m 7:"sofa"...
    "#);
    let automaton = Automaton::new(&question.answers());
    assert!(automaton.accepts("1-7 push-in end=18") && !automaton.accepts("1-7 push-in end=1"));
}

#[test]
fn the_worked_examples_are_answers_in_canonical_notation_about_their_objects_and_words() {
    for (asked, answer) in Question::examples() {
        let (steps, film) = answer.split_once(" | ").unwrap_or((&answer, ""));
        let mut plain = Vec::new();
        for step in steps.split(" / ") {
            let (range, step) = step.split_once(' ').unwrap();
            let (first, last) = range.split_once('-').unwrap();
            assert!(asked.contains(&format!(" {first}:")) && asked.contains(&format!(" {last}:")), "{range}: {asked}");
            plain.push(step);
        }
        let film = if film.is_empty() { String::new() } else { format!(" | {film}") };
        let plain = format!("{}{film}", plain.join(" / "));
        let program = program_from_notation(&plain).unwrap();
        assert_eq!(program_to_notation(&program), plain);
        for id in program.object_ids() {
            assert!(asked.lines().any(|line| line.contains(&format!(" {id} "))), "{id}: {asked}");
        }
    }
}

#[test]
fn many_objects_and_long_names_stay_within_bounds() {
    let objects: Vec<NamedObject> = (0..500).map(|id| named(id, &"x".repeat(200))).collect();
    let text = Question::new("pan", &objects, &[]).text();
    assert!(text.len() < 100 * 70, "{}", text.len());
    assert_eq!(Question::new("pan", &[], &[]).text(), "Objects: none\nSentence: 1:pan");
}
