use cinesplat::synth::{SynthKind, SynthScene, SynthSettings, generate};
use glam::{DMat3, DVec3};

use super::SCENES;

/// All numbers of a scene, as bits.
fn fingerprint(scene: &SynthScene) -> Vec<u32> {
    let g = &scene.gaussians;
    let vectors = g.means.iter().chain(&g.scales).chain(&g.sh_dc).chain(&g.sh_rest).flat_map(glam::Vec3::to_array);
    let rotations = g.rotations.iter().flat_map(glam::Quat::to_array);
    vectors.chain(rotations).chain(g.opacities.iter().copied()).map(f32::to_bits).collect()
}

#[test]
fn same_settings_give_the_same_bytes_on_any_number_of_threads() {
    let settings = SynthSettings { seed: 5, kind: SynthKind::Room, detail: 0.05 };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| generate(&settings))
    };
    let (one, three) = (on(1), on(3));
    assert_eq!(fingerprint(&one), fingerprint(&three));
    assert!(one == three, "scenes differ");
    assert_ne!(fingerprint(&one), fingerprint(&generate(&SynthSettings { seed: 6, ..settings })));
}

#[test]
fn all_values_are_finite_and_in_range() {
    for (seed, detail) in [(0, 0.02), (1, 0.2), (2, 0.5)] {
        let scene = generate(&SynthSettings { seed, kind: SynthKind::Tabletop, detail });
        let g = &scene.gaussians;
        let finite = |v: &glam::Vec3| v.is_finite();
        assert!(g.means.iter().all(finite) && g.sh_dc.iter().all(finite) && g.sh_rest.iter().all(finite));
        assert!(g.scales.iter().all(|s| s.is_finite() && s.min_element() > 0.0 && s.max_element() < 1.0));
        assert!(g.rotations.iter().all(|q| (q.length() - 1.0).abs() < 1e-4));
        assert!(g.opacities.iter().all(|o| (0.0..=1.0).contains(o)));
        assert_eq!(g.sh_rest.len(), g.len() * if g.sh_degree == 1 { 3 } else { 0 });
    }
}

/// Transmittance along a ray, from the maximum of each Gaussian along it.
fn transmittance(scene: &SynthScene, from: DVec3, direction: DVec3) -> f64 {
    let g = &scene.gaussians;
    let mut light = 1.0;
    for i in 0..g.len() {
        let offset = g.mean_world(i) - from;
        let reach = 4.0 * f64::from(g.scales[i].max_element());
        if offset.dot(direction) < 0.0 || offset.cross(direction).length_squared() > reach * reach {
            continue;
        }
        let to_own = DMat3::from_quat(g.rotations[i].as_dquat().conjugate());
        let scale = g.scales[i].as_dvec3();
        let (o, d) = (to_own * offset / scale, to_own * direction / scale);
        let closest = o - d * (o.dot(d) / d.length_squared());
        light *= 1.0 - (f64::from(g.opacities[i]) * (-0.5 * closest.length_squared()).exp()).min(0.99);
    }
    light
}

#[test]
fn walls_and_floor_are_opaque() {
    for seed in 0..3 {
        let scene = generate(&SynthSettings { seed, kind: SynthKind::Room, detail: 0.1 });
        let eye = scene.free_space[0];
        let mut worst: f64 = 0.0;
        // A spiral over all directions below 20 degrees of elevation; the ceiling may be invisible.
        for k in 0..400 {
            let height = -1.0 + 1.34 * (f64::from(k) + 0.5) / 400.0;
            let (sin, cos) = (f64::from(k) * 2.399_963).sin_cos();
            let level = (1.0 - height * height).sqrt();
            worst = worst.max(transmittance(&scene, eye, DVec3::new(cos * level, height, sin * level)));
        }
        assert!(worst < 0.08, "seed {seed}: a ray has a transmittance of {worst}");
    }
}

#[test]
fn surfels_are_flat() {
    let scene = &SCENES[2].1;
    let flat = scene.gaussians.scales.iter().filter(|s| s.z <= 0.5 * s.x.min(s.y) + 1e-3).count();
    assert!(flat * 100 > scene.gaussians.len() * 98);
}

#[test]
fn detail_sets_the_number_of_gaussians() {
    let count = |detail: f64| generate(&SynthSettings { seed: 3, kind: SynthKind::Tabletop, detail }).gaussians.len();
    let (coarse, fine) = (count(0.05), count(0.4));
    assert!(fine > 2 * coarse, "{coarse} at 0.05, {fine} at 0.4");
}
