//! The lens that a scan states for its own camera, in films.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::path::Path;

use cinesplat::export::{self, EncodedFiles, ExportSettings, Format, ImportSettings, shot_json};
use cinesplat::pipeline::{FilmSettings, film};
use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{LensModel, LensProjection, Shot};
use glam::{DVec3, Quat, Vec3};

/// Directions of balls, at depth 1.
const PLACES: [[f64; 2]; 3] = [[0.0, 0.0], [0.7, 0.3], [-0.6, 0.4]];

/// White balls of 0.02 units at the places, four units ahead.
fn balls(places: &[[f64; 2]]) -> Gaussians {
    let num = places.len();
    Gaussians {
        means: places.iter().map(|[x, y]| (DVec3::new(*x, *y, 1.0) * 4.0).as_vec3()).collect(),
        scales: vec![Vec3::splat(0.02); num],
        rotations: vec![Quat::IDENTITY; num],
        opacities: vec![0.99; num],
        sh_dc: vec![Vec3::splat(0.5 / 0.282_094_8); num],
        ..Gaussians::default()
    }
}

/// The shot of a camera path in a file.
fn imported(name: &str, text: &str, beside: Option<(&str, &str)>) -> (Shot, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), text).unwrap();
    if let Some((name, text)) = beside {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let imported = export::read(&folder.path().join(name), None).unwrap();
    imported.into_shot(&ImportSettings::default()).unwrap()
}

/// Mean position of the light in each frame of a film.
fn centers(scene: &Gaussians, shot: &Shot) -> Vec<[f64; 2]> {
    let folder = tempfile::tempdir().unwrap();
    let render = RenderSettings { quality: Quality::Final, near: 0.01, ..RenderSettings::default() };
    let settings = FilmSettings { render, ..FilmSettings::default() };
    let pattern = folder.path().join("%03d.png");
    film(&Renderer::new(scene), shot, &pattern, &settings, &mut |_| ControlFlow::Continue(())).unwrap();
    (0..shot.num_frames()).map(|idx| center(&folder.path().join(format!("{idx:03}.png")))).collect()
}

fn center(picture: &Path) -> [f64; 2] {
    let (mut sum, mut at) = (0.0, [0.0, 0.0]);
    for (x, y, pixel) in image::open(picture).unwrap().to_luma8().enumerate_pixels() {
        let value = f64::from(pixel.0[0]);
        sum += value;
        at[0] += value * (f64::from(x) + 0.5);
        at[1] += value * (f64::from(y) + 0.5);
    }
    at.map(|part| part / sum)
}

/// Films each ball alone, and compares its place with the one that the file's camera gives it.
fn check(shot: &Shot, pixel_of: impl Fn([f64; 2]) -> [f64; 2]) {
    for place in PLACES {
        let ([x, y], [wanted_x, wanted_y]) = (centers(&balls(&[place]), shot)[0], pixel_of(place));
        let off_px = (x - wanted_x).hypot(y - wanted_y);
        assert!(off_px < 0.3, "{place:?}: at {x} {y}, expected {wanted_x} {wanted_y}");
    }
}

/// `cv::projectPoints` (k1 k2 k3 k4 k5 k6, p1 p2), before the focal lengths.
fn opencv([x, y]: [f64; 2], [k1, k2, k3, k4, k5, k6]: [f64; 6], [p1, p2]: [f64; 2]) -> [f64; 2] {
    let r2 = x * x + y * y;
    let radial =
        (1.0 + k1 * r2 + k2 * r2.powi(2) + k3 * r2.powi(3)) / (1.0 + k4 * r2 + k5 * r2.powi(2) + k6 * r2.powi(3));
    [x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x), y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y]
}

/// `cv::fisheye::projectPoints`, before the focal lengths.
fn fisheye([x, y]: [f64; 2], [k1, k2, k3, k4]: [f64; 4]) -> [f64; 2] {
    let distance = x.hypot(y);
    let angle = distance.atan();
    let t2 = angle * angle;
    let bent = angle * (1.0 + k1 * t2 + k2 * t2.powi(2) + k3 * t2.powi(3) + k4 * t2.powi(4));
    let scale = if distance > 0.0 { bent / distance } else { 1.0 };
    [x * scale, y * scale]
}

const AT_ORIGIN: &str =
    r#""frames":[{"file_path":"a.png","transform_matrix":[[1,0,0,0],[0,-1,0,0],[0,0,-1,0],[0,0,0,1]]}]"#;

/// The distortion, the principal point and the second focal length were dropped with a line each.
#[test]
fn a_film_of_a_scan_with_a_distorted_lens_does_not_match_its_images() {
    let lens = r#""camera_model":"OPENCV","w":320,"h":180,"fl_x":168,"fl_y":160,"cx":167,"cy":84,"k1":-0.12,"k2":0.03,"p1":0.004,"p2":-0.006"#;
    let (shot, lines) = imported("transforms.json", &format!("{{{lens},{AT_ORIGIN}}}"), None);
    assert_eq!(lines.iter().filter(|line| line.contains("not read")).count(), 0, "{lines:?}");
    check(&shot, |place| {
        let [x, y] = opencv(place, [-0.12, 0.03, 0.0, 0.0, 0.0, 0.0], [0.004, -0.006]);
        [167.0 + 168.0 * x, 84.0 + 160.0 * y]
    });
    // The way through a file of the program's own.
    let again = shot_json::read(&shot_json::write(&shot)).unwrap();
    let values = |shot: &Shot| shot.effects[0].settings.iter().cloned().collect::<HashMap<String, f64>>();
    assert_eq!((values(&again.shot), again.notes), (values(&shot), Vec::new()));
}

#[test]
fn colmap_cameras_with_rational_and_fisheye_lenses_keep_them() {
    let images = "1 1 0 0 0 0 0 0 1 a.png\n\n";
    let camera = "1 FULL_OPENCV 320 180 168 160 167 84 -0.1 0.03 0.004 -0.006 0.01 0.05 -0.02 0.003\n";
    let (shot, _) = imported("images.txt", images, Some(("cameras.txt", camera)));
    check(&shot, |place| {
        let [x, y] = opencv(place, [-0.1, 0.03, 0.01, 0.05, -0.02, 0.003], [0.004, -0.006]);
        [167.0 + 168.0 * x, 84.0 + 160.0 * y]
    });
    let camera = "1 OPENCV_FISHEYE 320 180 120 118 163 92 0.05 -0.02 0.004 -0.001\n";
    let (shot, lines) = imported("images.txt", images, Some(("cameras.txt", camera)));
    assert_eq!(lines.iter().filter(|line| line.contains("pinhole")).count(), 0, "{lines:?}");
    check(&shot, |place| {
        let [x, y] = fisheye(place, [0.05, -0.02, 0.004, -0.001]);
        [163.0 + 120.0 * x, 92.0 + 118.0 * y]
    });
}

#[test]
fn images_with_different_lenses_give_no_effect_and_a_line() {
    let images = "1 1 0 0 0 0 0 0 1 a.png\n\n2 1 0 0 0 0 0 0.1 2 b.png\n\n";
    let cameras = "1 SIMPLE_RADIAL 320 180 160 160 90 -0.1\n2 SIMPLE_RADIAL 320 180 160 160 90 -0.2\n";
    let (shot, lines) = imported("images.txt", images, Some(("cameras.txt", cameras)));
    assert!(shot.effects.is_empty());
    insta::assert_snapshot!(lines.join("\n"), @r"
    the images have different lenses, and a path without cuts has one
    the lens distortion is not read (largest coefficient: a parameter -0.2000)
    the file has no times: 30 frames per second are assumed
    the file has no world up: the shot states none
    ");
    // A model that cannot be shown is a loss, too.
    let (shot, lines) = imported(
        "images.txt",
        "1 1 0 0 0 0 0 0 1 a.png\n\n",
        Some(("cameras.txt", "1 FOV 320 180 160 160 160 90 0.9\n")),
    );
    assert!(shot.effects.is_empty());
    insta::assert_snapshot!(lines.join("\n"), @r"
    the lens model FOV is read as a pinhole of the same focal length
    the lens distortion is not read (largest coefficient: a parameter 0.9000)
    the file has no times: 30 frames per second are assumed
    the file has no world up: the shot states none
    ");
}

/// A shot of two seconds with a cut after one, and the lenses of its four keys.
fn two_parts(lenses: [&str; 4]) -> String {
    let key = |(at, lens): (usize, &str)| {
        let cut = at == 2;
        let lens = if lens.is_empty() { String::new() } else { format!(r#","lens":{lens}"#) };
        format!(
            r#"{{"time_secs":{},"position":[0,0,0],"rotation_xyzw":[0,0,0,1],"fov_y_deg":50,"easing":"linear","cut":{cut}{lens}}}"#,
            [0.0, 0.9, 1.0, 2.0][at]
        )
    };
    let keys: Vec<String> = lenses.into_iter().enumerate().map(key).collect();
    format!(
        r#"{{"format":"cinesplat.shot","version":1,"width":160,"height":90,"fps":2,"duration_secs":2,"keyframes":[{}]}}"#,
        keys.join(",")
    )
}

#[test]
fn each_part_between_cuts_has_the_lens_of_its_keyframes() {
    let text = two_parts(["", r#"{"model":"opencv","k1":-0.15}"#, r#"{"model":"opencv-fisheye","stretch":1.1}"#, ""]);
    let shot = shot_json::read(&text).unwrap().shot;
    assert_eq!(shot_json::read(&shot_json::write(&shot)).unwrap().shot, shot);
    let lens = shot.keyframes[2].optics.lens.unwrap();
    assert_eq!(lens, LensModel { projection: LensProjection::OpencvFisheye, stretch: 1.1, ..LensModel::default() });
    let place = [0.5, 0.2];
    let focal_px = 45.0 / 25.0_f64.to_radians().tan();
    let bent = opencv(place, [-0.15, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0]);
    let [across, down] = fisheye(place, [0.0; 4]);
    let wanted = [bent, bent, [1.1 * across, down], [1.1 * across, down]];
    for ([x, y], [wanted_x, wanted_y]) in centers(&balls(&[place]), &shot).into_iter().zip(wanted) {
        let (wanted_x, wanted_y) = (80.0 + focal_px * wanted_x, 45.0 + focal_px * wanted_y);
        assert!((x - wanted_x).hypot(y - wanted_y) < 0.3, "{x} {y}, expected {wanted_x} {wanted_y}");
    }
    // A part that states no lens has that of the effects: here none.
    let shot = shot_json::read(&two_parts(["", "", r#"{"k1":-0.15}"#, ""])).unwrap().shot;
    let found = centers(&balls(&[place]), &shot);
    assert!((found[0][0] - (80.0 + focal_px * place[0])).abs() < 0.3, "{found:?}");
    assert!((found[2][0] - (80.0 + focal_px * bent[0])).abs() < 0.3, "{found:?}");
}

#[test]
fn two_lenses_without_a_cut_between_them_are_refused_with_their_place() {
    let refused = |lenses: [&str; 4]| shot_json::read(&two_parts(lenses)).unwrap_err().to_string();
    let (one, other) = (r#"{"k1":-0.15}"#, r#"{"k1":-0.2}"#);
    insta::assert_snapshot!(refused([one, other, "", ""]), @"keyframe 1: lens is another lens than that of keyframe 0, expected one lens from cut to cut");
    insta::assert_snapshot!(refused(["", "", r#"{"stretch":0}"#, ""]), @"keyframe 2: lens is 0, expected a stretch above 0");
    insta::assert_snapshot!(refused([r#"{"model":"tilted"}"#, "", "", ""]), @r#"keyframes[0].lens.model: found "tilted", expected one of opencv, opencv-fisheye"#);
    assert!(shot_json::read(&two_parts([one, one, other, other])).is_ok());
    let notes = shot_json::read(&two_parts([r#"{"k7":1}"#, "", "", ""])).unwrap().notes;
    insta::assert_snapshot!(notes.join("\n"), @"keyframes[0].lens.k7: unknown key, the nearest known key is k1");
}

#[test]
fn sampled_keys_keep_the_lens_of_their_part() {
    let shot = shot_json::read(&two_parts(["", r#"{"k1":-0.15}"#, "", ""])).unwrap().shot;
    let encoded = |format: Format| export::encode(format, &shot, &ExportSettings::default()).unwrap();
    let EncodedFiles::Single(bytes) = encoded(Format::Shot).files else { panic!("one file") };
    let sampled = shot_json::read(std::str::from_utf8(&bytes).unwrap()).unwrap().shot;
    let k1 = |idx: usize| sampled.keyframes[idx].optics.lens.map(|lens| lens.radial[0]);
    assert_eq!([k1(0), k1(1), k1(2), k1(3)], [Some(-0.15), Some(-0.15), None, None]);
    let losses = encoded(Format::Tum).losses;
    assert!(losses.contains(&"tum holds no effects: lens-distortion are lost".to_owned()), "{losses:?}");
}
