//! The scenes of `../shared`: all of them load, and their counts, degrees and bounds match the manifest.

use cinesplat::scene::{LoadOptions, Scene, SplatFilter, load};
use glam::{DVec3, Vec3};

use crate::support;

fn shared_scene(name: &str) -> Option<Scene> {
    let path = support::shared(&format!("data/{name}"))?;
    Some(load(&path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}")))
}

/// Number of Gaussians, degree and bounds, as the manifest states them.
#[test]
fn counts_degrees_and_bounds_match_the_manifest() {
    let table = [
        ("kitchen/scene.spz", 213_944, 0, [-2.59, -0.07, -1.65], [2.95, 3.43, 1.50]),
        ("playbot/2_0", 125_000, 2, [-1.03, -1.08, -1.03], [1.03, 0.05, 1.04]),
        ("playbot/3_0", 31_000, 2, [-1.03, -1.08, -1.03], [1.03, 0.05, 1.04]),
        ("playbot/4_0", 8_406, 2, [-1.03, -1.08, -1.03], [1.03, 0.05, 1.04]),
        ("playbot/5_0", 3_000, 2, [-1.03, -1.08, -1.03], [1.03, 0.05, 1.04]),
        ("playbot/6_0", 1_873, 2, [-1.03, -1.08, -1.03], [1.03, 0.05, 1.04]),
        ("guitar/guitar.compressed.ply", 90_854, 0, [-0.66, -4.29, -0.53], [0.82, 0.09, 0.92]),
        ("skull/skull.sog", 94_936, 3, [-0.53, -1.09, -0.72], [0.49, 0.03, 0.79]),
        ("palm/centered_lastchance.splat", 14_007, 0, [-0.35, -0.50, -0.47], [0.35, 0.50, 0.43]),
    ];
    for (name, count, degree, min, max) in table {
        let Some(scene) = shared_scene(name) else { continue };
        assert_eq!((scene.gaussians.len(), scene.gaussians.sh_degree), (count, degree), "{name}");
        assert!(scene.dropped.is_empty() && scene.notes.is_empty(), "{name}: {:?}", scene.notes);
        let bounds = scene.bounds();
        // The smaller levels of playbot lack outermost Gaussians: 0.02.
        assert!(bounds.min.abs_diff_eq(DVec3::from_array(min), 0.02), "{name}: {}", bounds.min);
        assert!(bounds.max.abs_diff_eq(DVec3::from_array(max), 0.02), "{name}: {}", bounds.max);
    }
}

#[test]
fn all_other_scenes_load() {
    let table = [
        ("composites/kitchen_plus_dev.spz", 403_362),
        ("composites/livingroom_surfels.spz", 642_390),
        ("logo_sogv1", 307_128),
        ("corpus_cc0/leica-sofort/spz/leica-sofort-top8192.spz", 8192),
        ("format_fixtures/train-1000.ply", 1000),
        ("format_fixtures/minimal.splat", 4),
        ("golden/edge.ply", 4000),
    ];
    for (name, count) in table {
        let Some(scene) = shared_scene(name) else { continue };
        assert_eq!((scene.gaussians.len(), scene.dropped.len()), (count, 0), "{name}");
    }
}

#[test]
fn kitchen_states_the_mip_filter() {
    let Some(scene) = shared_scene("kitchen/scene.spz") else { return };
    assert_eq!(scene.filter, Some(SplatFilter::Mip));
}

/// The SOG was converted from the PLY: 16 bits per coordinate in the logarithmic domain, 8 bits per rotation component
/// and per opacity, 256 values for scales and colors, another order.
#[test]
fn leica_ply_and_sog_hold_the_same_gaussians() {
    let folder = "corpus_cc0/leica-sofort";
    let Some(ply) = shared_scene(&format!("{folder}/ply/leica-sofort-top8192.ply")) else { return };
    let Some(sog) = shared_scene(&format!("{folder}/sog/leica-sofort-top8192.sog")) else { return };
    let (a, b) = (&ply.gaussians, &sog.gaussians);
    assert_eq!((a.len(), a.sh_degree), (b.len(), b.sh_degree));
    let mut used = vec![false; b.len()];
    let mut worst = [0.0_f32; 4];
    for i in 0..a.len() {
        let (nearest, distance) = (0..b.len())
            .filter(|&j| !used[j])
            .map(|j| (j, cost(a, i, b, j)))
            .min_by(|x, y| x.1.total_cmp(&y.1))
            .unwrap();
        used[nearest] = true;
        let j = nearest;
        assert!(distance < 0.2, "Gaussian {i}: {distance}");
        let log = |v: Vec3| v.map(f32::ln);
        worst[0] = worst[0].max((a.means[i] - b.means[j]).abs().max_element() / (1.0 + a.means[i].abs().max_element()));
        worst[1] = worst[1].max((a.opacities[i] - b.opacities[j]).abs());
        worst[2] = worst[2].max(a.rotations[i].angle_between(b.rotations[j]));
        let scale = (log(a.scales[i]) - log(b.scales[j])).abs().max_element();
        worst[3] = worst[3].max(scale);
    }
    // The writer truncates instead of rounding, so errors reach a whole step: 5.7 log units / 65535, 1 / 255, and
    // 2 sqrt(3) sqrt(2) / 255 of an angle, up to twice that through the reconstructed component.
    assert!(worst[0] < 9e-5, "positions {}", worst[0]);
    assert!(worst[1] < 1.0 / 255.0, "opacities {}", worst[1]);
    assert!(worst[2] < 0.04, "rotations {} rad", worst[2]);
    assert!(worst[3] < 0.25, "log-scales {}", worst[3]);
}

/// Dissimilarity of two Gaussians: mainly by position, then by color.
fn cost(a: &cinesplat::scene::Gaussians, i: usize, b: &cinesplat::scene::Gaussians, j: usize) -> f32 {
    (a.means[i] - b.means[j]).length() * 100.0 + (a.sh_dc[i] - b.sh_dc[j]).length()
}
