use std::fs;
use std::path::Path;

/// Where a version of control groups keeps its figures.
struct Version {
    /// Folder below the mount of all groups.
    mount: &'static str,
    /// Files of the limit and of what is used.
    files: [&'static str; 2],
    /// Lines of `memory.stat` about memory that the system gives up on demand.
    reclaimable: &'static [&'static str],
}

const UNIFIED: Version = Version {
    mount: "",
    files: ["memory.max", "memory.current"],
    reclaimable: &["active_file", "inactive_file", "slab_reclaimable"],
};
const LEGACY: Version = Version {
    mount: "memory",
    files: ["memory.limit_in_bytes", "memory.usage_in_bytes"],
    reclaimable: &["total_active_file", "total_inactive_file"],
};

/// Bytes that are left of the limits of this process's control group and of those above it; `None` without a limit.
/// `groups` is the text of `/proc/self/cgroup`, `mount` the folder `/sys/fs/cgroup`.
///
/// Memory that only caches files counts as left, whether it was used lately or not: the system gives it up on demand.
pub fn group_memory_left(groups: &str, mount: &Path) -> Option<u64> {
    least(groups, mount, left_in)
}

/// The least limit of this process's control group and of those above it, bytes, whatever is in use; `None` without one.
/// Arguments as those of [`group_memory_left`].
pub fn group_memory_max(groups: &str, mount: &Path) -> Option<u64> {
    least(groups, mount, |folder, version| number_in(folder, version.files[0]))
}

/// The least figure of a group and of those above it.
fn least(groups: &str, mount: &Path, of: impl Fn(&Path, &Version) -> Option<u64>) -> Option<u64> {
    let unified = groups.lines().find_map(|line| line.strip_prefix("0::"));
    let legacy = groups.lines().find_map(|line| line.split_once(":memory:").map(|(_, path)| path));
    let lowest = |path: &str, version: &Version| {
        let root = mount.join(version.mount);
        let folder = root.join(path.trim_start_matches('/'));
        let folders = folder.ancestors().take_while(|folder| folder.starts_with(&root));
        folders.filter_map(|folder| of(folder, version)).min()
    };
    let unified = unified.and_then(|path| lowest(path, &UNIFIED));
    let legacy = legacy.and_then(|path| lowest(path, &LEGACY));
    [unified, legacy].into_iter().flatten().min()
}

fn number_in(folder: &Path, name: &str) -> Option<u64> {
    fs::read_to_string(folder.join(name)).ok()?.trim().parse().ok()
}

fn left_in(folder: &Path, version: &Version) -> Option<u64> {
    let [max, used] = version.files;
    let (max, used) = (number_in(folder, max)?, number_in(folder, used)?);
    let stat = fs::read_to_string(folder.join("memory.stat")).unwrap_or_default();
    let reclaimable: u64 = stat
        .lines()
        .filter_map(|line| line.split_once(' '))
        .filter(|(name, _)| version.reclaimable.contains(name))
        .filter_map(|(_, bytes)| bytes.trim().parse::<u64>().ok())
        .sum();
    Some(max.saturating_sub(used.saturating_sub(reclaimable)))
}
