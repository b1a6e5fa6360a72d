//! Bruker, Veeco and Digital Instruments Nanoscope `.spm`, `.000`, `.001`...: a header of text, then the images.
//!
//! The header has sections, `\*Ciao image list` for each image, and lines `\key: value`. A value with a unit is `V [soft]
//! (step/LSB) hard`: the full range of the numbers in the unit of the converter, and the name of the sensitivity that makes a
//! height of it. Files from version 4.3 on; described at <http://www.physics.arizona.edu/~smanne/DI/software/fileformats.html>.

use super::channel::{Channel, Numbers, Order, Stored};
use super::error::{ReadError, shortened};
use super::source::Source;
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{I16, I32};

pub(super) const FORMAT: Format = Format {
    name: "a Nanoscope file",
    endings: &["spm", "000"],
    is: |source| BEGINS.iter().any(|begin| source.begin().starts_with(begin)),
    read: Reader::Channels(channels),
};

const BEGINS: [&[u8]; 4] = [b"\\*File list", b"\\*EC File list", FORCE, TEXT];
/// Curves of force against distance, or a map of them.
const FORCE: &[u8] = b"\\*Force file list";
/// The same header with numbers as text.
const TEXT: &[u8] = b"?*File list";
/// Bytes in which the header must end; those known have 20 to 80 KB.
const HEADER: u64 = 1 << 20;
const MOST_IMAGES: usize = 64;
/// The version from which on the numbers have 32 bits, whatever `Bytes/pixel` says.
const VERSION_32_BITS: u32 = 0x0920_0000;

/// A section of the header.
pub(super) struct Section<'a> {
    name: &'a str,
    lines: Vec<(&'a str, &'a str)>,
}

impl<'a> Section<'a> {
    /// The value of a key, which changed between upper and lower case over the versions.
    pub(super) fn get(&self, key: &str) -> Option<&'a str> {
        self.lines.iter().find(|(found, _)| found.eq_ignore_ascii_case(key)).map(|&(_, value)| value)
    }

    fn needed(&self, key: &str) -> Result<&'a str, ReadError> {
        self.get(key).ok_or_else(|| corrupt!("has an image without \"{key}\" in its header"))
    }

    /// The first word of a value as a number.
    fn count(&self, key: &str) -> Result<u64, ReadError> {
        let value = self.needed(key)?;
        let word = value.split_whitespace().next().unwrap_or_default();
        word.parse().map_err(|_| not_a_number(key, value))
    }
}

fn not_a_number(key: &str, value: &str) -> ReadError {
    corrupt!("has \"{key}: {}\" in its header; allowed: a number", shortened(value))
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let begin = source.begin();
    let unsupported = |found: &str| Err(ReadError::Unsupported(found.to_owned()));
    if begin.starts_with(FORCE) {
        return unsupported("holds curves of force; allowed: images");
    }
    if begin.starts_with(TEXT) {
        return unsupported(
            "holds numbers as text without \"\\Exported image units\"; allowed: binary Nanoscope files, and exports",
        );
    }
    if begin.split(|&byte| byte == b'\n').next().is_some_and(|line| !line.ends_with(b"\r")) {
        return Err(corrupt!(
            "has lost the carriage returns of its header, as when it is copied as a text, which damages its numbers; allowed: the \
             file as the instrument wrote it"
        ));
    }
    let header: String = source.at_most(0, HEADER)?.into_iter().map(char::from).collect();
    let Some((header, _)) = header.split_once("\\*File list end") else {
        return Err(corrupt!("is truncated: its header has no \"\\*File list end\""));
    };
    let sections = sections(header);
    let images: Vec<_> = sections.iter().filter(|section| section.is_image()).collect();
    if images.len() > MOST_IMAGES {
        return Err(corrupt!("claims {} images; allowed: at most {MOST_IMAGES}", images.len()));
    }
    let mut channels = Vec::new();
    for image in &images {
        channels.push(channel(source, image, &sections)?);
    }
    // What was recorded forth and back has one name.
    let names: Vec<String> = channels.iter().map(|channel| channel.name.clone()).collect();
    for (channel, image) in channels.iter_mut().zip(&images) {
        if let Some(direction) = image.get("Line direction")
            && names.iter().filter(|&name| *name == channel.name).count() > 1
        {
            channel.name = format!("{} {direction}", channel.name);
        }
    }
    Ok(channels)
}

pub(super) fn sections(header: &str) -> Vec<Section<'_>> {
    let mut sections: Vec<Section> = Vec::new();
    for line in header.lines().filter_map(|line| line.strip_prefix('\\')) {
        if let Some(name) = line.strip_prefix('*') {
            sections.push(Section { name: name.trim(), lines: Vec::new() });
        } else if let Some(section) = sections.last_mut() {
            let (key, value) = line.split_once(": ").unwrap_or((line, ""));
            // "@2:Z scale" belongs to an image, "@Sens. Zsens" to the scanner.
            let key = key.strip_prefix('@').map_or(key, |key| {
                key.split_once(':')
                    .filter(|(group, _)| group.parse::<u8>().is_ok())
                    .map_or(key, |(_, key)| key)
            });
            section.lines.push((key.trim(), value.trim()));
        }
    }
    sections
}

impl Section<'_> {
    pub(super) fn is_image(&self) -> bool {
        let name = self.name.to_ascii_lowercase();
        name.ends_with("image list") && !name.contains("force")
    }
}

fn channel(source: &Source, image: &Section, sections: &[Section]) -> Result<Channel, ReadError> {
    let scale = image.get("Z scale").filter(|scale| scale.starts_with('V'));
    let (Some(title), Some(scale)) = (image.get("Image Data"), scale) else {
        return Err(unsupported!(
            "has an image without \"@2:Image Data\" and \"@2:Z scale\"; allowed: files of version 4.3 or later"
        ));
    };
    // S [Sens] "Name"
    let name = title.split('"').nth(1).unwrap_or(title).trim();
    let global =
        |key: &str| sections.iter().find_map(|section| section.get(key).filter(|_| !section.is_image()));
    let version = sections.iter().find_map(|section| section.get("Version")).unwrap_or_default();
    let version = u32::from_str_radix(version.trim_start_matches("0x"), 16).unwrap_or_default();
    let pixel_bytes = match image.count("Bytes/pixel")? {
        bytes @ (2 | 4) => bytes,
        bytes => {
            return Err(unsupported!("holds numbers of {bytes} bytes; allowed: 2, 4"));
        }
    };
    let claimed = [image.count("Samps/line")?, image.count("Number of lines")?];
    let whole = |value: Option<&str>| value.and_then(|value| value.parse::<u64>().ok()).unwrap_or_default();
    // A scan that was stopped has fewer lines than its image claims.
    let valid = [whole(image.get("Valid data len X")), whole(image.get("Valid data len Y"))];
    let scanned = [whole(global("Samps/line")), whole(global("Lines"))];
    let length = image.count("Data length")?;
    let by_version = if version >= VERSION_32_BITS { 4 } else { 2 };
    let sizes = [claimed, valid, scanned].map(|points| [(points, by_version), (points, pixel_bytes)]);
    let bytes = |([nx, ny], bytes): ([u64; 2], u64)| nx.checked_mul(ny)?.checked_mul(bytes);
    let Some(&(points, bytes)) = sizes.as_flattened().iter().find(|&&size| bytes(size) == Some(length))
    else {
        let [nx, ny] = claimed;
        return Err(corrupt!(
            "has {length} bytes for the {nx} x {ny} points of \"{name}\"; allowed: 2 or 4 bytes a point"
        ));
    };
    let start = image.count("Data offset")?;
    // Where bytes are lost, all that follows has moved.
    source.check(start, length)?;
    let stored = Stored::new(start, if bytes == 4 { I32 } else { I16 });
    let (factor, unit) = height(scale, &global)?;
    Ok(Channel {
        pixel: Some(pixel(image, claimed, scanned, &global)?),
        // The range of the converter is that of Bytes/pixel, also where the numbers have more.
        factor: factor / if pixel_bytes == 4 { 4_294_967_296.0 } else { 65_536.0 },
        order: Order::LinesUpwards,
        ..Channel::new(name, points, Numbers::Stored(stored))
    }
    .in_unit(&unit)
    .pixel_in(image.get("Scan size").and_then(|size| super::channel::length(size.rsplit(' ').next()?))))
}

/// The pixel: the size of the scan by its points.
pub(super) fn pixel<'a>(
    image: &Section,
    claimed: [u64; 2],
    scanned: [u64; 2],
    global: &impl Fn(&str) -> Option<&'a str>,
) -> Result<[f64; 2], ReadError> {
    let size = image.needed("Scan size")?;
    let wrong = || not_a_number("Scan size", size);
    // 1.5 1.5 ~m; an old file has one number.
    let words: Vec<&str> = size.split_whitespace().collect();
    let (numbers, unit) = match words[..] {
        [x, y, unit] => ([x, y], unit),
        [x, unit] => ([x, x], unit),
        _ => return Err(wrong()),
    };
    let unit = super::channel::length(unit).ok_or_else(wrong)?;
    let number = |word: &str| word.parse::<f64>().map_err(|_| wrong());
    // With another ratio than 1:1 the size is that of the square scan, of which the image is a part.
    let is_oblong = |ratio: Option<&str>| {
        ratio.is_some_and(|ratio| {
            let ratio = ratio.split(':').next().and_then(|first| first.trim().parse::<f64>().ok());
            ratio.is_some_and(|ratio| ratio > 0.0 && ratio != 1.0)
        })
    };
    let lines = match is_oblong(image.get("Aspect ratio")) {
        true if is_oblong(global("Aspect ratio")) => claimed[0],
        true if scanned[1] > 0 => scanned[1],
        _ => claimed[1],
    };
    Ok([number(numbers[0])? * unit / claimed[0] as f64, number(numbers[1])? * unit / lines as f64])
}

/// The height of the whole range of the numbers and its unit, of `V [soft] (step/LSB) hard`.
fn height<'a>(scale: &'a str, global: &impl Fn(&str) -> Option<&'a str>) -> Result<(f64, String), ReadError> {
    let wrong = || not_a_number("Z scale", scale);
    let parts = |value: &'a str| {
        let (number, unit) = value.trim().split_once(' ').unwrap_or((value.trim(), ""));
        number.parse::<f64>().map(|number| (number, unit.trim()))
    };
    let soft = scale.split_once('[').and_then(|(_, rest)| rest.split_once(']')).map(|(name, _)| name);
    let hard = scale.rsplit_once("/LSB)").map_or(scale, |(_, rest)| rest);
    let (hard, unit) = parts(hard.trim_start_matches('V')).map_err(|_| wrong())?;
    let Some(sensitivity) = soft.filter(|soft| !soft.is_empty()).and_then(global) else {
        return Ok((hard, unit.to_owned()));
    };
    let (factor, sensed) = parts(sensitivity.trim_start_matches('V')).map_err(|_| wrong())?;
    // nm/V times mV
    let (unit, converted) = match sensed.rsplit_once('/') {
        _ if sensed.is_empty() => (unit.to_owned(), 1.0),
        Some((above, below)) if below == unit => (above.to_owned(), 1.0),
        Some((above, "V")) if unit == "mV" => (above.to_owned(), 1e-3),
        _ => (format!("{sensed} {unit}"), 1.0),
    };
    Ok((hard * factor * converted, unit))
}
