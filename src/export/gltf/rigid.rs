//! The rotation of a camera under nodes that stretch or mirror it, and what is lost with them.

use glam::{DAffine3, DMat3, DQuat};

use cinesplat_geometry::rotation;

/// Largest difference from a right angle, rad, and from equal lengths, that counts as rounding of f32.
const ROUNDING: f64 = 1e-4;

/// The rigid part of a camera's transform, with OpenGL axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rigid {
    pub(super) rotation: DQuat,
    pub(super) bend: Bend,
}

/// How far a transform is from a rigid one with a uniform scale.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Bend {
    /// Whether left and right are exchanged.
    is_mirrored: bool,
    /// Largest angle between the camera's axes and those of its picture, rad.
    skew_rad: f64,
    /// Largest ratio of two lengths along its axes, minus 1.
    stretch: f64,
}

impl Rigid {
    /// The rotation that keeps the view direction, and up as far as it is across it; `None` for a scale of 0.
    pub(super) fn of(placed: DAffine3) -> Option<Self> {
        let axes = placed.matrix3;
        let lengths = [axes.x_axis, axes.y_axis, axes.z_axis].map(glam::DVec3::length);
        let back = axes.z_axis.try_normalize()?;
        let up = (axes.y_axis - back * axes.y_axis.dot(back)).try_normalize()?;
        let right = up.cross(back);
        let side = axes.x_axis.try_normalize()?;
        let is_mirrored = side.dot(right) < 0.0;
        let skew_rad = [side.angle_between(if is_mirrored { -right } else { right }), axes.y_axis.angle_between(up)]
            .into_iter()
            .fold(0.0, f64::max);
        let (low, high) = lengths.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(*v), high.max(*v)));
        let rotation = rotation::from_matrix(DMat3::from_cols(right, up, back)).ok()?;
        Some(Self { rotation, bend: Bend { is_mirrored, skew_rad, stretch: high / low - 1.0 } })
    }
}

impl Bend {
    /// The larger of each amount.
    pub(super) fn worse(self, other: Self) -> Self {
        Self {
            is_mirrored: self.is_mirrored || other.is_mirrored,
            skew_rad: self.skew_rad.max(other.skew_rad),
            stretch: self.stretch.max(other.stretch),
        }
    }

    /// One line per loss; none for a rigid camera.
    pub(super) fn lines(self) -> Vec<String> {
        let mut lines = Vec::new();
        if self.is_mirrored {
            lines.push("the nodes above the camera mirror it: its picture is not mirrored here".to_owned());
        }
        if self.stretch > ROUNDING {
            let ratio = self.stretch + 1.0;
            lines.push(format!(
                "the nodes above the camera stretch it by up to {ratio:.3} times: its picture is not stretched here"
            ));
        }
        if self.skew_rad > ROUNDING {
            let degrees = self.skew_rad.to_degrees();
            lines.push(format!(
                "the nodes above the camera skew it by up to {degrees:.2} degrees: the view direction is kept"
            ));
        }
        lines
    }
}
