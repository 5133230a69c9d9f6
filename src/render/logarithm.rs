/// Binary logarithm of a positive normal number with an absolute error below 1e-7; vectorizes.
///
/// x = 2^e m with m in sqrt(1/2)..sqrt(2); log2(m) is a polynomial in m - 1, fitted at Chebyshev nodes.
#[inline(always)]
pub(super) fn log2(x: f32) -> f32 {
    const SQRT_HALF_BITS: u32 = 0x3f35_04f3;
    const POLYNOMIAL: [f32; 8] = [
        std::f32::consts::LOG2_E,
        -0.721_352_76,
        0.480_924_04,
        -0.360_242,
        0.287_075_6,
        -0.248_821_8,
        0.234_209_85,
        -0.146_203_53,
    ];
    let shifted = x.to_bits().wrapping_sub(SQRT_HALF_BITS);
    let exponent = (shifted as i32) >> 23;
    let t = f32::from_bits((shifted & 0x007f_ffff).wrapping_add(SQRT_HALF_BITS)) - 1.0;
    let mut sum = POLYNOMIAL[7];
    for coefficient in POLYNOMIAL[..7].iter().rev() {
        sum = sum * t + coefficient;
    }
    exponent as f32 + t * sum
}
