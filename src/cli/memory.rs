//! How much memory the program may take.
//!
//! Enters: `--max-memory`, the limit on address space (`ulimit -v`), the limit of the control group (containers, Slurm).
//! Leaves: the bytes that are left, for estimates before work. What exceeds them in the end is refused by the allocator.

use std::fs;
use std::path::{Path, PathBuf};

use crate::allocator;
use cinesplat::render;
use cinesplat::scene::Limits;

/// Share of what is left that a renderer may hold for one picture; the rest is for encoder and frames.
const RENDER_SHARE: f64 = 0.6;
/// Memory that threads and libraries take beyond estimates, bytes.
const SPARE_BYTES: u64 = 48 << 20;

/// Bounds the memory of everything that follows.
pub(super) fn set_max(bytes: u64) {
    // What the program holds before its first command is in the bound too.
    allocator::set_cap(bytes.saturating_sub(status_bytes("VmRSS:").unwrap_or(0)));
}

/// Bytes that may still be taken; `None` where nothing bounds them, or the system does not say.
pub(super) fn left_bytes() -> Option<u64> {
    [allocator::left_bytes(), left_addresses(), left_in_group()].into_iter().flatten().min()
}

/// The limits of readers.
pub(super) fn reading(limits: Limits) -> Limits {
    let memory_bytes = left_bytes().map_or(limits.memory_bytes, |left| left.saturating_sub(SPARE_BYTES));
    Limits { memory_bytes: memory_bytes.min(limits.memory_bytes), ..limits }
}

/// The limits of the renderer.
pub(super) fn rendering(limits: render::Limits) -> render::Limits {
    let left = left_bytes().map(|left| (left.saturating_sub(SPARE_BYTES) as f64 * RENDER_SHARE) as u64);
    render::Limits { max_memory_bytes: left.unwrap_or(u64::MAX).min(limits.max_memory_bytes), ..limits }
}

/// Whether so little is left that a library which fails may have failed for it.
pub(super) fn is_short() -> bool {
    left_bytes().is_some_and(|left| left < 4 * SPARE_BYTES)
}

/// The bytes that something takes with what it takes beyond estimates, and those that are left, where these are fewer.
pub(super) fn lacks(estimate: u64) -> Option<(u64, u64)> {
    let needed = estimate.saturating_add(SPARE_BYTES);
    left_bytes().filter(|left| needed > *left).map(|left| (needed, left))
}

/// A size such as 512M, 4G or a number of bytes.
pub(super) fn parse_size(text: &str) -> Result<u64, String> {
    let units = [('k', 10), ('m', 20), ('g', 30), ('t', 40)];
    let lower = text.trim().to_ascii_lowercase();
    let plain = lower.trim_end_matches('b').trim_end_matches('i');
    let with_unit = units.into_iter().find_map(|(unit, shift)| Some((plain.strip_suffix(unit)?, shift)));
    let (number, shift) = with_unit.unwrap_or((plain, 0));
    let bytes = number.parse::<f64>().ok().map(|number| number * (1_u64 << shift) as f64);
    let bytes = bytes.filter(|bytes| (1e6..=9e18).contains(bytes)).map(|bytes| bytes as u64);
    bytes.ok_or_else(|| "expected a size of at least 1M, such as 512M or 4G".to_owned())
}

/// What is left of the limit on address space.
fn left_addresses() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    let limit: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(limit.saturating_sub(status_bytes("VmSize:")?))
}

/// A size of this process, as Linux states it in kilobytes.
fn status_bytes(name: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(name))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()? << 10)
}

/// What is left of the limits of the control group and of those above it. Memory that only caches files is not counted:
/// the system gives it up on demand.
fn left_in_group() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    let unified = groups.lines().find_map(|line| line.strip_prefix("0::"));
    let legacy = groups.lines().find_map(|line| line.split_once(":memory:").map(|(_, path)| path));
    let left = |root: &str, path: &str, [max, used]: [&str; 2], cached: &str| {
        let folder = PathBuf::from(root).join(path.trim_start_matches('/'));
        let folders = folder.ancestors().take_while(|folder| folder.starts_with(root));
        folders.filter_map(|folder| left_in(folder, [max, used], cached)).min()
    };
    let unified =
        unified.and_then(|path| left("/sys/fs/cgroup", path, ["memory.max", "memory.current"], "inactive_file "));
    let names = ["memory.limit_in_bytes", "memory.usage_in_bytes"];
    let legacy = legacy.and_then(|path| left("/sys/fs/cgroup/memory", path, names, "total_inactive_file "));
    [unified, legacy].into_iter().flatten().min()
}

fn left_in(folder: &Path, [max, used]: [&str; 2], cached: &str) -> Option<u64> {
    let number = |name: &str| fs::read_to_string(folder.join(name)).ok()?.trim().parse::<u64>().ok();
    let (max, used) = (number(max)?, number(used)?);
    let stat = fs::read_to_string(folder.join("memory.stat")).unwrap_or_default();
    let cached = stat.lines().find_map(|line| line.strip_prefix(cached)?.trim().parse::<u64>().ok()).unwrap_or(0);
    Some(max.saturating_sub(used.saturating_sub(cached)))
}
