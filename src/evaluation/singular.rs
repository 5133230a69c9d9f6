//! Singular value decomposition of a 3 x 3 matrix, and the rotation nearest to one.

use glam::{DMat3, DVec3};

/// Sweeps of rotations; one-sided Jacobi converges quadratically and needs about six.
const MAX_SWEEPS: usize = 60;

/// `matrix = u * diag(values) * v^T` with orthonormal `u` and `v` (either may be mirrored) and values that fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Singular {
    pub(super) u: DMat3,
    pub(super) values: DVec3,
    pub(super) v: DMat3,
}

/// Decomposes by one-sided Jacobi rotations of the columns (Hestenes 1958), which keeps small values accurate.
pub(super) fn singular(matrix: DMat3) -> Singular {
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
    Singular { u: completed(a, b, c, values), values, v: DMat3::from_cols(v[order[0]], v[order[1]], v[order[2]]) }
}

/// Orthonormal columns along `a`, `b`, `c`; those that are null next to the largest are made up.
fn completed(a: DVec3, b: DVec3, c: DVec3, values: DVec3) -> DMat3 {
    let floor = values.x * 1e-14;
    let first = a.try_normalize().unwrap_or(DVec3::X);
    let second = if values.y > floor { b.try_normalize() } else { None };
    let second = second.unwrap_or_else(|| first.any_orthonormal_vector());
    let third = if values.z > floor { c.try_normalize() } else { None };
    DMat3::from_cols(first, second, third.unwrap_or_else(|| first.cross(second)))
}

/// The rotation nearest to a matrix in the Frobenius norm (Kabsch): mirrored input gives the nearest proper rotation.
pub(super) fn nearest_rotation(matrix: DMat3) -> DMat3 {
    let Singular { u, v, .. } = singular(matrix);
    let handed = if u.determinant() * v.determinant() < 0.0 { -1.0 } else { 1.0 };
    u * DMat3::from_diagonal(DVec3::new(1.0, 1.0, handed)) * v.transpose()
}

/// Angle in 0..=pi of the rotation nearest to a matrix that is one but for rounding; exact near 0 and pi.
pub(super) fn rotation_angle(matrix: DMat3) -> f64 {
    cinesplat_geometry::rotation::angle(glam::DQuat::from_mat3(&nearest_rotation(matrix)))
}
