use pulp::{Arch, Simd, WithSimd};

/// Instruction set for the SIMD loops. Every set gives the same bits; they differ in speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum InstructionSet {
    /// The widest that this machine has: AVX-512, AVX2 or NEON, else scalar code.
    #[default]
    Widest,
    /// AVX2 with FMA; scalar code on a machine without them.
    Avx2,
    /// Scalar code: the reference for the other sets. Very slow if the build has no FMA.
    Scalar,
}

impl InstructionSet {
    /// Runs `work`, compiled for this instruction set.
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
