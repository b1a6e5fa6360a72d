//! Wyko and Veeco `.opd`: a directory of named blocks, heights in wavelengths.

use super::channel::{Channel, Numbers, Order, Quantity, Stored};
use super::error::ReadError;
use super::source::{Fields, Source};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{self, F32, I16, U8, U16, U32};

pub(super) const FORMAT: Format = Format {
    name: "a Wyko OPD file",
    endings: &["opd"],
    is: |source| source.begin().starts_with(b"\x01\x00Directory\x00"),
    read: Reader::Channels(channels),
};

/// Bytes of an entry of the directory: a name of 16, type, length, attribute.
const ENTRY: usize = 24;
/// The type of a block that holds an array.
const ARRAY: u64 = 3;

struct Block {
    name: String,
    kind: u64,
    start: u64,
    length: u64,
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let length = source.fields(2, ENTRY as u64)?.count(18, U32)?;
    let directory = source.fields(2, length)?;
    let mut start = 2 + length;
    let mut blocks = Vec::new();
    for at in (ENTRY..length as usize).step_by(ENTRY) {
        let block = Block {
            name: directory.text(at, 16)?,
            kind: directory.count(at + 16, U16)?,
            start,
            length: directory.count(at + 18, U32)?,
        };
        start += block.length;
        if block.length > 0 {
            source.check(block.start, block.length)?;
            blocks.push(block);
        }
    }
    let fields = |block: &Block| source.fields(block.start, block.length.min(8));
    let number = |name: &str, kind: NumberType| match blocks.iter().find(|block| block.name == name) {
        Some(block) => fields(block)?.number(0, kind).map(Some),
        None => Ok(None),
    };
    let needed =
        |name: &str| number(name, F32)?.ok_or_else(|| corrupt!("has no block {name} in its directory"));
    // In mm and nm.
    let (pixel, wavelength) = (1e-3 * needed("Pixel_size")?, 1e-9 * needed("Wavelength")?);
    let aspect = number("Aspect", F32)?.unwrap_or(1.0);
    let factor = wavelength / number("Mult", U16)?.unwrap_or(1.0);
    let mut channels = Vec::new();
    for block in blocks.iter().filter(|block| block.kind == ARRAY) {
        let is_height = ["OPD", "SAMPLE_DATA", "RAW_DATA", "RAW DATA", "Raw"].contains(&block.name.as_str());
        let is_picture = ["Image", "Intensity", "SecArr_0"].contains(&block.name.as_str());
        if is_height || is_picture {
            let channel = array(block, &fields(block)?)?;
            let quantity = if is_height { Quantity::Length } else { Quantity::Other("grey".to_owned()) };
            channels.push(Channel { pixel: Some([pixel, pixel * aspect]), factor, quantity, ..channel });
        }
    }
    Ok(channels)
}

/// An array: two sizes, the bytes of a number, then column after column from the bottom.
fn array(block: &Block, fields: &Fields) -> Result<Channel, ReadError> {
    let points = [fields.count(0, U16)?, fields.count(2, U16)?];
    // Integers from 32766 up and huge numbers mark missing points.
    let (kind, missing) = match fields.count(4, U16)? {
        1 => (U8, f64::INFINITY),
        2 => (I16, 32_766.0),
        4 => (F32, 1e38),
        bytes => {
            return Err(unsupported!(
                "holds numbers of {bytes} bytes in its block {}; allowed: 1, 2, 4",
                block.name
            ));
        }
    };
    Ok(Channel {
        order: Order::ColumnsUpwards,
        missing: Box::new(move |value| value >= missing),
        ..Channel::new(&*block.name, points, Numbers::Stored(Stored::new(block.start + 6, kind)))
    })
}
