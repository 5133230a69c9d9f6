//! Logarithm, exponential, angle and 6D representation of rotations, accurate near 0 and near 180 degrees.

use glam::{DMat3, DQuat, DVec3};

use super::GeometryError;

/// Largest difference between an element of `R^T R` and of the identity for a matrix that counts as a rotation.
const ORTHONORMAL_TOLERANCE: f64 = 1e-3;

/// Angle of a rotation, 0..=pi rad. Accurate near 0, where an arc cosine returns 0.
pub fn angle(rotation: DQuat) -> f64 {
    2.0 * rotation.xyz().length().atan2(rotation.w.abs())
}

/// An angle as a turn of at most half a circle either way, -pi..pi rad.
pub fn short_turn(angle_rad: f64) -> f64 {
    (angle_rad + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
}

/// Angle of the smallest rotation from `a` to `b`, 0..=pi rad.
pub fn angle_between(a: DQuat, b: DQuat) -> f64 {
    angle(a.conjugate() * b)
}

/// Rotation vector (unit axis times angle in rad) of length 0..=pi. At exactly pi it is one of the two opposite
/// vectors.
pub fn log(rotation: DQuat) -> DVec3 {
    let short = if rotation.w < 0.0 { -rotation } else { rotation };
    let sine = short.xyz().length();
    // angle / sin(angle / 2) tends to 2 at the identity, where the quotient is 0 / 0.
    let scale = if sine > 0.0 { 2.0 * sine.atan2(short.w) / sine } else { 2.0 };
    short.xyz() * scale
}

/// The rotation about `vector` by an angle of its length in rad.
pub fn exp(vector: DVec3) -> DQuat {
    let half = vector.length() / 2.0;
    // sin(x) / (2 x), and its limit at 0.
    let scale = if half > 0.0 { half.sin() / (2.0 * half) } else { 0.5 };
    DQuat::from_xyzw(vector.x * scale, vector.y * scale, vector.z * scale, half.cos()).normalize()
}

/// Spherical interpolation along the shorter arc: `a` at `t = 0`, `b` at `t = 1`. The signs of the quaternions do not
/// matter: `slerp(a, -b, t)` equals `slerp(a, b, t)`.
pub fn slerp(a: DQuat, b: DQuat, t: f64) -> DQuat {
    (a * exp(log(a.conjugate() * b) * t)).normalize()
}

/// The quaternions with signs chosen so that neighbors lie in the same hemisphere.
pub fn aligned(rotations: &[DQuat]) -> Vec<DQuat> {
    let mut out: Vec<DQuat> = Vec::with_capacity(rotations.len());
    for &rotation in rotations {
        let flip = out.last().is_some_and(|last| last.dot(rotation) < 0.0);
        out.push(if flip { -rotation } else { rotation });
    }
    out
}

/// The quaternion of a 3 x 3 matrix that is a rotation up to rounding.
///
/// # Errors
/// [`GeometryError::NotARotation`] if the matrix is mirrored, scaled, sheared or not finite.
pub fn from_matrix(matrix: DMat3) -> Result<DQuat, GeometryError> {
    let gram = matrix.transpose() * matrix - DMat3::IDENTITY;
    let off = gram.to_cols_array().iter().fold(0.0_f64, |worst, v| worst.max(v.abs()));
    let determinant = matrix.determinant();
    // NaN fails.
    if !(off <= ORTHONORMAL_TOLERANCE && determinant > 0.0) {
        return Err(GeometryError::NotARotation {
            reason: format!("R^T R is off the identity by {off:.3e}, determinant {determinant:.3e}"),
        });
    }
    Ok(DQuat::from_mat3(&matrix).normalize())
}

/// The first two columns of the rotation matrix: the continuous 6D representation (Zhou et al. 2019).
pub fn to_6d(rotation: DQuat) -> [f64; 6] {
    let m = DMat3::from_quat(rotation);
    [m.x_axis.x, m.x_axis.y, m.x_axis.z, m.y_axis.x, m.y_axis.y, m.y_axis.z]
}

/// The rotation of a 6D representation, by Gram-Schmidt. Defined for every input: axes of `fallback` replace null or
/// parallel columns.
pub fn from_6d(rotation_6d: [f64; 6], fallback: DQuat) -> DQuat {
    let fallback_axes = DMat3::from_quat(fallback);
    let [a, b, c, d, e, f] = rotation_6d;
    let x = DVec3::new(a, b, c).try_normalize().unwrap_or(fallback_axes.x_axis);
    let second = DVec3::new(d, e, f).try_normalize().unwrap_or(fallback_axes.y_axis);
    let off_axis = |v: DVec3| Some(v - x * v.dot(x)).filter(|r| r.length() > 1e-4).and_then(DVec3::try_normalize);
    let y = off_axis(second).or_else(|| off_axis(fallback_axes.y_axis)).unwrap_or_else(|| x.any_orthonormal_vector());
    DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))).normalize()
}
