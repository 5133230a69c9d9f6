//! Values from files: NaN, quaternions of any length, large coordinates in double precision, all kinds of PLY.

use std::path::Path;

use cinesplat::geometry::Camera;
use cinesplat::render::{Quality, Renderer};
use cinesplat::scene::{Gaussians, LoadOptions, Scene, load_bytes};
use glam::{DVec3, Quat, Vec3};

use super::{picture, settings};
use crate::render::pictures::psnr_db;
use crate::render::scenes::{camera, crowd, moved, push, single};

/// Column names and rows of a PLY of these Gaussians, encoded as in training: logarithms of scales, logits of
/// opacities, coefficients channel by channel. Values are exact in single precision.
fn rows(scene: &Gaussians) -> (Vec<String>, Vec<Vec<f64>>) {
    let num_rest = scene.sh_rest.len() / scene.len();
    let names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2"]
        .into_iter()
        .chain(["rot_0", "rot_1", "rot_2", "rot_3"])
        .map(str::to_owned)
        .chain((0..3 * num_rest).map(|idx| format!("f_rest_{idx}")));
    let row = |idx: usize| {
        let (opacity, q) = (scene.opacities[idx], scene.rotations[idx]);
        let mut row: Vec<f32> = scene.means[idx].to_array().to_vec();
        row.extend(scene.sh_dc[idx].to_array());
        row.push((opacity / (1.0 - opacity)).ln());
        row.extend(scene.scales[idx].to_array().map(f32::ln));
        row.extend([q.w, q.x, q.y, q.z]);
        let rest = &scene.sh_rest[idx * num_rest..][..num_rest];
        row.extend((0..3).flat_map(|channel| rest.iter().map(move |value| value[channel])));
        row.into_iter().map(f64::from).collect()
    };
    (names.collect(), (0..scene.len()).map(row).collect())
}

/// How a PLY is written.
#[derive(Clone, Copy)]
struct Layout {
    is_double: bool,
    is_big_endian: bool,
    /// An element before and one after the Gaussians, and an unknown column.
    has_extras: bool,
}

const PLAIN: Layout = Layout { is_double: false, is_big_endian: false, has_extras: false };

fn ply(names: &[String], rows: &[Vec<f64>], layout: Layout) -> Vec<u8> {
    let endian = if layout.is_big_endian { "big" } else { "little" };
    let scalar = if layout.is_double { "double" } else { "float" };
    let mut header = format!("ply\nformat binary_{endian}_endian 1.0\n");
    if layout.has_extras {
        header += "element camera 2\nproperty uchar kind\n";
    }
    header.extend(["element vertex ", &rows.len().to_string(), "\n"]);
    if layout.has_extras {
        header += "property uchar confidence\n";
    }
    header.extend(names.iter().flat_map(|name| ["property ", scalar, " ", name, "\n"]));
    header += if layout.has_extras { "element face 1\nproperty list uchar uchar corners\n" } else { "" };
    let mut bytes = (header + "end_header\n").into_bytes();
    bytes.extend(if layout.has_extras { &[7_u8, 8][..] } else { &[] });
    for row in rows {
        bytes.extend(if layout.has_extras { &[9_u8][..] } else { &[] });
        for &value in row {
            match (layout.is_double, layout.is_big_endian) {
                (false, false) => bytes.extend((value as f32).to_le_bytes()),
                (false, true) => bytes.extend((value as f32).to_be_bytes()),
                (true, false) => bytes.extend(value.to_le_bytes()),
                (true, true) => bytes.extend(value.to_be_bytes()),
            }
        }
    }
    bytes.extend(if layout.has_extras { &[3_u8, 0, 1, 2][..] } else { &[] });
    bytes
}

fn read(bytes: &[u8]) -> Scene {
    load_bytes(Path::new("scene.ply"), bytes, &LoadOptions::default()).unwrap()
}

fn drawn(scene: &Scene, view: &Camera, quality: Quality) -> Vec<f32> {
    picture(&scene.gaussians, view, quality).rgb
}

#[test]
fn files_of_the_same_gaussians_draw_the_same_picture() {
    let view = camera(120, 80);
    let (names, values) = rows(&crowd(300, 43));
    let plain = read(&ply(&names, &values, PLAIN));
    for quality in [Quality::Standard, Quality::Reference] {
        let expected = drawn(&plain, &view, quality);
        assert!(expected.iter().any(|&value| value > 0.3));
        for bits in 1..8 {
            let layout = Layout { is_double: bits & 1 != 0, is_big_endian: bits & 2 != 0, has_extras: bits & 4 != 0 };
            assert!(drawn(&read(&ply(&names, &values, layout)), &view, quality) == expected, "layout {bits:b}");
        }
    }
}

#[test]
fn a_file_without_f_rest_draws_as_one_with_zeros() {
    let view = camera(120, 80);
    let mut scene = crowd(300, 44);
    scene.sh_rest.fill(Vec3::ZERO);
    let (names, values) = rows(&scene);
    let short: Vec<Vec<f64>> = values.iter().map(|row| row[..14].to_vec()).collect();
    let (with, without) = (read(&ply(&names, &values, PLAIN)), read(&ply(&names[..14], &short, PLAIN)));
    assert_eq!((with.gaussians.sh_degree, without.gaussians.sh_degree), (3, 0));
    for quality in [Quality::Standard, Quality::Reference] {
        assert!(drawn(&with, &view, quality) == drawn(&without, &view, quality), "{quality:?}");
    }
}

#[test]
fn quaternions_of_any_length_and_sign_draw_alike() {
    let view = camera(120, 80);
    let (names, values) = rows(&crowd(300, 45));
    let times = |factor: f64| {
        let scaled: Vec<Vec<f64>> = values
            .iter()
            .map(|row| {
                row.iter().enumerate().map(|(idx, v)| if (10..14).contains(&idx) { v * factor } else { *v }).collect()
            })
            .collect();
        read(&ply(&names, &scaled, Layout { is_double: true, ..PLAIN }))
    };
    for quality in [Quality::Final, Quality::Reference] {
        let expected = drawn(&times(1.0), &view, quality);
        for factor in [7.0, -1.0, -7.0, 1e-3] {
            assert!(drawn(&times(factor), &view, quality) == expected, "times {factor}, {quality:?}");
        }
    }
}

#[test]
fn a_zero_quaternion_is_dropped_and_counted() {
    let view = camera(120, 80);
    let (names, mut values) = rows(&crowd(100, 46));
    let expected = drawn(&read(&ply(&names, &values, PLAIN)), &view, Quality::Final);
    let mut zero = values[5].clone();
    zero[10..14].fill(0.0);
    values.insert(50, zero);
    let scene = read(&ply(&names, &values, PLAIN));
    assert_eq!(scene.notes, ["1 dropped: rotation is zero or not finite"]);
    assert!(drawn(&scene, &view, Quality::Final) == expected);
}

#[test]
fn every_property_of_a_file_takes_any_number() {
    const POISON: [f64; 22] = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.0,
        -0.0,
        1e-45,
        -1e-45,
        1e-40,
        1.2e-38,
        88.0,
        -88.0,
        1e4,
        -1e4,
        1e10,
        -1e10,
        1e20,
        -1e20,
        1e30,
        1e38,
        -1e38,
        3.4e38,
        -3.4e38,
    ];
    let view = camera(48, 32);
    let mut scene = crowd(60, 47);
    (scene.sh_degree, scene.sh_rest) = (0, Vec::new());
    let (names, values) = rows(&scene);
    let clean =
        [Quality::Final, Quality::Reference].map(|quality| drawn(&read(&ply(&names, &values, PLAIN)), &view, quality));
    for (slot, poison) in (0..names.len()).flat_map(|slot| POISON.map(|poison| (slot, poison))) {
        let mut poisoned = values.clone();
        poisoned.push(values[7].clone());
        poisoned[60][slot] = poison;
        let scene = read(&ply(&names, &poisoned, PLAIN));
        for (quality, clean) in [Quality::Final, Quality::Reference].into_iter().zip(&clean) {
            let found = drawn(&scene, &view, quality);
            let place = format!("{} = {poison:e}, {quality:?}", names[slot]);
            assert!(found.iter().all(|value| value.is_finite() && *value >= 0.0), "{place}");
            if !scene.dropped.is_empty() {
                assert_eq!(scene.dropped, [60], "{place}");
                assert!(found == *clean, "{place}");
            }
        }
        assert_eq!(scene.dropped.is_empty(), is_drawable(&names[slot], poison), "{} = {poison:e}", names[slot]);
    }
}

/// Whether a Gaussian with this value in this column can be drawn. An infinite logit is an opacity of 1 or 0, a log
/// scale of minus infinity is flat, and a finite log scale whose exponential overflows is clamped.
fn is_drawable(name: &str, value: f64) -> bool {
    match name {
        "opacity" => !value.is_nan(),
        name if name.starts_with("scale") => value < f64::INFINITY,
        _ => value.is_finite(),
    }
}

#[test]
fn poisoned_gaussians_change_nothing() {
    let clean = crowd(500, 2);
    let view = camera(160, 90);
    let poison = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for quality in [Quality::Final, Quality::Reference] {
        let expected = picture(&clean, &view, quality);
        for (slot, &value) in (0..6).flat_map(|slot| poison.iter().map(move |value| (slot, value))) {
            let mut scene = clean.clone();
            push(&mut scene, Vec3::Z * 2.0, Vec3::splat(0.3), Quat::IDENTITY, (0.9, Vec3::ONE));
            scene.sh_rest.extend([Vec3::ZERO; 15]);
            let last = scene.len() - 1;
            match slot {
                0 => scene.means[last].x = value,
                1 => scene.scales[last].y = value,
                2 => scene.rotations[last].z = value,
                3 => scene.opacities[last] = value,
                4 => scene.sh_dc[last].x = value,
                _ => scene.sh_rest[last * 15 + 4].y = value,
            }
            assert!(picture(&scene, &view, quality).rgb == expected.rgb, "slot {slot}, {value}, {quality:?}");
        }
    }
}

#[test]
fn extreme_but_valid_gaussians_stay_visible() {
    let view = camera(64, 48);
    for scale in [1e3_f32, 1e8, 1e15, 1e19] {
        let scene = single(Vec3::Z * 2.0, Vec3::splat(scale), Quat::IDENTITY, 0.5);
        for quality in [Quality::Final, Quality::Reference] {
            let frame = picture(&scene, &view, quality);
            assert!(frame.transmittance.iter().all(|rest| (rest - 0.5).abs() < 1e-3), "{scale} {quality:?}");
        }
    }
}

#[test]
fn tiny_gaussians_are_points_as_wide_as_the_dilation() {
    let view = camera(65, 49);
    for scale in [0.0_f32, 1e-45, 1e-40, f32::MIN_POSITIVE, 1e-20] {
        let scene = single(Vec3::Z * 2.0, Vec3::splat(scale), Quat::IDENTITY, 0.5);
        for quality in [Quality::Final, Quality::Reference] {
            let rest = picture(&scene, &view, quality).transmittance;
            assert!((rest[24 * 65 + 32] - 0.5).abs() < 1e-4, "{scale:e} {quality:?}");
        }
    }
}

#[test]
fn large_coordinates_in_double_precision_draw_the_picture_of_small_ones() {
    let shift = DVec3::new(5e5, 5e6, 100.0);
    let (names, values) = rows(&crowd(300, 48));
    let shifted: Vec<Vec<f64>> = values
        .iter()
        .map(|row| row.iter().enumerate().map(|(idx, v)| if idx < 3 { v + shift[idx] } else { *v }).collect())
        .collect();
    let as_doubles = Layout { is_double: true, ..PLAIN };
    let (near, far) = (read(&ply(&names, &values, as_doubles)), read(&ply(&names, &shifted, as_doubles)));
    assert!(far.gaussians.origin.length() > 1e6);
    let view = camera(160, 90);
    for quality in [Quality::Final, Quality::Reference] {
        let (here, there) = (drawn(&near, &view, quality), drawn(&far, &moved(&view, shift), quality));
        let apart = here.iter().zip(&there).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        // The precision of doubles at 5e6 is 1e-9, that of floats relative to the local origin 1e-6.
        let db = psnr_db(&here, &there);
        assert!(apart < 2e-5 && db > 120.0, "{quality:?}: {apart}, {db:.1} dB");
    }
}

#[test]
fn a_million_equal_splats_load_and_draw() {
    const NUM: usize = 1_000_000;
    let one = single(Vec3::Z * 3.0, Vec3::splat(0.05), Quat::IDENTITY, 0.01);
    let (names, values) = rows(&one);
    let scene = read(&ply(&names, &vec![values[0].clone(); NUM], PLAIN));
    assert_eq!(scene.gaussians.len(), NUM);
    let frame = Renderer::new(&scene.gaussians).render(&camera(64, 48), &settings(Quality::Standard)).unwrap();
    assert!(frame.transmittance[24 * 64 + 32] < 2e-3);
    // Blending stops when the pixels are opaque, not at the end of the list.
    let counts = frame.stats.counts;
    assert!(counts.num_splats == NUM as u64 && counts.num_block_blends < counts.num_pairs * 12, "{counts:?}");
}
