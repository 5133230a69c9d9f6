//! Singular value decomposition of a 3 x 3 matrix, and the nearest rotation to a matrix.

use glam::{DMat3, DVec3};

/// Largest number of sweeps. One-sided Jacobi converges quadratically and needs about six.
const MAX_SWEEPS: usize = 60;

/// `matrix = u * diag(values) * v^T` with orthonormal `u` and `v` (either may be mirrored) and descending values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Svd {
    pub(super) u: DMat3,
    pub(super) values: DVec3,
    pub(super) v: DMat3,
}

/// The decomposition by one-sided Jacobi rotations of the columns (Hestenes 1958), which is accurate for small values
/// too.
pub(super) fn svd(matrix: DMat3) -> Svd {
    let mut columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let mut v = [DVec3::X, DVec3::Y, DVec3::Z];
    for _ in 0..MAX_SWEEPS {
        let mut off = 0.0_f64;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let (alpha, beta) = (columns[p].length_squared(), columns[q].length_squared());
            let gamma = columns[p].dot(columns[q]);
            if gamma.abs() <= f64::EPSILON * (alpha * beta).sqrt() || gamma == 0.0 {
                continue;
            }
            off = off.max(gamma.abs());
            let zeta = (beta - alpha) / (2.0 * gamma);
            let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
            let cos = 1.0 / t.hypot(1.0);
            let sin = cos * t;
            for list in [&mut columns, &mut v] {
                let (a, b) = (list[p], list[q]);
                list[p] = a * cos - b * sin;
                list[q] = a * sin + b * cos;
            }
        }
        if off == 0.0 {
            break;
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| columns[*b].length().total_cmp(&columns[*a].length()));
    let [a, b, c] = order.map(|idx| columns[idx]);
    let values = DVec3::new(a.length(), b.length(), c.length());
    Svd { u: completed(a, b, c, values), values, v: DMat3::from_cols(v[order[0]], v[order[1]], v[order[2]]) }
}

/// Orthonormal columns along `a`, `b`, `c`. Columns that are null relative to the largest value are replaced.
fn completed(a: DVec3, b: DVec3, c: DVec3, values: DVec3) -> DMat3 {
    let floor = values.x * 1e-14;
    let first = a.try_normalize().unwrap_or(DVec3::X);
    let second = if values.y > floor { b.try_normalize() } else { None };
    let second = second.unwrap_or_else(|| first.any_orthonormal_vector());
    let third = if values.z > floor { c.try_normalize() } else { None };
    DMat3::from_cols(first, second, third.unwrap_or_else(|| first.cross(second)))
}

/// The nearest proper rotation to a matrix in the Frobenius norm (Kabsch 1976).
pub(super) fn nearest_rotation(matrix: DMat3) -> DMat3 {
    let Svd { u, v, .. } = svd(matrix);
    let handed = if u.determinant() * v.determinant() < 0.0 { -1.0 } else { 1.0 };
    u * DMat3::from_diagonal(DVec3::new(1.0, 1.0, handed)) * v.transpose()
}

/// Angle, 0..=pi rad, of a matrix that is a rotation up to rounding; accurate near 0 and pi.
pub(super) fn rotation_angle(matrix: DMat3) -> f64 {
    cinesplat_geometry::rotation::angle(glam::DQuat::from_mat3(&nearest_rotation(matrix)))
}
