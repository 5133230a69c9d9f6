//! The seeds of the fuzz targets: whole, cut at every byte, and changed. Every crash that fuzzing found is one of them.
//!
//! Any answer is right but a panic, a hang, or memory beyond the limits. The names of the folders are those of the targets.

use std::fs;
use std::path::{Path, PathBuf};

use cinesplat::director::inputs::Vocabulary;
use cinesplat::director::{Director, ModelFiles, Names, NamesFiles};
use cinesplat::export::{Format, cameras_json, read, shot_json};
use cinesplat::files::{npy, sha256_hex};
use cinesplat::language::{
    NamedObject, effect_mentions, frame_shape, link, plain_words, program_from_notation, tokenize,
};
use cinesplat::objects::{read_boxes, read_mask};
use cinesplat::reader::Reader;
use cinesplat::scene::{Limits, LoadOptions, load_bytes};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;
use serde_json::Value;
use strum::VariantArray;

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
            let number = usize::from(first & 127) % (Format::VARIANTS.len() + 1);
            let format = number.checked_sub(1).map(|idx| Format::VARIANTS[idx]);
            let is_folder = format == Some(Format::SevenScenes);
            let name = if first & 128 == 0 { "a.txt" } else { "a.bin" };
            let path = folder.join(if is_folder { "frame-000000.pose.txt" } else { name });
            fs::write(&path, rest).unwrap();
            drop(read(if is_folder { folder } else { &path }, format));
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
        "mask" => {
            fs::write(folder.join("mask.png"), input).unwrap();
            drop(read_mask(&folder.join("mask.png")));
        }
        "prompt" | "reading" => read_prompt(&String::from_utf8_lossy(input)),
        other => read_model(other, folder, input),
    }
}

/// Reads an input as the fuzz target of that name does, for targets of weights and vocabularies.
fn read_model(target: &str, folder: &Path, input: &[u8]) {
    let part = |input: &[u8]| {
        let (length, rest) = input.split_first_chunk::<4>().map_or(([0; 4], &[][..]), |(length, rest)| (*length, rest));
        let (part, rest) = rest.split_at(rest.len().min(u32::from_le_bytes(length) as usize));
        (part.to_vec(), rest.to_vec())
    };
    let with_hashes = |description: &[u8], hashes: &[(&str, &[u8])]| {
        let Ok(Value::Object(mut json)) = serde_json::from_slice(description) else { return description.to_vec() };
        json.extend(hashes.iter().map(|(key, bytes)| ((*key).to_owned(), sha256_hex(bytes).into())));
        Value::Object(json).to_string().into_bytes()
    };
    let write = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).unwrap();
    match target {
        "vocabulary" => drop(Vocabulary::from_json(input)),
        "model" => {
            let (description, rest) = part(input);
            let (vocabulary, rest) = part(&rest);
            let (weights, _) = part(&rest);
            let hashes = [("weights_sha256", &weights[..]), ("tokenizer_sha256", &vocabulary)];
            write("director.json", &with_hashes(&description, &hashes));
            write("director.tokenizer.json", &vocabulary);
            write("director.safetensors", &weights);
            let files = ModelFiles::read(folder).unwrap();
            drop((files.vocabulary(), files.tensors(), Director::from_files(&files)));
        }
        "names" => {
            let (description, weights) = part(input);
            write("names.json", &with_hashes(&description, &[("weights_sha256", &weights)]));
            write("names.safetensors", &weights);
            let files = NamesFiles::read(folder).unwrap();
            drop((files.tensors(), Names::from_files(&files)));
        }
        "gguf" => {
            let Some((first, rest)) = input.split_first() else { return };
            let header = &include_bytes!("../fuzz/seeds/gguf/beside.gguf")[1..];
            let (model, tokenizer) = if first % 2 == 0 { (rest, &b"{}"[..]) } else { (header, rest) };
            write("model.gguf", model);
            write("tokenizer.json", tokenizer);
            drop(Reader::load(&folder.join("model.gguf")));
        }
        other => panic!("no target {other}"),
    }
}

/// Reads a prompt by its words alone; `tests/director/hostile.rs` has prompts for the director.
fn read_prompt(prompt: &str) {
    let objects = [(1, "sofa"), (2, "bottle 1"), (3, "bottle 2"), (4, "floor lamp")];
    let objects = objects.map(|(id, label)| NamedObject { id, label: label.to_owned() });
    drop((plain_words(prompt, &tokenize(prompt), &|_| false), frame_shape(prompt, &objects)));
    if let Ok(linked) = link(prompt, &objects) {
        drop(effect_mentions(prompt, &linked));
    }
    drop(program_from_notation(prompt));
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
