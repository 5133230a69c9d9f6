use cinesplat::export::{Format, Imported, read};
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
    let doubt = "tum (8 columns, seconds, quaternion x y z w), or euroc (seconds, quaternion w x y z)";
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

/// ORB-SLAM3 writes its paths on EuRoC as nanoseconds with six decimals and w last, DPVO in exponents: both were read as
/// EuRoC's own ground truth, with permuted quaternions.
#[test]
fn nanoseconds_of_orb_slam3_and_dpvo_keep_w_last() {
    let doubt = "dpvo (8 columns, nanoseconds, quaternion x y z w), or euroc (nanoseconds, quaternion w x y z)";
    let orb_slam3 = ["1403636579750000128.000000", "1403636579800000000.000000", "1403636579850000128.000000"];
    assert_eq!(read_as(&Layout { times: orb_slam3, ..TUM }), doubt);
    let dpvo = ["1.403636579750000128e+18", "1.403636579800000000e+18", "1.403636579850000128e+18"];
    assert_eq!(read_as(&Layout { times: dpvo, ..TUM }), doubt);
    // A header that names the columns is more.
    let named = Layout { head: "# t x y z qw qx qy qz\n", turn: W_FIRST, times: orb_slam3, ..TUM };
    assert!(read_as(&named).starts_with("euroc"), "{}", read_as(&named));
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
        "euroc (17 columns, seconds, quaternion w x y z), or tum (seconds, quaternion x y z w)"
    );
}

#[test]
fn kitti_with_commas_is_not_read_as_euroc() {
    let (path, _folder) = file("a.txt", b"1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7,\r\n");
    let imported = read(&path, None).unwrap();
    assert_eq!((imported.format, imported.doubt), (Format::Kitti, None));
    assert_eq!(imported.track.frames[0].pose.position, DVec3::new(5.0, 6.0, 7.0));
}

/// A CSV of seconds with w first has nothing that tells it from TUM with commas; the flag used to make nanoseconds of it.
#[test]
fn a_named_format_decides_the_order_and_the_stamps_the_unit() {
    let (path, _folder) = file("a.txt", b"0.0,1,2,3,0,0,0,1\n0.5,1,2,3,0,0,0,1\n");
    let as_euroc = read(&path, Some(Format::Euroc)).unwrap();
    assert_eq!((as_euroc.track.frames[1].time_secs, as_euroc.doubt), (0.5, None));
    assert_eq!(as_euroc.track.frames[1].pose.rotation.z, 1.0);
    assert_eq!(as_euroc.track.unread, ["the times are read as seconds: as nanoseconds they make no path"]);
    let as_tum = read(&path, Some(Format::Tum)).unwrap();
    assert_eq!((as_tum.track.frames[1].time_secs, as_tum.track.frames[1].pose.rotation.w), (0.5, 1.0));
}

#[test]
fn milliseconds_and_microseconds_since_1970_are_not_read_as_seconds() {
    let millis = ["1403636579750", "1403636579800", "1403636579850"];
    let doubt =
        |unit: &str| format!("tum (8 columns, {unit}, quaternion x y z w), or euroc ({unit}, quaternion w x y z)");
    assert_eq!(read_as(&Layout { times: millis, ..TUM }), doubt("milliseconds"));
    let micros = ["1403636579750000", "1403636579800000", "1403636579850000"];
    assert_eq!(read_as(&Layout { times: micros, ..TUM }), doubt("microseconds"));
}

/// Poses whose first column counts `start`, `start + step`, and so on, behind a header.
fn stamped(head: &str, start: i64, step: i64) -> Imported {
    let line = |idx: i64| format!("{} {idx} 2 3 0.1 0.2 0.3 0.92736184954957\n", start + idx * step);
    let (path, _folder) = file("a.txt", (head.to_owned() + &(0..4).map(line).collect::<String>()).as_bytes());
    read(&path, None).unwrap()
}

/// Time from the first pose to the second, s.
fn step_secs(imported: &Imported) -> f64 {
    imported.track.frames[1].time_secs - imported.track.frames[0].time_secs
}

#[test]
fn a_header_that_names_the_unit_wins_over_the_steps() {
    let millis = stamped("# time [ms] x y z qx qy qz qw\n", 0, 40);
    assert_eq!(step_secs(&millis), 0.04);
    assert_eq!(millis.track.unread, ["the times are read as milliseconds: the stamps look like seconds"]);
    let (path, _folder) = file("a.txt", b"# time [ms]\n0 1 2 3 0 0 0 1\n40 1 2 3 0 0 0 1\n");
    assert_eq!(read(&path, Some(Format::Tum)).unwrap().track.frames[1].time_secs, 0.04);
    // A unit behind that of the time is another column's, and a text of seconds is no header.
    assert_eq!(step_secs(&stamped("# time [s], exposure [ms], 50 x\n", 0, 2)), 2.0);
    assert_eq!(step_secs(&stamped("# a walk of 30 seconds\n", 0, 50_000_000)), 0.05);
    // Stamps of 1970 and later are what they are.
    assert!((step_secs(&stamped("# time [s]\n", 1_403_636_579_750_000_000, 50_000_000)) - 0.05).abs() < 1e-6);
    assert!((step_secs(&stamped("# time [s]\n", 1_403_636_579_750, 50)) - 0.05).abs() < 1e-6);
}

#[test]
fn whole_stamps_that_may_be_milliseconds_are_in_doubt() {
    let imported = stamped("", 0, 33);
    assert_eq!(step_secs(&imported), 33.0);
    assert!(imported.track.unread[0].contains("`# time [ms]`"), "{:?}", imported.track.unread);
    assert_eq!((stamped("", 0, 1).track.unread, stamped("", 1_403_636_579, 33).track.unread), (vec![], vec![]));
}

#[test]
fn slow_milliseconds_and_nanoseconds_since_the_start_of_a_machine_are_told_apart() {
    assert_eq!(step_secs(&stamped("", 1_403_636_579_750, 5_000)), 5.0);
    assert_eq!(step_secs(&stamped("", 1_403_636_579_750, 600_000)), 600.0);
    let since_start = stamped("", 1_000_000_000_000_000, 2_000_000);
    assert!((step_secs(&since_start) - 0.002).abs() < 1e-6);
    assert!((step_secs(&stamped("", 1_000_000_000_000_000, 33_333_333)) - 0.033_333).abs() < 1e-6);
    assert!((step_secs(&stamped("", 1_403_636_579_750_000, 33_333)) - 0.033_333).abs() < 1e-6);
}

/// Further columns, such as a number of features, used to make EuRoC of a TUM file, with permuted quaternions.
#[test]
fn tum_with_further_columns_keeps_the_order_of_its_quaternions() {
    let doubt = "tum (9 columns, seconds, quaternion x y z w), or euroc (seconds, quaternion w x y z)";
    assert_eq!(read_as(&Layout { tail: " 57\n", ..TUM }), doubt);
}

/// All lines used to be one line, of which the first pose was read.
#[test]
fn lines_may_end_with_carriage_returns() {
    assert_eq!(read_as(&Layout { tail: "\r", ..TUM }), "tum");
    assert_eq!(read_as(&Layout { tail: "\r", head: "#timestamp [ns], x, y, z, qw, qx, qy, qz\r", ..EUROC }), "euroc");
    assert_eq!(read_as(&Layout { tail: "\r", head: "# made by hand\n", ..TUM }), "tum");
    assert_eq!(read_as(&Layout { tail: "\r", head: "# made by hand\r\n", ..TUM }), "tum");
}

#[test]
fn a_camera_that_never_turns_may_have_w_first() {
    let (path, _folder) = file("a.txt", b"0.0 1 2 3 1 0 0 0\n0.5 1 2 3 1 0 0 0\n");
    let imported = read(&path, None).unwrap();
    assert_eq!(imported.track.frames[0].pose.rotation.x, 1.0);
    assert_eq!(imported.doubt.unwrap().other, Format::Euroc);
    let (path, _folder) = file("a.txt", b"0.0 1 2 3 0 0 0 1\n0.5 1 2 3 0 0 0 1\n");
    assert_eq!(read(&path, None).unwrap().doubt, None);
}

#[test]
fn a_file_of_two_units_of_time_is_refused() {
    let text = b"1403636579.75 1 2 3 0 0 0 1\n1403636579.80 1 2 3 0 0 0 1\n1403636579850000128 1 2 3 0 0 0 1\n";
    let (path, _folder) = file("a.txt", text);
    let error = read(&path, None).unwrap_err().to_string();
    assert!(error.contains("line 2") || error.contains("line 3"), "{error}");
    assert!(error.contains("a time in the unit of the line before"), "{error}");
}

#[test]
fn kitti_as_4_x_4_matrices_is_read() {
    let (path, _folder) = file("a.txt", b"1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1\n1 0 0 6 0 1 0 6 0 0 1 7 0 0 0 1\n");
    let imported = read(&path, None).unwrap();
    assert_eq!((imported.format, imported.track.frames.len()), (Format::Kitti, 2));
    assert_eq!(imported.track.frames[1].pose.position, DVec3::new(6.0, 6.0, 7.0));
    let (path, _folder) = file("a.txt", b"1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1\n1 0 0 6 0 1 0 6 0 0 1 7 0 0 0 2\n");
    assert!(read(&path, None).unwrap_err().to_string().contains("line 2"));
    let (path, _folder) = file("a.txt", b"1 0 0 5 0 1 0 6 0 0 1 7 1e-9 0 -1e-9 0.9999999\n");
    assert_eq!(read(&path, None).unwrap().track.frames[0].pose.position, DVec3::new(5.0, 6.0, 7.0));
}

#[test]
fn kitti_with_nanoseconds_is_not_read_as_seconds() {
    let line = |idx: i64| format!("{} 1 0 0 5 0 1 0 6 0 0 1 7\n", 1_403_715_524_900_000_000 + 50_000_000 * idx);
    let (path, _folder) = file("a.txt", (0..3).map(line).collect::<String>().as_bytes());
    let track = read(&path, None).unwrap().track;
    assert!((track.frames[2].time_secs - 1_403_715_525.0).abs() < 1e-6, "{}", track.frames[2].time_secs);
    assert_eq!(track.unread, ["the times are read as nanoseconds: as seconds they make no path"]);
}

#[test]
fn comments_of_matlab_are_skipped() {
    let (path, _folder) = file("a.txt", b"% time x y z qx qy qz qw\n0.1 1 2 3 0 0 0 1\n% half\n0.2 1 2 4 0 0 0 1\n");
    let found = read(&path, None).unwrap();
    assert_eq!((found.format, found.track.frames.len()), (Format::Tum, 2));
}

/// `DataFrame.to_csv` of pandas writes the numbers of the rows in a first column without a name.
#[test]
fn the_index_column_of_pandas_is_skipped_aloud() {
    let rows = |start: &str, header: &str, separator: char| {
        let row = |idx: u32| {
            format!("{idx},{start}.{idx}659,1.5,0.5,{idx},0,0.6,0,0.8\n").replace(',', &separator.to_string())
        };
        header.replace(',', &separator.to_string()) + &(0..5).map(row).collect::<String>()
    };
    for separator in [',', ';'] {
        let text = rows("1305031098", ",timestamp,x,y,z,qx,qy,qz,qw\n", separator);
        let (path, _folder) = file("a.csv", text.as_bytes());
        let found = read(&path, None).unwrap();
        assert_eq!((found.format, found.track.frames.len()), (Format::Tum, 5));
        let frame = &found.track.frames[3];
        assert!((frame.time_secs - 1_305_031_098.365_9).abs() < 1e-6 && frame.pose.position.z == 3.0);
        assert!((frame.pose.rotation.y - 0.6).abs() < 1e-12);
        assert_eq!(found.track.unread, ["the first column has no name and is not read: an index of the lines"]);
    }
    let (path, _folder) = file("b.csv", rows("7", ",time_secs,x,y,z,qx,qy,qz,qw\n", ',').as_bytes());
    let found = read(&path, None).unwrap();
    assert_eq!((found.format, found.track.frames[4].pose.position.z), (Format::Csv, 4.0));
    // An error names the line of the file.
    let damaged = rows("7", ",time_secs,x,y,z,qx,qy,qz,qw\n", ',').replace("2,7.2659,1.5", "2,7.2659,left");
    let (path, _folder) = file("b.csv", damaged.as_bytes());
    assert!(read(&path, None).unwrap_err().to_string().starts_with("line 4: "));
}

#[test]
fn unread_columns_and_odd_flags_of_a_csv_are_told() {
    let csv = |head: &str, cell: &str| format!("time_secs,x,y,z,qx,qy,qz,qw,{head}\n0,1,2,3,0,0,0,1,{cell}\n");
    let (path, _folder) = file("a.csv", csv("note", "hi").as_bytes());
    assert_eq!(read(&path, None).unwrap().track.unread, ["columns that are not read: note"]);
    let (path, _folder) = file("a.csv", csv("cut", "TRUE").as_bytes());
    let found = read(&path, None).unwrap().track;
    assert!(found.frames[0].cut && found.unread.is_empty());
    let (path, _folder) = file("a.csv", csv("cut", "yes").as_bytes());
    assert!(read(&path, None).unwrap_err().to_string().contains("1, 0, true or false"));
}

#[test]
fn pictures_are_in_the_order_of_the_numbers_in_their_names() {
    let images = [10, 9, 100, 1].map(|k| format!("{k} 1 0 0 0 {k} 0 0 1 frame_{k}.png\n\n")).concat();
    let (path, _folder) = file("images.txt", images.as_bytes());
    let places: Vec<f64> = read(&path, None).unwrap().track.frames.iter().map(|frame| -frame.pose.position.x).collect();
    assert_eq!(places, [1.0, 9.0, 10.0, 100.0]);
}

#[test]
fn pictures_out_of_order_are_told() {
    let frame = |name: &str| {
        format!(r#"{{"file_path":"{name}","transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}}"#)
    };
    let names = [["1.png", "9.png", "10.png"], ["9.png", "1.png", "10.png"]].map(|names| {
        let text = format!(r#"{{"fl_y":700,"w":1000,"h":700,"frames":[{}]}}"#, names.map(frame).join(","));
        let (path, _folder) = file("transforms.json", text.as_bytes());
        read(&path, None).unwrap().track.unread.join("; ")
    });
    assert_eq!(names[0], "");
    assert!(names[1].ends_with("(1.png is behind 9.png)"), "{}", names[1]);
}

/// A lens of another projection without distortion coefficients used to be a pinhole without a word.
#[test]
fn lens_models_that_are_no_pinhole_are_told() {
    let text = r#"{"camera_model":"EQUIRECTANGULAR","fl_y":700,"w":1000,"h":700,"frames":[{"transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]}"#;
    let (path, _folder) = file("transforms.json", text.as_bytes());
    assert_eq!(
        read(&path, None).unwrap().track.unread,
        ["the lens model EQUIRECTANGULAR is read as a pinhole of the same focal length"]
    );
}

#[test]
fn unknown_content_is_shown() {
    let (path, _folder) = file("a.txt", b"# exported\n0,5 1,0 2,0 3,0 0,0 0,0 0,0 1,0\n");
    let error = read(&path, None).unwrap_err().to_string();
    assert!(error.contains("line 2: \"0,5 1,0 2,0 3,0 0,0 0,0 0,0 1,0\""), "{error}");
}
