//! Local planes: what the surface looks like in each small cube of the scene, whatever shape its Gaussians have.

use glam::{DMat3, DVec3};

use super::sample::Sample;

/// Cubes across the scene size.
const CUBES: f64 = 48.0;

/// Fewest patches that make a facet.
const MIN_PATCHES: usize = 6;

/// Thickness over width below which a facet is planar.
const FLATNESS: f64 = 0.25;

/// Width over cube side above which its flatness means something.
const LEAST_WIDTH: f64 = 0.08;

/// The matter in one cube.
#[derive(Debug, Clone, Copy)]
pub(super) struct Facet {
    /// Mean of its patches, relative to the middle of the scene.
    pub(super) position: DVec3,
    /// Unit normal, of either sign; zero where the matter does not lie in a plane.
    pub(super) normal: DVec3,
}

/// Facets of a sample, in the order of their cubes.
pub(super) fn find(sample: &Sample) -> Vec<Facet> {
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
    let is_planar = plane.thickness < FLATNESS * plane.width && plane.width > LEAST_WIDTH * side;
    Facet { position: plane.middle, normal: if is_planar { plane.normal } else { DVec3::ZERO } }
}

/// The plane of least squares through some points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// Mean of the points.
    pub(super) middle: DVec3,
    /// Unit normal, of either sign.
    pub(super) normal: DVec3,
    /// Standard deviation across the plane.
    pub(super) thickness: f64,
    /// Smaller standard deviation along the plane.
    pub(super) width: f64,
}

/// Fits a plane to points; to none of them, the plane z = 0.
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
        normal: vectors.col(least).normalize_or(DVec3::Z),
        thickness: deviation(least),
        width: deviation(second),
    }
}

/// Eigenvectors (columns) and eigenvalues of a symmetric matrix: Jacobi's rotations, each of which clears one entry off
/// the diagonal (Golub and Van Loan, "Matrix Computations", section 8.5).
fn eigen(symmetric: DMat3) -> (DMat3, DVec3) {
    let (mut a, mut vectors) = (symmetric, DMat3::IDENTITY);
    // Convergence is quadratic: six sweeps reach the last bit.
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
