//! SHA-256 of texts and files, and seeds made from them.

use std::io::Read;
use std::path::Path;

use asperity::progress::{Count, Progress, Silent};
use sha2::{Digest, Sha256};

pub fn sha256(bytes: &[u8]) -> [u8; 32] {
    Sha256::digest(bytes).into()
}

/// SHA-256 of a file's content.
pub fn sha256_of_file(path: &Path) -> std::io::Result<[u8; 32]> {
    watched_sha256_of_file(path, &Silent)
}

/// [`sha256_of_file`] with progress: a stage of the bytes of the file.
pub fn watched_sha256_of_file(path: &Path, progress: &dyn Progress) -> std::io::Result<[u8; 32]> {
    let mut file = std::fs::File::open(path)?;
    let bytes = file.metadata()?.len();
    progress.stage("comparing files", bytes as f64);
    let mut count = Count::new(progress, bytes as f64, bytes as usize);
    let mut hash = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer)? {
            0 => {
                count.end();
                return Ok(hash.finalize().into());
            }
            length => {
                hash.update(&buffer[..length]);
                count.add(length);
            }
        }
    }
}

pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
