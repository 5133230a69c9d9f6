//! Which fields, quantities and pointers of a code hold the framing at each of its two ends.

use super::fields::Field;
use super::key_code::{MAX_SUBJECTS, QuantityRole};

/// The fields and roles of a framing at one of its two ends.
pub(super) struct FramingEnd {
    /// Size, angle, part, whole, lens, side, place, hidden.
    pub(super) fields: [Field; 8],
    /// Height in the frame, elevation, height, distance, lens.
    pub(super) roles: [QuantityRole; 5],
    /// First pointer at the subjects.
    pub(super) subjects: usize,
}

/// The framing when the camera arrives at the key.
pub(super) const ARRIVAL: FramingEnd = FramingEnd {
    fields: [
        Field::ArriveSize,
        Field::ArriveAngle,
        Field::ArrivePart,
        Field::ArriveWhole,
        Field::ArriveLens,
        Field::ArriveSide,
        Field::ArrivePlace,
        Field::ArriveHidden,
    ],
    roles: [
        QuantityRole::ArriveHeightFrac,
        QuantityRole::ArriveElevation,
        QuantityRole::ArriveHeight,
        QuantityRole::ArriveDistance,
        QuantityRole::ArriveLens,
    ],
    subjects: 0,
};

/// The framing when the camera departs from the key.
pub(super) const DEPARTURE: FramingEnd = FramingEnd {
    fields: [
        Field::DepartSize,
        Field::DepartAngle,
        Field::DepartPart,
        Field::DepartWhole,
        Field::DepartLens,
        Field::DepartSide,
        Field::DepartPlace,
        Field::DepartHidden,
    ],
    roles: [
        QuantityRole::DepartHeightFrac,
        QuantityRole::DepartElevation,
        QuantityRole::DepartHeight,
        QuantityRole::DepartDistance,
        QuantityRole::DepartLens,
    ],
    subjects: MAX_SUBJECTS,
};
