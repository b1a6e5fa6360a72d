//! Large files of several formats, which hold as many points as they say.

use std::fmt::Write as _;
use std::io::{Cursor, Write as _};

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Points along x and y.
pub const POINTS: [usize; 2] = [1500, 1400];

/// Heights that look measured, whole numbers below 1000.
fn heights() -> impl Iterator<Item = u32> {
    let mut state = 1u64;
    (0..POINTS[0] * POINTS[1]).map(move |_| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as u32 % 1000
    })
}

fn doubles() -> Vec<u8> {
    heights().flat_map(|z| (1e-9 * f64::from(z)).to_le_bytes()).collect()
}

/// The name of a target, and what makes a file for it.
type LargeFile = (&'static str, fn() -> Vec<u8>);

pub const FILES: [LargeFile; 6] =
    [("npy", npy), ("text", matrix), ("text", columns), ("sdf", sdf), ("gwy", gwy), ("x3p", x3p)];

/// In Fortran order, which is read into memory.
fn npy() -> Vec<u8> {
    let [nx, ny] = POINTS;
    let text = format!("{{'descr': '<f8', 'fortran_order': True, 'shape': ({nx}, {ny}), }}\n");
    [b"\x93NUMPY\x01\x00", &(text.len() as u16).to_le_bytes()[..], text.as_bytes(), &doubles()].concat()
}

fn matrix() -> Vec<u8> {
    let mut text = String::new();
    for (k, z) in heights().enumerate() {
        let end = if (k + 1) % POINTS[0] == 0 { '\n' } else { ' ' };
        let _ = write!(text, "{z}.25{end}");
    }
    text.into_bytes()
}

fn columns() -> Vec<u8> {
    let mut text = String::new();
    for (k, z) in heights().enumerate() {
        let _ = writeln!(text, "{} {} {z}.25", k % POINTS[0], k / POINTS[0]);
    }
    text.into_bytes()
}

fn sdf() -> Vec<u8> {
    let [nx, ny] = POINTS;
    let header = format!(
        "aISO-1.0\nNumPoints = {nx}\nNumProfiles = {ny}\nXscale = 1e-6\nYscale = 1e-6\nZscale = 1e-9\nZresolution = -1\n\
         Compression = 0\nDataType = 7\nCheckType = 0\n*\n"
    );
    [header.as_bytes(), &matrix(), b"*\n"].concat()
}

fn gwy() -> Vec<u8> {
    let text = |text: &str| [text.as_bytes(), b"\0"].concat();
    let object =
        |name: &str, body: Vec<u8>| [text(name), (body.len() as u32).to_le_bytes().to_vec(), body].concat();
    let value = |name: &str, kind: u8, value: &[u8]| [&text(name)[..], &[kind], value].concat();
    let metre = object("GwySIUnit", value("unitstr", b's', &text("m")));
    let [nx, ny] = POINTS.map(|points| (points as i32).to_le_bytes());
    let data = [&((POINTS[0] * POINTS[1]) as u32).to_le_bytes()[..], &doubles()].concat();
    let field = [
        value("xres", b'i', &nx),
        value("yres", b'i', &ny),
        value("xreal", b'd', &1e-3f64.to_le_bytes()),
        value("yreal", b'd', &1e-3f64.to_le_bytes()),
        value("si_unit_xy", b'o', &metre),
        value("si_unit_z", b'o', &metre),
        value("data", b'D', &data),
    ];
    let field = object("GwyDataField", field.concat());
    [b"GWYP".to_vec(), object("GwyContainer", value("/0/data", b'o', &field))].concat()
}

fn x3p() -> Vec<u8> {
    let [nx, ny] = POINTS;
    let axis =
        |kind: &str| format!("<AxisType>{kind}</AxisType><DataType>D</DataType><Increment>1e-6</Increment>");
    let main = format!(
        "<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\"><Record1><FeatureType>SUR</FeatureType><Axes><CX>{0}</CX>\
         <CY>{0}</CY><CZ>{1}</CZ></Axes></Record1><Record3><MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>1</SizeZ>\
         </MatrixDimension><DataLink><PointDataLink>data.bin</PointDataLink></DataLink></Record3></p:ISO5436_2>",
        axis("I"),
        axis("A")
    );
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in [("main.xml", main.into_bytes()), ("data.bin", doubles())] {
        archive.start_file(name, SimpleFileOptions::default()).unwrap();
        archive.write_all(&content).unwrap();
    }
    archive.finish().unwrap().into_inner()
}
