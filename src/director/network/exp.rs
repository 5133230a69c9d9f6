//! The exponential function in a form that compilers turn into vector instructions.

/// `e^x` for x <= 0, without a branch: `2^n` by its bits times a polynomial of the rest (Cody and Waite 1980). Relative error
/// 2e-7; values below e^-87 are e^-87.
#[inline(always)]
#[allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]
pub(super) fn exp(x: f32) -> f32 {
    let x = x.max(-87.0);
    let n = (x * std::f32::consts::LOG2_E - 0.5) as i32;
    let whole = n as f32;
    let r = x - whole * 0.693_359_4 + whole * 2.121_944_4e-4;
    let polynomial =
        1.0 + r * (1.0 + r * (0.5 + r * (0.166_666_67 + r * (0.041_666_67 + r * (0.008_333_34 + r * 0.001_388_9)))));
    polynomial * f32::from_bits(((n + 127) << 23) as u32)
}
