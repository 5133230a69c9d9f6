/// How values map to positions along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AxisScale {
    /// Position proportional to the value.
    #[default]
    Linear,
    /// Position proportional to the logarithm of the value.
    Logarithmic,
}

/// One axis of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name of the quantity, with its unit.
    pub name: String,
    /// Mapping from values to positions.
    pub scale: AxisScale,
    /// Margin at each end, as a fraction of the range of the points.
    pub margin_frac: f64,
}

impl Axis {
    /// A linear axis with a margin at both ends.
    pub fn linear(name: &str) -> Self {
        Self { name: name.to_owned(), scale: AxisScale::Linear, margin_frac: 0.06 }
    }

    /// A logarithmic axis with a margin at both ends.
    pub fn logarithmic(name: &str) -> Self {
        Self { scale: AxisScale::Logarithmic, ..Self::linear(name) }
    }

    /// The value, or its decimal logarithm on a logarithmic axis.
    pub(super) fn scaled(&self, value: f64) -> f64 {
        match self.scale {
            AxisScale::Linear => value,
            AxisScale::Logarithmic => value.max(1e-12).log10(),
        }
    }

    /// Range `(low, high)` of all scaled values with the margins; (0, 1) without values.
    pub(super) fn range(&self, values: impl Iterator<Item = f64>) -> (f64, f64) {
        let scaled = values.map(|value| self.scaled(value)).filter(|value| value.is_finite());
        let (low, high) = scaled.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if !(low <= high) {
            return (0.0, 1.0);
        }
        // A minimum extent keeps the rounding errors of a constant line invisible.
        let min_extent = match self.scale {
            AxisScale::Linear => 1e-3 * low.abs().max(high.abs()).max(1.0),
            AxisScale::Logarithmic => 0.1,
        };
        let margin = ((high - low) * self.margin_frac).max((min_extent - (high - low)) / 2.0);
        (low - margin, high + margin)
    }

    /// About `count` round values between two scaled values, each with its label.
    pub(super) fn ticks(&self, low: f64, high: f64, count: f64) -> Vec<(f64, String)> {
        match self.scale {
            AxisScale::Linear => linear_ticks(low, high, count),
            AxisScale::Logarithmic => logarithmic_ticks(low, high, count),
        }
    }
}

/// Multiples of a step of 1, 2 or 5 times a power of ten.
fn linear_ticks(low: f64, high: f64, count: f64) -> Vec<(f64, String)> {
    let rough = (high - low) / count;
    if !(rough > 0.0 && rough.is_finite()) {
        return vec![(low, format!("{low:.3}"))];
    }
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().map(|m| m * power).find(|step| *step >= rough).unwrap_or(10.0 * power);
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    // Adding 0 turns -0 into 0.
    (first..=last).map(|idx| idx as f64 * step + 0.0).map(|value| (value, format!("{value:.decimals$}"))).collect()
}

/// Multiples of powers of ten, as many per power as fit; linear steps where the range spans too little for three.
fn logarithmic_ticks(low: f64, high: f64, count: f64) -> Vec<(f64, String)> {
    const STEPS: [&[f64]; 3] = [&[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0], &[1.0, 2.0, 5.0], &[1.0]];
    let powers = || low.floor() as i32..=high.ceil() as i32;
    let shown = |steps: &'static [f64], stride: i32| -> Vec<(f64, String)> {
        let all = powers().filter(|power| power.rem_euclid(stride) == 0);
        let values = all.flat_map(|power| steps.iter().map(move |step| step * 10_f64.powi(power)));
        values.filter(|value| (low..=high).contains(&value.log10())).map(|value| (value, abbreviated(value))).collect()
    };
    let max_count = count.max(2.0);
    let finest = shown(STEPS[0], 1);
    if finest.len() < 3 {
        return linear_ticks(10_f64.powf(low), 10_f64.powf(high), max_count);
    }
    let stride = ((high - low) / max_count).ceil().max(1.0) as i32;
    let fitting = STEPS.into_iter().map(|steps| shown(steps, 1)).find(|ticks| ticks.len() as f64 <= max_count);
    fitting.unwrap_or_else(|| shown(STEPS[2], stride))
}

/// A number in few characters, with k, M and G for powers of 1000.
fn abbreviated(value: f64) -> String {
    let rounded = |value: f64| format!("{}", (value * 1e4).round() / 1e4);
    match value.abs() {
        size if size >= 1e9 => format!("{}G", rounded(value / 1e9)),
        size if size >= 1e6 => format!("{}M", rounded(value / 1e6)),
        size if size >= 1e3 => format!("{}k", rounded(value / 1e3)),
        size if size < 0.01 && size > 0.0 => format!("{value:.0e}"),
        _ => rounded(value),
    }
}
