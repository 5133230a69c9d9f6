use cinesplat::export::{Format, read};
use glam::DVec3;
use strum::VariantArray;

use super::sample_shot::file;

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

/// Three poses at 20 frames per second, turned by (0.1, 0.2, 0.3) in x, y, z, written in any layout.
struct Layout<'a> {
    head: &'a str,
    times: [&'a str; 3],
    /// The quaternion, in the order of the file.
    turn: [&'a str; 4],
    separator: &'a str,
    /// Text at the end of each line.
    tail: &'a str,
}

const UNIX_SECS: [&str; 3] = ["1403636579.75", "1403636579.80", "1403636579.85"];
const UNIX_NANOS: [&str; 3] = ["1403636579750000128", "1403636579800000000", "1403636579850000128"];
const W_LAST: [&str; 4] = ["0.1", "0.2", "0.3", "0.927361849549570"];
const W_FIRST: [&str; 4] = ["0.927361849549570", "0.1", "0.2", "0.3"];

const TUM: Layout = Layout { head: "", times: UNIX_SECS, turn: W_LAST, separator: " ", tail: "\n" };
const EUROC: Layout = Layout { head: "", times: UNIX_NANOS, turn: W_FIRST, separator: ",", tail: "\n" };
const BIASES: &str = ",0.1,0.2,0.3,0.01,0.02,0.03,0.4,0.5,0.6\n";

/// The format, and the doubt as one line; asserts that times, positions and rotations are the true ones.
fn read_as(layout: &Layout) -> String {
    let mut text = layout.head.to_owned();
    for (idx, time) in layout.times.iter().enumerate() {
        let [x, y, z] = [format!("{idx}.5"), "-2".to_owned(), "3".to_owned()];
        let turn = layout.turn.map(str::to_owned);
        let cells = [[(*time).to_owned(), x, y, z], turn].concat();
        text += &(cells.join(layout.separator) + layout.tail);
    }
    let (path, _folder) = file("poses.dat", text.as_bytes());
    let imported = read(&path, None).unwrap_or_else(|error| panic!("{text}: {error}"));
    assert_eq!(imported.track.frames.len(), 3, "{text}");
    let first_secs = imported.track.frames[0].time_secs;
    for (idx, frame) in imported.track.frames.iter().enumerate() {
        assert!((frame.time_secs - first_secs - idx as f64 * 0.05).abs() < 1e-6, "{text}: {}", frame.time_secs);
        assert_eq!(frame.pose.position, DVec3::new(idx as f64 + 0.5, -2.0, 3.0), "{text}");
        let turn = frame.pose.rotation;
        assert!(
            (DVec3::new(turn.x, turn.y, turn.z) - DVec3::new(0.1, 0.2, 0.3)).length() < 1e-9 && turn.w > 0.9,
            "{text}: {turn}"
        );
    }
    match imported.doubt {
        None => format!("{}", imported.format),
        Some(doubt) => format!("{}, or {} ({})", doubt.read_as, doubt.other, doubt.other_reading),
    }
}

#[test]
fn tum_and_euroc_as_documented_are_certain() {
    assert_eq!(read_as(&TUM), "tum");
    assert_eq!(read_as(&EUROC), "euroc");
    assert_eq!(read_as(&Layout { tail: BIASES, ..EUROC }), "euroc");
    assert_eq!(read_as(&Layout { times: ["0", "50000000", "100000000"], ..EUROC }), "euroc");
    assert_eq!(read_as(&Layout { times: ["0", "0.05", "0.1"], ..TUM }), "tum");
}

#[test]
fn tum_with_commas_is_not_read_as_euroc() {
    let commas = Layout { separator: ",", ..TUM };
    let doubt = "tum (8 columns, seconds, quaternion x y z w), or euroc (nanoseconds, quaternion w x y z)";
    assert_eq!(read_as(&commas), doubt);
    assert_eq!(read_as(&Layout { times: ["0", "0.05", "0.1"], separator: ", ", ..TUM }), doubt);
    assert_eq!(read_as(&Layout { head: "# timestamp tx ty tz qx qy qz qw\n", ..commas }), "tum");
    assert_eq!(read_as(&Layout { head: "time,px,py,pz,qx,qy,qz,qw\n", tail: ",\r\n", ..commas }), "tum");
    assert_eq!(read_as(&Layout { separator: ";", head: "\u{feff}# timestamp;tx;ty;tz;qx;qy;qz;qw\r\n", ..TUM }), "tum");
}

#[test]
fn euroc_with_spaces_is_not_read_as_tum() {
    let spaces = Layout { separator: " ", ..EUROC };
    let doubt = "euroc (8 columns, nanoseconds, quaternion w x y z), or dpvo (nanoseconds, quaternion x y z w)";
    assert_eq!(read_as(&spaces), doubt);
    assert_eq!(read_as(&Layout { separator: "\t", tail: "\r\n", head: "\u{feff}", ..EUROC }), doubt);
    assert_eq!(read_as(&Layout { tail: &BIASES.replace(',', " "), ..spaces }), "euroc");
    let head =
        "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n";
    assert_eq!(read_as(&Layout { head, tail: ",\r\n", ..spaces }), "euroc");
}

#[test]
fn a_header_decides_the_order_of_the_quaternion() {
    let seconds_w_first = Layout { head: "# t x y z qw qx qy qz\n", turn: W_FIRST, ..TUM };
    assert_eq!(
        read_as(&seconds_w_first),
        "tum (8 columns, seconds, quaternion w x y z), or tum (seconds, quaternion x y z w)"
    );
    let nanos_w_last = Layout { head: "stamp_ns,x,y,z,q_x,q_y,q_z,q_w\n", turn: W_LAST, ..EUROC };
    assert_eq!(
        read_as(&nanos_w_last),
        "euroc (8 columns, nanoseconds, quaternion x y z w), or euroc (nanoseconds, quaternion w x y z)"
    );
    let seconds_and_biases = Layout { times: UNIX_SECS, tail: BIASES, ..EUROC };
    assert_eq!(
        read_as(&seconds_and_biases),
        "euroc (17 columns, seconds, quaternion w x y z), or euroc (nanoseconds, quaternion w x y z)"
    );
}

#[test]
fn kitti_with_commas_is_not_read_as_euroc() {
    let (path, _folder) = file("a.txt", b"1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7,\r\n");
    let imported = read(&path, None).unwrap();
    assert_eq!((imported.format, imported.doubt), (Format::Kitti, None));
    assert_eq!(imported.track.frames[0].pose.position, DVec3::new(5.0, 6.0, 7.0));
}

#[test]
fn a_named_format_is_read_as_it_is_defined() {
    let (path, _folder) = file("a.txt", b"0.0,1,2,3,0,0,0,1\n0.5,1,2,3,0,0,0,1\n");
    let as_euroc = read(&path, Some(Format::Euroc)).unwrap();
    assert_eq!((as_euroc.track.frames[1].time_secs, as_euroc.doubt), (0.5e-9, None));
    assert_eq!(as_euroc.track.frames[1].pose.rotation.z, 1.0);
    let as_tum = read(&path, Some(Format::Tum)).unwrap();
    assert_eq!((as_tum.track.frames[1].time_secs, as_tum.track.frames[1].pose.rotation.w), (0.5, 1.0));
}
