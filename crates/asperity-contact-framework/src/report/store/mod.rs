//! The only module that writes to disk: reports are replaced atomically.
//!
//! A [`Store`] is one folder of reports, `DIR`. Each report is a folder of files, `DIR/<stem>/`:
//!
//! - A report is written next to its place and moved in, so that a reader, at any instant and
//!   after any crash, finds the old report or the new one. [`Store::recover`] clears up after a run
//!   that was killed; every first write does so too.
//! - A file that was edited since it was written is kept beside its new version, as `report.md.bak`.
//! - Nothing is destroyed that a run has not written: `manifest.json`, or the `files` of
//!   `summary.json`, must name every file of a report that is to be replaced.
//! - One run writes at a time: `DIR/.lock` is locked from the first write until the store is
//!   dropped. The empty file stays; unlocked it means nothing, and removing it could give two runs
//!   a lock each. File systems without locks are not locked.
//! - Nothing is created before the first write, so that a rejected run leaves no trace. Whether there is a place to write to is
//!   checked before a run. A folder that is removed during a run is made again.

mod manifest;

use std::fs::{File, TryLockError};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::{fs, io};

use manifest::{Kept, MANIFEST, Manifest};
use rayon::prelude::*;
use serde::Deserialize;

use crate::kept::{advice, check_writable};

const LOCK: &str = ".lock";

/// Why the disk was not touched, or what failed when it was.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The operating system refused.
    #[error("cannot {operation} {}: {source}{}", path.display(), advice(source))]
    Io {
        /// What was tried, as in "cannot write".
        operation: &'static str,
        path: PathBuf,
        source: io::Error,
    },
    /// A file is where the folder of reports, or a folder above it, should be.
    #[error("--out: {} is a file; allowed: a folder for the reports, new or existing", .0.display())]
    NotAFolder(PathBuf),
    /// The folder of reports, or a folder above it, is a link that leads nowhere.
    #[error("--out: {} is a link to {}, which is not there; allowed: a folder for the reports, new or existing", link.display(), to.display())]
    LeadsNowhere { link: PathBuf, to: PathBuf },
    /// Another process holds the lock.
    #[error("another run is writing to {}; wait for it to end or choose another --out", .0.display())]
    Busy(PathBuf),
    /// A report would replace something that no run has written.
    #[error("{} was not written by a run and would be lost; move it away or choose another --out", .0.display())]
    NotGenerated(PathBuf),
    /// An invalid name of a report or of one of its files.
    #[error("{0:?} cannot name a report or a file in it")]
    BadName(String),
}

/// The files of one report, and the key of the run that made them.
#[derive(Clone, Debug)]
pub struct Folder {
    stem: String,
    key: String,
    files: Vec<(String, Vec<u8>)>,
}

impl Folder {
    /// An empty report; `key` identifies everything that its content depends on.
    pub fn new(stem: impl Into<String>, key: impl Into<String>) -> Self {
        Self { stem: stem.into(), key: key.into(), files: Vec::new() }
    }

    pub fn file(&mut self, name: impl Into<String>, content: impl Into<Vec<u8>>) -> &mut Self {
        self.files.push((name.into(), content.into()));
        self
    }

    /// Names and contents of the files so far, in their order; `manifest.json` is not among them.
    pub fn files(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.files.iter().map(|(name, content)| (name.as_str(), content.as_slice()))
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|(name, _)| name.as_str())
    }
}

/// Whether a report is that of its experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Complete, on this input; one that was made here also by this program.
    UpToDate,
    Missing,
    /// The spec, or a file that it names, is another one.
    InputChanged,
    ProgramChanged,
    /// A file of it is missing or is another one.
    Edited,
}

#[derive(Debug)]
pub struct Store {
    directory: PathBuf,
    /// Present from the first write on.
    lock: Option<File>,
}

impl Store {
    /// A store in a folder that need not exist yet; touches nothing.
    pub fn new(directory: impl Into<PathBuf>) -> Self {
        Self { directory: directory.into(), lock: None }
    }

    /// Whether there is a report of this name.
    pub fn has(&self, stem: &str) -> bool {
        is_plain(stem) && Manifest::read(&self.directory.join(stem)).is_some()
    }

    /// Whether a report of this key is there with every file as it was written. A missing or altered
    /// file, or a manifest that says nothing of the kind, is a no; so is a report that a killed run
    /// had moved aside, until [`Store::recover`] brings it back.
    pub fn is_current(&self, stem: &str, key: &str) -> bool {
        is_plain(stem)
            && Manifest::read(&self.directory.join(stem))
                .is_some_and(|manifest| manifest.key == key && manifest.matches(&self.directory.join(stem)))
    }

    /// Whether the report of this name is that of an experiment of this key and input.
    pub fn state(&self, stem: &str, key: &str, input_sha256: &str) -> State {
        let folder = self.directory.join(stem);
        if !is_plain(stem) {
            return State::Missing;
        }
        if self.is_current(stem, key) || manifest::is_committed(&folder, input_sha256) {
            return State::UpToDate;
        }
        match manifest::summary(&folder).map(|summary| summary.input_sha256) {
            None => State::Missing,
            Some(input) if input != input_sha256 => State::InputChanged,
            Some(_) if Manifest::read(&folder).is_some_and(|manifest| manifest.key != key) => {
                State::ProgramChanged
            }
            Some(_) => State::Edited,
        }
    }

    /// The seconds that the last run of this report took on this machine.
    pub fn seconds(&self, stem: &str) -> Option<f64> {
        #[derive(Deserialize)]
        struct Times {
            total_s: f64,
        }
        let times = fs::read(self.directory.join(stem).join("timing.json")).ok()?;
        serde_json::from_slice(&times).ok().map(|Times { total_s }| total_s)
    }

    /// The hash of the library's sources by which a long report was made, where it says so.
    pub fn library(&self, stem: &str) -> Option<String> {
        manifest::summary(&self.directory.join(stem))?.library_sha256
    }

    /// Whether a report of this name may be written: [`StoreError::NotGenerated`] if something is in the
    /// way, [`StoreError::BadName`], or [`StoreError::Io`] if that cannot be determined. Writes nothing.
    pub fn check(&self, stem: &str) -> Result<(), StoreError> {
        if !is_plain(stem) {
            return Err(StoreError::BadName(stem.into()));
        }
        manifest::check_generated(&self.directory.join(stem))
    }

    /// Replaces the report of the same name atomically, with its `manifest.json`, and returns the names under which it kept
    /// files that were edited since they were written. Errors are those of [`Store::check`], [`StoreError::Busy`] and
    /// [`StoreError::Io`].
    pub fn write(&mut self, folder: &Folder) -> Result<Vec<String>, StoreError> {
        self.check(&folder.stem)?;
        for (k, name) in folder.names().enumerate() {
            if !is_plain(name) || name == MANIFEST || folder.names().take(k).any(|other| other == name) {
                return Err(StoreError::BadName(name.into()));
            }
        }
        self.open()?;
        // Clearing up may have brought back what an interrupted run had moved aside.
        self.check(&folder.stem)?;
        let places = Places::new(&self.directory, &folder.stem);
        let kept = Kept::read(&self.directory.join(&folder.stem))?;
        let done = write_all(&places.new, folder, &kept).and_then(|()| replace(&places));
        if done.is_err() {
            // The first error is more informative than one during cleanup.
            recover_one(&places).ok();
        }
        done.map(|()| kept.edited.into_iter().map(|(name, _)| name).collect())
    }

    /// Whether a page of this name may be written: [`StoreError::NotGenerated`] if a file is in the way that
    /// does not contain `mark`, which identifies generated pages. Writes nothing.
    pub fn check_page(&self, name: &str, mark: &str) -> Result<(), StoreError> {
        if !is_plain(name) {
            return Err(StoreError::BadName(name.into()));
        }
        let path = self.directory.join(name);
        match fs::symlink_metadata(&path) {
            Ok(found) => {
                let generated = found.is_file()
                    && fs::read(&path)
                        .or_else(|e| failed("read", &path, e))?
                        .windows(mark.len().max(1))
                        .any(|part| part == mark.as_bytes());
                if generated { Ok(()) } else { Err(StoreError::NotGenerated(path)) }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            Err(error) => failed("inspect", &path, error),
        }
    }

    /// Writes one file of the store itself, such as the index of all reports,
    /// atomically; `content` should contain `mark`. Errors are those of [`Store::check_page`] and [`Store::write`].
    pub fn write_page(&mut self, name: &str, content: &[u8], mark: &str) -> Result<(), StoreError> {
        self.check_page(name, mark)?;
        self.open()?;
        let path = self.directory.join(name);
        let new = Places::new(&self.directory, name).new;
        let done = write_file(&new, content).and_then(|()| rename(&new, &path));
        if done.is_err() {
            fs::remove_file(&new).ok();
        }
        done
    }

    /// Clears up after a run that was killed: unfinished reports go, a report that was moved aside
    /// comes back. A store that does not exist needs nothing but a place where it can be made. Errors: [`StoreError::NotAFolder`],
    /// [`StoreError::LeadsNowhere`], [`StoreError::Busy`] and [`StoreError::Io`].
    pub fn recover(&mut self) -> Result<(), StoreError> {
        if let Some(file) = self.directory.ancestors().find(|path| path.is_file()) {
            return Err(StoreError::NotAFolder(file.to_owned()));
        }
        if let Some(link) = self.directory.ancestors().find(|path| path.is_symlink() && !path.exists()) {
            let to = fs::read_link(link).or_else(|e| failed("read", link, e))?;
            return Err(StoreError::LeadsNowhere { link: link.to_owned(), to });
        }
        if self.directory.is_dir() {
            return self.open();
        }
        // A run takes long: that its report has no place is said before.
        let above = self.directory.ancestors().find(|path| path.is_dir()).unwrap_or(Path::new("."));
        check_writable(above).or_else(|e| failed("create folder", &self.directory, e))
    }

    /// Creates the folder, locks it and clears up: once, and again where it was removed meanwhile.
    fn open(&mut self) -> Result<(), StoreError> {
        let path = self.directory.join(LOCK);
        if self.lock.as_ref().is_some_and(|lock| is_at(lock, &path)) {
            return Ok(());
        }
        fs::create_dir_all(&self.directory).or_else(|e| failed("create folder", &self.directory, e))?;
        check_writable(&self.directory).or_else(|e| failed("write to", &self.directory, e))?;
        let file = File::options().create(true).truncate(false).write(true).open(&path);
        let file = file.or_else(|e| failed("open", &path, e))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(StoreError::Busy(self.directory.clone())),
            Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
            Err(TryLockError::Error(error)) => return failed("lock", &path, error),
        }
        recover(&self.directory)?;
        self.lock = Some(file);
        Ok(())
    }
}

/// Writes the files of a report and its manifest into a new folder, down to the disk.
fn write_all(path: &Path, folder: &Folder, kept: &Kept) -> Result<(), StoreError> {
    fs::create_dir(path).or_else(|e| failed("create folder", path, e))?;
    let files: Vec<_> = folder.files.iter().chain(&kept.earlier).chain(&kept.edited).collect();
    for (name, content) in &files {
        write_content(&path.join(name), content)?;
    }
    // Each takes a disk some time, in which the others get there too.
    files.par_iter().try_for_each(|(name, _)| sync_file(&path.join(name)))?;
    write_file(&path.join(MANIFEST), Manifest::new(&folder.key, &folder.files).text().as_bytes())?;
    sync_folder(path)
}

/// Writes a file down to the disk.
fn write_file(path: &Path, content: &[u8]) -> Result<(), StoreError> {
    write_content(path, content)?;
    sync_file(path)
}

fn write_content(path: &Path, content: &[u8]) -> Result<(), StoreError> {
    let mut file = File::create(path).or_else(|e| failed("create", path, e))?;
    file.write_all(content).or_else(|e| failed("write", path, e))
}

/// Brings a file down to the disk.
fn sync_file(path: &Path) -> Result<(), StoreError> {
    // Some systems flush only what is open for writing.
    let file = File::options().write(true).open(path);
    file.and_then(|file| file.sync_all()).or_else(|e| failed("write", path, e))
}

/// Whether an open file is still the one at a path.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |found: fs::Metadata| (found.dev(), found.ino());
    file.metadata().map(place).ok() == fs::metadata(path).map(place).ok()
}

/// Elsewhere an open file cannot be removed.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}

/// Brings renames in a folder down to the disk.
fn sync_folder(path: &Path) -> Result<(), StoreError> {
    // Elsewhere a folder cannot be opened like a file.
    if cfg!(unix) {
        File::open(path).and_then(|folder| folder.sync_all()).or_else(|e| failed("flush", path, e))?;
    }
    Ok(())
}

fn failed<T>(operation: &'static str, path: &Path, source: io::Error) -> Result<T, StoreError> {
    Err(StoreError::Io { operation, path: path.into(), source })
}

/// Whether a name is a valid visible file name on every system, so that a report may take it.
pub fn is_plain(name: &str) -> bool {
    !name.is_empty() && !name.starts_with('.') && !name.chars().any(is_special)
}

/// The name with a dash for each character that a file name does not have on every system.
pub fn plain(name: &str) -> String {
    name.chars().map(|c| if is_special(c) { '-' } else { c }).collect()
}

fn is_special(c: char) -> bool {
    c.is_control() || matches!(c, '/' | '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|')
}

/// Long enough that nothing else bears such a name.
const NEW: &str = ".asperity-new";
const OLD: &str = ".asperity-old";

/// Paths of a report: final, in preparation, moved aside.
struct Places {
    directory: PathBuf,
    place: PathBuf,
    new: PathBuf,
    old: PathBuf,
}

impl Places {
    fn new(directory: &Path, stem: &str) -> Self {
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
enum Step {
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

const INTO_FREE_PLACE: &[Step] = &[Step::MoveIn];
const BY_EXCHANGE: &[Step] = &[Step::Exchange, Step::DiscardExchanged];
const BY_TWO_RENAMES: &[Step] = &[Step::SetAside, Step::MoveIn, Step::DiscardAside];

/// Puts the new folder in its place.
fn replace(places: &Places) -> Result<(), StoreError> {
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

fn take(steps: &[Step], places: &Places) -> Result<(), StoreError> {
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
fn recover(directory: &Path) -> Result<(), StoreError> {
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
fn recover_one(places: &Places) -> Result<(), StoreError> {
    if exists(&places.old)? && !exists(&places.place)? {
        rename(&places.old, &places.place)?;
    }
    discard(&places.old)?;
    discard(&places.new)
}

/// Renames and brings that down to the disk.
fn rename(from: &Path, to: &Path) -> Result<(), StoreError> {
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

#[cfg(test)]
mod tests;
