use cinesplat::export::Format;
use strum::VariantArray;

#[test]
fn names_come_back_as_formats() {
    assert!(Format::VARIANTS.iter().all(|format| format.as_ref().parse() == Ok(*format)));
    let wanted = "tum kitti euroc nerfstudio transforms colmap supersplat lichtfeld gltf usd blender csv shot";
    assert!(wanted.split(' ').all(|name| name.parse::<Format>().is_ok()));
}

#[test]
fn paths_that_say_their_format() {
    let format = |path: &str| Format::from_path(path.as_ref()).map(<&str>::from);
    let said = [
        ("x/camera_path.json", "nerfstudio"),
        ("k01.path.json", "nerfstudio"),
        ("transforms_train.json", "transforms"),
        ("move.shot.json", "shot"),
        ("a.kitti.txt", "kitti"),
        ("a_tum.txt", "tum"),
        ("a.euroc.csv", "euroc"),
        ("a.csv", "csv"),
        ("A.GLB", "gltf"),
        ("a.usda", "usd"),
        ("a.py", "blender"),
        ("model/images.bin", "colmap"),
    ];
    for (path, name) in said {
        assert_eq!(format(path), Some(name), "{path}");
    }
    assert_eq!((format("a.json"), format("a.txt"), format("folder")), (None, None, None));
}

#[test]
fn the_content_determines_the_format_of_an_import() {
    let name = |bytes: &[u8]| Format::detect(bytes).map(<&str>::from);
    assert_eq!(name(b"# c\n1 2 3 4 0 0 0 1\n"), Some("tum"));
    assert_eq!(name(b"1 0 0 0 0 1 0 0 0 0 1 0\n"), Some("kitti"));
    assert_eq!(name(b"#timestamp, p\n1403636579763555584,1,2,3,1,0,0,0,0\n"), Some("euroc"));
    assert_eq!(name(b"1 1 0 0 0 0 0 0 1 a.png\n\n"), Some("colmap"));
    assert_eq!(name(b"1 SIMPLE_RADIAL 8 8 5 4 4 0.1\n"), Some("colmap"));
    assert_eq!(name(b"0 0 1\n1 0 0 0\n"), Some("log"));
    assert_eq!(name(b"{\"frames\": [{\"transform_matrix\": []}]}"), Some("transforms"));
    assert_eq!(name(b"{\"version\": 4, \"clip_duration\": 1, \"keyframes\": []}"), Some("lichtfeld"));
    assert_eq!(name(b"{\"anything\": 1}"), None);
    assert_eq!(name(b"ply\nformat binary_little_endian 1.0\n"), None);
    assert_eq!(name(b""), None);
}
