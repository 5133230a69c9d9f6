//! The `cinesplat` program.

mod allocator;
mod cli;

/// Training and rendering make and drop many large buffers; the system's allocator gives each back to the system.
#[global_allocator]
static ALLOCATOR: allocator::BoundedAllocator = allocator::BoundedAllocator;

fn main() -> ! {
    allocator::leave(cli::run(std::env::args_os()).into())
}
