use super::RenderOutput;
use cinesplat_render::{Accuracy, InstructionSet, Precision, Quality, RenderSettings};
use strum::VariantArray;

/// The knob that a variant sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum KnobKind {
    /// The preset.
    Preset,
    /// The alpha cut; everything else as `final`.
    AlphaCut,
    /// The transmittance stop; everything else as `final`.
    TransmittanceStop,
    /// The resolution before enlarging; everything else as `final`.
    Resolution,
    /// The precision of the blending loop; everything else as `final`.
    Precision,
    /// The output; everything else as `standard`.
    Output,
    /// A knob that must not change any bit; everything else as `standard`.
    Free,
}

impl KnobKind {
    /// Whether the knob trades accuracy for time.
    pub(super) fn costs_accuracy(self) -> bool {
        !matches!(self, Self::Output | Self::Free)
    }
}

/// One setting of the renderer to measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// The output that is timed.
    pub output: RenderOutput,
    /// The knob.
    pub kind: KnobKind,
    /// Value of the knob, for tables.
    pub name: String,
    /// The render settings.
    pub settings: RenderSettings,
    /// Number of threads; `None` for those of the current pool.
    pub num_threads: Option<usize>,
    /// Whether it is so slow that it is measured once, with the first camera.
    pub is_slow: bool,
}

/// A variant that times 8-bit color on the current threads.
fn variant_of(kind: KnobKind, name: String, settings: RenderSettings) -> Variant {
    Variant { output: RenderOutput::Rgb8, kind, name, settings, num_threads: None, is_slow: false }
}

/// All presets except `reference`, every knob alone, the outputs, and the free knobs. All other settings are those of
/// `base`.
pub fn variants(base: &RenderSettings) -> Vec<Variant> {
    let mut all = presets(base);
    let knob = |kind, name, accuracy| {
        variant_of(kind, name, RenderSettings { quality: Quality::Final, accuracy: Some(accuracy), ..*base })
    };
    for divisor in [1024, 512, 192, 128, 64, 32] {
        let accuracy = Accuracy { alpha_cut: 1.0 / f64::from(divisor), ..Accuracy::SPEC };
        all.push(knob(KnobKind::AlphaCut, format!("1/{divisor}"), accuracy));
    }
    for transmittance_stop in [3e-4, 1e-3, 3e-3, 1e-2, 3e-2] {
        let accuracy = Accuracy { transmittance_stop, ..Accuracy::SPEC };
        all.push(knob(KnobKind::TransmittanceStop, format!("{transmittance_stop}"), accuracy));
    }
    for resolution_frac in [0.9, 0.75, 2.0 / 3.0, 0.5, 1.0 / 3.0] {
        let accuracy = Accuracy { resolution_frac, ..Accuracy::SPEC };
        all.push(knob(KnobKind::Resolution, format!("{resolution_frac:.2}"), accuracy));
    }
    let quick = Accuracy { precision: Precision::Quick, ..Accuracy::SPEC };
    all.push(knob(KnobKind::Precision, quick.precision.to_string(), quick));
    for transmittance_stop in [1e-3, 4e-3, 1e-2, 3e-2] {
        let accuracy = Accuracy { transmittance_stop, ..quick };
        all.push(knob(KnobKind::Precision, format!("{} to {transmittance_stop}", quick.precision), accuracy));
    }
    all.extend(outputs(base));
    all.extend(free(base));
    all
}

/// All presets except `reference`. All other settings are those of `base`.
pub fn presets(base: &RenderSettings) -> Vec<Variant> {
    let preset = |quality: Quality| {
        variant_of(KnobKind::Preset, quality.as_ref().to_owned(), RenderSettings { quality, accuracy: None, ..*base })
    };
    [Quality::Draft, Quality::Standard, Quality::Final].map(preset).to_vec()
}

/// One variant per output.
fn outputs(base: &RenderSettings) -> Vec<Variant> {
    let settings = RenderSettings { quality: Quality::Standard, accuracy: None, ..*base };
    let variant =
        |output: RenderOutput| Variant { output, ..variant_of(KnobKind::Output, output.as_ref().to_owned(), settings) };
    RenderOutput::VARIANTS.iter().copied().map(variant).collect()
}

/// Knobs that may change the time and must not change any bit.
fn free(base: &RenderSettings) -> Vec<Variant> {
    let standard = RenderSettings { quality: Quality::Standard, accuracy: None, ..*base };
    let as_standard = |name: &str| variant_of(KnobKind::Free, name.to_owned(), standard);
    let mut full_sort = as_standard("full sort");
    full_sort.settings.reuses_order = false;
    let on_threads = |num_threads: usize| {
        let plural = if num_threads == 1 { "" } else { "s" };
        Variant { num_threads: Some(num_threads), ..as_standard(&format!("{num_threads} thread{plural}")) }
    };
    let with = |instructions: InstructionSet| {
        let mut variant = as_standard(instructions.as_ref());
        variant.settings.instructions = instructions;
        variant
    };
    let mut scalar = with(InstructionSet::Scalar);
    scalar.is_slow = true;
    let mut all = vec![full_sort];
    all.extend([1, 2, 3].map(on_threads));
    all.extend([with(InstructionSet::Widest), with(InstructionSet::Avx2), scalar]);
    all
}
