//! Speeds that are stated as numbers: `at 0.3 m/s`, `15 deg/s`, `10 cm per second`.

use super::linked::Linked;
use super::numerals::number_word;
use super::quantity::{QuantityKind, rate_of, unit};

/// A stated speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rate {
    /// What moves: degrees of a turn, or scene units of a way.
    pub kind: QuantityKind,
    /// How much of it a second.
    pub per_sec: f64,
    /// Its bytes of the prompt.
    pub bytes: [usize; 2],
}

impl Linked {
    /// The rate of frames that the words state, or the usual one, per second.
    pub fn frames_per_sec(&self) -> f64 {
        let words: Vec<&str> = self.tokens_text.split(' ').collect();
        rate_of(words.windows(2).map(|pair| [pair[0], pair[1]]))
    }

    /// The speeds that the words state, in their order.
    pub fn rates(&self) -> Vec<Rate> {
        let words: Vec<&str> = self.tokens_text.split(' ').collect();
        (0..words.len()).filter_map(|at| self.rate_at(&words, at)).collect()
    }

    fn rate_at(&self, words: &[&str], at: usize) -> Option<Rate> {
        let word = |at: usize| words.get(at).copied().unwrap_or_default();
        let (value, next) = match word(at) {
            "half" if matches!(word(at + 1), "a" | "an") => (0.5, at + 2),
            "a" | "one" if unit(word(at + 1)).is_some() && word(at.wrapping_sub(1)) != "half" => (1.0, at + 1),
            number => (number.parse::<f64>().ok().or_else(|| spelled(number))?, at + 1),
        };
        let (kind, scale) = unit(word(next))?;
        let is_second = |at: usize| matches!(word(at), "s" | "sec" | "secs" | "second");
        let is_rate = matches!(word(next + 1), "/" | "per" | "a" | "every" | "each") && is_second(next + 2);
        let moves = matches!(kind, QuantityKind::Degrees | QuantityKind::Units);
        let per_sec = value * scale;
        let bytes = [self.spans.get(at)?[0], self.spans.get(next + 2)?[1]];
        (is_rate && moves && per_sec.is_finite() && per_sec > 0.0).then_some(Rate { kind, per_sec, bytes })
    }
}

/// The value of a small number in words.
fn spelled(word: &str) -> Option<f64> {
    (1..=20).find(|value| number_word(*value) == Some(word)).map(f64::from)
}
