use pulp::{Arch, Simd, WithSimd};

/// The widest instructions that may be used. Pictures are the same to the bit for all of them; time is not.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Default,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum InstructionSet {
    /// The widest that this machine has: AVX-512, AVX2, NEON.
    #[default]
    Widest,
    /// AVX2 with FMA; where a machine has no such thing, one number at a time.
    Avx2,
    /// One number at a time: what the others are checked against. Very slow where the build has no FMA.
    Scalar,
}

impl InstructionSet {
    /// Runs `work` with these instructions.
    #[inline]
    pub(super) fn dispatch<W: WithSimd>(self, work: W) -> W::Output {
        match self {
            Self::Widest => Arch::new().dispatch(work),
            Self::Avx2 => avx2(work),
            Self::Scalar => pulp::Scalar::new().vectorize(work),
        }
    }
}

#[cfg(target_arch = "x86_64")]
fn avx2<W: WithSimd>(work: W) -> W::Output {
    match pulp::x86::V3::try_new() {
        Some(instructions) => Simd::vectorize(instructions, work),
        None => pulp::Scalar::new().vectorize(work),
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn avx2<W: WithSimd>(work: W) -> W::Output {
    pulp::Scalar::new().vectorize(work)
}
