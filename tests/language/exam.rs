use std::collections::BTreeSet;
use strum::VariantArray;

use super::assert_links_to;
use cinesplat::language::link;
use cinesplat::training::{exam, exam_objects};
use cinesplat::trajectory::Move;

#[test]
fn the_exam_has_at_least_220_prompts_and_covers_every_move() {
    let exam = exam().unwrap();
    assert!(exam.len() >= 220, "{}", exam.len());
    let steps = exam.iter().flat_map(|item| &item.program.steps);
    let moves: BTreeSet<Move> = steps.map(|step| step.movement).collect();
    let missing: Vec<&Move> = Move::VARIANTS.iter().filter(|movement| !moves.contains(movement)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// The programs were written by hand from the prompts, without the linker.
#[test]
fn prompts_of_the_exam_link_to_the_objects_and_quantities_of_their_programs() {
    let objects = exam_objects().unwrap();
    for item in exam().unwrap() {
        assert_links_to(&link(&item.prompt, &objects).unwrap(), &item.program, &item.prompt);
    }
}
