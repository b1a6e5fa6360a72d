//! Atomic replacement of a folder: a kill at any instant leaves the old or the new one complete.
//!
//! Where the system can exchange two folders atomically, it does. Elsewhere the old folder is moved
//! aside first; a run killed just then leaves its place empty until the next run brings it back.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::{StoreError, failed, sync_folder};

/// Long enough that nothing else bears such a name.
const NEW: &str = ".asperity-new";
const OLD: &str = ".asperity-old";

/// Paths of a report: final, in preparation, moved aside.
pub(super) struct Places {
    directory: PathBuf,
    pub(super) place: PathBuf,
    pub(super) new: PathBuf,
    old: PathBuf,
}

impl Places {
    pub(super) fn new(directory: &Path, stem: &str) -> Self {
        Self {
            directory: directory.into(),
            place: directory.join(stem),
            new: directory.join(format!(".{stem}{NEW}")),
            old: directory.join(format!(".{stem}{OLD}")),
        }
    }
}

/// An atomic step, except for the removal of obsolete files.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// The new folder goes to a place that is free.
    MoveIn,
    /// The new and the old folder are exchanged.
    Exchange,
    /// The old folder is moved aside.
    SetAside,
    /// The old folder, now in the place of the new one, is removed.
    DiscardExchanged,
    /// The old folder, now aside, goes.
    DiscardAside,
}

pub(super) const INTO_FREE_PLACE: &[Step] = &[Step::MoveIn];
pub(super) const BY_EXCHANGE: &[Step] = &[Step::Exchange, Step::DiscardExchanged];
pub(super) const BY_TWO_RENAMES: &[Step] = &[Step::SetAside, Step::MoveIn, Step::DiscardAside];

/// Puts the new folder in its place.
pub(super) fn replace(places: &Places) -> Result<(), StoreError> {
    if !exists(&places.place)? {
        return take(INTO_FREE_PLACE, places);
    }
    match take(BY_EXCHANGE, places) {
        Err(StoreError::Io { source, .. }) if source.kind() == ErrorKind::Unsupported => {
            take(BY_TWO_RENAMES, places)
        }
        done => done,
    }
}

pub(super) fn take(steps: &[Step], places: &Places) -> Result<(), StoreError> {
    for step in steps {
        match step {
            Step::MoveIn => rename(&places.new, &places.place)?,
            Step::SetAside => rename(&places.place, &places.old)?,
            Step::Exchange => {
                exchange(&places.new, &places.place).or_else(|e| failed("replace", &places.place, e))?;
                sync_folder(&places.directory)?;
            }
            Step::DiscardExchanged => discard(&places.new)?,
            Step::DiscardAside => discard(&places.old)?,
        }
    }
    Ok(())
}

/// Clears up after every report of a store that was being replaced when its run was killed.
pub(super) fn recover(directory: &Path) -> Result<(), StoreError> {
    for entry in fs::read_dir(directory).or_else(|e| failed("list", directory, e))? {
        let name = entry.or_else(|e| failed("list", directory, e))?.file_name();
        let stem = name.to_str().and_then(|name| name.strip_prefix('.'));
        if let Some(stem) = stem.and_then(|name| name.strip_suffix(NEW).or_else(|| name.strip_suffix(OLD))) {
            recover_one(&Places::new(directory, stem))?;
        }
    }
    Ok(())
}

/// After a kill exactly one complete report remains (or none, if there never was one).
pub(super) fn recover_one(places: &Places) -> Result<(), StoreError> {
    if exists(&places.old)? && !exists(&places.place)? {
        rename(&places.old, &places.place)?;
    }
    discard(&places.old)?;
    discard(&places.new)
}

/// Renames and brings that down to the disk.
pub(super) fn rename(from: &Path, to: &Path) -> Result<(), StoreError> {
    fs::rename(from, to).or_else(|e| failed("move something to", to, e))?;
    to.parent().map_or(Ok(()), sync_folder)
}

#[cfg(target_os = "linux")]
fn exchange(a: &Path, b: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    use rustix::io::Errno;
    renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE).map_err(|error| match error {
        // Errors of file systems and kernels without this operation.
        Errno::INVAL | Errno::NOSYS | Errno::NOTSUP => ErrorKind::Unsupported.into(),
        other => other.into(),
    })
}

#[cfg(not(target_os = "linux"))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(ErrorKind::Unsupported.into())
}

fn exists(path: &Path) -> Result<bool, StoreError> {
    match fs::symlink_metadata(path) {
        Ok(_) => Ok(true),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => failed("inspect", path, error),
    }
}

/// Removes a folder or a file if it is there.
fn discard(path: &Path) -> Result<(), StoreError> {
    let removed = match fs::symlink_metadata(path) {
        Ok(found) if found.is_dir() => fs::remove_dir_all(path),
        Ok(_) => fs::remove_file(path),
        Err(error) => Err(error),
    };
    match removed {
        Err(error) if error.kind() != ErrorKind::NotFound => failed("remove", path, error),
        _ => Ok(()),
    }
}
