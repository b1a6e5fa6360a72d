//! TIFF: pictures and tags of two bytes, in which instruments store their heights or how to scale a picture to heights.

use std::fs::File;
use std::io::BufReader;

use tiff::TiffError;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::{Tag, Type};

use super::error::ReadError;
use super::source::{Fields, Source, latin1};
use crate::numeric::stored::NumberType::{self, F32, F64, I8, I16, I32, U8, U16, U32};

/// Bytes of an entry of a directory.
const ENTRY: u64 = 12;
/// The longest text of a tag that is read, bytes.
const MAX_TEXT: usize = 256;
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
    let first = |mut decoder: Decoder<BufReader<File>>| {
        let directory = decoder.ifd_pointer().and_then(|first| decoder.read_directory(first).ok());
        directory.is_some_and(|found| tags.iter().all(|&tag| found.contains(Tag::from_u16_exhaustive(tag))))
    };
    is_tiff(source) && source.reader().is_ok_and(|reader| Decoder::new(reader).is_ok_and(first))
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
        TiffError::IoError(_) => ReadError::Corrupt("is truncated: its TIFF ends too early".to_owned()),
        TiffError::LimitsExceeded => {
            ReadError::Corrupt("claims a larger picture than its TIFF can hold".to_owned())
        }
        _ => ReadError::Corrupt(format!("is a TIFF that cannot be read: {error}")),
    }
}

/// A TIFF and the directories of its pictures.
pub(super) struct Tags {
    decoder: Decoder<BufReader<File>>,
    directories: Vec<tiff::Directory>,
    big_endian: bool,
}

impl Tags {
    pub(super) fn open(source: &Source) -> Result<Self, ReadError> {
        let mut decoder = Decoder::new(source.reader()?).map_err(damaged)?;
        let big_endian = source.begin().starts_with(b"MM");
        let mut directories = Vec::new();
        let mut left = source.length() / ENTRY;
        let mut next = decoder.ifd_pointer();
        while let Some(pointer) = next {
            let entries = Fields { big_endian, ..source.fields(pointer.0, 2)? }.count(0, U16)?;
            // Directories that lie in each other, or in a circle, claim more than the file holds.
            left = left.checked_sub(entries.max(1)).ok_or_else(|| {
                ReadError::Corrupt(
                    "has more entries in the directories of its TIFF than bytes for them".to_owned(),
                )
            })?;
            let directory = decoder.read_directory(pointer).map_err(damaged)?;
            next = directory.next();
            directories.push(directory);
        }
        Ok(Self { decoder, directories, big_endian })
    }

    /// How many pictures there are.
    pub(super) fn count(&self) -> usize {
        self.directories.len()
    }

    /// Bytes of the value of a tag.
    pub(super) fn length(&self, picture: usize, tag: u16) -> Option<u64> {
        let entry = self.directories.get(picture)?.get(Tag::from_u16_exhaustive(tag))?;
        entry.count().checked_mul(match entry.field_type() {
            Type::BYTE | Type::SBYTE | Type::ASCII | Type::UNDEFINED => 1,
            Type::SHORT | Type::SSHORT => 2,
            Type::LONG | Type::SLONG | Type::FLOAT | Type::IFD => 4,
            _ => 8,
        })
    }

    /// The first bytes of the value of a tag, at most `most` of them.
    pub(super) fn bytes(
        &mut self,
        picture: usize,
        tag: u16,
        most: usize,
    ) -> Result<Option<Vec<u8>>, ReadError> {
        let (Some(length), Some(directory)) = (self.length(picture, tag), self.directories.get(picture))
        else {
            return Ok(None);
        };
        let mut bytes = vec![0; usize::try_from(length).map_or(most, |length| length.min(most))];
        let mut tags = self.decoder.read_directory_tags(directory);
        tags.find_tag_bytes(Tag::from_u16_exhaustive(tag), &mut bytes, 0).map_err(damaged)?;
        Ok(Some(bytes))
    }

    pub(super) fn text(&mut self, picture: usize, tag: u16) -> Result<Option<String>, ReadError> {
        Ok(self.bytes(picture, tag, MAX_TEXT)?.map(|bytes| latin1(&bytes)))
    }

    /// The first number of a tag.
    pub(super) fn number(&mut self, picture: usize, tag: u16) -> Result<Option<f64>, ReadError> {
        let entry = self.directories.get(picture).and_then(|all| all.get(Tag::from_u16_exhaustive(tag)));
        let kind = match entry.map(tiff::decoder::ifd::Entry::field_type) {
            Some(Type::BYTE) => U8,
            Some(Type::SBYTE) => I8,
            Some(Type::SHORT) => U16,
            Some(Type::SSHORT) => I16,
            Some(Type::LONG) => U32,
            Some(Type::SLONG) => I32,
            Some(Type::FLOAT) => F32,
            Some(Type::DOUBLE) => F64,
            _ => return Ok(None),
        };
        let bytes = self.bytes(picture, tag, kind.bytes() as usize)?.unwrap_or_default();
        let mut value = [f64::NAN];
        kind.decode(&bytes, self.big_endian, &mut value);
        Ok(Some(value[0]).filter(|value| value.is_finite()))
    }

    /// The size and the numbers of a grey picture of more than 8 bits, of which a program can compute.
    pub(super) fn grey(&mut self, picture: usize) -> Result<Option<([u64; 2], NumberType)>, ReadError> {
        let mut number =
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
    pub(super) fn most_bytes(&mut self, source: &Source, picture: usize) -> Result<u64, ReadError> {
        let is_compressed = self.number(picture, COMPRESSION)?.is_some_and(|method| method != 1.0);
        Ok(if is_compressed { source.length().saturating_mul(MAX_COMPRESSION) } else { source.length() })
    }
}

/// The numbers of a picture of at most `most` bytes, line after line from the first.
pub(super) fn image(source: &Source, picture: usize, most: u64) -> Result<Vec<f64>, ReadError> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = usize::try_from(most).unwrap_or(usize::MAX);
    limits.intermediate_buffer_size = limits.decoding_buffer_size;
    let mut decoder = Decoder::new(source.reader()?).map_err(damaged)?.with_limits(limits);
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
