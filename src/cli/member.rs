//! Programs that a farm on this machine starts.

use std::process::Command;

use super::console;
use super::failure::Failure;

/// Set for them.
const IS_MEMBER: &str = "CINESPLAT_IS_MEMBER";

/// Marks a program that a farm is about to start.
pub(super) fn mark(program: &mut Command) {
    program.env(IS_MEMBER, "1");
}

/// Prints why a command ends early. That the user stopped it, the farm says once for all its programs.
pub(super) fn report(failure: &Failure) {
    if !failure.is_stop() || std::env::var_os(IS_MEMBER).is_none() {
        console::error(failure);
    }
}
