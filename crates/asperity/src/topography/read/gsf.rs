//! Gwyddion Simple Field: a header of `key = value` in UTF-8, at least one byte 0 to a multiple of four bytes, then single precision, line
//! after line from the top. Numbers are in SI units without prefixes; without a unit they are bare (user guide of Gwyddion, "Gwyddion Simple
//! Field").

use super::bcr::Header;
use super::channel::{Channel, Numbers, Stored, length};
use super::error::ReadError;
use super::source::Source;
use super::{Format, Reader};
use crate::numeric::stored::NumberType::F32;

pub(super) const FORMAT: Format = Format {
    name: "a Gwyddion Simple Field",
    endings: &["gsf"],
    is: |source| source.begin().starts_with(b"Gwyddion Simple Field "),
    read: Reader::Channels(channels),
};

/// The most bytes of a header.
const MOST: u64 = 1 << 16;

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let begin = source.at_most(0, MOST)?;
    let end = begin.iter().position(|&byte| byte == 0);
    let end = end.ok_or_else(|| corrupt!("has no byte 0 at the end of its header"))?;
    let header = Header(String::from_utf8_lossy(&begin[..end]).into_owned());
    let points = [header.needed("XRes")?, header.needed("YRes")?];
    let lateral = length(header.text("XYUnits").unwrap_or_default());
    let size = [header.number::<f64>("XReal")?, header.number("YReal")?];
    let pixel = match (lateral, size) {
        (Some(unit), [Some(x), Some(y)]) => Some([unit * x / points[0] as f64, unit * y / points[1] as f64]),
        _ => None,
    };
    let start = (end as u64 / 4 + 1) * 4;
    let numbers = Numbers::Stored(Stored::new(start, F32));
    let channel =
        Channel { pixel, ..Channel::new(header.text("Title").unwrap_or("Heights"), points, numbers) };
    Ok(vec![channel.in_unit(header.text("ZUnits").unwrap_or_default()).pixel_in(lateral)])
}
