use super::RenderOutput;
use cinesplat_render::{Accuracy, InstructionSet, Precision, Quality, RenderSettings};
use strum::VariantArray;

/// What a variant turns.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum KnobKind {
    /// A preset.
    Preset,
    /// The least opacity that counts, all else as `final`.
    AlphaCut,
    /// Where blending stops, all else as `final`.
    TransmittanceStop,
    /// The size rendered before enlarging, all else as `final`.
    Resolution,
    /// Precision of the blending loop, all else as `final`.
    Precision,
    /// What a picture is asked for, all else as `standard`.
    Output,
    /// What must change no bit, all else as `standard`.
    Free,
}

impl KnobKind {
    /// Whether it trades accuracy for time.
    pub fn costs_accuracy(self) -> bool {
        !matches!(self, Self::Output | Self::Free)
    }
}

/// Settings to be measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// What the pictures are asked for.
    pub output: RenderOutput,
    /// What it turns.
    pub kind: KnobKind,
    /// How far.
    pub name: String,
    /// The settings.
    pub settings: RenderSettings,
    /// Threads, in place of those of the current pool.
    pub num_threads: Option<usize>,
    /// Whether it takes so long that one run on the first camera has to do.
    pub is_slow: bool,
}

/// A variant of color in eight bits on the threads there are.
fn of(kind: KnobKind, name: String, settings: RenderSettings) -> Variant {
    Variant { output: RenderOutput::Levels, kind, name, settings, num_threads: None, is_slow: false }
}

/// All presets but `reference`, every knob alone, the outputs, and the knobs that must be free; filter, near plane and
/// the like as in `base`.
pub fn variants(base: &RenderSettings) -> Vec<Variant> {
    let mut all = presets(base);
    let knob = |kind, name, accuracy| {
        of(kind, name, RenderSettings { quality: Quality::Final, accuracy: Some(accuracy), ..*base })
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

/// All presets but `reference`.
pub fn presets(base: &RenderSettings) -> Vec<Variant> {
    let preset = |quality: Quality| {
        of(KnobKind::Preset, quality.as_ref().to_owned(), RenderSettings { quality, accuracy: None, ..*base })
    };
    [Quality::Draft, Quality::Standard, Quality::Final].map(preset).to_vec()
}

/// What a picture may be asked for.
fn outputs(base: &RenderSettings) -> Vec<Variant> {
    let settings = RenderSettings { quality: Quality::Standard, accuracy: None, ..*base };
    let asked = |output: RenderOutput| Variant { output, ..of(KnobKind::Output, output.as_ref().to_owned(), settings) };
    RenderOutput::VARIANTS.iter().copied().map(asked).collect()
}

/// What may change time and must change no bit.
fn free(base: &RenderSettings) -> Vec<Variant> {
    let standard = RenderSettings { quality: Quality::Standard, accuracy: None, ..*base };
    let as_standard = |name: &str| of(KnobKind::Free, name.to_owned(), standard);
    let mut anew = as_standard("order anew");
    anew.settings.reuses_order = false;
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
    let mut all = vec![anew];
    all.extend([1, 2, 3].map(on_threads));
    all.extend([with(InstructionSet::Widest), with(InstructionSet::Avx2), scalar]);
    all
}
