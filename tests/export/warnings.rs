//! Warnings name the properties that a format cannot hold, and nothing else.

use cinesplat::export::{Content, Format};

use super::sample_shot::{there_and_back, with_cut};

#[test]
fn every_loss_has_a_line() {
    let lines = |format: Format, name: &str| there_and_back(&with_cut(), format, name, Content::Keyframes).1.join("\n");
    insta::assert_snapshot!(lines(Format::Tum, "a.tum"), @r"
    tum holds no field of view: 35.000 to 50.000 degrees are lost
    tum holds no image size
    tum holds no focus distance
    tum holds no cuts: other programs may interpolate across them
    ");
    insta::assert_snapshot!(lines(Format::Kitti, "a.kitti"), @r"
    kitti holds no times: only the order of the frames is kept
    kitti holds no field of view: 35.000 to 50.000 degrees are lost
    kitti holds no image size
    kitti holds no focus distance
    kitti holds no cuts: other programs may interpolate across them
    ");
    insta::assert_snapshot!(lines(Format::Usd, "a.usda"), @"usd joins keyframes with lines: up to 0.0000 scene units (at 0.50 s), 0.67 degrees and a field of view 0.53 degrees off the film; export every frame for the path of the film");
    insta::assert_snapshot!(lines(Format::Supersplat, "settings.json"), @r"
    supersplat holds no image size
    supersplat holds no focus distance
    supersplat holds no roll: up to 7.4 degrees relative to its up (-y) are lost
    supersplat joins keyframes with its own spline: up to 0.4207 scene units (at 0.67 s), 10.55 degrees and a field of view 0.37 degrees off the film; export every frame for the path of the film
    ");
    insta::assert_snapshot!(lines(Format::Cameras, "cameras.json"), @r"
    cameras holds no times: only the order of the frames is kept
    cameras holds no focus distance
    cameras holds no cuts: other programs may interpolate across them
    ");
}

#[test]
fn a_lens_that_lichtfeld_would_clamp_is_named() {
    let mut wide = with_cut();
    wide.keyframes[0].fov_y_rad = 2.2;
    let (_, warnings, _folder) = there_and_back(&wide, Format::Lichtfeld, "a.json", Content::Sampled);
    assert!(warnings.iter().any(|line| line.contains("10 to 200 mm")), "{warnings:?}");
}
