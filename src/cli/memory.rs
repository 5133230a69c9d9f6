//! How much memory the program may take.
//!
//! Enters: `--max-memory`, the limit on address space (`ulimit -v`), the limit of the control group (containers, Slurm).
//! Leaves: the bytes that are left, for estimates before work. What exceeds them in the end is refused by the allocator.
//!
//! `--max-memory` takes the place of what the control group has left and of the caps that readers and renderers have without
//! it: whoever gives a number knows more than an estimate does. The machine's memory, the control group's limit and the limit
//! on address space cannot be overruled.

use std::fs;
use std::path::Path;

use crate::allocator;
use cinesplat::files::{group_memory_left, group_memory_max};
use cinesplat::render;
use cinesplat::scene::Limits;

/// Share of what is left that a renderer may hold for one picture; the rest is for encoder and frames.
const RENDER_SHARE: f64 = 0.6;
/// Largest part of the program's own file that is read as it runs: what a debugger needs besides is not.
const MAX_FILE_BYTES: u64 = 96 << 20;
/// Memory that threads and libraries take beyond estimates, bytes.
const SPARE_BYTES: u64 = 48 << 20;

/// Bounds the memory of everything that follows.
pub(super) fn set_max(bytes: u64) {
    let bounds = [in_group(group_memory_max), bytes_in("/proc/meminfo", "MemTotal:")];
    let bytes = bounds.into_iter().flatten().fold(bytes, u64::min);
    // What the program holds before its first command is in the bound too, and so is what of its own file is not read yet.
    let held = status_bytes("VmRSS:").unwrap_or(0);
    let own_file = std::env::current_exe().and_then(fs::metadata).map_or(0, |file| file.len().min(MAX_FILE_BYTES));
    let unread = own_file.saturating_sub(status_bytes("RssFile:").unwrap_or(0));
    allocator::set_cap(bytes.saturating_sub(held + unread));
}

/// Bytes that may still be taken; `None` where nothing bounds them, or the system does not say.
pub(super) fn left_bytes() -> Option<u64> {
    [allocator::left_bytes().or_else(|| in_group(group_memory_left)), left_addresses()].into_iter().flatten().min()
}

/// The limits of readers.
pub(super) fn reading(limits: Limits) -> Limits {
    Limits { memory_bytes: share_of_left(1.0, limits.memory_bytes), ..limits }
}

/// The limits of the renderer.
pub(super) fn rendering(limits: render::Limits) -> render::Limits {
    render::Limits { max_memory_bytes: share_of_left(RENDER_SHARE, limits.max_memory_bytes), ..limits }
}

/// A share of what is left beyond [`SPARE_BYTES`]; without `--max-memory` at most `cap`.
fn share_of_left(share: f64, cap: u64) -> u64 {
    let left = left_bytes().map(|left| (left.saturating_sub(SPARE_BYTES) as f64 * share) as u64);
    let cap = if allocator::left_bytes().is_some() { u64::MAX } else { cap };
    left.unwrap_or(u64::MAX).min(cap)
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
    bytes_in("/proc/self/status", name)
}

/// As [`status_bytes`], from another of Linux's files.
fn bytes_in(file: &str, name: &str) -> Option<u64> {
    let text = fs::read_to_string(file).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()? << 10)
}

/// A figure of the control group.
fn in_group(of: fn(&str, &Path) -> Option<u64>) -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    of(&groups, Path::new("/sys/fs/cgroup"))
}
