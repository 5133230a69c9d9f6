//! Distances to matter, against sampled surfaces and brute-force scans.

use cinesplat::operator::{ClearanceIndex, SIGMA_LEVEL};
use cinesplat::scene::{Gaussians, SOLID_OPACITY};
use glam::{DVec3, Quat, Vec3};

use super::{add, bisected, brute_force};

/// Seeded random numbers.
pub(super) struct Dice(pub(super) u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Three numbers in -1..1.
    pub(super) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.roll(), self.roll(), self.roll()) * 2.0 - 1.0
    }

    fn rotation(&mut self) -> Quat {
        let v = self.vector();
        Quat::from_xyzw(v.x as f32, v.y as f32, v.z as f32, self.roll() as f32 + 0.01).normalize()
    }
}

/// Distance from `point` to the surface of the first Gaussian: a scan over all directions, then a pattern search from
/// the best one.
fn searched(gaussians: &Gaussians, point: DVec3) -> f64 {
    let semi_axes = gaussians.scales[0].as_dvec3() * SIGMA_LEVEL;
    let rotation = gaussians.rotations[0].as_dquat().normalize();
    let at = |u: DVec3| (gaussians.mean_world(0) + rotation * (semi_axes * u.normalize())).distance(point);
    let even = (0..4000).map(|i| {
        let y = 1.0 - 2.0 * (f64::from(i) + 0.5) / 4000.0;
        let (sin, cos) = (2.399_963_229_728_653 * f64::from(i)).sin_cos();
        DVec3::new((1.0 - y * y).sqrt() * cos, y, (1.0 - y * y).sqrt() * sin)
    });
    let mut best = even.min_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap();
    let mut step = 0.1;
    while step > 1e-12 {
        let moves = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis * step, axis * -step]);
        match moves.map(|by| (best + by).normalize()).min_by(|a, b| at(*a).total_cmp(&at(*b))) {
            Some(next) if at(next) < at(best) => best = next,
            _ => step *= 0.6,
        }
    }
    at(best)
}

#[test]
fn distances_to_needles_disks_and_balls_match_a_search_over_the_surface() {
    let mut dice = Dice(5);
    let shapes = [[0.3, 0.3, 0.3], [1.0, 0.4, 0.1], [1.0, 1e-3, 1e-3], [1.0, 1.0, 1e-4], [0.5, 0.02, 1e-6]];
    for shape in shapes {
        for _ in 0..12 {
            let mut gaussians = Gaussians::default();
            let scales = Vec3::from_array(shape.map(|s: f64| s as f32));
            add(&mut gaussians, dice.vector(), scales, dice.rotation(), 0.9);
            let index = ClearanceIndex::new(&gaussians);
            let point = gaussians.mean_world(0) + dice.vector() * 3.0;
            let got = index.nearest_within(point, f64::INFINITY).unwrap().distance;
            if bisected(&gaussians, 0, point) == 0.0 {
                assert_eq!(got, 0.0, "inside {shape:?}");
                continue;
            }
            let wanted = searched(&gaussians, point);
            // The search stops slightly above the minimum, more so along a needle.
            assert!(got <= wanted + 1e-9 && got >= wanted - 2e-4, "{shape:?}: {got} for {wanted}");
            let bisected = bisected(&gaussians, 0, point);
            assert!((got - bisected).abs() <= 1e-9 * (1.0 + bisected), "{shape:?}: {got} for {bisected}");
        }
    }
}

#[test]
fn a_gaussian_without_extent_is_a_point_and_a_flat_one_is_a_disk() {
    let mut gaussians = Gaussians::default();
    add(&mut gaussians, DVec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Quat::IDENTITY, 1.0);
    let index = ClearanceIndex::new(&gaussians);
    let nearest = index.nearest_within(DVec3::new(1.0, 2.0, 7.0), f64::INFINITY).unwrap();
    assert!((nearest.distance - 4.0).abs() < 1e-9);

    let mut gaussians = Gaussians::default();
    add(&mut gaussians, DVec3::ZERO, Vec3::new(2.0, 2.0, 0.0), Quat::IDENTITY, 1.0);
    let index = ClearanceIndex::new(&gaussians);
    let distance = |p: DVec3| index.nearest_within(p, f64::INFINITY).unwrap().distance;
    assert!((distance(DVec3::new(0.5, 0.5, 0.7)) - 0.7).abs() < 1e-6, "above the disk");
    assert!((distance(DVec3::new(4.0, 0.0, 0.0)) - 1.0).abs() < 1e-6, "beside the disk");
    assert!((distance(DVec3::new(2.9, 0.0, 1e-3)) - 1e-3).abs() < 1e-6, "just above its rim");
}

#[test]
fn the_nearest_ellipsoid_matches_a_brute_force_scan() {
    let mut dice = Dice(11);
    let mut gaussians = Gaussians { origin: DVec3::new(300.0, -20.0, 7.0), ..Gaussians::default() };
    for _ in 0..2500 {
        let size = 10.0_f64.powf(dice.roll() * 3.5 - 3.5);
        let scales = DVec3::new(dice.roll(), dice.roll(), dice.roll().powi(6)) * size;
        let (mean, rotation, opacity) = (dice.vector() * 4.0, dice.rotation(), dice.roll());
        add(&mut gaussians, mean, scales.as_vec3(), rotation, opacity as f32);
    }
    // One as large as the scene, and one far from it.
    add(&mut gaussians, DVec3::new(0.0, -6.0, 0.0), Vec3::new(4.0, 0.1, 4.0), Quat::IDENTITY, 0.9);
    add(&mut gaussians, DVec3::new(4000.0, 0.0, 0.0), Vec3::splat(0.5), Quat::IDENTITY, 0.9);
    let index = ClearanceIndex::new(&gaussians);
    let solid = gaussians.opacities.iter().filter(|&&opacity| opacity >= SOLID_OPACITY).count();
    assert_eq!(index.len(), solid);
    for i in 0..300 {
        let reach = if i % 10 == 0 { 60.0 } else { 5.0 };
        let point = gaussians.origin + dice.vector() * reach;
        let (wanted, _) = brute_force(&gaussians, point);
        let got = index.nearest_within(point, f64::INFINITY).unwrap();
        assert!((got.distance - wanted).abs() <= 1e-9 * (1.0 + wanted), "{point}: {} for {wanted}", got.distance);
        let own = bisected(&gaussians, got.gaussian_idx as usize, point);
        assert!((own - got.distance).abs() <= 1e-9 * (1.0 + own), "the index is not that of the nearest Gaussian");
        assert_eq!(index.nearest_within(point, wanted * 0.999), None, "none within less");
    }
}

#[test]
fn faint_gaussians_do_not_count_as_matter() {
    let mut gaussians = Gaussians::default();
    add(&mut gaussians, DVec3::ZERO, Vec3::ONE, Quat::IDENTITY, 0.49);
    let index = ClearanceIndex::new(&gaussians);
    assert!(index.is_empty());
    assert_eq!(index.nearest_within(DVec3::ZERO, f64::INFINITY), None);
}
