//! Files that ask for far more memory than their size, and limits that forbid it.

use std::io::Cursor;
use std::path::Path;

use cinesplat::scene::{Limits, LoadOptions, SceneError, load_bytes};
use image::{ImageFormat, RgbaImage};

use super::bytes::{gzip, header, one, row_of, spz_header};
use super::{code, other_formats, read, sog};

/// A kilobyte of pictures used to become five gigabytes: 49 million texels of one color.
#[test]
fn pictures_of_a_sog_that_unpack_to_far_more_than_their_size_are_refused() {
    let mut files = sog::files();
    let side = 2400;
    let mut bytes = Cursor::new(Vec::new());
    RgbaImage::new(side, side).write_to(&mut bytes, ImageFormat::WebP).unwrap();
    let picture = bytes.into_inner();
    assert!(picture.len() < 4096);
    for (name, bytes) in &mut files {
        match name.as_str() {
            "meta.json" => {
                let text = String::from_utf8(bytes.clone()).unwrap();
                *bytes = text.replacen("\"count\":2", &format!("\"count\":{}", side * side), 2).into_bytes();
            }
            _ => bytes.clone_from(&picture),
        }
    }
    let error = read("a.sog", &sog::bundle(&files)).unwrap_err();
    assert_eq!(error.code(), "SOG-PICTURE");
    assert!(error.to_string().contains("2400 x 2400 texels in"), "{error}");
}

/// A scan may have one scale or one rotation: that plane takes a few bytes, and the positions many.
#[test]
fn a_plane_of_one_value_is_no_bomb_beside_full_planes() {
    let mut files = sog::files();
    let side = 64;
    let encoded = |picture: RgbaImage| {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, ImageFormat::WebP).unwrap();
        bytes.into_inner()
    };
    let hash = |x: u32, y: u32| {
        let mixed = (x * 64 + y + 1).wrapping_mul(2_654_435_761);
        let mixed = (mixed ^ (mixed >> 15)).wrapping_mul(2_246_822_519);
        (mixed ^ (mixed >> 13)).wrapping_mul(3_266_489_917)
    };
    let full = encoded(RgbaImage::from_fn(side, side, |x, y| image::Rgba(hash(x, y).to_le_bytes())));
    let flat = encoded(RgbaImage::new(side, side));
    for (name, bytes) in &mut files {
        match name.as_str() {
            "meta.json" => {
                let text = String::from_utf8(bytes.clone()).unwrap();
                *bytes = text.replacen("\"count\":2", "\"count\":4096", 1).into_bytes();
            }
            "n.webp" => {}
            "l.webp" => bytes.clone_from(&full),
            _ => bytes.clone_from(&flat),
        }
    }
    let limits = Limits { unpacked_bytes: 4096, ratio: 10, ..Limits::DEFAULT };
    assert!(limits.unpacked(flat.len()) < 4 * 4096, "{}", flat.len());
    assert!(full.len() > 10_000, "{}", full.len());
    let options = LoadOptions { limits, up: None };
    let scene = load_bytes(Path::new("a.sog"), &sog::bundle(&files), &options).unwrap();
    assert_eq!(scene.gaussians.len(), 4096);
}

/// Zeros compress a thousandfold: 80 kilobytes used to take 1.5 gigabytes.
#[test]
fn an_spz_of_zeros_is_refused_beyond_what_any_small_file_may_unpack_to() {
    let of = |count: u32| {
        let body = vec![0; 20 * count as usize];
        gzip(&[spz_header(2, count, 0, 12, 0), body].concat())
    };
    assert_eq!(code("bomb", &of(1_000_000)), "SPZ-BOMB");
    assert!(!matches!(read("small", &of(100_000)), Err(SceneError::SpzBomb { .. })));
}

/// The binary chunk used to be copied for each buffer without an address: three bytes of JSON each.
#[test]
fn only_the_first_buffer_of_a_gltf_may_lack_an_address() {
    let text = other_formats::gltf(r#"{"mesh":0}"#, "{}");
    assert!(read("a.gltf", text.as_bytes()).is_ok());
    let many = text.replacen(r#""buffers":["#, r#""buffers":[{},{},"#, 1);
    assert_ne!(many, text);
    assert_eq!(code("a.gltf", many.as_bytes()), "SCENE-DAMAGED");
}

#[test]
fn json_with_too_many_values_is_refused_before_it_is_parsed() {
    // Each of these objects of seven bytes takes hundreds of bytes once it is parsed.
    let text = format!(r#"{{"asset":{{}},"nodes":[{}{{}}]}}"#, r#"{"":0},"#.repeat(2_000_000));
    assert_eq!(code("a.gltf", text.as_bytes()), "SCENE-DAMAGED");
    let deep = format!("{{\"asset\":{}1{}}}", "[".repeat(200_000), "]".repeat(200_000));
    assert_eq!(code("a.gltf", deep.as_bytes()), "SCENE-DAMAGED");
}

#[test]
fn a_scene_that_takes_more_memory_than_allowed_is_refused_with_both_figures() {
    let options = LoadOptions { limits: Limits { memory_bytes: 100_000, ..Limits::DEFAULT }, up: None };
    let bytes = row_of(1000);
    let error = load_bytes(Path::new("a.ply"), &bytes, &options).unwrap_err();
    let SceneError::OutOfMemory { found, needed_bytes, limit_bytes, .. } = error else { panic!("{error}") };
    assert_eq!((found, limit_bytes), (1000, 100_000));
    assert!(needed_bytes > 100_000 && needed_bytes < 400_000, "{needed_bytes}");
    assert!(load_bytes(Path::new("a.ply"), &row_of(100), &options).is_ok());
}

/// The reader used to look for the next line behind the largest header, and panicked.
#[test]
fn a_header_whose_last_line_ending_straddles_the_limit_is_refused() {
    let (names, values) = one();
    let text = header("ascii", "1", &names);
    let (start, end) = text.split_at(text.find("element").unwrap());
    for limit in [Limits::DEFAULT.header_bytes - 1, Limits::DEFAULT.header_bytes, Limits::DEFAULT.header_bytes + 1] {
        for ending in ["\r\n", "\n", "\r"] {
            let mut file = format!("{start}comment ");
            file.push_str(&"x".repeat(limit - ending.len() - file.len()));
            file.push_str(ending);
            assert_eq!(file.len(), limit);
            file.push_str(end);
            file.push_str(&values.iter().map(f64::to_string).collect::<Vec<_>>().join(" "));
            assert_eq!(code("a.ply", file.as_bytes()), "PLY-HEADER", "{limit} {ending:?}");
        }
    }
}
