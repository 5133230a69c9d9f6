use super::super::{Accuracy, Instructions, Precision, Quality, RenderSettings};

/// What a variant turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
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
    /// What must change no bit, all else as `standard`.
    Free,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Preset, Self::AlphaCut, Self::TransmittanceStop, Self::Resolution, Self::Precision, Self::Free];

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Preset => "preset",
            Self::AlphaCut => "alpha-cut",
            Self::TransmittanceStop => "transmittance-stop",
            Self::Resolution => "resolution",
            Self::Precision => "precision",
            Self::Free => "free",
        }
    }
}

/// Settings to be measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// What it turns.
    pub kind: Kind,
    /// How far.
    pub name: String,
    /// The settings.
    pub settings: RenderSettings,
    /// Threads, in place of those of the current pool.
    pub num_threads: Option<usize>,
}

/// All presets but `reference`, every knob alone, and the knobs that must be free; filter, near plane and the like as
/// in `base`.
pub fn variants(base: &RenderSettings) -> Vec<Variant> {
    let of = |kind, name: String, quality, accuracy| Variant {
        kind,
        name,
        settings: RenderSettings { quality, accuracy, ..*base },
        num_threads: None,
    };
    let knob = |kind, name, accuracy| of(kind, name, Quality::Final, Some(accuracy));
    let presets = [Quality::Draft, Quality::Standard, Quality::Final];
    let mut all: Vec<Variant> =
        presets.into_iter().map(|quality| of(Kind::Preset, quality.name().to_owned(), quality, None)).collect();
    for divisor in [1024, 512, 192, 128, 64, 32, 16] {
        let accuracy = Accuracy { alpha_cut: 1.0 / f64::from(divisor), ..Accuracy::SPEC };
        all.push(knob(Kind::AlphaCut, format!("1/{divisor}"), accuracy));
    }
    for transmittance_stop in [3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1] {
        let accuracy = Accuracy { transmittance_stop, ..Accuracy::SPEC };
        all.push(knob(Kind::TransmittanceStop, format!("{transmittance_stop}"), accuracy));
    }
    for resolution_frac in [0.9, 0.75, 2.0 / 3.0, 0.5, 1.0 / 3.0] {
        let accuracy = Accuracy { resolution_frac, ..Accuracy::SPEC };
        all.push(knob(Kind::Resolution, format!("{resolution_frac:.2}"), accuracy));
    }
    all.push(knob(Kind::Precision, "quick".to_owned(), Accuracy { precision: Precision::Quick, ..Accuracy::SPEC }));
    all.extend(free(base));
    all
}

/// What may change time and must change no bit.
fn free(base: &RenderSettings) -> Vec<Variant> {
    let standard = RenderSettings { quality: Quality::Standard, accuracy: None, ..*base };
    let of = |name: &str, instructions, num_threads| Variant {
        kind: Kind::Free,
        name: name.to_owned(),
        settings: RenderSettings { instructions, ..standard },
        num_threads,
    };
    let mut anew = of("order anew", standard.instructions, None);
    anew.settings.reuses_order = false;
    vec![
        anew,
        of("1 thread", standard.instructions, Some(1)),
        of("2 threads", standard.instructions, Some(2)),
        of("3 threads", standard.instructions, Some(3)),
        of("widest", Instructions::Widest, None),
        of("avx2", Instructions::Avx2, None),
        of("scalar", Instructions::Scalar, None),
    ]
}
