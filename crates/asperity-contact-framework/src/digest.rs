//! SHA-256 of texts and files, and seeds made from them.

use std::fs::File;
use std::io::{ErrorKind, Read, Seek, Write};
use std::path::Path;
use std::time::SystemTime;

use asperity::progress::{Count, Progress, Silent};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// SHA-256 of some bytes.
pub fn sha256(bytes: &[u8]) -> [u8; 32] {
    Sha256::digest(bytes).into()
}

/// SHA-256 of a file's content.
///
/// # Errors
/// A file that cannot be read.
pub fn sha256_of_file(path: &Path) -> std::io::Result<[u8; 32]> {
    watched_sha256_of_file(path, &Silent)
}

/// [`sha256_of_file`] with progress: a stage of the bytes of the file.
///
/// # Errors
/// A file that cannot be read.
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

/// SHA-256 of files, kept in a folder that many processes share: a large file is read by the first of them only, for which
/// the others wait.
#[derive(Debug)]
pub struct KnownFiles<'a> {
    /// The folder.
    pub folder: &'a Path,
}

/// A file as it was when its hash was computed.
#[derive(PartialEq, Eq, Serialize, Deserialize)]
struct KnownFile {
    bytes: u64,
    modified: SystemTime,
    sha256: [u8; 32],
}

impl KnownFiles<'_> {
    /// [`sha256_of_file`], read again only where size or time of the file have changed.
    ///
    /// # Errors
    /// A file that cannot be read, or a folder that cannot be written to.
    pub fn sha256(&self, path: &Path) -> std::io::Result<[u8; 32]> {
        std::fs::create_dir_all(self.folder)?;
        let whole = std::fs::canonicalize(path)?;
        let name = hexadecimal(&sha256(whole.as_os_str().as_encoded_bytes())[..8]);
        let place = self.folder.join(format!(".input-{name}.json"));
        let mut kept = File::options().create(true).truncate(false).read(true).write(true).open(place)?;
        match kept.lock() {
            // Without locks each process reads the file.
            Err(error) if error.kind() != ErrorKind::Unsupported => return Err(error),
            _ => {}
        }
        let metadata = std::fs::metadata(path)?;
        let (bytes, modified) = (metadata.len(), metadata.modified()?);
        let mut text = String::new();
        kept.read_to_string(&mut text)?;
        // What a killed process left is no description of a file.
        let known: Option<KnownFile> = serde_json::from_str(&text).ok();
        if let Some(known) = known.filter(|known| known.bytes == bytes && known.modified == modified) {
            return Ok(known.sha256);
        }
        let sha256 = sha256_of_file(path)?;
        kept.set_len(0)?;
        kept.rewind()?;
        kept.write_all(&serde_json::to_vec(&KnownFile { bytes, modified, sha256 })?)?;
        Ok(sha256)
    }
}

/// Bytes as lower-case hexadecimal digits.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_again_once_it_has_changed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("list.npy");
        let known = KnownFiles { folder: &folder.path().join("parts") };
        std::fs::write(&path, "one").unwrap();
        let old = std::fs::metadata(&path).unwrap().modified().unwrap();
        assert_eq!(known.sha256(&path).unwrap(), sha256(b"one"));
        // The same size and time: not read.
        std::fs::write(&path, "two").unwrap();
        File::options().write(true).open(&path).unwrap().set_modified(old).unwrap();
        assert_eq!(known.sha256(&path).unwrap(), sha256(b"one"));
        std::fs::write(&path, "three").unwrap();
        assert_eq!(known.sha256(&path).unwrap(), sha256(b"three"));
        // What a killed process left.
        let kept = std::fs::read_dir(known.folder).unwrap().next().unwrap().unwrap().path();
        std::fs::write(&kept, "{\"bytes\":5,").unwrap();
        assert_eq!(known.sha256(&path).unwrap(), sha256(b"three"));
        assert_eq!(known.sha256(&folder.path().join("none")).unwrap_err().kind(), ErrorKind::NotFound);
    }
}
