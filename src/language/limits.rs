//! Limits for the camera of the whole film: `never closer than half a metre`, `stay below 1.4 m`, `at most 0.3 m/s`.
//!
//! Enters: a linked prompt. Leaves: its limits, and the words without them: to the network they are amounts of moves.

use cinesplat_operator::{Level, Limit};

use super::error::LanguageError;
use super::heights::SpokenHeight;
use super::linked::Linked;
use super::quantity::QuantityKind;
use super::rates::Rate;
use super::tokenizer::is_listed;

/// Words that deny what follows, and words between them and what is denied.
const DENIES: &str = "'t never not no without don't dont n't cannot can't avoid mustn't shouldn't nor neither";
const DENIED: &str = "ever get gets getting go goes going come comes coming be being is move moves moving let the camera cam lens it \
    rig drone robot rise rises rising climb climbs climbing drop drops dropping dip dips dipping sink sinks sinking fly flies flying \
    allowed to travel travels travelling traveling turn turns turning pan pans panning rotate rotating any approach approaching do \
    even at time point";
/// Words by which something holds throughout, and words between them and what holds.
const KEEPS: &str = "stay stays staying keep keeps keeping remain remains remaining maintain maintains maintaining leave leaving hold \
    holding always must with";
const KEPT: &str = "the camera cam lens it rig drone robot always at all times a an it's its itself yourself well safe safety \
    distance gap clearance of be stay keep remain altitude height";
/// What bounds are called.
const LEAST: &str = "min minimum least smallest minimal";
const MOST: &str = "max maximum most top largest highest maximal peak";
const DISTANCES: &str = "distance clearance standoff gap separation margin range dist";
const HEIGHTS: &str = "height altitude level h alt";
const SPEEDS: &str = "speed velocity rate pace turn rotation angular linear pan yaw";
/// Words between what is bounded and its value.
const LINKS: &str = "of is = : - the to be at <= >= < > ≤ ≥ than from";
/// Words between `at least` and a length, and between a length and what it is from.
const LINKS_OF_LEAST: &str = "a distance clearance gap of about";
const AWAY: &str = "of away back off clear distance clearance";
/// Any matter.
const ANYTHING: &str = "anything everything objects object obstacles obstacle furniture walls wall surfaces surface things geometry \
    something stuff";
/// Words before those.
const ARTICLES: &str = "the any all a an its surrounding nearest every";
/// Words behind a limit that say that it holds throughout.
const ALWAYS: [&[&str]; 12] = [
    &["at", "any", "point"],
    &["at", "any", "time"],
    &["at", "all", "times"],
    &["at", "any", "moment"],
    &["the", "whole", "time"],
    &["the", "whole", "way"],
    &["the", "entire", "time"],
    &["all", "the", "time"],
    &["all", "the", "way"],
    &["all", "along"],
    &["throughout"],
    &["always"],
];
/// Words before a limit that join it to what else is said.
const JOINS: &str = ", and but while whilst so or ; ( - at do don must should can";
/// How far from a thing somebody stays who does not go near it, meters.
const BERTH_METERS: f64 = 0.5;
/// Height of a person's eyes, meters.
const EYE_METERS: f64 = 1.6;

impl Linked {
    /// The prompt without the words that limit the camera for the whole film, and with these limits.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] for a damaged list of heights.
    pub fn without_limits(self) -> Result<Self, LanguageError> {
        let heights = self.spoken_heights()?;
        let words: Vec<(&str, [usize; 2])> = self.words_in([0, usize::MAX]).collect();
        let reader = Reader {
            linked: &self,
            texts: words.iter().map(|(word, _)| *word).collect(),
            spans: words.iter().map(|(_, span)| *span).collect(),
            rates: self.rates(),
            heights,
        };
        let (mut limits, mut bytes, mut named, mut at) = (Vec::new(), Vec::new(), None, 0);
        while at < words.len() {
            let Some((end, found)) = reader.limit_at(at) else {
                at += 1;
                continue;
            };
            let from = (0..at).rev().take_while(|before| is_listed(JOINS, reader.text(*before))).last().unwrap_or(at);
            bytes.push([words[from].1[0], words[end - 1].1[1]]);
            // `Stay a metre from the vase and go round it`.
            named = words[at..end].iter().rev().find_map(|(word, _)| self.slot_at(word)).or(named);
            limits.extend(found);
            at = end;
        }
        if limits.is_empty() {
            return Ok(self);
        }
        limits.sort_by_key(Limit::rank);
        let rest = self.without(&bytes, named);
        Ok(Self { limits, acts: self.acts, scenery: self.scenery, warnings: self.warnings, ..rest })
    }
}

/// The words of a prompt, with what their numbers mean.
struct Reader<'a> {
    linked: &'a Linked,
    texts: Vec<&'a str>,
    spans: Vec<[usize; 2]>,
    rates: Vec<Rate>,
    heights: Vec<([usize; 2], SpokenHeight)>,
}

/// A limit that begins at a word: the word behind it, and what it limits.
type Found = (usize, Vec<Limit>);

impl Reader<'_> {
    fn text(&self, at: usize) -> &str {
        self.texts.get(at).copied().unwrap_or_default()
    }

    /// The first word from `at` on that is not in a list.
    fn after(&self, at: usize, list: &str) -> usize {
        at + (at..self.texts.len()).take_while(|at| is_listed(list, self.text(*at))).count()
    }

    fn limit_at(&self, at: usize) -> Option<Found> {
        let found = if is_listed(DENIES, self.text(at)) {
            self.denied(self.after(at + 1, DENIED))
        } else if is_listed(KEEPS, self.text(at)) {
            self.kept(self.after(at + 1, KEPT))
        } else {
            self.named(at)
        };
        found.map(|(end, limits)| (self.past_always(end), limits))
    }

    /// `closer than 0.5 m to it`, `above 1.4 m`, `faster than 0.3 m/s`, behind a negation.
    fn denied(&self, at: usize) -> Option<Found> {
        let than = |at: usize| self.after(at + 1, "than to");
        match self.text(at) {
            "closer" | "nearer" | "within" | "inside" => Some(self.clear(self.distance(than(at))?)),
            "farther" | "further" | "more" => {
                let (end, units) = self.distance(than(at))?;
                let (end, ids) = self.things(self.after(end, "away"))?;
                withins(end, units, &ids)
            }
            // `Not over the table but past it` is a way.
            "over" | "past" => self.below(than(at)).filter(is_of_matter),
            "above" | "higher" => self.below(than(at)),
            "below" | "under" | "beneath" | "underneath" | "lower" | "less" => {
                let from = than(at);
                // `Stand-off never below half a metre from the jar`.
                let away = self.distance(from).and_then(|(end, units)| {
                    let is_away = matches!(self.text(end), "from" | "to") && self.floor(end).is_none();
                    let (end, ids) = self.things(end).filter(|_| is_away)?;
                    Some((end, clears(&ids, units)))
                });
                // `Not under the table but past it` is a way, `no less than a metre` how far.
                let is_way = matches!(self.text(at), "under" | "beneath" | "underneath");
                let is_height = |found: &Found| self.text(at) != "less" && (!is_way || is_of_matter(found));
                away.or_else(|| self.above(from).filter(is_height))
            }
            "faster" | "quicker" | "exceed" | "exceeding" => self.speed(than(at)),
            "anywhere" | "near" => {
                let near = self.after(at, "anywhere near");
                let says = (at..near).any(|word| self.text(word) == "near");
                let (end, ids) = self.things(near).filter(|_| says)?;
                (!ids.is_empty()).then(|| (end, clears(&ids, BERTH_METERS)))
            }
            _ => None,
        }
    }

    /// `below 1.4 m`, `at least 50 cm from everything`, behind a word that says that it holds.
    fn kept(&self, at: usize) -> Option<Found> {
        match self.text(at) {
            "below" | "under" | "beneath" | "lower" => {
                let from = self.after(at + 1, "than");
                self.below(from).filter(is_of_matter).or_else(|| self.speed(from))
            }
            // `Hold above the table` is where the camera is for a while.
            "above" | "higher" => self.above(self.after(at + 1, "than")).filter(is_of_matter),
            "within" => {
                let (end, units) = self.distance(at + 1)?;
                let (end, ids) = self.things(end)?;
                withins(end, units, &ids)
            }
            "least" | "minimum" | "min" => self.at_least(self.after(at + 1, LINKS_OF_LEAST)),
            "clear" => {
                let (end, ids) = self.things(at + 1)?;
                let by = self.distance(self.after(end, "by at least a minimum of"));
                let (end, units) = by.unwrap_or((end, BERTH_METERS));
                (by.is_some() || !ids.is_empty()).then(|| (end, clears(&ids, units)))
            }
            "between" => {
                let (end, limits) = self.between(at + 1)?;
                Some((self.floor(end)?, limits))
            }
            // `Keep 50 cm away from everything`; from a thing it is how far the camera is.
            _ => {
                let (end, units) = self.distance(at)?;
                let (end, ids) = self.things(self.after(end, AWAY))?;
                ids.is_empty().then(|| (end, clears(&ids, units)))
            }
        }
    }

    /// `At least 50 cm from the vase`, `at least a metre above the floor`.
    fn at_least(&self, at: usize) -> Option<Found> {
        let (end, units) = self.distance(at)?;
        if let Some(end) = self.floor(end) {
            return Some((end, vec![Limit::Above(Level::Units(units))]));
        }
        let (end, ids) = self.things(self.after(end, AWAY))?;
        Some((end, clears(&ids, units)))
    }

    /// `Minimum clearance 0.4 m`, `max height 1.5 m`, `speed limit 0.3 m/s`, `at most 0.3 m/s`.
    fn named(&self, at: usize) -> Option<Found> {
        let first = self.text(at);
        let next = self.text(at + 1);
        if is_listed(LEAST, first) || is_listed(MOST, first) {
            let is_least = is_listed(LEAST, first);
            let begins = at.checked_sub(1).is_some_and(|before| self.text(before) == "at");
            let what =
                self.after(at + 1, "safe safety camera cam allowed permitted travel linear angular pan yaw turn");
            let name = self.text(what);
            let behind = self.after(what + 1, "limit");
            if is_least && is_listed(DISTANCES, name) {
                return self.distanced(behind);
            }
            if is_listed(HEIGHTS, name) {
                let behind = self.after(behind, LINKS);
                return if is_least { self.above(behind) } else { self.below(behind) };
            }
            if !is_least && is_listed(SPEEDS, name) {
                return self.speed(self.after(behind, LINKS));
            }
            return match (begins, is_least) {
                (true, true) => self.at_least(at + 1).filter(is_of_matter),
                (true, false) => self.speed(at + 1),
                (false, _) => None,
            };
        }
        match (first, next) {
            ("speed" | "velocity", next) if is_listed("limit cap capped limited < <= ≤ under below", next) => {
                self.speed(self.after(at + 2, LINKS))
            }
            ("height" | "altitude", "limit" | "cap" | "capped" | "limited") => self.below(self.after(at + 2, LINKS)),
            ("height" | "altitude", "between") => {
                let (end, limits) = self.between(at + 2)?;
                Some((self.floor(end).unwrap_or(end), limits))
            }
            ("clearance" | "standoff", _) => self.distanced(at + 1),
            _ => None,
        }
    }

    /// The value and the things of a least distance, in either order: `0.4 m to the vase`, `to the vase 0.4 m`.
    fn distanced(&self, at: usize) -> Option<Found> {
        let at = self.after(at, LINKS);
        if let Some((end, units)) = self.distance(at) {
            let things = self.things(end);
            let (end, ids) = things.unwrap_or((end, Vec::new()));
            return Some((end, clears(&ids, units)));
        }
        let (end, ids) = self.things(at)?;
        let (end, units) = self.distance(self.after(end, LINKS))?;
        Some((end, clears(&ids, units)))
    }

    /// `1.2 and 1.5 m`: two heights that the camera stays between.
    fn between(&self, at: usize) -> Option<Found> {
        let (end, low) = self.distance(at)?;
        let (end, high) = self.distance(self.after(end, "and to -"))?;
        (low < high).then(|| (end, vec![Limit::Above(Level::Units(low)), Limit::Below(Level::Units(high))]))
    }

    /// Nothing, or the things that a distance is from.
    fn clear(&self, (end, units): (usize, f64)) -> Found {
        let (end, ids) = self.things(self.after(end, "away")).unwrap_or_else(|| (end, self.last_thing(end)));
        (end, clears(&ids, units))
    }

    fn below(&self, at: usize) -> Option<Found> {
        let (end, level) = self.level(at)?;
        Some((end, vec![Limit::Below(level)]))
    }

    fn above(&self, at: usize) -> Option<Found> {
        let (end, level) = self.level(at)?;
        Some((end, vec![Limit::Above(level)]))
    }

    fn speed(&self, at: usize) -> Option<Found> {
        let at = self.after(at, "a an about roughly speed of");
        let begin = self.spans.get(at)?[0];
        let Rate { kind, per_sec, bytes } = *self.rates.iter().find(|rate| rate.bytes[0] == begin)?;
        let end = (at..self.texts.len()).find(|word| self.spans[*word][0] >= bytes[1]).unwrap_or(self.texts.len());
        let limit = if kind == QuantityKind::Degrees { Limit::TurnSpeed(per_sec) } else { Limit::Speed(per_sec) };
        Some((end, vec![limit]))
    }

    /// A height: a length, one that people name, or a thing's.
    fn level(&self, at: usize) -> Option<(usize, Level)> {
        let from = self.after(at, "the a an about roughly around height level of");
        if let Some((end, units)) = self.distance(at) {
            let end = self.after(end, "high height up tall");
            return Some((self.floor(end).unwrap_or(end), Level::Units(units)));
        }
        if self.text(from) == "eye" && is_listed("level height line", self.text(from + 1)) {
            return Some((from + 2, Level::Units(EYE_METERS)));
        }
        let spoken = self.heights.iter().find(|([start, end], _)| (*start..*end).contains(&from));
        if let Some(([_, end], SpokenHeight::Meters(meters))) = spoken {
            return Some((*end, Level::Units(*meters)));
        }
        let thing = self.after(from, "top upper tops edge surface of the");
        let id = *self.linked.expanded(&[self.linked.slot_at(self.text(thing))?]).first()?;
        Some((self.after(thing + 1, "'s top tops surface edge height level"), Level::Object(id)))
    }

    /// A length at a word.
    fn distance(&self, at: usize) -> Option<(usize, f64)> {
        let at = self.after(at, "a an about roughly around minimum of least at");
        let quantity = self.linked.quantity_at(self.text(at))?;
        (quantity.kind == QuantityKind::Units).then_some((at + 1, quantity.value))
    }

    /// `Above the floor`: the word behind it.
    fn floor(&self, at: usize) -> Option<usize> {
        let place = self.after(at, "above off over from clear of the up");
        let is_floor = is_listed("floor ground floorboards carpet floors", self.text(place)) && place > at;
        is_floor.then_some(place + 1)
    }

    /// `To the vase`, `from anything`: the word behind it, and the things, none for any matter.
    fn things(&self, at: usize) -> Option<(usize, Vec<u32>)> {
        let from = self.after(at, "to from of off away");
        let word = self.after(from, ARTICLES);
        if from > at && is_listed(ANYTHING, self.text(word)) {
            return Some((word + 1, Vec::new()));
        }
        if is_listed("it them", self.text(from)) && from > at {
            return Some((from + 1, self.last_thing(from)));
        }
        let (mut end, mut slots) = (from, Vec::new());
        while let Some(id) = self.linked.slot_at(self.text(end)) {
            slots.push(id);
            let next = self.after(end + 1, ", and or");
            let goes_on = next > end + 1 && self.linked.slot_at(self.text(next)).is_some();
            end = if goes_on { next } else { end + 1 };
        }
        (!slots.is_empty()).then(|| (end, self.linked.expanded(&slots)))
    }

    /// The last thing before a word.
    fn last_thing(&self, at: usize) -> Vec<u32> {
        let last = (0..at).rev().find_map(|at| self.linked.slot_at(self.text(at)));
        self.linked.expanded(&last.into_iter().collect::<Vec<_>>())
    }

    fn past_always(&self, end: usize) -> usize {
        let rest = self.texts.get(end..).unwrap_or_default();
        end + ALWAYS.iter().find(|always| rest.starts_with(always)).map_or(0, |always| always.len())
    }
}

/// Whether limits are about heights or any matter: `at least 50 cm from the vase` is how far away somebody stands.
fn is_of_matter((_, limits): &Found) -> bool {
    limits.iter().all(|limit| limit.object().is_none())
}

/// The largest distance to some things, where there are any.
fn withins(end: usize, units: f64, ids: &[u32]) -> Option<Found> {
    (!ids.is_empty()).then(|| (end, ids.iter().map(|id| Limit::Within(*id, units)).collect()))
}

/// The least distance to some things, or to any matter.
fn clears(ids: &[u32], units: f64) -> Vec<Limit> {
    if ids.is_empty() {
        return vec![Limit::Clear(None, units)];
    }
    ids.iter().map(|id| Limit::Clear(Some(*id), units)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::linked;
    use crate::quantity::Quantity;

    fn read(text: &str) -> Linked {
        let quantity = Quantity { kind: QuantityKind::Units, value: 0.5 };
        Linked { quantities: vec![quantity; 3], ..linked(text) }.without_limits().unwrap()
    }

    fn limits(text: &str) -> Vec<Limit> {
        read(text).limits
    }

    #[test]
    fn distances_are_limited() {
        let near = Limit::Clear(Some(5), 0.5);
        let linked = read("push in on <obj-0> , never closer than <qty-0> .");
        assert_eq!((linked.tokens_text.as_str(), &linked.limits[..]), ("push in on <obj-0> .", &[near][..]));
        assert_eq!(limits("orbit <obj-0> but do not come within <qty-0> of <obj-1>"), [Limit::Clear(Some(7), 0.5)]);
        let linked = read("stay at least <qty-0> from <obj-0> and go round it");
        assert_eq!((linked.tokens_text.as_str(), &linked.limits[..]), ("and go round <obj-0>", &[near][..]));
        let any = Limit::Clear(None, 0.5);
        assert_eq!(limits("circle <obj-0> , keep at least <qty-0> away from everything"), [any]);
        assert_eq!(limits("circle <obj-0> , minimum clearance <qty-0>"), [any]);
        assert_eq!(limits("minimum distance to <obj-0> : <qty-0> , circle it"), [near]);
        assert_eq!(limits("standoff never below <qty-0> from <obj-0>"), [near]);
        assert_eq!(limits("circle <obj-0> and stay well clear of <obj-1>"), [Limit::Clear(Some(7), BERTH_METERS)]);
        assert_eq!(limits("rise , do not go anywhere near <obj-0>"), [Limit::Clear(Some(5), BERTH_METERS)]);
        assert_eq!(limits("circle <obj-0> , staying within <qty-0> of it"), [Limit::Within(5, 0.5)]);
    }

    #[test]
    fn heights_are_limited() {
        let below = Limit::Below(Level::Units(0.5));
        assert_eq!(limits("track along <obj-0> , not above <qty-0>"), [below]);
        assert_eq!(limits("track along <obj-0> staying below <qty-0> throughout"), [below]);
        assert_eq!(limits("track along <obj-0> , max height <qty-0>"), [below]);
        assert_eq!(limits("rise by <obj-0> but never higher than <obj-1>"), [Limit::Below(Level::Object(7))]);
        assert_eq!(limits("sink by <obj-0> , never lower than waist height"), [Limit::Above(Level::Units(1.0))]);
        assert_eq!(
            limits("sink by <obj-0> , keep at least <qty-0> above the floor"),
            [Limit::Above(Level::Units(0.5))]
        );
    }

    #[test]
    fn speeds_are_limited() {
        assert_eq!(limits("track along <obj-0> , never faster than 0.3 m / s"), [Limit::Speed(0.3)]);
        assert_eq!(limits("pan to <obj-0> , max turn rate 20 deg / s"), [Limit::TurnSpeed(20.0)]);
        assert_eq!(limits("go to <obj-0> at most 0.3 m / s"), [Limit::Speed(0.3)]);
    }

    #[test]
    fn amounts_and_places_are_no_limits() {
        for text in [
            "push in <qty-0> closer to <obj-0>",
            "stay below <obj-0>",
            "rise <qty-0> above <obj-0>",
            "keep <qty-0> away from <obj-0>",
            "no zoom , go over <obj-0>",
            "hold above <obj-0> for a while",
            "go to <obj-0> but not too close to it",
            "rise no less than <qty-0>",
            "not over <obj-0> but past it",
        ] {
            assert_eq!(limits(text), [], "{text}");
        }
    }
}
