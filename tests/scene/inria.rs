use cinesplat::scene::{SplatFilter, UpSource};
use glam::{DVec3, Vec3};

use super::bytes::{PROPERTIES, header, one, ply, properties, rest_names};
use super::{code, read};

/// Asserts that a file loads to the Gaussian of [`PROPERTIES`].
fn assert_is_the_one(name: &str, bytes: &[u8]) {
    let scene = read(name, bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
    let g = &scene.gaussians;
    assert_eq!(g.len(), 1, "{name}");
    assert_eq!(g.means[0], Vec3::new(1.0, 2.0, 3.0), "{name}");
    assert!(g.scales[0].abs_diff_eq(Vec3::new(0.5, 1.0, 2.0), 1e-6), "{name}: {}", g.scales[0]);
    assert!((g.opacities[0] - 0.75).abs() < 1e-6, "{name}: {}", g.opacities[0]);
    assert!((g.rotations[0] * Vec3::X).abs_diff_eq(Vec3::Y, 1e-6), "{name}: {}", g.rotations[0]);
    assert!(g.sh_dc[0].abs_diff_eq(Vec3::new(0.1, 0.2, 0.3), 1e-6), "{name}: {}", g.sh_dc[0]);
}

#[test]
fn layouts_of_one_gaussian_load_alike() {
    let (names, values) = one();
    assert_is_the_one("plain", &ply(&names, std::slice::from_ref(&values)));

    let (mut back, mut back_values) = (names.clone(), values.clone());
    back.reverse();
    back_values.reverse();
    assert_is_the_one("reversed order", &ply(&back, &[back_values]));

    let mut big = header("binary_big_endian", "1", &names).into_bytes();
    big.extend(values.iter().flat_map(|v| (*v as f32).to_be_bytes()));
    assert_is_the_one("big-endian", &big);

    let mut double = header("binary_little_endian", "1", &names).replace("float", "double").into_bytes();
    double.extend(values.iter().flat_map(|v| v.to_le_bytes()));
    assert_is_the_one("double", &double);

    let text: Vec<String> = values.iter().map(f64::to_string).collect();
    let ascii = format!("{}{}\n", header("ascii", "1", &names), text.join(" "));
    assert_is_the_one("ascii", ascii.as_bytes());
    assert_is_the_one("ascii with CR LF", ascii.replace('\n', "\r\n").as_bytes());
    assert_is_the_one("ascii without last line end", ascii.trim_end().as_bytes());

    let crlf = header("binary_little_endian", "1", &names).replace('\n', "\r\n");
    let mut binary = crlf.into_bytes();
    binary.extend(values.iter().flat_map(|v| (*v as f32).to_le_bytes()));
    assert_is_the_one("binary with CR LF", &binary);
}

#[test]
fn extra_elements_and_properties_are_skipped() {
    let (names, values) = one();
    let mut text = String::from("ply\nformat binary_little_endian 1.0\nobj_info made by hand\nelement camera 2\n");
    text += "property uchar kind\nproperty list uchar int path\nelement vertex 1\nproperty short before\n";
    text += &properties("float", &names);
    text += "property list uchar float extra\nelement face 1\nproperty list uchar uint vertex_indices\nend_header\n";
    let mut bytes = text.into_bytes();
    bytes.extend([9, 2, 1, 0, 0, 0, 2, 0, 0, 0, 9, 0]);
    bytes.extend(7_i16.to_le_bytes());
    bytes.extend(values.iter().flat_map(|v| (*v as f32).to_le_bytes()));
    bytes.extend([2, 0, 0, 128, 63, 0, 0, 128, 63]);
    bytes.extend([1, 5, 0, 0, 0]);
    assert_is_the_one("extras", &bytes);
    assert!(read("extras", &bytes).unwrap().notes.is_empty());
}

#[test]
fn red_green_blue_replace_f_dc() {
    let names = ["x", "y", "z", "opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"];
    let head = header("ascii", "1", &names)
        .replace("end_header", "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header");
    let scene = read("rgb", format!("{head}0 0 0 0 0 0 0 1 0 0 0 255 0 51\n").as_bytes()).unwrap();
    assert!(scene.gaussians.base_color(0).abs_diff_eq(Vec3::new(1.0, 0.0, 0.2), 1e-6));
}

#[test]
fn harmonics_are_channel_major_in_the_file() {
    for (degree, n) in [(1, 3), (2, 8), (3, 15)] {
        let (mut names, mut values) = one();
        let rest = rest_names(3 * n);
        names.extend(rest.iter().map(String::as_str));
        values.extend((0..3 * n).map(|i| i as f64));
        let g = read("sh", &ply(&names, &[values])).unwrap().gaussians;
        assert_eq!(g.sh_degree, degree);
        let second = Vec3::new(1.0, 1.0 + n as f32, 1.0 + 2.0 * n as f32);
        assert_eq!((g.sh_rest.len(), g.sh_rest_of(0)[1]), (n, second));
    }
}

#[test]
fn two_scales_are_a_flat_gaussian() {
    let (names, values): (Vec<&str>, Vec<f64>) = PROPERTIES.into_iter().filter(|(name, _)| *name != "scale_2").unzip();
    let scene = read("2dgs", &ply(&names, &[values])).unwrap();
    assert!(scene.gaussians.scales[0].z.abs() <= 0.0);
    assert_eq!(scene.notes, ["no scale_2: the Gaussians are flat (2DGS)"]);
}

#[test]
fn object_ids_come_from_the_file() {
    let (mut names, values) = one();
    names.push("instance_id");
    let rows: Vec<Vec<f64>> = [3.0, 0.0, -1.0, 65535.0].map(|id| values.iter().copied().chain([id]).collect()).to_vec();
    assert_eq!(read("ids", &ply(&names, &rows)).unwrap().gaussians.ids, [3, 0, 0, 65535]);
    let odd: Vec<Vec<f64>> = [3.0, 0.5].map(|id| values.iter().copied().chain([id]).collect()).to_vec();
    let scene = read("ids", &ply(&names, &odd)).unwrap();
    assert!(scene.gaussians.ids.is_empty());
    assert_eq!(
        scene.notes,
        ["property instance_id is not used as object ids: 0.5 at Gaussian 1, expected whole numbers from 0 to 65535"]
    );
}

#[test]
fn comments_name_the_filter_and_the_up_axis() {
    let (names, values) = one();
    let with = |comment: &str| {
        let plain = String::from_utf8(ply(&names, &[])).unwrap().replace("vertex 0", "vertex 1");
        let mut bytes = plain.replace("element", &format!("comment {comment}\nelement")).into_bytes();
        bytes.extend(values.iter().flat_map(|v| (*v as f32).to_le_bytes()));
        read("comment", &bytes).unwrap()
    };
    assert_eq!(with("SplatRenderMode: mip").filter, Some(SplatFilter::Mip));
    assert_eq!(with("SplatRenderMode: default").filter, Some(SplatFilter::Classic));
    assert_eq!(with("antialiased 1").filter, Some(SplatFilter::Mip));
    assert_eq!(with("hello").filter, None);
    let up = |comment: &str| (with(comment).up, with(comment).up_source);
    assert_eq!(up("Vertical Axis: z"), (DVec3::Z, UpSource::File("Vertical Axis: z".to_owned())));
    assert_eq!(up("Vertical axis: y").0, DVec3::NEG_Y);
    assert_eq!(up("Vertical axis: +y").0, DVec3::Y);
    assert!(matches!(up("the vertical axis is fine").1, UpSource::Estimated(_)));
}

#[test]
fn filter_3d_means_a_small_dilation() {
    let (mut names, mut values) = one();
    names.push("filter_3D");
    values.push(0.01);
    assert_eq!(read("mip", &ply(&names, &[values])).unwrap().filter, Some(SplatFilter::MipSmall));
}

#[test]
fn inconsistent_headers_are_rejected() {
    let (names, _) = one();
    for count in ["1152921504606846976", "18446744073709551615", "-1", "1e23", "4e9", "four", "4294967296"] {
        assert_eq!(code("count", header("binary_little_endian", count, &names).as_bytes()), "PLY-COUNT", "{count}");
    }
    assert_eq!(code("long", header("binary_little_endian", "4000000000", &names).as_bytes()), "PLY-TRUNCATED");
    assert_eq!(code("none", header("binary_little_endian", "0", &names).as_bytes()), "SCENE-EMPTY");
    let good = header("ascii", "1", &names) + "1 2 3 .1 .2 .3 1 0 0 0 1 0 0 0\n";
    let broken: [(&str, String); 13] = [
        ("no end", good.replace("end_header\n", "")),
        ("no line end", "ply\n".to_owned() + &"x".repeat(70_000)),
        ("too long", good.replace("element", &("comment ".to_owned() + &"x".repeat(66_000) + "\nelement"))),
        ("NUL", good.replace("vertex", "ver\0tex")),
        ("unknown type", good.replace("float x", "quad x")),
        ("twice", good.replace("float y", "float x")),
        ("no color", good.replace("f_dc_", "color_")),
        ("two colors", good.replace("property float f_dc_2\n", "")),
        ("no opacity", good.replace("opacity", "transparency")),
        ("no format", good.replace("format ascii 1.0\n", "")),
        ("version 2", good.replace("ascii 1.0", "ascii 2.0")),
        ("property first", good.replace("element vertex 1\n", "")),
        ("44 rest", good.replace("end_header", &(properties("float", &rest_names(44)) + "end_header"))),
    ];
    for (name, text) in broken {
        assert_eq!(code(name, text.as_bytes()), "PLY-HEADER", "{name}");
    }
    assert_eq!(code("word", good.replace(".2", "much").as_bytes()), "PLY-VALUE");
    assert!(read("good", good.as_bytes()).is_ok());
}

#[test]
fn truncated_error_names_row_and_byte() {
    let (names, values) = one();
    let bytes = ply(&names, &vec![values; 4]);
    let cut = bytes.len() - 60;
    let error = read("scene.ply", &bytes[..cut]).unwrap_err();
    let start = bytes.len() - 4 * 56;
    assert_eq!(
        error.to_string(),
        format!("scene.ply: vertex 3 of 4 ends at byte {} or later, file has {cut}", start + 3 * 56)
    );
    assert_eq!(error.code(), "PLY-TRUNCATED");
}

#[test]
fn bytes_after_the_last_row_give_a_note() {
    let (names, values) = one();
    let mut bytes = ply(&names, &[values]);
    bytes.extend([0; 5]);
    assert_eq!(read("tail", &bytes).unwrap().notes, ["5 bytes after the last element are ignored"]);
}
