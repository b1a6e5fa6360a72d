//! What a run wrote into a folder, and under which key.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::{StoreError, failed, is_plain};

pub(super) const MANIFEST: &str = "manifest.json";
const SUMMARY: &str = "summary.json";
const PROGRAM: &str = "asperity";

/// The content of `manifest.json`.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Manifest {
    program: String,
    pub(super) key: String,
    /// SHA-256 of each file, by its name.
    files: BTreeMap<String, String>,
}

impl Manifest {
    pub(super) fn new(key: &str, files: &[(String, Vec<u8>)]) -> Self {
        let files = files.iter().map(|(name, content)| (name.clone(), hash(content))).collect();
        Self { program: PROGRAM.into(), key: key.into(), files }
    }

    /// The manifest of a folder, if this program wrote one.
    pub(super) fn read(folder: &Path) -> Option<Self> {
        let manifest: Self = serde_json::from_slice(&fs::read(folder.join(MANIFEST)).ok()?).ok()?;
        (manifest.program == PROGRAM).then_some(manifest)
    }

    pub(super) fn text(&self) -> String {
        // Text keys and text values always make JSON.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Whether the report in a folder is still the one that was written, edited or not: its summary, which no one edits, is that
    /// of another run where version control has replaced the files.
    fn is_of(&self, folder: &Path) -> bool {
        let written = self.files.get(SUMMARY);
        written.is_some_and(|written| {
            fs::read(folder.join(SUMMARY)).is_ok_and(|content| hash(&content) == *written)
        })
    }

    /// Whether every file exists with the content that was written.
    pub(super) fn matches(&self, folder: &Path) -> bool {
        self.files.iter().all(|(name, written)| {
            // A name that leads out of the folder was not written by a run.
            is_plain(name) && fs::read(folder.join(name)).is_ok_and(|content| hash(&content) == *written)
        })
    }
}

/// Files in a folder of a report that its user has made: each is kept under its name here when the report is replaced.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Kept {
    /// Files edited since they were written, by their new name.
    pub(super) edited: Vec<(String, Vec<u8>)>,
    /// Those that an earlier replacement kept.
    pub(super) earlier: Vec<(String, Vec<u8>)>,
}

impl Kept {
    /// Looks for them. Without a manifest of this report nothing is known to be edited.
    pub(super) fn read(folder: &Path) -> Result<Self, StoreError> {
        let mut kept = Self::default();
        if !folder.is_dir() {
            return Ok(kept);
        }
        let mut taken = BTreeSet::new();
        for entry in fs::read_dir(folder).or_else(|e| failed("list", folder, e))? {
            let entry = entry.or_else(|e| failed("list", folder, e))?;
            let Some(name) =
                entry.file_name().to_str().filter(|name| unkept(name).is_some()).map(str::to_owned)
            else {
                continue;
            };
            let content = fs::read(entry.path()).or_else(|e| failed("read", &entry.path(), e))?;
            taken.insert(name.clone());
            kept.earlier.push((name, content));
        }
        let manifest = Manifest::read(folder).filter(|manifest| manifest.is_of(folder));
        for (name, written) in manifest.iter().flat_map(|manifest| &manifest.files) {
            // A name that leads out of the folder was not written by a run; a file that is gone has nothing to keep.
            let Some(content) =
                Some(name).filter(|name| is_plain(name)).and_then(|name| fs::read(folder.join(name)).ok())
            else {
                continue;
            };
            if hash(&content) != *written {
                let free = (1..)
                    .map(|k| if k == 1 { format!("{name}{BACKUP}") } else { format!("{name}{BACKUP}{k}") });
                let new = free.into_iter().find(|new| !taken.contains(new)).unwrap_or_default();
                kept.edited.push((new, content));
            }
        }
        Ok(kept)
    }
}

/// Ending of a file that was edited by hand before its report was replaced; from the second on with a number.
const BACKUP: &str = ".bak";

/// The name that a kept file had; `None` of other files.
fn unkept(name: &str) -> Option<&str> {
    let (before, number) = name.rsplit_once(BACKUP)?;
    (!before.is_empty() && number.chars().all(|digit| digit.is_ascii_digit())).then_some(before)
}

/// Fields of `summary.json` that identify it as written by a run; a fresh clone has no manifest.
#[derive(Deserialize)]
pub(super) struct Summary {
    program: String,
    #[serde(default)]
    files: Vec<String>,
    #[serde(default)]
    pub(super) input_sha256: String,
    pub(super) library_sha256: Option<String>,
    /// SHA-256 of the files that version control keeps.
    #[serde(default)]
    committed: BTreeMap<String, String>,
}

/// Whether a folder holds a report without manifest, on the input with this hash, whose pages, pictures and short tables are those
/// that were written: one that came with a clone.
pub(super) fn is_committed(folder: &Path, input_sha256: &str) -> bool {
    !folder.join(MANIFEST).exists()
        && summary(folder).is_some_and(|summary| {
            summary.input_sha256 == input_sha256
                && !summary.committed.is_empty()
                && summary.committed.iter().all(|(name, written)| {
                    is_plain(name)
                        && fs::read(folder.join(name)).is_ok_and(|content| hash(&content) == *written)
                })
        })
}

/// The summary of a folder, if this program wrote one.
pub(super) fn summary(folder: &Path) -> Option<Summary> {
    let summary: Summary = serde_json::from_slice(&fs::read(folder.join(SUMMARY)).ok()?).ok()?;
    (summary.program == PROGRAM).then_some(summary)
}

/// Checks that `path` is free, or a folder with generated files only.
pub(super) fn check_generated(path: &Path) -> Result<(), StoreError> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_dir() => {}
        Ok(_) => return Err(StoreError::NotGenerated(path.into())),
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(error) => return failed("inspect", path, error),
    }
    let generated = written(path);
    for entry in fs::read_dir(path).or_else(|e| failed("list", path, e))? {
        let entry = entry.or_else(|e| failed("list", path, e))?;
        let is_file = entry.file_type().or_else(|e| failed("inspect", &entry.path(), e))?.is_file();
        let known = entry.file_name().to_str().is_some_and(|name| {
            generated.contains(name) || unkept(name).is_some_and(|name| generated.contains(name))
        });
        if !is_file || !known {
            return Err(StoreError::NotGenerated(entry.path()));
        }
    }
    Ok(())
}

/// Names of the generated files in a folder, by its manifest or summary.
fn written(folder: &Path) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    if let Some(manifest) = Manifest::read(folder) {
        names.extend(manifest.files.into_keys());
        names.insert(MANIFEST.to_owned());
    }
    if let Some(summary) = summary(folder) {
        names.extend(summary.files);
        names.extend([SUMMARY, MANIFEST].map(str::to_owned));
    }
    names
}

fn hash(content: &[u8]) -> String {
    Sha256::digest(content).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_sha_256() {
        assert_eq!(hash(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }

    #[test]
    fn the_text_reads_back() {
        let manifest = Manifest::new("k\"1", &[("a.csv".into(), b"1".to_vec())]);
        assert_eq!(serde_json::from_str::<Manifest>(&manifest.text()).unwrap(), manifest);
    }
}
