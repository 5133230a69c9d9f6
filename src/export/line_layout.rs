//! How lines of a time, a position and a quaternion are laid out, found from the text itself.
//!
//! Enters: text with one pose per line. Leaves: the unit of the times and the order of the quaternion, with the
//! evidence. The order of a quaternion cannot be found from its numbers: both orders have the same length and the same
//! angles from pose to pose. A header that names the columns decides it, else the unit of the times, because EuRoC
//! counts nanoseconds and writes w first, and TUM counts seconds and writes w last. EuRoC's nanoseconds are whole numbers
//! without a point; those of programs that write TUM's lines at EuRoC's times (ORB-SLAM3, evo's writer in DPVO) are
//! numbers of floating point (`1403636579763555584.000000`, `1.403636579763555584e+18`). A format that is named decides the
//! order, and the text still decides the unit where it shows one: a header that names it, unless the stamps are of no
//! time in that unit, and else the size of the stamps and of their steps.

use super::columns::{cells, data_lines, is_names};
use super::stamp_unit::{MAX_LINES, StampUnit, UnitEvidence, header};

/// Largest deviation of a quaternion's length from 1. Above it, the columns are likely something else.
pub(super) const UNIT_TOLERANCE: f64 = 0.05;
/// Number of columns of a line with a time, a position and a quaternion.
pub(super) const POSE_COLUMNS: usize = 8;
/// Columns of EuRoC's ground truth, with velocities and biases.
pub(super) const EUROC_COLUMNS: usize = 17;

/// The order of the four numbers of a quaternion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
pub(super) enum QuaternionOrder {
    /// w last.
    #[strum(serialize = "x y z w")]
    Xyzw,
    /// w first.
    #[strum(serialize = "w x y z")]
    Wxyz,
}

/// The layout of lines of a time, a position and a quaternion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LineLayout {
    pub(super) unit: StampUnit,
    pub(super) order: QuaternionOrder,
}

impl LineLayout {
    /// TUM RGB-D.
    pub(super) const TUM: Self = Self { unit: StampUnit::Seconds, order: QuaternionOrder::Xyzw };
    /// DPVO: TUM with nanoseconds.
    pub(super) const DPVO: Self = Self { unit: StampUnit::Nanoseconds, ..Self::TUM };
    /// EuRoC MAV ground truth.
    pub(super) const EUROC: Self = Self { unit: StampUnit::Nanoseconds, order: QuaternionOrder::Wxyz };

    /// The layout with the unit that the header or the stamps of a text show; with its own if they show none.
    #[must_use]
    pub(super) fn with_unit_of(self, text: &str) -> Self {
        Self { unit: UnitEvidence::of(text).unit().unwrap_or(self.unit), ..self }
    }
}

/// A layout and its evidence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FoundLayout {
    pub(super) layout: LineLayout,
    /// Number of columns of the first line.
    pub(super) num_columns: usize,
    /// The unit that the text shows, whatever format is named.
    pub(super) shown_unit: Option<StampUnit>,
    /// Whether the unit did not have to be assumed.
    pub(super) is_unit_certain: bool,
    /// Whether the order did not have to be assumed.
    pub(super) is_order_certain: bool,
    /// Whether the times between spaces are numbers of floating point.
    pub(super) has_floating_stamps: bool,
}

/// The layout of a text; `None` if its first line is not a time, a position and a quaternion.
pub(super) fn find(text: &str) -> Option<FoundLayout> {
    let mut lines = data_lines(text).map(|(_, line)| line).filter(|line| !is_names(line)).take(MAX_LINES).peekable();
    let has_separators = lines.peek()?.contains([',', ';']);
    let rows: Vec<Vec<f64>> =
        lines.map_while(|line| cells(line).iter().map(|cell| cell.parse().ok()).collect()).collect();
    let num_columns = rows.first()?.len();
    let is_unit = |row: &&Vec<f64>| {
        let length_squared: Option<f64> = row.get(4..POSE_COLUMNS).map(|q| q.iter().map(|v| v * v).sum());
        length_squared.is_some_and(|squared| (squared.sqrt() - 1.0).abs() < UNIT_TOLERANCE)
    };
    // The reader names the line of a quaternion that is not of unit length, if the columns are likely poses.
    let are_poses = num_columns == POSE_COLUMNS || rows.iter().filter(is_unit).count() * 2 > rows.len();
    if num_columns < POSE_COLUMNS || !are_poses {
        return None;
    }
    let (evidence, header) = (UnitEvidence::of(text), header(text));
    let looks_like_euroc = has_separators || num_columns > POSE_COLUMNS;
    let usual_unit = if looks_like_euroc { StampUnit::Nanoseconds } else { StampUnit::Seconds };
    let (shown_unit, is_unit_certain) = (evidence.unit(), evidence.is_certain());
    let unit = shown_unit.unwrap_or(usual_unit);
    let named_order = order_in_header(&header);
    let has_floating_stamps = !looks_like_euroc && are_stamps_floating(text);
    let usual_order = match unit {
        _ if num_columns == EUROC_COLUMNS => QuaternionOrder::Wxyz,
        StampUnit::Nanoseconds if !has_floating_stamps => QuaternionOrder::Wxyz,
        _ => QuaternionOrder::Xyzw,
    };
    // A camera that never turns is rarely turned by half a circle about its own x.
    let is_likely_w_first = rows.iter().all(|row| row.get(4..POSE_COLUMNS) == Some(&[1.0, 0.0, 0.0, 0.0]));
    let is_order_certain = named_order.is_some()
        || match unit {
            StampUnit::Seconds => !looks_like_euroc && !is_likely_w_first,
            StampUnit::Nanoseconds => has_separators || num_columns == EUROC_COLUMNS,
            StampUnit::Milliseconds | StampUnit::Microseconds => false,
        };
    let layout = LineLayout { unit, order: named_order.unwrap_or(usual_order) };
    Some(FoundLayout { layout, num_columns, shown_unit, is_unit_certain, is_order_certain, has_floating_stamps })
}

/// Whether every time is written as a number of floating point, with a point or an exponent.
fn are_stamps_floating(text: &str) -> bool {
    let lines = data_lines(text).map(|(_, line)| line).filter(|line| !is_names(line)).take(MAX_LINES);
    lines.map(cells).all(|cells| cells.first().is_some_and(|stamp| stamp.contains(['.', 'e', 'E'])))
}

/// The order of four neighboring names that differ in the last letter: `qw qx qy qz`, `q_RS_x, q_RS_y, ..`.
fn order_in_header(header: &[String]) -> Option<QuaternionOrder> {
    let order_of = |names: &[&str]| {
        let prefix = names[0].get(..names[0].len().saturating_sub(1))?;
        let are = |letters: [&str; 4]| {
            names.iter().zip(letters).all(|(name, letter)| name.strip_prefix(prefix) == Some(letter))
        };
        if are(["w", "x", "y", "z"]) {
            return Some(QuaternionOrder::Wxyz);
        }
        are(["x", "y", "z", "w"]).then_some(QuaternionOrder::Xyzw)
    };
    header.iter().find_map(|line| {
        // Units in brackets stand between the names.
        let without_units: String =
            line.split('[').map(|part| part.split_once(']').map_or(part, |(_, rest)| rest)).collect();
        let names: Vec<&str> =
            without_units.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|name| !name.is_empty()).collect();
        names.windows(4).rev().find_map(order_of)
    })
}
