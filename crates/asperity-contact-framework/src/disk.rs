//! What a user can do about a disk that refuses.

use std::io::{self, ErrorKind};
use std::path::Path;

/// The end of a message on `error`, which an operation on the disk gave: what to do next. Empty where nothing is known.
pub fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "; free some space or choose another folder, then run again"
        }
        ErrorKind::FileTooLarge => "; raise the limit (`ulimit -f`) or choose another folder, then run again",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "; allow writing there or choose another folder"
        }
        ErrorKind::NotFound => "; it was removed meanwhile: run again",
        _ => "",
    }
}

/// Whether files can be made in a folder that is there, as far as that can be told without making one.
#[cfg(target_os = "linux")]
pub fn check_writable(folder: &Path) -> io::Result<()> {
    use rustix::fs::{Access, access};
    Ok(access(folder, Access::WRITE_OK | Access::EXEC_OK)?)
}

/// Elsewhere only an attempt tells.
#[cfg(not(target_os = "linux"))]
pub fn check_writable(_: &Path) -> io::Result<()> {
    Ok(())
}
