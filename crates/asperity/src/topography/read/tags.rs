//! TIFF: pictures and tags of two bytes, in which instruments store their heights or how to scale a picture to heights.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};

use tiff::TiffError;
use tiff::decoder::{Decoder, DecodingResult, Limits};

use super::channel::UNPACKED;
use super::error::ReadError;
use super::source::{Fields, Source, latin1};
use crate::numeric::stored::NumberType::{self, F32, F64, I8, I16, I32, U8, U16, U32};
use crate::progress::Count;

/// Bytes of an entry of a directory.
const ENTRY: u64 = 12;
/// The longest text of a tag that is read, bytes.
const MAX_TEXT: u64 = 256;
/// The most bytes that a compressed one may unpack to: the noise of measured heights leaves more than that.
const MAX_COMPRESSION: u64 = 50;

/// The tags of TIFF itself that are needed.
const BITS: u16 = 258;
const COMPRESSION: u16 = 259;
const PHOTOMETRIC: u16 = 262;
const SAMPLES: u16 = 277;
const SAMPLE_FORMAT: u16 = 339;

pub(super) fn is_tiff(source: &Source) -> bool {
    source.begin().starts_with(b"II*\0") || source.begin().starts_with(b"MM\0*")
}

/// Whether the first directory has all of these tags.
pub(super) fn has(source: &Source, tags: &[u16]) -> bool {
    let first = || Directory::read(source, header(source)?.count(4, U32)?, &mut source.length());
    is_tiff(source) && first().is_ok_and(|(first, _)| tags.iter().all(|tag| first.0.contains_key(tag)))
}

/// Why a TIFF that no instrument wrote is refused.
pub(super) fn refused(source: &Source) -> ReadError {
    let picture = "is a TIFF picture, which holds grey values or colours, no heights; allowed: TIFF of JPK or Park instruments";
    match Tags::open(source) {
        Ok(_) => ReadError::Unsupported(picture.to_owned()),
        Err(error) => error,
    }
}

fn damaged(error: TiffError) -> ReadError {
    match error {
        TiffError::IoError(error) if error.kind() != std::io::ErrorKind::UnexpectedEof => {
            ReadError::Io(error)
        }
        TiffError::IoError(_) => corrupt!("is truncated: its TIFF ends too early"),
        TiffError::LimitsExceeded => {
            corrupt!("claims a larger picture than its TIFF can hold")
        }
        _ => corrupt!("is a TIFF that cannot be read: {error}"),
    }
}

/// The mark of the byte order and the place of the first directory.
fn header(source: &Source) -> Result<Fields, ReadError> {
    Ok(Fields { big_endian: source.begin().starts_with(b"MM"), ..source.fields(0, 8)? })
}

/// The value of a tag.
#[derive(Debug, Clone, Copy)]
struct Entry {
    /// Its number type; `None` of texts, fractions and types that are not known.
    kind: Option<NumberType>,
    /// Bytes of the value.
    length: u64,
    /// The place of its first byte.
    start: u64,
}

/// The tags of a picture.
struct Directory(BTreeMap<u16, Entry>);

impl Directory {
    /// The directory at a byte and the place of the next, which is 0 behind the last. Its bytes are taken from those `left`: directories that
    /// lie in each other, or in a circle, claim more than the file holds.
    fn read(source: &Source, at: u64, left: &mut u64) -> Result<(Self, u64), ReadError> {
        let big_endian = header(source)?.big_endian;
        let fields = |start, count| Ok::<_, ReadError>(Fields { big_endian, ..source.fields(start, count)? });
        let count = fields(at, 2)?.count(0, U16)?;
        let length = count * ENTRY;
        *left = left
            .checked_sub(length.max(ENTRY))
            .ok_or_else(|| corrupt!("has more entries in the directories of its TIFF than bytes for them"))?;
        let directory = fields(at + 2, length + 4)?;
        let mut entries = BTreeMap::new();
        for place in (0..length as usize).step_by(ENTRY as usize) {
            let (kind, bytes) = match directory.count(place + 2, U16)? {
                1 => (Some(U8), 1),
                6 => (Some(I8), 1),
                2 | 7 => (None, 1),
                3 => (Some(U16), 2),
                8 => (Some(I16), 2),
                4 => (Some(U32), 4),
                9 => (Some(I32), 4),
                11 => (Some(F32), 4),
                13 => (None, 4),
                12 => (Some(F64), 8),
                _ => (None, 8),
            };
            let length = directory.count(place + 4, U32)? * bytes;
            // A short value stands in place of the place of a long one.
            let start =
                if length <= 4 { at + 2 + place as u64 + 8 } else { directory.count(place + 8, U32)? };
            entries.entry(directory.count(place, U16)? as u16).or_insert(Entry { kind, length, start });
        }
        Ok((Self(entries), directory.count(length as usize, U32)?))
    }
}

/// A TIFF and the directories of its pictures.
pub(super) struct Tags<'a> {
    source: &'a Source<'a>,
    directories: Vec<Directory>,
    big_endian: bool,
}

impl<'a> Tags<'a> {
    pub(super) fn open(source: &'a Source<'a>) -> Result<Self, ReadError> {
        let header = header(source)?;
        let mut directories = Vec::new();
        let mut left = source.length();
        let mut next = header.count(4, U32)?;
        while next != 0 {
            let (directory, following) = Directory::read(source, next, &mut left)?;
            directories.push(directory);
            next = following;
        }
        Ok(Self { source, directories, big_endian: header.big_endian })
    }

    /// How many pictures there are.
    pub(super) fn count(&self) -> usize {
        self.directories.len()
    }

    fn entry(&self, picture: usize, tag: u16) -> Option<&Entry> {
        self.directories.get(picture)?.0.get(&tag)
    }

    /// Bytes of the value of a tag.
    pub(super) fn length(&self, picture: usize, tag: u16) -> Option<u64> {
        Some(self.entry(picture, tag)?.length)
    }

    /// The first bytes of the value of a tag, at most `most` of them.
    pub(super) fn bytes(&self, picture: usize, tag: u16, most: u64) -> Result<Option<Vec<u8>>, ReadError> {
        let bytes = |entry: &Entry| self.source.bytes(entry.start, entry.length.min(most));
        self.entry(picture, tag).map(bytes).transpose()
    }

    pub(super) fn text(&self, picture: usize, tag: u16) -> Result<Option<String>, ReadError> {
        Ok(self.bytes(picture, tag, MAX_TEXT)?.map(|bytes| latin1(&bytes)))
    }

    /// The first number of a tag.
    pub(super) fn number(&self, picture: usize, tag: u16) -> Result<Option<f64>, ReadError> {
        let Some(kind) = self.entry(picture, tag).and_then(|entry| entry.kind) else { return Ok(None) };
        let bytes = self.bytes(picture, tag, kind.bytes())?.unwrap_or_default();
        let mut value = [f64::NAN];
        kind.decode(&bytes, self.big_endian, &mut value);
        Ok(Some(value[0]).filter(|value| value.is_finite()))
    }

    /// The size and the numbers of a grey picture of more than 8 bits, of which a program can compute.
    pub(super) fn grey(&self, picture: usize) -> Result<Option<([u64; 2], NumberType)>, ReadError> {
        let number =
            |tag: u16, default: f64| Ok::<_, ReadError>(self.number(picture, tag)?.unwrap_or(default));
        let size = [number(256, 0.0)? as u64, number(257, 0.0)? as u64];
        if number(PHOTOMETRIC, 0.0)? != 1.0 || number(SAMPLES, 1.0)? != 1.0 {
            return Ok(None);
        }
        let kind = match (number(BITS, 1.0)? as u64, number(SAMPLE_FORMAT, 1.0)? as u64) {
            (16, 1) => U16,
            (16, 2) => I16,
            (32, 1) => U32,
            (32, 2) => I32,
            (32, 3) => F32,
            (64, 3) => F64,
            _ => return Ok(None),
        };
        Ok(Some((size, kind)))
    }

    /// The most bytes that a picture can unpack to.
    pub(super) fn most_bytes(&self, picture: usize) -> Result<u64, ReadError> {
        let is_compressed = self.number(picture, COMPRESSION)?.is_some_and(|method| method != 1.0);
        let length = self.source.length();
        Ok(if is_compressed { length.saturating_mul(MAX_COMPRESSION) } else { length })
    }

    /// Checks that the file has the bytes of all values of a picture, before a decoder takes memory for them.
    fn check(&self, picture: usize) -> Result<(), ReadError> {
        let entries = self.directories.get(picture).into_iter().flat_map(|directory| directory.0.values());
        entries.into_iter().try_for_each(|entry| self.source.check(entry.start, entry.length))
    }
}

/// A file, the bytes of which are counted as a decoder reads them.
struct Counted<'a> {
    file: BufReader<File>,
    count: Count<'a>,
}

impl Read for Counted<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let length = self.file.read(bytes)?;
        self.count.add(length);
        Ok(length)
    }
}

impl Seek for Counted<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

/// The numbers of a picture of at most `most` bytes, line after line from the first.
pub(super) fn image(source: &Source, picture: usize, most: u64) -> Result<Vec<f64>, ReadError> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = usize::try_from(most).unwrap_or(usize::MAX);
    limits.intermediate_buffer_size = limits.decoding_buffer_size;
    // A decoder begins with the first picture.
    let tags = Tags::open(source)?;
    tags.check(0).and_then(|()| tags.check(picture))?;
    let reader = Counted { file: source.reader()?, count: source.count(UNPACKED, source.length() as usize) };
    let mut decoder = Decoder::new(reader).map_err(damaged)?.with_limits(limits);
    decoder.seek_to_image(picture).map_err(damaged)?;
    macro_rules! numbers {
        ($($variant:ident)*) => {
            match decoder.read_image().map_err(damaged)? {
                $(DecodingResult::$variant(numbers) => Ok(numbers.into_iter().map(|number| number as f64).collect()),)*
DecodingResult::F16(numbers) => Ok(numbers.into_iter().map(f64::from).collect()),
            }
        };
    }
    numbers!(U8 U16 U32 U64 I8 I16 I32 I64 F32 F64)
}
