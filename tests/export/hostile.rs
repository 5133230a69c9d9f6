//! Truncated files, wrong counts and deep nesting are errors, and no count is allocated before it is checked.

use cinesplat::export::{Content, Format, read};
use cinesplat::trajectory::Easing;

use super::sample_shot::{file, there_and_back, with_cut};

/// A file of every format, cut off at 40 places, is an error or a shorter path, never a panic.
#[test]
fn truncated_files_never_panic() {
    let names = [
        "a.txt",
        "b.txt",
        "c.csv",
        "d.json",
        "e.json",
        "images.txt",
        "images.bin",
        "f.json",
        "g.glb",
        "h.usda",
        "i.py",
    ];
    let formats = [
        Format::Tum,
        Format::Kitti,
        Format::Euroc,
        Format::Nerfstudio,
        Format::Transforms,
        Format::Colmap,
        Format::Colmap,
        Format::Lichtfeld,
        Format::Gltf,
        Format::Usd,
        Format::Blender,
    ];
    for (name, format) in names.into_iter().zip(formats) {
        let (_, _, folder) = there_and_back(&with_cut(), format, name, Content::Keyframes);
        let path = folder.path().join(name);
        let bytes = std::fs::read(&path).unwrap();
        for part in 0..40 {
            std::fs::write(&path, &bytes[..bytes.len() * part / 40]).unwrap();
            if let Err(error) = read(&path, Some(format)) {
                assert!(!matches!(error.code(), "FILE-READ" | "EXCHANGE-SIZE"), "{name}: {error}");
            }
        }
    }
}

#[test]
fn false_counts_are_refused() {
    let (path, _folder) = file("images.bin", &u64::MAX.to_le_bytes());
    insta::assert_snapshot!(read(&path, None).unwrap_err(), @"byte 8: found the end of the file, expected an image id");
    let gltf = br#"{"asset": {"version": "2.0"}, "cameras": [{"perspective": {"yfov": 1}}], "nodes": [{"camera": 0}],
      "animations": [{"samplers": [{"input": 0, "output": 0}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 4000000000}],
      "bufferViews": [{"buffer": 0, "byteLength": 4}], "buffers": [{"uri": "data:;base64,AAAAAA=="}]}"#;
    let (path, _folder) = file("a.gltf", gltf);
    assert!(read(&path, None).unwrap_err().to_string().contains("expected values inside the buffer"));
}

#[test]
fn deep_nesting_and_files_elsewhere_are_refused() {
    let (path, _folder) =
        file("a.usda", format!("#usda 1.0\ndef X \"a\" {{ float a = {} }}", "(".repeat(100_000)).as_bytes());
    assert!(read(&path, None).unwrap_err().to_string().contains("expected less nesting"));
    let (path, _folder) = file("a.usda", format!("#usda 1.0\n{}", "def X \"a\" { ".repeat(100_000)).as_bytes());
    assert!(read(&path, None).unwrap_err().to_string().contains("expected less nesting"));
    let gltf = br#"{"asset": {}, "cameras": [], "nodes": [], "buffers": [{"uri": "../../etc/passwd"}]}"#;
    let (path, _folder) = file("a.gltf", gltf);
    assert!(read(&path, None).unwrap_err().to_string().contains("expected the name of a file in the same folder"));
}

#[test]
fn missing_files_and_foreign_content_have_their_own_codes() {
    let code = |name: &str| read(name.as_ref(), None).map_err(|error| error.code()).unwrap_err();
    assert_eq!(code("/nowhere/at/all.json"), "FILE-READ");
    let (path, _folder) = file("a.ply", b"ply\nformat ascii 1.0\n");
    assert_eq!(code(path.to_str().unwrap()), "EXCHANGE-FORMAT");
}

#[test]
fn an_unknown_easing_in_a_blender_script_is_an_error() {
    let mut eased = with_cut();
    eased.keyframes[1].easing = Easing::Smooth;
    let (_, _, folder) = there_and_back(&eased, Format::Blender, "a.py", Content::Keyframes);
    let path = folder.path().join("a.py");
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("\"smooth\""));
    std::fs::write(&path, text.replace("\"smooth\"", "\"smoth\"")).unwrap();
    let error = read(&path, None).unwrap_err().to_string();
    assert!(error.starts_with("frames[1].easing: found \"smoth\", expected one of smooth, linear, "), "{error}");
}
