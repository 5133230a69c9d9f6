//! The allocator of the program, here as one of several: it serves what these tests ask it for, and counts that alone.
#![allow(unsafe_code, reason = "an allocator cannot be asked without")]

#[path = "../src/allocator.rs"]
#[expect(clippy::module_inception, reason = "the module under test has this name")]
mod allocator;

use std::alloc::{GlobalAlloc, Layout};

/// A block that grew used to count with its old and its new size: a program ended at two thirds of what it may take.
#[test]
fn a_block_that_grows_counts_once() {
    let of = |bytes: usize| Layout::from_size_align(bytes, 8).unwrap();
    allocator::set_cap(10 << 20);
    // A second count would end the tests with exit code 71.
    unsafe {
        let block = allocator::BoundedAllocator.alloc(of(6 << 20));
        let block = allocator::BoundedAllocator.realloc(block, of(6 << 20), 9 << 20);
        assert_eq!(allocator::left_bytes(), Some(1 << 20));
        let block = allocator::BoundedAllocator.realloc(block, of(9 << 20), 2 << 20);
        assert_eq!(allocator::left_bytes(), Some(8 << 20));
        allocator::BoundedAllocator.dealloc(block, of(2 << 20));
    }
    assert_eq!(allocator::left_bytes(), Some(10 << 20));
}
