//! The `cinesplat` program.

mod cli;

use std::process::ExitCode;

/// Training and rendering make and drop many large buffers; the system's allocator gives each back to the system.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    cli::run(std::env::args_os())
}
