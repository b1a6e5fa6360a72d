//! Refusing input, for people: file, line, key, what was found, what is allowed.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

use asperity::legible;
use indexmap::IndexMap;
use toml::de::{DeTable, DeValue};

use super::file::InMemory;
use crate::remedy::FrontEnd;

/// What errors call a spec in memory.
const IN_MEMORY: &str = "dictionary";

/// Input that the program does not run on, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct InputError {
    file: PathBuf,
    place: Place,
    message: String,
}

/// Where the invalid input is.
#[derive(Debug, Clone, PartialEq)]
enum Place {
    /// In a file as a whole.
    File,
    /// In a line of a spec.
    Line { line: usize, key: Option<String>, text: String },
    /// In an argument of the command line, as it was typed.
    Argument(String),
}

impl InputError {
    /// An error about a file, without a line.
    pub fn file(file: &Path, message: impl fmt::Display) -> Self {
        Self { file: file.to_owned(), place: Place::File, message: message.to_string() }
    }

    /// What was found and what is allowed, without the place.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// The error; without a line of a spec in memory, which nobody has written.
    pub fn without_line(&self) -> String {
        let message = legible(&self.message, 2000);
        match self.key() {
            _ if !self.file.ends_with(IN_MEMORY) => self.to_string(),
            Some(key) => format!("{}: {message}", legible(key, 200)),
            None => message.into(),
        }
    }

    /// The dotted key of the spec that it is about; `None` where it is about no key.
    pub fn key(&self) -> Option<&str> {
        match &self.place {
            Place::Line { key, .. } => key.as_deref(),
            Place::File | Place::Argument(_) => None,
        }
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { file, place, message } = self;
        let message = legible(message, 2000);
        match place {
            Place::File => write!(f, "{}: {message}", file.display()),
            Place::Line { line, key, text } => {
                write!(f, "{}, line {line}", file.display())?;
                if let Some(key) = key {
                    write!(f, ", {}", legible(key, 200))?;
                }
                write!(f, ": {message}\n{line:>6} | {}", legible(text, 300))
            }
            // A message about a file begins with its name.
            Place::Argument(argument) if message.starts_with(argument) => f.write_str(&message),
            Place::Argument(argument) => write!(f, "{argument}: {message}"),
        }
    }
}

impl std::error::Error for InputError {}

/// A spec's text and where it is from.
#[derive(Debug, Clone)]
pub struct Source {
    pub path: PathBuf,
    pub text: String,
    is_in_memory: bool,
    /// For a spec made from the command line, the argument that each line stands for.
    arguments: Vec<String>,
    /// What is in memory, by the path that the spec has for it.
    in_memory: IndexMap<PathBuf, InMemory>,
    /// The folder that its files must lie in.
    confined: Option<PathBuf>,
    /// Where its errors are read.
    front_end: FrontEnd,
}

impl Source {
    /// A spec that was read from a file.
    pub fn file(path: &Path, text: String) -> Self {
        Self {
            path: path.to_owned(),
            text,
            is_in_memory: false,
            arguments: Vec::new(),
            in_memory: IndexMap::new(),
            confined: None,
            front_end: FrontEnd::Spec,
        }
    }

    /// A spec made from the command line, whose paths are relative to the working directory. Each line comes with the
    /// argument it stands for, which an error cites as it was typed.
    pub fn command_line(lines: Vec<(String, String)>) -> Self {
        let (lines, arguments): (Vec<_>, Vec<_>) = lines.into_iter().unzip();
        let source = Self::file(Path::new("(command line)"), lines.join("\n") + "\n");
        Self { arguments, front_end: FrontEnd::Terminal, ..source }
    }

    /// The same, whose messages are read in another front end.
    #[must_use]
    pub fn read_in(self, front_end: FrontEnd) -> Self {
        Self { front_end, ..self }
    }

    /// Where messages about it are read.
    pub fn front_end(&self) -> FrontEnd {
        self.front_end
    }

    /// A spec that a program holds, without a file; its paths are relative to `folder`.
    pub fn in_memory(folder: &Path, text: String) -> Self {
        Self { is_in_memory: true, ..Self::file(&folder.join(IN_MEMORY), text) }
    }

    /// Another spec in its place, with the same files.
    #[must_use]
    pub fn with_text(&self, text: String) -> Self {
        Self { text, arguments: Vec::new(), ..self.clone() }
    }

    /// The same spec, whose files must lie in `folder` (an absolute path without links).
    #[must_use]
    pub fn confined_to(self, folder: &Path) -> Self {
        Self { confined: Some(folder.to_owned()), ..self }
    }

    /// Whether it may read the file at `path`: links do not lead out of the folder that its files must lie in.
    pub fn may_read(&self, path: &Path) -> bool {
        self.confined
            .as_ref()
            .is_none_or(|folder| std::fs::canonicalize(path).is_ok_and(|whole| whole.starts_with(folder)))
    }

    /// Whether it has no file of its own.
    pub fn is_in_memory(&self) -> bool {
        self.is_in_memory
    }

    /// The same spec with surfaces in memory, each by the path that the spec has for it.
    #[must_use]
    pub fn with_in_memory(self, in_memory: IndexMap<PathBuf, InMemory>) -> Self {
        Self { in_memory, ..self }
    }

    /// What is in memory by this path; `None` of a file.
    pub fn content_in_memory(&self, path: &Path) -> Option<&InMemory> {
        self.in_memory.get(path)
    }

    /// Error at `span` (bytes of the text).
    pub fn error_at(&self, span: Range<usize>, message: impl fmt::Display) -> InputError {
        let start = span.start.min(self.text.len());
        // A span may end up inside a character only if the parser is wrong; then line 1 is named.
        let before = self.text.get(..start).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        let place = match self.arguments.get(line - 1) {
            Some(argument) => Place::Argument(argument.clone()),
            None => Place::Line {
                line,
                key: DeTable::parse(&self.text).ok().and_then(|table| key_at(table.get_ref(), &span)),
                text: self.text.lines().nth(line - 1).unwrap_or_default().trim_end().to_owned(),
            },
        };
        let message = self.front_end.text(&message.to_string());
        InputError { file: self.path.clone(), place, message }
    }

    /// Position and text of the value at a path of keys.
    pub fn value_at(&self, path: &[&str]) -> Option<(Range<usize>, &str)> {
        let document = DeTable::parse(&self.text).ok()?;
        let (last, tables) = path.split_last()?;
        let table =
            tables.iter().try_fold(document.get_ref(), |table, key| match table.get(*key)?.get_ref() {
                DeValue::Table(inner) => Some(inner),
                _ => None,
            })?;
        let span = table.get(*last)?.span();
        Some((span.clone(), self.text.get(span)?))
    }

    /// Refuses the spec as its parser did.
    pub fn parse_error(&self, error: &toml::de::Error) -> InputError {
        let mut message = plain_message(error.message());
        let line = |span: Range<usize>| {
            let begin = self.text.get(..span.start)?.rfind('\n').map_or(0, |end| end + 1);
            self.text.get(begin..)?.lines().next()
        };
        if ["escape", "unicode"].iter().any(|word| error.message().contains(word))
            && error.span().and_then(line).is_some_and(|line| line.contains('\\'))
        {
            message = format!(
                "found a backslash in double quotes that begins no escape ({message}); allowed: single quotes, as in \
                 'C:\\maps\\a.npy', or forward slashes, as in \"C:/maps/a.npy\""
            );
        }
        match error.span() {
            Some(span) => self.error_at(span, message),
            None => InputError::file(&self.path, message),
        }
    }
}

/// Keys of earlier versions, and what to do instead.
const GONE: [(&str, &str); 6] = [
    ("tolerance", "every point of a curve is exact; leave it out"),
    (
        "tables",
        "tables are CSV, which pandas turns into Parquet by `pd.read_csv(\"curves.csv\").to_parquet(\"curves.parquet\")`; leave it out",
    ),
    ("coverage", EVIDENCE),
    ("precision", EVIDENCE),
    ("solver-validation", EVIDENCE),
    ("stability", EVIDENCE),
];

const EVIDENCE: &str =
    "it is a program with its own numbers; run it by its name in [evidence], such as `name = \"stability\"`";

/// The message of a key of an earlier version.
pub fn gone(key: &str) -> Option<String> {
    let (_, instead) = GONE.into_iter().find(|(gone, _)| *gone == key)?;
    Some(format!("found the key `{key}`, which is gone: {instead}"))
}

/// Message of the parser as what was found and what is allowed.
pub fn plain_message(message: &str) -> String {
    let plain = match message {
        "wanted string or table" => {
            Some("found neither a name nor a table; allowed: a name in quotes, or a table")
        }
        "integer number overflowed" => {
            Some("found a number of too many digits; allowed: a whole number up to 18446744073709551615")
        }
        "floating-point number overflowed" => {
            Some("found a number that is too large; allowed: at most 1e308 in magnitude")
        }
        "duplicate key" => Some("found this key twice; allowed: once"),
        "wanted exactly 1 element, more than 1 element" => {
            Some("found several keys; allowed: exactly one of them")
        }
        "wanted exactly 1 element, found 0 elements" => {
            Some("found an empty table; allowed: one key and its value")
        }
        "invalid type: unit variant, expected newtype variant" => {
            Some("found only a name; allowed: a table with the name as its key and the parameters in it")
        }
        _ => None,
    };
    if let Some(plain) = plain {
        return plain.to_owned();
    }
    if let Some(field) = message.strip_prefix("missing field ") {
        return format!("found no {field}, which is needed");
    }
    let unknown = message.strip_prefix("unknown field `").and_then(|rest| rest.split('`').next());
    if let Some(message) = unknown.and_then(gone) {
        return message;
    }
    for (begin, found) in [
        ("unknown field ", "found the key "),
        ("unknown variant ", "found "),
        ("invalid type: ", "found "),
        ("invalid value: ", "found "),
    ] {
        if let Some((what, expected)) =
            message.strip_prefix(begin).and_then(|rest| rest.split_once(", expected "))
        {
            let expected = expected.strip_prefix("one of ").unwrap_or(expected);
            return format!("{found}{}; allowed: {}", plain_value(what), plain_kind(expected));
        }
    }
    message.to_owned()
}

/// A value as the parser calls it, in the words of a spec: "floating point `2.5`" is 2.5.
fn plain_value(what: &str) -> &str {
    for kind in ["integer `", "floating point `", "boolean `"] {
        if let Some(value) = what.strip_prefix(kind) {
            return value.split('`').next().unwrap_or(value);
        }
    }
    match what {
        "sequence" => "a list",
        "map" => "a table",
        text => text.strip_prefix("string ").unwrap_or(text),
    }
}

/// What the parser expects, without names of types.
fn plain_kind(expected: &str) -> &str {
    const INTEGERS: [&str; 10] = ["u8", "u16", "u32", "u64", "usize", "i8", "i16", "i32", "i64", "isize"];
    match expected {
        "a sequence" => "a list in square brackets",
        "a map" | "map" => "a table",
        "a string" | "string" => "a text in quotes",
        "path string" => "the name of a file in quotes",
        "a boolean" => "true or false",
        "f64" | "f32" => "a number without quotes",
        integer if INTEGERS.contains(&integer) => "a whole number such as 1000",
        structure if structure.starts_with("struct ") || structure.starts_with("tuple ") => "a table of keys",
        other => other,
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
