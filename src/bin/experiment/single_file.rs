//! Single files that a command writes beside reports: a saved spec, a template.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use asperity_contact_framework::kept::advice;

use super::{Failure, interrupt};

/// Refuses to save a spec of a spec, over a file, or where none can be written, before anything runs.
pub fn check_save_spec(file: &Path, spec: &Path) -> Result<(), Failure> {
    if file.extension().is_some_and(|ending| ending == "toml") {
        let message =
            format!("{}: is a spec already; allowed: --save-spec with a measured file", file.display());
        return Err(Failure::Input(message));
    }
    if spec.exists() {
        let message =
            format!("--save-spec {}: found a file of this name; allowed: a new name", spec.display());
        return Err(Failure::Input(message));
    }
    let folder = spec.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        let message = format!(
            "--save-spec {}: found no folder {}; allowed: a new name in a folder that is there",
            spec.display(),
            folder.display()
        );
        return Err(Failure::Input(message));
    }
    // Nothing but an attempt says whether a file can be made there.
    File::create_new(spec).and_then(|_| fs::remove_file(spec)).map_err(|error| {
        Failure::Input(format!(
            "--save-spec {}: {error}; allowed: a file that can be written",
            spec.display()
        ))
    })
}

/// Writes a file that is not there yet, whole or not at all.
pub fn write_new(path: &Path, text: &str) -> Result<(), Failure> {
    let _whole = interrupt::begin_writing();
    let failed = |error: &io::Error| unwritten(&path.display().to_string(), error);
    let mut file = File::create_new(path).map_err(|error| failed(&error))?;
    file.write_all(text.as_bytes()).and_then(|()| file.sync_all()).map_err(|error| {
        let _ = fs::remove_file(path);
        failed(&error)
    })
}

/// A place that cannot be written to: of a disk that refuses a failed run, else invalid input.
pub fn unwritten(place: &str, error: &io::Error) -> Failure {
    let message = format!("{place}: {error}{}", advice(error));
    match error.kind() {
        ErrorKind::AlreadyExists
        | ErrorKind::InvalidInput
        | ErrorKind::NotADirectory
        | ErrorKind::NotFound => Failure::Input(message),
        _ => Failure::Run(message),
    }
}
