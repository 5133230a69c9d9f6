use std::io::{Cursor, Write};
use std::path::Path;

use cinesplat::scene::{LoadOptions, SplatFilter, load};
use glam::Vec3;
use image::{ImageFormat, RgbaImage};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::{code, read};

/// The files of a version 2 SOG with two Gaussians of degree 1; its pictures have 2 x 1 texels.
pub fn files() -> Vec<(String, Vec<u8>)> {
    let book: Vec<f64> = (0..256).map(|i| f64::from(i) / 64.0 - 3.0).collect();
    let meta = serde_json::json!({
        "version": 2, "count": 2, "antialias": true,
        "means": {"mins": [-1.0, 0.0, -2.0], "maxs": [1.0, 2.0, 2.0], "files": ["l.webp", "u.webp"]},
        "scales": {"codebook": book, "files": ["s.webp"]}, "quats": {"files": ["q.webp"]},
        "sh0": {"codebook": book, "files": ["c.webp"]},
        "shN": {"count": 64, "bands": 1, "codebook": book, "files": ["n.webp", "i.webp"]},
    });
    let palette: Vec<u8> = (0..192_u8).flat_map(|i| [i, 0, 192, 255]).collect();
    let pictures = [
        ("l.webp", webp(2, 1, &[255, 255, 0, 255, 0, 0, 0, 255])),
        ("u.webp", webp(2, 1, &[255, 255, 0, 255, 0, 0, 0, 255])),
        ("s.webp", webp(2, 1, &[192, 128, 0, 255, 192, 192, 192, 255])),
        ("q.webp", webp(2, 1, &[128, 128, 255, 252, 128, 128, 128, 255])),
        ("c.webp", webp(2, 1, &[192, 255, 0, 51, 192, 192, 192, 255])),
        ("n.webp", webp(192, 1, &palette)),
        ("i.webp", webp(2, 1, &[2, 0, 0, 255, 63, 0, 0, 255])),
    ];
    let named = pictures.into_iter().map(|(name, bytes)| (name.to_owned(), bytes));
    std::iter::once(("meta.json".to_owned(), meta.to_string().into_bytes())).chain(named).collect()
}

fn webp(width: u32, height: u32, rgba: &[u8]) -> Vec<u8> {
    let mut out = Cursor::new(Vec::new());
    RgbaImage::from_raw(width, height, rgba.to_vec()).unwrap().write_to(&mut out, ImageFormat::WebP).unwrap();
    out.into_inner()
}

/// The files in a zip archive.
pub fn bundle(files: &[(String, Vec<u8>)]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        zip.start_file(name.as_str(), SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored))
            .unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

fn write_folder(folder: &Path, files: &[(String, Vec<u8>)]) {
    for (name, bytes) in files {
        std::fs::write(folder.join(name), bytes).unwrap();
    }
}

#[test]
fn bundle_decodes_to_its_values() {
    let scene = read("a.sog", &bundle(&files())).unwrap();
    let g = &scene.gaussians;
    assert_eq!((scene.format.as_str(), scene.filter, g.sh_degree), ("sog v2 (bundled)", Some(SplatFilter::Mip), 1));
    let e = std::f32::consts::E;
    assert!(g.means[0].abs_diff_eq(Vec3::new(e - 1.0, e * e - 1.0, 1.0 - e * e), 1e-5), "{}", g.means[0]);
    assert!(g.means[1].abs_diff_eq(Vec3::new(1.0 - e, 0.0, 1.0 - e * e), 1e-5), "{}", g.means[1]);
    assert!(g.scales[0].abs_diff_eq(Vec3::new(1.0, (-1.0_f32).exp(), (-3.0_f32).exp()), 1e-6), "{}", g.scales[0]);
    assert!((g.rotations[0] * Vec3::X).abs_diff_eq(Vec3::Y, 1e-2), "{}", g.rotations[0]);
    assert_eq!((g.opacities[0], g.sh_dc[0]), (0.2, Vec3::new(0.0, 0.984_375, -3.0)));
    assert_eq!(g.sh_rest_of(0)[1], Vec3::new(7.0 / 64.0 - 3.0, -3.0, 0.0));
    assert_eq!(g.sh_rest_of(1)[2], Vec3::new(191.0 / 64.0 - 3.0, -3.0, 0.0));
}

#[test]
fn folder_and_meta_json_load_like_the_bundle() {
    let folder = tempfile::tempdir().unwrap();
    write_folder(folder.path(), &files());
    let bundled = read("a.sog", &bundle(&files())).unwrap();
    for path in [folder.path().to_path_buf(), folder.path().join("meta.json")] {
        let scene = load(&path, &LoadOptions::default()).unwrap();
        assert_eq!((scene.gaussians, scene.format.as_str()), (bundled.gaussians.clone(), "sog v2 (unbundled)"));
        assert_eq!(scene.path, path);
    }
}

#[test]
fn invalid_metas_are_rejected() {
    let with = |from: &str, to: &str| {
        let mut all = files();
        let text = String::from_utf8(all[0].1.clone()).unwrap();
        assert!(text.contains(from), "{from}");
        all[0].1 = text.replace(from, to).into_bytes();
        code("a.sog", &bundle(&all))
    };
    assert_eq!(with("\"version\":2", "\"version\":3"), "SOG-META");
    assert_eq!(with("\"s.webp\"", "\"../s.webp\""), "SOG-META");
    assert_eq!(with("\"s.webp\"", "\"/etc/passwd\""), "SOG-META");
    assert_eq!(with("\"s.webp\"", "\"t.webp\""), "SOG-PICTURE");
    assert_eq!(with("\"count\":2", "\"count\":3"), "SOG-PICTURE");
    assert_eq!(with("\"count\":2", "\"count\":-2"), "SOG-META");
    assert_eq!(with("\"count\":2", "\"count\":4294967295"), "SCENE-COUNT-CAP");
    assert_eq!(with("\"bands\":1", "\"bands\":3"), "SOG-PICTURE");
    assert_eq!(with("\"bands\":1", "\"bands\":9"), "SOG-META");
    assert_eq!(code("a.sog", &bundle(&files()[1..])), "SOG-PICTURE");
}

/// A tree of two boxes, each with one Gaussian of every level; the boxes are in the other order in level 0.
const TREE: &str = r#"{"lodLevels":2,"environment":null,"filenames":["0_0/meta.json","1_0/meta.json"],"tree":{"children":[
    {"lods":{"0":{"file":0,"offset":1,"count":1},"1":{"file":1,"offset":0,"count":1}}},
    {"lods":{"0":{"file":0,"offset":0,"count":1},"1":{"file":1,"offset":1,"count":1}}}]}}"#;

#[test]
fn a_streamed_sog_is_read_at_its_finest_level_that_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let meta = folder.path().join("lod-meta.json");
    std::fs::write(&meta, TREE).unwrap();
    let code = || load(&meta, &LoadOptions::default()).unwrap_err().code();
    assert_eq!(code(), "SCENE-NOT-FOUND");
    let write = |level: &str| {
        let folder = folder.path().join(level);
        std::fs::create_dir(&folder).unwrap();
        write_folder(&folder, &files());
    };
    let own = read("a.sog", &bundle(&files())).unwrap().gaussians;
    write("1_0");
    let coarse = load(folder.path(), &LoadOptions::default()).unwrap();
    assert_eq!((coarse.gaussians.clone(), coarse.format.as_str()), (own.clone(), "sog (streamed, level 1 of 2)"));
    let note = "the files of finer levels of detail are missing: level 1 of 0 to 1 is read";
    assert!(coarse.notes.iter().any(|line| line == note), "{:?}", coarse.notes);
    write("0_0");
    let fine = load(&meta, &LoadOptions::default()).unwrap();
    // Which level is read depends on the files, and so does the hash.
    assert_ne!(fine.sha256, coarse.sha256);
    assert_eq!((fine.gaussians, fine.format.as_str()), (own.subset(&[1, 0]), "sog (streamed, level 0 of 2)"));
    // The environment is around every level.
    std::fs::write(&meta, TREE.replace("null", r#""1_0/meta.json""#)).unwrap();
    assert_eq!(load(&meta, &LoadOptions::default()).unwrap().gaussians, own.subset(&[1, 0, 0, 1]));
}

#[test]
fn gaussians_that_a_level_drops_keep_their_numbers_and_a_file_listed_twice_is_read_once() {
    let folder = tempfile::tempdir().unwrap();
    let mut all = files();
    let mut own: serde_json::Value = serde_json::from_slice(&all[0].1).unwrap();
    // The first Gaussian has byte 255, which the codebook then lacks.
    own["sh0"]["codebook"].as_array_mut().unwrap().pop();
    all[0].1 = own.to_string().into_bytes();
    write_folder(folder.path(), &all);
    let meta = folder.path().join("lod-meta.json");
    let twice =
        TREE.replace("0_0/", "").replace("1_0/", "").replace(r#""file":0,"offset":0"#, r#""file":1,"offset":0"#);
    std::fs::write(&meta, twice).unwrap();
    let scene = load(&meta, &LoadOptions::default()).unwrap();
    assert_eq!((scene.gaussians.len(), scene.dropped.as_slice(), scene.num_in_file()), (1, &[1][..], 2));
    assert_eq!(scene.notes, ["meta.json: 1 dropped: color is not finite"]);
}

#[test]
fn the_hash_of_an_unbundled_sog_covers_its_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let mut all = files();
    let mut hash = || {
        write_folder(folder.path(), &all);
        all[3].1 = webp(2, 1, &[192, 128, 1, 255, 192, 192, 192, 255]);
        load(folder.path(), &LoadOptions::default()).unwrap().sha256
    };
    assert_ne!(hash(), hash());
}

#[test]
fn a_streamed_sog_with_a_bad_tree_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    write_folder(folder.path(), &files());
    let code = |tree: &str| {
        let path = folder.path().join("lod-meta.json");
        std::fs::write(&path, tree).unwrap();
        load(&path, &LoadOptions::default()).unwrap_err().code()
    };
    let here = TREE.replace("0_0/", "").replace("1_0/", "");
    assert_eq!(code(&here.replace(r#""offset":1"#, r#""offset":2"#)), "SCENE-DAMAGED");
    assert_eq!(code(&here.replace(r#""offset":1,"#, "")), "SCENE-DAMAGED");
    assert_eq!(code(&here.replace("\"meta.json\"", "\"../meta.json\"")), "SCENE-DAMAGED");
    assert_eq!(code(&here.replace("\"count\":1", "\"count\":99999999999")), "SCENE-COUNT-CAP");
    assert_eq!(code(r#"{"lodLevels":1,"filenames":["meta.json"],"tree":{}}"#), "SCENE-DAMAGED");
    let deep = (0..99).fold("{}".to_owned(), |inner, _| format!(r#"{{"children":[{inner}]}}"#));
    assert_eq!(code(&format!(r#"{{"lodLevels":1,"filenames":[],"tree":{deep}}}"#)), "SCENE-DAMAGED");
    for (name, bytes) in [
        ("a.glb", &b"glTF\x02\0\0\0"[..]),
        ("a.gltf", br#"{"asset":{"version":"2.0"}}"#),
        ("a.pcd", b"# .PCD v0.7\nVERSION 0.7\n"),
    ] {
        assert_eq!(super::code(name, bytes), "SCENE-DAMAGED");
    }
}

#[test]
fn the_playbots_streamed_sog_is_its_finest_level() {
    let Some(folder) = crate::support::shared("data/playbot") else { return };
    let streamed = load(&folder, &LoadOptions::default()).unwrap();
    let level = load(&folder.join("2_0"), &LoadOptions::default()).unwrap();
    assert_eq!(streamed.gaussians.len(), level.gaussians.len());
    assert_eq!(streamed.format, "sog (streamed, level 2 of 7)");
}
