//! Keys as the class numbers and places that the network's heads choose among, and back.
//!
//! Enters: a [`Key`] with object ids and quantities. Leaves: a [`KeyCode`]: classes, places in the list of objects, in
//! the list of quantities and in the text. What does not apply (the move of a key that stops) is `None` and is neither
//! trained nor read.

use cinesplat_operator::{Amount, Framing, Pass, Speed, SubjectPart, Via};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};
use strum::VariantArray;

use super::keys::{Key, Next, Segment};

/// Subjects that a framing can name, and objects that a step can pass.
pub const PLACES: usize = 3;

/// Pointers at objects that a key has: subjects on arrival, subjects on departure, objects on the way.
pub const OBJECT_POINTERS: usize = 3 * PLACES;

/// Pointers at quantities that a key has: amount and duration.
pub const QUANTITY_POINTERS: usize = 2;

/// A choice among classes that a key makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    Next,
    Movement,
    With,
    EitherWay,
    Via,
    Amount,
    Speed,
    Easing,
    Returns,
    ArriveSize,
    ArriveAngle,
    ArrivePart,
    ArriveWhole,
    DepartSize,
    DepartAngle,
    DepartPart,
    DepartWhole,
}

/// Number of fields.
pub const NUM_FIELDS: usize = Field::ALL.len();

impl Field {
    /// Every field, in the order in which the network puts them out.
    pub const ALL: [Self; 17] = [
        Self::Next,
        Self::Movement,
        Self::With,
        Self::EitherWay,
        Self::Via,
        Self::Amount,
        Self::Speed,
        Self::Easing,
        Self::Returns,
        Self::ArriveSize,
        Self::ArriveAngle,
        Self::ArrivePart,
        Self::ArriveWhole,
        Self::DepartSize,
        Self::DepartAngle,
        Self::DepartPart,
        Self::DepartWhole,
    ];

    /// Number of classes; class 0 of an optional field is "not said".
    pub fn num_classes(self) -> usize {
        match self {
            Self::Next => 3,
            Self::Movement => Move::VARIANTS.len(),
            Self::With => 1 + Move::VARIANTS.len(),
            Self::EitherWay | Self::Returns | Self::ArriveWhole | Self::DepartWhole => 2,
            Self::Via => 1 + Pass::VARIANTS.len(),
            Self::Amount => 4,
            Self::Speed => Speed::VARIANTS.len(),
            Self::Easing => 1 + Easing::VOCABULARY.len(),
            Self::ArriveSize | Self::DepartSize => 1 + ShotSize::VARIANTS.len(),
            Self::ArriveAngle | Self::DepartAngle => 1 + ShotAngle::VARIANTS.len(),
            Self::ArrivePart | Self::DepartPart => SubjectPart::VARIANTS.len(),
        }
    }

    /// Where its classes begin among all classes.
    pub fn offset(self) -> usize {
        Self::ALL.iter().take_while(|field| **field != self).map(|field| field.num_classes()).sum()
    }

    /// Classes of all fields together.
    pub fn total_classes() -> usize {
        Self::ALL.iter().map(|field| field.num_classes()).sum()
    }

    /// Name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Next => "next",
            Self::Movement => "move",
            Self::With => "second move",
            Self::EitherWay => "either-way",
            Self::Via => "via",
            Self::Amount => "amount",
            Self::Speed => "speed",
            Self::Easing => "easing",
            Self::Returns => "returns",
            Self::ArriveSize => "end size",
            Self::ArriveAngle => "end angle",
            Self::ArrivePart => "end part",
            Self::ArriveWhole => "end whole",
            Self::DepartSize => "start size",
            Self::DepartAngle => "start angle",
            Self::DepartPart => "start part",
            Self::DepartWhole => "start whole",
        }
    }

    /// When the field applies.
    pub fn applies(self, next: u8, is_first: bool) -> bool {
        match self {
            Self::Next => true,
            Self::ArriveSize | Self::ArriveAngle | Self::ArrivePart | Self::ArriveWhole => !is_first,
            _ => next == NEXT_SEGMENT,
        }
    }
}

/// Class of [`Field::Next`]: a segment follows.
pub const NEXT_SEGMENT: u8 = 0;
/// Class of [`Field::Next`]: a cut follows.
pub const NEXT_CUT: u8 = 1;
/// Class of [`Field::Next`]: the film ends.
pub const NEXT_STOP: u8 = 2;
/// Class of [`Field::Amount`]: a quantity of the text.
pub const AMOUNT_QUANTITY: u8 = 1;

/// A key in numbers. Pointers count from 1; 0 points at nothing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct KeyCode {
    /// Class of each field of [`Field::ALL`]; `None` where it does not apply or is not known.
    pub classes: [Option<u8>; NUM_FIELDS],
    /// Places in the list of objects: arrival, departure, on the way, [`PLACES`] each.
    pub objects: [Option<u8>; OBJECT_POINTERS],
    /// Places in the list of quantities: amount, duration.
    pub quantities: [Option<u8>; QUANTITY_POINTERS],
    /// First and last token of the words it comes from.
    pub span: Option<[usize; 2]>,
}

impl KeyCode {
    /// Class of a field; 0 where it does not apply.
    pub fn class(&self, field: Field) -> u8 {
        let field_idx = Field::ALL.iter().position(|other| *other == field);
        field_idx.and_then(|field_idx| self.classes[field_idx]).unwrap_or(0)
    }

    /// Place of the object that the key is about: first on departure, else first on arrival.
    pub fn main_object(&self) -> Option<usize> {
        let place =
            |pointer: usize| self.objects[pointer].filter(|place| *place > 0).map(|place| usize::from(place) - 1);
        place(PLACES).or_else(|| place(0))
    }
}

/// What the places of a [`KeyCode`] stand for in one prompt.
pub trait Grounding {
    /// Place (from 0) of an object in the list of objects.
    fn object_place(&self, id: u32) -> Option<usize>;
    /// Id of the object at a place.
    fn object_id(&self, place: usize) -> Option<u32>;
    /// Place of the quantity that an amount is, preferably among the tokens of `span`.
    fn amount_place(&self, amount: Amount, span: Option<[usize; 2]>) -> Option<usize>;
    /// The quantity at a place as an amount.
    fn amount(&self, place: usize) -> Option<Amount>;
    /// Place of the quantity that a duration is, preferably among the tokens of `span`.
    fn seconds_place(&self, secs: f64, span: Option<[usize; 2]>) -> Option<usize>;
    /// The quantity at a place as a duration.
    fn seconds(&self, place: usize) -> Option<f64>;
    /// First and last token of a byte range of the prompt.
    fn tokens(&self, bytes: [usize; 2]) -> Option<[usize; 2]>;
    /// Byte range of the prompt from a first to a last token.
    fn bytes(&self, tokens: [usize; 2]) -> Option<[usize; 2]>;
}

/// The code of a key; `None` when it names an object that the list lacks or more objects than there are pointers.
pub fn encode(key: &Key, is_first: bool, grounding: &impl Grounding) -> Option<KeyCode> {
    let mut code = KeyCode::default();
    let next = match &key.next {
        Next::Segment(segment) => {
            encode_segment(segment, grounding, &mut code)?;
            encode_framing(&key.depart, Field::DepartSize, &mut code);
            point_at(&key.depart.subjects, PLACES, grounding, &mut code)?;
            NEXT_SEGMENT
        }
        Next::Cut => NEXT_CUT,
        Next::Stop => NEXT_STOP,
    };
    set(&mut code, Field::Next, next);
    if !is_first {
        encode_framing(&key.arrive, Field::ArriveSize, &mut code);
        point_at(&key.arrive.subjects, 0, grounding, &mut code)?;
    }
    Some(code)
}

fn set(code: &mut KeyCode, field: Field, class: u8) {
    if let Some(field_idx) = Field::ALL.iter().position(|other| *other == field) {
        code.classes[field_idx] = Some(class);
    }
}

/// Sets the four fields of a framing, of which `size_field` is the first.
fn encode_framing(framing: &Framing, size_field: Field, code: &mut KeyCode) {
    let Some(first) = Field::ALL.iter().position(|field| *field == size_field) else { return };
    code.classes[first] = Some(optional_class(ShotSize::VARIANTS, framing.size));
    code.classes[first + 1] = Some(optional_class(ShotAngle::VARIANTS, framing.angle));
    code.classes[first + 2] = Some(class_of(SubjectPart::VARIANTS, framing.part));
    code.classes[first + 3] = Some(u8::from(framing.whole));
}

fn point_at(ids: &[u32], first: usize, grounding: &impl Grounding, code: &mut KeyCode) -> Option<()> {
    if ids.len() > PLACES {
        return None;
    }
    for place_idx in 0..PLACES {
        let place = match ids.get(place_idx) {
            Some(id) => u8::try_from(grounding.object_place(*id)? + 1).ok()?,
            None => 0,
        };
        code.objects[first + place_idx] = Some(place);
    }
    Some(())
}

fn encode_segment(segment: &Segment, grounding: &impl Grounding, code: &mut KeyCode) -> Option<()> {
    code.span = segment.words.and_then(|bytes| grounding.tokens(bytes));
    set(code, Field::Movement, class_of(Move::VARIANTS, segment.movement));
    set(code, Field::With, optional_class(Move::VARIANTS, segment.with));
    set(code, Field::EitherWay, u8::from(segment.either_way));
    set(code, Field::Via, segment.via.as_ref().map_or(0, |via| 1 + class_of(Pass::VARIANTS, via.how)));
    set(code, Field::Speed, class_of(Speed::VARIANTS, segment.speed));
    set(code, Field::Easing, optional_class(Easing::VOCABULARY, segment.easing));
    set(code, Field::Returns, u8::from(segment.returns));
    let passed = segment.via.as_ref().map_or(&[][..], |via| &via.objects);
    point_at(passed, 2 * PLACES, grounding, code)?;
    encode_amount(segment.amount, grounding, code);
    code.quantities[1] = match segment.duration_secs {
        Some(secs) => grounding.seconds_place(secs, code.span).map(one_based),
        None => Some(0),
    };
    Some(())
}

/// An amount that is said in words that are no quantity stays unknown: not trained.
fn encode_amount(amount: Option<Amount>, grounding: &impl Grounding, code: &mut KeyCode) {
    let class = match amount {
        None => 0,
        Some(Amount::Slight) => 2,
        Some(Amount::Large) => 3,
        Some(quantity) => match grounding.amount_place(quantity, code.span) {
            Some(place) => {
                code.quantities[0] = Some(one_based(place));
                AMOUNT_QUANTITY
            }
            None => return,
        },
    };
    set(code, Field::Amount, class);
}

fn one_based(place: usize) -> u8 {
    u8::try_from(place + 1).unwrap_or(u8::MAX)
}

fn class_of<T: PartialEq + Copy>(all: &[T], choice: T) -> u8 {
    all.iter().position(|other| *other == choice).and_then(|class| u8::try_from(class).ok()).unwrap_or(0)
}

fn optional_class<T: PartialEq + Copy>(all: &[T], choice: Option<T>) -> u8 {
    choice.map_or(0, |choice| 1 + class_of(all, choice))
}

fn optional<T: Copy>(all: &[T], class: u8) -> Option<T> {
    usize::from(class).checked_sub(1).and_then(|choice| all.get(choice)).copied()
}

/// The key of a code: total, a class that does not exist counts as the first.
pub fn decode(code: &KeyCode, grounding: &impl Grounding) -> Key {
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
        depart: decode_framing(depart, ids_at(code, PLACES, grounding)),
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

/// Ids behind the pointers from `first`, each once.
fn ids_at(code: &KeyCode, first: usize, grounding: &impl Grounding) -> Vec<u32> {
    let mut ids = Vec::new();
    for pointer in &code.objects[first..first + PLACES] {
        let place = pointer.and_then(|place| usize::from(place).checked_sub(1));
        if let Some(id) = place.and_then(|place| grounding.object_id(place)).filter(|id| !ids.contains(id)) {
            ids.push(id);
        }
    }
    ids
}

fn decode_segment(code: &KeyCode, grounding: &impl Grounding) -> Segment {
    let quantity = |pointer: usize| code.quantities[pointer].and_then(|place| usize::from(place).checked_sub(1));
    let passed = ids_at(code, 2 * PLACES, grounding);
    let how = optional(Pass::VARIANTS, code.class(Field::Via));
    Segment {
        movement: Move::VARIANTS.get(usize::from(code.class(Field::Movement))).copied().unwrap_or(Move::Static),
        with: optional(Move::VARIANTS, code.class(Field::With)),
        either_way: code.class(Field::EitherWay) == 1,
        via: how.filter(|_| !passed.is_empty()).map(|how| Via { how, objects: passed }),
        amount: match code.class(Field::Amount) {
            AMOUNT_QUANTITY => quantity(0).and_then(|place| grounding.amount(place)),
            2 => Some(Amount::Slight),
            3 => Some(Amount::Large),
            _ => None,
        },
        duration_secs: quantity(1).and_then(|place| grounding.seconds(place)),
        speed: Speed::VARIANTS.get(usize::from(code.class(Field::Speed))).copied().unwrap_or_default(),
        easing: optional(Easing::VOCABULARY, code.class(Field::Easing)),
        returns: code.class(Field::Returns) == 1,
        words: code.span.and_then(|tokens| grounding.bytes(tokens)),
    }
}
