//! What a clause says of a picture: its subjects, how much of each is seen, place, height, lens, and where the camera is.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_operator::{Framing, Lens, Step};
use cinesplat_trajectory::Move;

use super::clauses::Clause;
use super::words::{OUT, ROOM, SEEN, WHOLE, angle, has_opposite_places, place, size};

/// A described picture.
#[derive(Debug, Clone, Default)]
pub(super) struct Picture {
    /// What is stated of it.
    pub(super) framing: Framing,
    /// Things that are out of it while others are in it.
    pub(super) gone: Vec<u32>,
    /// It is one of the room.
    pub(super) is_room: bool,
    /// Several things have places of their own in it: `the teapot in the upper half and the jar in the lower half`.
    pub(super) is_shared: bool,
}

impl Picture {
    /// The picture of a clause; `None` where it states nothing. One that only names a thing or a number is built like
    /// the picture `before`.
    pub(super) fn of(linked: &Linked, clause: &Clause, before: Option<&Self>) -> Option<Self> {
        let all: Vec<&str> = linked.tokens_text.split(' ').collect();
        let words: Vec<&str> = clause.words.iter().map(|at| all[*at]).collect();
        let says = |list: &str| words.iter().any(|word| is_listed(list, word));
        let mut picture = Self::default();
        picture.take_subjects(linked, clause, &all);
        let framing = &mut picture.framing;
        // Which of the things before `both` means is not said here.
        if framing.subjects.is_empty() && says("both") {
            return None;
        }
        // Several things make one picture.
        framing.whole |= framing.subjects.len() > 1 && !framing.hidden;
        let named = framing.clone();
        (framing.place, framing.size, framing.angle) = (place(&words), size(&words), angle(&words));
        picture.is_shared = named.subjects.len() > 1 && framing.place.is_none() && has_opposite_places(&words);
        picture.is_room = named.subjects.is_empty() && says(ROOM);
        take_quantities(linked, &words, before.map(|before| &before.framing), framing);
        let is_bare = *framing == named && !named.subjects.is_empty() && !says("in on with") && !says(SEEN);
        let is_like = |before: &&Self| is_bare && (before.framing.whole || !named.whole || named.subjects.len() > 1);
        if let Some(before) = before.filter(is_like) {
            let whole = named.whole || before.framing.whole;
            *framing = Framing { subjects: named.subjects, whole, ..before.framing.clone() };
        }
        (picture.framing != Framing::default()).then_some(picture)
    }

    /// Takes the things that are seen, and how: wholly, or not at all where nothing else is.
    fn take_subjects(&mut self, linked: &Linked, clause: &Clause, words: &[&str]) {
        let (mut seen, mut unseen) = (Vec::new(), Vec::new());
        let (mut group, mut whole, mut is_told, mut is_gone) = (Vec::new(), false, false, false);
        let mut all_whole = true;
        let mut close = |group: &mut Vec<u32>, whole: bool, is_gone: bool| {
            if !is_gone && !group.is_empty() {
                all_whole &= whole;
            }
            if is_gone { &mut unseen } else { &mut seen }.append(group);
        };
        for &at in &clause.words {
            let word = words[at];
            if let Some(id) = linked.slot_at(word) {
                if is_told {
                    close(&mut group, whole, is_gone);
                    (whole, is_told, is_gone) = (false, false, false);
                }
                group.push(id);
                whole |= linked.wholes.contains(&linked.spans[at]);
            } else if is_listed(WHOLE, word) {
                whole = true;
            } else if is_listed(OUT, word) {
                (is_told, is_gone) = (!group.is_empty(), true);
            } else if word == "in" || is_listed(SEEN, word) || linked.is_quantity(word) {
                is_told |= !group.is_empty();
            }
        }
        close(&mut group, whole, is_gone);
        let is_hidden = seen.is_empty() && (is_gone || !unseen.is_empty());
        self.framing.whole = !is_hidden && (all_whole && !seen.is_empty() || seen.is_empty() && whole);
        self.framing.hidden = is_hidden;
        self.framing.subjects = linked.expanded(if is_hidden { &unseen } else { &seen });
        self.gone = if is_hidden { Vec::new() } else { linked.expanded(&unseen) };
    }

    /// Writes what is stated over a framing. What was read of another subject is dropped.
    pub(super) fn write(&self, _linked: &Linked, framing: &mut Framing) {
        let own = &self.framing;
        if self.is_room && !framing.subjects.is_empty() {
            *framing = Framing::default();
        }
        if !own.subjects.is_empty() && framing.subjects != own.subjects {
            let size = framing.size.filter(|_| framing.subjects.is_empty());
            *framing = Framing { subjects: own.subjects.clone(), size, ..Framing::default() };
        }
        framing.size = own.size.or(framing.size.filter(|_| own.height_frac.is_none() && own.distance.is_none()));
        framing.angle = own.angle.or(framing.angle.filter(|_| own.elevation_deg.is_none()));
        framing.height_frac = own.height_frac.or(framing.height_frac);
        framing.elevation_deg = own.elevation_deg.or(framing.elevation_deg);
        framing.height = own.height.or(framing.height);
        framing.distance = own.distance.or(framing.distance);
        framing.lens = own.lens.or(framing.lens);
        framing.place = own.place.or(framing.place);
        framing.whole |= own.whole;
        framing.hidden |= own.hidden;
    }

    /// Writes what all pictures have in common over both ends of a step about the same subject.
    pub(super) fn write_throughout(&self, linked: &Linked, step: &mut Step) {
        let subjects = &self.framing.subjects;
        if self.is_shared {
            let shares = |framing: &Framing| framing.subjects.iter().all(|id| subjects.contains(id));
            for framing in [&mut step.start, &mut step.end].into_iter().filter(|framing| shares(framing)) {
                framing.subjects.clone_from(subjects);
                (framing.whole, framing.place) = (true, None);
            }
            return;
        }
        let leaves = step.movement.looks_elsewhere() || step.movement == Move::FlyThrough;
        let others = |framing: &Framing| !framing.subjects.is_empty() && framing.subjects != *subjects;
        if leaves || !subjects.is_empty() && (others(&step.start) || others(&step.end)) {
            return;
        }
        let own = Self { framing: Framing { subjects: Vec::new(), ..self.framing.clone() }, ..Self::default() };
        if !step.start.subjects.is_empty() {
            own.write(linked, &mut step.start);
        }
        if !step.end.subjects.is_empty() {
            own.write(linked, &mut step.end);
        }
    }
}

/// Takes what numbers state. A bare angle after an elevation is one.
fn take_quantities(linked: &Linked, words: &[&str], before: Option<&Framing>, framing: &mut Framing) {
    let says = |list: &str| words.iter().any(|word| is_listed(list, word));
    let is_elevation =
        says("elevation") || before.is_some_and(|before| before.elevation_deg.is_some()) && !says("fov lens");
    for (nth, word) in words.iter().enumerate() {
        if *word == "0" && matches!(words.get(nth + 1), Some(&("\u{B0}" | "degrees"))) && is_elevation {
            framing.elevation_deg = Some(0.0);
        }
        let Some(quantity) = linked.quantity_at(word) else { continue };
        let value = quantity.value;
        match quantity.kind {
            QuantityKind::Percent if !says("width wide") => framing.height_frac = Some(value / 100.0),
            QuantityKind::Degrees if says("fov field") => framing.lens = Some(Lens::FovDeg(value)),
            QuantityKind::Degrees if is_elevation => framing.elevation_deg = Some(value),
            QuantityKind::Millimeters => framing.lens = Some(Lens::FocalMm(value)),
            QuantityKind::Units if says("floor ground altitude height high") => framing.height = Some(value),
            QuantityKind::Units => framing.distance = Some(value),
            _ => {}
        }
    }
}
