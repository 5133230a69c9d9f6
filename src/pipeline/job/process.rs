//! Names of programs that tell which machine they run on, and whether one of this machine has ended.

use std::fs;

/// The name of this program: machine, process, moment of its start.
pub(super) fn own_name() -> String {
    let process = std::process::id();
    let start = state_and_start(process).map_or_else(String::new, |(_, start)| start);
    format!("{}-{process}-{start}", place())
}

/// Whether the program of a name, whatever follows it, has ended; `None` for one of another machine.
pub(super) fn has_ended(name: &str) -> Option<bool> {
    let place = Some(place()).filter(|place| !place.is_empty())?;
    let mut parts = name.strip_prefix(&place)?.strip_prefix('-')?.split('-');
    let (process, start) = (parts.next()?.parse().ok()?, parts.next()?);
    if !is_there(process)? {
        return Some(true);
    }
    // Numbers are given again. The system may hide what it knows about others: then the number alone counts.
    Some(state_and_start(process).is_some_and(|(state, found)| "ZX".contains(&state) || found != start))
}

/// Whether there is a process with this number; `None` where the system does not say.
#[cfg(unix)]
fn is_there(process: u32) -> Option<bool> {
    let process = nix::unistd::Pid::from_raw(i32::try_from(process).ok().filter(|process| *process > 0)?);
    Some(nix::sys::signal::kill(process, None) != Err(nix::errno::Errno::ESRCH))
}

#[cfg(not(unix))]
fn is_there(_: u32) -> Option<bool> {
    None
}

/// The machine that this program runs on, since it was started, with its space of process numbers; empty where the system
/// does not say.
fn place() -> String {
    let read = |name: &str| fs::read_to_string(format!("/proc/sys/kernel/{name}"));
    let (Ok(host), Ok(boot)) = (read("hostname"), read("random/boot_id")) else { return String::new() };
    let Ok(space) = fs::read_link("/proc/self/ns/pid") else { return String::new() };
    let digits: String = space.to_string_lossy().chars().filter(char::is_ascii_digit).collect();
    format!("{}.{digits}.{}", host.trim(), boot.trim())
}

/// State of a process, and when it was started in ticks since the machine was.
fn state_and_start(process: u32) -> Option<(String, String)> {
    let text = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // The name of the program, in brackets, may hold anything.
    let mut words = text.rsplit_once(')')?.1.split_whitespace();
    Some((words.next()?.to_owned(), words.nth(18)?.to_owned()))
}
