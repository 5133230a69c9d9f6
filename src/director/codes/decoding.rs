//! Codes to keys. Every code has a meaning.

use cinesplat_operator::{Amount, FramePlace, Framing, Lens, Look, Motion, Pass, Speed, SubjectPart, SubjectSide, Via};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};
use strum::VariantArray;

use super::fields::{
    AMOUNT_LARGE, AMOUNT_QUANTITY, AMOUNT_SLIGHT, FORBIDDEN, Field, LENS_FOCAL, LENS_FOV, LENS_LONG, LENS_WIDE,
    LOOK_AHEAD, LOOK_AT, LOOK_BACK, LOOK_ROOM, NEXT_CUT, NEXT_SEGMENT,
};
use super::framing_end::{ARRIVAL, DEPARTURE, FramingEnd};
use super::key_code::{AVOID_POINTER, KEEP_POINTER, KeyCode, LOOK_POINTER, MAX_SUBJECTS, QuantityRole};
use crate::inputs::Grounding;
use crate::keys::{Key, Next, Segment};

/// Key of a code. An unknown class is read as a stop, a default or "unspecified"; a pointer beyond
/// its list points at nothing.
pub fn decode_key(code: &KeyCode, grounding: &Grounding) -> Key {
    let next = match code.class(Field::Next) {
        NEXT_CUT => Next::Cut,
        NEXT_SEGMENT => Next::Segment(decode_segment(code, grounding)),
        _ => Next::Stop,
    };
    Key { arrive: framing(code, &ARRIVAL, grounding), depart: framing(code, &DEPARTURE, grounding), next }
}

/// Motions that the film of a first key forbids.
pub fn forbidden_of(code: &KeyCode) -> Vec<Motion> {
    FORBIDDEN.iter().filter(|(field, _)| code.class(*field) == 1).map(|(_, motion)| *motion).collect()
}

/// Motions that the network reads bans of, in the order of its fields. Bans of others are read from the words.
pub(crate) fn read_motions() -> impl Iterator<Item = Motion> {
    FORBIDDEN.iter().map(|(_, motion)| *motion)
}

fn framing(code: &KeyCode, end: &FramingEnd, grounding: &Grounding) -> Framing {
    let [size, angle, part, whole, lens_kind, side, place, hidden] = end.fields.map(|field| code.class(field));
    let values = end.roles.map(|role| code.quantity(role).and_then(|idx| grounding.value(idx)));
    let [height_percent, elevation_deg, height, distance, lens_value] = values;
    Framing {
        subjects: ids_at(code, end.subjects, MAX_SUBJECTS, grounding),
        size: optional(ShotSize::VARIANTS, size),
        angle: optional(ShotAngle::VARIANTS, angle),
        part: SubjectPart::VARIANTS.get(usize::from(part)).copied().unwrap_or_default(),
        whole: whole == 1,
        height_frac: height_percent.map(|percent| percent / 100.0),
        elevation_deg,
        height,
        distance,
        lens: lens(lens_kind, lens_value),
        side: optional(&SubjectSide::READ, side),
        place: optional(FramePlace::VARIANTS, place),
        hidden: hidden == 1,
        // Backgrounds are read from the words.
        backdrop: Vec::new(),
    }
}

fn lens(class: u8, value: Option<f64>) -> Option<Lens> {
    match class {
        LENS_FOCAL => value.map(Lens::FocalMm),
        LENS_FOV => value.map(Lens::FovDeg),
        LENS_WIDE => Some(Lens::Wide),
        LENS_LONG => Some(Lens::Long),
        _ => None,
    }
}

/// Ids of the objects that the pointers `first..first + count` point at, each once.
fn ids_at(code: &KeyCode, first: usize, count: usize, grounding: &Grounding) -> Vec<u32> {
    let mut ids = Vec::new();
    for pointer in &code.objects[first..first + count] {
        let idx = pointer.and_then(|pointer| usize::from(pointer).checked_sub(1));
        if let Some(id) = idx.and_then(|idx| grounding.object_id(idx)).filter(|id| !ids.contains(id)) {
            ids.push(id);
        }
    }
    ids
}

fn decode_segment(code: &KeyCode, grounding: &Grounding) -> Segment {
    let passed = ids_at(code, 2 * MAX_SUBJECTS, MAX_SUBJECTS, grounding);
    let how = optional(Pass::VARIANTS, code.class(Field::Via));
    let with = [Field::With, Field::SecondWith].map(|field| optional(Move::VARIANTS, code.class(field)));
    Segment {
        movement: Move::VARIANTS.get(usize::from(code.class(Field::Movement))).copied().unwrap_or(Move::Static),
        with: with.into_iter().flatten().collect(),
        either_way: code.class(Field::EitherWay) == 1,
        via: how.filter(|_| !passed.is_empty()).map(|how| Via { how, objects: passed }),
        look: look(code, grounding),
        keep: ids_at(code, KEEP_POINTER, 1, grounding),
        avoid: ids_at(code, AVOID_POINTER, 1, grounding),
        amount: match code.class(Field::Amount) {
            AMOUNT_QUANTITY => code.quantity(QuantityRole::Amount).and_then(|idx| grounding.amount(idx)),
            AMOUNT_SLIGHT => Some(Amount::Slight),
            AMOUNT_LARGE => Some(Amount::Large),
            _ => None,
        },
        duration_secs: code.quantity(QuantityRole::Duration).and_then(|idx| grounding.seconds(idx)),
        speed: Speed::VARIANTS.get(usize::from(code.class(Field::Speed))).copied().unwrap_or_default(),
        easing: optional(Easing::VOCABULARY, code.class(Field::Easing)),
        returns: code.class(Field::Returns) == 1,
        words: code.span.and_then(|tokens| grounding.byte_range(tokens)),
    }
}

fn look(code: &KeyCode, grounding: &Grounding) -> Option<Look> {
    match code.class(Field::Look) {
        LOOK_AT => Some(ids_at(code, LOOK_POINTER, 1, grounding)).filter(|ids| !ids.is_empty()).map(Look::At),
        LOOK_AHEAD => Some(Look::Ahead),
        LOOK_BACK => Some(Look::Back),
        LOOK_ROOM => Some(Look::Room),
        _ => None,
    }
}

/// The choice of an optional field.
fn optional<T: Copy>(all: &[T], class: u8) -> Option<T> {
    usize::from(class).checked_sub(1).and_then(|choice| all.get(choice)).copied()
}
