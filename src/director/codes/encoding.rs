//! Keys to codes and back.
//!
//! Enters: a [`Key`] with object ids and quantities. Leaves: a [`KeyCode`] with classes and pointers into the lists of a
//! [`Grounding`]. [`decode_key`] is total: every code has a meaning.

use cinesplat_operator::{Amount, Framing, Pass, Speed, SubjectPart, Via};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};
use strum::VariantArray;

use super::fields::{AMOUNT_LARGE, AMOUNT_QUANTITY, AMOUNT_SLIGHT, Field, NEXT_CUT, NEXT_SEGMENT, NEXT_STOP};
use super::key_code::{KeyCode, MAX_SUBJECTS};
use crate::inputs::Grounding;
use crate::keys::{Key, Next, Segment};

/// Code of a key; `None` when the key names an object that the list of `grounding` lacks, or more objects than there are
/// pointers. `is_first` marks the film's first key, at which no camera arrives.
pub fn encode_key(key: &Key, is_first: bool, grounding: &Grounding) -> Option<KeyCode> {
    let mut code = KeyCode::default();
    let next = match &key.next {
        Next::Segment(segment) => {
            encode_segment(segment, grounding, &mut code)?;
            encode_framing(&key.depart, Field::DepartSize, &mut code);
            point_at(&key.depart.subjects, MAX_SUBJECTS, grounding, &mut code)?;
            NEXT_SEGMENT
        }
        Next::Cut => NEXT_CUT,
        Next::Stop => NEXT_STOP,
    };
    code.set_class(Field::Next, next);
    if !is_first {
        encode_framing(&key.arrive, Field::ArriveSize, &mut code);
        point_at(&key.arrive.subjects, 0, grounding, &mut code)?;
    }
    Some(code)
}

/// Sets the four fields of a framing; `size_field` is the first of them.
fn encode_framing(framing: &Framing, size_field: Field, code: &mut KeyCode) {
    let first = size_field as usize;
    code.classes[first] = Some(optional_class(ShotSize::VARIANTS, framing.size));
    code.classes[first + 1] = Some(optional_class(ShotAngle::VARIANTS, framing.angle));
    code.classes[first + 2] = Some(class_of(SubjectPart::VARIANTS, framing.part));
    code.classes[first + 3] = Some(u8::from(framing.whole));
}

/// Sets the [`MAX_SUBJECTS`] object pointers from `first` on; `None` when they cannot hold `ids`.
fn point_at(ids: &[u32], first: usize, grounding: &Grounding, code: &mut KeyCode) -> Option<()> {
    if ids.len() > MAX_SUBJECTS {
        return None;
    }
    for rank in 0..MAX_SUBJECTS {
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
    code.set_class(Field::With, optional_class(Move::VARIANTS, segment.with));
    code.set_class(Field::EitherWay, u8::from(segment.either_way));
    code.set_class(Field::Via, segment.via.as_ref().map_or(0, |via| 1 + class_of(Pass::VARIANTS, via.how)));
    code.set_class(Field::Speed, class_of(Speed::VARIANTS, segment.speed));
    code.set_class(Field::Easing, optional_class(Easing::VOCABULARY, segment.easing));
    code.set_class(Field::Returns, u8::from(segment.returns));
    let passed = segment.via.as_ref().map_or(&[][..], |via| &via.objects);
    point_at(passed, 2 * MAX_SUBJECTS, grounding, code)?;
    encode_amount(segment.amount, grounding, code);
    code.quantities[1] = match segment.duration_secs {
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
                code.quantities[0] = Some(one_based(idx));
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

/// The choice that [`optional_class`] encoded.
fn optional<T: Copy>(all: &[T], class: u8) -> Option<T> {
    usize::from(class).checked_sub(1).and_then(|choice| all.get(choice)).copied()
}

/// Key of a code. An unknown class is read as a stop, a default or "unspecified"; a pointer beyond
/// its list points at nothing.
pub fn decode_key(code: &KeyCode, grounding: &Grounding) -> Key {
    let next = match code.class(Field::Next) {
        NEXT_CUT => Next::Cut,
        NEXT_SEGMENT => Next::Segment(decode_segment(code, grounding)),
        _ => Next::Stop,
    };
    let fields = |size, angle, part, whole| [size, angle, part, whole].map(|field| code.class(field));
    let arrive = fields(Field::ArriveSize, Field::ArriveAngle, Field::ArrivePart, Field::ArriveWhole);
    let depart = fields(Field::DepartSize, Field::DepartAngle, Field::DepartPart, Field::DepartWhole);
    Key {
        arrive: decode_framing(arrive, ids_at(code, 0, grounding)),
        depart: decode_framing(depart, ids_at(code, MAX_SUBJECTS, grounding)),
        next,
    }
}

fn decode_framing([size, angle, part, whole]: [u8; 4], subjects: Vec<u32>) -> Framing {
    Framing {
        subjects,
        size: optional(ShotSize::VARIANTS, size),
        angle: optional(ShotAngle::VARIANTS, angle),
        part: SubjectPart::VARIANTS.get(usize::from(part)).copied().unwrap_or_default(),
        whole: whole == 1,
    }
}

/// Ids of the objects that the [`MAX_SUBJECTS`] pointers from `first` on point at, each once.
fn ids_at(code: &KeyCode, first: usize, grounding: &Grounding) -> Vec<u32> {
    let mut ids = Vec::new();
    for pointer in &code.objects[first..first + MAX_SUBJECTS] {
        let idx = pointer.and_then(|pointer| usize::from(pointer).checked_sub(1));
        if let Some(id) = idx.and_then(|idx| grounding.object_id(idx)).filter(|id| !ids.contains(id)) {
            ids.push(id);
        }
    }
    ids
}

fn decode_segment(code: &KeyCode, grounding: &Grounding) -> Segment {
    let quantity = |which: usize| code.quantities[which].and_then(|pointer| usize::from(pointer).checked_sub(1));
    let passed = ids_at(code, 2 * MAX_SUBJECTS, grounding);
    let how = optional(Pass::VARIANTS, code.class(Field::Via));
    Segment {
        movement: Move::VARIANTS.get(usize::from(code.class(Field::Movement))).copied().unwrap_or(Move::Static),
        with: optional(Move::VARIANTS, code.class(Field::With)),
        either_way: code.class(Field::EitherWay) == 1,
        via: how.filter(|_| !passed.is_empty()).map(|how| Via { how, objects: passed }),
        amount: match code.class(Field::Amount) {
            AMOUNT_QUANTITY => quantity(0).and_then(|idx| grounding.amount(idx)),
            AMOUNT_SLIGHT => Some(Amount::Slight),
            AMOUNT_LARGE => Some(Amount::Large),
            _ => None,
        },
        duration_secs: quantity(1).and_then(|idx| grounding.seconds(idx)),
        speed: Speed::VARIANTS.get(usize::from(code.class(Field::Speed))).copied().unwrap_or_default(),
        easing: optional(Easing::VOCABULARY, code.class(Field::Easing)),
        returns: code.class(Field::Returns) == 1,
        words: code.span.and_then(|tokens| grounding.byte_range(tokens)),
    }
}
