/// Name of the effect that shows a [`LensModel`].
pub const LENS_EFFECT: &str = "lens-distortion";

/// Names of the coefficients, in the order of [`LensModel::radial`] and [`LensModel::tangential`].
const COEFFICIENTS: [&str; 8] = ["k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"];

/// A lens as OpenCV models it, beside the field of view, which gives its vertical focal length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensModel {
    /// What the radial coefficients are those of.
    pub projection: LensProjection,
    /// k1 to k6; a fisheye has k1 to k4.
    pub radial: [f64; 6],
    /// p1 and p2; a fisheye has none.
    pub tangential: [f64; 2],
    /// Offset of the principal point from the middle of the frame, to the right and down, over the frame's height.
    pub center: [f64; 2],
    /// Horizontal over vertical focal length.
    pub stretch: f64,
}

/// How a [`LensModel`] projects.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum LensProjection {
    /// A pinhole with rational radial and tangential distortion (`cv::projectPoints`).
    #[default]
    Opencv,
    /// Distance from the principal point by a polynomial of the angle (`cv::fisheye::projectPoints`).
    OpencvFisheye,
}

impl Default for LensModel {
    /// A pinhole.
    fn default() -> Self {
        Self {
            projection: LensProjection::Opencv,
            radial: [0.0; 6],
            tangential: [0.0; 2],
            center: [0.0; 2],
            stretch: 1.0,
        }
    }
}

impl LensModel {
    /// Names of [`LensModel::values`].
    pub const NAMES: [&'static str; 12] =
        ["fisheye", "k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "center_x", "center_y", "stretch"];

    /// The lens with these values, by the names of [`LensModel::NAMES`]; those that `value` does not state are those of a
    /// pinhole.
    pub fn of_values(value: impl Fn(&str) -> Option<f64>) -> Self {
        let coefficient = |idx: usize| value(COEFFICIENTS[idx]).unwrap_or(0.0);
        let is_fisheye = value("fisheye").is_some_and(|fisheye| fisheye > 0.0);
        Self {
            projection: if is_fisheye { LensProjection::OpencvFisheye } else { LensProjection::Opencv },
            radial: std::array::from_fn(coefficient),
            tangential: [coefficient(6), coefficient(7)],
            center: ["center_x", "center_y"].map(|name| value(name).unwrap_or(0.0)),
            stretch: value("stretch").unwrap_or(1.0),
        }
    }

    /// Every value with its name; a projection is a number here, 1 for a fisheye.
    pub fn values(&self) -> [(&'static str, f64); 12] {
        let [k1, k2, k3, k4, k5, k6] = self.radial;
        let ([p1, p2], [x, y]) = (self.tangential, self.center);
        let fisheye = f64::from(u8::from(self.projection == LensProjection::OpencvFisheye));
        let values = [fisheye, k1, k2, k3, k4, k5, k6, p1, p2, x, y, self.stretch];
        std::array::from_fn(|idx| (Self::NAMES[idx], values[idx]))
    }

    /// The values that are not those of a pinhole.
    pub fn own_values(&self) -> Vec<(&'static str, f64)> {
        let of_pinhole = Self::default().values();
        self.values().into_iter().zip(of_pinhole).filter(|(own, other)| own != other).map(|(own, _)| own).collect()
    }

    /// Whether it is more than a pinhole.
    pub fn is_distorted(&self) -> bool {
        *self != Self::default()
    }

    /// Whether it shows a straight line as a curve.
    pub fn is_bent(&self) -> bool {
        let has_coefficients = self.radial.iter().chain(&self.tangential).any(|value| value.abs() > 0.0);
        has_coefficients || self.projection == LensProjection::OpencvFisheye
    }

    /// The first value that no lens has, and what it should be.
    pub fn fault(&self) -> Option<(f64, &'static str)> {
        let is_finite = |(_, value): &(&str, f64)| value.abs() <= 1e6;
        let wrong = self.values().into_iter().find(|value| !is_finite(value));
        let of_stretch = || (!(self.stretch > 0.0)).then_some((self.stretch, "a stretch above 0"));
        wrong.map(|(_, value)| (value, "numbers of at most a million")).or_else(of_stretch)
    }
}
