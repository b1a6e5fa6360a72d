//! What the program prints.

use std::fmt::Arguments;
use std::io::{ErrorKind, Write};
use std::sync::OnceLock;

use super::arguments::RunOptions;

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

/// Prints a line on standard error.
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
