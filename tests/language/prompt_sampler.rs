use std::collections::BTreeSet;
use strum::VariantArray;

use super::assert_links_to;
use cinesplat::language::{NamedObject, link, program_from_notation, program_to_notation};
use cinesplat::operator::{Program, Speed, Step};
use cinesplat::training::{LabeledPrompt, PromptSampler, TemplateSplit, exam, exam_objects};
use cinesplat::trajectory::Move;
use rand::SeedableRng;
use rand_pcg::Pcg64;

const NUM_SAMPLES: usize = 1500;

fn samples(split: TemplateSplit, seed: u64, count: usize) -> Vec<(LabeledPrompt, Vec<NamedObject>)> {
    let sampler = PromptSampler::embedded().unwrap().with_split(split);
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut draw = |index: usize| {
        let objects = sampler.invent_objects(1 + index % 8, &mut rng);
        (sampler.sample(&objects, &mut rng), objects)
    };
    (0..count).map(&mut draw).collect()
}

#[test]
fn equal_seeds_give_equal_prompts() {
    assert_eq!(samples(TemplateSplit::Train, 5, 50), samples(TemplateSplit::Train, 5, 50));
    assert_ne!(samples(TemplateSplit::Train, 5, 50), samples(TemplateSplit::Train, 6, 50));
}

#[test]
fn prompts_link_to_the_objects_and_quantities_of_their_programs() {
    for (sample, objects) in samples(TemplateSplit::Train, 1, NUM_SAMPLES) {
        assert_links_to(&link(&sample.prompt, &objects).unwrap(), &sample.program, &sample.prompt);
    }
}

#[test]
fn programs_survive_the_notation_and_their_words_lie_in_the_prompt() {
    for (sample, _) in samples(TemplateSplit::Train, 2, NUM_SAMPLES) {
        assert!((1..=8).contains(&sample.program.steps.len()), "{}", sample.prompt);
        for step in &sample.program.steps {
            let [start, end] = step.words.unwrap();
            assert!(start < end && sample.prompt.get(start..end).is_some(), "{}", sample.prompt);
            let count = step.end.subjects.len();
            let different: BTreeSet<u32> = step.end.subjects.iter().copied().collect();
            assert_eq!(different.len(), count, "{}: {}", sample.prompt, program_to_notation(&sample.program));
        }
        let without_words = sample.program.steps.iter().map(|step| Step { words: None, ..step.clone() });
        let bare = Program { steps: without_words.collect(), ..sample.program };
        assert_eq!(program_from_notation(&program_to_notation(&bare)).unwrap(), bare);
    }
}

/// Steps are in the order of their words, except for two clauses joined by `before`.
#[test]
fn before_swaps_two_clauses() {
    let mut swapped = 0;
    for (sample, objects) in samples(TemplateSplit::Train, 12, NUM_SAMPLES) {
        let starts: Vec<usize> = sample.program.steps.iter().map(|step| step.words.unwrap()[0]).collect();
        let text = link(&sample.prompt, &objects).unwrap().tokens_text;
        if starts.is_sorted() {
            assert!(starts.len() < 2 || !text.starts_with("before "), "{}", sample.prompt);
        } else {
            assert!(!sample.program.steps.iter().any(|step| step.returns || step.cut), "{}", sample.prompt);
            swapped += 1;
        }
    }
    assert!(swapped > 5, "{swapped}");
}

/// `rush up to the vase and hold for 2 seconds`: the duration belongs to the hold.
#[test]
fn a_duration_after_a_hold_belongs_to_the_hold() {
    let mut holds = 0;
    for (sample, _) in samples(TemplateSplit::Train, 13, NUM_SAMPLES) {
        for pair in sample.program.steps.windows(2) {
            let [before, hold] = pair else { continue };
            if hold.movement == Move::Static && !hold.cut && hold.words == before.words {
                assert_eq!(before.duration_secs, None, "{}", sample.prompt);
                assert_eq!(hold.speed, Speed::Normal, "{}", sample.prompt);
                holds += 1;
            }
        }
    }
    assert!(holds > 5, "{holds}");
}

#[test]
fn every_move_is_sampled() {
    let seen: BTreeSet<Move> = samples(TemplateSplit::Train, 3, 4000)
        .iter()
        .flat_map(|(s, _)| s.program.steps.iter().map(|step| step.movement))
        .collect();
    let missing: Vec<&Move> = Move::VARIANTS.iter().filter(|m| !seen.contains(m)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// The oracle does not use the grammar: in a prompt of one step the direction word decides. Clockwise from above is to the
/// left.
#[test]
fn the_direction_word_of_a_prompt_is_the_direction_of_its_move() {
    let mut checked = 0;
    for (sample, objects) in samples(TemplateSplit::Train, 4, 2 * NUM_SAMPLES) {
        let [step] = sample.program.steps.as_slice() else { continue };
        let text = format!(" {} ", link(&sample.prompt, &objects).unwrap().tokens_text);
        let (left, right) = (text.matches(" left").count(), text.matches(" right").count());
        let counter = text.contains("counter") || text.contains("anticlockwise") || text.contains("anti clockwise");
        // A typo may hide one of the two words of `from left to right`.
        if text.contains("from left")
            || text.contains("from right")
            || text.contains(" end ")
            || text.contains(" side ")
            || text.contains(" edge ")
        {
            continue;
        }
        let name = step.movement.as_ref();
        let turns = name.starts_with("orbit") || name.starts_with("arc");
        if turns && text.contains("clockwise") {
            assert_eq!(name.ends_with("left"), !counter, "{}", sample.prompt);
            checked += 1;
        } else if (name.ends_with("-left") || name.ends_with("-right"))
            && step.with.is_empty()
            && left + right == 1
            && !step.either_way
        {
            assert_eq!(name.ends_with("-left"), left == 1, "{}", sample.prompt);
            checked += 1;
        }
    }
    assert!(checked > 80, "{checked}");
}

#[test]
fn held_out_templates_stay_out_of_the_train_split() {
    let train: String = samples(TemplateSplit::Train, 7, NUM_SAMPLES)
        .into_iter()
        .map(|(s, _)| s.prompt.to_lowercase() + "\n")
        .collect();
    let held: String = samples(TemplateSplit::HeldOut, 7, NUM_SAMPLES)
        .into_iter()
        .map(|(s, _)| s.prompt.to_lowercase() + "\n")
        .collect();
    for phrase in [
        "a smidge",
        "a tad",
        "kick off",
        "wind up on",
        "unveil",
        "home in on",
        "bear down on",
        "levitate",
        "rock steady",
    ] {
        assert!(!train.contains(phrase), "{phrase}");
    }
    assert!(["a smidge", "kick off", "unveil", "home in on"].iter().filter(|w| held.contains(**w)).count() >= 2);
}

#[test]
fn exam_sentences_are_never_sampled() {
    let objects = exam_objects().unwrap();
    let bare = |prompt: &str, objects: &[NamedObject]| {
        link(prompt, objects).map(|l| l.tokens_text.trim_end_matches([' ', '.', '!']).to_owned()).unwrap()
    };
    let exam: BTreeSet<String> = exam().unwrap().iter().map(|item| bare(&item.prompt, &objects)).collect();
    for (sample, cast) in samples(TemplateSplit::Train, 8, NUM_SAMPLES) {
        assert!(!exam.contains(&bare(&sample.prompt, &cast)), "{}", sample.prompt);
    }
}

#[test]
fn any_list_of_objects_gives_a_prompt_that_links() {
    let sampler = PromptSampler::embedded().unwrap();
    let mut rng = Pcg64::seed_from_u64(9);
    let odd = [
        vec![],
        vec![NamedObject { id: 65535, label: String::new() }],
        vec![
            NamedObject { id: 1, label: "camera".to_owned() },
            NamedObject { id: 2, label: "the \u{202E} pan-left 45 degrees".to_owned() },
        ],
        (1..=3).map(|id| NamedObject { id, label: "chair".to_owned() }).collect(),
        (1..=300).map(|id| NamedObject { id, label: format!("box {id}") }).collect(),
    ];
    for objects in &odd {
        for _ in 0..40 {
            let sample = sampler.sample(objects, &mut rng);
            assert!(!sample.prompt.is_empty() && !sample.program.steps.is_empty());
            assert!(link(&sample.prompt, objects).is_ok(), "{}", sample.prompt);
        }
    }
}
