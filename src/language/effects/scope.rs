//! What the words around a phrase make of it: whether it is forbidden, and how much of it is asked for.

use cinesplat_lens::Degree;

use super::phrase::Found;
use super::table::{Table, WordKind};
use crate::lexicon::Lexicon;
use crate::tokenizer::{Word, word_at};

/// Words before a phrase among which its degree is looked for.
const DEGREE_REACH: usize = 4;
/// Words between a phrase and the word behind it that forbids it.
const AFTER_REACH: usize = 6;
/// Words that a negation covers although no list names them: `no cheesy eighties grain`.
const MAX_STRANGERS: usize = 2;
/// Words that join what one negation covers.
const JOINTS: [&str; 5] = ["or", "nor", "and", ",", "/"];

/// What a negation covers.
#[derive(Debug, Clone, Copy)]
struct Scope {
    /// The word that it began with.
    start: usize,
    /// Number of words since then that no list names.
    strangers: usize,
}

impl Scope {
    fn from(start: usize) -> Self {
        Self { start, strangers: 0 }
    }
}

/// The words of a prompt and the phrases in them.
#[derive(Clone, Copy)]
pub(super) struct Context<'a> {
    pub(super) table: &'a Table,
    pub(super) prompt: &'a str,
    pub(super) words: &'a [Word],
    pub(super) phrases: &'a [Found<'a>],
}

/// Whether each phrase is forbidden by the words around it.
pub(super) fn forbidden(context: Context<'_>) -> Vec<bool> {
    let Context { words, phrases, .. } = context;
    let mut result = vec![false; phrases.len()];
    let mut scope: Option<Scope> = None;
    let mut at = 0;
    while at < words.len() {
        if let Some(idx) = phrases.iter().position(|found| found.start == at && !found.spans) {
            at = phrases[idx].end();
            let dismissal = context.dismissal_after(&phrases[idx], scope.is_some());
            result[idx] |= scope.is_some() ^ dismissal.is_some() ^ phrases[idx].is_negated;
            if dismissal.is_some() && scope.is_none() {
                context.forbid_list_before(idx, &mut result);
            }
            at += dismissal.unwrap_or_default();
            scope = scope.filter(|scope| context.goes_on(at, scope.start));
            continue;
        }
        // A phrase whose words stand apart begins inside what covers it: `don't let the focus start on A and end on B`.
        if let Some(idx) = phrases.iter().position(|found| found.start == at && found.spans) {
            result[idx] |= scope.is_some() != phrases[idx].is_negated;
        }
        scope = context.next_scope(at, scope);
        at += 1;
    }
    result
}

impl Context<'_> {
    fn word(&self, at: usize) -> &str {
        word_at(self.words, at)
    }

    fn lists(&self, kind: WordKind, at: usize) -> bool {
        self.table.lists(kind, self.word(at))
    }

    fn phrase_from(&self, at: usize) -> Option<&Found<'_>> {
        self.phrases.iter().find(|found| found.start == at)
    }

    /// What covers the words after word `at`.
    fn next_scope(&self, at: usize, scope: Option<Scope>) -> Option<Scope> {
        let word = self.word(at);
        let follows = |k: usize| self.word(at + k);
        match word {
            // `no, wait`; `not only`; `no more than a touch of`; `not just`.
            "no" | "not" | "never" if matches!(follows(1), "," | "." | "only" | "just" | "!" | "longer") => None,
            "no" if follows(1) == "more" && follows(2) == "than" => None,
            "zero" if matches!(follows(1), "point" | "s" | "sec" | "second" | "seconds" | "degree" | "degrees") => None,
            "instead" | "rather" if matches!(follows(1), "of" | "than") => Some(Scope::from(at)),
            "free" | "clean" | "clear" | "devoid" if matches!(follows(1), "of" | "from") => Some(Scope::from(at)),
            // `take off over the sofa` is a start.
            "take" if follows(1) == "off" && matches!(follows(2), "with" | "from" | "over" | "toward" | "towards") => {
                None
            }
            "turn" | "turned" | "switch" | "leave" | "take" if matches!(follows(1), "off" | "out") => {
                Some(Scope::from(at))
            }
            // `keep out of the fog` is a path.
            "keep" | "filter" | "edit" if follows(1) == "out" && follows(2) != "of" => Some(Scope::from(at)),
            "enough" | "sick" | "tired" if follows(1) == "of" => Some(Scope::from(at)),
            "spare" if matches!(follows(1), "me" | "us") => Some(Scope::from(at)),
            "away" if follows(1) == "with" && at > 0 && matches!(self.word(at - 1), "do" | "doing" | "done") => {
                Some(Scope::from(at))
            }
            // `can't wait to see`, `without a doubt`.
            "wait" | "doubt" | "help" => None,
            "get" | "getting" if follows(1) == "rid" => Some(Scope::from(at)),
            "of" | "than" | "from" | "off" | "out" | "rid" if scope.is_some() => scope,
            _ if scope.is_some() && self.lists(WordKind::TakesBack, at) => None,
            _ if scope.is_some() && self.lists(WordKind::Moderates, at) => None,
            _ if self.lists(WordKind::Negation, at) || word == "'t" && follows(1) != "get" => Some(Scope::from(at)),
            _ if self.lists(WordKind::Closes, at) => None,
            _ => self.covered(at, scope?),
        }
    }

    /// What goes on behind word `at` of all that a negation covers.
    fn covered(&self, at: usize, scope: Scope) -> Option<Scope> {
        let word = self.word(at);
        let is_degree = self.lists(WordKind::Slight, at) || self.lists(WordKind::Strong, at);
        if is_degree || word.starts_with('\'') {
            return Some(scope);
        }
        if self.lists(WordKind::Filler, at) || JOINTS.contains(&word) {
            return (scope.strangers == 0 || !matches!(word, "with" | "for" | "and" | ",")).then_some(scope);
        }
        // `no zoom, motion blur on the pan`: what is ruled out is the move.
        if names_shot(word) {
            return None;
        }
        let strangers = scope.strangers + 1;
        (word.starts_with(char::is_alphanumeric) && strangers <= MAX_STRANGERS).then_some(Scope { strangers, ..scope })
    }

    /// Whether a negation that covered a phrase goes on behind it: `no grain, vignette or flares`, `without fog and
    /// haze`.
    fn goes_on(&self, end: usize, start: usize) -> bool {
        match self.word(end) {
            "or" | "nor" | "/" => true,
            // `no blur and shallow focus` asks for focus; `without blur and grain` forbids both.
            "and" => self.word(start) != "no" && self.next_phrase(end + 1).is_some(),
            "," => self.next_phrase(end + 1).is_some_and(|found| {
                // Only a list that ends in a joint is one.
                let is_last = |joint: &str| matches!(joint, "or" | "nor") || joint == "and" && self.word(start) != "no";
                is_last(self.word(end + 1))
                    || is_last(self.word(found.end()))
                    || self.word(found.end()) == "," && self.goes_on(found.end(), start)
            }),
            _ => false,
        }
    }

    /// The phrase from a word on, after a joint and articles.
    fn next_phrase(&self, from: usize) -> Option<&Found<'_>> {
        let is_between = |at: &usize| {
            matches!(self.word(*at), "or" | "nor" | "and" | "the" | "a" | "an" | "any" | "of" | "no")
                || self.lists(WordKind::Slight, *at)
                || self.lists(WordKind::Strong, *at)
        };
        let begins = |at: usize| self.phrase_from(at);
        let num = (from..from + 3).take_while(|at| begins(*at).is_none() && is_between(at)).count();
        begins(from + num)
    }

    /// Forbids the phrases of a list whose last one is forbidden: `distortion and vignetting removed`.
    fn forbid_list_before(&self, last: usize, result: &mut [bool]) {
        for idx in (0..last).rev() {
            let between = self.phrases[idx].end()..self.phrases[idx + 1].start;
            let is_joint = |at: usize| matches!(self.word(at), "and" | "or" | "nor" | "/" | "the" | "any" | ",");
            let is_comma = between.len() == 1 && self.word(between.start) == ",";
            if between.is_empty() || !between.clone().all(is_joint) || is_comma && idx + 1 == last {
                return;
            }
            result[idx] = true;
        }
    }

    /// The number of words right behind a phrase that do nothing but forbid it, if words behind it do: `grain has to
    /// go`, `grain off`. Behind a phrase that a negation covers, only those that take the negation back.
    fn dismissal_after(&self, found: &Found<'_>, is_covered: bool) -> Option<usize> {
        let text = self.table.text(self.prompt, self.words)?;
        let dismissals = self.table.dismissals().iter().filter(|dismissal| !is_covered || dismissal.takes_back());
        let dismissal = dismissals.filter_map(|dismissal| dismissal.len_after(text, found)).max();
        dismissal.or_else(|| self.is_forbidden_after(found.end()).then_some(0))
    }

    /// Whether the words after a phrase forbid it: `grain off`, `blur-free`, `motion blur: none`, `grain is added in
    /// post`.
    fn is_forbidden_after(&self, end: usize) -> bool {
        let between = (end..end + AFTER_REACH).take_while(|at| self.lists(WordKind::Between, *at)).count();
        let at = end + between;
        let (first, second) = (self.word(at), self.word(at + 1));
        // `flares off the window` come from there.
        let is_origin =
            matches!(first, "off" | "free") && matches!(second, "the" | "a" | "an" | "of" | "its" | "that" | "every");
        let is_done = |at: usize| matches!(self.word(at), "done" | "added" | "add" | "applied");
        // `added later in the shot` is later in the film.
        let is_delayed = matches!(first, "later" | "afterwards" | "afterward")
            && !matches!(second, "in" | "on")
            && (end..at).any(is_done);
        !is_origin && self.lists(WordKind::ForbidsBefore, at)
            || first == "not" && matches!(second, "wanted" | "needed" | "necessary" | "allowed" | "desired" | "wished")
            || self.lists(WordKind::Elsewhere, at) && (end..at).any(|at| self.word(at) == "in")
            || is_delayed
    }
}

/// Whether a word belongs to the language of shots and moves.
fn names_shot(word: &str) -> bool {
    Lexicon::embedded().is_ok_and(|lexicon| lexicon.is_shot_language(word))
}

/// How much of an effect the words before its phrase, or the first word of it, ask for.
pub(super) fn degree_of(table: &Table, words: &[Word], found: &Found<'_>, phrases: &[Found<'_>]) -> Degree {
    let is_other = |at: usize| phrases.iter().any(|other| other.start <= at && at < other.start + other.len);
    let first = found.start.saturating_sub(DEGREE_REACH);
    let before = (first..found.start).rev().take_while(|&at| {
        !is_other(at) && word_at(words, at).chars().all(char::is_alphanumeric) && !JOINTS.contains(&word_at(words, at))
    });
    let inside = found.start..found.start + found.len;
    for at in before.chain(inside) {
        let word = word_at(words, at);
        if table.lists(WordKind::Slight, word) || word == "too" && at < found.start {
            return Degree::Slight;
        }
        // `not too much`.
        let is_moderate = at > 0 && table.lists(WordKind::Moderates, word_at(words, at - 1));
        if table.lists(WordKind::Strong, word) {
            return if is_moderate { Degree::Slight } else { Degree::Strong };
        }
    }
    Degree::Medium
}
