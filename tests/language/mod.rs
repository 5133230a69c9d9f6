//! Linking, quantities, effects, the notation of programs, the prompt sampler and the exam.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking, in its helpers too")]

use std::collections::BTreeSet;

use cinesplat::language::Linked;
use cinesplat::operator::{Amount, Program};

mod corrections;
mod effects;
mod exam;
mod frame_shape;
mod grammar;
mod idioms;
mod link;
mod mention;
mod notation;
mod plain;
mod prompt_sampler;
mod quantity;
mod scenery;
mod senses;
mod timeline;

/// Asserts that linking found exactly the objects and quantities that a program names, in any order.
fn assert_links_to(linked: &Linked, program: &Program, prompt: &str) {
    let slots: BTreeSet<u32> = linked.slots.iter().copied().collect();
    assert_eq!(slots, program.object_ids().into_iter().collect(), "{prompt}");
    let amounts = program.steps.iter().filter_map(|step| match step.amount {
        Some(Amount::Degrees(value) | Amount::Units(value) | Amount::Factor(value)) => Some(value),
        _ => None,
    });
    let durations = program.steps.iter().filter_map(|step| step.duration_secs).chain(program.duration_secs);
    let mut expected: Vec<f64> = amounts.chain(durations).collect();
    let mut found: Vec<f64> = linked.quantities.iter().map(|quantity| quantity.value).collect();
    expected.sort_by(f64::total_cmp);
    found.sort_by(f64::total_cmp);
    let are_equal = expected.len() == found.len() && expected.iter().zip(&found).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(are_equal, "{prompt}: {found:?}, expected {expected:?}");
}
