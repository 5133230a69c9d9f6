//! How the speed of a camera changes along a segment, by name.
//!
//! Four easings are what words ask for; the others are the common curves of animation programs (R. Penner, "Motion,
//! Tweening, and Easing", 2002). Those of that family that leave the way between two keys (back, elastic, bounce) are not
//! here, since a camera does not run backward, nor circ, whose speed has no bound at one end.

use std::f64::consts::{FRAC_PI_2, LN_2};

/// How the camera's speed changes along the segment that starts at a key.
///
/// `smooth`, `ease-in`, `ease-out` are a cruise at even speed with ramps, so that the middle of a move is steady.
/// The others follow one curve from key to key: `in` starts from rest, `out` comes to rest, `in-out` both.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
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
pub enum Easing {
    /// Ramp up, even cruise, ramp down: at rest at both ends.
    Smooth,
    /// Even speed, passing through both ends.
    Linear,
    /// From rest up to even speed.
    EaseIn,
    /// From even speed down to rest.
    EaseOut,
    /// A quarter of a cosine, from rest.
    SineIn,
    /// A quarter of a sine, to rest.
    SineOut,
    /// Half a cosine.
    SineInOut,
    /// Square of the time, from rest.
    QuadIn,
    /// Square of the time left, to rest.
    QuadOut,
    /// Two halves of a square.
    QuadInOut,
    /// Third power, from rest.
    CubicIn,
    /// Third power, to rest.
    CubicOut,
    /// Third power, both.
    CubicInOut,
    /// Fourth power, from rest.
    QuartIn,
    /// Fourth power, to rest.
    QuartOut,
    /// Fourth power, both.
    QuartInOut,
    /// Fifth power, from rest.
    QuintIn,
    /// Fifth power, to rest.
    QuintOut,
    /// Fifth power, both.
    QuintInOut,
    /// Ten doublings of speed, from rest.
    ExpoIn,
    /// Ten halvings of speed, to rest.
    ExpoOut,
    /// Ten doublings and ten halvings.
    ExpoInOut,
}

/// Growth of a curve from rest, before it is turned around for its `out` and `in-out`.
#[derive(Debug, Clone, Copy)]
enum Growth {
    Sine,
    Power(i32),
    Expo,
}

/// Doublings of speed along the `expo` curves.
const EXPO_DOUBLINGS: f64 = 10.0;

impl Growth {
    /// Progress and its slope at a share of the time, both 0..=1 mapped to 0..=1.
    fn at(self, x: f64) -> (f64, f64) {
        match self {
            Self::Sine => (1.0 - (FRAC_PI_2 * x).cos(), FRAC_PI_2 * (FRAC_PI_2 * x).sin()),
            Self::Power(n) => (x.powi(n), f64::from(n) * x.powi(n - 1)),
            Self::Expo => {
                // 2^(10 x) less its value at 0, so that it starts at 0 exactly.
                let (grown, all) = ((EXPO_DOUBLINGS * x).exp2(), EXPO_DOUBLINGS.exp2() - 1.0);
                ((grown - 1.0) / all, EXPO_DOUBLINGS * LN_2 * grown / all)
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

/// The curve of an easing that follows one from key to key.
#[derive(Debug, Clone, Copy)]
pub(super) struct Curve {
    growth: Growth,
    rest: Rest,
}

impl Curve {
    /// Share of the way at a share of the time, and the slope there.
    pub(super) fn at(self, x: f64) -> (f64, f64) {
        let backward = |x: f64| {
            let (left, slope) = self.growth.at(1.0 - x);
            (1.0 - left, slope)
        };
        match self.rest {
            Rest::Start => self.growth.at(x),
            Rest::End => backward(x),
            Rest::Both if x < 0.5 => {
                let (way, slope) = self.growth.at(2.0 * x);
                (way / 2.0, slope)
            }
            Rest::Both => {
                let (way, slope) = backward(2.0 * x - 1.0);
                (0.5 + way / 2.0, slope)
            }
        }
    }
}

impl Easing {
    /// The easings that words ask for, and that a director knows.
    pub const SPOKEN: &'static [Self] = &[Self::Smooth, Self::Linear, Self::EaseIn, Self::EaseOut];

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

    /// The easing made of a cruise and ramps that rests at the same ends.
    #[must_use]
    pub fn as_cruise(self) -> Self {
        match (self.rests_at_start(), self.rests_at_end()) {
            (true, true) => Self::Smooth,
            (true, false) => Self::EaseIn,
            (false, true) => Self::EaseOut,
            (false, false) => Self::Linear,
        }
    }

    /// The curve that the speed follows; `None` for a cruise with ramps.
    pub(super) fn curve(self) -> Option<Curve> {
        let (growth, rest) = match self {
            Self::Smooth | Self::Linear | Self::EaseIn | Self::EaseOut => return None,
            Self::SineIn => (Growth::Sine, Rest::Start),
            Self::SineOut => (Growth::Sine, Rest::End),
            Self::SineInOut => (Growth::Sine, Rest::Both),
            Self::QuadIn => (Growth::Power(2), Rest::Start),
            Self::QuadOut => (Growth::Power(2), Rest::End),
            Self::QuadInOut => (Growth::Power(2), Rest::Both),
            Self::CubicIn => (Growth::Power(3), Rest::Start),
            Self::CubicOut => (Growth::Power(3), Rest::End),
            Self::CubicInOut => (Growth::Power(3), Rest::Both),
            Self::QuartIn => (Growth::Power(4), Rest::Start),
            Self::QuartOut => (Growth::Power(4), Rest::End),
            Self::QuartInOut => (Growth::Power(4), Rest::Both),
            Self::QuintIn => (Growth::Power(5), Rest::Start),
            Self::QuintOut => (Growth::Power(5), Rest::End),
            Self::QuintInOut => (Growth::Power(5), Rest::Both),
            Self::ExpoIn => (Growth::Expo, Rest::Start),
            Self::ExpoOut => (Growth::Expo, Rest::End),
            Self::ExpoInOut => (Growth::Expo, Rest::Both),
        };
        Some(Curve { growth, rest })
    }
}
