//! The unit of the times in the first column of a text, from its header and from the stamps.
//!
//! Enters: text with one pose per line. Leaves: the unit, and how much the text says about it.

use super::columns::{all_lines, cells, data_lines, is_comment, is_names};

/// Number of lines that are examined.
pub(super) const MAX_LINES: usize = 1000;

/// The unit of the times in the first column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum StampUnit {
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
    /// Microseconds.
    Microseconds,
    /// Nanoseconds.
    Nanoseconds,
}

impl StampUnit {
    /// Units per second.
    pub(super) fn per_sec(self) -> f64 {
        match self {
            Self::Seconds => 1.0,
            Self::Milliseconds => 1e3,
            Self::Microseconds => 1e6,
            Self::Nanoseconds => 1e9,
        }
    }
}

/// How much a unit that stamps show is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Strength {
    /// As other units the stamps would be of no time at all: the header is wrong.
    Certain,
    /// As other units the steps would be no steps of a camera; a header that names a unit is more.
    Likely,
    /// Other units are possible.
    Guess,
}

/// The unit that stamps show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Shown {
    unit: StampUnit,
    strength: Strength,
}

/// What a text says about the unit of its times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct UnitEvidence {
    by_stamps: Option<Shown>,
    by_header: Option<StampUnit>,
}

impl UnitEvidence {
    /// What a text shows.
    pub(super) fn of(text: &str) -> Self {
        let lines = data_lines(text).map(|(_, line)| line).filter(|line| !is_names(line)).take(MAX_LINES);
        let stamps: Option<Vec<f64>> = lines.map(|line| cells(line).first()?.parse().ok()).collect();
        Self { by_stamps: stamps.and_then(|stamps| unit_of_stamps(&stamps)), by_header: unit_in_header(&header(text)) }
    }

    /// The unit that the text shows.
    pub(super) fn unit(self) -> Option<StampUnit> {
        let certain = self.by_stamps.filter(|shown| shown.strength == Strength::Certain).map(|shown| shown.unit);
        certain.or(self.by_header).or(self.by_stamps.map(|shown| shown.unit))
    }

    /// Whether the unit does not have to be guessed.
    pub(super) fn is_certain(self) -> bool {
        match (self.by_stamps, self.by_header) {
            (Some(stamps), Some(header)) => stamps.unit == header,
            (Some(stamps), None) => stamps.strength != Strength::Guess,
            (None, header) => header.is_some(),
        }
    }

    /// A note on a unit that the text does not settle.
    pub(super) fn doubt(self, read_as: StampUnit) -> Option<String> {
        match (self.by_stamps, self.by_header) {
            (Some(stamps), Some(header)) if stamps.unit != header => {
                let other = if read_as == header { stamps.unit } else { header };
                let by = if read_as == header { "the stamps look like" } else { "the header says" };
                Some(format!("the times are read as {read_as}: {by} {other}"))
            }
            (Some(Shown { strength: Strength::Guess, .. }), None) => Some(format!(
                "the times are read as {read_as}, which their steps do not settle: a header `# time [ms]` would, or [s], [us], [ns]"
            )),
            _ => None,
        }
    }
}

/// The unit that the size of the stamps and their steps shows; `None` if several are possible.
fn unit_of_stamps(stamps: &[f64]) -> Option<Shown> {
    /// Nanoseconds since 1970 on a day in 1973, and more seconds than the universe is old.
    const ONLY_NANOSECONDS: f64 = 1e17;
    /// Milliseconds since 1970, of the years 1998 to 2286; the same digits with three more are microseconds.
    const UNIX_MILLISECONDS: std::ops::Range<f64> = 9e11..1e13;
    /// Seconds since 1970 in the year 5138, and 100 s in nanoseconds.
    const MOST_SECONDS: f64 = 1e11;
    /// Three years in seconds, and a day in milliseconds: stamps that count from the start of a recording.
    const FROM_START: f64 = 1e8;
    /// Steps of a camera in milliseconds, and of one that takes a picture now and then in seconds.
    const EITHER: std::ops::RangeInclusive<f64> = 5.0..=1000.0;
    let shown = |unit, strength| Some(Shown { unit, strength });
    let largest = stamps.iter().fold(0.0, |largest: f64, stamp| largest.max(stamp.abs()));
    if largest >= ONLY_NANOSECONDS {
        return shown(StampUnit::Nanoseconds, Strength::Certain);
    }
    let mut steps: Vec<f64> = stamps.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0).collect();
    steps.sort_by(f64::total_cmp);
    let is_whole = stamps.iter().all(|stamp| stamp.fract().abs() < f64::EPSILON);
    let step = steps.get(steps.len() / 2).copied();
    let is_step_below = |limit: f64| step.is_none_or(|step| step < limit);
    // As nanoseconds, counted since a quarter of an hour, the steps would be below 1 ms.
    if UNIX_MILLISECONDS.contains(&largest) && is_step_below(1e6) {
        return shown(StampUnit::Milliseconds, Strength::Certain);
    }
    if UNIX_MILLISECONDS.contains(&(largest / 1e3)) && is_step_below(3e6) {
        // Nanoseconds since the start of a machine, in steps of whole milliseconds.
        let are_millis = step.is_some_and(|step| step >= 1e6 && step % 1e6 == 0.0);
        return match step {
            _ if are_millis => shown(StampUnit::Nanoseconds, Strength::Guess),
            Some(step) if step >= 1e6 => shown(StampUnit::Microseconds, Strength::Guess),
            _ => shown(StampUnit::Microseconds, Strength::Certain),
        };
    }
    match step {
        // 0.1 ms in nanoseconds or a day in seconds; 1 ms or 11 days for stamps with fractions.
        Some(step) if step >= 1e6 || (is_whole && step >= 1e5) => shown(StampUnit::Nanoseconds, Strength::Likely),
        Some(step) if is_whole && largest < FROM_START && EITHER.contains(&step) => {
            shown(StampUnit::Seconds, Strength::Guess)
        }
        Some(step) if step <= 1e4 && largest < MOST_SECONDS => shown(StampUnit::Seconds, Strength::Likely),
        None if !is_whole && largest < MOST_SECONDS => shown(StampUnit::Seconds, Strength::Likely),
        _ => None,
    }
}

/// The lines before the first data, in lower case.
pub(super) fn header(text: &str) -> Vec<String> {
    let lines = all_lines(text);
    lines.take_while(|line| line.is_empty() || is_comment(line) || is_names(line)).map(str::to_lowercase).collect()
}

/// The unit that a header names first, in brackets, at the end of a column's name, or as a word beside that of time.
fn unit_in_header(header: &[String]) -> Option<StampUnit> {
    const NAMES: [(StampUnit, [&str; 3], &[&str]); 4] = [
        (StampUnit::Nanoseconds, ["[ns]", "(ns)", "_ns"], &["nsec", "nanosec"]),
        (StampUnit::Microseconds, ["[us]", "(us)", "_us"], &["usec", "microsec"]),
        (StampUnit::Milliseconds, ["[ms]", "(ms)", "_ms"], &["msec", "millisec"]),
        (StampUnit::Seconds, ["[s]", "(s)", "_secs"], &["secs", "seconds"]),
    ];
    let in_line = |line: &String| {
        let is_about_time = ["time", "stamp"].iter().any(|word| line.contains(word)) || is_names(line);
        let place_of = |name: &str| {
            let mut places = line.match_indices(name).map(|(at, _)| at);
            // `_ns` ends a name, and is no beginning of another one.
            places.find(|at| !name.starts_with('_') || !line[at + name.len()..].starts_with(char::is_alphanumeric))
        };
        let found = NAMES.iter().filter_map(|(unit, marks, words)| {
            let words = if is_about_time { *words } else { &[] };
            Some((marks.iter().chain(words).filter_map(|name| place_of(name)).min()?, *unit))
        });
        found.min_by_key(|(place, _)| *place).map(|(_, unit)| unit)
    };
    header.iter().find_map(in_line)
}
