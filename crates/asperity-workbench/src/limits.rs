//! What the server accepts at most; `docs/workbench.md` states it.

use std::time::Duration;

/// Bytes of a file that is dropped on the page.
pub const UPLOAD: u64 = 2 << 30;

/// Bytes of any other request: a spec.
pub const REQUEST: usize = 1 << 20;

/// Bytes of a map of which the list has a picture, and the points of the picture along an axis.
pub const PICTURED: u64 = 64 << 20;
pub const PICTURE: usize = 160;

/// Bytes of the summary of a report that is listed.
pub const SUMMARY: u64 = 16 << 20;

/// Time of one analysis, from the first stage to the last.
pub const ANALYSIS: Duration = Duration::from_secs(30 * 60);

/// Entries of the list of files; folders below are listed this deep.
pub const FILES: usize = 2000;
pub const DEPTH: usize = 4;

/// Points of a map along an axis that the page draws.
pub const POINTS: usize = 2048;

/// Bytes of memory that all analyses may use together: three quarters of what the machine has.
pub fn memory() -> u64 {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    // Without a known size nothing is refused.
    match system.total_memory() {
        0 => u64::MAX,
        total => total / 4 * 3,
    }
}
