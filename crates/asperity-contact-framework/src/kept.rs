//! What a long run has done so far, in a folder: one file for each piece, whole or not there, so that a killed run continues; what a user
//! can do about a disk that refuses.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// The pieces of one run in a folder.
#[derive(Debug)]
pub struct Kept {
    folder: PathBuf,
}

impl Kept {
    /// Those in `folder`, which need not be there.
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned() }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.json"))
    }

    /// The piece of a name; `None` where there is none that can be read.
    pub fn read(&self, name: &str) -> Option<Vec<u8>> {
        fs::read(self.path(name)).ok()
    }

    /// Keeps a piece, in the place of another of this name.
    pub fn write(&self, name: &str, content: &[u8]) -> io::Result<()> {
        let path = self.path(name);
        let write = || {
            fs::create_dir_all(&self.folder)?;
            let mut file = NamedTempFile::with_prefix_in(".", &self.folder)?;
            file.write_all(content)?;
            file.as_file().sync_all()?;
            file.persist(&path).map_err(|error| error.error)?;
            Ok(())
        };
        write().map_err(|error: io::Error| {
            io::Error::new(error.kind(), format!("cannot keep {}: {error}{}", path.display(), advice(&error)))
        })
    }

    /// Removes all pieces but those of `names`, and what killed runs have left; what cannot be removed stays.
    pub fn retain(&self, names: &BTreeSet<String>) {
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let is_used = path.extension().is_some_and(|ending| ending == "json")
                && path.file_stem().and_then(|stem| stem.to_str()).is_some_and(|name| names.contains(name));
            if !is_used {
                let _ = fs::remove_file(path);
            }
        }
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_is_whole_and_the_last_one_counts() {
        let folder = tempfile::tempdir().unwrap();
        let kept = Kept::new(&folder.path().join("sweep"));
        assert_eq!(kept.read("a"), None);
        kept.write("a", b"1").unwrap();
        kept.write("a", b"22").unwrap();
        kept.write("b", b"3").unwrap();
        assert_eq!(kept.read("a").unwrap(), b"22");
        fs::write(folder.path().join("sweep/.killed"), "half").unwrap();
        kept.retain(&BTreeSet::from(["b".to_owned()]));
        assert_eq!(kept.read("a"), None);
        assert_eq!(fs::read_dir(folder.path().join("sweep")).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_named() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let message = Kept::new(file.path()).write("a", b"1").unwrap_err().to_string();
        assert!(message.contains("cannot keep") && message.contains("a.json"), "{message}");
    }
}
