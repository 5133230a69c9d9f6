//! Truncated and mutated files: every one gives a scene or an error, without a panic.

use cinesplat::scene::{LoadOptions, SceneError};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use super::bytes::{gzip, header, one, row_of, splat_record, spz_v2};
use super::{code, read};
use crate::support;

/// A small file of each format.
fn seeds() -> Vec<(String, Vec<u8>)> {
    let (names, values) = one();
    let text: Vec<String> = values.iter().map(f64::to_string).collect();
    let ascii = header("ascii", "2", &names) + &format!("{0}\n{0}\n", text.join(" "));
    let mut seeds = vec![
        ("binary.ply".to_owned(), row_of(4)),
        ("ascii.ply".to_owned(), ascii.into_bytes()),
        ("a.splat".to_owned(), splat_record([1.0; 3], [1.0; 3], [9; 4], [255, 128, 128, 128]).repeat(3)),
        ("plain.spz".to_owned(), spz_v2(2)),
        ("gzip.spz".to_owned(), gzip(&spz_v2(1))),
        ("a.sog".to_owned(), super::sog::bundle(&super::sog::files())),
    ];
    seeds.push(("a.ksplat".to_owned(), super::other_formats::ksplat(1, 2)));
    seeds.push(("a.gltf".to_owned(), super::other_formats::gltf(r#"{"mesh":0}"#, "{}").into_bytes()));
    seeds.push(("a.pcd".to_owned(), super::other_formats::compressed_pcd()));
    for name in ["minimal-v4.spz", "minimal.ksplat", "khr_conformance_matrix.glb"] {
        if let Some(path) = support::shared(&format!("data/format_fixtures/{name}")) {
            seeds.push((name.to_owned(), std::fs::read(path).unwrap()));
        }
    }
    seeds
}

#[test]
fn every_truncation_gives_an_error_or_a_scene() {
    for (name, bytes) in seeds() {
        for cut in 0..bytes.len().min(3000) {
            if let Err(error) = read(&name, &bytes[..cut]) {
                let is_content = !matches!(
                    error,
                    SceneError::NotFound { .. } | SceneError::Permission { .. } | SceneError::Io { .. }
                );
                assert!(is_content && !error.to_string().contains('\n'), "{name} cut at {cut}: {error}");
            } else {
                assert!(name != "binary.ply", "{name} cut at {cut} loads");
            }
        }
    }
}

#[test]
fn truncated_binary_rows_do_not_load() {
    let bytes = row_of(4);
    let start = bytes.len() - 4 * 56;
    (start..bytes.len()).for_each(|cut| assert_eq!(code("a.ply", &bytes[..cut]), "PLY-TRUNCATED", "cut at {cut}"));
}

#[test]
fn random_mutations_never_panic() {
    let mut rng = Pcg32::seed_from_u64(20);
    for (name, bytes) in seeds() {
        for _ in 0..600 {
            let mut bad = bytes.clone();
            for _ in 0..rng.random_range(1..8) {
                let at = rng.random_range(0..bad.len());
                match rng.random_range(0..3) {
                    0 => bad[at] ^= 1 << rng.random_range(0..8),
                    1 => bad[at] = [0, 1, 127, 128, 255][rng.random_range(0..5)],
                    _ => drop(bad.splice(at..at, [rng.random::<u8>()])),
                }
            }
            let _ = read(&name, &bad);
        }
    }
}

#[test]
fn flipped_header_bits_of_an_spz_never_panic() {
    for (name, bytes) in seeds().into_iter().filter(|(name, _)| name.contains("spz")) {
        for bit in 0..bytes.len().min(128) * 8 {
            let mut bad = bytes.clone();
            bad[bit / 8] ^= 1 << (bit % 8);
            let _ = read(&name, &bad);
        }
    }
}

#[test]
fn a_million_identical_gaussians_load() {
    let record = splat_record([1.0; 3], [1.0; 3], [9; 4], [255, 128, 128, 128]);
    assert_eq!(read("same.splat", &record.repeat(1_000_000)).unwrap().gaussians.len(), 1_000_000);
}

#[test]
fn paths_that_are_not_files_are_rejected() {
    let code = |path: &str| cinesplat::scene::load(path.as_ref(), &LoadOptions::default()).unwrap_err();
    assert_eq!(code("/no/such/scene.ply").code(), "SCENE-NOT-FOUND");
    if cfg!(target_os = "linux") {
        assert_eq!(code("/dev/zero").code(), "SCENE-NOT-A-FILE");
    }
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(code(folder.path().to_str().unwrap()).code(), "SCENE-NOT-FOUND");
}
