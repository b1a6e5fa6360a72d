//! A file read by places, never beyond its end: what its header claims costs no memory.

use std::borrow::Cow;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use super::error::{ReadError, too_large};
use crate::numeric::stored::NumberType;
use crate::progress::{Count, PIECE, Progress};

/// Bytes that most formats are identified by.
const BEGIN: u64 = 4096;
/// The most bytes that a packed one may unpack to: the noise of measured heights leaves more than that.
pub(super) const MAX_COMPRESSION: u64 = 200;

/// Units of work that reading all bytes of a file is; the others of the unit are unpacking and sorting its numbers.
pub(super) const OF_BYTES: f64 = 0.2;

/// A file of heights, of which to read a map is a unit of work.
pub(super) struct Source<'a> {
    file: File,
    length: u64,
    begin: Vec<u8>,
    progress: &'a dyn Progress,
    /// Words of a text that its user says to mark missing points.
    pub(super) missing: Vec<String>,
}

impl<'a> Source<'a> {
    pub(super) fn open(path: &Path, progress: &'a dyn Progress) -> Result<Self, ReadError> {
        super::existing(path)?;
        let file = File::open(path)?;
        let length = file.metadata()?.len();
        let mut begin = Vec::new();
        (&file).take(BEGIN).read_to_end(&mut begin)?;
        Ok(Self { file, length, begin, progress, missing: Vec::new() })
    }

    /// Whoever watches.
    pub(super) fn progress(&self) -> &'a dyn Progress {
        self.progress
    }

    /// Counts items that are `work` units together.
    pub(super) fn count(&self, work: f64, items: usize) -> Count<'a> {
        Count::new(self.progress, work, items)
    }

    /// The first bytes, of a short file all.
    pub(super) fn begin(&self) -> &[u8] {
        &self.begin
    }

    /// Bytes of the file.
    pub(super) fn length(&self) -> u64 {
        self.length
    }

    /// Checks that the file has `count` bytes from `start`.
    pub(super) fn check(&self, start: u64, count: u64) -> Result<(), ReadError> {
        match start.checked_add(count).ok_or_else(too_large)? {
            end if end <= self.length => Ok(()),
            end => Err(corrupt!(
                "is truncated: it ends at {} bytes, and its header claims at least {end}",
                self.length
            )),
        }
    }

    /// `count` bytes from `start`.
    pub(super) fn bytes(&self, start: u64, count: u64) -> Result<Vec<u8>, ReadError> {
        self.check(start, count)?;
        let mut bytes = vec![0; usize::try_from(count).map_err(|_| too_large())?];
        let mut file = &self.file;
        file.seek(SeekFrom::Start(start))?;
        let work = OF_BYTES * count as f64 / self.length.max(1) as f64;
        let counted = Count::new(self.progress, work, bytes.len());
        counted.pieces(&mut bytes, |piece| file.read_exact(piece))?;
        Ok(bytes)
    }

    /// The numbers in `bytes`, which are `work` units to decode.
    pub(super) fn values(&self, kind: NumberType, big_endian: bool, bytes: &[u8], work: f64) -> Vec<f64> {
        let mut values = vec![0.0; bytes.len() / kind.bytes() as usize];
        let mut count = self.count(work, values.len());
        decode(kind, big_endian, bytes, &mut values, &mut count);
        count.end();
        values
    }

    /// All bytes.
    pub(super) fn all(&self) -> Result<Vec<u8>, ReadError> {
        self.bytes(0, self.length)
    }

    /// At most `most` bytes from `start`, fewer where the file ends.
    pub(super) fn at_most(&self, start: u64, most: u64) -> Result<Vec<u8>, ReadError> {
        self.bytes(start, most.min(self.length.saturating_sub(start)))
    }

    /// `count` bytes of a header from `start`, their numbers with the least significant byte first.
    pub(super) fn fields(&self, start: u64, count: u64) -> Result<Fields, ReadError> {
        Ok(Fields { bytes: self.bytes(start, count)?, big_endian: false })
    }

    /// The file from its first byte, for a library that reads it.
    pub(super) fn reader(&self) -> Result<BufReader<File>, ReadError> {
        let mut file = self.file.try_clone()?;
        file.seek(SeekFrom::Start(0))?;
        Ok(BufReader::new(file))
    }
}

/// Decodes as many numbers as `out` holds, counted.
pub(super) fn decode(kind: NumberType, big_endian: bool, bytes: &[u8], out: &mut [f64], count: &mut Count) {
    for (out, bytes) in out.chunks_mut(PIECE).zip(bytes.chunks(PIECE * kind.bytes() as usize)) {
        kind.decode(bytes, big_endian, out);
        count.add(out.len());
    }
}

/// Bytes of a header: numbers and texts at given places.
#[derive(Debug)]
pub(super) struct Fields {
    pub(super) bytes: Vec<u8>,
    /// Whether the most significant byte of a number stands first.
    pub(super) big_endian: bool,
}

impl Fields {
    fn slice(&self, at: usize, count: usize) -> Result<&[u8], ReadError> {
        let end = || corrupt!("is truncated: its header ends too early");
        self.bytes.get(at..).and_then(|rest| rest.get(..count)).ok_or_else(end)
    }

    /// The number at a byte.
    pub(super) fn number(&self, at: usize, kind: NumberType) -> Result<f64, ReadError> {
        let mut value = [0.0];
        kind.decode(self.slice(at, kind.bytes() as usize)?, self.big_endian, &mut value);
        Ok(value[0])
    }

    /// A number that counts: whole, not negative.
    pub(super) fn count(&self, at: usize, kind: NumberType) -> Result<u64, ReadError> {
        let value = self.number(at, kind)?;
        if value < 0.0 {
            return Err(corrupt!("has a count of {value} in its header; allowed: at least 0"));
        }
        Ok(value as u64)
    }

    /// A text of `count` bytes in Latin-1, up to its first zero byte.
    pub(super) fn text(&self, at: usize, count: usize) -> Result<String, ReadError> {
        Ok(latin1(self.slice(at, count)?))
    }
}

/// A text in Latin-1 up to its first zero byte, without spaces around it.
pub(super) fn latin1(bytes: &[u8]) -> String {
    let bytes = bytes.split(|&byte| byte == 0).next().unwrap_or_default();
    bytes.iter().map(|&byte| char::from(byte)).collect::<String>().trim().to_owned()
}

/// A text in UTF-8, in UTF-16 with its mark, or in Latin-1 as some programs write µ; `count` is of its bytes.
pub(super) fn text(bytes: Vec<u8>, mut count: Count) -> String {
    let is_big = bytes.starts_with(b"\xfe\xff");
    if is_big || bytes.starts_with(b"\xff\xfe") {
        let (pairs, _) = bytes.as_chunks::<2>();
        let unit = if is_big { u16::from_be_bytes } else { u16::from_le_bytes };
        let units = pairs.iter().map(|&pair| unit(pair));
        count.end();
        return char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
    }
    let text = String::from_utf8(bytes).unwrap_or_else(|error| {
        let mut text = String::with_capacity(error.as_bytes().len());
        for piece in error.as_bytes().chunks(PIECE) {
            text.extend(piece.iter().map(|&byte| char::from(byte)));
            count.add(piece.len());
        }
        text
    });
    count.end();
    text
}

/// Checks that measured heights of `unpacked` bytes may have been packed into `packed`; `what` holds them.
pub(super) fn check_packed(what: &str, packed: u64, unpacked: u64) -> Result<(), ReadError> {
    /// Bytes of heights that are read however far they were packed.
    const SMALL: u64 = 8 << 20;
    if unpacked > SMALL && unpacked / MAX_COMPRESSION > packed {
        return Err(corrupt!(
            "holds no measured heights: {what} unpacks from {packed} to {unpacked} bytes; allowed: at most {MAX_COMPRESSION} times as \
             many, as heights have noise"
        ));
    }
    Ok(())
}

/// A text in UTF-8, whatever is none of it replaced; `count` is of its bytes.
pub(super) fn lossy<'a>(bytes: &'a [u8], mut count: Count) -> Cow<'a, str> {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => {
            let mut text = String::with_capacity(bytes.len());
            for chunk in bytes.utf8_chunks() {
                text.push_str(chunk.valid());
                if !chunk.invalid().is_empty() {
                    text.push(char::REPLACEMENT_CHARACTER);
                }
                count.add(chunk.valid().len() + chunk.invalid().len());
            }
            Cow::Owned(text)
        }
    };
    count.end();
    text
}

/// Reads what is left, at most `most` bytes, into `bytes`, of which it has none; counted.
pub(super) fn read_counted(
    mut from: impl Read,
    mut bytes: Vec<u8>,
    most: u64,
    count: &mut Count,
) -> std::io::Result<Vec<u8>> {
    loop {
        let piece = (most - bytes.len() as u64).min(PIECE as u64);
        match (&mut from).take(piece).read_to_end(&mut bytes)? {
            0 => return Ok(bytes),
            length => count.add(length),
        }
    }
}

/// Unpacks `count` bytes of a zlib stream.
pub(super) fn inflated(packed: &[u8], count: u64, counted: &mut Count) -> Result<Vec<u8>, ReadError> {
    let corrupt = |found: &dyn std::fmt::Display| {
        corrupt!("is damaged: {found} in {} packed bytes that should hold {count}", packed.len())
    };
    // The caller has checked the count.
    let bytes = Vec::with_capacity(usize::try_from(count + 1).map_err(|_| too_large())?);
    let decoder = flate2::read::ZlibDecoder::new(packed);
    let bytes = read_counted(decoder, bytes, count + 1, counted).map_err(|error| corrupt(&error))?;
    if bytes.len() as u64 != count {
        return Err(corrupt(&format!("{} bytes", bytes.len())));
    }
    Ok(bytes)
}
