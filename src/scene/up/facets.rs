//! Local planes of a scene, independent of the shapes of its Gaussians.
//!
//! Enters: patches. Leaves: one facet per cube of a regular grid, with the normal of a least-squares plane.

use glam::{DMat3, DVec3};

use super::sample::PatchSample;

/// Cubes per scene size.
const CUBES: f64 = 48.0;

/// Minimum number of patches per facet.
const MIN_PATCHES: usize = 6;

/// Ratio of thickness to width below which a facet is planar.
const FLATNESS: f64 = 0.25;

/// Ratio of width to the cube's side above which a facet can be planar.
const MIN_WIDTH: f64 = 0.08;

/// The patches of a cube.
#[derive(Debug, Clone, Copy)]
pub(super) struct Facet {
    /// Mean of the patches, relative to the center of the scene's core.
    pub(super) position: DVec3,
    /// Unit normal of arbitrary sign; zero if the patches do not lie in a plane.
    pub(super) normal: DVec3,
}

/// Facets of a sample, ordered by cube.
pub(super) fn find_facets(sample: &PatchSample) -> Vec<Facet> {
    let side = sample.size / CUBES;
    let cube = |p: DVec3| (p / side).floor().as_i64vec3().to_array();
    let mut by_cube: Vec<([i64; 3], DVec3)> = sample.patches.iter().map(|p| (cube(p.position), p.position)).collect();
    by_cube.sort_by_key(|(cube, _)| *cube);
    let groups = by_cube.chunk_by(|a, b| a.0 == b.0);
    groups.filter(|group| group.len() >= MIN_PATCHES).map(|group| facet(group, side)).collect()
}

fn facet(group: &[([i64; 3], DVec3)], side: f64) -> Facet {
    let points: Vec<DVec3> = group.iter().map(|(_, p)| *p).collect();
    let plane = fit_plane(&points);
    let is_planar = plane.thickness < FLATNESS * plane.width && plane.width > MIN_WIDTH * side;
    Facet { position: plane.middle, normal: if is_planar { plane.normal() } else { DVec3::ZERO } }
}

/// A least-squares plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// Mean of the points.
    pub(super) middle: DVec3,
    /// Principal axes of arbitrary signs, unit: the normal, then those within the plane, the longest last.
    pub(super) axes: [DVec3; 3],
    /// Standard deviation along the normal.
    pub(super) thickness: f64,
    /// Smaller standard deviation within the plane.
    pub(super) width: f64,
}

impl Plane {
    /// Unit normal of arbitrary sign.
    pub(super) fn normal(&self) -> DVec3 {
        self.axes[0]
    }
}

/// Fits a plane to points; without points it is z = 0.
pub(super) fn fit_plane(points: &[DVec3]) -> Plane {
    let n = points.len().max(1) as f64;
    let middle = points.iter().copied().sum::<DVec3>() / n;
    let outer = |d: DVec3| DMat3::from_cols(d * d.x, d * d.y, d * d.z);
    let covariance = points.iter().fold(DMat3::ZERO, |sum, p| sum + outer(*p - middle)) * (1.0 / n);
    let (vectors, values) = eigen(covariance);
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| values[*i].total_cmp(&values[*j]));
    let [least, second, _] = order;
    let deviation = |idx: usize| values[idx].max(0.0).sqrt();
    Plane {
        middle,
        axes: order.map(|idx| vectors.col(idx).normalize_or(DVec3::Z)),
        thickness: deviation(least),
        width: deviation(second),
    }
}

/// Eigenvectors (columns) and eigenvalues of a symmetric matrix, by Jacobi rotations (Golub and Van Loan, "Matrix
/// Computations", section 8.5).
fn eigen(symmetric: DMat3) -> (DMat3, DVec3) {
    let (mut a, mut vectors) = (symmetric, DMat3::IDENTITY);
    // Convergence is quadratic: six sweeps reach full precision.
    for _ in 0..6 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = a.col(q)[p];
            if off == 0.0 {
                continue;
            }
            let cot = (a.col(q)[q] - a.col(p)[p]) / (2.0 * off);
            let tan = cot.signum() / (cot.abs() + cot.hypot(1.0));
            let cos = 1.0 / tan.hypot(1.0);
            let mut turn = DMat3::IDENTITY;
            (turn.col_mut(p)[p], turn.col_mut(q)[q]) = (cos, cos);
            (turn.col_mut(q)[p], turn.col_mut(p)[q]) = (cos * tan, -cos * tan);
            a = turn.transpose() * a * turn;
            vectors *= turn;
        }
    }
    (vectors, DVec3::new(a.x_axis.x, a.y_axis.y, a.z_axis.z))
}
