//! Refusing input, for people: file, line, key, what was found, what is allowed.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};

/// Input that the program does not run on, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal {
    file: PathBuf,
    place: Option<Place>,
    message: String,
}

/// Where in a spec.
#[derive(Debug, Clone, PartialEq)]
struct Place {
    line: usize,
    key: Option<String>,
    text: String,
}

impl Refusal {
    /// A file that is refused as a whole.
    pub fn file(file: &Path, message: impl fmt::Display) -> Self {
        Self { file: file.to_owned(), place: None, message: message.to_string() }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if let Some(place) = &self.place {
            write!(f, ", line {}", place.line)?;
            if let Some(key) = &place.key {
                write!(f, ", {key}")?;
            }
        }
        write!(f, ": {}", self.message)?;
        if let Some(place) = &self.place {
            write!(f, "\n{:>6} | {}", place.line, place.text)?;
        }
        Ok(())
    }
}

impl std::error::Error for Refusal {}

const COMMAND_LINE: &str = "(command line)";

/// A spec's text and where it is from.
#[derive(Debug, Clone)]
pub struct Source {
    /// The file.
    pub path: PathBuf,
    /// Its content.
    pub text: String,
}

impl Source {
    /// Words that the command line made; what they name is relative to the working directory.
    pub fn command_line(text: String) -> Self {
        Self { path: COMMAND_LINE.into(), text }
    }

    /// Whether the command line made it.
    pub fn is_command_line(&self) -> bool {
        self.path.as_os_str() == COMMAND_LINE
    }

    /// Refuses what stands at `span` (bytes of the text).
    pub fn refuse(&self, span: Range<usize>, message: impl fmt::Display) -> Refusal {
        let start = span.start.min(self.text.len());
        // A span may end up inside a character only if the parser is wrong; then line 1 is named.
        let before = self.text.get(..start).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        let text = self.text.lines().nth(line - 1).unwrap_or_default().trim_end().to_owned();
        let key = DeTable::parse(&self.text).ok().and_then(|table| key_at(table.get_ref(), &span));
        Refusal {
            file: self.path.clone(),
            place: Some(Place { line, key, text }),
            message: message.to_string(),
        }
    }

    /// Refuses the spec as its parser did.
    pub fn refuse_as(&self, error: &toml::de::Error) -> Refusal {
        match error.span() {
            Some(span) => self.refuse(span, error.message()),
            None => Refusal::file(&self.path, error.message()),
        }
    }
}

/// The dotted key of the innermost entry of `table` that `span` points into.
fn key_at(table: &DeTable, span: &Range<usize>) -> Option<String> {
    let holds = |outer: Range<usize>| outer.start <= span.start && span.end <= outer.end;
    table.iter().find_map(|(key, value)| {
        let name = key.get_ref();
        let inner = match value.get_ref() {
            DeValue::Table(inner) => key_at(inner, span),
            _ => None,
        };
        match inner {
            Some(inner) => Some(format!("{name}.{inner}")),
            None => (holds(key.span()) || holds(value.span())).then(|| name.to_string()),
        }
    })
}
