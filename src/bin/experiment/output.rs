//! What the program prints, and single files that it writes beside reports.

use std::fmt::Arguments;
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::sync::OnceLock;
use std::{fs, io};

use asperity_contact_framework::kept::advice;

use crate::arguments::RunOptions;
use crate::{Failure, interrupt};

/// Why a line was not printed.
static LOST: OnceLock<String> = OnceLock::new();

/// Prints a line. A closed pipe, as after `head`, is no error; others are remembered for [`lost`].
pub fn print(line: Arguments) {
    if let Err(error) = writeln!(std::io::stdout(), "{line}")
        && error.kind() != ErrorKind::BrokenPipe
    {
        let _ = LOST.set(error.to_string());
    }
}

/// Prints a text of many lines.
pub fn print_text(text: &str) {
    print(format_args!("{}", text.trim_end()));
}

pub fn print_error(line: Arguments) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Prints a line on what is done, unless that is not wanted.
pub fn say(options: &RunOptions, line: &str) {
    if !options.is_quiet() {
        print(format_args!("{line}"));
    }
}

/// Why something that should have been printed was not.
pub fn lost() -> Option<&'static str> {
    LOST.get().map(String::as_str)
}

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
