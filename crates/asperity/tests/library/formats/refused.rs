//! Files that are refused: `refused.txt` holds changes to good ones, each with its error. `RENEW=1 cargo test` writes the errors anew, which a
//! review reads.
//!
//! A change is `"OLD" -> "NEW"` of all places, `AT: "NEW"` or `AT: TYPE NUMBER` of the bytes from a place on, `end AT` of what follows a place,
//! or `"BYTES"` of all there is; several stand between `&`. `as it is` changes nothing.

use std::fmt::{Debug, Display};
use std::ops::Range;
use std::path::Path;

use super::instrument::Number;
use super::*;

/// What is changed, and how a file is made of it and read.
pub struct Good {
    pub name: &'static str,
    pub part: Vec<u8>,
    pub file: fn(Vec<u8>) -> Vec<u8>,
    pub error: fn(&[u8]) -> String,
    /// Lengths at which the file is said to be truncated.
    pub truncated: Range<usize>,
}

impl Good {
    /// A file of a map, any byte of which may be changed.
    pub fn whole(name: &'static str, part: impl Into<Vec<u8>>) -> Self {
        let error = |bytes: &[u8]| described(&refused(bytes));
        Self { name, part: part.into(), file: |part| part, error, truncated: 0..0 }
    }

    fn all() -> Vec<Self> {
        let formats = [
            al3d::good(),
            bcr::good(),
            datx::good(),
            exports::good(),
            gsf::good(),
            gwy::good(),
            ibw::good(),
            jpk::good(),
            metropro::good(),
            nanoscope::good(),
            nid::good(),
            opd::good(),
            park::good(),
            plu::good(),
            sdf::good(),
            sur::good(),
            text::good(),
            tiff::good(),
            vk::good(),
            written::good(),
            x3p::good(),
        ];
        formats.into_iter().flatten().chain(crate::npy::good()).chain(crate::lists::good()).collect()
    }
}

/// The kind of an error and its message.
pub fn described(error: &(impl Debug + Display)) -> String {
    let fields = format!("{error:?}");
    let kind = fields.split(|letter: char| !letter.is_alphanumeric()).next().unwrap();
    format!("{kind}: {error}").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The bytes that a word in quotes stands for.
fn unquoted(word: &str) -> Vec<u8> {
    let inner = word.strip_prefix('"').and_then(|word| word.strip_suffix('"'));
    let mut letters = inner.unwrap_or_else(|| panic!("no quotes: {word}")).bytes();
    let mut bytes = Vec::new();
    while let Some(letter) = letters.next() {
        bytes.push(match letter {
            b'\\' => match letters.next().unwrap() {
                b'n' => b'\n',
                b'r' => b'\r',
                b't' => b'\t',
                b'0' => 0,
                b'x' => {
                    let digits = [letters.next().unwrap(), letters.next().unwrap()];
                    u8::from_str_radix(std::str::from_utf8(&digits).unwrap(), 16).unwrap()
                }
                other => other,
            },
            letter => letter,
        });
    }
    bytes
}

/// Bytes in quotes, or of a number behind its type.
fn value(text: &str) -> Vec<u8> {
    let Some((kind, number)) = text.split_once(' ').filter(|_| !text.starts_with('"')) else {
        return unquoted(text);
    };
    let (number, is_big): (f64, bool) = (number.parse().unwrap(), kind.ends_with("be"));
    match kind.trim_end_matches("be") {
        "u16" => u16::of(number).bytes(is_big),
        "u32" => u32::of(number).bytes(is_big),
        "i32" => i32::of(number).bytes(is_big),
        "f32" => f32::of(number).bytes(is_big),
        "f64" => f64::of(number).bytes(is_big),
        _ => panic!("{kind} is no type"),
    }
}

fn replaced(bytes: &[u8], old: &[u8], new: &[u8]) -> Vec<u8> {
    let place = bytes.windows(old.len()).position(|found| found == old);
    let Some(place) = place else { return bytes.to_vec() };
    [&bytes[..place], new, &replaced(&bytes[place + old.len()..], old, new)].concat()
}

fn changed(mut part: Vec<u8>, changes: &str) -> Vec<u8> {
    for change in changes.split(" & ") {
        let at = change.split_once(": ").and_then(|(at, new)| Some((at.parse::<usize>().ok()?, value(new))));
        part = if change == "as it is" {
            part
        } else if let Some(end) = change.strip_prefix("end ") {
            part[..end.parse().unwrap()].to_vec()
        } else if let Some((at, new)) = at {
            part.splice(at..at + new.len(), new);
            part
        } else if let Some((old, new)) = change.split_once(" -> ") {
            let new = replaced(&part, &unquoted(old), &unquoted(new));
            assert_ne!(new, part, "{change} changes nothing");
            new
        } else {
            unquoted(change)
        };
    }
    part
}

#[test]
fn bad_files_are_refused() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/library/refused.txt");
    let text = std::fs::read_to_string(&path).unwrap();
    let all = Good::all();
    let (mut good, mut used) = (&all[0], Vec::new());
    let mut found = String::new();
    for line in text.lines().filter(|line| !line.starts_with("> ")) {
        found += &format!("{line}\n");
        if let Some(name) = line.strip_prefix("=== ") {
            good = all.iter().find(|good| good.name == name).unwrap_or_else(|| panic!("{name} is no file"));
            used.push(name);
        } else if !line.is_empty() && !line.starts_with('#') {
            let bytes = (good.file)(changed(good.part.clone(), line));
            found += &format!("> {}\n", (good.error)(&bytes));
        }
    }
    if std::env::var_os("RENEW").is_some() {
        return std::fs::write(&path, &found).unwrap();
    }
    for (line, (found, known)) in found.lines().zip(text.lines()).enumerate() {
        assert_eq!(found, known, "refused.txt, line {}", line + 1);
    }
    assert_eq!(found.lines().count(), text.lines().count());
    assert!(all.iter().all(|good| !good.truncated.is_empty() || used.contains(&good.name)));
}

#[test]
fn a_file_that_ends_too_early_is_said_to_be_truncated() {
    for good in Good::all() {
        let whole = (good.file)(good.part);
        let (_folder, path) = file(&whole);
        for length in (0..whole.len()).rev().step_by(whole.len().div_ceil(1000).max(1)) {
            if good.truncated.contains(&length) {
                let error = (good.error)(&whole[..length]);
                assert!(
                    error.starts_with("Corrupt: is truncated"),
                    "{} of {length} bytes: {error}",
                    good.name
                );
            } else {
                // It is read, or refused otherwise.
                std::fs::File::options().write(true).open(&path).unwrap().set_len(length as u64).unwrap();
                let _ = metadata(&path).and_then(|_| height_map(&path, IN_NM));
            }
        }
    }
}
