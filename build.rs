//! Hashes the program's own sources: a report made by other sources is made again.

use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// What a report depends on; tests and examples it does not.
const FOLDERS: [&str; 7] = [
    "src",
    "crates/asperity/src",
    "crates/asperity-fft/src",
    "crates/asperity-contact-framework/src",
    "crates/asperity-plot/src",
    "crates/asperity-print/src",
    "crates/asperity-validation/src",
];

fn main() {
    let mut files = vec![PathBuf::from("Cargo.toml"), PathBuf::from("Cargo.lock"), PathBuf::from("build.rs")];
    for folder in FOLDERS {
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
    let hex: String = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    println!("cargo:rustc-env=ASPERITY_SOURCES={hex}");
    for watched in FOLDERS.into_iter().chain(["Cargo.toml", "Cargo.lock", "build.rs"]) {
        println!("cargo:rerun-if-changed={watched}");
    }
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
