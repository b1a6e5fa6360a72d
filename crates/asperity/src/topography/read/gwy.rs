//! Gwyddion `.gwy`: one container of named components; data fields of doubles, line after line from the top, in SI units.
//!
//! The format is described in the user guide of Gwyddion, "Gwyddion native format". A component is a name, a letter for
//! its type, and its value; an object is a name, a length and components. Only the objects that a map needs are entered,
//! to a fixed depth; all others, and all arrays, are passed over by their lengths.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};

use super::channel::{Channel, Numbers, Stored, UNPACKED, length};
use super::error::{ReadError, too_large};
use super::source::{OF_BYTES, Source};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::F64;
use crate::progress::PIECE;

pub(super) const FORMAT: Format = Format {
    name: "a Gwyddion file",
    endings: &["gwy"],
    is: |source| source.begin().starts_with(b"GWYP"),
    read: Reader::Channels(channels),
};

/// Bytes of the longest name of a component or an object.
const MAX_NAME: u64 = 4096;
/// A mask of more than this marks its point.
const MASKED: f64 = 0.5;

/// The key of a channel's pixel in metres, "1e-7 x 1e-7", as [`write`](super::super::write) has it: the size of a map over its points is
/// rounded.
pub const PIXEL: &str = "data/pixel";

/// What is known of a channel.
#[derive(Default)]
struct Found {
    title: String,
    data: Option<Field>,
    mask: Option<Field>,
    /// As the file states it, m.
    pixel: Option<[f64; 2]>,
}

/// A data field.
#[derive(Default)]
struct Field {
    points: [u64; 2],
    size: [f64; 2],
    /// The unit of its size.
    lateral: String,
    /// The unit of its numbers.
    vertical: String,
    /// The place of the first number, bytes.
    start: u64,
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let mut place = Place { input: source.reader()?, at: 0, end: source.length() };
    place.skip(4)?;
    let mut found = BTreeMap::<u32, Found>::new();
    let is_container = place.enter("GwyContainer", |place, name, kind| {
        let Some((number, key)) = name.strip_prefix('/').and_then(|rest| rest.split_once('/')) else {
            return Ok(false);
        };
        let Ok(number) = number.parse() else { return Ok(false) };
        match (key, kind) {
            ("data", b'o') => found.entry(number).or_default().data = Field::read(place)?,
            ("mask", b'o') => found.entry(number).or_default().mask = Field::read(place)?,
            (PIXEL, b's') => {
                found.entry(number).or_default().pixel = stated_pixel(&place.text(u64::MAX)?);
            }
            ("data/title", b's') => found.entry(number).or_default().title = place.text(u64::MAX)?,
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    if !is_container {
        return Err(unsupported!("holds no container of Gwyddion; allowed: GwyContainer"));
    }
    let mut channels = Vec::new();
    for (number, Found { title, data, mask, pixel }) in found {
        let Some(data) = data else { continue };
        let name = if title.trim().is_empty() { format!("Channel {number}") } else { title };
        let masked = mask.map(|mask| masked(&data, &mask));
        channels.push(data.channel(name.clone(), pixel, Numbers::Stored(Stored::new(data.start, F64))));
        if let Some(numbers) = masked {
            channels.push(data.channel(format!("{name}, less its mask"), pixel, numbers));
        }
    }
    Ok(channels)
}

/// A pixel as [`PIXEL`] has it, m.
fn stated_pixel(text: &str) -> Option<[f64; 2]> {
    let (x, y) = text.split_once(" x ")?;
    Some([x.parse().ok()?, y.parse().ok()?])
}

/// The numbers of a field, those under its mask missing.
fn masked(data: &Field, mask: &Field) -> Numbers {
    let ([start, marks], [points, others]) = ([data.start, mask.start], [data.points, mask.points]);
    let unpacked = move |source: &Source| {
        if points != others {
            let [[nx, ny], [mx, my]] = [points, others];
            return Err(corrupt!("has a mask of {mx} x {my} points on a map of {nx} x {ny} points"));
        }
        // Both arrays were found to be this long.
        let bytes = points[0] * points[1] * F64.bytes();
        let values = |start: u64| {
            let work = (UNPACKED - OF_BYTES) / 4.0;
            Ok::<_, ReadError>(source.values(F64, false, &source.bytes(start, bytes)?, work))
        };
        let (mut values, marks) = (values(start)?, values(marks)?);
        let mut marks = marks.chunks(PIECE);
        source.count((UNPACKED - OF_BYTES) / 2.0, values.len()).pieces(&mut values, |piece| {
            for (value, mark) in piece.iter_mut().zip(marks.next().unwrap_or_default()) {
                if *mark > MASKED {
                    *value = f64::NAN;
                }
            }
            Ok::<_, ReadError>(())
        })?;
        Ok(values)
    };
    Numbers::Packed(F64, Box::new(unpacked))
}

impl Field {
    /// The data field at a place; none where another object stands there.
    fn read(place: &mut Place) -> Result<Option<Self>, ReadError> {
        let mut field = Self::default();
        let mut count = None;
        let [x, y] = [0, 1];
        let is_field = place.enter("GwyDataField", |place, name, kind| {
            match (name, kind) {
                ("xres", b'i') => field.points[x] = place.count()?,
                ("yres", b'i') => field.points[y] = place.count()?,
                ("xreal", b'd') => field.size[x] = f64::from_le_bytes(place.bytes()?),
                ("yreal", b'd') => field.size[y] = f64::from_le_bytes(place.bytes()?),
                ("si_unit_xy", b'o') => field.lateral = place.unit()?,
                ("si_unit_z", b'o') => field.vertical = place.unit()?,
                ("data", b'D') => {
                    let numbers = place.count()?;
                    (count, field.start) = (Some(numbers), place.at);
                    place.skip(numbers * F64.bytes())?;
                }
                _ => return Ok(false),
            }
            Ok(true)
        })?;
        let [nx, ny] = field.points;
        if is_field && count != nx.checked_mul(ny) {
            return Err(corrupt!("holds {} numbers for a map of {nx} x {ny} points", count.unwrap_or(0)));
        }
        Ok(is_field.then_some(field))
    }

    /// The channel; its pixel is the one that is `stated`, but for a map that was rescaled since.
    fn channel(&self, name: String, stated: Option<[f64; 2]>, numbers: Numbers) -> Channel {
        const ROUNDING: f64 = 1e-12;
        let ([nx, ny], [x, y]) = (self.points, self.size);
        let pixel = length(&self.lateral).map(|unit| {
            let own = [x / nx as f64 * unit, y / ny as f64 * unit];
            let is_own = |stated: &[f64; 2]| (0..2).all(|k| (stated[k] / own[k] - 1.0).abs() < ROUNDING);
            stated.filter(is_own).unwrap_or(own)
        });
        Channel { pixel, ..Channel::new(name, self.points, numbers) }
            .in_unit(&self.vertical)
            .pixel_in(length(&self.lateral))
    }
}

/// A place in the file, within an object.
struct Place {
    input: BufReader<File>,
    at: u64,
    end: u64,
}

impl Place {
    /// Moves on, and checks that the bytes are there.
    fn forward(&mut self, count: u64) -> Result<(), ReadError> {
        match self.at.checked_add(count).filter(|&at| at <= self.end) {
            Some(at) => self.at = at,
            None => {
                return Err(corrupt!(
                    "is truncated: it claims {count} bytes at byte {}, where {} are left",
                    self.at,
                    self.end - self.at
                ));
            }
        }
        Ok(())
    }

    fn skip(&mut self, count: u64) -> Result<(), ReadError> {
        self.forward(count)?;
        Ok(self.input.seek_relative(i64::try_from(count).map_err(|_| too_large())?)?)
    }

    fn bytes<const COUNT: usize>(&mut self) -> Result<[u8; COUNT], ReadError> {
        self.forward(COUNT as u64)?;
        let mut bytes = [0; COUNT];
        self.input.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    fn count(&mut self) -> Result<u64, ReadError> {
        Ok(u32::from_le_bytes(self.bytes()?).into())
    }

    /// A text up to its zero byte.
    fn text(&mut self, most: u64) -> Result<String, ReadError> {
        let mut bytes = Vec::new();
        (&mut self.input).take(most.min(self.end - self.at)).read_until(0, &mut bytes)?;
        self.forward(bytes.len() as u64)?;
        match bytes.pop() {
            Some(0) => Ok(String::from_utf8_lossy(&bytes).into_owned()),
            _ => Err(corrupt!("has a text without an end before byte {}", self.at)),
        }
    }

    /// The unit that an object holds.
    fn unit(&mut self) -> Result<String, ReadError> {
        let mut unit = String::new();
        self.enter("GwySIUnit", |place, name, kind| {
            let is_unit = (name, kind) == ("unitstr", b's');
            if is_unit {
                unit = place.text(MAX_NAME)?;
            }
            Ok(is_unit)
        })?;
        Ok(unit)
    }

    /// Visits the components of an object and says whether it is of the `wanted` kind; others are passed over, as are
    /// components of which `read` says that it did not read them.
    fn enter(
        &mut self,
        wanted: &str,
        mut read: impl FnMut(&mut Self, &str, u8) -> Result<bool, ReadError>,
    ) -> Result<bool, ReadError> {
        let kind = self.text(MAX_NAME)?;
        let length = self.count()?;
        if kind != wanted {
            self.skip(length)?;
            return Ok(false);
        }
        let start = self.at;
        self.forward(length)?;
        let outer = std::mem::replace(&mut self.end, self.at);
        self.at = start;
        while self.at < self.end {
            let name = self.text(MAX_NAME)?;
            let [kind] = self.bytes()?;
            if !read(self, &name, kind)? {
                self.pass(kind)?;
            }
        }
        self.end = outer;
        Ok(true)
    }

    /// Passes over the value of a component of this type.
    fn pass(&mut self, kind: u8) -> Result<(), ReadError> {
        match kind {
            b'b' | b'c' => self.skip(1),
            b'i' => self.skip(4),
            b'q' | b'd' => self.skip(8),
            b's' => self.text(u64::MAX).map(drop),
            b'o' => self.text(MAX_NAME).and_then(|_| self.count()).and_then(|length| self.skip(length)),
            b'C' => self.count().and_then(|count| self.skip(count)),
            b'I' => self.count().and_then(|count| self.skip(4 * count)),
            b'Q' | b'D' => self.count().and_then(|count| self.skip(8 * count)),
            b'S' | b'O' => {
                for _ in 0..self.count()? {
                    self.pass(kind.to_ascii_lowercase())?;
                }
                Ok(())
            }
            _ => Err(corrupt!(
                "has a component of type \"{}\" before byte {}; allowed: b, c, i, q, d, s, o, C, I, Q, D, S, O",
                kind.escape_ascii(),
                self.at
            )),
        }
    }
}
