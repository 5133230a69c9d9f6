use std::collections::BTreeSet;
use strum::VariantArray;

use cinesplat::language::link;
use cinesplat::operator::Amount;
use cinesplat::training::{exam, exam_objects};
use cinesplat::trajectory::Move;

#[test]
fn the_exam_is_large_and_covers_every_move() {
    let items = exam().unwrap();
    assert!(items.len() >= 220, "{}", items.len());
    let moves: BTreeSet<Move> =
        items.iter().flat_map(|item| item.program.steps.iter().map(|step| step.movement)).collect();
    let missing: Vec<&Move> = Move::VARIANTS.iter().filter(|m| !moves.contains(m)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// The programs were written by hand from the sentences, without the linker: both have to speak of the same things.
#[test]
fn sentences_link_to_the_objects_and_quantities_that_their_programs_name() {
    let objects = exam_objects().unwrap();
    for item in exam().unwrap() {
        let linked = link(&item.prompt, &objects).unwrap();
        let steps = &item.program.steps;
        let framed = steps.iter().flat_map(|step| step.start.subjects.iter().chain(&step.end.subjects));
        let passed = steps.iter().filter_map(|step| step.via.as_ref()).flat_map(|via| via.objects.iter());
        let named: BTreeSet<u32> = framed.chain(passed).copied().collect();
        assert_eq!(linked.slots.iter().copied().collect::<BTreeSet<u32>>(), named, "{}", item.prompt);
        let amounts = steps.iter().filter_map(|step| match step.amount {
            Some(Amount::Degrees(v) | Amount::Units(v) | Amount::Factor(v)) => Some(v),
            _ => None,
        });
        let times = steps.iter().filter_map(|step| step.duration_secs).chain(item.program.duration_secs);
        let mut wanted: Vec<f64> = amounts.chain(times).collect();
        let mut found: Vec<f64> = linked.quantities.iter().map(|q| q.value).collect();
        wanted.sort_by(f64::total_cmp);
        found.sort_by(f64::total_cmp);
        assert!(
            wanted.len() == found.len() && wanted.iter().zip(&found).all(|(a, b)| (a - b).abs() < 1e-9),
            "{}: {found:?}, expected {wanted:?}",
            item.prompt
        );
    }
}
