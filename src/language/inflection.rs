//! English word forms: inflected verbs, their bases, singular nouns.

/// Form of a verb.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VerbForm {
    /// `push`.
    Base,
    /// `pushes`.
    ThirdPerson,
    /// `pushing`.
    Gerund,
}

/// Verbs that double their last letter before `-ing`.
const DOUBLED: [&str; 24] = [
    "pan", "zip", "whip", "cut", "get", "begin", "stop", "drop", "dip", "spin", "put", "sit", "run", "step", "slip",
    "snap", "tip", "skim", "jog", "let", "nod", "set", "blur", "fog",
];

/// Least letters of the base of an inflected word.
const MIN_BASE: usize = 2;

/// The base form `verb` in another form; of a hyphenated verb (`dolly-zoom`) the last word is inflected.
///
/// # Example
/// ```
/// use cinesplat_language::{VerbForm, inflect};
///
/// assert_eq!(inflect("push", VerbForm::ThirdPerson), "pushes");
/// assert_eq!(inflect("whip-pan", VerbForm::Gerund), "whip-panning");
/// ```
pub fn inflect(verb: &str, form: VerbForm) -> String {
    let (front, last) = verb.rsplit_once('-').map_or(("", verb), |(front, last)| (front, last));
    let dash = if front.is_empty() { "" } else { "-" };
    let inflected = match form {
        VerbForm::Base => last.to_owned(),
        VerbForm::ThirdPerson => third_person(last),
        VerbForm::Gerund => gerund(last),
    };
    format!("{front}{dash}{inflected}")
}

fn third_person(verb: &str) -> String {
    match verb {
        "have" => return "has".to_owned(),
        "be" => return "is".to_owned(),
        _ => {}
    }
    let sibilant = ["s", "x", "z", "ch", "sh", "o"].iter().any(|ending| verb.ends_with(ending));
    if sibilant {
        return format!("{verb}es");
    }
    match verb.strip_suffix('y') {
        Some(base) if !base.ends_with(['a', 'e', 'o', 'u']) => format!("{base}ies"),
        _ => format!("{verb}s"),
    }
}

fn gerund(verb: &str) -> String {
    if DOUBLED.contains(&verb) {
        let last = verb.chars().last().unwrap_or_default();
        return format!("{verb}{last}ing");
    }
    match verb.strip_suffix('e') {
        Some(base) if !base.ends_with(['e', 'o', 'y']) && base.len() > 1 => format!("{base}ing"),
        _ => format!("{verb}ing"),
    }
}

/// A word and the words that its endings make: `blur`, `blurs`, `blurring`, `blurred`, `blurry`.
pub(crate) fn forms(base: &str) -> Vec<String> {
    let gerund = gerund(base);
    let root = gerund.strip_suffix("ing").unwrap_or(base);
    let ended = ["ed", "y", "ier", "iness"].map(|ending| format!("{root}{ending}"));
    [base.to_owned(), third_person(base), gerund.clone()].into_iter().chain(ended).collect()
}

/// The singular of an English noun, by its ending. Equal words always have equal stems; the stem of another word
/// need not be a word.
pub fn stem(word: &str) -> String {
    let count = word.chars().count();
    if let Some(base) = word.strip_suffix("ies").filter(|_| count > 4) {
        return format!("{base}y");
    }
    if let Some(base) = word.strip_suffix("lves") {
        return format!("{base}lf");
    }
    if word == "knives" || word == "knife" {
        return "knife".to_owned();
    }
    for ending in ["sses", "xes", "ches", "shes"] {
        if word.ends_with(ending) {
            return word.strip_suffix("es").unwrap_or(word).to_owned();
        }
    }
    match word.strip_suffix('s') {
        Some(base) if count > 3 && !base.ends_with('s') && !base.ends_with('u') => base.to_owned(),
        _ => word.to_owned(),
    }
}

/// Words that a word may be a form of, the likeliest first: `gliding` of `glide`, `hops` of `hop`, `panned` of `pan`.
pub(crate) fn bases(word: &str) -> Vec<String> {
    let mut bases = Vec::new();
    if !word.is_ascii() {
        return bases;
    }
    if let Some(base) = word.strip_suffix('s').filter(|base| !base.ends_with(['s', 'u'])) {
        bases.push(base.to_owned());
        bases.extend(base.strip_suffix('e').map(str::to_owned));
        bases.extend(base.strip_suffix("ie").map(|base| format!("{base}y")));
    }
    for ending in ["ing", "ed", "er", "in"] {
        let Some(base) = word.strip_suffix(ending) else { continue };
        let mut letters = base.chars().rev();
        let is_doubled = letters.next().is_some_and(|last| letters.next() == Some(last));
        let undoubled = is_doubled.then(|| base[..base.len() - 1].to_owned());
        bases.extend([Some(base.to_owned()), Some(format!("{base}e")), undoubled].into_iter().flatten());
        bases.extend(base.strip_suffix('i').map(|base| format!("{base}y")));
    }
    bases.retain(|base| base.len() >= MIN_BASE);
    bases
}
