//! Settings that suit a scene.

use std::path::PathBuf;

use cinesplat::render::RenderSettings;
use cinesplat::scene::{Scene, SplatFilter, UpSource};
use glam::{DVec3, Quat, Vec3};

use super::scenes::push;

/// A scene of two solid Gaussians at this distance from each other, whose file states this filter.
fn scene(distance: f32, filter: Option<SplatFilter>) -> Scene {
    let mut gaussians = cinesplat::scene::Gaussians::default();
    for x in [0.0, distance] {
        push(&mut gaussians, Vec3::X * x, Vec3::splat(0.1), Quat::IDENTITY, (1.0, Vec3::ONE));
    }
    let (up, up_source) = (DVec3::Y, UpSource::Flag);
    let (path, sha256, format) = (PathBuf::new(), String::new(), String::new());
    Scene { path, sha256, format, gaussians, dropped: Vec::new(), filter, up, up_source, notes: Vec::new() }
}

#[test]
fn settings_for_a_scene_have_its_filter_and_a_near_plane_for_its_size() {
    let small = RenderSettings::for_scene(&scene(1.0, Some(SplatFilter::MipSmall)));
    assert_eq!(small.filter, SplatFilter::MipSmall);
    // 0.01 of the distance between the percentiles 2 and 98.
    assert!((small.near - 0.0096).abs() < 1e-6, "{}", small.near);
    let large = RenderSettings::for_scene(&scene(1000.0, None));
    assert_eq!(large, RenderSettings { filter: SplatFilter::Classic, near: 0.2, ..RenderSettings::default() });
}
