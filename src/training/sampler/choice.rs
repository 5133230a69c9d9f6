//! Random choice by weight.

use std::cmp::Ordering;

use rand::RngExt;
use rand_pcg::Pcg64;

/// One of `choices` with a probability in proportion to its weight; `None` without choices.
pub(crate) fn choose_from_table<T: Copy>(choices: &[(T, u32)], rng: &mut Pcg64) -> Option<T> {
    let total: u32 = choices.iter().map(|(_, weight)| weight).sum();
    let mut at = rng.random_range(0..total.max(1));
    choices
        .iter()
        .find(|(_, weight)| {
            let here = at < *weight;
            at = at.saturating_sub(*weight);
            here
        })
        .map(|(choice, _)| *choice)
}

/// One of `items` with a probability in proportion to its weight; `None` where all weights are 0.
pub(crate) fn choose_weighted<'i, T>(
    items: impl Iterator<Item = &'i T> + Clone,
    weight: impl Fn(&T) -> f64,
    rng: &mut Pcg64,
) -> Option<&'i T> {
    let total: f64 = items.clone().map(&weight).sum();
    if total.partial_cmp(&0.0) != Some(Ordering::Greater) {
        return None;
    }
    let mut at = rng.random_range(0.0..total);
    items.into_iter().find(|item| {
        at -= weight(item);
        at < 0.0
    })
}
