//! The measured part of an error pose.

use glam::{DMat3, DVec3};

use super::svd::rotation_angle;

/// The measured part of the error pose E = (R, t).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "snake_case")]
pub enum Relation {
    /// Frobenius norm of E - I, 4 x 4: mixes radians and scene units.
    Full,
    /// Length of t, scene units.
    #[default]
    #[strum(to_string = "trans", serialize = "trans_part")]
    Trans,
    /// Frobenius norm of R - I, 3 x 3; about sqrt(2) times the angle.
    #[strum(to_string = "rot", serialize = "rot_part")]
    Rot,
    /// Angle of R in degrees.
    AngleDeg,
    /// Angle of R in rad.
    AngleRad,
    /// Difference of the distances between the two poses of a pair, scene units; for absolute errors the same as
    /// `Trans`.
    PointDistance,
    /// The same relative to the reference's distance, percent; for relative errors only.
    #[strum(to_string = "point_distance_ratio", serialize = "point_distance_error_ratio")]
    PointDistanceRatio,
}

impl Relation {
    /// Whether the errors are lengths in scene units.
    pub(crate) fn is_length(self) -> bool {
        matches!(self, Self::Trans | Self::PointDistance)
    }

    /// What is measured, with its unit.
    pub(crate) fn name_with_unit(self) -> &'static str {
        match self {
            Self::Full => "norm of the error pose",
            Self::Rot => "norm of the rotation",
            Self::Trans => "position, scene units",
            Self::PointDistance => "distance, scene units",
            Self::AngleDeg => "rotation, degrees",
            Self::AngleRad => "rotation, rad",
            Self::PointDistanceRatio => "distance, %",
        }
    }

    /// Unit of the errors; empty for norms of matrices.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Full | Self::Rot => "",
            Self::Trans | Self::PointDistance => "scene units",
            Self::AngleDeg => "degrees",
            Self::AngleRad => "rad",
            Self::PointDistanceRatio => "%",
        }
    }
}

/// A rigid transform whose matrix is never re-orthonormalized: the inverse transposes it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rigid {
    pub(super) rotation: DMat3,
    pub(super) translation: DVec3,
}

impl Rigid {
    /// `self^-1 * other`.
    pub(super) fn to(self, other: Self) -> Self {
        let back = self.rotation.transpose();
        let translation = back * other.translation - back * self.translation;
        Self { rotation: back * other.rotation, translation }
    }

    /// The error of this error pose by a relation.
    pub(super) fn error(self, relation: Relation) -> f64 {
        let off = || {
            let d = self.rotation - DMat3::IDENTITY;
            d.x_axis.length_squared() + d.y_axis.length_squared() + d.z_axis.length_squared()
        };
        match relation {
            Relation::Full => (off() + self.translation.length_squared()).sqrt(),
            Relation::Rot => off().sqrt(),
            Relation::AngleDeg => rotation_angle(self.rotation).to_degrees(),
            Relation::AngleRad => rotation_angle(self.rotation),
            Relation::Trans | Relation::PointDistance | Relation::PointDistanceRatio => self.translation.length(),
        }
    }
}
