use std::fs;
use std::io::Write;
use std::process::Command;

use cinesplat::files::{Existing, FileError, NewFile, remove_open_files};

/// Names the folder in the process that this test starts: the list is one per process, and other tests write files.
const FOLDER: &str = "CINESPLAT_TEST_OPEN_FILES";

/// Temporary files used to stay behind where a program ran out of memory.
#[test]
fn temporary_files_are_removed_at_an_end_without_destructors() {
    let Some(folder) = std::env::var_os(FOLDER) else { return start() };
    let folder = std::path::PathBuf::from(folder);
    let create = |name: &str| NewFile::create(&folder.join(name), Existing::Replace).unwrap();
    let done = create("done");
    done.file().write_all(b"whole").unwrap();
    done.commit().unwrap();
    drop(create("dropped"));
    let open: Vec<NewFile> = (0..3).map(|idx| create(&format!("open{idx}"))).collect();
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 4);
    remove_open_files();
    let left: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["done"]);
    for file in open {
        assert!(matches!(file.commit(), Err(FileError::Write { .. })));
    }
}

fn start() {
    let folder = tempfile::tempdir().unwrap();
    let name = "files::open_files::temporary_files_are_removed_at_an_end_without_destructors";
    let mut tests = Command::new(std::env::current_exe().unwrap());
    let output = tests.args(["--exact", name]).env(FOLDER, folder.path()).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("1 passed"), "{said}");
}
