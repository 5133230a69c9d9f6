//! The `cinesplat` program; all of it is in the library's `cli`.

use std::process::ExitCode;

/// Training and rendering make and drop many large buffers; the system's allocator gives each back to the system.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    cinesplat::cli::run(std::env::args_os())
}
