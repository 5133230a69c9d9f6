//! Recordings of ROS, written here byte by byte as their specifications say.

use cinesplat::export::{ExportError, Format, Imported, read};
use glam::DVec3;

use super::sample_shot::file;

fn counted(bytes: &[u8]) -> Vec<u8> {
    [&(bytes.len() as u32).to_le_bytes()[..], bytes].concat()
}

/// Header, body and pose of a message: x is `idx`, the time `100 + idx / 10` s. In CDR numbers are aligned to their size.
fn body(idx: u32, frame: &str, child: Option<&str>, is_cdr: bool) -> Vec<u8> {
    let mut out = if is_cdr { vec![] } else { idx.to_le_bytes().to_vec() };
    out.extend(100_u32.to_le_bytes());
    out.extend((idx * 100_000_000).to_le_bytes());
    for text in std::iter::once(frame).chain(child) {
        while is_cdr && out.len() % 4 != 0 {
            out.push(0);
        }
        let zero: &[u8] = if is_cdr { &[0] } else { &[] };
        out.extend(counted(&[text.as_bytes(), zero].concat()));
    }
    while is_cdr && out.len() % 8 != 0 {
        out.push(0);
    }
    for number in [f64::from(idx), 2.0, 3.0, 0.0, 0.0, 0.6, 0.8] {
        out.extend(number.to_le_bytes());
    }
    out
}

fn record(fields: &[(&str, &[u8])], data: &[u8]) -> Vec<u8> {
    let header: Vec<u8> = fields.iter().flat_map(|(name, v)| counted(&[name.as_bytes(), b"=", *v].concat())).collect();
    [counted(&header), counted(data)].concat()
}

/// A bag with a topic per name and type, three messages each, in one chunk.
fn bag(topics: &[(&str, &str)], packing: &str) -> Vec<u8> {
    let mut chunk = Vec::new();
    for (conn, (name, kind)) in (0_u32..).zip(topics) {
        let own: Vec<u8> = counted(&[b"type=", kind.as_bytes()].concat());
        let conn = conn.to_le_bytes();
        chunk.extend(record(&[("op", &[7]), ("conn", &conn), ("topic", name.as_bytes())], &own));
        for idx in 0..3 {
            let message = match *kind {
                "nav_msgs/Odometry" => body(idx, "odom", Some("base"), false),
                "tf2_msgs/TFMessage" => [
                    &2_u32.to_le_bytes()[..],
                    &body(idx, "map", Some("odom"), false),
                    &body(idx, "odom", Some("base"), false),
                ]
                .concat(),
                "std_msgs/String" => counted(b"no pose"),
                _ => body(idx, "map", None, false),
            };
            chunk.extend(record(&[("op", &[2]), ("conn", &conn), ("time", &[0; 8])], &message));
        }
    }
    let chunk = record(&[("op", &[5]), ("compression", packing.as_bytes()), ("size", &[0; 4])], &chunk);
    [b"#ROSBAG V2.0\n".to_vec(), record(&[("op", &[3])], &[b' '; 40]), chunk].concat()
}

fn mcap_record(kind: u8, data: &[u8]) -> Vec<u8> {
    [&[kind][..], &(data.len() as u64).to_le_bytes(), data].concat()
}

/// An MCAP file of ROS 2 with one topic of odometry in a plain chunk.
fn mcap(packing: &str) -> Vec<u8> {
    let schema =
        [&1_u16.to_le_bytes()[..], &counted(b"nav_msgs/msg/Odometry"), &counted(b"ros2msg"), &counted(b"")].concat();
    let ids = [4_u16.to_le_bytes(), 1_u16.to_le_bytes()].concat();
    let channel = [ids, counted(b"/odom"), counted(b"cdr"), counted(b"")].concat();
    let mut chunk = [mcap_record(3, &schema), mcap_record(4, &channel)].concat();
    for idx in 0..3 {
        let head = [&4_u16.to_le_bytes()[..], &[0; 20], &[0, 1, 0, 0]].concat();
        chunk.extend(mcap_record(5, &[head, body(idx, "odom", Some("base_footprint"), true)].concat()));
    }
    let size = (chunk.len() as u64).to_le_bytes();
    let packed = [&[0; 16][..], &size, &[0; 4], &counted(packing.as_bytes()), &size, &chunk].concat();
    [
        b"\x89MCAP0\r\n".to_vec(),
        mcap_record(1, &[0; 8]),
        mcap_record(6, &packed),
        mcap_record(2, &[0; 20]),
        b"\x89MCAP0\r\n".to_vec(),
    ]
    .concat()
}

fn topic(name: &str, bytes: &[u8], topic: &str) -> Result<Imported, ExportError> {
    let (path, _folder) = file(name, bytes);
    let named = if topic.is_empty() { path } else { format!("{}#{topic}", path.display()).into() };
    read(&named, None)
}

fn assert_poses(imported: &Imported) {
    assert_eq!((imported.format, imported.track.frames.len()), (Format::Ros, 3));
    assert_eq!(imported.track.up, Some(DVec3::Z));
    for (idx, frame) in imported.track.frames.iter().enumerate() {
        assert!((frame.time_secs - 100.0 - 0.1 * idx as f64).abs() < 1e-9);
        assert_eq!(frame.pose.position, DVec3::new(idx as f64, 2.0, 3.0));
        assert!((frame.pose.rotation.z - 0.6).abs() < 1e-12 && (frame.pose.rotation.w - 0.8).abs() < 1e-12);
    }
}

#[test]
fn every_kind_of_message_with_poses_is_read_from_a_bag() {
    for kind in ["geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped", "nav_msgs/Odometry"] {
        assert_poses(&topic("a.bag", &bag(&[("/chat", "std_msgs/String"), ("/pose", kind)], "none"), "").unwrap());
    }
    let transforms = bag(&[("/tf", "tf2_msgs/TFMessage")], "none");
    assert_poses(&topic("a.bag", &transforms, "/tf:odom.base").unwrap());
    assert_poses(&topic("a.bag", &transforms, "/tf:map.odom").unwrap());
}

#[test]
fn one_of_several_topics_must_be_named() {
    let bytes = bag(&[("/a", "geometry_msgs/PoseStamped"), ("/tf", "tf2_msgs/TFMessage")], "none");
    let refused = |name: &str| topic("a.bag", &bytes, name).unwrap_err().to_string();
    let listed = "expected one of /a (3), /tf:map.odom (3), /tf:odom.base (3)";
    assert_eq!(refused(""), format!("topic (RECORDING#TOPIC): found none, {listed}"));
    assert!(refused("/b").ends_with(listed));
    assert_poses(&topic("a.bag", &bytes, "/a").unwrap());
}

#[test]
fn recordings_of_ros_2_are_read_from_mcap() {
    let imported = topic("a.mcap", &mcap(""), "/odom").unwrap();
    assert_poses(&imported);
    assert_eq!(
        imported.track.unread,
        ["/odom: the axes of the body base_footprint count as those of a camera: x right, y down, z forward"]
    );
}

#[test]
fn packed_parts_without_a_reader_name_the_command_that_unpacks_them() {
    let error = topic("a.bag", &bag(&[("/a", "geometry_msgs/PoseStamped")], "bz2"), "").unwrap_err().to_string();
    assert!(error.contains("bz2") && error.contains("rosbag decompress"), "{error}");
    let error = topic("a.mcap", &mcap("lzma"), "").unwrap_err().to_string();
    assert!(error.contains("lzma") && error.contains("mcap compress"), "{error}");
    // What says that it is packed with LZ4 and is not.
    let error = topic("a.mcap", &mcap("lz4"), "").unwrap_err().to_string();
    assert!(error.contains("bytes packed with lz4"), "{error}");
    let error = topic("a.bag", &bag(&[("/a", "geometry_msgs/PoseStamped")], "lz4"), "").unwrap_err().to_string();
    assert!(error.contains("bytes packed with lz4"), "{error}");
}

#[test]
fn a_recording_that_ends_inside_a_record_is_an_error() {
    let (bag, mcap) = (bag(&[("/a", "nav_msgs/Odometry")], "none"), mcap(""));
    // Behind its chunk an MCAP file has a footer of 29 bytes, and its first bytes again.
    let is_whole = |end: usize| end == mcap.len() - 37 || end >= mcap.len() - 8;
    let cuts = (0..bag.len()).map(|end| &bag[..end]);
    for cut in cuts.chain((0..mcap.len()).filter(|end| !is_whole(*end)).map(|end| &mcap[..end])) {
        let (path, _folder) = file("a.bin", cut);
        assert!(read(&path, Some(Format::Ros)).is_err(), "{} bytes", cut.len());
    }
    assert_poses(&topic("a.mcap", &mcap[..mcap.len() - 37], "").unwrap());
}

#[test]
fn a_file_that_is_no_recording_is_refused() {
    for bytes in [&b""[..], b"a", b"1 2 3 4 0 0 0 1\n"] {
        let (path, _folder) = file("a.bin", bytes);
        let error = read(&path, Some(Format::Ros)).unwrap_err();
        assert!(matches!(error, ExportError::WrongFormat { .. }), "{error}");
    }
}

#[test]
fn a_pose_that_is_none_spoils_its_own_topic_alone() {
    let mut bytes = bag(&[("/a", "geometry_msgs/PoseStamped"), ("/b", "geometry_msgs/PoseStamped")], "none");
    // The last number of the last message is w of /b.
    let end = bytes.len();
    bytes[end - 8..].copy_from_slice(&f64::NAN.to_le_bytes());
    assert_poses(&topic("a.bag", &bytes, "/a").unwrap());
    let error = topic("a.bag", &bytes, "/b").unwrap_err().to_string();
    assert!(error.starts_with("/b at 100.2 s: found the pose"), "{error}");
}

#[test]
fn two_bodies_on_one_topic_are_two_paths() {
    let mut chunk =
        record(&[("op", &[7]), ("conn", &[0; 4]), ("topic", b"/robots")], &counted(b"type=nav_msgs/Odometry"));
    for idx in 0..3 {
        for child in ["one", "two"] {
            chunk.extend(record(&[("op", &[2]), ("conn", &[0; 4])], &body(idx, "map", Some(child), false)));
        }
    }
    let bytes = [b"#ROSBAG V2.0\n".to_vec(), chunk].concat();
    let error = topic("a.bag", &bytes, "/robots").unwrap_err().to_string();
    assert!(error.ends_with("expected one of /robots:map.one (3), /robots:map.two (3)"), "{error}");
    assert_poses(&topic("a.bag", &bytes, "/robots:map.two").unwrap());
}

#[test]
fn a_header_has_a_limit() {
    let long = vec![b'x'; 70_000];
    let bytes = [b"#ROSBAG V2.0\n".to_vec(), record(&[("op", &[3]), ("x", &long)], b"")].concat();
    let error = topic("a.bag", &bytes, "").unwrap_err().to_string();
    assert!(error.contains("expected at most 65536"), "{error}");
}

/// A bag of transforms: topic, frame, child, and the numbers of the messages.
fn transforms(links: &[(&str, &str, &str, &[u32])]) -> Vec<u8> {
    let mut bytes = b"#ROSBAG V2.0\n".to_vec();
    for (conn, (name, frame, child, numbers)) in (0_u32..).zip(links) {
        let conn = conn.to_le_bytes();
        let own = counted(b"type=tf2_msgs/TFMessage");
        bytes.extend(record(&[("op", &[7]), ("conn", &conn), ("topic", name.as_bytes())], &own));
        for idx in *numbers {
            let message = [&1_u32.to_le_bytes()[..], &body(*idx, frame, Some(child), false)].concat();
            bytes.extend(record(&[("op", &[2]), ("conn", &conn)], &message));
        }
    }
    bytes
}

#[test]
fn transforms_are_joined_over_the_frames_between_two_frames() {
    let links: [(&str, &str, &str, &[u32]); 3] = [
        ("/tf", "map", "odom", &[0, 2, 4]),
        ("/tf", "odom", "base", &[1, 2, 3, 4, 5]),
        ("/tf_static", "base", "camera", &[7]),
    ];
    let bytes = transforms(&links);
    let frames = topic("a.bag", &bytes, "/tf:map.camera").unwrap().track.frames;
    // At the times of the most frequent transform, but for the last: map <- odom ends at 0.4 s.
    let times: Vec<f64> = frames.iter().map(|frame| ((frame.time_secs - 100.0) * 1e6).round() / 1e6).collect();
    assert_eq!(times, [0.1, 0.2, 0.3, 0.4]);
    // Every link is a turn by the same angle about z, and a place (number, 2, 3); numbers lie on a line.
    let turn = glam::DQuat::from_xyzw(0.0, 0.0, 0.6, 0.8);
    for (frame, number) in frames.iter().zip([1.0, 2.0, 3.0, 4.0]) {
        let place = |number: f64| DVec3::new(number, 2.0, 3.0);
        let expected = place(number) + turn * (place(number) + turn * place(7.0));
        assert!(frame.pose.position.distance(expected) < 1e-9, "{} {expected}", frame.pose.position);
        assert!(frame.pose.rotation.dot(turn * turn * turn).abs() > 1.0 - 1e-12);
    }
    // The other way around, and beside each other: the inverse.
    let back = topic("a.bag", &bytes, "/tf:camera.map").unwrap().track.frames;
    for (there, back) in frames.iter().zip(&back) {
        assert!(there.pose.compose(&back.pose).position.length() < 1e-9);
    }
    let named = topic(
        "a.bag",
        &transforms(&[links[0], links[1], ("/mounts", "base", "camera", &[7])]),
        "/tf:map.camera:/mounts",
    );
    assert_eq!(named.unwrap().track.frames, frames);
    // A static transform alone is one pose.
    assert_eq!(topic("a.bag", &bytes, "/tf:camera.base").unwrap().track.frames.len(), 1);
}

#[test]
fn frames_that_nothing_joins_are_refused_with_the_topics() {
    let bytes = transforms(&[("/tf", "map", "odom", &[0, 1]), ("/tf", "world", "base", &[0, 1])]);
    let error = topic("a.bag", &bytes, "/tf:map.base").unwrap_err().to_string();
    assert!(error.ends_with("expected one of /tf:map.odom (2), /tf:world.base (2)"), "{error}");
}

#[test]
fn transforms_in_a_circle_or_with_two_frames_above_are_errors() {
    let circle = transforms(&[("/tf", "a", "b", &[0, 1]), ("/tf", "b", "a", &[0, 1])]);
    let error = topic("a.bag", &circle, "/tf:a.c").unwrap_err().to_string();
    assert!(error.contains("transforms without a circle"), "{error}");
    let two = transforms(&[("/tf", "a", "c", &[0, 1]), ("/tf", "b", "c", &[0, 1]), ("/tf", "c", "d", &[0, 1])]);
    let error = topic("a.bag", &two, "/tf:a.d").unwrap_err().to_string();
    assert_eq!(error, "the frame c: found it below a, b, expected one frame above it");
}

#[test]
fn poses_at_times_that_a_link_is_not_known_at_are_counted() {
    let bytes = transforms(&[("/tf", "/map", "odom", &[1, 2]), ("/tf", "odom", "cam:0", &[0, 1, 2])]);
    let read = topic("a.bag", &bytes, "/tf:map.cam:0").unwrap().track;
    assert_eq!(read.frames.len(), 2);
    assert!(read.unread[0].starts_with("1 of 3 poses left out: map <- odom is known from "), "{:?}", read.unread);
    let apart = transforms(&[("/tf", "map", "odom", &[5, 6]), ("/tf", "odom", "camera", &[0, 1, 2])]);
    let error = topic("a.bag", &apart, "/tf:map.camera").unwrap_err().to_string();
    assert!(error.starts_with("/tf:map.camera: found 3 of 3 poses left out: map <- odom"), "{error}");
}

/// ROS 2 records into a folder, which was `a folder without a camera path`.
#[test]
fn the_folder_of_a_recording_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    write("metadata.yaml", b"rosbag2_bagfile_information:\n  version: 9\n");
    let error = read(folder.path(), None).unwrap_err().to_string();
    assert!(error.contains("a recording of ROS (.mcap or .bag)"), "{error}");
    write("drive_0.mcap.zstd", &[]);
    insta::assert_snapshot!(read(folder.path(), None).unwrap_err(), @"found a packed recording of ROS, drive_0.mcap.zstd, expected one that is unpacked (`zstd -d drive_0.mcap.zstd`)");
    std::fs::remove_file(folder.path().join("drive_0.mcap.zstd")).unwrap();
    write("drive_0.mcap", &mcap(""));
    assert_poses(&read(folder.path(), None).unwrap());
    let mut named = folder.path().as_os_str().to_owned();
    named.push("#/odom");
    assert_poses(&read(named.as_ref(), None).unwrap());
    write("drive_1.mcap", &mcap(""));
    insta::assert_snapshot!(read(folder.path(), None).unwrap_err(), @"found a folder with 2 recordings of ROS (drive_0.mcap, drive_1.mcap), expected the path of one of them");
    for name in ["drive_0.mcap", "drive_1.mcap"] {
        std::fs::remove_file(folder.path().join(name)).unwrap();
    }
    write("drive_0.db3", b"SQLite format 3\0..");
    let error = read(folder.path(), None).unwrap_err().to_string();
    assert!(error.contains("evo_traj bag2"), "{error}");
}
