//! What a message wants seen, in order.

use std::ops::Range;

use cinesplat_language::{Linked, add_ids, is_listed};

use super::super::directions::says_any;
use super::text::{Text, is_object};
use super::things::Things;

/// What is seen at a place of the film.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Subject {
    /// Things.
    Things(Vec<u32>),
    /// All of the place.
    Place,
    /// What is seen from a thing: `what the telly sees`; from the height of a standing person where the words say so.
    From { eye: Vec<u32>, seen: Vec<u32>, stands: bool },
}

/// Where a station is in the film.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    First,
    Between,
    Last,
}

/// A picture that a message wants.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Station {
    pub(super) subject: Subject,
    pub(super) is_close: bool,
    pub(super) rank: Rank,
    /// The camera rests there.
    pub(super) rests: bool,
    /// The camera goes a little way round it.
    pub(super) is_circled: bool,
    /// The words about it.
    pub(super) words: Range<usize>,
}

impl Station {
    /// A station of nothing, where a film begins.
    pub(super) fn nothing() -> Self {
        Self {
            subject: Subject::Place,
            is_close: false,
            rank: Rank::First,
            rests: false,
            is_circled: false,
            words: 0..0,
        }
    }
}

/// Words that a sentence about what is to be seen has, and one that only tells why does not.
const WISHES: &str = "first then next after begin start open end finish last finally leave see sees show shown visit look give meet \
    take include includes want wants wish admire notice clues clue heroes hero stars star points plus obviously especially \
    important answer compare until only each every please understand starting ending please remember find count ask love";
/// Words of what is sold: of a group each one is shown, and then all.
pub(super) const WARES: &str = "shop store product products brand sale selling sell auction lot lots bidders bidder bestseller catalogue \
    catalog webshop customer customers buyer buyers";
/// Words that show the things of a group one after the other.
const IN_TURN: [&[&str]; 14] = [
    &["one", "then", "the", "other"],
    &["one", ",", "then", "the", "other"],
    &["first", "one", ","],
    &["after", "the", "other"],
    &["after", "another"],
    &["one", "by", "one"],
    &["at", "each"],
    &["on", "each"],
    &["each", "one"],
    &["each", "of"],
    &["every", "one"],
    &["in", "turn"],
    &["individually"],
    &["same", "treatment"],
];
/// Words that show a thing close.
const CLOSE: &str = "close closely closer near nearer tight tightly detail details clue clues macro big huge fills amongst nose homely intimate";
/// Words between a thing and one that is seen with it.
const WITH: &str = "with plus beside";
const ARTICLES: &str = "both all the a an its his her their my our your some";
/// Words before a thing that only say where another one is, and before them.
const WHERE: &str = "on in near against by behind under above at from for";
/// Words of a place, and of all of it.
const PLACES: &str =
    "room place kitchen studio lot space scene bedroom lounge flat house shop workshop office thing everything world";
const WHOLE: &str = "whole entire full complete all everything";
/// Verbs of what something sees.
const SEES: &str = "sees see looks watches faces would 's is";
const STANDS: &str = "standing stood stand stands entering arriving looking";
/// Verbs of what somebody does somewhere, and what he does it at.
const DEEDS: [(&str, &str); 6] = [
    ("sit sits sitting seat seats seating pedestal", "chair stool armchair sofa couch bench"),
    ("sleep sleeps sleeping bed", "bed"),
    ("hang hangs clothes clothing", "wardrobe"),
    ("cook cooks cooking", "stove"),
    ("eat eats eating dine", "dining"),
    ("work works working paint paints painting write writes writing", "easel desk workbench"),
];

/// What the words want seen, in order, without what is `denied`.
pub(super) fn stations(text: &Text<'_>, linked: &Linked, things: &Things<'_>, denied: &[u32]) -> Vec<Station> {
    let of_wishes = stations_of(text, linked, things, (denied, true));
    // What a story names is seen, too, where little else is.
    if of_wishes.len() > 1 { of_wishes } else { stations_of(text, linked, things, (denied, false)) }
}

/// The same, of the sentences that wish for something only, or of all.
fn stations_of(
    text: &Text<'_>,
    linked: &Linked,
    things: &Things<'_>,
    (denied, wishes_only): (&[u32], bool),
) -> Vec<Station> {
    let mut found =
        Found { text, linked, things, stations: Vec::new(), last: None, is_last_open: false, is_with_open: false };
    let is_wish = |at: usize| text.has(text.sentence(at), WISHES) || text.has(text.sentence(at), WARES);
    let slots = || (0..text.words.len()).filter(|at| is_object(text.words[*at]) && !text.is_likeness(*at));
    let have_wishes = wishes_only && slots().any(is_wish);
    for at in 0..text.words.len() {
        if text.is_likeness(at) {
            continue;
        }
        if found.is_place(at) {
            found.add(at, Subject::Place);
        }
        if let Some(ids) = found.deed(at) {
            found.add(at, Subject::Things(ids));
            found.last = Some(at);
        }
        let Some(id) = linked.slot_at(text.words[at]).filter(|id| linked.missing(*id).is_none()) else { continue };
        let ids: Vec<u32> = linked.expanded(&[id]).into_iter().filter(|id| !denied.contains(id)).collect();
        if ids.is_empty() || have_wishes && !is_wish(at) || found.last.is_some_and(|last| found.is_deed_of(last, at)) {
            continue;
        }
        found.take(at, ids);
    }
    let mut stations = found.stations;
    fill_between(text, things, &mut stations);
    if let Some(anchor) = split_anchor(text, linked, things, &stations) {
        stations = anchor;
    }
    stations.sort_by_key(|station| station.rank);
    stations
}

/// Visits what stands near the first thing on the way to the last one, where the words show it `little by little`.
fn fill_between(text: &Text<'_>, things: &Things<'_>, stations: &mut Vec<Station>) {
    let says = text.words.windows(3).any(|three| matches!(three, ["little" | "bit", "by", "little" | "bit"]));
    let [first, last] = &stations[..] else { return };
    let (Subject::Things(ids), Subject::Things(ends), true) = (&first.subject, &last.subject, says) else { return };
    let between = things.on_the_way(ids[0], ends[0]);
    let new = between.into_iter().map(|id| Station {
        subject: Subject::Things(vec![id]),
        rank: Rank::Between,
        ..first.clone()
    });
    let new: Vec<Station> = new.collect();
    stations.splice(1..1, new);
}

/// The stations, with a group that is visited thing by thing from where the words start: `the three easels one after the other,
/// starting with the one at the window`.
fn split_anchor(text: &Text<'_>, linked: &Linked, things: &Things<'_>, stations: &[Station]) -> Option<Vec<Station>> {
    let is_turn = says_any(&text.words, &IN_TURN);
    let sells = text.has(0..text.words.len(), WARES);
    let nth = stations
        .iter()
        .position(|station| matches!(&station.subject, Subject::Things(ids) if ids.len() > 1 && group(linked, ids)))?;
    let Subject::Things(ids) = &stations[nth].subject else { return None };
    if !(is_turn || sells && things.are_small(ids)) || ids.len() > 6 {
        return None;
    }
    let start = text.words.iter().position(|word| matches!(*word, "starting" | "beginning" | "start" | "begin"));
    let anchor = start.and_then(|start| text.words[start..].iter().take(6).find_map(|word| linked.slot_at(word)));
    let anchor = anchor.and_then(|id| linked.expanded(&[id]).first().copied());
    let each = things
        .in_turn(ids, anchor)
        .into_iter()
        .map(|id| Station { subject: Subject::Things(vec![id]), ..stations[nth].clone() });
    let is_anchor = |station: &Station| matches!(&station.subject, Subject::Things(own) if anchor.is_some_and(|anchor| own.contains(&anchor) && !ids.contains(&anchor)));
    let is_whole_group =
        |station: &Station| matches!(&station.subject, Subject::Things(own) if own.iter().all(|id| ids.contains(id)));
    let mut out: Vec<Station> = stations.to_vec();
    let mut all = out.remove(nth);
    out.retain(|station| !is_anchor(station) && !is_whole_group(station));
    let at = nth.min(out.len());
    out.splice(at..at, each);
    if sells {
        // What is sold is seen together at last.
        if let Subject::Things(shown) = &mut all.subject {
            for station in &out {
                if let Subject::Things(own) = &station.subject {
                    add_ids(shown, own);
                }
            }
        }
        all.rank = Rank::Last;
        out.push(all);
    }
    Some(out)
}

/// Whether one mention names some things.
fn group(linked: &Linked, ids: &[u32]) -> bool {
    linked.groups.iter().any(|group| ids.iter().all(|id| group.members.contains(id)))
}

/// The stations that are found so far.
struct Found<'a> {
    text: &'a Text<'a>,
    linked: &'a Linked,
    things: &'a Things<'a>,
    stations: Vec<Station>,
    /// The word of what was found last.
    last: Option<usize>,
    is_last_open: bool,
    is_with_open: bool,
}

impl Found<'_> {
    /// Takes a thing that is mentioned at a word.
    fn take(&mut self, at: usize, ids: Vec<u32>) {
        let (text, words) = (self.text, &self.text.words);
        let plain = |nth: &usize| !is_listed(ARTICLES, words[*nth]);
        let before = (0..at).rev().find(plain);
        let before_word = before.map_or("", |nth| words[nth]);
        let sentence = text.sentence(at);
        let last = self.last.filter(|last| sentence.contains(last));
        let between = last.map_or(&[][..], |last| &words[last + 1..at]);
        let next = words.get(at + 1).copied().unwrap_or_default();
        // `The canvas taking two thirds of the frame`, `until it fills the screen`.
        let is_size = is_listed("taking takes filling fills covering", next)
            && !self.stations.is_empty()
            && words[at..].iter().take(6).any(|word| self.linked.is_quantity(word));
        let fills = words[..at].iter().rev().take(4).any(|word| is_listed("fills fill filling", word));
        if is_size || fills && !self.stations.is_empty() || before_word == "or" && last.is_some() {
            return;
        }
        if before_word == "what" && is_listed(SEES, next) || self.stands_at(at) {
            let stands = text.has(sentence, STANDS);
            self.add(at, Subject::From { eye: ids, seen: Vec::new(), stands });
            self.last = Some(at);
            return;
        }
        if let Some(Station { subject: Subject::From { seen, stands: false, .. }, .. }) = self.stations.last_mut()
            && last.is_some()
        {
            seen.extend(ids.into_iter().filter(|id| !seen.contains(id)).collect::<Vec<_>>());
            self.last = Some(at);
            return;
        }
        let ids =
            self.of_group(before_word == "of" && before.is_some_and(|nth| nth > 0 && words[nth - 1] == "one"), ids);
        // `It stands on the shelf` only says where something is.
        let is_where = last.is_some()
            && is_listed(WHERE, before_word)
            && !text.closes(at)
            && (!between.iter().any(|word| is_listed("then and , to up", word))
                || between.iter().any(|word| is_listed("it they which", word)));
        if is_where || before_word == "for" {
            return;
        }
        let behind = text.behind(at);
        let verb = before.and_then(|nth| nth.checked_sub(1)).map_or("", |nth| words[nth]);
        let is_end =
            is_listed("start starting begin beginning end ending finish finishing them us people everyone", verb);
        let is_with = last.is_some()
            && (is_listed(WITH, before_word) && !is_end
                || words[behind.clone()].starts_with(&["next", "to", "it"])
                || words[behind.clone()].starts_with(&["beside", "it"]));
        let is_listed_on = between.iter().all(|word| is_listed("and , & the a", word));
        let is_separate = text.has(sentence.clone(), CLOSE) || between.contains(&",");
        if let Some(Station { subject: Subject::Things(shown), .. }) = self.stations.last_mut()
            && last.is_some()
            && !ids.iter().any(|id| shown.contains(id))
            && (is_with
                || is_listed_on && !is_separate && (self.is_with_open || self.things.are_one_picture(shown, &ids)))
        {
            let beside = self.things.beside(shown, &ids);
            shown.extend(beside);
            self.is_with_open = true;
            self.last = Some(at);
            return;
        }
        self.is_with_open = false;
        let (opens, closes) = (text.opens(at), text.closes(at));
        let known = self.stations.iter().position(
            |station| matches!(&station.subject, Subject::Things(own) if ids.iter().all(|id| own.contains(id))),
        );
        if let Some(nth) = known {
            // Named again where the words say when it is seen.
            if opens || closes {
                let mut again = self.stations.remove(nth);
                again.rank = if closes { Rank::Last } else { Rank::First };
                again.is_close |= self.is_close(at);
                self.stations.push(again);
            }
            self.last = Some(at);
            return;
        }
        self.add(at, Subject::Things(ids));
        self.last = Some(at);
    }

    /// Of the things of one mention those that are one picture.
    fn of_group(&self, is_one: bool, ids: Vec<u32>) -> Vec<u32> {
        if ids.len() < 2 {
            return ids;
        }
        if is_one {
            let last = self.stations.iter().rev().find_map(|station| match &station.subject {
                Subject::Things(shown) => shown.first().copied(),
                _ => None,
            });
            let one = last.and_then(|last| self.things.nearest(&ids, last)).or(ids.first().copied());
            return one.into_iter().collect();
        }
        self.things.together(&ids)
    }

    /// Whether somebody stands at a thing and looks from there: `by the door, like I'm standing there looking in`.
    fn stands_at(&self, at: usize) -> bool {
        let behind = self.text.slice(self.text.behind(at));
        let stands = behind.iter().any(|word| is_listed("standing stood stand", word));
        let looks = behind
            .windows(2)
            .any(|two| is_listed("looking look looks", two[0]) && is_listed("in into back round around", two[1]));
        stands && looks
    }

    /// Adds a station that is mentioned at a word.
    fn add(&mut self, at: usize, subject: Subject) {
        let text = self.text;
        let is_last_before = self.last.is_some_and(|last| text.sentence(at).contains(&last)) && self.is_last_open;
        let leads_on = text.has(text.before(at), "then");
        let rank = match (text.closes(at), text.opens(at)) {
            (true, _) => Rank::Last,
            (_, true) if !self.stations.iter().any(|station| station.rank == Rank::First) => Rank::First,
            _ if is_last_before && !leads_on => Rank::Last,
            _ => Rank::Between,
        };
        self.is_last_open = rank == Rank::Last;
        let is_small = matches!(&subject, Subject::Things(ids) if self.things.are_small(ids));
        let is_close = self.is_close(at) || is_small && self.is_clue(at);
        let rests = text.has(text.behind(at), "stop pause rest hold linger wait stay");
        let is_circled = text
            .slice(self.told_behind(at))
            .windows(2)
            .any(|two| is_listed("around round", two[0]) && is_listed("it him her them", two[1]));
        let words = text.before(at).start..text.behind(at).end;
        self.stations.push(Station { subject, is_close, rank, rests, is_circled, words });
    }

    /// Whether the words show a thing close.
    fn is_close(&self, at: usize) -> bool {
        let words = &self.text.words;
        // `See how big it is`, `can I close the curtains`.
        let is_size = |nth: usize| {
            let next = words.get(nth + 1).copied().unwrap_or_default();
            let is_verb = words[nth] == "close" && is_object(next);
            nth > 0 && matches!(words[nth - 1], "how" | "so" | "too" | "not") || next == "enough" || is_verb
        };
        let mut near = self.text.before(at).chain(self.text.behind(at)).chain(self.told_behind(at));
        let says = near.any(|nth| is_listed(CLOSE, words[nth]) && !is_size(nth));
        let small = self.text.opens(at) && self.text.has(self.text.before(at), "small tiny little");
        says || small
    }

    /// The words of the next sentence where it speaks of a thing by a pronoun only: `the globe! And then we are really near at it`.
    fn told_behind(&self, at: usize) -> Range<usize> {
        let own = self.text.sentence(at);
        let is_last = !self.text.words[at + 1..own.end].iter().any(|word| is_object(word));
        let next = self.text.sentence(own.end);
        let words = self.text.slice(next.clone());
        let is_about = words.iter().take(10).any(|word| is_listed("it him her them", word));
        let names = words.iter().any(|word| is_object(word));
        if is_last && is_about && !names { next } else { own.end..own.end }
    }

    /// Whether a thing is in a list of clues, or of what is seen up close.
    fn is_clue(&self, at: usize) -> bool {
        let words = &self.text.words;
        let start = self.text.sentence(at).start;
        let mut list = (start..at).rev().take_while(|nth| !matches!(words[*nth], "then" | "finally"));
        list.any(|nth| words[nth] == "close" && nth > 0 && words[nth - 1] == "up" || words[nth] == "clues")
    }

    /// Whether a word stands for all of the place: `the whole room`, `end wide`.
    fn is_place(&self, at: usize) -> bool {
        let words = &self.text.words;
        let is_whole = is_listed(PLACES, words[at])
            && words[..at].iter().rev().take(2).any(|word| is_listed(WHOLE, word))
            && !self.stations.iter().any(|station| station.subject == Subject::Place);
        let is_rest = words[at] == "room" && words[..at].ends_with(&["rest", "of", "the"]);
        // `Then realise how large the room is`.
        let is_large = is_listed(PLACES, words[at])
            && matches!(
                words[..at],
                [.., "how", "large" | "big" | "small" | "bright" | "empty", "the" | "this" | "our"]
            );
        let is_wide = is_rest || is_large || is_listed("wide wider", words[at]) && self.text.closes(at);
        is_whole || is_wide && !self.stations.iter().any(|station| station.subject == Subject::Place)
    }

    /// The things at which somebody does what the words say: `where she's going to sit and work`, `where do I hang my clothes`.
    fn deed(&self, at: usize) -> Option<Vec<u32>> {
        if self.text.words[at] != "where" {
            return None;
        }
        let end = self.text.sentence(at).end;
        let clause: Vec<&str> =
            self.text.words[at..end].iter().take_while(|word| !matches!(**word, "," | "then")).copied().collect();
        let says = |deeds: &str| clause.iter().any(|word| is_listed(deeds, word));
        let named: Vec<u32> = clause.iter().filter_map(|word| self.linked.slot_at(word)).collect();
        let named = self.linked.expanded(&named);
        let found: Vec<Vec<u32>> =
            DEEDS.iter().filter(|(deeds, _)| says(deeds)).map(|(_, kinds)| self.things.labelled(kinds)).collect();
        match &found[..] {
            [seats, places, ..] => Some(self.things.nearest_pair(seats, places)?.to_vec()),
            [seats] if !named.is_empty() && clause.iter().any(|word| is_listed("sit pedestal", word)) => {
                let places = [self.things.labelled("easel desk workbench"), named].concat();
                Some(self.things.nearest_pair(seats, &places)?.to_vec())
            }
            [things] if named.is_empty() && !things.is_empty() => Some(self.things.together(things)),
            _ => None,
        }
    }

    /// Whether a thing is named in the clause of a deed, which has its own.
    fn is_deed_of(&self, deed: usize, at: usize) -> bool {
        let words = &self.text.words;
        words[deed] == "where" && self.text.sentence(at).contains(&deed) && !words[deed..at].contains(&",")
    }
}
