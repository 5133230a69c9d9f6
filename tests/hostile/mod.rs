//! The seeds of the fuzz targets: whole, cut at every byte, and changed. Every crash that fuzzing found is one of them.
//!
//! Any answer is right but a panic, a hang, or memory beyond the limits. The names of the folders are those of the targets.

use std::fs;
use std::path::{Path, PathBuf};

use cinesplat::export::{Format, cameras_json, read, shot_json};
use cinesplat::files::npy;
use cinesplat::objects::read_boxes;
use cinesplat::scene::{Limits, LoadOptions, load_bytes};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

/// Changed copies of every seed.
const NUM_CHANGED: usize = 200;

/// Reads an input as the fuzz target of that name does.
fn read_as(target: &str, folder: &Path, input: &[u8]) {
    let Some((first, rest)) = input.split_first() else { return };
    match target {
        "scene" => {
            let name = ["a.ply", "a.splat", "a.spz", "meta.json"][usize::from(*first) % 4];
            let limits = Limits { memory_bytes: 256 << 20, ..Limits::DEFAULT };
            drop(load_bytes(&folder.join(name), rest, &LoadOptions { up: None, limits }));
        }
        "path" => {
            let formats = [
                None,
                Some(Format::Tum),
                Some(Format::Kitti),
                Some(Format::Euroc),
                Some(Format::Nerfstudio),
                Some(Format::Transforms),
                Some(Format::Colmap),
                Some(Format::Supersplat),
                Some(Format::Lichtfeld),
                Some(Format::Gltf),
                Some(Format::Usd),
                Some(Format::Blender),
            ];
            let path = folder.join(if first & 128 == 0 { "a.txt" } else { "a.bin" });
            fs::write(&path, rest).unwrap();
            drop(read(&path, formats[usize::from(first & 127) % formats.len()]));
        }
        "shot" => drop(std::str::from_utf8(input).map(shot_json::read)),
        "cameras" => drop(std::str::from_utf8(input).map(cameras_json::read)),
        "objects" => {
            let path = folder.join("objects.json");
            let names_clouds = br#"{"format":"cinesplat.objects","version":1,"clouds":"c.safetensors",
                "objects":[{"id":1,"label":"a","center":[0,0,0],"half_extents":[1,1,1]}]}"#;
            fs::write(folder.join("c.safetensors"), rest).unwrap();
            fs::write(&path, if *first == 255 { &names_clouds[..] } else { input }).unwrap();
            drop(read_boxes(&path));
        }
        "array" => drop(npy::Array::parse(input).map(|array| (array.to_u32(), array.to_f32()))),
        other => panic!("no target {other}"),
    }
}

/// Every seed with the name of its target.
fn seeds() -> Vec<(String, PathBuf)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/seeds");
    let entries = |folder: &Path| {
        let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        paths
    };
    let targets = entries(&folder);
    let named = |target: &PathBuf| (target.file_name().unwrap().to_str().unwrap().to_owned(), entries(target));
    targets
        .iter()
        .map(named)
        .flat_map(|(name, seeds)| seeds.into_iter().map(move |seed| (name.clone(), seed)))
        .collect()
}

#[test]
fn every_seed_of_the_fuzz_targets_is_read_without_a_panic() {
    // In memory where there is such a place: file systems flush a file that is written over.
    let folder = tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).unwrap();
    let seeds = seeds();
    assert!(seeds.len() >= 40, "{} seeds", seeds.len());
    let mut rng = Pcg32::seed_from_u64(7);
    for (target, seed) in seeds {
        let whole = fs::read(&seed).unwrap();
        read_as(&target, folder.path(), &whole);
        // A long run of zeros is cut at few places: nothing changes along it.
        let step = whole.len().div_ceil(4000).max(1);
        (0..whole.len()).step_by(step).for_each(|len| read_as(&target, folder.path(), &whole[..len]));
        for _ in 0..NUM_CHANGED {
            let mut changed = whole.clone();
            for _ in 0..rng.random_range(1..6) {
                let at = rng.random_range(0..changed.len());
                match rng.random_range(0..4) {
                    0 => changed[at] ^= 1 << rng.random_range(0..8),
                    1 => changed[at] = [0, 1, 127, 128, 255, b'9', b'-', b'e'][rng.random_range(0..8)],
                    2 => drop(changed.splice(at..at, [rng.random::<u8>()])),
                    _ => drop(changed.drain(at..(at + rng.random_range(1..9)).min(changed.len()))),
                }
                if changed.is_empty() {
                    break;
                }
            }
            read_as(&target, folder.path(), &changed);
        }
    }
}
