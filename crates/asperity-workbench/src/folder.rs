//! The user's files in one folder: read and added. Nothing outside of it is touched, and nothing in it is overwritten unasked.

use std::fs;
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

use asperity_contact_framework::report::Index;
use serde::Serialize;
use sha2::{Digest, Sha256};
use tempfile::NamedTempFile;

use crate::engine::Refused;
use crate::limits;
use crate::listing::is_report;

pub const UPLOADS: &str = "uploads";
pub const REPORTS: &str = "reports";
const EXAMPLE: &str = "example";
/// Begins the name of a file that is not yet whole.
const PART: &str = ".part-";

#[derive(Debug, Clone)]
pub struct Folder {
    root: PathBuf,
}

#[derive(Debug, Serialize)]
pub struct SpecOnDisk {
    pub text: String,
    pub state: String,
}

impl Folder {
    /// The folder at `path`, in which parts of files of a server that was killed are removed.
    pub fn new(path: &Path) -> io::Result<Self> {
        let root = fs::canonicalize(path)?;
        if !root.is_dir() {
            return Err(io::Error::new(io::ErrorKind::NotADirectory, "is no folder"));
        }
        let folder = Self { root };
        ["", UPLOADS, EXAMPLE].iter().for_each(|name| folder.remove_parts(name));
        Ok(folder)
    }

    /// Removes the parts of files that no server is writing any more.
    fn remove_parts(&self, name: &str) {
        let is_part = |entry: &fs::DirEntry| {
            let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
            is_file && entry.file_name().to_str().is_some_and(|name| name.starts_with(PART))
        };
        let Ok(folder) = self.made(name) else { return };
        for part in fs::read_dir(folder).into_iter().flatten().flatten().filter(is_part) {
            // Another server holds the lock of what it writes.
            if fs::File::open(part.path()).is_ok_and(|file| file.try_lock().is_ok()) {
                let _ = fs::remove_file(part.path());
            }
        }
    }

    /// A folder in it, by its path without links.
    fn made(&self, name: &str) -> io::Result<PathBuf> {
        let whole = fs::canonicalize(self.root.join(name))?;
        if whole.starts_with(&self.root) {
            Ok(whole)
        } else {
            Err(io::Error::other("leads out of the folder of the workbench"))
        }
    }

    /// The same, which is made where it is not there.
    fn make(&self, name: &str) -> io::Result<PathBuf> {
        fs::create_dir_all(self.root.join(name))?;
        self.made(name)
    }

    /// A file in it to be filled, which a server that starts meanwhile leaves alone.
    fn part(folder: &Path) -> io::Result<NamedTempFile> {
        let file = NamedTempFile::with_prefix_in(PART, folder)?;
        // Where files have no locks nobody is in the way.
        let _ = file.as_file().try_lock();
        Ok(file)
    }

    pub fn reports(&self) -> Result<PathBuf, Refused> {
        let refuse = |error: io::Error| Refused::new(format!("{REPORTS}: cannot be written: {error}"));
        // Nothing is made before there is a report.
        let folder = match fs::symlink_metadata(self.root.join(REPORTS)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => self.root.join(REPORTS),
            _ => self.made(REPORTS).map_err(refuse)?,
        };
        // The lock of the reports is written through a link.
        let is_link = fs::symlink_metadata(folder.join(".lock")).is_ok_and(|lock| lock.is_symlink());
        if is_link { Err(outside(&format!("{REPORTS}/.lock"))) } else { Ok(folder) }
    }

    /// A page that leads to `address`, for its user's browser alone: the address holds the token, and what a program is started with
    /// everybody on the machine can read.
    pub fn page_that_leads_to(&self, address: &str) -> io::Result<NamedTempFile> {
        let mut file = tempfile::Builder::new().prefix(PART).suffix(".html").tempfile_in(&self.root)?;
        let _ = file.as_file().try_lock();
        write!(
            file,
            "<!DOCTYPE html><title>Asperity workbench</title><meta http-equiv=\"refresh\" content=\"0;url={address}\">"
        )?;
        Ok(file)
    }

    pub fn root(&self) -> &Path {
        &self.root
    }

    /// A folder or file in it that is there.
    pub fn existing(&self, path: &str) -> Result<PathBuf, Refused> {
        let joined = self.root.join(inside(path)?);
        let whole = fs::canonicalize(&joined)
            .map_err(|error| Refused::new(format!("{path}: cannot be read: {error}")))?;
        if whole.starts_with(&self.root) { Ok(whole) } else { Err(outside(path)) }
    }

    /// A file in it that is there: no folder, no pipe, which would keep its reader waiting.
    pub fn file(&self, path: &str) -> Result<PathBuf, Refused> {
        let whole = self.existing(path)?;
        if whole.is_file() { Ok(whole) } else { Err(Refused::new(format!("{path}: is no file"))) }
    }

    /// A folder in it that is there.
    pub fn folder(&self, path: &str) -> Result<PathBuf, Refused> {
        let whole = self.existing(path)?;
        if whole.is_dir() { Ok(whole) } else { Err(Refused::new(format!("{path}: is no folder"))) }
    }

    /// The path from the folder, with slashes.
    pub fn name_of(&self, path: &Path) -> Option<String> {
        let parts = path.strip_prefix(&self.root).ok()?.components();
        let parts: Option<Vec<&str>> = parts.map(|part| part.as_os_str().to_str()).collect();
        Some(parts?.join("/"))
    }

    pub fn spec(&self, path: &str) -> Result<SpecOnDisk, Refused> {
        let whole = self.file(path)?;
        let bytes = fs::metadata(&whole).map_or(0, |metadata| metadata.len());
        if bytes > limits::REQUEST as u64 {
            return Err(Refused::new(format!(
                "{path}: found {bytes} bytes; allowed: a spec of at most {} bytes",
                limits::REQUEST
            )));
        }
        let text = fs::read_to_string(whole)
            .map_err(|error| Refused::new(format!("{path}: cannot be read: {error}")))?;
        Ok(SpecOnDisk { state: hash(&text), text })
    }

    /// Writes a spec, whole or not at all: a new file, or in place of the one whose `state` is known.
    pub fn save(&self, path: &str, text: &str, state: Option<&str>) -> Result<String, Refused> {
        let whole = self.new_path(path, "toml")?;
        match fs::read_to_string(&whole) {
            Ok(before) if before == text => return Ok(hash(text)),
            Ok(before) if state.is_some_and(|state| state == hash(&before)) => {}
            Ok(_) => {
                return Err(Refused::new(format!(
                    "{path}: found a file that is not the one this page has read or written; allowed: a new name, or to open that file"
                )));
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(Refused::new(format!("{path}: cannot be read: {error}"))),
        }
        let written = || {
            let mut file = Self::part(whole.parent().unwrap_or(&self.root))?;
            file.write_all(text.as_bytes())?;
            file.as_file().sync_all()?;
            if whole.exists() { file.persist(&whole) } else { file.persist_noclobber(&whole) }
                .map_err(|error| error.error)?;
            Ok::<(), io::Error>(())
        };
        written().map_err(|error| Refused::new(format!("{path}: cannot be written: {error}")))?;
        Ok(hash(text))
    }

    /// A path for a new file with this ending, in a folder that is there.
    fn new_path(&self, path: &str, ending: &str) -> Result<PathBuf, Refused> {
        let relative = inside(path)?;
        let name = relative.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if !is_plain(name) || !name.ends_with(&format!(".{ending}")) {
            return Err(Refused::new(format!(
                "found the name \"{path}\"; allowed: a name such as my-surface.{ending}, without any of \\:*?\"<>| and no point at its beginning"
            )));
        }
        let folder = relative.parent().and_then(Path::to_str).unwrap_or_default();
        let whole = self.folder(folder)?.join(name);
        // A link in its place would lead elsewhere.
        match fs::symlink_metadata(&whole) {
            Ok(metadata) if !metadata.is_file() => Err(outside(path)),
            _ => Ok(whole),
        }
    }

    /// A file to be filled with what is dropped on the page.
    pub fn upload(&self, name: &str) -> Result<Upload, Refused> {
        let refuse = |error: io::Error| Refused::new(format!("{UPLOADS}: cannot be written: {error}"));
        let folder = self.make(UPLOADS).map_err(refuse)?;
        let file = Self::part(&folder).map_err(refuse)?;
        Ok(Upload { file, folder, name: plain_name(name), bytes: 0, hash: Sha256::new() })
    }

    /// Writes a file of the example, unless it is there; gives its path.
    pub fn add(&self, name: &str, content: &[u8]) -> Result<String, Refused> {
        let path = format!("{EXAMPLE}/{name}");
        let (below, last) = path.rsplit_once('/').unwrap_or(("", &path));
        let written = || {
            let folder = self.make(below)?;
            let whole = folder.join(last);
            if whole.is_file() && fs::read(&whole).is_ok_and(|before| before == content) {
                return Ok(());
            }
            let mut file = Self::part(&folder)?;
            file.write_all(content)?;
            file.persist_noclobber(&whole).map_err(|error| error.error)?;
            Ok(())
        };
        written().map_err(|error: io::Error| Refused::new(format!("{path}: cannot be written: {error}")))?;
        Ok(path)
    }

    /// A file of a report, with its media type.
    pub fn of_report(&self, path: &str) -> Result<(Vec<u8>, &'static str), Refused> {
        const TYPES: [(&str, &str); 8] = [
            ("html", "text/html; charset=utf-8"),
            ("svg", "image/svg+xml"),
            ("png", "image/png"),
            ("pdf", "application/pdf"),
            ("csv", "text/csv; charset=utf-8"),
            ("json", "application/json"),
            ("md", "text/markdown; charset=utf-8"),
            ("toml", "text/plain; charset=utf-8"),
        ];
        let no_file = || Refused::new(format!("{path}: found no file of a report"));
        let whole = self.file(path)?;
        let ending = whole.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        let media =
            TYPES.iter().find(|(one, _)| *one == ending).map(|(_, media)| *media).ok_or_else(no_file)?;
        let folder = whole.parent().unwrap_or(&self.root);
        // The pages that lead to all reports lie beside their folders.
        let name = whole.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let is_index = || {
            Index::FILES.contains(&name)
                && fs::read_dir(folder).into_iter().flatten().flatten().any(|entry| is_report(&entry.path()))
        };
        if !is_report(folder) && !is_index() {
            return Err(no_file());
        }
        let content =
            fs::read(&whole).map_err(|error| Refused::new(format!("{path}: cannot be read: {error}")))?;
        Ok((content, media))
    }
}

/// A file that is being dropped.
pub struct Upload {
    file: NamedTempFile,
    folder: PathBuf,
    name: String,
    bytes: u64,
    hash: Sha256,
}

impl Upload {
    pub fn add(&mut self, bytes: &[u8]) -> Result<(), Refused> {
        self.bytes += bytes.len() as u64;
        if self.bytes > limits::UPLOAD {
            return Err(too_large(self.bytes));
        }
        self.hash.update(bytes);
        self.file
            .write_all(bytes)
            .map_err(|error| Refused::new(format!("{}: cannot be written: {error}", self.name)))
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// Keeps it, if `accept` takes it, under its name, or under one with a number where another file has that; the same file is kept once.
    /// Gives its path from the folder of the workbench.
    pub fn finish(self, accept: impl FnOnce(&Path) -> Result<(), Refused>) -> Result<String, Refused> {
        accept(self.file.path())?;
        /// Files of one name.
        const MOST: u32 = 10_000;
        let Self { mut file, folder, name, hash, bytes } = self;
        let refuse = |error: io::Error| Refused::new(format!("{UPLOADS}/{name}: cannot be written: {error}"));
        file.as_file().sync_all().map_err(refuse)?;
        let hash = hash.finalize();
        let (stem, ending) = name
            .rsplit_once('.')
            .map_or((name.as_str(), String::new()), |(stem, ending)| (stem, format!(".{ending}")));
        for number in 1..MOST {
            let numbered = if number == 1 { name.clone() } else { format!("{stem}-{number}{ending}") };
            let path = folder.join(&numbered);
            let is_same = || {
                let has_size = fs::metadata(&path).is_ok_and(|metadata| metadata.len() == bytes);
                has_size
                    && asperity_contact_framework::digest::sha256_of_file(&path)
                        .is_ok_and(|other| other[..] == hash[..])
            };
            if is_same() {
                return Ok(format!("{UPLOADS}/{numbered}"));
            }
            match file.persist_noclobber(&path) {
                Ok(_) => return Ok(format!("{UPLOADS}/{numbered}")),
                Err(error) if error.error.kind() == io::ErrorKind::AlreadyExists => file = error.file,
                Err(error) => return Err(refuse(error.error)),
            }
        }
        Err(Refused::new(format!("{UPLOADS}/{name}: found {MOST} files of this name; allowed: another name")))
    }
}

/// Refuses a file of so many bytes.
pub fn too_large(bytes: u64) -> Refused {
    let gigabytes = |bytes: u64| bytes as f64 / f64::from(1 << 30);
    Refused::new(format!(
        "found a file of {:.2} GiB; allowed: up to {:.0} GiB. A larger one is put into the folder by hand",
        gigabytes(bytes),
        gigabytes(limits::UPLOAD)
    ))
}

/// A path from the folder that names no way out of it.
fn inside(path: &str) -> Result<PathBuf, Refused> {
    let parts = Path::new(path);
    let is_inside =
        parts.components().all(|part| matches!(part, Component::Normal(_))) && !path.contains(['\\', '\0']);
    if is_inside { Ok(parts.to_owned()) } else { Err(outside(path)) }
}

fn outside(path: &str) -> Refused {
    Refused::new(format!("found \"{path}\"; allowed: a file in the folder of the workbench"))
}

/// Whether a text is the name of a file on every system.
pub fn is_plain(name: &str) -> bool {
    !name.is_empty()
        && !name.starts_with('.')
        && !name.ends_with(['.', ' '])
        && name.len() <= 200
        && !name.contains(|c: char| c.is_control() || "/\\:*?\"<>|".contains(c))
}

/// A name for a dropped file, as near to its own as every system allows.
fn plain_name(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let replaced: String =
        last.chars().map(|c| if c.is_control() || ":*?\"<>|".contains(c) { '-' } else { c }).collect();
    let begun = replaced.trim_start_matches('.').trim();
    let mut kept = String::new();
    // The end of a long name holds its ending.
    for c in begun.chars().rev() {
        if kept.len() + c.len_utf8() > 150 {
            break;
        }
        kept.insert(0, c);
    }
    if is_plain(&kept) { kept } else { "surface".to_owned() }
}

fn hash(text: &str) -> String {
    asperity_contact_framework::digest::hexadecimal(&Sha256::digest(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_name_keeps_its_ending() {
        let long = plain_name(&format!("{}é.x3p", "a".repeat(300)));
        assert!(long.len() <= 150 && long.ends_with("aé.x3p"), "{long}");
    }

    #[test]
    fn a_spec_that_is_saved_again_is_no_other_file() {
        let made = tempfile::tempdir().unwrap();
        let folder = Folder::new(made.path()).unwrap();
        let state = folder.save("a.toml", "one", None).unwrap();
        assert_eq!(folder.save("a.toml", "one", None).unwrap(), state);
        assert!(folder.save("a.toml", "two", None).unwrap_err().message.contains("a new name"));
    }
}
