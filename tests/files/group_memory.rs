use std::fs;
use std::path::Path;

use cinesplat::files::{group_memory_left, group_memory_max};

fn write(folder: &Path, files: &[(&str, &str)]) {
    fs::create_dir_all(folder).unwrap();
    files.iter().for_each(|(name, text)| fs::write(folder.join(name), text).unwrap());
}

/// Files that were read lately used to count as taken: a container that had read a large scene refused to render it.
#[test]
fn what_caches_files_is_left_of_a_containers_memory() {
    let mount = tempfile::tempdir().unwrap();
    let stat = "anon 100\nfile 800\ninactive_anon 40\nactive_file 300\ninactive_file 400\nshmem 90\nslab_reclaimable 50\nslab_unreclaimable 20\n";
    write(&mount.path().join("a/b"), &[("memory.max", "1000\n"), ("memory.current", "950\n"), ("memory.stat", stat)]);
    write(&mount.path().join("a"), &[("memory.max", "max\n"), ("memory.current", "2000\n"), ("memory.stat", stat)]);
    assert_eq!(group_memory_left("0::/a/b\n", mount.path()), Some(1000 - (950 - 750)));
    assert_eq!(group_memory_max("0::/a/b\n", mount.path()), Some(1000));
    assert_eq!(group_memory_left("0::/a\n", mount.path()), None, "no limit");
    // The limit of a group above counts where it is tighter.
    write(mount.path(), &[("memory.max", "500\n"), ("memory.current", "400\n")]);
    assert_eq!(group_memory_left("0::/a/b\n", mount.path()), Some(100));
    assert_eq!(group_memory_left("0::/gone\n", mount.path()), Some(100), "a group that is not shown here");
    assert_eq!(group_memory_left("nonsense", mount.path()), None);
}

#[test]
fn the_groups_of_old_kernels_are_read_too() {
    let mount = tempfile::tempdir().unwrap();
    let stat = "cache 9\nactive_file 1\ninactive_file 1\ntotal_active_file 200\ntotal_inactive_file 100\n";
    let files = [("memory.limit_in_bytes", "1000"), ("memory.usage_in_bytes", "900"), ("memory.stat", stat)];
    write(&mount.path().join("memory/x"), &files);
    assert_eq!(group_memory_left("12:pids:/y\n4:memory:/x\n0::/\n", mount.path()), Some(400));
}
