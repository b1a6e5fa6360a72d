//! X3P (ISO 25178-72): a zip archive of `main.xml` and usually a binary file of heights.
//!
//! A height is the stored number x Increment + Offset of the z axis, in metres, for all number types. The Offset is kept apart. A Rotation only
//! places the map in space and is not applied. The archive and the XML are read with zip and roxmltree rather than
//! verity-x3p 0.2, which ignores the Increment of floating-point heights and the file of valid points, allocates the
//! size that an entry claims, and reads no heights from XML.

use std::fs::File;
use std::io::{BufReader, ErrorKind};

use md5::{Digest, Md5};
use roxmltree::{Document, Node, ParsingOptions};
use zip::ZipArchive;
use zip::result::ZipError;

use super::content::{Measured, Metadata, transposed};
use super::error::{ReadError, shortened, too_large};
use super::source::{Source, check_packed, read_counted};
use super::{Format, Reader};
use crate::numeric::stored::NumberType;
use crate::numeric::{LARGEST, is_positive};
use crate::progress::{Count, PIECE};

/// The first bytes of a zip archive that is not empty.
const MAGIC: &[u8; 4] = b"PK\x03\x04";

const NAME: &str = "an X3P file";

pub(super) const FORMAT: Format = Format {
    name: NAME,
    endings: &["x3p"],
    is: |source| source.begin().starts_with(MAGIC),
    read: Reader::Map { metadata, measured },
};

const MAIN: &str = "main.xml";
/// The largest XML that is read, with its nodes, two of a height; the standard stores more than 10 000 heights in a binary file.
const MAX_XML_BYTES: u64 = 4 << 20;
const MAX_NODES: u32 = 500_000;
/// The most attributes of an element, and the most namespaces, each of which the parser compares with all others.
const MAX_ATTRIBUTES: usize = 200;

/// A file within the archive, and its check sum if there is one.
struct Link {
    name: String,
    md5: Option<String>,
}

enum Heights {
    /// In the XML; NaN where missing.
    Listed(Vec<f64>),
    /// In a file, with an optional file of one bit per point, set where the point is valid.
    Linked { heights: Link, valid: Option<Link> },
}

/// The content of `main.xml`.
struct Main {
    metadata: Metadata,
    count: u64,
    stored: NumberType,
    increment: f64,
    offset: f64,
    heights: Heights,
}

/// The archive, the folder in it that `main.xml` is in, with a slash behind it: a folder that was packed rather than its content; and the
/// file.
struct Archive<'a>(ZipArchive<BufReader<File>>, String, &'a Source<'a>);

/// The header, its links checked against the sizes of the files in the archive.
///
/// # Errors
/// See [`ReadError`].
pub(super) fn metadata(source: &Source) -> Result<Metadata, ReadError> {
    let mut archive = Archive::open(source)?;
    let main = archive.main()?;
    if let Heights::Linked { heights, valid } = &main.heights {
        archive.sized(&heights.name, main.bytes()?)?;
        if let Some(valid) = valid {
            archive.sized(&valid.name, main.count.div_ceil(8))?;
        }
    }
    Ok(main.metadata)
}

/// Reads a map in metres.
///
/// # Errors
/// See [`ReadError`].
pub(super) fn measured(source: &Source) -> Result<Measured, ReadError> {
    let mut archive = Archive::open(source)?;
    let main = archive.main()?;
    let bytes = main.bytes()?;
    let Main { metadata, count, stored, increment, offset, heights } = main;
    let mut values = match heights {
        Heights::Listed(values) => values,
        Heights::Linked { heights, valid } => {
            let linked = archive.linked(&heights, bytes, 0.4)?;
            let mut values = source.values(stored, false, &linked, 0.1);
            drop(linked);
            if let Some(valid) = valid {
                let valid = archive.linked(&valid, count.div_ceil(8), 0.0)?;
                let bits = valid.iter().flat_map(|byte| (0..8).map(move |bit| byte >> bit & 1 == 1));
                let mut counted = source.count(0.0, values.len());
                for (value, is_admissible) in values.iter_mut().zip(bits) {
                    counted.add(1);
                    if !is_admissible {
                        *value = f64::NAN;
                    }
                }
            }
            values
        }
    };
    source.count(0.2, values.len()).pieces(&mut values, |piece| {
        piece.iter_mut().for_each(|value| *value *= increment);
        Ok::<_, ReadError>(())
    })?;
    let heights = transposed(&values, metadata.points[0], source.count(0.3, values.len()));
    Ok(Measured { metadata, heights, scale: 1.0, offset, precision: stored.scaled_precision() })
}

/// The name of an entry for either path separator.
fn plain(name: &str) -> String {
    let name = name.trim().replace('\\', "/").to_lowercase();
    name.trim_start_matches("./").trim_start_matches('/').to_owned()
}

impl<'a> Archive<'a> {
    fn open(source: &'a Source<'a>) -> Result<Self, ReadError> {
        let archive = ZipArchive::new(source.reader()?).map_err(of_zip)?;
        let mut all = Self(archive, String::new(), source);
        if all.find(MAIN).is_none() {
            let mut folders = all.0.file_names().flatten().filter_map(|name| {
                let name = plain(&name);
                name.strip_suffix(MAIN).filter(|folder| folder.ends_with('/')).map(str::to_owned)
            });
            let folder = folders.next().filter(|_| folders.next().is_none());
            all.1 = folder.unwrap_or_default();
        }
        Ok(all)
    }

    /// The index of the entry `name`, for either path separator.
    fn find(&self, name: &str) -> Option<usize> {
        let wanted = self.1.clone() + &plain(name);
        let is_wanted =
            |index| matches!(self.0.name_for_index(index), Some(Ok(name)) if plain(&name) == wanted);
        (0..self.0.len()).find(|&index| is_wanted(index))
    }

    /// The index of the entry `name`, whose length must be `bytes`.
    fn sized(&mut self, name: &str, bytes: u64) -> Result<usize, ReadError> {
        let index = self.find(name).ok_or_else(|| {
            corrupt!("links to {name}, which is not in the archive; found: {}", self.names())
        })?;
        let (found, packed) = {
            let entry = self.0.by_index_raw(index).map_err(of_zip)?;
            (entry.size(), entry.compressed_size())
        };
        if found != bytes {
            let kind = if found < bytes { "is truncated" } else { "is inconsistent" };
            return Err(corrupt!("{kind}: {name} holds {found} bytes; allowed: {bytes}, as {MAIN} says"));
        }
        check_packed(name, packed.min(self.2.length()), found)?;
        Ok(index)
    }

    fn names(&self) -> String {
        self.0.file_names().flatten().take(8).collect::<Vec<_>>().join(", ")
    }

    /// The content of an entry of at most `most` bytes, whatever its declared size: so much `work`.
    fn content(&mut self, index: usize, most: u64, work: f64) -> Result<Vec<u8>, ReadError> {
        let entry = self.0.by_index(index).map_err(of_zip)?;
        let size = entry.size().min(most) as usize;
        let mut count = self.2.count(work, size);
        let content = read_counted(entry, Vec::with_capacity(size + 1), most.saturating_add(1), &mut count)
            .map_err(of_io)?;
        count.end();
        if content.len() as u64 > most {
            return Err(unsupported!(
                "holds {} of more than {most} bytes; allowed: at most {most}, heights in a binary file",
                self.0.name_for_index(index).and_then(Result::ok).as_deref().unwrap_or("an entry")
            ));
        }
        Ok(content)
    }

    /// The content of a link, whose length must be `bytes`, after verification of its check sum: so much `work`.
    fn linked(&mut self, link: &Link, bytes: u64, work: f64) -> Result<Vec<u8>, ReadError> {
        let index = self.sized(&link.name, bytes)?;
        let content = self.content(index, bytes, 0.7 * work)?;
        if content.len() as u64 != bytes {
            return Err(corrupt!(
                "is truncated: {} holds {} bytes; allowed: {bytes}",
                link.name,
                content.len()
            ));
        }
        let count = self.2.count(0.3 * work, content.len());
        check_md5(&link.name, &content, link.md5.as_deref(), count)?;
        Ok(content)
    }

    fn main(&mut self) -> Result<Main, ReadError> {
        let index = self.find(MAIN).ok_or_else(|| {
            let unpack = if self.names().to_lowercase().contains(".x3p") { "; unpack it first" } else { "" };
            mismatch!("is a zip archive without {MAIN}, not an X3P file; found: {}{unpack}", self.names())
        })?;
        let content = self.content(index, MAX_XML_BYTES, 0.0)?;
        // Its check sum is in a separate file: "1234... *main.xml"; some programs write that of the heights there.
        let checked = match self.find("md5checksum.hex") {
            Some(index) => {
                let line = String::from_utf8_lossy(&self.content(index, 4096, 0.0)?).into_owned();
                let is_of_main =
                    |line: &&str| line.split_once('*').is_none_or(|(_, name)| plain(name).ends_with(MAIN));
                let sum = line.lines().find(is_of_main).and_then(|line| line.split_whitespace().next());
                check_md5(MAIN, &content, sum, self.2.count(0.0, content.len()))
            }
            None => Ok(()),
        };
        let text = String::from_utf8(content)
            .unwrap_or_else(|error| error.into_bytes().iter().map(|&byte| char::from(byte)).collect());
        let text = text.trim_start_matches('\u{feff}');
        if has_many_attributes(text) {
            return Err(corrupt!(
                "has more than {MAX_ATTRIBUTES} attributes of an element, or namespaces, in {MAIN}"
            ));
        }
        let options = ParsingOptions { nodes_limit: MAX_NODES, ..ParsingOptions::default() };
        let document = Document::parse_with_options(text, options)
            .map_err(|error| corrupt!("holds a {MAIN} that is not XML: {error}"))?;
        let mut main = Main::parse(document.root_element())?;
        // Programs that edit main.xml leave its check sum as it was. The heights have one of their own, without which nothing vouches for them.
        if let Err(error) = checked {
            if !matches!(&main.heights, Heights::Linked { heights, .. } if heights.md5.is_some()) {
                return Err(error);
            }
            main.metadata.notes.push(format!(
                "was changed after its check sums were written: {MAIN}, with pixel and scale, has another than md5checksum.hex says; that of \
                 the heights is right"
            ));
        }
        Ok(main)
    }
}

/// Whether an element of an XML has more attributes, or the XML more namespaces, than are read.
fn has_many_attributes(xml: &str) -> bool {
    let attributes = |element: &str| element.split('>').next().unwrap_or_default().matches('=').count();
    xml.split('<').any(|element| !element.starts_with(['!', '?']) && attributes(element) > MAX_ATTRIBUTES)
        || xml.matches("xmlns").count() > MAX_ATTRIBUTES
}

fn check_md5(name: &str, content: &[u8], wanted: Option<&str>, mut count: Count) -> Result<(), ReadError> {
    let Some(wanted) = wanted.filter(|wanted| !wanted.is_empty()) else {
        count.end();
        return Ok(());
    };
    let mut sum = Md5::new();
    for piece in content.chunks(PIECE) {
        sum.update(piece);
        count.add(piece.len());
    }
    count.end();
    let found: String = sum.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    if found.eq_ignore_ascii_case(wanted) {
        return Ok(());
    }
    Err(corrupt!("is damaged: {name} has the MD5 sum {found}; allowed: {wanted}, as the file says"))
}

fn of_zip(error: ZipError) -> ReadError {
    match error {
        ZipError::Io(error) => of_io(error),
        ZipError::UnsupportedArchive(reason) => {
            unsupported!("uses an unsupported zip feature: {reason}")
        }
        error => corrupt!("is an invalid zip archive: {error}"),
    }
}

fn of_io(error: std::io::Error) -> ReadError {
    match error.kind() {
        ErrorKind::UnexpectedEof | ErrorKind::InvalidData | ErrorKind::InvalidInput | ErrorKind::Other => {
            corrupt!("is an invalid zip archive: {error}")
        }
        ErrorKind::Unsupported => unsupported!("uses an unsupported zip feature: {error}"),
        _ => ReadError::Io(error),
    }
}

/// The first child with this name in any namespace.
fn child<'a>(node: Node<'a, 'a>, name: &str) -> Option<Node<'a, 'a>> {
    node.children().find(|child| child.tag_name().name() == name)
}

/// The text at a path of element names; `None` if there is none.
fn text_at<'a>(node: Node<'a, 'a>, path: &[&str]) -> Option<&'a str> {
    let node = path.iter().try_fold(node, |node, name| child(node, name))?;
    node.text().map(str::trim).filter(|text| !text.is_empty())
}

fn missing(path: &[&str]) -> ReadError {
    corrupt!("has no {} in {MAIN}", path.join("/"))
}

fn needed<'a>(node: Node<'a, 'a>, path: &[&str]) -> Result<&'a str, ReadError> {
    text_at(node, path).ok_or_else(|| missing(path))
}

/// A finite number, or `default` if it is missing.
fn number(node: Node, path: &[&str], default: Option<f64>) -> Result<f64, ReadError> {
    let Some(text) = text_at(node, path) else { return default.ok_or_else(|| missing(path)) };
    text.parse()
        .ok()
        .filter(|value: &f64| value.abs() <= LARGEST)
        .ok_or_else(|| corrupt!("has {} = \"{text}\" in {MAIN}; allowed: a finite number", path.join("/")))
}

fn size(node: Node, axis: &str) -> Result<u64, ReadError> {
    let path = ["MatrixDimension", axis];
    let text = needed(node, &path)?;
    text.parse()
        .map_err(|_| corrupt!("has {} = \"{text}\" in {MAIN}; allowed: a whole number", path.join("/")))
}

impl Main {
    /// Bytes of the heights.
    fn bytes(&self) -> Result<u64, ReadError> {
        self.count.checked_mul(self.stored.bytes()).ok_or_else(too_large)
    }

    fn parse(root: Node) -> Result<Self, ReadError> {
        let part = |name| {
            child(root, name).ok_or_else(|| {
                let root = root.tag_name().name();
                mismatch!("is not an X3P file: its {MAIN}, of {root}, has no {name}")
            })
        };
        let (header, data) = (part("Record1")?, part("Record3")?);
        let only = |path: &[&str], allowed: &str, meaning: &str| {
            let Some(found) = text_at(header, path).filter(|found| !found.eq_ignore_ascii_case(allowed))
            else {
                return Ok(());
            };
            let found = shortened(found);
            Err(unsupported!("has {} = {found}; allowed: {allowed}, which is {meaning}", path.join("/")))
        };
        only(&["FeatureType"], "SUR", "a surface")?;
        only(&["Axes", "CX", "AxisType"], "I", "an even spacing")?;
        only(&["Axes", "CY", "AxisType"], "I", "an even spacing")?;
        only(&["Axes", "CZ", "AxisType"], "A", "a height for each point")?;
        let (nx, ny, layers) = (size(data, "SizeX")?, size(data, "SizeY")?, size(data, "SizeZ")?);
        if layers != 1 {
            return Err(unsupported!("holds {layers} layers; allowed: one"));
        }
        let mut pixel = [0.0; 2];
        for (size, axis) in pixel.iter_mut().zip(["CX", "CY"]) {
            *size = number(header, &["Axes", axis, "Increment"], None)?;
            if !is_positive(*size) {
                return Err(corrupt!("has Axes/{axis}/Increment = {size:e}; allowed: positive, in metres"));
            }
        }
        let increment = number(header, &["Axes", "CZ", "Increment"], Some(1.0))?;
        if increment == 0.0 {
            return Err(corrupt!("has Axes/CZ/Increment = 0; allowed: other than zero"));
        }
        let offset = number(header, &["Axes", "CZ", "Offset"], Some(0.0))?;
        let stored = match text_at(header, &["Axes", "CZ", "DataType"]).unwrap_or("D") {
            "I" => NumberType::I16,
            "L" => NumberType::I32,
            "F" => NumberType::F32,
            "D" => NumberType::F64,
            found => {
                let found = shortened(found);
                return Err(unsupported!("has Axes/CZ/DataType = {found}; allowed: I, L, F, D"));
            }
        };
        let count = nx.checked_mul(ny).ok_or_else(too_large)?;
        let length = |length: u64| usize::try_from(length).map_err(|_| too_large());
        let points = [length(nx)?, length(ny)?];
        let heights = if let Some(list) = child(data, "DataList") {
            Heights::Listed(listed(list, count)?)
        } else {
            let link = |path: &[&str], md5: &str| {
                text_at(data, path).map(|name| Link {
                    name: name.to_owned(),
                    md5: text_at(data, &["DataLink", md5]).map(str::to_owned),
                })
            };
            let path = ["DataLink", "PointDataLink"];
            Heights::Linked {
                heights: link(&path, "MD5ChecksumPointData").ok_or_else(|| missing(&path))?,
                valid: link(&["DataLink", "ValidPointsLink"], "MD5ChecksumValidPoints"),
            }
        };
        let metadata = Metadata::in_metres(points, pixel, NAME);
        Ok(Self { metadata, count, stored, increment, offset, heights })
    }
}

/// The heights of a DataList: one Datum per point, empty where the point is missing.
fn listed(list: Node, count: u64) -> Result<Vec<f64>, ReadError> {
    let data = list.children().filter(|node| node.tag_name().name() == "Datum");
    let value = |(place, node): (usize, Node)| {
        let text = node.text().unwrap_or_default().trim();
        if text.is_empty() {
            return Ok(f64::NAN);
        }
        text.parse().map_err(|_| {
            let found = shortened(text);
            corrupt!("Datum {place}: found \"{found}\"; allowed: a number, or nothing")
        })
    };
    let values: Vec<f64> = (1..).zip(data).map(value).collect::<Result<_, _>>()?;
    if values.len() as u64 != count {
        let kind = if (values.len() as u64) < count { "is truncated" } else { "is inconsistent" };
        return Err(corrupt!(
            "{kind}: its DataList holds {} heights; allowed: {count}, as MatrixDimension says",
            values.len()
        ));
    }
    Ok(values)
}
