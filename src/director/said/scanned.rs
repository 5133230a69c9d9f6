//! How large the parts of the one thing of a scan are in the frame: `rise from the feet of the stand to the tuning pegs` begins
//! with the feet, and not with all of the guitar.

use cinesplat_language::{Linked, is_listed};
use cinesplat_objects::{Object, only_whole};
use cinesplat_operator::{Amount, Framing, Motion, Pass, Program, Step, SubjectPart};
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};
use glam::DVec3;

use super::directions::is_form;

/// Height over width from which on a thing stands upright.
const UPRIGHT: f64 = 1.4;
/// Height of the whole thing over that of the frame in a picture of one end of it, where it stands upright and where it does not:
/// the end is seen up to its edge.
const OF_UPRIGHT: f64 = 2.4;
const OF_COMPACT: f64 = 1.7;
/// The same of a close picture of the end of a part, such as the pegs at the end of a neck.
const CLOSE: f64 = 2.0;
/// Most of the height of a thing that a part is which is its end, and the distance of their edges, of its height.
const END_FRAC: f64 = 0.65;
const EDGE_FRAC: f64 = 0.08;

/// Part of the height of a thing from which a way between two of its parts leads up or down.
const LEADS_FRAC: f64 = 0.15;
/// Least turn about a lone thing that goes round it, degrees: a camera that turned so far on the spot would see nothing.
const LEAST_ROUND_DEG: f64 = 45.0;

/// Share of the height of a thing below which the middle of a part of its lower end is, and above which from the top.
const LOWER: f64 = 0.4;
/// Growth of the picture over half a way that comes nearer.
const NEARER: f64 = 1.2;

/// Words that only say to come closer.
const CLOSER: &str = "closer nearer close and even still in , . then yet much a bit little";
/// Words that keep something in the picture, of the picture, of a place in it, and of what was named before.
const KEEPS: &str = "keep keeping keeps with have having hold holding";
const SEEN: &str = "frame shot view picture sight visible screen image";
const PLACES: &str = "top bottom upper lower left right center centre middle third corner edge centered centred";
const PRONOUNS: &str = "him her it them he she";
/// Verbs of a way along something, and of a way over it.
const SLIDES: [&str; 9] = ["slide", "glide", "travel", "come", "go", "run", "move", "drift", "track"];
const CLIMBS: [&str; 7] = ["climb", "rise", "lift", "crane", "boom", "jib", "float"];

/// The one thing of a scan and its parts.
struct Scanned<'a> {
    whole: &'a Object,
    objects: &'a [Object],
    up: DVec3,
}

/// Frames the parts of the one thing of a scan as large as they are.
pub(crate) fn frame_parts(linked: &Linked, (objects, up): (&[Object], DVec3), program: &mut Program) {
    let Some(whole) = only_whole(objects) else { return };
    let scanned = Scanned { whole, objects, up: up.normalize_or_zero() };
    scanned.circle_the_whole(linked, &mut program.steps);
    scanned.come_closer(linked, &mut program.steps);
    for step in &mut program.steps {
        scanned.keep_in_frame(linked, step);
        scanned.end_on_whole(linked, step);
        scanned.slide_along(linked, step);
        scanned.go_round(linked, step);
        scanned.rise_over(linked, step);
        for framing in [&mut step.start, &mut step.end] {
            scanned.drop_parts_of_whole(framing);
        }
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_close = words.iter().any(|word| matches!(*word, "close" | "tight" | "tightly" | "closely"));
        if !scanned.lead_from_end_to_end(step, is_close) {
            scanned.close_on_end(&mut step.start);
            scanned.close_on_end(&mut step.end);
        }
    }
}

impl Scanned<'_> {
    /// Lowest and highest point of an object, along up.
    fn heights(&self, object: &Object) -> [f64; 2] {
        object.span_along(self.up)
    }

    fn height(&self) -> f64 {
        let [low, high] = self.heights(self.whole);
        (high - low).max(1e-9)
    }

    fn is_upright(&self) -> bool {
        let (right, ahead) = self.up.any_orthonormal_pair();
        let extent = |axis: DVec3| {
            let [low, high] = self.whole.span_along(axis);
            high - low
        };
        self.height() > UPRIGHT * extent(right).max(extent(ahead))
    }

    /// Whether an object is the thing or a part of it.
    fn is_own(&self, id: u32) -> bool {
        id == self.whole.id || self.objects.iter().any(|o| o.id == id && o.parent == Some(self.whole.id))
    }

    /// A picture of the thing and of some of its parts is one of the thing.
    fn drop_parts_of_whole(&self, framing: &mut Framing) {
        if framing.subjects.contains(&self.whole.id) && framing.subjects.len() > 1 {
            framing.subjects.retain(|id| *id == self.whole.id || !self.is_own(*id));
        }
    }

    /// The part of the thing that is its end.
    fn end(&self, part: SubjectPart) -> Option<&Object> {
        let [low, high] = self.heights(self.whole);
        let is_end = |object: &&Object| {
            let [own_low, own_high] = self.heights(object);
            let gap = if part == SubjectPart::Top { high - own_high } else { own_low - low };
            gap < EDGE_FRAC * self.height() && own_high - own_low < END_FRAC * self.height()
        };
        self.objects.iter().filter(|object| object.parent == Some(self.whole.id)).find(is_end)
    }

    /// Goes round all of the thing where the step before shows all of it and the words name nothing else: `pull out to the full
    /// guitar and circle it`.
    fn circle_the_whole(&self, linked: &Linked, steps: &mut [Step]) {
        for nth in 1..steps.len() {
            let (before, rest) = steps.split_at_mut(nth);
            let (Some(before), Some(step)) = (before.last(), rest.first_mut()) else { return };
            let words = linked.texts_in(step.words.unwrap_or_default());
            let names = words.iter().any(|word| linked.slot_at(word).is_some());
            let shows_all = before.end.subjects == [self.whole.id] && before.end.whole;
            let is_part = matches!(step.end.subjects[..], [id] if id != self.whole.id && self.is_own(id));
            if step.movement.is_circular() && !names && shows_all && is_part {
                step.end.subjects = vec![self.whole.id];
            }
        }
    }

    /// Stays close to the small part to which a rise leads from a close picture, and comes closer where that is all that is said.
    fn come_closer(&self, linked: &Linked, steps: &mut [Step]) {
        for nth in 1..steps.len() {
            let (before, rest) = steps.split_at_mut(nth);
            let (Some(before), Some(step)) = (before.last(), rest.first_mut()) else { return };
            let is_near = matches!(before.end.size, Some(ShotSize::CloseUp | ShotSize::ExtremeCloseUp));
            let end = &step.end;
            let is_open = end.size.is_none() && end.height_frac.is_none() && !end.whole && end.angle.is_none();
            let own = !end.subjects.is_empty() && end.subjects.iter().all(|id| self.is_own(*id));
            if !is_near || !is_open || !own || step.cut {
                continue;
            }
            let [from, to] = step.words.unwrap_or_default();
            let small = linked.parts.iter().any(|(bytes, part)| part.is_small && from <= bytes[0] && bytes[1] <= to);
            let lifts = Motion::of(step.movement) == Some(Motion::Rise);
            let words = linked.texts_in([from, to]);
            let is_closer = words.iter().any(|word| matches!(*word, "closer" | "nearer"))
                && words.iter().all(|word| is_listed(CLOSER, word));
            if small && lifts {
                step.end.size = Some(ShotSize::CloseUp);
            } else if is_closer && step.movement == Move::PushIn && before.end.subjects == step.end.subjects {
                step.end = Framing { size: Some(ShotSize::ExtremeCloseUp), ..before.end.clone() };
            }
        }
    }

    /// Shows all of the thing where a part of it is only to stay in the frame: `arc around him, keep his head in frame`.
    fn keep_in_frame(&self, linked: &Linked, step: &mut Step) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let kept = (0..words.len()).filter_map(|at| Some((at, linked.slot_at(words[at])?))).find(|(at, _)| {
            let behind = words[at + 1..].iter().take(5);
            let holds = words[..*at].iter().rev().take(6).any(|word| is_listed(KEEPS, word));
            holds
                && behind.clone().any(|word| is_listed(SEEN, word))
                && !behind.clone().any(|word| is_listed(PLACES, word))
        });
        let Some((at, id)) = kept.filter(|(_, id)| self.is_own(*id)) else { return };
        // What is said of nothing else is about the part.
        let is_said = |word: &&str| is_listed(PRONOUNS, word) || linked.slot_at(word).is_some_and(|id| self.is_own(id));
        let is_aside = words[..at].iter().chain(&words[at + 1..]).any(is_said);
        let own = step.end.subjects.iter().all(|id| self.is_own(*id));
        if !is_aside || !own || step.movement == Move::Static {
            return;
        }
        let size = step.end.size;
        step.end = Framing { subjects: vec![self.whole.id], size, whole: size.is_none(), ..Framing::default() };
        if id != self.whole.id && !step.keep.contains(&id) {
            step.keep.push(id);
        }
    }

    /// Ends on all of the thing where the words end on all of it: `crane down from the lid and end on the whole jug`.
    fn end_on_whole(&self, linked: &Linked, step: &mut Step) {
        let words: Vec<(&str, [usize; 2])> = linked.words_in(step.words.unwrap_or_default()).collect();
        let last = words.iter().rev().find_map(|(word, span)| Some((linked.slot_at(word)?, span)));
        let is_whole = last.is_some_and(|(id, span)| id == self.whole.id && linked.wholes.contains(span));
        let is_end =
            matches!(step.end.subjects[..], [id] if id == self.whole.id) && step.end.part != SubjectPart::Middle;
        if !is_whole || !is_end {
            return;
        }
        step.end =
            Framing { part: SubjectPart::Middle, size: None, height_frac: None, whole: true, ..step.end.clone() };
        let is_open = step.start.size.is_none() && step.start.height_frac.is_none() && !step.start.whole;
        if is_open && step.start.part != SubjectPart::Middle && step.start.subjects == step.end.subjects {
            step.start.height_frac = Some(if self.is_upright() { OF_UPRIGHT } else { OF_COMPACT });
        }
    }

    /// Sinks or rises along an upright thing where the words slide down or up it: `slide down the neck to the bridge`.
    fn slide_along(&self, linked: &Linked, step: &mut Step) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_way = matches!(step.movement, Move::TruckLeft | Move::TruckRight | Move::Follow | Move::FlyThrough);
        let says =
            |way: &str| words.windows(2).any(|two| two[1] == way && SLIDES.iter().any(|verb| is_form(two[0], verb)));
        let is_sideways = words.iter().any(|word| matches!(*word, "left" | "right" | "sideways" | "across"));
        let own = step.end.subjects.iter().all(|id| self.is_own(*id)) && !step.end.subjects.is_empty();
        if !is_way || is_sideways || !own || !self.is_upright() || step.returns {
            return;
        }
        let leads_up = self.leads_up(step);
        match (says("down") || leads_up == Some(false), says("up") || leads_up == Some(true)) {
            (true, false) => (step.movement, step.either_way) = (Move::PedestalDown, false),
            (false, true) => (step.movement, step.either_way) = (Move::PedestalUp, false),
            _ => {}
        }
    }

    /// Whether a step leads up (or down) from one part of the thing to another.
    fn leads_up(&self, step: &Step) -> Option<bool> {
        let height = |framing: &Framing| {
            let [id] = framing.subjects[..] else { return None };
            let [low, high] = self.heights(self.objects.iter().find(|object| object.id == id)?);
            Some(match framing.part {
                SubjectPart::Top => high,
                SubjectPart::Bottom => low,
                _ => low.midpoint(high),
            })
        };
        let rise = (height(&step.end)? - height(&step.start)?) / self.height();
        (rise.abs() > LEADS_FRAC).then_some(rise > 0.0)
    }

    /// Goes round the thing where its words turn by a part of a circle and name nothing: `quarter turn to the right` of a lone
    /// thing shows nothing else than its other side.
    fn go_round(&self, linked: &Linked, step: &mut Step) {
        let turn = match step.movement {
            Move::PanRight => Move::OrbitRight,
            Move::PanLeft => Move::OrbitLeft,
            _ => return,
        };
        let words = linked.texts_in(step.words.unwrap_or_default());
        let looks = words.iter().any(|word| is_listed("pan pans panning look looks yaw head spot place away", word));
        let own = step.end.subjects.iter().chain(&step.start.subjects).all(|id| *id == self.whole.id);
        let is_far = matches!(step.amount, Some(Amount::Degrees(degrees)) if degrees >= LEAST_ROUND_DEG);
        if own && is_far && !looks {
            step.movement = turn;
            step.end.subjects = vec![self.whole.id];
        }
    }

    /// Ends above the thing where the words climb over it: `up and over the top`.
    fn rise_over(&self, linked: &Linked, step: &mut Step) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let climbs = (0..words.len()).any(|at| {
            let over = words[at + 1..].iter().take(3).any(|word| *word == "over");
            over && (words[at] == "up" || CLIMBS.iter().any(|verb| is_form(words[at], verb)))
        });
        let is_way =
            matches!(step.movement, Move::CraneUp | Move::PedestalUp | Move::FlyThrough | Move::Follow | Move::PushIn);
        let over_it = step.via.as_ref().is_none_or(|via| {
            matches!(via.how, Pass::Over | Pass::Past | Pass::Along) && via.objects.iter().all(|id| self.is_own(*id))
        });
        let own = step.end.subjects.iter().all(|id| self.is_own(*id));
        let is_open = matches!(step.end.angle, None | Some(ShotAngle::High)) && step.end.height.is_none();
        if climbs && is_way && over_it && own && is_open && step.end.elevation_deg.is_none() {
            let size = step.end.size;
            (step.movement, step.via) = (Move::CraneUp, None);
            step.end =
                Framing { subjects: vec![self.whole.id], angle: Some(ShotAngle::Overhead), size, ..Framing::default() };
        }
    }

    /// Frames both ends of a rise or descent from one end of the thing to the other as one thing, so that the camera keeps
    /// its distance and level. Says whether it is one.
    fn lead_from_end_to_end(&self, step: &mut Step, is_close: bool) -> bool {
        let lifts = Motion::of(step.movement) == Some(Motion::Rise);
        let is_end = |framing: &Framing| {
            let is_open = framing.height_frac.is_none()
                && framing.angle.is_none()
                && framing.elevation_deg.is_none()
                && framing.size.is_none_or(|size| size == ShotSize::CloseUp);
            let [id] = framing.subjects[..] else { return false };
            is_open && self.is_own(id) && matches!(framing.part, SubjectPart::Top | SubjectPart::Bottom)
        };
        let as_end = |framing: &Framing| if self.is_upright() { framing.clone() } else { self.as_end(framing) };
        let ends = [as_end(&step.start), as_end(&step.end)];
        if !lifts || !ends.iter().all(is_end) || ends[0].part == ends[1].part {
            return false;
        }
        [step.start, step.end] = ends;
        let share = if self.is_upright() { OF_UPRIGHT } else { OF_COMPACT };
        let share = if is_close { share * 1.2 } else { share };
        let grows = if step.with.contains(&Move::PushIn) { NEARER } else { 1.0 };
        for (framing, share) in [(&mut step.start, share / grows), (&mut step.end, share * grows)] {
            framing.subjects = vec![self.whole.id];
            (framing.size, framing.height_frac, framing.whole) = (None, Some(share), false);
        }
        true
    }

    /// The picture of a part that lies at one end of the thing as one of that end: the jaw is the lower end of a skull.
    fn as_end(&self, framing: &Framing) -> Framing {
        let part = || {
            let [id] = framing.subjects[..] else { return None };
            let object = self.objects.iter().find(|object| object.id == id && object.parent == Some(self.whole.id))?;
            let [low, high] = self.heights(self.whole);
            let [own_low, own_high] = self.heights(object);
            let middle = (own_low.midpoint(own_high) - low) / (high - low).max(1e-9);
            match middle {
                middle if middle < LOWER => Some(SubjectPart::Bottom),
                middle if middle > 1.0 - LOWER => Some(SubjectPart::Top),
                _ => None,
            }
        };
        match part().filter(|_| framing.part == SubjectPart::Middle) {
            Some(part) => Framing { part, ..framing.clone() },
            None => framing.clone(),
        }
    }

    /// Frames a close picture of an end of the upright thing as close as the end needs it.
    fn close_on_end(&self, framing: &mut Framing) {
        let [id] = framing.subjects[..] else { return };
        let is_end = matches!(framing.part, SubjectPart::Top | SubjectPart::Bottom);
        let is_close = framing.size == Some(ShotSize::CloseUp) && framing.height_frac.is_none();
        if !is_end || !is_close || !self.is_own(id) || !self.is_upright() {
            return;
        }
        let end = self.end(framing.part).filter(|_| id == self.whole.id).map(|end| end.id);
        let share = if end.is_some() || id != self.whole.id { CLOSE } else { OF_UPRIGHT };
        framing.subjects = vec![end.unwrap_or(id)];
        (framing.size, framing.height_frac) = (None, Some(share));
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::linked;
    use super::*;

    fn guitar() -> Vec<Object> {
        let part = |id, label: &str, y: f64, half: f64, parent| Object {
            parent,
            ..Object::from_box(id, label, DVec3::new(0.0, y, 0.0), DVec3::new(0.4, half, 0.4))
        };
        vec![part(1, "guitar", 2.0, 2.0, None), part(2, "body", 1.0, 1.0, Some(1)), part(3, "neck", 3.0, 1.0, Some(1))]
    }

    fn framing(id: u32, part: SubjectPart, size: Option<ShotSize>) -> Framing {
        Framing { subjects: vec![id], part, size, ..Framing::default() }
    }

    fn framed(step: Step) -> Step {
        let mut program = Program { steps: vec![step], ..Program::default() };
        frame_parts(&linked("rise"), (&guitar(), DVec3::Y), &mut program);
        program.steps.remove(0)
    }

    #[test]
    fn a_rise_from_end_to_end_is_near_enough_for_the_ends() {
        let (bottom, top) = (framing(1, SubjectPart::Bottom, None), framing(3, SubjectPart::Top, None));
        let step = framed(Step { start: bottom, end: top, ..Step::of(Move::PedestalUp) });
        assert_eq!((&step.start.subjects[..], &step.end.subjects[..]), (&[1][..], &[1][..]));
        assert_eq!((step.start.height_frac, step.end.height_frac), (Some(OF_UPRIGHT), Some(OF_UPRIGHT)));
    }

    #[test]
    fn a_close_picture_of_an_end_shows_the_part_that_is_there() {
        let close = framing(1, SubjectPart::Top, Some(ShotSize::CloseUp));
        let step = framed(Step { end: close, ..Step::of(Move::PushIn) });
        assert_eq!((&step.end.subjects[..], step.end.height_frac), (&[3][..], Some(CLOSE)));
        let wide = framing(1, SubjectPart::Top, Some(ShotSize::Long));
        let step = framed(Step { end: wide.clone(), ..Step::of(Move::PushIn) });
        assert_eq!(step.end, wide);
    }

    #[test]
    fn a_part_that_stays_in_the_frame_is_no_place_in_it() {
        let kept = |text: &str| {
            let linked = Linked { slots: vec![3, 1], ..linked(text) };
            let end = Framing {
                place: Some(cinesplat_operator::FramePlace::AtUpper),
                ..framing(1, SubjectPart::Middle, None)
            };
            let step = Step { end, words: Some([0, text.len()]), ..Step::of(Move::ArcLeft) };
            let mut program = Program { steps: vec![step], ..Program::default() };
            frame_parts(&linked, (&guitar(), DVec3::Y), &mut program);
            program.steps.remove(0)
        };
        let step = kept("arc around it , keep <obj-0> in frame");
        assert_eq!((step.end.place, &step.keep[..]), (None, &[3][..]));
        assert!(kept("arc around it , keep <obj-0> in the upper third of the frame").end.place.is_some());
    }

    #[test]
    fn a_descent_to_the_whole_thing_ends_on_all_of_it() {
        let text = "crane down from <obj-0> to <obj-0>";
        let linked = Linked { slots: vec![1], wholes: vec![[27, 34]], ..linked(text) };
        let step = Step {
            start: framing(1, SubjectPart::Top, None),
            end: framing(1, SubjectPart::Bottom, None),
            words: Some([0, text.len()]),
            ..Step::of(Move::CraneDown)
        };
        let mut program = Program { steps: vec![step], ..Program::default() };
        frame_parts(&linked, (&guitar(), DVec3::Y), &mut program);
        let step = &program.steps[0];
        assert!(step.end.whole && step.end.part == SubjectPart::Middle && step.end.height_frac.is_none());
        assert_eq!(step.start.height_frac, Some(OF_UPRIGHT));
    }

    fn said(text: &str, step: Step) -> Step {
        let mut program = Program { steps: vec![Step { words: Some([0, text.len()]), ..step }], ..Program::default() };
        frame_parts(&linked(text), (&guitar(), DVec3::Y), &mut program);
        program.steps.remove(0)
    }

    #[test]
    fn a_slide_down_a_neck_sinks() {
        let step =
            || Step { end: framing(3, SubjectPart::Bottom, None), either_way: true, ..Step::of(Move::TruckRight) };
        assert_eq!(said("slide down it to the bridge", step()).movement, Move::PedestalDown);
        assert_eq!(said("slide left along it", step()).movement, Move::TruckRight);
    }

    #[test]
    fn closer_is_closer_than_close() {
        let text = "go to it close , closer";
        let close = framing(1, SubjectPart::Middle, Some(ShotSize::CloseUp));
        let first = Step { end: close.clone(), words: Some([0, 15]), ..Step::of(Move::PushIn) };
        let plain = framing(1, SubjectPart::Middle, None);
        let second = Step { end: plain, words: Some([15, text.len()]), ..Step::of(Move::PushIn) };
        let mut program = Program { steps: vec![first, second], ..Program::default() };
        frame_parts(&linked(text), (&guitar(), DVec3::Y), &mut program);
        assert_eq!(program.steps[1].end.size, Some(ShotSize::ExtremeCloseUp));
    }

    #[test]
    fn a_climb_over_the_thing_ends_above_it() {
        let step = || Step { end: framing(1, SubjectPart::Middle, None), ..Step::of(Move::FlyThrough) };
        let up = said("then go up and over the top", step());
        assert_eq!((up.movement, up.end.angle), (Move::CraneUp, Some(ShotAngle::Overhead)));
        assert_eq!(said("fly over it", step()).movement, Move::FlyThrough);
    }

    #[test]
    fn a_picture_of_the_thing_and_its_part_is_one_of_the_thing() {
        let both = Framing { subjects: vec![1, 2], whole: true, ..Framing::default() };
        assert_eq!(framed(Step { end: both, ..Step::of(Move::PullOut) }).end.subjects, [1]);
    }
}
