//! Keys to codes.
//!
//! Enters: a [`Key`] with object ids and quantities. Leaves: a [`KeyCode`] with classes and pointers into the lists of a
//! [`Grounding`].

use cinesplat_language::QuantityKind;
use cinesplat_operator::{Amount, FramePlace, Framing, Lens, Look, Motion, Pass, Speed, SubjectPart, SubjectSide};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};
use strum::VariantArray;

use super::fields::{
    AMOUNT_LARGE, AMOUNT_QUANTITY, AMOUNT_SLIGHT, FORBIDDEN, Field, LENS_FOCAL, LENS_FOV, LENS_LONG, LENS_WIDE,
    LOOK_AHEAD, LOOK_AT, LOOK_BACK, LOOK_ROOM, NEXT_CUT, NEXT_SEGMENT, NEXT_STOP,
};
use super::framing_end::{ARRIVAL, DEPARTURE, FramingEnd};
use super::key_code::{AVOID_POINTER, KEEP_POINTER, KeyCode, LOOK_POINTER, MAX_SUBJECTS, QuantityRole};
use crate::inputs::Grounding;
use crate::keys::{Key, Next, Segment};

/// Code of a key; `None` when the key names an object that the list of `grounding` lacks, or more objects than there are
/// pointers. `is_first` marks the film's first key, at which no camera arrives, and which has the motions that the film
/// forbids.
pub fn encode_key(key: &Key, is_first: bool, forbidden: &[Motion], grounding: &Grounding) -> Option<KeyCode> {
    let mut code = KeyCode::default();
    let next = match &key.next {
        Next::Segment(segment) => {
            encode_segment(segment, grounding, &mut code)?;
            encode_framing(&key.depart, &DEPARTURE, grounding, &mut code)?;
            NEXT_SEGMENT
        }
        Next::Cut => NEXT_CUT,
        Next::Stop => NEXT_STOP,
    };
    code.set_class(Field::Next, next);
    if is_first {
        for (field, motion) in FORBIDDEN {
            code.set_class(field, u8::from(forbidden.contains(&motion)));
        }
    } else {
        encode_framing(&key.arrive, &ARRIVAL, grounding, &mut code)?;
    }
    Some(code)
}

fn encode_framing(framing: &Framing, end: &FramingEnd, grounding: &Grounding, code: &mut KeyCode) -> Option<()> {
    let lens = match framing.lens {
        None => 0,
        Some(Lens::FocalMm(_)) => LENS_FOCAL,
        Some(Lens::FovDeg(_)) => LENS_FOV,
        Some(Lens::Wide) => LENS_WIDE,
        Some(Lens::Long) => LENS_LONG,
    };
    let classes = [
        optional_class(ShotSize::VARIANTS, framing.size),
        optional_class(ShotAngle::VARIANTS, framing.angle),
        class_of(SubjectPart::VARIANTS, framing.part),
        u8::from(framing.whole),
        lens,
        optional_class(&SubjectSide::READ, framing.side.filter(|side| SubjectSide::READ.contains(side))),
        optional_class(FramePlace::VARIANTS, framing.place),
        u8::from(framing.hidden),
    ];
    for (field, class) in end.fields.into_iter().zip(classes) {
        code.set_class(field, class);
    }
    let lens = match framing.lens {
        Some(Lens::FocalMm(focal_mm)) => Some((QuantityKind::Millimeters, focal_mm)),
        Some(Lens::FovDeg(fov_deg)) => Some((QuantityKind::Degrees, fov_deg)),
        _ => None,
    };
    let quantities = [
        framing.height_frac.map(|frac| (QuantityKind::Percent, 100.0 * frac)),
        framing.elevation_deg.map(|degrees| (QuantityKind::Degrees, degrees)),
        framing.height.map(|height| (QuantityKind::Units, height)),
        framing.distance.map(|distance| (QuantityKind::Units, distance)),
        lens,
    ];
    for (role, quantity) in end.roles.into_iter().zip(quantities) {
        code.quantities[role as usize] = match quantity {
            None => Some(0),
            Some((kind, value)) => grounding.quantity_idx(kind, value.abs(), None).map(one_based),
        };
    }
    point_at(&framing.subjects, end.subjects, MAX_SUBJECTS, grounding, code)
}

/// Sets the object pointers `first..first + count`; `None` when they cannot hold `ids`.
fn point_at(ids: &[u32], first: usize, count: usize, grounding: &Grounding, code: &mut KeyCode) -> Option<()> {
    if ids.len() > count {
        return None;
    }
    for rank in 0..count {
        let pointer = match ids.get(rank) {
            Some(id) => u8::try_from(grounding.object_idx(*id)? + 1).ok()?,
            None => 0,
        };
        code.objects[first + rank] = Some(pointer);
    }
    Some(())
}

fn encode_segment(segment: &Segment, grounding: &Grounding, code: &mut KeyCode) -> Option<()> {
    code.span = segment.words.and_then(|bytes| grounding.token_range(bytes));
    code.set_class(Field::Movement, class_of(Move::VARIANTS, segment.movement));
    code.set_class(Field::With, optional_class(Move::VARIANTS, segment.with.first().copied()));
    code.set_class(Field::SecondWith, optional_class(Move::VARIANTS, segment.with.get(1).copied()));
    code.set_class(Field::EitherWay, u8::from(segment.either_way));
    code.set_class(Field::Via, segment.via.as_ref().map_or(0, |via| 1 + class_of(Pass::VARIANTS, via.how)));
    code.set_class(Field::Speed, class_of(Speed::VARIANTS, segment.speed));
    code.set_class(Field::Easing, optional_class(Easing::VOCABULARY, segment.easing));
    code.set_class(Field::Returns, u8::from(segment.returns));
    let passed = segment.via.as_ref().map_or(&[][..], |via| &via.objects);
    point_at(passed, 2 * MAX_SUBJECTS, MAX_SUBJECTS, grounding, code)?;
    let (look, looked_at) = match &segment.look {
        None => (0, &[][..]),
        Some(Look::At(ids)) => (LOOK_AT, &ids[..]),
        Some(Look::Ahead) => (LOOK_AHEAD, &[][..]),
        Some(Look::Back) => (LOOK_BACK, &[][..]),
        Some(Look::Room) => (LOOK_ROOM, &[][..]),
    };
    code.set_class(Field::Look, look);
    point_at(looked_at, LOOK_POINTER, 1, grounding, code)?;
    point_at(&segment.keep, KEEP_POINTER, 1, grounding, code)?;
    point_at(&segment.avoid, AVOID_POINTER, 1, grounding, code)?;
    encode_amount(segment.amount, grounding, code);
    code.quantities[QuantityRole::Duration as usize] = match segment.duration_secs {
        Some(secs) => grounding.seconds_idx(secs, code.span).map(one_based),
        None => Some(0),
    };
    Some(())
}

/// Sets the class and the pointer of an amount. An amount that no quantity of the text gives stays unknown, and training
/// skips it.
fn encode_amount(amount: Option<Amount>, grounding: &Grounding, code: &mut KeyCode) {
    let class = match amount {
        None => 0,
        Some(Amount::Slight) => AMOUNT_SLIGHT,
        Some(Amount::Large) => AMOUNT_LARGE,
        Some(quantity) => match grounding.amount_idx(quantity, code.span) {
            Some(idx) => {
                code.quantities[QuantityRole::Amount as usize] = Some(one_based(idx));
                AMOUNT_QUANTITY
            }
            None => return,
        },
    };
    code.set_class(Field::Amount, class);
}

fn one_based(idx: usize) -> u8 {
    u8::try_from(idx + 1).unwrap_or(u8::MAX)
}

/// Index of `choice` among `all`; 0 when it is not among them.
fn class_of<T: PartialEq + Copy>(all: &[T], choice: T) -> u8 {
    all.iter().position(|other| *other == choice).and_then(|class| u8::try_from(class).ok()).unwrap_or(0)
}

/// 0 for `None`, else 1 + the index of the choice.
fn optional_class<T: PartialEq + Copy>(all: &[T], choice: Option<T>) -> u8 {
    choice.map_or(0, |choice| 1 + class_of(all, choice))
}
