//! Surface data files (ISO 25178-71), text and binary: versions ISO-1.0, ISO-2.0 and their predecessor BCR-1.0.
//!
//! Scales are in metres. A missing point is BAD or NaN in a text, the smallest number of the type in ISO-1.0 and
//! ISO-2.0, and the largest in BCR-1.0 and for the unsigned types, which only BCR-1.0 defines. Compression and check
//! sums, which only BCR-1.0 defines, are not supported.

use std::borrow::Cow;

use super::content::{Measured, Metadata, transposed};
use super::error::{ReadError, shortened, too_large};
use super::source::{OF_BYTES, Source};
use super::{Format, Reader, source};
use crate::numeric::is_positive;
use crate::numeric::stored::NumberType;
use crate::progress::Count;

const NAME: &str = "an SDF file";

pub(super) const FORMAT: Format = Format {
    name: NAME,
    endings: &["sdf"],
    is: |source| is_sdf(source.begin()),
    read: Reader::Map { metadata, measured },
};

const FIELDS: &str = "NumPoints, NumProfiles, Xscale, Yscale, Zscale, Compression, DataType, CheckType";
const VERSIONS: [&[u8]; 3] = [b"ISO-1.0", b"ISO-2.0", b"BCR-1.0"];
/// Names of the codes of `DataType` in BCR-1.0.
const TYPES: [&str; 8] = ["UCHAR", "UINTEGER", "ULONGINT", "FLOAT", "CHAR", "INTEGER", "LONGINT", "DOUBLE"];
/// Bytes of the header of a binary file with two-byte counts.
const HEAD: usize = 81;

/// Whether a file begins as a surface data file: a or b, three capitals, a hyphen, two digits.
fn is_sdf(begin: &[u8]) -> bool {
    matches!(
        begin,
        [
            b'a' | b'b' | b'A' | b'B',
            b'A'..=b'Z',
            b'A'..=b'Z',
            b'A'..=b'Z',
            b'-',
            b'0'..=b'9',
            b'.',
            b'0'..=b'9',
            ..
        ]
    )
}

/// The type of a `DataType`.
fn stored(code: u8) -> Result<NumberType, ReadError> {
    use NumberType::{F32, F64, I8, I16, I32, U8, U16, U32};
    [U8, U16, U32, F32, I8, I16, I32, F64]
        .get(usize::from(code))
        .copied()
        .ok_or_else(|| unsupported!("holds numbers of the DataType {code}; allowed: 0 to 7"))
}

/// Whether a number marks a missing point: the smallest number of the type, or the largest if `greatest` or if the type
/// is unsigned.
fn marks_missing(stored: NumberType, value: f64, greatest: bool) -> bool {
    let [least, most] = stored.range();
    if stored.is_integer() {
        value == if greatest || least == 0.0 { most } else { least }
    } else {
        // A text may print the extreme number with fewer digits.
        value.abs() > 0.99 * most
    }
}

/// The header fields.
struct Fields {
    points: u64,
    profiles: u64,
    x_scale: f64,
    y_scale: f64,
    z_scale: f64,
    compression: u8,
    data_type: u8,
    check_type: u8,
}

/// Validated header fields.
struct Checked {
    metadata: Metadata,
    count: u64,
    z_scale: f64,
    stored: NumberType,
    /// Whether the largest number of a signed type marks a missing point.
    greatest: bool,
}

/// The header, checked against the length of the file.
///
/// # Errors
/// See [`ReadError`].
pub(super) fn metadata(source: &Source) -> Result<Metadata, ReadError> {
    Ok(open(source)?.0.metadata)
}

/// Reads a map in metres.
///
/// # Errors
/// See [`ReadError`].
pub(super) fn measured(source: &Source) -> Result<Measured, ReadError> {
    /// Units of work of the numbers before their scale and their order.
    const NUMBERS: f64 = 0.6;
    let (checked, body) = open(source)?;
    let Checked { metadata, count, z_scale, stored, greatest } = checked;
    let work = NUMBERS - OF_BYTES;
    let mut values = match body {
        Body::Text(text) => text_values(&text, count, source.count(work, text.len()))?,
        // `open` has checked the number of bytes.
        Body::Binary { begin } => {
            source.values(stored, false, &source.bytes(begin, count * stored.bytes())?, work)
        }
    };
    if values.len() as u64 != count {
        return Err(truncated(count, &format!("{} numbers", values.len())));
    }
    let [scaled, sorted] = [0.5, 0.5].map(|share| source.count(share * (1.0 - NUMBERS), values.len()));
    scaled.pieces(&mut values, |piece| {
        for value in piece {
            *value = if marks_missing(stored, *value, greatest) { f64::NAN } else { *value * z_scale };
        }
        Ok::<_, ReadError>(())
    })?;
    let heights = transposed(&values, metadata.points[0], sorted);
    Ok(Measured { metadata, heights, scale: 1.0, offset: 0.0, precision: stored.scaled_precision() })
}

/// The data, not yet read.
enum Body {
    Text(String),
    Binary { begin: u64 },
}

fn open(source: &Source) -> Result<(Checked, Body), ReadError> {
    let begin = source.begin();
    let (Some(kind), Some(version)) = (begin.first(), begin.get(1..8)) else {
        return Err(mismatch!("is not an SDF file: it is too short"));
    };
    if !VERSIONS.contains(&version) {
        return Err(unsupported!(
            "is an SDF file of the version {}; allowed: ISO-1.0, ISO-2.0, BCR-1.0",
            version.escape_ascii()
        ));
    }
    let greatest = version == b"BCR-1.0";
    if kind.eq_ignore_ascii_case(&b'a') {
        let bytes = source.all()?;
        let count = || source.count(0.0, bytes.len());
        let text = source::lossy(&bytes, count());
        let text = without_comments(&text, count());
        let mut parts = text.splitn(3, '*');
        let (Some(header), Some(numbers)) = (parts.next(), parts.next()) else {
            return Err(corrupt!("is truncated: no * ends its header"));
        };
        let checked = Fields::of_text(header)?.check(greatest)?;
        // The shortest number and its separator.
        if checked.count > numbers.len() as u64 / 2 + 1 {
            return Err(truncated(checked.count, &format!("{} characters", numbers.len())));
        }
        return Ok((checked, Body::Text(numbers.to_owned())));
    }
    let wide = version == b"ISO-2.0";
    let head_length = HEAD as u64 + if wide { 4 } else { 0 };
    let fields =
        Fields::of_binary(begin, wide).ok_or_else(|| corrupt!("is truncated: it ends within its header"))?;
    let checked = fields.check(greatest)?;
    let body = source.length().saturating_sub(head_length);
    let bytes = checked.count.checked_mul(checked.stored.bytes()).filter(|&bytes| bytes <= body);
    let bytes = bytes.ok_or_else(|| truncated(checked.count, &format!("{body} bytes")))?;
    // Olympus microscopes write eight undocumented bytes before the numbers, two counts of 5 and 1.
    let extra = if version == b"ISO-1.0" && body == bytes + 8 && is_olympus(begin) { 8 } else { 0 };
    Ok((checked, Body::Binary { begin: head_length + extra }))
}

/// Removes the comments of BCR-1.0, which begin with a semicolon; `count` is of the bytes.
fn without_comments<'a>(text: &'a str, mut count: Count) -> Cow<'a, str> {
    if !text.contains(';') {
        count.end();
        return Cow::Borrowed(text);
    }
    let bare = text.lines().map(|line| {
        count.add(line.len() + 1);
        line.split(';').next().unwrap_or_default()
    });
    Cow::Owned(bare.flat_map(|line| [line, "\n"]).collect())
}

fn is_olympus(begin: &[u8]) -> bool {
    begin.get(HEAD..HEAD + 8) == Some(&[5, 0, 0, 0, 1, 0, 0, 0])
}

fn truncated(count: u64, found: &str) -> ReadError {
    corrupt!("is truncated: its header says {count} points, {found} are there")
}

impl Fields {
    fn of_binary(begin: &[u8], wide: bool) -> Option<Self> {
        let mut rest = begin.get(42..)?;
        let mut count = || {
            if wide {
                rest.split_off(..4)?.try_into().ok().map(u32::from_le_bytes).map(u64::from)
            } else {
                rest.split_off(..2)?.try_into().ok().map(u16::from_le_bytes).map(u64::from)
            }
        };
        let (points, profiles) = (count()?, count()?);
        let mut scale = || rest.split_off(..8)?.try_into().ok().map(f64::from_le_bytes);
        let (x_scale, y_scale, z_scale, _resolution) = (scale()?, scale()?, scale()?, scale()?);
        let &[compression, data_type, check_type, ..] = rest else { return None };
        Some(Self { points, profiles, x_scale, y_scale, z_scale, compression, data_type, check_type })
    }

    fn of_text(header: &str) -> Result<Self, ReadError> {
        fn field<T: std::str::FromStr>(header: &str, key: &str) -> Result<T, ReadError> {
            let mut entries = header.lines().filter_map(|line| line.split_once('='));
            let Some((_, value)) = entries.find(|(name, _)| name.trim().eq_ignore_ascii_case(key)) else {
                return Err(corrupt!("has no {key} in its header; allowed: {FIELDS}"));
            };
            value.trim().parse().map_err(|_| {
                let found = shortened(value);
                corrupt!("has {key} = \"{found}\"; allowed: a number")
            })
        }
        // BCR-1.0 may write a name instead of a code.
        let code = |header, key, names: &[&str]| {
            let word: String = field(header, key)?;
            let word = if word == "NULL" { "NONE".to_owned() } else { word };
            let named = names.iter().position(|&name| name == word).and_then(|code| u8::try_from(code).ok());
            named.or_else(|| word.parse().ok()).ok_or_else(|| {
                let found = shortened(&word);
                unsupported!("has {key} = \"{found}\"; allowed: its code, or {}", names.join(", "))
            })
        };
        Ok(Self {
            points: field(header, "NumPoints")?,
            profiles: field(header, "NumProfiles")?,
            x_scale: field(header, "Xscale")?,
            y_scale: field(header, "Yscale")?,
            z_scale: field(header, "Zscale")?,
            compression: code(header, "Compression", &["NONE"])?,
            data_type: code(header, "DataType", &TYPES)?,
            check_type: code(header, "CheckType", &["NONE"])?,
        })
    }

    fn check(&self, greatest: bool) -> Result<Checked, ReadError> {
        let unsupported =
            |what: &str, code: u8| Err(unsupported!("has the {what} {code}; allowed: 0 (none)"));
        if self.compression > 0 {
            return unsupported("Compression", self.compression);
        }
        if self.check_type > 0 {
            return unsupported("CheckType", self.check_type);
        }
        let stored = stored(self.data_type)?;
        if self.points == 0 || self.profiles == 0 {
            return Err(corrupt!(
                "holds no point: NumPoints = {}, NumProfiles = {}; allowed: at least 2",
                self.points,
                self.profiles
            ));
        }
        if self.profiles == 1 {
            return Err(unsupported!("holds a single profile; allowed: surfaces"));
        }
        for (key, scale) in [("Xscale", self.x_scale), ("Yscale", self.y_scale), ("Zscale", self.z_scale)] {
            if !is_positive(scale) {
                return Err(corrupt!("has {key} = {scale:e}; allowed: positive and finite, in metres"));
            }
        }
        let size = |count: u64| usize::try_from(count).ok();
        let (Some(nx), Some(ny), Some(count)) =
            (size(self.points), size(self.profiles), self.points.checked_mul(self.profiles))
        else {
            return Err(too_large());
        };
        let pixel = [self.x_scale, self.y_scale];
        let metadata = Metadata::in_metres([nx, ny], pixel, NAME);
        Ok(Checked { metadata, count, z_scale: self.z_scale, stored, greatest })
    }
}

/// The numbers of a text up to the closing asterisk; `counted` is of its bytes.
fn text_values(numbers: &str, count: u64, mut counted: Count) -> Result<Vec<f64>, ReadError> {
    let value = |(place, word): (usize, &str)| {
        counted.add(word.len() + 1);
        if word.eq_ignore_ascii_case("BAD") {
            return Ok(f64::NAN);
        }
        word.parse().map_err(|_| {
            let found = shortened(word);
            corrupt!("number {place}: found \"{found}\"; allowed: a number, BAD or NaN")
        })
    };
    let values: Vec<f64> = (1..).zip(numbers.split_whitespace()).map(value).collect::<Result<_, _>>()?;
    counted.end();
    if values.len() as u64 > count {
        return Err(corrupt!("holds {} numbers; allowed: {count}, as its header says", values.len()));
    }
    Ok(values)
}
