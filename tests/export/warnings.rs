//! Warnings name the properties that a format cannot hold, and nothing else.

use cinesplat::export::{Content, Format};

use super::sample_shot::{there_and_back, with_cut};

#[test]
fn every_loss_has_a_line() {
    let lines = |format: Format, name: &str| there_and_back(&with_cut(), format, name, Content::Keyframes).1.join("\n");
    let curve = "interpolates between keyframes with its own curve: export every frame for the path of the film";
    assert!(lines(Format::Gltf, "a.glb").ends_with(curve));
    insta::assert_snapshot!(lines(Format::Tum, "a.tum"), @r"
    tum holds no field of view: 35.000 to 50.000 degrees are lost
    tum holds no image size
    tum holds no focus distance
    tum holds no cuts: other programs may interpolate across them
    tum interpolates between keyframes with its own curve: export every frame for the path of the film
    ");
    insta::assert_snapshot!(lines(Format::Kitti, "a.kitti"), @r"
    kitti holds no times: only the order of the frames is kept
    kitti holds no field of view: 35.000 to 50.000 degrees are lost
    kitti holds no image size
    kitti holds no focus distance
    kitti holds no cuts: other programs may interpolate across them
    kitti interpolates between keyframes with its own curve: export every frame for the path of the film
    ");
    insta::assert_snapshot!(lines(Format::Usd, "a.usda"), @"usd interpolates between keyframes with its own curve: export every frame for the path of the film");
}

#[test]
fn a_lens_that_lichtfeld_would_clamp_is_named() {
    let mut wide = with_cut();
    wide.keyframes[0].fov_y_rad = 2.2;
    let (_, warnings, _folder) = there_and_back(&wide, Format::Lichtfeld, "a.json", Content::Sampled);
    assert!(warnings.iter().any(|line| line.contains("10 to 200 mm")), "{warnings:?}");
}
