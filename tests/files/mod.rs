//! The crate `files`: complete or absent files, protection of existing files, numpy arrays, relative paths.

mod group_memory;
mod open_files;
mod past_cache;

use std::fs;
use std::io::Write;
use std::path::Path;

use cinesplat::files::{
    Existing, FileError, Limits, NewFile, beside, check_free, checksum, holds, json_excess, move_file, npy, read,
    relative_to, sha256_hex, write,
};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_file_is_replaced_only_where_the_caller_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    write(&path, b"first", Existing::Keep).unwrap();
    assert!(matches!(write(&path, b"second", Existing::Keep), Err(FileError::Exists { .. })));
    assert_eq!(fs::read(&path).unwrap(), b"first");
    write(&path, b"second", Existing::Replace).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"second");
    assert_eq!(names(folder.path()), ["a.txt"]);
}

#[test]
fn a_file_that_appears_while_the_new_one_is_written_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let new = NewFile::create(&path, Existing::Keep).unwrap();
    new.file().write_all(b"ours").unwrap();
    fs::write(&path, b"theirs").unwrap();
    assert!(matches!(new.commit(), Err(FileError::Exists { .. })));
    assert_eq!(fs::read(&path).unwrap(), b"theirs");
    assert_eq!(names(folder.path()), ["a.txt"], "the temporary file is removed");
}

#[test]
fn a_dropped_file_leaves_nothing_and_two_writers_never_share_a_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let one = NewFile::create(&path, Existing::Keep).unwrap();
    let other = NewFile::create(&path, Existing::Keep).unwrap();
    assert_ne!(one.path(), other.path());
    drop((one, other));
    assert!(names(folder.path()).is_empty());
}

#[cfg(unix)]
#[test]
fn new_files_have_the_permissions_of_any_new_file_and_special_files_are_written_directly() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
    write(&ours, b"x", Existing::Keep).unwrap();
    fs::write(&plain, b"x").unwrap();
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
    write(Path::new("/dev/null"), b"x", Existing::Keep).unwrap();
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
}

#[cfg(target_os = "linux")]
#[test]
fn a_name_of_an_open_file_is_written_and_never_replaced() {
    use std::os::fd::AsRawFd;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("redirected");
    fs::write(&path, "before ").unwrap();
    let open = fs::File::options().append(true).open(&path).unwrap();
    let name = format!("/dev/fd/{}", open.as_raw_fd());
    write(Path::new(&name), b"after", Existing::Replace).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "before after");
    // A link to it in a folder of its own is replaced as any link.
    let link = folder.path().join("link");
    std::os::unix::fs::symlink(&path, &link).unwrap();
    write(&link, b"new", Existing::Replace).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "before after");
    assert_eq!(fs::read_to_string(&link).unwrap(), "new");
}

#[test]
fn outputs_that_cannot_be_are_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let create = |path: &Path| matches!(check_free(path, Existing::Replace), Err(FileError::Create { .. }));
    assert!(create(folder.path()));
    assert!(create(&folder.path().join("no/such/folder.txt")));
    let file = folder.path().join("file");
    fs::write(&file, b"x").unwrap();
    assert!(create(&file.join("below.txt")));
    assert!(check_free(&folder.path().join("new.txt"), Existing::Keep).is_ok());
}

#[test]
fn arrays_read_back_and_look_as_numpy_writes_them() {
    // numpy.save of numpy.array([1, 2, 300], dtype="<u2"), numpy 1.26.
    let mut expected = b"\x93NUMPY\x01\x00v\x00{'descr': '<u2', 'fortran_order': False, 'shape': (3,), }".to_vec();
    expected.resize(127, b' ');
    expected.extend(b"\n\x01\x00\x02\x00\x2c\x01");
    assert_eq!(npy::encode_u16(&[3], &[1, 2, 300]), expected);
    let array = npy::Array::parse(&expected).unwrap();
    assert_eq!((array.shape.as_slice(), array.to_u32().unwrap()), (&[3][..], vec![1, 2, 300]));

    let values = [0.5_f32, -1.0, f32::MAX, 1e-40, 0.0, 7.25];
    let bytes = npy::encode_f32(&[2, 3], &values);
    let array = npy::Array::parse(&bytes).unwrap();
    assert_eq!((array.shape.as_slice(), array.to_f32().unwrap()), (&[2, 3][..], values.to_vec()));
    assert!(array.to_u32().unwrap_err().to_string().contains("<f4"));
}

#[test]
fn truncated_arrays_are_refused_and_damaged_ones_never_panic() {
    let bytes = npy::encode_u16(&[4], &[1, 2, 3, 4]);
    for len in 0..bytes.len() {
        assert!(npy::Array::parse(&bytes[..len]).and_then(|array| array.to_u32()).is_err(), "{len} bytes");
    }
    for at in 0..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x55;
        // Any result is accepted; a panic is not.
        let _ = npy::Array::parse(&damaged).and_then(|array| array.to_u32());
    }
    let huge = npy::encode("'<f4'", &[usize::MAX, 2], std::iter::empty());
    assert!(npy::Array::parse(&huge).unwrap().to_f32().is_err());
}

#[test]
fn paths_inside_a_file_are_relative_to_it() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("shots/a")).unwrap();
    fs::write(folder.path().join("room.spz"), b"x").unwrap();
    let shot = folder.path().join("shots/a/shot.json");
    let name = relative_to(&shot, &folder.path().join("room.spz"));
    assert_eq!(name, "../../room.spz");
    assert_eq!(beside(&shot, &name).canonicalize().unwrap(), folder.path().join("room.spz").canonicalize().unwrap());
    assert_eq!(relative_to(&shot, Path::new("synth:demo")), "synth:demo");
}

#[test]
fn hashes_are_those_of_the_standard() {
    // FIPS 180-2, appendix B.1.
    assert_eq!(sha256_hex(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

/// A FIFO without a writer used to block for ever, and `/dev/zero` to fill the memory.
#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_refused_unread() {
    let folder = tempfile::tempdir().unwrap();
    let (fifo, socket) = (folder.path().join("fifo"), folder.path().join("socket"));
    let made = std::process::Command::new("mkfifo").arg(&fifo).status().unwrap();
    assert!(made.success());
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    let refused = |path: &Path| {
        let error = read(path, u64::MAX).unwrap_err();
        assert_eq!((error.code(), error.path()), ("FILE-KIND", path));
        error.to_string().trim_start_matches(&format!("{}: ", path.display())).to_owned()
    };
    assert_eq!(refused(&fifo), "it is a pipe, expected a regular file");
    assert_eq!(refused(&socket), "it is a socket, expected a regular file");
    assert_eq!(refused(folder.path()), "it is a folder, expected a regular file");
    assert_eq!(refused(Path::new("/dev/zero")), "it is a device, expected a regular file");
}

#[test]
fn a_file_above_the_limit_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, b"12345").unwrap();
    assert_eq!(read(&path, 5).unwrap(), b"12345");
    let error = read(&path, 4).unwrap_err();
    assert_eq!(error.code(), "FILE-SIZE");
    assert!(error.to_string().ends_with("a.txt: the file has 5 bytes, expected at most 4"), "{error}");
}

#[test]
fn checksums_are_those_of_the_specification() {
    // Test vectors of XXH64 with seed 0, from its specification.
    assert_eq!(checksum(&[]), 0xEF46_DB37_51D8_E999);
    assert_eq!(checksum(&[b"abc"]), 0x44BC_2CF5_AD77_0999);
    assert_eq!(checksum(&[b"a", b"", b"bc"]), checksum(&[b"abc"]));
}

#[test]
fn a_file_is_moved_to_a_free_name_or_stays() {
    let folder = tempfile::tempdir().unwrap();
    let [from, to] = ["from", "to"].map(|name| folder.path().join(name));
    fs::write(&from, "new").unwrap();
    fs::write(&to, "old").unwrap();
    assert!(matches!(move_file(&from, &to, Existing::Keep), Err(FileError::Exists { .. })));
    assert!(matches!(move_file(&from, &to.join("x"), Existing::Keep), Err(FileError::Write { .. })));
    assert_eq!((fs::read(&from).unwrap(), fs::read(&to).unwrap()), (b"new".to_vec(), b"old".to_vec()));
    move_file(&from, &to, Existing::Replace).unwrap();
    assert_eq!(names(folder.path()), ["to"]);
    assert!(holds(&to, b"new") && !holds(&to, b"old") && !holds(&to, b"newer") && !holds(&from, b"new"));
    move_file(&to, &from, Existing::Keep).unwrap();
    assert_eq!(names(folder.path()), ["from"]);
}

#[test]
fn a_name_that_ends_in_a_slash_is_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let path = format!("{}/new.mp4/", folder.path().display());
    assert!(matches!(check_free(Path::new(&path), Existing::Keep), Err(FileError::Create { .. })));
}

#[test]
fn json_beyond_the_limits_is_found_before_it_is_parsed() {
    let limits = Limits { json_depth: 4, json_bytes: 10_000, scene_bytes: 30_000, ..Limits::DEFAULT };
    let excess = |text: &str| json_excess(text.as_bytes(), &limits);
    assert_eq!(excess(r#"{"a": [1, 2, {"b": "]]]]]][[[[[[{{{{{{"}]}"#), None);
    assert_eq!(excess("[[[[1]]]]"), None);
    assert_eq!(excess("[[[[[1]]]]]").unwrap(), "lists nested over 4 deep, expected at most 4");
    // Escaped quotes do not end a text.
    assert_eq!(excess(r#"["\"[[[[[[", "\\", 1]"#), None);
    assert!(excess(r#"["\\", [[[[[1]]]]]]"#).is_some());
    let many = format!("[{}1]", "1,".repeat(400));
    assert!(excess(&many).unwrap().contains("over 10000 bytes of memory"));
    assert!(excess(&format!("[{}]", vec!["{}"; 20].join(","))).is_some());
    // Embedded data is no larger in memory than in the file.
    assert_eq!(excess(&format!("\"{}\"", "x".repeat(11_000))), None);
    assert_eq!(excess(&format!("\"{}\"", "x".repeat(31_000))).unwrap(), "texts of 31001 bytes, expected at most 30000");
    // Text that is no JSON is no reason to panic.
    for text in ["", "]]]]", "\"", "\"\\", "{\"a", "\u{feff}["] {
        assert_eq!(excess(text), None, "{text:?}");
    }
}
