//! X3P (ISO 25178-72, before ISO 5436-2): a zip archive of doubles in metres and their description, with MD5 sums.

use std::io::{self, Write};

use md5::{Digest, Md5};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::{MapFormat, Note, Out, bytes_of, each_line};
use crate::topography::Rows;

pub(super) const FORMAT: MapFormat = MapFormat { ending: "x3p", holds_notes: true, write };

/// Where the heights are in the archive.
const DATA: &str = "bindata/data.bin";

fn write(out: &mut dyn Out, map: &dyn Rows, notes: &[Note]) -> io::Result<()> {
    let [nx, ny] = map.points();
    let mut archive = ZipWriter::new(out);
    // No time of writing: the same map gives the same file.
    let options = SimpleFileOptions::DEFAULT.compression_method(CompressionMethod::Deflated);
    /// Beyond this an archive needs longer fields.
    const LARGE: u64 = 1 << 31;
    archive.start_file(DATA, options.large_file(8 * nx as u64 * ny as u64 > LARGE))?;
    let (mut sum, mut bytes) = (Md5::new(), Vec::new());
    each_line(map, |line| {
        bytes_of(line, &mut bytes);
        sum.update(&bytes);
        archive.write_all(&bytes)
    })?;
    let main = main(map, notes, &hexadecimal(&sum.finalize()));
    archive.start_file("main.xml", options)?;
    archive.write_all(main.as_bytes())?;
    archive.start_file("md5checksum.hex", options)?;
    writeln!(archive, "{} *main.xml", hexadecimal(&Md5::digest(&main)))?;
    archive.finish()?;
    Ok(())
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The description. The standard wants a date and an instrument beside the comment.
fn main(map: &dyn Rows, notes: &[Note], md5: &str) -> String {
    let ([nx, ny], [dx, dy], offset) = (map.points(), map.pixel(), map.offset());
    let comment: Vec<String> = notes.iter().map(|(name, text)| escaped(&format!("{name}: {text}"))).collect();
    let comment = comment.join("\n");
    let version = env!("CARGO_PKG_VERSION");
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.opengps.eu/2008/ISO5436_2 http://www.opengps.eu/2008/ISO5436_2/ISO5436_2.xsd">
  <Record1>
    <Revision>ISO5436 - 2000</Revision>
    <FeatureType>SUR</FeatureType>
    <Axes>
      <CX><AxisType>I</AxisType><DataType>D</DataType><Increment>{dx:e}</Increment><Offset>0</Offset></CX>
      <CY><AxisType>I</AxisType><DataType>D</DataType><Increment>{dy:e}</Increment><Offset>0</Offset></CY>
      <CZ><AxisType>A</AxisType><DataType>D</DataType><Increment>1</Increment><Offset>{offset:e}</Offset></CZ>
    </Axes>
  </Record1>
  <Record2>
    <Date>1970-01-01T00:00:00Z</Date>
    <Creator>asperity {version}</Creator>
    <Instrument><Manufacturer>none</Manufacturer><Model>asperity</Model><Serial>none</Serial><Version>{version}</Version></Instrument>
    <CalibrationDate>1970-01-01T00:00:00Z</CalibrationDate>
    <ProbingSystem><Type>Software</Type><Identification>asperity</Identification></ProbingSystem>
    <Comment>{comment}</Comment>
  </Record2>
  <Record3>
    <MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
    <DataLink><PointDataLink>{DATA}</PointDataLink><MD5ChecksumPointData>{md5}</MD5ChecksumPointData></DataLink>
  </Record3>
  <Record4>
    <ChecksumFile>md5checksum.hex</ChecksumFile>
  </Record4>
</p:ISO5436_2>
"#
    )
}

/// A text within XML, which has no control characters.
fn escaped(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
