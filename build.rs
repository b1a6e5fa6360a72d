//! Hashes the program's own sources: a report made by other sources is made again.

use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// What a report depends on; tests and examples it does not.
const FOLDERS: [&str; 6] = [
    "src",
    "crates/asperity/src",
    "crates/asperity-fft/src",
    "crates/asperity-contact-framework/src",
    "crates/asperity-plot/src",
    "crates/asperity-evidence/src",
];

/// Those of them that numbers follow from, whatever a page says of them.
const LIBRARY: [&str; 2] = ["crates/asperity/src", "crates/asperity-fft/src"];

fn main() {
    let manifests = ["Cargo.toml", "Cargo.lock", "build.rs"];
    println!("cargo:rustc-env=ASPERITY_SOURCES={}", hash_of(&manifests, &FOLDERS));
    println!("cargo:rustc-env=ASPERITY_LIBRARY={}", hash_of(&[], &LIBRARY));
    for watched in FOLDERS.into_iter().chain(manifests) {
        println!("cargo:rerun-if-changed={watched}");
    }
}

/// SHA-256 of files and of all files of folders, hexadecimal.
fn hash_of(files: &[&str], folders: &[&str]) -> String {
    let mut files: Vec<PathBuf> = files.iter().map(PathBuf::from).collect();
    for folder in folders {
        collect(Path::new(folder), &mut files);
    }
    files.sort();
    let mut hash = Sha256::new();
    for file in files.iter().filter(|file| file.is_file()) {
        let content = fs::read(file).expect("a source file that was just listed can be read");
        hash.update(file.to_string_lossy().as_bytes());
        hash.update((content.len() as u64).to_le_bytes());
        hash.update(&content);
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).expect("the source folder is there");
    for path in entries.filter_map(|entry| entry.ok().map(|entry| entry.path())) {
        if path.is_dir() {
            collect(&path, files);
        } else {
            files.push(path);
        }
    }
}
