//! Splits a prompt into plain lower-case words and keeps the bytes of each.
//!
//! Enters: any UTF-8 text. Leaves: one word per run of letters or digits, one word per punctuation mark. Case, accents,
//! typographic quotes and dashes, full-width forms, joiners and direction marks do not change the words. Hyphens split
//! words (`push-in` = `push in`), and so does the border between digits and letters (`2.5s` = `2.5 s`). The sign of a turn or
//! a translation is a word (`yaw -30` = `yaw minus 30`). One pass over the text.

use super::inflection::stem;
use super::pictograms::{BEFORE, BEHIND, name_of};

/// Turns about an axis and ways along one, whose amount may have a sign: `yaw -30 degrees`.
pub(crate) const SIGNED: &str =
    "yaw pitch roll pan tilt heading azimuth elevation translate translation displacement displace offset";

/// One word and the bytes of the prompt that it was made from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Word {
    /// The word: lower case, without accents.
    pub text: String,
    /// The word as a singular noun, to compare names by.
    pub stem: String,
    /// Byte range of the prompt.
    pub span: [usize; 2],
    /// Whether it is a number that a hyphen joins to the word before: the `6` of `3-6`.
    pub after_hyphen: bool,
}

impl Word {
    /// Whether it begins with a letter.
    pub fn is_alphabetic(&self) -> bool {
        self.text.starts_with(char::is_alphabetic)
    }
}

/// The text of word `i`, or an empty string past the end.
pub(crate) fn word_at(words: &[Word], i: usize) -> &str {
    words.get(i).map_or("", |word| word.text.as_str())
}

/// Whether a list of words between spaces has a word.
pub fn is_listed(list: &str, word: &str) -> bool {
    list.split_ascii_whitespace().any(|known| known == word)
}

/// The bytes from the first to the last of some words; `[0, 0]` without words.
pub(crate) fn span_of(words: &[Word]) -> [usize; 2] {
    [words.first().map_or(0, |word| word.span[0]), words.last().map_or(0, |word| word.span[1])]
}

/// Class of a character.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Glyph {
    Letter(char),
    Digit(char),
    Mark(char),
    Apostrophe,
    /// A double quotation mark, or the sign of inches.
    Quotation,
    Hyphen,
    /// A picture of a thing, with its name.
    Pictogram(&'static str),
    Space,
    /// Dropped: it neither belongs to a word nor ends one.
    Invisible,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Run {
    Letters,
    Digits,
}

/// The words of `text`, in order.
///
/// # Example
/// ```
/// use cinesplat_language::tokenize;
///
/// let words: Vec<String> = tokenize("Push-in on the Chairs!").into_iter().map(|word| word.stem).collect();
/// assert_eq!(words, ["push", "in", "on", "the", "chair", "!"]);
/// ```
pub fn tokenize(text: &str) -> Vec<Word> {
    let glyphs: Vec<(usize, usize, Glyph)> =
        text.char_indices().map(|(at, c)| (at, at + c.len_utf8(), glyph(c))).collect();
    let mut tokenizer = Tokenizer::default();
    for (index, &(start, end, glyph)) in glyphs.iter().enumerate() {
        let before = index.checked_sub(1).and_then(|i| glyphs.get(i)).map(|g| g.2);
        let after = glyphs.get(index + 1).map(|g| g.2);
        if let Glyph::Pictogram(name) = glyph {
            tokenizer.push_pictogram(name, [start, end], &first_word(&glyphs[index + 1..]));
            continue;
        }
        tokenizer.push(glyph, [start, end], [before, after]);
    }
    tokenizer.end_word();
    for word in &mut tokenizer.words {
        word.stem = stem(&word.text);
    }
    tokenizer.words
}

/// The word or mark that some glyphs begin with.
fn first_word(glyphs: &[(usize, usize, Glyph)]) -> String {
    let rest = glyphs.iter().map(|glyph| glyph.2).skip_while(|glyph| matches!(glyph, Glyph::Space | Glyph::Invisible));
    let mut word = String::new();
    for glyph in rest {
        match glyph {
            Glyph::Letter(c) => word.push(c),
            Glyph::Mark(c) if word.is_empty() => return c.to_string(),
            _ => break,
        }
    }
    word
}

#[derive(Default)]
struct Tokenizer {
    words: Vec<Word>,
    current: Option<(Run, Word)>,
    /// Whether a hyphen before a digit was the last glyph.
    after_hyphen: bool,
    /// Whether a quotation is open. Inside one, an apostrophe after a digit ends it and means no feet.
    in_quotation: bool,
}

impl Tokenizer {
    fn end_word(&mut self) {
        self.words.extend(self.current.take().map(|(_, word)| word));
    }

    /// Appends to the current word if it is of the same run; else ends that word and begins a new one.
    fn extend_word(&mut self, run: Run, c: char, span: [usize; 2]) {
        match &mut self.current {
            Some((same, word)) if *same == run => {
                word.text.push(c);
                word.span[1] = span[1];
            }
            _ => {
                self.end_word();
                let after_hyphen = std::mem::take(&mut self.after_hyphen);
                self.current = Some((run, Word { text: c.to_string(), stem: String::new(), span, after_hyphen }));
            }
        }
    }

    fn push_mark(&mut self, text: &str, span: [usize; 2]) {
        self.end_word();
        self.words.push(Word { text: text.to_owned(), stem: String::new(), span, after_hyphen: false });
    }

    /// Appends the name of a pictogram that stands where a noun does (`from the 🎸 to the 💀`, but not `push in on the guitar 🎸`);
    /// `behind` is the word that follows.
    fn push_pictogram(&mut self, name: &str, span: [usize; 2], behind: &str) {
        self.end_word();
        let before = self.words.last();
        if before.map_or_else(|| is_listed(BEHIND, behind), |word| is_listed(BEFORE, &word.text)) {
            self.push_mark(name, span);
        }
    }

    fn push(&mut self, glyph: Glyph, span: [usize; 2], [before, after]: [Option<Glyph>; 2]) {
        let next_is_digit = matches!(after, Some(Glyph::Digit(_)));
        let in_digits = matches!(self.current, Some((Run::Digits, _)));
        let next_is_letter = matches!(after, Some(Glyph::Letter(_)));
        match glyph {
            Glyph::Letter(c) => self.extend_word(Run::Letters, c, span),
            Glyph::Digit(c) => self.extend_word(Run::Digits, c, span),
            Glyph::Mark('.') if next_is_digit && in_digits && !self.has_point() => {
                self.extend_word(Run::Digits, '.', span);
            }
            Glyph::Mark('.')
                if next_is_digit && !matches!(before, Some(Glyph::Digit(_) | Glyph::Letter(_) | Glyph::Mark('.'))) =>
            {
                self.end_word();
                self.extend_word(Run::Digits, '.', span);
            }
            Glyph::Mark('&') => self.push_mark("and", span),
            Glyph::Mark(c) => self.push_mark(c.encode_utf8(&mut [0; 4]), span),
            // `skull's` and `it's`: the ending is a word of its own. Quotation marks are dropped.
            Glyph::Apostrophe
                if next_is_letter && matches!(before, Some(Glyph::Letter(_) | Glyph::Digit(_) | Glyph::Mark('>'))) =>
            {
                self.end_word();
                self.extend_word(Run::Letters, '\'', span);
            }
            // A dash between spaces separates clauses like a comma.
            Glyph::Hyphen if matches!(before, Some(Glyph::Space)) && matches!(after, Some(Glyph::Space)) => {
                self.push_mark(",", span);
            }
            // The sign of a turn or a way: `yaw -30`.
            Glyph::Hyphen if next_is_digit && matches!(before, Some(Glyph::Space)) && self.takes_sign() => {
                self.push_mark("minus", span);
            }
            Glyph::Hyphen => {
                self.end_word();
                self.after_hyphen = next_is_digit && matches!(before, Some(Glyph::Digit(_) | Glyph::Letter(_)));
            }
            // `6'` and `18"` are feet and inches.
            Glyph::Apostrophe | Glyph::Quotation if matches!(before, Some(Glyph::Digit(_))) && !self.in_quotation => {
                self.push_mark(if glyph == Glyph::Apostrophe { "'" } else { "\"" }, span);
            }
            Glyph::Apostrophe | Glyph::Quotation => {
                self.end_word();
                self.in_quotation = next_is_letter || next_is_digit;
            }
            Glyph::Space | Glyph::Pictogram(_) => self.end_word(),
            Glyph::Invisible => {}
        }
    }

    /// Whether the last word is a turn about an axis, or a way along one.
    fn takes_sign(&self) -> bool {
        let mut back = self.words.iter().rev().skip_while(|word| matches!(word.text.as_str(), "of" | "by"));
        back.next().is_some_and(|word| is_listed(SIGNED, &word.text))
    }

    fn has_point(&self) -> bool {
        self.current.as_ref().is_some_and(|(_, word)| word.text.contains('.'))
    }
}

fn glyph(c: char) -> Glyph {
    let c = ascii_of_full_width(c);
    match c {
        '\'' | '\u{2018}' | '\u{2019}' | '\u{201B}' | '\u{2032}' | '`' | '\u{B4}' => Glyph::Apostrophe,
        '"' | '\u{201C}' | '\u{201D}' | '\u{201E}' | '\u{2033}' | '\u{AB}' | '\u{BB}' => Glyph::Quotation,
        '-' | '_' | '\u{2010}' | '\u{2011}' | '\u{2012}' | '\u{2212}' | '\u{AD}' => Glyph::Hyphen,
        '\u{2013}' | '\u{2014}' | '\u{2015}' | '\u{2192}' | '\u{2794}' | '\u{21D2}' | '\u{27A1}' | '\u{279C}' => {
            Glyph::Mark(',')
        }
        '\u{2026}' => Glyph::Mark('.'),
        '\u{B0}' | '\u{BA}' => Glyph::Mark('\u{B0}'),
        '\u{D7}' => Glyph::Letter('x'),
        ',' | '.' | ';' | ':' | '!' | '?' | '(' | ')' | '/' | '<' | '>' | '#' | '%' | '&' | '+' => Glyph::Mark(c),
        '[' => Glyph::Mark('('),
        ']' => Glyph::Mark(')'),
        _ if is_invisible(c) => Glyph::Invisible,
        _ if c.is_ascii_digit() => Glyph::Digit(c),
        _ if c.is_alphabetic() => Glyph::Letter(unaccented(c)),
        _ => name_of(c).map_or(Glyph::Space, Glyph::Pictogram),
    }
}

/// The ASCII character of a full-width form; other characters unchanged.
fn ascii_of_full_width(c: char) -> char {
    let code = u32::from(c);
    if (0xFF01..=0xFF5E).contains(&code) { char::from_u32(code - 0xFEE0).unwrap_or(c) } else { c }
}

/// Combining marks, joiners, direction marks, variation selectors, byte order marks.
fn is_invisible(c: char) -> bool {
    matches!(u32::from(c), 0x300..=0x36F | 0x1AB0..=0x1AFF | 0x20D0..=0x20FF | 0x200B..=0x200F | 0x202A..=0x202E
        | 0x2060..=0x2069 | 0xFE00..=0xFE0F | 0xFE20..=0xFE2F | 0xFEFF | 0x61C)
}

/// Lower case without Latin accents.
fn unaccented(c: char) -> char {
    let c = c.to_lowercase().next().unwrap_or(c);
    match c {
        'à'..='å' | 'ā' | 'ă' | 'ą' => 'a',
        'ç' | 'ć' | 'č' => 'c',
        'è'..='ë' | 'ē' | 'ę' | 'ě' => 'e',
        'ì'..='ï' | 'ī' | 'ı' => 'i',
        'ñ' | 'ń' | 'ň' => 'n',
        'ò'..='ö' | 'ø' | 'ō' => 'o',
        'ù'..='ü' | 'ū' | 'ů' => 'u',
        'ý' | 'ÿ' => 'y',
        'ś' | 'š' => 's',
        'ź' | 'ž' | 'ż' => 'z',
        _ => c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pictogram_in_the_place_of_a_noun_is_one() {
        let words = |text: &str| tokenize(text).into_iter().map(|word| word.text).collect::<Vec<_>>().join(" ");
        assert_eq!(words("🎸 ➡️ 🌴 → 💀 in that order"), "guitar , palm , skull in that order");
        assert_eq!(words("🎸 to 💀"), "guitar to skull");
        assert_eq!(words("pan from the 🪑 to the 📺, slowly"), "pan from the chair to the television , slowly");
        assert_eq!(words("🎬 push in on the guitar 🎸🔥!"), "push in on the guitar !");
        assert_eq!(words("🎸 push in on the guitar"), "push in on the guitar");
    }
}
