//! The shipped weights at work.

use std::collections::BTreeSet;
use std::time::Instant;

use cinesplat::director::keys::MAX_KEYS;
use cinesplat::director::{Direction, Director, SceneContext};
use cinesplat::language::{Linked, NamedObject, link};
use cinesplat::objects::Object;
use cinesplat::operator::Program;
use cinesplat::training::{EvaluationSplit, StepField, evaluate_director, exam, exam_objects};
use cinesplat::trajectory::Move;
use glam::{DQuat, DVec3};

fn cast() -> Vec<Object> {
    let labels = ["sofa", "floor lamp", "golden skull", "guitar", "table"];
    let object = |(place, label): (usize, &&str)| Object {
        id: 10 + place as u32,
        label: (*label).to_owned(),
        center: DVec3::new(place as f64 - 2.0, 0.5, -1.0 - (place % 2) as f64),
        half_extents: DVec3::new(0.3, 0.5, 0.2),
        rotation: DQuat::from_rotation_y(0.2 * place as f64),
        num_gaussians: 0,
        points: vec![DVec3::new(place as f64 - 2.2, 0.4, -1.0), DVec3::new(place as f64 - 1.8, 0.9, -1.2)],
        shape_radius: 0.0,
        mask_iou: 0.0,
    };
    labels.iter().enumerate().map(object).collect()
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
fn plain_words_are_understood() {
    let director = Director::embedded().unwrap();
    let objects = cast();
    let direction = directed(&director, "Push in on the golden skull, then pan left to the guitar.", &objects);
    let moves: Vec<Move> = direction.program.steps.iter().map(|step| step.movement).collect();
    assert_eq!(moves, [Move::PushIn, Move::PanLeft]);
    assert_eq!(direction.program.steps[1].end.subjects, [13]);
    let orbit = directed(&director, "Orbit <obj-12> to the right by 45 degrees.", &objects);
    assert_eq!(orbit.program.steps.len(), 1);
    assert_eq!(orbit.program.steps[0].amount, Some(cinesplat::operator::Amount::Degrees(45.0)));
}

#[test]
fn the_middle_one_of_three_clauses_is_carried_out() {
    let director = Director::embedded().unwrap();
    let objects = cast();
    let said = |prompt: &str| directed(&director, prompt, &objects).program.steps;
    let moves = |prompt: &str| said(prompt).iter().map(|step| step.movement).collect::<Vec<Move>>();
    let until_both =
        "Push in on <obj-10>, pan left to <obj-11>, then pull back until <obj-10> and <obj-11> are both in frame.";
    assert_eq!(moves(until_both), [Move::PushIn, Move::PanLeft, Move::PullOut]);
    let hold = said("Push in on the guitar, hold for two seconds, then pull back.");
    assert_eq!(
        hold.iter().map(|step| (step.movement, step.duration_secs)).collect::<Vec<_>>(),
        [(Move::PushIn, None), (Move::Static, Some(2.0)), (Move::PullOut, None)]
    );
    assert_eq!(moves("After panning right to the table, push in on it."), [Move::PanRight, Move::PushIn]);
}

/// A step has to use each object that the exam's sentences name; which ones they name was written by hand.
#[test]
fn what_a_sentence_names_is_used() {
    let director = Director::embedded().unwrap();
    let cast = exam_objects().unwrap();
    let objects: Vec<Object> = cast
        .iter()
        .enumerate()
        .map(|(place, named)| Object {
            id: named.id,
            label: named.label.clone(),
            center: DVec3::new(place as f64, 0.0, (place % 3) as f64),
            half_extents: DVec3::splat(0.3),
            rotation: DQuat::IDENTITY,
            num_gaussians: 0,
            points: Vec::new(),
            shape_radius: 0.0,
            mask_iou: 0.0,
        })
        .collect();
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
    assert!(whole * 100 >= all * 97, "{whole} of {all}");
}

#[test]
fn whatever_the_words_the_direction_can_be_carried_out() {
    let director = Director::embedded().unwrap();
    let objects = cast();
    let endless = "push in on the sofa then pan left to the lamp and ".repeat(12);
    let prompts = [
        "blorf the wug <obj-13> zzz",
        "\u{202e}الكاميرا <obj-10>",
        "🎥🎥 sofa",
        "a",
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
fn a_prompt_beyond_the_network_is_refused() {
    let objects = cast();
    let context = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::ZERO, size: 7.0 };
    let director = Director::embedded().unwrap();
    let refused =
        |linked: &Linked| director.direct(linked, &context).map_err(|error| error.code().to_owned()).unwrap_err();
    assert_eq!(refused(&linked(&"pan left ".repeat(300), &objects)), "PROMPT-TOO-LONG");
    let endless = Linked { tokens_text: "x".repeat(1 << 20), ..Linked::default() };
    let start = Instant::now();
    assert_eq!(refused(&endless), "PROMPT-TOO-LONG");
    assert!(start.elapsed().as_secs() < 5, "an endless word was given to the tokenizer");
    assert_eq!(refused(&Linked::default()), "PROMPT-EMPTY");
}

#[test]
fn the_order_of_the_objects_makes_no_difference_to_the_program() {
    let director = Director::embedded().unwrap();
    let mut objects = cast();
    let prompt = "truck right from the sofa past the lamp, then orbit the skull";
    let here = directed(&director, prompt, &objects);
    objects.reverse();
    assert_eq!(directed(&director, prompt, &objects), here);
}

/// A floor under the shipped weights: the card in `models` says where they stand.
#[test]
fn the_shipped_weights_understand_most_sentences_that_people_wrote() {
    let metrics = evaluate_director(&Director::embedded().unwrap(), EvaluationSplit::HandWritten).unwrap();
    let moves = metrics.fields.iter().find(|(field, _)| *field == StepField::Move).unwrap().1;
    assert!(moves.correct_frac() >= 0.8, "{moves:?}");
}
