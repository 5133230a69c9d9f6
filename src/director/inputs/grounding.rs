//! Grounding: conversion between indices of the network and the objects, quantities and bytes of the prompt.

use cinesplat_language::{Quantity, QuantityKind};
use cinesplat_operator::Amount;

use super::move_words::names_move;

/// The meaning of the indices of one prompt. Indices count from 0.
#[derive(Debug, Clone, Default)]
pub struct Grounding {
    /// Ids of the prompt's objects: those that the text names, then the others.
    pub object_ids: Vec<u32>,
    /// Quantities of the text.
    pub quantities: Vec<Quantity>,
    /// One entry per token; the first token begins the text.
    pub(super) tokens: Vec<TokenSource>,
}

/// The place in the prompt that a token comes from.
#[derive(Debug, Clone, Copy)]
pub(super) struct TokenSource {
    /// Byte range of the prompt.
    pub(super) bytes: [usize; 2],
    /// Index of its word in the linked text.
    pub(super) word: Option<usize>,
    /// Index of the quantity that it names.
    pub(super) quantity: Option<usize>,
}

impl Grounding {
    /// Kind of each quantity.
    pub(crate) fn kinds(&self) -> Vec<QuantityKind> {
        self.quantities.iter().map(|quantity| quantity.kind).collect()
    }

    /// For each token, whether it begins a word of `text` (the linked text) that names a camera move.
    pub(crate) fn is_move(&self, text: &str) -> Vec<bool> {
        let words: Vec<&str> = text.split(' ').collect();
        let mut last = None;
        let mut begins = |token: &TokenSource| {
            let word = std::mem::replace(&mut last, token.word);
            token.word.filter(|idx| word != Some(*idx)).and_then(|idx| words.get(idx))
        };
        self.tokens.iter().map(|token| begins(token).is_some_and(|word| names_move(word))).collect()
    }

    /// Index of an object in the prompt's list.
    pub(crate) fn object_idx(&self, id: u32) -> Option<usize> {
        self.object_ids.iter().position(|known| *known == id)
    }

    /// Id of the object at an index.
    pub(crate) fn object_id(&self, idx: usize) -> Option<u32> {
        self.object_ids.get(idx).copied()
    }

    /// Index of the quantity that equals an amount; the first among the tokens of `span` (first and last token), else the
    /// first of all. `None` for amounts without a number.
    pub(crate) fn amount_idx(&self, amount: Amount, span: Option<[usize; 2]>) -> Option<usize> {
        match amount {
            Amount::Degrees(value) => self.quantity_idx(QuantityKind::Degrees, value, span),
            Amount::Units(value) => self.quantity_idx(QuantityKind::Units, value, span),
            Amount::Factor(value) => self.quantity_idx(QuantityKind::Factor, value, span),
            Amount::Slight | Amount::Large => None,
        }
    }

    /// The value of the quantity at an index.
    pub(crate) fn value(&self, idx: usize) -> Option<f64> {
        self.quantities.get(idx).map(|quantity| quantity.value)
    }

    /// The quantity at an index as an amount; `None` for kinds that are none.
    pub(crate) fn amount(&self, idx: usize) -> Option<Amount> {
        let quantity = self.quantities.get(idx)?;
        match quantity.kind {
            QuantityKind::Seconds | QuantityKind::Percent | QuantityKind::Millimeters => None,
            QuantityKind::Degrees => Some(Amount::Degrees(quantity.value)),
            QuantityKind::Units => Some(Amount::Units(quantity.value)),
            QuantityKind::Factor => Some(Amount::Factor(quantity.value)),
        }
    }

    /// Index of the quantity that equals a duration; the first among the tokens of `span` (first and last token), else
    /// the first of all.
    pub fn seconds_idx(&self, secs: f64, span: Option<[usize; 2]>) -> Option<usize> {
        self.quantity_idx(QuantityKind::Seconds, secs, span)
    }

    /// The quantity at an index as a duration; `None` for other kinds.
    pub(crate) fn seconds(&self, idx: usize) -> Option<f64> {
        let is_time = |quantity: &&Quantity| quantity.kind == QuantityKind::Seconds;
        self.quantities.get(idx).filter(is_time).map(|quantity| quantity.value)
    }

    /// For each token, whether it begins in one of these byte ranges of the prompt.
    pub fn tokens_in(&self, ranges: &[[usize; 2]]) -> Vec<bool> {
        let inside = |token: &TokenSource| {
            token.word.is_some() && ranges.iter().any(|[start, end]| (start..end).contains(&&token.bytes[0]))
        };
        self.tokens.iter().map(inside).collect()
    }

    /// Byte ranges of the prompt of the marked tokens; consecutive ones make one range.
    pub(crate) fn ranges_of(&self, marked: &[bool]) -> Vec<[usize; 2]> {
        let mut ranges: Vec<[usize; 2]> = Vec::new();
        let mut continues = false;
        for (token, is_marked) in self.tokens.iter().zip(marked) {
            let is_marked = *is_marked && token.word.is_some();
            match ranges.last_mut() {
                Some(last) if is_marked && continues => last[1] = last[1].max(token.bytes[1]),
                _ if is_marked => ranges.push(token.bytes),
                _ => {}
            }
            continues = is_marked;
        }
        ranges
    }

    /// First and last token of a byte range of the prompt.
    pub(crate) fn token_range(&self, bytes: [usize; 2]) -> Option<[usize; 2]> {
        let inside = |token: &TokenSource| token.bytes[0] < bytes[1] && token.bytes[1] > bytes[0];
        let first = self.tokens.iter().position(inside)?;
        let last = self.tokens.iter().rposition(inside)?;
        Some([first, last])
    }

    /// Byte range of the prompt from a first to a last token; `None` when it is empty.
    pub(crate) fn byte_range(&self, tokens: [usize; 2]) -> Option<[usize; 2]> {
        let [first, last] = tokens.map(|token_idx| self.tokens.get(token_idx));
        Some([first?.bytes[0], last?.bytes[1]]).filter(|[start, end]| start < end)
    }

    /// Index of the quantity of this kind and value: the first within `span`, else the first of all.
    pub(crate) fn quantity_idx(&self, kind: QuantityKind, value: f64, span: Option<[usize; 2]>) -> Option<usize> {
        let fits = |quantity: &Quantity| {
            quantity.kind == kind && (quantity.value - value).abs() <= 1e-6 * value.abs().max(1.0)
        };
        let is_match = |idx: &usize| self.quantities.get(*idx).is_some_and(fits);
        let inside = span.and_then(|[first, last]| {
            let tokens = self.tokens.get(first..=last).unwrap_or_default();
            tokens.iter().filter_map(|token| token.quantity).find(is_match)
        });
        inside.or_else(|| (0..self.quantities.len()).find(is_match))
    }
}
