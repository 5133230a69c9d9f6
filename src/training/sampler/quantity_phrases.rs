//! Quantities phrased in words: the inverse of finding them in a prompt.

use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

use cinesplat_language::number_word;

/// Placeholder of a quantity in a template, such as `{SECS}`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::EnumString)]
#[strum(serialize_all = "UPPERCASE")]
pub(crate) enum QuantityPlaceholder {
    /// Duration of a step.
    Secs,
    /// Duration of the film.
    Secs0,
    /// Duration of the film before a noun: `a 10-second shot`.
    SecsAdj,
    /// Angle.
    Deg,
    /// Length.
    Units,
    /// Factor below 1 on the distance.
    Nearer,
    /// Factor above 1 on the distance.
    Farther,
    /// Factor on the focal length.
    Lens,
}

/// A quantity in words and as a token of the notation of programs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct QuantityPhrase {
    pub(crate) words: String,
    pub(crate) meaning: String,
}

impl QuantityPlaceholder {
    /// A random value in random words.
    pub(crate) fn phrase(self, rng: &mut Pcg64) -> QuantityPhrase {
        let (words, meaning) = match self {
            Self::Secs => seconds(rng, "dur"),
            Self::Secs0 => seconds(rng, "total"),
            Self::SecsAdj => seconds_before_noun(rng),
            Self::Deg => degrees(rng),
            Self::Units => units(rng),
            Self::Nearer => factor(rng, &NEARER),
            Self::Farther => factor(rng, &FARTHER),
            Self::Lens => factor(rng, &LENS),
        };
        QuantityPhrase { words, meaning }
    }
}

/// A number of hundredths in digits. Hundredths have the same value in the text and in the program.
fn decimal(hundredths: u32) -> String {
    format!("{}", f64::from(hundredths) / 100.0)
}

/// A duration as the notation token `key=`.
fn seconds(rng: &mut Pcg64, key: &str) -> (String, String) {
    let phrases: [(&str, f64); 9] = [
        ("half a second", 0.5),
        ("a second", 1.0),
        ("one second", 1.0),
        ("a couple of seconds", 2.0),
        ("a few seconds", 3.0),
        ("one and a half seconds", 1.5),
        ("two and a half seconds", 2.5),
        ("half a minute", 30.0),
        ("a minute", 60.0),
    ];
    if rng.random_bool(0.12)
        && let Some((words, value)) = phrases.choose(rng)
    {
        return ((*words).to_owned(), format!("{key}={value}s"));
    }
    let hundredths =
        if rng.random_bool(0.2) { rng.random_range(5..120u32) * 10 } else { rng.random_range(1..21u32) * 100 };
    let whole = hundredths / 100;
    let number = match number_word(whole) {
        Some(word) if hundredths % 100 == 0 && rng.random_bool(0.4) => word.to_owned(),
        _ => decimal(hundredths),
    };
    let spelled = number.starts_with(char::is_alphabetic);
    let one = hundredths == 100;
    let unit = match rng.random_range(0..10) {
        0 if !spelled => "s",
        1 if !spelled => " s",
        2 if !spelled => " sec",
        3 if !spelled => " secs",
        _ if one => " second",
        _ => " seconds",
    };
    (format!("{number}{unit}"), format!("{key}={}s", decimal(hundredths)))
}

fn seconds_before_noun(rng: &mut Pcg64) -> (String, String) {
    let value = rng.random_range(2..21u32);
    let number = match number_word(value) {
        Some(word) if rng.random_bool(0.4) => word.to_owned(),
        _ => value.to_string(),
    };
    let unit = if number.starts_with(char::is_alphabetic) {
        ["-second", " second"].choose(rng)
    } else {
        ["-second", " second", " sec", "s", " seconds", "-sec"].choose(rng)
    };
    (format!("{number}{}", unit.copied().unwrap_or(" second")), format!("total={value}s"))
}

fn degrees(rng: &mut Pcg64) -> (String, String) {
    let phrases: [(&str, u32); 23] = [
        ("a quarter turn", 90),
        ("a quarter circle", 90),
        ("a quarter of a turn", 90),
        ("a quarter of a circle", 90),
        ("quarter turn", 90),
        ("a half turn", 180),
        ("half a turn", 180),
        ("half a circle", 180),
        ("a half circle", 180),
        ("half circle", 180),
        ("a semicircle", 180),
        ("halfway around", 180),
        ("three quarters of a turn", 270),
        ("three quarters of a circle", 270),
        ("a full circle", 360),
        ("a full turn", 360),
        ("full circle", 360),
        ("a complete circle", 360),
        ("one full turn", 360),
        ("a full revolution", 360),
        ("once around", 360),
        ("one and a half turns", 540),
        ("two full turns", 720),
    ];
    if rng.random_bool(0.25)
        && let Some((words, value)) = phrases.choose(rng)
    {
        return ((*words).to_owned(), format!("amount={value}deg"));
    }
    if rng.random_bool(0.08) {
        let value = [45u32, 60, 90, 120, 180, 270, 360].choose(rng).copied().unwrap_or(90);
        return (value.to_string(), format!("amount={value}deg"));
    }
    let value = if rng.random_bool(0.75) { rng.random_range(1..37u32) * 10 } else { rng.random_range(1..73u32) * 5 };
    let spelled = [
        (45, "forty-five"),
        (30, "thirty"),
        (60, "sixty"),
        (90, "ninety"),
        (180, "a hundred and eighty"),
        (20, "twenty"),
    ];
    let word = spelled.iter().find(|(v, _)| *v == value).map(|(_, w)| *w).filter(|_| rng.random_bool(0.3));
    let number = word.map_or_else(|| value.to_string(), str::to_owned);
    let unit = match rng.random_range(0..8) {
        0 | 1 if word.is_none() => "\u{B0}",
        2 => " deg",
        3 => "-degrees",
        _ => " degrees",
    };
    (format!("{number}{unit}"), format!("amount={value}deg"))
}

fn units(rng: &mut Pcg64) -> (String, String) {
    let phrases: [(&str, f64); 6] = [
        ("half a meter", 0.5),
        ("a meter", 1.0),
        ("a metre", 1.0),
        ("one meter", 1.0),
        ("a couple of meters", 2.0),
        ("one and a half meters", 1.5),
    ];
    if rng.random_bool(0.2)
        && let Some((words, value)) = phrases.choose(rng)
    {
        return ((*words).to_owned(), format!("amount={value}u"));
    }
    if rng.random_bool(0.15) {
        let value = rng.random_range(1..20u32) * 10;
        let unit = ["cm", " cm", " centimeters"].choose(rng).copied().unwrap_or("cm");
        return (format!("{value}{unit}"), format!("amount={}u", f64::from(value) * 0.01));
    }
    if rng.random_bool(0.12) {
        let value = rng.random_range(2..12u32);
        let unit = [" feet", "ft", " ft"].choose(rng).copied().unwrap_or(" feet");
        return (format!("{value}{unit}"), format!("amount={}u", f64::from(value) * 0.3048));
    }
    let whole = rng.random_bool(0.6);
    let hundredths = if whole { rng.random_range(2..9u32) * 100 } else { rng.random_range(2..60u32) * 10 };
    let number = match number_word(hundredths / 100) {
        Some(word) if whole && rng.random_bool(0.5) => word.to_owned(),
        _ => decimal(hundredths),
    };
    let unit = [" meters", " meters", " metres", " units", " m"].choose(rng).copied().unwrap_or(" meters");
    (format!("{number}{unit}"), format!("amount={}u", decimal(hundredths)))
}

const NEARER: [(&str, f64); 14] = [
    ("to half the distance", 0.5),
    ("half the distance", 0.5),
    ("halfway", 0.5),
    ("half way", 0.5),
    ("half the way", 0.5),
    ("until we are twice as close", 0.5),
    ("twice as close", 0.5),
    ("two times closer", 0.5),
    ("three times closer", 1.0 / 3.0),
    ("a third of the way", 2.0 / 3.0),
    ("two thirds of the way", 1.0 - 2.0 / 3.0),
    ("three quarters of the way", 0.25),
    ("by a factor of 0.5", 0.5),
    ("until it is twice as big", 0.5),
];
const FARTHER: [(&str, f64); 10] = [
    ("to twice the distance", 2.0),
    ("to double the distance", 2.0),
    ("twice as far", 2.0),
    ("twice as far away", 2.0),
    ("three times as far", 3.0),
    ("to three times the distance", 3.0),
    ("by a factor of 2", 2.0),
    ("by a factor of three", 3.0),
    ("until it is half as big", 2.0),
    ("until it is half the size", 2.0),
];
const LENS: [(&str, f64); 7] = [
    ("2x", 2.0),
    ("by 2x", 2.0),
    ("by a factor of 2", 2.0),
    ("3x", 3.0),
    ("by 1.5x", 1.5),
    ("by a factor of three", 3.0),
    ("4x", 4.0),
];

fn factor(rng: &mut Pcg64, phrases: &[(&str, f64)]) -> (String, String) {
    phrases
        .choose(rng)
        .map_or_else(Default::default, |(words, value)| ((*words).to_owned(), format!("amount={value}x")))
}
