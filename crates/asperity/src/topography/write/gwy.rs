//! Gwyddion's `.gwy`: fields of doubles in one container, line after line from the top, with notes that Gwyddion shows as metadata.

use std::io;

use super::{MapFormat, Note, Out, bytes_of, each_line, too_large};
use crate::topography::Rows;
use crate::topography::read::PIXEL_OF_GWY;

pub(super) const FORMAT: MapFormat = MapFormat {
    ending: "gwy",
    holds_notes: true,
    write: |out, map, notes| gwy(out, &[GwyField { title: "Height", unit: "m", map }], notes),
};

/// A field of a `.gwy` file.
pub struct GwyField<'a> {
    /// What Gwyddion calls it.
    pub title: &'a str,
    /// Unit of its numbers.
    pub unit: &'a str,
    /// Its numbers.
    pub map: &'a dyn Rows,
}

/// Writes fields with what is said of all of them.
///
/// # Errors
/// A file that cannot be written; fields of 4 GB or more, which the format cannot hold ([`io::ErrorKind::InvalidInput`]).
pub fn gwy(mut out: impl Out, fields: &[GwyField], notes: &[Note]) -> io::Result<()> {
    let heads: Vec<Head> = fields.iter().enumerate().map(|(k, field)| Head::new(k, field, notes)).collect();
    let length = heads.iter().map(|head| head.bytes.len() as u64 + head.numbers).sum();
    out.write_all(b"GWYPGwyContainer\0")?;
    out.write_all(&size(length)?)?;
    let mut bytes = Vec::new();
    for (field, head) in fields.iter().zip(heads) {
        out.write_all(&head.bytes)?;
        each_line(field.map, |line| {
            bytes_of(line, &mut bytes);
            out.write_all(&bytes)
        })?;
    }
    Ok(())
}

/// What stands before the numbers of a field: they come last in their object, and their object last of what belongs to it.
struct Head {
    bytes: Vec<u8>,
    /// Bytes of the numbers.
    numbers: u64,
}

impl Head {
    fn new(index: usize, field: &GwyField, notes: &[Note]) -> Self {
        let ([nx, ny], [dx, dy]) = (field.map.points(), field.map.pixel());
        let key = |rest: &str| format!("/{index}/{rest}");
        let mut bytes = text(&key("data/title"), field.title);
        bytes.extend(text(&key(PIXEL_OF_GWY), &format!("{dx:e} x {dy:e}")));
        let meta: Vec<u8> = notes.iter().flat_map(|(name, content)| text(name, content)).collect();
        bytes.extend(object(&key("meta"), "GwyContainer", &meta, 0));
        let count = nx as u64 * ny as u64;
        let numbers = count * 8;
        let mut content = Vec::new();
        for (name, value) in [("xres", nx), ("yres", ny)] {
            content.extend(component(name, b'i', &(value as u32).to_le_bytes()));
        }
        for (name, value) in [("xreal", nx as f64 * dx), ("yreal", ny as f64 * dy)] {
            content.extend(component(name, b'd', &value.to_le_bytes()));
        }
        content.extend(object("si_unit_xy", "GwySIUnit", &text("unitstr", "m"), 0));
        content.extend(object("si_unit_z", "GwySIUnit", &text("unitstr", field.unit), 0));
        content.extend(component("data", b'D', &(count as u32).to_le_bytes()));
        bytes.extend(object(&key("data"), "GwyDataField", &content, numbers));
        Self { bytes, numbers }
    }
}

/// A length, which must be below 4 GB.
fn size(bytes: u64) -> io::Result<[u8; 4]> {
    let error = || too_large("a .gwy file holds less than 4 GB; allowed: a smaller map, or .npy, .x3p, .xyz");
    u32::try_from(bytes).map(u32::to_le_bytes).map_err(|_| error())
}

fn component(name: &str, kind: u8, value: &[u8]) -> Vec<u8> {
    [name.as_bytes(), &[0, kind], value].concat()
}

/// A text, which ends at its zero byte.
fn text(name: &str, value: &str) -> Vec<u8> {
    component(name, b's', format!("{}\0", value.replace('\0', " ")).as_bytes())
}

/// An object with its content, of which `more` bytes follow.
fn object(name: &str, kind: &str, content: &[u8], more: u64) -> Vec<u8> {
    // What is too long is refused with the container that it is in.
    let length = (content.len() as u64 + more) as u32;
    component(name, b'o', &[kind.as_bytes(), &[0], &length.to_le_bytes(), content].concat())
}
