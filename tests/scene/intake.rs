use cinesplat::scene::{Limits, LoadOptions, UpSource};
use glam::DVec3;

use super::bytes::{PROPERTIES, header, one, ply, row_of};
use super::{code, read};

/// Index of a property in a row of [`PROPERTIES`].
fn at(name: &str) -> usize {
    PROPERTIES.iter().position(|(known, _)| *known == name).unwrap()
}

#[test]
fn invalid_gaussians_are_dropped_and_the_others_are_unchanged() {
    let (names, values) = one();
    let clean = read("clean", &ply(&names, &vec![values.clone(); 3])).unwrap();
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for (idx, name) in names.iter().enumerate() {
        for poison in bad {
            let kept =
                *name == "opacity" && !poison.is_nan() || name.starts_with("scale") && poison == f64::NEG_INFINITY;
            if kept {
                continue;
            }
            let mut rows = vec![values.clone(); 4];
            rows[1][idx] = poison;
            let scene = read("poisoned", &ply(&names, &rows)).unwrap();
            assert_eq!(scene.gaussians, clean.gaussians, "{name} = {poison}");
            assert_eq!(scene.dropped, [1], "{name} = {poison}");
            assert!(scene.notes[0].starts_with("1 dropped: "), "{:?}", scene.notes);
        }
    }
}

#[test]
fn infinite_opacity_is_1_and_scale_of_minus_infinity_is_0() {
    let (names, mut values) = one();
    values[at("opacity")] = f64::INFINITY;
    values[at("scale_1")] = f64::NEG_INFINITY;
    let scene = read("extreme", &ply(&names, &[values])).unwrap();
    assert_eq!((scene.gaussians.opacities[0], scene.gaussians.scales[0].y), (1.0, 0.0));
    assert!(scene.notes.is_empty() && scene.dropped.is_empty());
}

#[test]
fn extreme_values_are_kept_and_finite() {
    let (names, values) = one();
    for (name, value) in
        [("x", 1e30), ("scale_0", 1e30), ("scale_0", -1e30), ("opacity", -1e30), ("f_dc_0", 1e30), ("rot_0", 1e-30)]
    {
        let mut row = values.clone();
        row[at(name)] = value;
        let scene = read("extreme", &ply(&names, &[values.clone(), row])).unwrap();
        assert_eq!(scene.gaussians.len(), 2, "{name} = {value}");
        assert!(scene.gaussians.scales[1].is_finite() && scene.gaussians.rotations[1].is_normalized());
    }
}

#[test]
fn quaternions_of_any_length_and_sign_load_alike() {
    let (names, values) = one();
    let rotation = [0.5, -0.25, 0.125, 0.75];
    let with = |factor: f64| {
        let mut row = values.clone();
        (0..4).for_each(|i| row[at("rot_0") + i] = rotation[i] * factor);
        read("q", &ply(&names, &[row])).unwrap().gaussians.rotations[0]
    };
    for factor in [7.0, -1.0, -7.0, 1e-20, 3.0, 1e15_f64.exp2().min(1e30)] {
        assert_eq!(with(factor), with(1.0), "times {factor}");
    }
    let mut zero = values.clone();
    (0..4).for_each(|i| zero[at("rot_0") + i] = 0.0);
    let scene = read("q", &ply(&names, &[values.clone(), zero])).unwrap();
    assert_eq!(scene.notes, ["1 dropped: rotation is zero or not finite"]);
}

#[test]
fn no_valid_gaussian_is_an_error_and_one_is_a_scene() {
    let (names, values) = one();
    let dead = vec![f64::NAN; values.len()];
    assert_eq!(code("dead", &ply(&names, &[dead.clone(), dead])), "SCENE-EMPTY");
    assert_eq!(read("one", &ply(&names, &[values])).unwrap().gaussians.len(), 1);
}

#[test]
fn double_precision_far_from_the_origin_loads_as_near_it() {
    let (names, values) = one();
    let rows: Vec<Vec<f64>> = (0..50)
        .map(|i| {
            let mut row = values.clone();
            (0..3).for_each(|axis| row[axis] = f64::from((i * (7 + 4 * axis as i32)) % 50) * 0.125);
            row
        })
        .collect();
    let shift = [5e5, 5e6, 100.0];
    let file = |offset: [f64; 3]| {
        let mut bytes = header("binary_little_endian", "50", &names).replace("float", "double").into_bytes();
        for row in &rows {
            let moved = row.iter().enumerate().map(|(i, v)| if i < 3 { v + offset[i] } else { *v });
            bytes.extend(moved.flat_map(f64::to_le_bytes));
        }
        read("far", &bytes).unwrap().gaussians
    };
    let (near, far) = (file([0.0; 3]), file(shift));
    assert_eq!(near.origin, DVec3::ZERO);
    for i in 0..near.len() {
        assert_eq!(far.mean_world(i) - DVec3::from_array(shift), near.mean_world(i), "Gaussian {i}");
    }
}

#[test]
fn single_precision_far_from_the_origin_reports_its_quantization() {
    let (names, values) = one();
    let rows: Vec<Vec<f64>> = (0..9).map(|i| [vec![1e6 + f64::from(i)], values[1..].to_vec()].concat()).collect();
    let scene = read("far", &ply(&names, &rows)).unwrap();
    assert!(scene.notes.iter().any(|note| note.contains("quantized to 0.0625")), "{:?}", scene.notes);
    assert!((scene.gaussians.mean_world(3).x - (1e6 + 3.0)).abs() <= 0.0);
}

#[test]
fn kept_selects_the_entries_of_the_kept_gaussians() {
    let (names, values) = one();
    let mut rows = vec![values.clone(); 5];
    rows[1][0] = f64::NAN;
    rows[4][0] = f64::NAN;
    let scene = read("labels", &ply(&names, &rows)).unwrap();
    assert_eq!(scene.kept(&[10, 11, 12, 13, 14]), Some(vec![10, 12, 13]));
    assert_eq!(scene.kept(&[10, 11]), None);
}

#[test]
fn limits_are_enforced() {
    let bytes = row_of(10);
    let options = LoadOptions { limits: Limits { gaussians: 9, ..Limits::DEFAULT }, up: None };
    let error = cinesplat::scene::load_bytes("big.ply".as_ref(), &bytes, &options).unwrap_err();
    assert_eq!(error.code(), "SCENE-COUNT-CAP");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("big.ply");
    std::fs::write(&path, &bytes).unwrap();
    let options = LoadOptions { limits: Limits { scene_bytes: 100, ..Limits::DEFAULT }, up: None };
    assert_eq!(cinesplat::scene::load(&path, &options).unwrap_err().code(), "SCENE-BYTES-CAP");
}

#[test]
fn up_of_the_caller_overrides_the_file() {
    let options = LoadOptions { up: Some(DVec3::new(0.0, 0.0, 5.0)), ..LoadOptions::default() };
    let scene = cinesplat::scene::load_bytes("a.ply".as_ref(), &row_of(3), &options).unwrap();
    assert_eq!((scene.up, scene.up_source), (DVec3::Z, UpSource::Flag));
    let zero = LoadOptions { up: Some(DVec3::ZERO), ..LoadOptions::default() };
    assert_eq!(cinesplat::scene::load_bytes("a.ply".as_ref(), &row_of(3), &zero).unwrap_err().code(), "UP-DIRECTION");
}
