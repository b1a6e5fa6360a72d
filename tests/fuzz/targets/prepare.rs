//! Makes any bytes a file of one format, so that its reader sees them: the first bytes, sums, archives.

use std::io::{Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// The bytes with the first of a format instead of their own.
pub fn begin(bytes: &[u8], first: &[u8]) -> Vec<u8> {
    let rest = bytes.get(first.len()..).unwrap_or_default();
    [first, rest].concat()
}

/// The same where they do not begin with one of `allowed`.
fn begin_with_one(bytes: &[u8], allowed: &[&[u8]]) -> Vec<u8> {
    if allowed.iter().any(|first| bytes.starts_with(first)) {
        return bytes.to_vec();
    }
    let chosen = usize::from(bytes.first().copied().unwrap_or(0)) % allowed.len();
    begin(bytes, allowed[chosen])
}

pub fn bcr(bytes: &[u8]) -> Vec<u8> {
    let wide: Vec<u8> = "fileformat = bcrf".encode_utf16().flat_map(u16::to_le_bytes).collect();
    begin_with_one(
        bytes,
        &[b"fileformat = bcrstm", b"fileformat = bcrf", &[b"\xff\xfe", wide.as_slice()].concat(), &wide],
    )
}

/// Version 5 in either order of bytes; the words of its headers add up to zero.
pub fn ibw(bytes: &[u8]) -> Vec<u8> {
    const HEADERS: usize = 384;
    let mut bytes = bytes.to_vec();
    bytes.resize(bytes.len().max(HEADERS), 0);
    let is_big = bytes[0] == 0;
    let word = |bytes: [u8; 2]| if is_big { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) };
    let two = |value: u16| if is_big { value.to_be_bytes() } else { value.to_le_bytes() };
    bytes[..2].copy_from_slice(&two(5));
    bytes[2..4].copy_from_slice(&[0, 0]);
    let sum = bytes[..HEADERS].as_chunks().0.iter().map(|&bytes| word(bytes)).fold(0, u16::wrapping_add);
    bytes[2..4].copy_from_slice(&two(sum.wrapping_neg()));
    bytes
}

pub fn tiff(bytes: &[u8]) -> Vec<u8> {
    begin_with_one(bytes, &[b"II*\0", b"MM\0*"])
}

pub fn metropro(bytes: &[u8]) -> Vec<u8> {
    begin_with_one(bytes, &[b"\x88\x1b\x03\x6f", b"\x88\x1b\x03\x70", b"\x88\x1b\x03\x71"])
}

pub fn sdf(bytes: &[u8]) -> Vec<u8> {
    begin_with_one(bytes, &[b"aISO-1.0", b"bISO-1.0", b"aISO-2.0", b"bISO-2.0", b"aBCR-1.0", b"bBCR-1.0"])
}

pub fn sur(bytes: &[u8]) -> Vec<u8> {
    begin_with_one(bytes, &[b"DIGITAL SURF", b"DSCOMPRESSED"])
}

/// No other bytes than a text has in its beginning.
pub fn text(bytes: &[u8]) -> Vec<u8> {
    let letter =
        |byte: &u8| if *byte >= b' ' || byte.is_ascii_whitespace() { *byte } else { b'0' + *byte % 10 };
    bytes.iter().map(letter).collect()
}

/// A zip archive of files.
fn zip(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    for (name, content) in files {
        let written = archive.start_file(*name, options).and_then(|()| Ok(archive.write_all(content)?));
        written.expect("an archive in memory");
    }
    archive.finish().expect("an archive in memory").into_inner()
}

/// Version 3 or 4; four zeros follow the version of the program.
pub fn vk(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = begin_with_one(bytes, &[b"VK3_", b"VK4_"]);
    bytes.resize(bytes.len().max(12), 0);
    bytes[8..12].fill(0);
    bytes
}

/// The file in a VK6.
pub fn vk_packed(bytes: &[u8]) -> Vec<u8> {
    [b"VK6".as_slice(), &zip(&[("Vk4File", &vk(bytes))])].concat()
}

/// The XML of an X3P, up to a zero byte, and the file of heights behind it.
pub fn x3p_packed(bytes: &[u8]) -> Vec<u8> {
    let end = bytes.iter().position(|&byte| byte == 0);
    let (main, rest) = bytes.split_at(end.unwrap_or(bytes.len()));
    let data = rest.get(1..).unwrap_or_default();
    zip(&[("main.xml", main), ("bindata/data.bin", data), ("bindata/valid.bin", data)])
}
