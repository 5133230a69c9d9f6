use glam::DVec3;

/// Which up axes files of a kind tend to have, when nothing in the scene tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UpPrior {
    /// PLY, `.splat` and SOG: y down as COLMAP and INRIA have it, seldom z up.
    PlyFrame,
    /// SPZ: y up by its specification, and as often y down by what converters write.
    Spz,
}

/// What it costs to lie off an axis at all, and for each degree. Many scenes are in the frame of their first camera, which
/// looks down at its subject by up to 45 degrees.
const TILT_COST: f64 = 0.2;
const TILT_COST_A_DEGREE: f64 = 1.0 / 18.0;

/// The coordinate axes in the order that breaks ties.
pub(super) const AXES: [DVec3; 6] = [DVec3::NEG_Y, DVec3::Y, DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_X];

impl UpPrior {
    /// Logarithm of the odds of an axis, against the likeliest one.
    pub(super) fn of_axis(self, axis: DVec3) -> f64 {
        match (self, axis.to_array().map(|v| v as i32)) {
            (Self::PlyFrame, [0, -1, 0]) | (Self::Spz, [0, 1, 0]) => 0.0,
            (Self::Spz, [0, -1, 0]) => -0.2,
            (Self::PlyFrame, [0, 1, 0] | [0, 0, 1]) => -1.5,
            (Self::Spz, [0, 0, 1]) => -2.0,
            (_, [0, 0, -1]) => -2.5,
            _ => -4.0,
        }
    }

    /// Logarithm of the odds of a direction: that of the best axis less what the tilt costs.
    pub(super) fn of(self, direction: DVec3) -> f64 {
        let tilted = |axis: DVec3| {
            let degrees = direction.dot(axis).clamp(-1.0, 1.0).acos().to_degrees();
            let cost = if degrees < 0.5 { 0.0 } else { TILT_COST + TILT_COST_A_DEGREE * degrees };
            self.of_axis(axis) - cost
        };
        AXES.into_iter().map(tilted).fold(f64::NEG_INFINITY, f64::max)
    }
}
