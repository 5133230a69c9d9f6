//! Limits on memory and work, and splats larger than the picture.

use cinesplat::render::{Limits, Quality, RenderSettings, Renderer};
use cinesplat::scene::Gaussians;
use glam::{Quat, Vec3};

use super::settings;
use crate::render::scenes::{camera, push};

/// Gray splats, one behind the other, each covering the picture.
fn full_screen(num_splats: usize) -> Gaussians {
    let mut scene = Gaussians::default();
    for idx in 0..num_splats {
        let mean = Vec3::new(0.0, 0.0, 2.0 + idx as f32 * 1e-5);
        push(&mut scene, mean, Vec3::splat(50.0), Quat::IDENTITY, (0.05, Vec3::splat(0.5)));
    }
    scene
}

#[test]
fn a_hundred_thousand_full_screen_splats_lose_no_tile_and_stay_within_the_memory_limit() {
    let scene = full_screen(100_000);
    let renderer = Renderer::new(&scene);
    let picture_bytes = 512 * 512 * 16;
    for (quality, max_memory_bytes) in [(Quality::Standard, 64 << 20), (Quality::Final, 64 << 20)] {
        let limits = Limits { max_memory_bytes, ..Limits::default() };
        let frame = renderer.render(&camera(512, 512), &RenderSettings { limits, ..settings(quality) }).unwrap();
        // Every pixel of every tile is blended up to the transmittance stop.
        assert!(frame.transmittance.iter().all(|&rest| rest > 0.0 && rest < 4e-3), "{quality:?}");
        assert!(frame.rgb.iter().all(|value| (value - 0.5).abs() < 2.5e-3), "{quality:?}");
        let held = renderer.memory_bytes() + picture_bytes;
        assert!(held <= max_memory_bytes, "{quality:?}: holds {held} of {max_memory_bytes} bytes");
    }
    for max_memory_bytes in [1 << 20, 8 << 20] {
        let limits = Limits { max_memory_bytes, ..Limits::default() };
        let over = renderer.render(&camera(512, 512), &RenderSettings { limits, ..settings(Quality::Final) });
        let error = over.unwrap_err();
        assert_eq!(error.code(), "RENDER-MEMORY");
    }
}

#[test]
fn work_above_the_limits_is_an_error_before_any_allocation() {
    let mut scene = Gaussians::default();
    for _ in 0..2_000 {
        push(&mut scene, Vec3::Z * 2.0, Vec3::splat(50.0), Quat::IDENTITY, (0.5, Vec3::ONE));
    }
    for quality in [Quality::Standard, Quality::Reference] {
        let render =
            |limits| Renderer::new(&scene).render(&camera(640, 360), &RenderSettings { limits, ..settings(quality) });
        let cost = render(Limits { max_pairs: 1_000, ..Limits::default() }).unwrap_err();
        assert_eq!(cost.code(), "RENDER-COST");
        let memory = render(Limits { max_memory_bytes: 10_000, ..Limits::default() }).unwrap_err();
        assert_eq!(memory.code(), "RENDER-MEMORY");
    }
}
