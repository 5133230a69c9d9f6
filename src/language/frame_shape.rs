//! The shape of the frame where a prompt states it: `portrait`, `vertical video`, `9:16`, `square`.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::blanks::{blank, unless_empty};
use super::names::NamedObject;
use super::tokenizer::{Word, span_of, tokenize};

/// A stated shape of the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameShape {
    /// Width and height, in the smallest whole numbers.
    pub ratio: [u32; 2],
    /// Bytes of the prompt that state it.
    pub bytes: [usize; 2],
}

/// Ratios that people write as numbers, and the shapes that platforms and formats have.
const RATIOS: [[u32; 2]; 7] = [[9, 16], [16, 9], [4, 5], [1, 1], [3, 4], [4, 3], [2, 3]];
const UPRIGHT: [&str; 5] = ["tiktok", "reels", "reel", "shorts", "stories"];
/// Words that make `portrait`, `vertical` and `square` a shape of the frame, and others that make them something else.
const FILM: [&str; 16] = [
    "video",
    "film",
    "format",
    "frame",
    "framing",
    "clip",
    "orientation",
    "aspect",
    "mode",
    "crop",
    "picture",
    "still",
    "shot",
    "close",
    "cut",
    "version",
];
/// Words before a shape that go with it.
const PREPOSITIONS: [&str; 4] = [" for", " in", " as", " on"];
const ARTICLES: [&str; 10] = ["the", "this", "that", "his", "her", "their", "its", "each", "every", "my"];

/// The first shape that a prompt states. Words in the name of an object (`portrait of a lady`) state none.
pub fn frame_shape(prompt: &str, objects: &[NamedObject]) -> Option<FrameShape> {
    let words = tokenize(prompt);
    let names: BTreeSet<String> =
        objects.iter().flat_map(|object| tokenize(&object.label)).map(|word| word.text).collect();
    (0..words.len()).find_map(|at| {
        let (len, ratio) = stated_at(&words, at, &names)?;
        Some(FrameShape { ratio, bytes: span_of(&words[at..at + len]) })
    })
}

/// The prompt without the words that state shapes of the frame: blanks stand for them, so that every other byte stays where
/// it is. A prompt that states nothing else stays as it is.
pub fn without_frame_shape<'a>(prompt: &'a str, objects: &[NamedObject]) -> Cow<'a, str> {
    let mut blanked = Cow::Borrowed(prompt);
    while let Some(shape) = frame_shape(&blanked, objects) {
        let [start, end] = shape.bytes;
        // `portrait: ..` and `.. for tiktok` lose their mark and preposition.
        let end = end + usize::from(blanked[end..].starts_with([':', ',']));
        let before = blanked[..start].trim_end();
        let start = PREPOSITIONS.iter().find_map(|word| before.strip_suffix(word)).map_or(start, str::len);
        blank(&mut blanked, [start, end]);
    }
    unless_empty(blanked, prompt)
}

impl FrameShape {
    /// Pixels of a frame of this shape whose shorter side is `side_px`; even numbers.
    pub fn size_px(self, side_px: u32) -> [u32; 2] {
        let short = self.ratio[0].min(self.ratio[1]).max(1);
        self.ratio.map(|side| (side_px * side / short) & !1)
    }
}

/// Number of words from word `at` on that state a shape, and the ratio.
fn stated_at(words: &[Word], at: usize, names: &BTreeSet<String>) -> Option<(usize, [u32; 2])> {
    let text = |i: usize| words.get(i).map_or("", |word| word.text.as_str());
    let before = if at == 0 { "" } else { text(at - 1) };
    let (word, next) = (text(at), text(at + 1));
    if word.starts_with(|c: char| c.is_ascii_digit()) && matches!(next, ":" | "x") {
        let ratio = [word, text(at + 2)].map(|number| number.parse::<u32>().unwrap_or(0));
        // `at 1:1` and `0:01` are no ratios where a longer clock goes on.
        let is_clock = matches!(before, ":" | "-" | "at")
            || text(at + 3) == ":"
            || text(at + 2).len() != ratio[1].to_string().len();
        return (RATIOS.contains(&ratio) && !is_clock).then_some((3, ratio));
    }
    if names.contains(word) {
        return None;
    }
    let stands_alone = at == 0 && matches!(next, "," | ":" | "." | "-" | "");
    // `.., 8 seconds tops, portrait.`
    let ends_list =
        at > 0 && matches!(before, "," | ".") && matches!(next, "." | "!" | "" | "please" | "pls" | "thanks");
    let stands_alone = stands_alone || ends_list;
    let of_film = FILM.contains(&next) && !ARTICLES.contains(&before);
    match word {
        "portrait" if (stands_alone || of_film) && text(at + 2) != "lens" && next != "mode" => Some((1, [9, 16])),
        "vertical" if stands_alone || (of_film && !matches!(next, "shot" | "cut" | "close")) => Some((1, [9, 16])),
        "square" if ends_list => Some((1, [1, 1])),
        "square" if of_film && !matches!(next, "picture" | "frame" | "shot" | "close" | "cut") => Some((1, [1, 1])),
        "landscape" if matches!(next, "video" | "format" | "orientation") => Some((1, [16, 9])),
        word if UPRIGHT.contains(&word)
            && matches!(before, "for" | "a" | "on" | "tiktok" | "instagram" | "insta" | "youtube") =>
        {
            Some((1, [9, 16]))
        }
        _ => None,
    }
}
