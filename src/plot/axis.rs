/// How numbers are laid along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Spacing {
    /// Evenly.
    #[default]
    Even,
    /// By their logarithm.
    Logarithmic,
}

/// One axis of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What it measures, with its unit.
    pub name: String,
    /// How numbers lie along it.
    pub spacing: Spacing,
    /// Room left at both ends, as a part of what the points take.
    pub room_frac: f64,
}

impl Axis {
    /// An axis of even numbers with some room at both ends.
    pub fn even(name: &str) -> Self {
        Self { name: name.to_owned(), spacing: Spacing::Even, room_frac: 0.06 }
    }

    /// An axis of powers with some room at both ends.
    pub fn logarithmic(name: &str) -> Self {
        Self { spacing: Spacing::Logarithmic, ..Self::even(name) }
    }

    /// Position of a value along the axis before it is fitted to the chart.
    pub(super) fn place(&self, value: f64) -> f64 {
        match self.spacing {
            Spacing::Even => value,
            Spacing::Logarithmic => value.max(1e-12).log10(),
        }
    }

    /// The places that hold all values and the room beside them; 0..1 where there are none.
    pub(super) fn interval(&self, values: impl Iterator<Item = f64>) -> (f64, f64) {
        let places = values.map(|value| self.place(value)).filter(|place| place.is_finite());
        let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if !(low <= high) {
            return (0.0, 1.0);
        }
        // A flat line is not blown up until its rounding shows.
        let least = match self.spacing {
            Spacing::Even => 1e-3 * low.abs().max(high.abs()).max(1.0),
            Spacing::Logarithmic => 0.1,
        };
        let room = ((high - low) * self.room_frac).max((least - (high - low)) / 2.0);
        (low - room, high + room)
    }

    /// Round values between two places, about `count` of them, each with its text.
    pub(super) fn ticks(&self, low: f64, high: f64, count: f64) -> Vec<(f64, String)> {
        match self.spacing {
            Spacing::Even => even_ticks(low, high, count),
            Spacing::Logarithmic => logarithmic_ticks(low, high, count),
        }
    }
}

/// Multiples of 1, 2 or 5 times a power of ten.
fn even_ticks(low: f64, high: f64, count: f64) -> Vec<(f64, String)> {
    let rough = (high - low) / count;
    if !(rough > 0.0 && rough.is_finite()) {
        return vec![(low, format!("{low:.3}"))];
    }
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().map(|m| m * power).find(|step| *step >= rough).unwrap_or(10.0 * power);
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    // Zero is added so that none has a minus before zero.
    (first..=last).map(|idx| idx as f64 * step + 0.0).map(|value| (value, format!("{value:.decimals$}"))).collect()
}

/// Multiples of powers of ten, as many to a power as there is room for; over less than that, even steps.
fn logarithmic_ticks(low: f64, high: f64, count: f64) -> Vec<(f64, String)> {
    const STEPS: [&[f64]; 3] = [&[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0], &[1.0, 2.0, 5.0], &[1.0]];
    let powers = || low.floor() as i32..=high.ceil() as i32;
    let shown = |steps: &'static [f64], stride: i32| -> Vec<(f64, String)> {
        let all = powers().filter(|power| power.rem_euclid(stride) == 0);
        let values = all.flat_map(|power| steps.iter().map(move |step| step * 10_f64.powi(power)));
        values.filter(|value| (low..=high).contains(&value.log10())).map(|value| (value, short(value))).collect()
    };
    let most = count.max(2.0);
    let finest = shown(STEPS[0], 1);
    if finest.len() < 3 {
        return even_ticks(10_f64.powf(low), 10_f64.powf(high), most);
    }
    let stride = ((high - low) / most).ceil().max(1.0) as i32;
    let fitting = STEPS.into_iter().map(|steps| shown(steps, 1)).find(|ticks| ticks.len() as f64 <= most);
    fitting.unwrap_or_else(|| shown(STEPS[2], stride))
}

/// A number in few characters.
fn short(value: f64) -> String {
    let rounded = |value: f64| format!("{}", (value * 1e4).round() / 1e4);
    match value.abs() {
        size if size >= 1e9 => format!("{}G", rounded(value / 1e9)),
        size if size >= 1e6 => format!("{}M", rounded(value / 1e6)),
        size if size >= 1e3 => format!("{}k", rounded(value / 1e3)),
        size if size < 0.01 && size > 0.0 => format!("{value:.0e}"),
        _ => rounded(value),
    }
}
