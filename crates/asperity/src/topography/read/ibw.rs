//! Igor binary waves `.ibw`, as the microscopes of Asylum Research write them: a wave of x, y and channels.
//!
//! The format is described in WaveMetrics' technical note PTN003. A microscope adds a note of lines "key:value" and ends the
//! file with the kind of its data, MFP3D for images. Lines run along x from the bottom.

use std::collections::HashMap;

use super::channel::{Channel, Numbers, Order, Stored, length};
use super::error::ReadError;
use super::source::{Fields, Source, latin1};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{self, F32, F64, I8, I16, I32, I64, U8, U16, U32, U64};

pub(super) const FORMAT: Format = Format {
    name: "an Igor binary wave",
    endings: &["ibw"],
    is: |source| version(source.begin()).is_some(),
    read: Reader::Channels(channels),
};

/// Bytes of the headers of version 5; the numbers follow.
const HEADERS: u64 = 384;
/// Bytes of its first header.
const FIRST: u64 = 64;
/// Bytes of the name of a channel.
const LABEL: usize = 32;
/// More layers are a stack of other data.
const MAX_LAYERS: u64 = 1000;

/// The version and whether the most significant bytes are first; none where the sum of all words of the headers is not zero.
fn version(begin: &[u8]) -> Option<(u16, bool)> {
    let first = u16::from_le_bytes(*begin.first_chunk()?);
    let big_endian = first & 0xff == 0;
    let version = if big_endian { first.swap_bytes() } else { first };
    let headers = match version {
        1 => 134,
        2 => 142,
        3 => 146,
        5 => HEADERS as usize,
        _ => return None,
    };
    let words = begin.get(..headers)?.as_chunks().0.iter();
    let word = |&bytes| if big_endian { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) };
    (words.map(word).fold(0, u16::wrapping_add) == 0).then_some((version, big_endian))
}

/// The text behind the numbers.
struct Tail {
    note: HashMap<String, String>,
    /// Units that are too long for the header: of the numbers, and along the dimensions.
    units: [String; 5],
    /// Names along the second dimension.
    columns: Vec<String>,
    /// Names of the channels.
    layers: Vec<String>,
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let unsupported = |text: String| Err(ReadError::Unsupported(text));
    let allowed = "allowed: a map of two dimensions, or of three, the third its channels";
    let (version, big_endian) = version(source.begin()).unwrap_or_default();
    if version != 5 {
        return unsupported(format!(
            "is an Igor wave of version {version}, which holds a curve, no map; {allowed}"
        ));
    }
    let header = Fields { big_endian, ..source.fields(0, HEADERS)? };
    let count = |at: usize| header.count(at, U32);
    let [nx, ny, layers, others] = [count(132)?, count(136)?, count(140)?, count(144)?];
    let kind = number_type(header.count(80, U16)?)?;
    let tail = Tail::read(source, &header)?;
    let ending = source.at_most(source.length().saturating_sub(5), 5)?;
    if ending == b"Force" || (layers == 0 && !tail.columns.is_empty()) {
        let columns = tail.columns.join(", ");
        return unsupported(format!("holds curves ({columns}), such as those of forces, no map; {allowed}"));
    }
    if nx == 0 || ny == 0 || others > 0 {
        let sizes = [nx, ny, layers, others].map(|size| size.to_string());
        let sizes: Vec<_> = sizes.into_iter().take_while(|size| size != "0").collect();
        let size = if sizes.is_empty() { "no".to_owned() } else { sizes.join(" x ") };
        return unsupported(format!("holds {size} numbers in an Igor wave; {allowed}"));
    }
    if layers > MAX_LAYERS {
        return unsupported(format!(
            "holds {layers} layers in an Igor wave; allowed: at most {MAX_LAYERS} channels"
        ));
    }
    let is_asylum = ending == b"MFP3D";
    let unit = |at: usize, long: &str| match header.text(at, 4)? {
        short if short.is_empty() => Ok(long.to_owned()),
        short => Ok::<_, ReadError>(short),
    };
    let lengths = [length(&unit(216, &tail.units[1])?), length(&unit(220, &tail.units[2])?)];
    let steps = [header.number(148, F64)?, header.number(156, F64)?];
    let pixel = match lengths {
        [Some(x), Some(y)] => Some([steps[0] * x, steps[1] * y]),
        _ => None,
    };
    let unit_of_all = unit(212, &tail.units[0])?;
    let bytes = nx.saturating_mul(ny).saturating_mul(kind.bytes());
    source.check(HEADERS, bytes.saturating_mul(layers))?;
    let wave = header.text(92, LABEL)?;
    let channel = |layer: u64| {
        let label = tail.layers.get(layer as usize).map_or("", String::as_str);
        let name = match (label, layers) {
            ("", 0 | 1) if !wave.is_empty() => wave.clone(),
            ("", _) => format!("Layer {}", layer + 1),
            _ => label.to_owned(),
        };
        // The header of a microscope states one unit for channels of different quantities.
        let unit = if is_asylum { tail.unit(&name) } else { &unit_of_all };
        let stored = Stored { big_endian, ..Stored::new(HEADERS + layer * bytes, kind) };
        let channel = Channel::new(&*name, [nx, ny], Numbers::Stored(stored));
        Channel { pixel, order: Order::LinesUpwards, ..channel }.in_unit(unit).pixel_in(lengths[0])
    };
    Ok((0..layers.max(1)).map(channel).collect())
}

fn number_type(code: u64) -> Result<NumberType, ReadError> {
    Ok(match code {
        0x02 => F32,
        0x04 => F64,
        0x08 => I8,
        0x10 => I16,
        0x20 => I32,
        0x80 => I64,
        0x48 => U8,
        0x50 => U16,
        0x60 => U32,
        0xc0 => U64,
        _ => {
            let found = match code {
                0 => "texts".to_owned(),
                _ if code & 1 == 1 => "complex numbers".to_owned(),
                _ => format!("numbers of type {code}"),
            };
            return Err(unsupported!("holds {found}; allowed: real numbers"));
        }
    })
}

impl Tail {
    /// Of the parts behind the numbers the note, the units and the names of columns and layers.
    fn read(source: &Source, header: &Fields) -> Result<Self, ReadError> {
        let count = |at: usize| header.count(at, U32);
        let mut start = FIRST + count(4)? + count(8)?;
        let mut part = |at: usize| {
            let length = count(at)?;
            let bytes = source.bytes(start, length)?;
            start += length;
            Ok::<_, ReadError>(bytes)
        };
        let note = part(12)?;
        let mut units = <[String; 5]>::default();
        for (k, unit) in units.iter_mut().enumerate() {
            *unit = latin1(&part(16 + 4 * k)?);
        }
        // The first of the names is that of the dimension.
        let names = |bytes: &[u8]| bytes.chunks(LABEL).skip(1).map(latin1).collect();
        part(36)?;
        let columns = names(&part(40)?);
        let layers = names(&part(44)?);
        let lines = note.split(|byte| matches!(byte, b'\r' | b'\n')).map(latin1);
        let pair = |line: String| {
            line.split_once(':').map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()))
        };
        Ok(Self { note: lines.filter_map(pair).collect(), units, columns, layers })
    }

    /// The unit of a channel of a microscope: that of the note, else what its name says.
    fn unit(&self, name: &str) -> &str {
        let quantity = name.split("Mod").next().unwrap_or(name);
        let quantity =
            quantity.strip_suffix("Retrace").or(quantity.strip_suffix("Trace")).unwrap_or(quantity);
        if let Some(unit) = self.note.get(&format!("{quantity}Unit")) {
            return unit;
        }
        let quantity = quantity.trim_start_matches("DAC").trim_start_matches("Nap");
        let begins = |words: &[&str]| words.iter().any(|word| quantity.starts_with(word));
        match () {
            () if begins(&["Height", "ZSensor", "Deflection", "Amplitude"]) => "m",
            () if begins(&["Phase"]) => "deg",
            () if begins(&["Current"]) => "A",
            () if begins(&["Frequency"]) => "Hz",
            () if begins(&["Capacitance"]) => "F",
            () => "V",
        }
    }
}
