//! Named speed profiles of a segment.
//!
//! Prompts can name four of them. The others are the common curves of animation programs (R. Penner, "Motion,
//! Tweening, and Easing", 2002), without back, elastic and bounce, which overshoot or run backward, and without circ,
//! whose speed is unbounded at one end.

use std::f64::consts::{FRAC_PI_2, LN_2};

/// How the camera's speed changes along the segment that starts at a key.
///
/// `smooth`, `linear`, `ease-in` and `ease-out` cruise at constant speed, with a ramp at each end that is at rest, so that
/// the middle of a move is steady. `blend` leads from the motion before to the motion after. The others follow one curve
/// from key to key: `in` starts from rest, `out` comes to rest, `in-out` does both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Easing {
    /// Ramp up, cruise, ramp down: at rest at both ends.
    Smooth,
    /// Constant speed, at rest at neither end.
    Linear,
    /// Ramp up, cruise: at rest at the start.
    EaseIn,
    /// Cruise, ramp down: at rest at the end.
    EaseOut,
    /// From the velocity of the segment before to that of the segment after, continuous up to the acceleration, in
    /// position, rotation and lens. At rest where there is no such segment.
    Blend,
    /// A quarter period of a cosine, from rest.
    SineIn,
    /// A quarter period of a sine, to rest.
    SineOut,
    /// Half a period of a cosine, from rest to rest.
    SineInOut,
    /// Square of the time, from rest.
    QuadIn,
    /// Square of the remaining time, to rest.
    QuadOut,
    /// Square of the time, then of the remaining time, from rest to rest.
    QuadInOut,
    /// Third power, from rest.
    CubicIn,
    /// Third power, to rest.
    CubicOut,
    /// Third power, from rest to rest.
    CubicInOut,
    /// Fourth power, from rest.
    QuartIn,
    /// Fourth power, to rest.
    QuartOut,
    /// Fourth power, from rest to rest.
    QuartInOut,
    /// Fifth power, from rest.
    QuintIn,
    /// Fifth power, to rest.
    QuintOut,
    /// Fifth power, from rest to rest.
    QuintInOut,
    /// The speed doubles ten times, from near rest.
    ExpoIn,
    /// The speed halves ten times, to near rest.
    ExpoOut,
    /// The speed doubles ten times, then halves ten times.
    ExpoInOut,
}

/// The `in` form of a family of curves; `out` and `in-out` are mirrored from it.
#[derive(Debug, Clone, Copy)]
enum CurveFamily {
    Sine,
    Power(i32),
    Expo,
}

/// Number of doublings of the speed along the `expo` curves.
const EXPO_DOUBLINGS: f64 = 10.0;

impl CurveFamily {
    /// Fraction of the length after a fraction `x` of the time, both 0..=1, and its derivative.
    fn at(self, x: f64) -> (f64, f64) {
        match self {
            Self::Sine => (1.0 - (FRAC_PI_2 * x).cos(), FRAC_PI_2 * (FRAC_PI_2 * x).sin()),
            Self::Power(n) => (x.powi(n), f64::from(n) * x.powi(n - 1)),
            Self::Expo => {
                // 2^(10 x) minus its value at 0, so that the curve starts at exactly 0.
                let (power, total) = ((EXPO_DOUBLINGS * x).exp2(), EXPO_DOUBLINGS.exp2() - 1.0);
                ((power - 1.0) / total, EXPO_DOUBLINGS * LN_2 * power / total)
            }
        }
    }
}

/// Which ends of a curve are at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Rest {
    Start,
    End,
    Both,
}

/// The curve of an easing from key to key.
#[derive(Debug, Clone, Copy)]
pub(super) struct Curve {
    family: CurveFamily,
    rest: Rest,
}

impl Curve {
    /// Fraction of the length after a fraction `x` of the time, both 0..=1, and its derivative.
    pub(super) fn at(self, x: f64) -> (f64, f64) {
        let mirrored = |x: f64| {
            let (length, slope) = self.family.at(1.0 - x);
            (1.0 - length, slope)
        };
        match self.rest {
            Rest::Start => self.family.at(x),
            Rest::End => mirrored(x),
            Rest::Both if x < 0.5 => {
                let (length, slope) = self.family.at(2.0 * x);
                (length / 2.0, slope)
            }
            Rest::Both => {
                let (length, slope) = mirrored(2.0 * x - 1.0);
                (0.5 + length / 2.0, slope)
            }
        }
    }
}

impl Easing {
    /// The easings that a prompt can name: the vocabulary of the director.
    pub const VOCABULARY: &'static [Self] = &[Self::Smooth, Self::Linear, Self::EaseIn, Self::EaseOut];

    /// Whether the camera is at rest where the segment starts.
    pub fn rests_at_start(self) -> bool {
        match self.curve() {
            Some(curve) => curve.rest != Rest::End,
            None => matches!(self, Self::Smooth | Self::EaseIn),
        }
    }

    /// Whether the camera is at rest where the segment ends.
    pub fn rests_at_end(self) -> bool {
        match self.curve() {
            Some(curve) => curve.rest != Rest::Start,
            None => matches!(self, Self::Smooth | Self::EaseOut),
        }
    }

    /// The curve of the easing; `None` for a cruise with ramps.
    pub(super) fn curve(self) -> Option<Curve> {
        let (family, rest) = match self {
            Self::Smooth | Self::Linear | Self::EaseIn | Self::EaseOut | Self::Blend => return None,
            Self::SineIn => (CurveFamily::Sine, Rest::Start),
            Self::SineOut => (CurveFamily::Sine, Rest::End),
            Self::SineInOut => (CurveFamily::Sine, Rest::Both),
            Self::QuadIn => (CurveFamily::Power(2), Rest::Start),
            Self::QuadOut => (CurveFamily::Power(2), Rest::End),
            Self::QuadInOut => (CurveFamily::Power(2), Rest::Both),
            Self::CubicIn => (CurveFamily::Power(3), Rest::Start),
            Self::CubicOut => (CurveFamily::Power(3), Rest::End),
            Self::CubicInOut => (CurveFamily::Power(3), Rest::Both),
            Self::QuartIn => (CurveFamily::Power(4), Rest::Start),
            Self::QuartOut => (CurveFamily::Power(4), Rest::End),
            Self::QuartInOut => (CurveFamily::Power(4), Rest::Both),
            Self::QuintIn => (CurveFamily::Power(5), Rest::Start),
            Self::QuintOut => (CurveFamily::Power(5), Rest::End),
            Self::QuintInOut => (CurveFamily::Power(5), Rest::Both),
            Self::ExpoIn => (CurveFamily::Expo, Rest::Start),
            Self::ExpoOut => (CurveFamily::Expo, Rest::End),
            Self::ExpoInOut => (CurveFamily::Expo, Rest::Both),
        };
        Some(Curve { family, rest })
    }
}
