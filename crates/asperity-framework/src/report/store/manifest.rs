//! What a run wrote into a folder, and under which key.

use super::{StoreError, failed, is_plain};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

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
    pub(super) fn of(key: &str, files: &[(String, Vec<u8>)]) -> Self {
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

    /// Whether every file exists with the content that was written.
    pub(super) fn matches(&self, folder: &Path) -> bool {
        self.files.iter().all(|(name, written)| {
            // A name that leads out of the folder was not written by a run.
            is_plain(name) && fs::read(folder.join(name)).is_ok_and(|content| hash(&content) == *written)
        })
    }
}

/// Fields of `summary.json` that identify it as written by a run; a fresh clone has no manifest.
#[derive(Deserialize)]
struct Summary {
    program: String,
    #[serde(default)]
    files: Vec<String>,
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
        let known = entry.file_name().to_str().is_some_and(|name| generated.contains(name));
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
    let summary =
        fs::read(folder.join(SUMMARY)).ok().and_then(|text| serde_json::from_slice::<Summary>(&text).ok());
    if let Some(summary) = summary.filter(|summary| summary.program == PROGRAM) {
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
        let manifest = Manifest::of("k\"1", &[("a.csv".into(), b"1".to_vec())]);
        assert_eq!(serde_json::from_str::<Manifest>(&manifest.text()).unwrap(), manifest);
    }
}
