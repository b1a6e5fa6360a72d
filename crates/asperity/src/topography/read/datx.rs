//! Zygo `.datx`: an HDF5 file with the groups `Data/Surface` and `Data/Intensity`, a dataset for each measurement in them, and
//! `Attributes`.
//!
//! Read for facts: `IO/DATX.py` of SurfaceTopography. Its converters, compound attributes, are left aside: the same numbers
//! stand in plain attributes, and the programs Mx and MetroPro write different converters.

use std::collections::{BTreeSet, HashMap};
use std::sync::atomic::{AtomicU64, Ordering};

use hdf5_pure::{AttrValue, DType, Dataset, File, FormatError, ReadSeekSource};

use super::channel::{Channel, Numbers, Quantity, UNPACKED, length};
use super::error::{ReadError, too_large};
use super::source::Source;
use super::{Format, Reader};
use crate::numeric::is_positive;
use crate::numeric::stored::NumberType;
use crate::progress::PIECE;

pub(super) const FORMAT: Format = Format {
    name: "a Zygo DATX file",
    endings: &["datx"],
    is: |source| source.begin().starts_with(b"\x89HDF\r\n\x1a\n"),
    read: Reader::Channels(channels),
};

/// How many times the bytes of the file its numbers may take: far more than a surface is ever compressed.
const MOST_UNPACKED: u64 = 256;
const MOST_DATASETS: usize = 256;

/// A file of which no more is read than a few times its length, however often its parts refer to each other.
struct Bounded<S> {
    source: S,
    left: AtomicU64,
}

impl<S: hdf5_pure::Source> hdf5_pure::Source for Bounded<S> {
    fn len(&self) -> u64 {
        self.source.len()
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), FormatError> {
        // A short read costs as much time as a long one.
        let cost = (buffer.len() as u64).max(1024);
        let left =
            self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(cost));
        left.map_err(|_| FormatError::Source("its parts refer to each other too often".to_owned()))?;
        self.source.read_at(offset, buffer)
    }
}

fn damaged(error: impl std::fmt::Display) -> ReadError {
    corrupt!("cannot be read as HDF5: {error}")
}

type Attributes = HashMap<String, AttrValue>;

fn number(attributes: &Attributes, name: &str) -> Option<f64> {
    let value = attributes.get(name)?;
    value.as_f64().or_else(|| value.to_i64s()?.first().map(|&value| value as f64))
}

fn text<'a>(attributes: &'a Attributes, name: &str) -> Option<&'a str> {
    let value = attributes.get(name)?;
    value.as_str().or_else(|| value.as_strings()?.first().map(String::as_str))
}

/// A unit of length as Zygo names it, m.
fn metres(unit: &str) -> Option<f64> {
    length(unit).or_else(|| length(&unit.to_ascii_lowercase()))
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let left = source.length().saturating_mul(8).saturating_add(1 << 26);
    let reader = ReadSeekSource::new(source.reader()?).map_err(damaged)?;
    let file = File::from_source(Bounded { source: reader, left: left.into() }).map_err(damaged)?;
    let data = file.group("Data").and_then(|data| Ok((data.group("Surface")?, data.group("Intensity"))));
    let Ok((surface, intensity)) = data else {
        return Err(unsupported!("is an HDF5 file without the group Data/Surface; allowed: files of Zygo"));
    };
    let mut measured = Vec::new();
    if let Ok(groups) = file.group("Attributes").and_then(|group| group.iter_groups()) {
        for (_, group) in groups.take(MOST_DATASETS) {
            measured.push(group.attrs().map_err(damaged)?);
        }
    }
    let mut channels = Vec::new();
    for (name, group) in [("Surface", Some(surface)), ("Intensity", intensity.ok())] {
        for (_, dataset) in
            group.map(|group| group.iter_datasets()).transpose().map_err(damaged)?.into_iter().flatten()
        {
            if channels.len() == MOST_DATASETS {
                return Err(corrupt!("holds more than {MOST_DATASETS} surfaces"));
            }
            channels.push(channel(source, name, dataset, &measured)?);
        }
    }
    Ok(channels)
}

fn channel(
    source: &Source,
    name: &str,
    dataset: Dataset,
    measured: &[Attributes],
) -> Result<Channel, ReadError> {
    let shape = dataset.shape().map_err(damaged)?;
    let [lines, samples] = shape[..] else {
        return Err(unsupported!("holds a {name} of {} dimensions; allowed: 2", shape.len()));
    };
    // Chunks are unpacked whole.
    let chunk = dataset.chunk_shape().map_err(damaged)?.unwrap_or_default();
    let whole = |points: u64, k: usize| points.checked_next_multiple_of(chunk.get(k).copied().unwrap_or(1));
    let count =
        whole(lines, 0).zip(whole(samples, 1)).and_then(|(lines, samples)| lines.checked_mul(samples));
    let unpacked = count.and_then(|count| count.checked_mul(8)).ok_or_else(too_large)?;
    if unpacked / MOST_UNPACKED > source.length() {
        return Err(corrupt!(
            "claims {samples} x {lines} points in {} bytes; allowed: at most {MOST_UNPACKED} times the bytes of the file",
            source.length()
        ));
    }
    let kind = match dataset.dtype().map_err(damaged)? {
        DType::F32 => NumberType::F32,
        DType::F64 => NumberType::F64,
        DType::I8 | DType::I16 | DType::I32 | DType::U8 | DType::U16 | DType::U32 => NumberType::I32,
        other => {
            return Err(unsupported!(
                "holds a {name} of the type {other}; allowed: floats and integers of up to 32 bits"
            ));
        }
    };
    let attributes = dataset.attrs().map_err(damaged)?;
    let no_data = number(&attributes, "No Data").unwrap_or(f64::INFINITY);
    let (factor, quantity) = match text(&attributes, "Unit") {
        _ if name != "Surface" => (1.0, Quantity::Other("grey".to_owned())),
        // Of light that goes there and back, and at an angle.
        Some(unit) if unit.eq_ignore_ascii_case("Fringes") => {
            let needed = |key: &str| {
                number(&attributes, key)
                    .ok_or_else(|| corrupt!("has heights in fringes and no attribute \"{key}\""))
            };
            let scale = needed("Interferometric Scale Factor")? * needed("Obliquity Factor")?;
            (needed("Wavelength")? * scale, Quantity::Length)
        }
        Some(unit) => match metres(unit) {
            Some(factor) => (factor, Quantity::Length),
            None => (1.0, Quantity::Other(unit.to_owned())),
        },
        None => (1.0, Quantity::Unknown),
    };
    let mut channel = Channel::new(
        name,
        [samples, lines],
        Numbers::Packed(
            kind,
            Box::new(move |source| {
                check_chunks(source, &dataset)?;
                numbers(&dataset, source)
            }),
        ),
    );
    // A camera that is not calibrated has a pixel of 0.
    channel.pixel = pixel(&attributes, measured).filter(|&pixel| is_positive(pixel)).map(|pixel| [pixel; 2]);
    channel.missing = Box::new(move |value| value >= no_data);
    Ok(Channel { factor, quantity, ..channel })
}

/// The numbers of a dataset, some rows of chunks at a time.
fn numbers(dataset: &Dataset, source: &Source) -> Result<Vec<f64>, ReadError> {
    let shape = dataset.shape().map_err(damaged)?;
    let (lines, samples) = (shape[0], shape[1..].iter().product::<u64>().max(1));
    let chunk = dataset.chunk_shape().map_err(damaged)?.and_then(|chunk| chunk.first().copied());
    let rows = (PIECE as u64).div_ceil(samples).next_multiple_of(chunk.unwrap_or(1).max(1));
    let mut count = source.count(UNPACKED, lines.saturating_mul(samples) as usize);
    let mut values = Vec::with_capacity(lines.saturating_mul(samples) as usize);
    for first in (0..lines).step_by(rows as usize) {
        let some = dataset.read_f64_rows(first, rows).map_err(damaged)?;
        count.add(some.len());
        values.extend(some);
    }
    count.end();
    Ok(values)
}

/// Checks that the file has the bytes of all chunks of a dataset, and that they hold all of it, before memory is taken for them.
fn check_chunks(source: &Source, dataset: &Dataset) -> Result<(), ReadError> {
    let Some(chunk) = dataset.chunk_shape().map_err(damaged)? else { return Ok(()) };
    let shape = dataset.shape().map_err(damaged)?;
    let needed =
        shape.iter().zip(&chunk).map(|(points, size)| points.div_ceil((*size).max(1))).product::<u64>();
    let chunks = dataset.chunks().map_err(damaged)?;
    // What lies elsewhere the crate would add up beyond the range of its numbers.
    let is_placed = |offset: &[u64]| {
        let mut axes = offset.iter().zip(&shape).zip(&chunk);
        offset.len() == shape.len()
            && axes.all(|((first, points), size)| first < points && first.is_multiple_of((*size).max(1)))
    };
    let placed: BTreeSet<&[u64]> =
        chunks.iter().map(|chunk| &*chunk.offset).filter(|offset| is_placed(offset)).collect();
    if placed.len() as u64 != needed || chunks.len() != placed.len() {
        return Err(corrupt!("is damaged: {} of the {needed} chunks of its heights are there", placed.len()));
    }
    chunks.iter().try_for_each(|chunk| source.check(chunk.address, chunk.storage_size))
}

/// The pixel in the attributes of the measurement that a dataset belongs to, m.
fn pixel(dataset: &Attributes, measured: &[Attributes]) -> Option<f64> {
    let group = |attributes| number(attributes, "Group Number");
    let own = measured.iter().filter(|attributes| group(attributes) == group(dataset));
    own.chain(measured).find_map(|attributes| {
        ["Surface Data Context", "Data Context"].iter().find_map(|context| {
            let key = format!("{context}.Lateral Resolution");
            let unit = text(attributes, &format!("{key}:Unit")).map_or(Some(1.0), metres)?;
            Some(unit * number(attributes, &format!("{key}:Value"))?)
        })
    })
}
