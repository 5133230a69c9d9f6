//! The text of a prompt: spacing, articles, capitals, punctuation, typo augmentation.
//!
//! Enters: words of clauses. Leaves: the text and the byte range of every clause. The one invariant: every character
//! keeps the clause that it belongs to through all edits.

use rand::RngExt;
use rand_pcg::Pcg64;

/// A character of the text.
#[derive(Debug, Clone, Copy)]
struct SurfaceChar {
    char: char,
    /// Index of its clause.
    clause: Option<usize>,
    /// Part of a mention or a quantity: never changed by a typo, never dropped as punctuation.
    protected: bool,
}

/// The text of a prompt with the clause of every character.
#[derive(Debug, Clone, Default)]
pub(crate) struct SurfaceText {
    chars: Vec<SurfaceChar>,
}

/// Capitals and punctuation of a prompt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WritingStyle {
    /// Capitals and, mostly, a final full stop.
    Standard,
    /// As composed: lower case, no final full stop.
    Lowercase,
    /// Lower case without commas, semicolons, colons and apostrophes.
    Unpunctuated,
    /// All capitals.
    Uppercase,
    /// Standard with one typo.
    Typo,
}

impl SurfaceText {
    pub(crate) fn is_empty(&self) -> bool {
        self.chars.is_empty()
    }

    /// Appends words, each after a space, and punctuation marks without one. `protected` is for mentions and quantities.
    pub(crate) fn add(&mut self, words: &str, clause: Option<usize>, protected: bool) {
        for word in words.split_whitespace() {
            let tight = matches!(word, "," | "." | ";" | ":" | ")") || word.starts_with('\'');
            let after_open = self.chars.last().is_none_or(|c| c.char == '(');
            if !tight && !after_open {
                self.chars.push(SurfaceChar { char: ' ', clause: None, protected: true });
            }
            self.chars.extend(word.chars().map(|char| SurfaceChar { char, clause, protected }));
        }
    }

    fn ends_with(&self, endings: &[char]) -> bool {
        self.chars.last().is_some_and(|c| endings.contains(&c.char))
    }

    /// Repairs the joints of clauses: drops doubled articles, all but one of several marks in a row, and marks and spaces
    /// at the start; changes `a` before a vowel to `an`.
    pub(crate) fn normalize(&mut self) {
        let text: Vec<char> = self.chars.iter().map(|c| c.char).collect();
        let mut drop = vec![false; text.len()];
        let is_mark = |c: char| matches!(c, ',' | '.' | ';' | ':');
        let mut seen_word = false;
        let mut last_mark: Option<usize> = None;
        for (i, c) in text.iter().enumerate() {
            if is_mark(*c) && !digit_on_both_sides(&text, i) {
                if !seen_word {
                    mark_dropped(&mut drop, i);
                } else if let Some(previous) = last_mark {
                    // Of two marks in a row, the full stop is kept.
                    let dropped = if *c == '.' || text.get(previous) == Some(&',') { previous } else { i };
                    mark_dropped(&mut drop, dropped);
                    last_mark = Some(if dropped == i { previous } else { i });
                } else {
                    last_mark = Some(i);
                }
            } else if *c != ' ' {
                seen_word = true;
                last_mark = None;
            }
        }
        drop_doubled_articles(&text, &mut drop);
        let mut index = 0;
        self.chars.retain(|_| {
            index += 1;
            !drop.get(index - 1).copied().unwrap_or(false)
        });
        self.fix_articles();
        while self.chars.first().is_some_and(|c| c.char == ' ') {
            self.chars.remove(0);
        }
    }

    /// Changes `a` before a vowel to `an`.
    fn fix_articles(&mut self) {
        let mut i = 0;
        while i + 2 < self.chars.len() {
            let is = |at: usize, chars: &[char]| self.chars.get(at).is_some_and(|c| chars.contains(&c.char));
            let starts = i == 0 || is(i - 1, &[' ', '(']);
            if starts
                && is(i, &['a'])
                && is(i + 1, &[' '])
                && is(i + 2, &['a', 'e', 'i', 'o'])
                && !self.one_follows(i + 2)
                && let Some(article) = self.chars.get(i).copied()
            {
                self.chars.insert(i + 1, SurfaceChar { char: 'n', ..article });
            }
            i += 1;
        }
    }

    /// Whether the word `one` is at an index: its first sound is a consonant.
    fn one_follows(&self, at: usize) -> bool {
        let next: String = self.chars.iter().skip(at).take(4).map(|c| c.char).collect();
        next.starts_with("one ") || next.starts_with("one-")
    }

    /// Applies a writing style: capitals, punctuation, a typo.
    pub(crate) fn apply(&mut self, style: WritingStyle, rng: &mut Pcg64) {
        match style {
            WritingStyle::Standard | WritingStyle::Typo => {
                self.capitalize();
                if rng.random_bool(0.75) && !self.ends_with(&['.', '!', '?', ')']) {
                    self.chars.push(SurfaceChar { char: '.', clause: None, protected: true });
                }
            }
            WritingStyle::Lowercase => {}
            WritingStyle::Unpunctuated => {
                self.chars.retain(|c| c.protected || !matches!(c.char, ',' | ';' | ':' | '\''));
            }
            WritingStyle::Uppercase => {
                for c in &mut self.chars {
                    c.char = c.char.to_ascii_uppercase();
                }
            }
        }
        if style == WritingStyle::Typo {
            self.add_typo(rng);
        }
    }

    fn capitalize(&mut self) {
        let mut due = true;
        for c in &mut self.chars {
            if due && c.char.is_ascii_lowercase() {
                c.char = c.char.to_ascii_uppercase();
            }
            due = match c.char {
                '.' | '!' | '?' => true,
                ' ' => due,
                _ => false,
            };
        }
    }

    /// Typo augmentation: drops, doubles or replaces one letter, or swaps it with the next. The letter is inside a run of
    /// four lower-case letters that are not protected; without such a run the text stays as it is.
    fn add_typo(&mut self, rng: &mut Pcg64) {
        let is_free = |c: Option<&SurfaceChar>| c.is_some_and(|l| !l.protected && l.char.is_ascii_lowercase());
        let places: Vec<usize> = (1..self.chars.len())
            .filter(|i| (i - 1..=i + 1).all(|j| is_free(self.chars.get(j))) && is_free(self.chars.get(i + 2)))
            .collect();
        if places.is_empty() {
            return;
        }
        let at = places.get(rng.random_range(0..places.len())).copied().unwrap_or(1);
        match rng.random_range(0..4) {
            0 => {
                self.chars.remove(at);
            }
            1 => self.chars.swap(at, at + 1),
            2 => {
                if let Some(doubled) = self.chars.get(at).copied() {
                    self.chars.insert(at, doubled);
                }
            }
            _ => {
                if let Some(c) = self.chars.get_mut(at) {
                    c.char = char::from(b'a' + rng.random_range(0..26u8));
                }
            }
        }
    }

    /// The text, and the byte range of each clause; `None` for a clause without text.
    pub(crate) fn text_and_spans(&self, num_clauses: usize) -> (String, Vec<Option<[usize; 2]>>) {
        let mut text = String::new();
        let mut spans: Vec<Option<[usize; 2]>> = vec![None; num_clauses];
        for c in &self.chars {
            let start = text.len();
            text.push(c.char);
            if let Some(span) = c.clause.and_then(|clause| spans.get_mut(clause)) {
                *span = Some([span.map_or(start, |s| s[0]), text.len()]);
            }
        }
        (text, spans)
    }
}

fn digit_on_both_sides(text: &[char], i: usize) -> bool {
    let digit = |at: Option<&char>| at.is_some_and(char::is_ascii_digit);
    digit(i.checked_sub(1).and_then(|j| text.get(j))) && digit(text.get(i + 1))
}

fn mark_dropped(drop: &mut [bool], i: usize) {
    if let Some(place) = drop.get_mut(i) {
        *place = true;
    }
}

/// Marks the first article of `a a quarter turn` and `a the` as dropped.
fn drop_doubled_articles(text: &[char], drop: &mut [bool]) {
    const SECOND: [&str; 8] = ["a ", "an ", "the ", "one ", "half a", "two ", "three ", "once "];
    for i in 0..text.len() {
        let starts = i == 0 || matches!(text.get(i - 1), Some(' '));
        let article = starts && text.get(i) == Some(&'a') && text.get(i + 1) == Some(&' ');
        let rest: String = text.iter().skip(i + 2).take(8).collect();
        if article && SECOND.iter().any(|second| rest.starts_with(second)) {
            mark_dropped(drop, i);
            mark_dropped(drop, i + 1);
        }
    }
}
