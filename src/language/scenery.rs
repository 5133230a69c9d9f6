//! Clauses about light, weather and mood: `dust motes drifting upward`, `sunlight sliding over the wall`, `melancholy,
//! lo-fi`. They are about the picture and say nothing to whoever moves the camera, however much they move themselves.

use super::error::LanguageError;
use super::known_words::KnownWords;
use super::mention::Mention;
use super::senses::{Senses, sense_names, senses_of};
use super::tokenizer::{Word, is_listed, span_of, tokenize, word_at};

/// What light, weather and mood consist of.
const SCENERY: [&str; 100] = [
    "light",
    "lights",
    "sunlight",
    "moonlight",
    "daylight",
    "candlelight",
    "lamplight",
    "firelight",
    "starlight",
    "sun",
    "moon",
    "sunbeam",
    "sunbeams",
    "sunset",
    "sunrise",
    "dawn",
    "dusk",
    "twilight",
    "rays",
    "beams",
    "shaft",
    "shafts",
    "glow",
    "shimmer",
    "glare",
    "glint",
    "glints",
    "reflection",
    "reflections",
    "shadow",
    "shadows",
    "dust",
    "motes",
    "mote",
    "particles",
    "pollen",
    "smoke",
    "steam",
    "vapor",
    "vapour",
    "haze",
    "mist",
    "fog",
    "rain",
    "raindrops",
    "drizzle",
    "snow",
    "snowflakes",
    "wind",
    "breeze",
    "draft",
    "air",
    "sky",
    "clouds",
    "cloud",
    "storm",
    "thunder",
    "lightning",
    "embers",
    "ember",
    "sparks",
    "ash",
    "ashes",
    "flame",
    "flames",
    "candlelights",
    "petals",
    "bubbles",
    "confetti",
    "glitter",
    "music",
    "silence",
    "sound",
    "sounds",
    "birdsong",
    "mood",
    "atmosphere",
    "ambience",
    "ambiance",
    "vibe",
    "vibes",
    "tone",
    "tones",
    "palette",
    "color",
    "colors",
    "colour",
    "colours",
    "contrast",
    "texture",
    "textures",
    "bokeh",
    "grain",
    "grade",
    "grading",
    "highlights",
    "hue",
    "hues",
    "warmth",
    "fireflies",
];
/// Weather, and light as a thing in the air: it is no place and no target, wherever it is.
const WEATHER: &str = "rain raindrops drizzle snow snowflakes dust motes mote pollen smoke steam vapor vapour haze mist fog \
    wind thunder lightning sunlight moonlight daylight rays shafts embers sparks confetti glitter fireflies \
    particles glow";
/// What such things and others do by themselves: `flour floating upwards`.
const DRIFTS: &str = "floating drifting swirling rising falling curling dancing spilling settling glowing shimmering \
    flickering fluttering swaying sparkling twinkling streaming pouring billowing melting dripping humming crackling \
    breathing rustling wafting hovering";
/// Words before the name of such a thing that do not belong to another.
const MAX_BEFORE: usize = 5;
/// Words that begin a clause beside a comma.
const OPENERS: [&str; 3] = ["while", "as", "with"];
/// Words that end such a clause: what follows is about something else.
const CLOSERS: [&str; 9] = ["as", "while", "when", "then", "until", "before", "after", "so", "but"];
/// Words after which the thing is only where something is, or a thing to film: `the light on the left`.
const PREPOSITIONS: [&str; 18] = [
    "on", "in", "at", "by", "near", "behind", "above", "below", "under", "beside", "over", "to", "from", "and", "or",
    "is", "with", "between",
];
/// Who films, and what a film is made of: a clause with one of them is about the camera.
const CAMERA: [&str; 21] = [
    "camera",
    "cam",
    "we",
    "i",
    "you",
    "drone",
    "lens",
    "frame",
    "shot",
    "view",
    "viewer",
    "move",
    "movement",
    "speed",
    "motion",
    "follow",
    "follows",
    "following",
    "pan",
    "push",
    "pull",
];
/// Senses of words that tell an operator how it looks and not where to go.
const LOOKS: [&str; 2] = ["effect", "like"];
/// Endings of words of command.
const COMMAND_FORMS: [&str; 4] = ["ing", "wards", "ed", "ly"];
/// Words that say how fast a move is.
const PACES: [&str; 5] = ["slow", "slowly", "fast", "quick", "rapid"];
/// Words that begin the name of a thing, or the way to it.
const BEFORE_NOUNS: [&str; 12] =
    ["the", "a", "an", "this", "that", "its", "to", "into", "through", "towards", "above", "past"];
/// Senses of words that say where to go, or how near or from where to look.
const COMMANDS: [&str; 36] = [
    "in", "out", "left", "right", "up", "down", "around", "past", "through", "over", "under", "go", "turn", "nod",
    "bank", "lens", "sideways", "lift", "circle", "curve", "vertigo", "whip", "follow", "look", "show", "hide", "hold",
    "shake", "visit", "close", "wide", "medium", "high", "low", "topdown", "eyelevel",
];
/// Senses that a word of looks may have besides: `moody` is slow, too.
const SHADES: [&str; 8] = ["slow", "fast", "smooth", "big", "small", "little", "much", "detail"];

/// The bytes of the clauses of a prompt that are about light, weather and mood alone, each with the comma before it. A
/// clause that mentions an object is none of them, unless light falls on it. Nothing of a prompt that says nothing else.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of senses.
pub fn scenery(prompt: &str, mentions: &[Mention]) -> Result<Vec<[usize; 2]>, LanguageError> {
    let words = tokenize(prompt);
    let meaning = Meaning::of(&words)?;
    let is_scenery = |clause: &[usize; 2]| {
        is_about_scenery(&words, &meaning, mentions, *clause)
            || is_drifting(&words, &meaning, mentions, *clause)
            || is_tag(&words, &meaning, mentions, *clause)
    };
    let (out, kept): (Vec<[usize; 2]>, Vec<[usize; 2]>) =
        clauses(prompt, &words, &meaning).into_iter().partition(is_scenery);
    if !kept.iter().any(|clause| (clause[0]..clause[1]).any(|at| meaning.tells(at))) {
        return Ok(Vec::new());
    }
    let bytes_of = |[from, to]: [usize; 2]| {
        let [start, end] = span_of(&words[from..to]);
        let comma = from.checked_sub(1).filter(|before| word_at(&words, *before) == ",");
        [comma.map_or(start, |comma| words[comma].span[0]), end]
    };
    Ok(out.into_iter().map(bytes_of).collect())
}

/// What the words of a prompt tell an operator.
struct Meaning {
    senses: Vec<Senses>,
    looks: Senses,
    hard: Senses,
    commands: Senses,
}

impl Meaning {
    fn of(words: &[Word]) -> Result<Self, LanguageError> {
        let is_hard = |name: &&str| !LOOKS.contains(name) && !SHADES.contains(name);
        let hard: Vec<&str> = sense_names()?.iter().map(String::as_str).filter(is_hard).collect();
        Ok(Self {
            senses: senses_of(words)?,
            looks: Senses::named(&LOOKS)?,
            hard: Senses::named(&hard)?,
            commands: Senses::named(&COMMANDS)?,
        })
    }

    /// Whether a word says where to go, or how near or from where to look.
    fn commands(&self, at: usize) -> bool {
        self.senses[at].overlaps(self.commands)
    }

    /// Whether a word has a sense that is not one of looks.
    fn tells(&self, at: usize) -> bool {
        let senses = self.senses[at];
        if senses.overlaps(self.looks) { senses.overlaps(self.hard) } else { !senses.is_empty() }
    }
}

/// The clauses of a prompt: first word and the word after the last. Marks and words that join clauses end them.
fn clauses(prompt: &str, words: &[Word], meaning: &Meaning) -> Vec<[usize; 2]> {
    let mut clauses = Vec::new();
    let mut start = 0;
    for at in 0..=words.len() {
        let is_line =
            at > 0 && words.get(at).is_some_and(|word| prompt[words[at - 1].span[1]..word.span[0]].contains('\n'));
        let is_mark =
            words.get(at).is_none_or(|word| !word.text.starts_with(char::is_alphanumeric) && !is_inner(&word.text));
        let joins = words
            .get(at)
            .is_some_and(|word| OPENERS.contains(&word.text.as_str()) || CLOSERS.contains(&word.text.as_str()));
        // `Steam rises and tilt up slowly`: what follows is a command.
        let and = matches!(word_at(words, at), "and" | "&" | "+");
        let is_next = |next: usize| next < words.len() && meaning.tells(next);
        let commands = and && (is_next(at + 1) || word_at(words, at + 1).ends_with("ly") && is_next(at + 2));
        if !(is_line || is_mark || joins || commands) {
            continue;
        }
        if at > start {
            clauses.push([start, at]);
        }
        start = if is_mark { at + 1 } else { at };
    }
    clauses
}

/// Whether a mark stands inside clauses: those of placeholders, numbers and words.
fn is_inner(mark: &str) -> bool {
    matches!(mark, "<" | ">" | "-" | "'" | "\u{2019}" | "#" | "%" | "\u{b0}" | "&" | "+") || mark.starts_with('\'')
}

/// Whether the subject of a clause is scenery: `golden hour light spilling through the window`.
fn is_about_scenery(words: &[Word], meaning: &Meaning, mentions: &[Mention], [from, to]: [usize; 2]) -> bool {
    let named = |at: usize| mention_at(words, mentions, at).is_some_and(|mention| !mention.ids.is_empty());
    // `Golden hour` is light.
    let is_hour = |at: usize| {
        word_at(words, at) == "hour" && at > 0 && matches!(word_at(words, at - 1), "golden" | "blue" | "magic")
    };
    let is_head = |at: &usize| (SCENERY.contains(&word_at(words, *at)) || is_hour(*at)) && !named(*at);
    // What is the whole of a part of a list is its picture.
    let is_part = from > 0 && matches!(word_at(words, from - 1), ":" | "|");
    // `Then dust on the shelf` is a part of a list.
    if matches!(word_at(words, from), "then" | "next" | "finally") {
        return false;
    }
    let from = from + usize::from(OPENERS.contains(&word_at(words, from)));
    let Some(head) = (from..to.min(from + MAX_BEFORE + 1)).find(is_head).filter(|_| !is_part) else { return false };
    let head = (head..to).take_while(is_head).last().unwrap_or(head);
    // Of the words before it none asks for anything: `rise above the haze`, `low-angle mood`, `fast tone`.
    let asks = |at: usize| {
        // `Floating dust` is no float, `chasing the sunlight` a chase.
        let is_attribute = word_at(words, at).ends_with("ing") && !BEFORE_NOUNS.contains(&word_at(words, at + 1));
        named(at) || !is_attribute && (meaning.commands(at) || PACES.contains(&word_at(words, at)))
    };
    let next = if head + 1 < to { word_at(words, head + 1) } else { "" };
    let is_verb = ["ing", "s", "ed"].iter().any(|ending| next.ends_with(ending));
    // `Light tilt up`, `wind-blown drift`: the light is one of a move.
    let is_weather = is_listed(WEATHER, word_at(words, head));
    let is_placed = PREPOSITIONS.contains(&next);
    let is_free = next.is_empty() || is_verb || is_weather && is_placed;
    let is_of_move = !is_free && (head + 1..to).any(|at| meaning.tells(at));
    let is_of_camera = (from..to).any(|at| CAMERA.contains(&word_at(words, at)));
    let has_number = (from..to).any(|at| word_at(words, at).starts_with(|c: char| c.is_ascii_digit()));
    let num_named = (from..to).filter(|at| named(*at) && (*at == from || !named(at - 1))).count();
    // `Rain on the glass` beside what is filmed.
    let names_elsewhere = || {
        let inside = |mention: &&Mention| (from..to).any(|at| words[at].span[0] == mention.bytes[0]);
        mentions.iter().filter(|mention| !mention.ids.is_empty()).any(|mention| !inside(&mention))
    };
    !((from..head).any(asks) || is_of_move || is_of_camera || has_number || is_placed && !is_weather)
        && (num_named == 0 || num_named == 1 && (is_verb || is_weather && is_placed && names_elsewhere()))
}

/// Whether a clause is about something that drifts by itself: `flour floating upwards`, `ribbons swaying in the breeze`.
fn is_drifting(words: &[Word], meaning: &Meaning, mentions: &[Mention], [from, to]: [usize; 2]) -> bool {
    let Some(verb) = (from + 1..to.min(from + 4)).find(|at| is_listed(DRIFTS, word_at(words, *at))) else {
        return false;
    };
    // What drifts has a name that no command has.
    let is_plain = |at: usize| {
        let word = word_at(words, at);
        meaning.senses[at].is_empty() && !word.ends_with("ly") && !KnownWords::embedded().contains(word)
    };
    let is_of_camera = (from..to).any(|at| CAMERA.contains(&word_at(words, at)));
    let is_named = (from..to).any(|at| mention_at(words, mentions, at).is_some_and(|mention| !mention.ids.is_empty()));
    is_plain(verb - 1) && !(from..verb).any(|at| meaning.commands(at)) && !is_of_camera && !is_named
}

/// Whether a clause only says how it looks: none of its words tells an operator anything.
fn is_tag(words: &[Word], meaning: &Meaning, mentions: &[Mention], [from, to]: [usize; 2]) -> bool {
    let looks = (from..to).any(|at| meaning.senses[at].overlaps(meaning.looks));
    // A word alone may be one that the list of senses lacks: `unhurried`, `centred`.
    let is_command = |word: &str| {
        KnownWords::embedded().contains(word)
            || COMMAND_FORMS.iter().any(|ending| word.ends_with(ending))
            || word.starts_with("un")
    };
    (looks || to - from > 1 || !is_command(word_at(words, from)))
        && (from..to).all(|at| {
            let word = &words[at].text;
            // Single letters are shorthand: `R to L`.
            let is_letter = word.len() == 1 && word != "a";
            let has_digit = word.contains(|c: char| c.is_ascii_digit());
            !(meaning.tells(at) || is_letter || has_digit) && mention_at(words, mentions, at).is_none()
        })
}

/// The mention that a word belongs to.
fn mention_at<'a>(words: &[Word], mentions: &'a [Mention], at: usize) -> Option<&'a Mention> {
    let start = words[at].span[0];
    mentions.iter().find(|mention| (mention.bytes[0]..mention.bytes[1]).contains(&start))
}
