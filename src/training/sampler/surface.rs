//! The last coat: spacing, capitals, full stops, slips of the pen, with every letter's step kept.

use rand::RngExt;
use rand_pcg::Pcg64;

/// A character of a prompt being written: which clause it belongs to, and whether a slip may change it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Letter {
    pub(crate) char: char,
    pub(crate) clause: Option<usize>,
    pub(crate) locked: bool,
}

/// Text in the making.
#[derive(Debug, Clone, Default)]
pub(crate) struct Page {
    letters: Vec<Letter>,
}

/// How careful the writer of a prompt is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Hand {
    /// Capitals and full stops.
    Neat,
    /// All lower case, few full stops.
    Lower,
    /// No punctuation inside either.
    Bare,
    /// Shouting.
    Upper,
    /// Neat but for one slip.
    Slip,
}

impl Page {
    pub(crate) fn is_empty(&self) -> bool {
        self.letters.is_empty()
    }

    /// Adds words with a space before them, punctuation without.
    pub(crate) fn add(&mut self, words: &str, clause: Option<usize>, locked: bool) {
        for word in words.split_whitespace() {
            let tight = matches!(word, "," | "." | ";" | ":" | ")") || word.starts_with('\'');
            let after_open = self.letters.last().is_none_or(|letter| letter.char == '(');
            if !tight && !after_open {
                self.letters.push(Letter { char: ' ', clause: None, locked: true });
            }
            self.letters.extend(word.chars().map(|char| Letter { char, clause, locked }));
        }
    }

    fn ends_with(&self, endings: &[char]) -> bool {
        self.letters.last().is_some_and(|letter| endings.contains(&letter.char))
    }

    /// Repairs what joining leaves: doubled articles and marks, `a` before a vowel, a mark at the start.
    pub(crate) fn tidy(&mut self) {
        let text: Vec<char> = self.letters.iter().map(|letter| letter.char).collect();
        let mut drop = vec![false; text.len()];
        let mark = |c: char| matches!(c, ',' | '.' | ';' | ':');
        let mut seen_word = false;
        let mut last_mark: Option<usize> = None;
        for (i, c) in text.iter().enumerate() {
            if mark(*c) && !digit_on_both_sides(&text, i) {
                if !seen_word {
                    set(&mut drop, i);
                } else if let Some(previous) = last_mark {
                    // Of two marks in a row the stronger one stays: the full stop.
                    let loser = if *c == '.' || text.get(previous) == Some(&',') { previous } else { i };
                    set(&mut drop, loser);
                    last_mark = Some(if loser == i { previous } else { i });
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
        self.letters.retain(|_| {
            index += 1;
            !drop.get(index - 1).copied().unwrap_or(false)
        });
        self.fix_articles();
        while self.letters.first().is_some_and(|letter| letter.char == ' ') {
            self.letters.remove(0);
        }
    }

    /// `a` becomes `an` before a vowel.
    fn fix_articles(&mut self) {
        let mut i = 0;
        while i + 2 < self.letters.len() {
            let is =
                |at: usize, chars: &[char]| self.letters.get(at).is_some_and(|letter| chars.contains(&letter.char));
            let starts = i == 0 || is(i - 1, &[' ', '(']);
            if starts
                && is(i, &['a'])
                && is(i + 1, &[' '])
                && is(i + 2, &['a', 'e', 'i', 'o'])
                && !self.one_follows(i + 2)
            {
                let letter = self.letters.get(i).copied();
                if let Some(letter) = letter {
                    self.letters.insert(i + 1, Letter { char: 'n', ..letter });
                }
            }
            i += 1;
        }
    }

    fn one_follows(&self, at: usize) -> bool {
        let next: String = self.letters.iter().skip(at).take(4).map(|letter| letter.char).collect();
        next.starts_with("one ") || next.starts_with("one-")
    }

    /// Writes it in a hand: capitals, full stop, slip.
    pub(crate) fn write(&mut self, hand: Hand, rng: &mut Pcg64) {
        match hand {
            Hand::Neat | Hand::Slip => {
                self.capitalize();
                if rng.random_bool(0.75) && !self.ends_with(&['.', '!', '?', ')']) {
                    self.letters.push(Letter { char: '.', clause: None, locked: true });
                }
            }
            Hand::Lower => {}
            Hand::Bare => self.letters.retain(|letter| letter.locked || !matches!(letter.char, ',' | ';' | ':' | '\'')),
            Hand::Upper => {
                for letter in &mut self.letters {
                    letter.char = letter.char.to_ascii_uppercase();
                }
            }
        }
        if hand == Hand::Slip {
            self.slip(rng);
        }
    }

    fn capitalize(&mut self) {
        let mut due = true;
        for letter in &mut self.letters {
            if due && letter.char.is_ascii_lowercase() {
                letter.char = letter.char.to_ascii_uppercase();
            }
            due = match letter.char {
                '.' | '!' | '?' => true,
                ' ' => due,
                _ => false,
            };
        }
    }

    /// One letter doubled, dropped, swapped with the next or replaced, in a word of at least four.
    fn slip(&mut self, rng: &mut Pcg64) {
        let free = |letter: Option<&Letter>| letter.is_some_and(|l| !l.locked && l.char.is_ascii_lowercase());
        let places: Vec<usize> = (1..self.letters.len())
            .filter(|i| (i - 1..=i + 1).all(|j| free(self.letters.get(j))) && free(self.letters.get(i + 2)))
            .collect();
        if places.is_empty() {
            return;
        }
        let at = places.get(rng.random_range(0..places.len())).copied().unwrap_or(1);
        match rng.random_range(0..4) {
            0 => {
                self.letters.remove(at);
            }
            1 => self.letters.swap(at, at + 1),
            2 => {
                let letter = self.letters.get(at).copied();
                if let Some(letter) = letter {
                    self.letters.insert(at, letter);
                }
            }
            _ => {
                if let Some(letter) = self.letters.get_mut(at) {
                    letter.char = char::from(b'a' + rng.random_range(0..26u8));
                }
            }
        }
    }

    /// The text, and for each clause the bytes it covers.
    pub(crate) fn finish(&self, num_clauses: usize) -> (String, Vec<Option<[usize; 2]>>) {
        let mut text = String::new();
        let mut spans: Vec<Option<[usize; 2]>> = vec![None; num_clauses];
        for letter in &self.letters {
            let start = text.len();
            text.push(letter.char);
            if let Some(span) = letter.clause.and_then(|clause| spans.get_mut(clause)) {
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

fn set(drop: &mut [bool], i: usize) {
    if let Some(place) = drop.get_mut(i) {
        *place = true;
    }
}

/// `a a quarter turn` and `a the`: the first article goes.
fn drop_doubled_articles(text: &[char], drop: &mut [bool]) {
    const SECOND: [&str; 8] = ["a ", "an ", "the ", "one ", "half a", "two ", "three ", "once "];
    for i in 0..text.len() {
        let starts = i == 0 || matches!(text.get(i - 1), Some(' '));
        let article = starts && text.get(i) == Some(&'a') && text.get(i + 1) == Some(&' ');
        let rest: String = text.iter().skip(i + 2).take(8).collect();
        if article && SECOND.iter().any(|second| rest.starts_with(second)) {
            set(drop, i);
            set(drop, i + 1);
        }
    }
}
