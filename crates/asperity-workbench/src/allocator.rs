//! Memory that is free returns to the system.
//!
//! The allocator of glibc keeps freed memory for later, also what a map of a hundred megabytes has left. `mallopt` keeps large arrays apart,
//! and `malloc_trim` gives back the rest. Both calls are unsafe in name only: they have no precondition, may be made from any thread at any
//! time, and touch free memory alone.
#![allow(unsafe_code)]

/// Keeps arrays of this size and above apart from others, so that each returns when it is freed.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn keep_large_apart() {
    const LARGE: i32 = 4 << 20;
    // SAFETY: see above.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE);
    }
}

/// Gives free memory back to the system, where its allocator would keep it.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn trim() {
    // SAFETY: see above; 0 bytes stay at the end of the heap.
    unsafe {
        libc::malloc_trim(0);
    }
}

/// Other allocators do so by themselves.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub fn keep_large_apart() {}

/// Other allocators do so by themselves.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub fn trim() {}
