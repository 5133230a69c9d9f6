//! Directions of the shipped weights.

use std::collections::BTreeSet;

use cinesplat::director::keys::MAX_KEYS;
use cinesplat::director::{Direction, Director, DirectorError, SceneContext};
use cinesplat::language::{Linked, NamedObject, link};
use cinesplat::objects::Object;
use cinesplat::operator::Program;
use cinesplat::training::{EvaluationSplit, StepField, evaluate_director, exam, exam_objects};
use cinesplat::trajectory::Move;
use glam::{DQuat, DVec3};

/// Five objects with ids from 10 and clouds of two points.
fn room() -> Vec<Object> {
    let labels = ["sofa", "floor lamp", "golden skull", "guitar", "table"];
    let placed = |(idx, label): (usize, &&str)| {
        let center = DVec3::new(idx as f64 - 2.0, 0.5, -1.0 - (idx % 2) as f64);
        Object {
            rotation: DQuat::from_rotation_y(0.2 * idx as f64),
            points: vec![DVec3::new(idx as f64 - 2.2, 0.4, -1.0), DVec3::new(idx as f64 - 1.8, 0.9, -1.2)],
            ..Object::from_box(10 + idx as u32, label, center, DVec3::new(0.3, 0.5, 0.2))
        }
    };
    labels.iter().enumerate().map(placed).collect()
}

fn linked(prompt: &str, objects: &[Object]) -> Linked {
    let named = |object: &Object| NamedObject { id: object.id, label: object.label.clone() };
    link(prompt, &objects.iter().map(named).collect::<Vec<_>>()).unwrap()
}

fn directed(director: &Director, prompt: &str, objects: &[Object]) -> Direction {
    let context = SceneContext { objects, up: DVec3::Y, center: DVec3::new(0.0, 1.0, -1.5), size: 7.0 };
    director.direct(&linked(prompt, objects), &context).unwrap()
}

#[test]
fn simple_prompts_are_understood() {
    let director = Director::embedded().unwrap();
    let objects = room();
    let direction = directed(&director, "Push in on the golden skull, then pan left to the guitar.", &objects);
    let moves: Vec<Move> = direction.program.steps.iter().map(|step| step.movement).collect();
    assert_eq!(moves, [Move::PushIn, Move::PanLeft]);
    assert_eq!(direction.program.steps[1].end.subjects, [13]);
    let orbit = directed(&director, "Orbit <obj-12> to the right by 45 degrees.", &objects);
    assert_eq!(orbit.program.steps.len(), 1);
    assert_eq!(orbit.program.steps[0].amount, Some(cinesplat::operator::Amount::Degrees(45.0)));
}

#[test]
fn the_second_of_three_clauses_is_not_lost() {
    let director = Director::embedded().unwrap();
    let objects = room();
    let steps = |prompt: &str| directed(&director, prompt, &objects).program.steps;
    let moves = |prompt: &str| steps(prompt).iter().map(|step| step.movement).collect::<Vec<Move>>();
    let until_both =
        "Push in on <obj-10>, pan left to <obj-11>, then pull back until <obj-10> and <obj-11> are both in frame.";
    assert_eq!(moves(until_both), [Move::PushIn, Move::PanLeft, Move::PullOut]);
    let hold = steps("Push in on the guitar, hold for two seconds, then pull back.");
    assert_eq!(
        hold.iter().map(|step| (step.movement, step.duration_secs)).collect::<Vec<_>>(),
        [(Move::PushIn, None), (Move::Static, Some(2.0)), (Move::PullOut, None)]
    );
    assert_eq!(moves("After panning right to the table, push in on it."), [Move::PanRight, Move::PushIn]);
}

/// What a sentence asks for does not depend on where things are and how large they are.
#[test]
fn programs_are_read_from_the_words_alone() {
    let director = Director::embedded().unwrap();
    let objects = room();
    let shifted = |(idx, object): (usize, &Object)| Object {
        center: DVec3::new(3.0 - 2.5 * idx as f64, 1.5 * idx as f64, 2.0 * (idx % 2) as f64),
        half_extents: object.half_extents * (0.2 + idx as f64),
        points: Vec::new(),
        ..object.clone()
    };
    let elsewhere: Vec<Object> = objects.iter().enumerate().map(shifted).collect();
    for prompt in [
        "We open wide on the room, drift past the table, and come to rest on a medium close-up of the golden skull.",
        "Find the guitar. Push in slowly, let the lamp go by in the foreground, finish on a close-up of the guitar.",
        "overhead shot of the table, rotate slowly clockwise",
        "sneak up on the sofa from the left, low",
    ] {
        let words = linked(prompt, &objects);
        let read = |objects: &[Object]| {
            let context = SceneContext { objects, up: DVec3::Y, center: DVec3::new(0.0, 1.0, -1.5), size: 7.0 };
            director.direct(&words, &context).unwrap()
        };
        let (here, there) = (read(&objects), read(&elsewhere));
        assert_eq!(here.program, there.program, "{prompt}");
        assert_eq!(here.certainty.len(), there.certainty.len());
        assert_ne!(here.step_cameras, there.step_cameras, "{prompt}: cameras depend on where things are");
    }
}

/// The hand-written programs give the objects that each sentence names.
#[test]
fn programs_use_the_objects_that_the_sentences_name() {
    let director = Director::embedded().unwrap();
    let named = exam_objects().unwrap();
    let placed = |(idx, named): (usize, &NamedObject)| {
        Object::from_box(named.id, &named.label, DVec3::new(idx as f64, 0.0, (idx % 3) as f64), DVec3::splat(0.3))
    };
    let objects: Vec<Object> = named.iter().enumerate().map(placed).collect();
    let ids = |program: &Program| -> BTreeSet<u32> {
        let framed = program.steps.iter().flat_map(|step| step.start.subjects.iter().chain(&step.end.subjects));
        let passed = program.steps.iter().filter_map(|step| step.via.as_ref()).flat_map(|via| via.objects.iter());
        framed.chain(passed).copied().collect()
    };
    let items = exam().unwrap();
    let whole = items
        .iter()
        .filter(|item| ids(&directed(&director, &item.prompt, &objects).program).is_superset(&ids(&item.program)));
    let (whole, all) = (whole.count(), items.len());
    assert!(whole * 100 >= all * 97, "{whole} of {all} programs use every named object");
}

#[test]
fn every_prompt_gives_a_valid_direction() {
    let director = Director::embedded().unwrap();
    let objects = room();
    let endless = "push in on the sofa then pan left to the lamp and ".repeat(12);
    let prompts = [
        "blorf the wug <obj-13> zzz",
        "\u{202e}الكاميرا <obj-10>",
        "🎥🎥 sofa",
        "cut cut cut <obj-11>",
        endless.trim(),
    ];
    for prompt in prompts {
        let direction = directed(&director, prompt, &objects);
        let steps = &direction.program.steps;
        assert!(!steps.is_empty() && steps.len() <= MAX_KEYS, "{prompt}");
        assert_eq!((direction.step_cameras.len(), direction.certainty.len()), (steps.len(), steps.len()));
        assert!(direction.step_cameras.iter().all(|cameras| cameras.secs >= 0.0));
        for camera in direction.step_cameras.iter().flat_map(|cameras| [cameras.start, cameras.end]) {
            assert!(camera.pose.position.is_finite() && (camera.pose.rotation.length() - 1.0).abs() < 1e-9);
            assert!(camera.fov_y_rad > 0.0 && camera.fov_y_rad < 3.0);
        }
        let named: Vec<u32> = linked(prompt, &objects).slots;
        for step in steps {
            let ids = step
                .start
                .subjects
                .iter()
                .chain(&step.end.subjects)
                .chain(step.via.iter().flat_map(|via| &via.objects));
            assert!(named.is_empty() || ids.clone().all(|id| named.contains(id)), "{prompt}: {steps:?}");
            assert!(step.words.is_none_or(|[start, end]| prompt.get(start..end).is_some()), "{prompt}");
        }
        assert!(direction.certainty.iter().all(|certainty| (0.0..=1.0).contains(&certainty.probability)));
    }
}

#[test]
fn prompts_that_are_too_long_or_empty_are_rejected() {
    let objects = room();
    let context = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::ZERO, size: 7.0 };
    let director = Director::embedded().unwrap();
    let rejected =
        |linked: &Linked| director.direct(linked, &context).map_err(|error| error.code().to_owned()).unwrap_err();
    assert_eq!(rejected(&linked(&"pan left ".repeat(300), &objects)), "PROMPT-TOO-LONG");
    let endless = Linked { tokens_text: "x".repeat(1 << 20), ..Linked::default() };
    // A quarter of the bytes: the length is estimated before the tokenizer, which takes quadratic time, gets the text.
    let estimate = director.direct(&endless, &context);
    assert!(matches!(estimate, Err(DirectorError::PromptTooLong { found: 262_144, .. })), "{estimate:?}");
    assert_eq!(rejected(&Linked::default()), "PROMPT-EMPTY");
}

#[test]
fn the_order_of_the_objects_does_not_change_the_direction() {
    let director = Director::embedded().unwrap();
    let mut objects = room();
    let prompt = "truck right from the sofa past the lamp, then orbit the skull";
    let here = directed(&director, prompt, &objects);
    objects.reverse();
    assert_eq!(directed(&director, prompt, &objects), here);
}

/// A lower bound; `models/README.md` has the measured accuracy.
#[test]
fn the_shipped_weights_understand_most_hand_written_sentences() {
    let metrics = evaluate_director(&Director::embedded().unwrap(), EvaluationSplit::HandWritten).unwrap();
    let moves = metrics.fields.iter().find(|(field, _)| *field == StepField::Move).unwrap().1;
    assert!(moves.correct_frac() >= 0.94, "{moves:?}");
}
