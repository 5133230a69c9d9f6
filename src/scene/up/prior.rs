use glam::DVec3;

/// Prior probabilities of the up axis, by kind of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UpPrior {
    /// PLY, `.splat` and SOG: mostly y down, the frame of COLMAP and INRIA; rarely z up.
    PlyFrame,
    /// SPZ: y up by the specification, and about as often y down, as converters write it.
    Spz,
    /// A scene in any pose: no direction is more likely than another.
    Any,
}

/// Cost of a direction off the axes, and cost per degree off. Many scenes have the frame of their first camera, which is
/// pitched down to its subject by up to 45 degrees.
const TILT_COST: f64 = 0.2;
const TILT_COST_PER_DEGREE: f64 = 1.0 / 18.0;

/// The coordinate axes in the order in which they win ties.
pub(super) const AXES: [DVec3; 6] = [DVec3::NEG_Y, DVec3::Y, DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_X];

impl UpPrior {
    /// That of a kind of file, by the name of its format, such as `spz v2`.
    pub(crate) fn of_format(format: &str) -> Self {
        if format.starts_with("spz") { Self::Spz } else { Self::PlyFrame }
    }

    /// Logarithm of the odds of a coordinate axis relative to the most likely one.
    pub(super) fn of_axis(self, axis: DVec3) -> f64 {
        if self == Self::Any {
            return 0.0;
        }
        match (self, axis.to_array().map(|v| v as i32)) {
            (Self::PlyFrame, [0, -1, 0]) | (Self::Spz, [0, 1, 0]) => 0.0,
            (Self::Spz, [0, -1, 0]) => -0.2,
            (Self::PlyFrame, [0, 1, 0] | [0, 0, 1]) => -1.5,
            (Self::Spz, [0, 0, 1]) => -2.0,
            (_, [0, 0, -1]) => -2.5,
            _ => -4.0,
        }
    }

    /// Logarithm of the odds of a direction: that of the best axis minus the cost of the tilt.
    pub(super) fn of(self, direction: DVec3) -> f64 {
        if self == Self::Any {
            return 0.0;
        }
        let tilted = |axis: DVec3| {
            let degrees = direction.dot(axis).clamp(-1.0, 1.0).acos().to_degrees();
            let cost = if degrees < 0.5 { 0.0 } else { TILT_COST + TILT_COST_PER_DEGREE * degrees };
            self.of_axis(axis) - cost
        };
        AXES.into_iter().map(tilted).fold(f64::NEG_INFINITY, f64::max)
    }
}
