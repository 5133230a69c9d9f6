//! Golden pictures, rendered by an independent `f64` rasterizer without tiles. `tests/render/golden` is part of every
//! clone; `../shared/data/golden` holds larger scenes that only some machines have.

use std::path::{Path, PathBuf};

use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat::scene::{self, Gaussians, LoadOptions};
use glam::{DQuat, DVec3, Quat, Vec3};

use super::pictures::{golden_set, npy, psnr_db};
use crate::support;

/// Golden sets that lie in one folder.
struct GoldenFolder {
    pictures: PathBuf,
    /// The folder that the scene paths are relative to.
    scenes: PathBuf,
    sets: &'static [&'static str],
}

/// One scene with both filters.
fn own() -> GoldenFolder {
    let pictures = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/render/golden");
    GoldenFolder { scenes: pictures.clone(), pictures, sets: &["fruit", "fruit_mip"] }
}

/// Four scenes, the kitchen with both filters.
fn shared() -> Option<GoldenFolder> {
    let pictures = support::shared("data/golden")?;
    let sets = &["kitchen", "kitchen_mip", "guitar", "leica", "edge"];
    Some(GoldenFolder { scenes: pictures.join(".."), pictures, sets })
}

/// Smallest PSNR in dB over the cameras of a golden set, for color and for transmittance.
fn worst_psnr_db(folder: &GoldenFolder, set: &str, quality: Quality) -> (f64, f64) {
    let golden = golden_set(&folder.pictures.join(format!("{set}.cameras.json")));
    let scene = scene::load(&folder.scenes.join(&golden.scene), &LoadOptions::default()).unwrap();
    let renderer = Renderer::new(&scene.gaussians);
    let settings = RenderSettings { quality, filter: golden.filter, near: golden.near, ..RenderSettings::default() };
    let mut worst = (f64::INFINITY, f64::INFINITY);
    for (name, camera) in &golden.cameras {
        let frame = renderer.render(camera, &settings).unwrap();
        let color = psnr_db(&frame.rgb, &npy(&folder.pictures.join(format!("{name}.npy"))));
        let transmittance = psnr_db(&frame.transmittance, &npy(&folder.pictures.join(format!("{name}.T.npy"))));
        eprintln!("{name} {}: color {color:.1} dB, transmittance {transmittance:.1} dB", quality.as_ref());
        worst = (worst.0.min(color), worst.1.min(transmittance));
    }
    worst
}

fn assert_reaches(folder: &GoldenFolder, quality: Quality, least_db: f64) {
    for set in folder.sets {
        let (color, transmittance) = worst_psnr_db(folder, set, quality);
        assert!(color >= least_db, "{set} {}: color {color:.2} dB, expected {least_db}", quality.as_ref());
        assert!(
            transmittance >= least_db,
            "{set} {}: transmittance {transmittance:.2} dB, expected {least_db}",
            quality.as_ref()
        );
    }
}

#[test]
fn reference_is_the_spec_image() {
    assert_reaches(&own(), Quality::Reference, 140.0);
}

#[test]
fn reference_is_the_spec_image_of_shared_scenes() {
    let Some(folder) = shared() else { return };
    assert_reaches(&folder, Quality::Reference, 100.0);
}

#[test]
fn final_has_a_psnr_of_105_db_against_the_spec_image() {
    assert_reaches(&own(), Quality::Final, 105.0);
}

#[test]
fn final_has_a_psnr_of_60_db_against_the_spec_image_of_shared_scenes() {
    let Some(folder) = shared() else { return };
    assert_reaches(&folder, Quality::Final, 60.0);
}

#[test]
fn standard_has_a_psnr_of_55_db_against_the_spec_image() {
    assert_reaches(&own(), Quality::Standard, 55.0);
}

#[test]
fn standard_has_a_psnr_of_50_db_against_the_spec_image_of_shared_scenes() {
    let Some(folder) = shared() else { return };
    assert_reaches(&folder, Quality::Standard, 50.0);
}

#[test]
fn four_splats_match_the_picture_of_the_cuda_rasterizer() {
    let Some(path) = support::shared("data/render_reference_gsplat/tiny_case.safetensors") else { return };
    let bytes = std::fs::read(path).unwrap();
    let tensors = safetensors::SafeTensors::deserialize(&bytes).unwrap();
    let floats = |name: &str| -> Vec<f32> {
        let data = tensors.tensor(name).unwrap().data().to_vec();
        data.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect()
    };
    let triples = |name: &str| -> Vec<Vec3> { floats(name).chunks_exact(3).map(Vec3::from_slice).collect() };
    let coefficients = triples("coeffs");
    let scene = Gaussians {
        means: triples("means"),
        scales: triples("scales").into_iter().map(Vec3::exp).collect(),
        rotations: floats("quats")
            .chunks_exact(4)
            .map(|q| Quat::from_xyzw(q[1], q[2], q[3], q[0]).normalize())
            .collect(),
        opacities: floats("opacities").into_iter().map(|logit| 1.0 / (1.0 + (-logit).exp())).collect(),
        sh_dc: coefficients.iter().copied().step_by(16).collect(),
        sh_degree: 3,
        sh_rest: coefficients.chunks_exact(16).flat_map(|bands| &bands[1..]).copied().collect(),
        ..Gaussians::default()
    };
    let pose = Pose::new(DVec3::new(0.123, 0.456, -8.0), DQuat::IDENTITY);
    let intrinsics = Intrinsics { width: 123, height: 82, fx_px: 61.5, fy_px: 61.5, cx_px: 61.5, cy_px: 41.0 };
    let expected: Vec<f32> = floats("out_img").chunks_exact(4).flat_map(|rgba| &rgba[..3]).copied().collect();
    for quality in [Quality::Reference, Quality::Final] {
        let settings = RenderSettings { quality, near: 0.01, ..RenderSettings::default() };
        let frame = Renderer::new(&scene).render(&Camera { pose, intrinsics }, &settings).unwrap();
        let db = psnr_db(&frame.rgb, &expected);
        assert!(db >= 60.0, "{}: {db:.1} dB", quality.as_ref());
    }
}
