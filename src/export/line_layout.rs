//! How lines of a time, a position and a quaternion are laid out, found from the text itself.
//!
//! Enters: text with one pose per line. Leaves: the unit of the times and the order of the quaternion, with the
//! evidence. The order of a quaternion cannot be found from its numbers: both orders have the same length and the same
//! angles from pose to pose. A header that names the columns decides it, else the unit of the times, because EuRoC
//! counts nanoseconds and writes w first, and TUM counts seconds and writes w last.

use super::columns::{cells, data_lines, is_names};

/// Number of lines that are examined.
const MAX_LINES: usize = 1000;
/// Largest deviation of a quaternion's length from 1. Above it, the columns are likely something else.
pub(super) const UNIT_TOLERANCE: f64 = 0.05;
/// Number of columns of a line with a time, a position and a quaternion.
pub(super) const POSE_COLUMNS: usize = 8;
/// Columns of EuRoC's ground truth, with velocities and biases.
const EUROC_COLUMNS: usize = 17;

/// The unit of the times in the first column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum StampUnit {
    /// Seconds.
    Seconds,
    /// Nanoseconds.
    Nanoseconds,
}

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

/// The number of columns that a reader accepts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ColumnCount {
    /// Eight.
    Exact,
    /// Eight, and any number of others behind them.
    AtLeast,
}

/// The layout of lines of a time, a position and a quaternion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LineLayout {
    pub(super) unit: StampUnit,
    pub(super) order: QuaternionOrder,
    pub(super) columns: ColumnCount,
}

impl LineLayout {
    /// TUM RGB-D.
    pub(super) const TUM: Self =
        Self { unit: StampUnit::Seconds, order: QuaternionOrder::Xyzw, columns: ColumnCount::Exact };
    /// DPVO: TUM with nanoseconds.
    pub(super) const DPVO: Self = Self { unit: StampUnit::Nanoseconds, ..Self::TUM };
    /// EuRoC MAV ground truth.
    pub(super) const EUROC: Self =
        Self { unit: StampUnit::Nanoseconds, order: QuaternionOrder::Wxyz, columns: ColumnCount::AtLeast };
}

/// A layout and its evidence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FoundLayout {
    pub(super) layout: LineLayout,
    /// Number of columns of the first line.
    pub(super) num_columns: usize,
    /// Whether neither the unit nor the order had to be assumed.
    pub(super) is_certain: bool,
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
    let stamps: Vec<f64> = rows.iter().filter_map(|row| row.first().copied()).collect();
    let (by_stamps, header) = (unit_of_stamps(&stamps), header(text));
    let by_header = unit_in_header(&header);
    let looks_like_euroc = has_separators || num_columns > POSE_COLUMNS;
    let usual_unit = if looks_like_euroc { StampUnit::Nanoseconds } else { StampUnit::Seconds };
    let unit = by_stamps.or(by_header).unwrap_or(usual_unit);
    let is_unit_certain = match (by_stamps, by_header) {
        (Some(stamps), Some(header)) => stamps == header,
        (stamps, header) => stamps.is_some() || header.is_some(),
    };
    let named_order = order_in_header(&header);
    let usual_order = match unit {
        StampUnit::Seconds if num_columns == POSE_COLUMNS => QuaternionOrder::Xyzw,
        _ => QuaternionOrder::Wxyz,
    };
    let is_order_certain = named_order.is_some()
        || match unit {
            StampUnit::Seconds => !looks_like_euroc,
            StampUnit::Nanoseconds => has_separators || num_columns == EUROC_COLUMNS,
        };
    let columns = if num_columns == POSE_COLUMNS { ColumnCount::Exact } else { ColumnCount::AtLeast };
    let layout = LineLayout { unit, order: named_order.unwrap_or(usual_order), columns };
    Some(FoundLayout { layout, num_columns, is_certain: is_unit_certain && is_order_certain })
}

/// The unit that the size of the stamps and their steps shows; `None` if both are possible.
fn unit_of_stamps(stamps: &[f64]) -> Option<StampUnit> {
    /// Nanoseconds since 1970 on a day in 1973, and more seconds than the universe is old.
    const ONLY_NANOSECONDS: f64 = 1e17;
    /// Seconds since 1970 in the year 5138, and 100 s in nanoseconds.
    const MOST_SECONDS: f64 = 1e11;
    let largest = stamps.iter().fold(0.0, |largest: f64, stamp| largest.max(stamp.abs()));
    if largest >= ONLY_NANOSECONDS {
        return Some(StampUnit::Nanoseconds);
    }
    let mut steps: Vec<f64> = stamps.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0).collect();
    steps.sort_by(f64::total_cmp);
    let is_whole = stamps.iter().all(|stamp| stamp.fract().abs() < f64::EPSILON);
    match steps.get(steps.len() / 2) {
        // 0.1 ms in nanoseconds or a day in seconds; 1 ms or 11 days for stamps with fractions.
        Some(step) if *step >= 1e6 || (is_whole && *step >= 1e5) => Some(StampUnit::Nanoseconds),
        Some(step) if *step <= 1e4 && largest < MOST_SECONDS => Some(StampUnit::Seconds),
        None if !is_whole && largest < MOST_SECONDS => Some(StampUnit::Seconds),
        _ => None,
    }
}

/// The lines before the first data, in lower case.
fn header(text: &str) -> Vec<String> {
    let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    lines.take_while(|line| line.is_empty() || line.starts_with('#') || is_names(line)).map(str::to_lowercase).collect()
}

fn unit_in_header(header: &[String]) -> Option<StampUnit> {
    let has = |names: &[&str]| header.iter().any(|line| names.iter().any(|name| line.contains(name)));
    if has(&["[ns]", "(ns)", "_ns", "nsec", "nanosec"]) {
        return Some(StampUnit::Nanoseconds);
    }
    has(&["[s]", "(s)", "secs", "seconds"]).then_some(StampUnit::Seconds)
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
