//! The secret that opens the page, kept in the user's configuration folder, so that a bookmark works after a restart.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use etcetera::base_strategy::{BaseStrategy, choose_native_strategy};

const DIGITS: usize = 64;

/// Where the token is kept: `asperity/workbench-token` in the configuration folder.
pub fn path() -> Option<PathBuf> {
    Some(choose_native_strategy().ok()?.config_dir().join("asperity").join("workbench-token"))
}

/// The token in the file at `path`, which is made where there is none or it holds something else; only its owner can read it.
///
/// # Errors
/// A file that cannot be read or written.
pub fn kept(path: &Path) -> io::Result<String> {
    match fs::read_to_string(path) {
        // One that others could read is theirs, too.
        Ok(text) if is_token(text.trim_end()) && is_private(path)? => return Ok(text.trim_end().to_owned()),
        Ok(_) => {}
        Err(error) if matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::InvalidData) => {}
        Err(error) => return Err(error),
    }
    let token = random()?;
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    // It is private from its first byte on, and whole.
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    writeln!(file, "{token}")?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(token)
}

pub fn random() -> io::Result<String> {
    let mut bytes = [0; DIGITS / 2];
    getrandom::fill(&mut bytes).map_err(io::Error::other)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

fn is_token(text: &str) -> bool {
    text.len() == DIGITS && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// Whether two texts are the same, in a time that does not tell where they differ.
pub fn is_same(one: &str, other: &str) -> bool {
    let difference = one.bytes().zip(other.bytes()).fold(0, |sum, (a, b)| sum | (a ^ b));
    one.len() == other.len() && std::hint::black_box(difference) == 0
}

/// Whether its owner alone may read a file.
#[cfg(unix)]
fn is_private(path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::PermissionsExt;
    Ok(fs::metadata(path)?.permissions().mode() & 0o077 == 0)
}

#[cfg(not(unix))]
fn is_private(_: &Path) -> io::Result<bool> {
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_kept_and_private() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/token");
        let first = kept(&path).unwrap();
        assert!(is_token(&first));
        assert_eq!(kept(&path).unwrap(), first);
        fs::write(&path, "short").unwrap();
        assert_ne!(kept(&path).unwrap(), first);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let before = kept(&path).unwrap();
            fs::set_permissions(&path, fs::Permissions::from_mode(0o644)).unwrap();
            assert_ne!(kept(&path).unwrap(), before);
            assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
        }
    }

    #[test]
    fn only_the_same_texts_are_the_same() {
        assert!(
            is_same("abc", "abc") && !is_same("abc", "abd") && !is_same("abc", "ab") && !is_same("", "a")
        );
    }
}
