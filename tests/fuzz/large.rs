//! Large files of several formats, which hold as many points as they say.

use std::fmt::Write as _;
use std::io::Cursor;

use asperity::HeightMap;
use asperity::topography::write::MapFormat;

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

/// The name of a target, and what makes a file for it.
type LargeFile = (&'static str, fn() -> Vec<u8>);

pub const FILES: [LargeFile; 6] = [
    ("npy", npy),
    ("text", matrix),
    ("text", columns),
    ("sdf", sdf),
    ("gwy", || written("gwy")),
    ("x3p", || written("x3p")),
];

/// In Fortran order, which is read into memory.
fn npy() -> Vec<u8> {
    let [nx, ny] = POINTS;
    let numbers: Vec<u8> = heights().flat_map(|z| (1e-9 * f64::from(z)).to_le_bytes()).collect();
    let text = format!("{{'descr': '<f8', 'fortran_order': True, 'shape': ({nx}, {ny}), }}\n");
    [b"\x93NUMPY\x01\x00", &(text.len() as u16).to_le_bytes()[..], text.as_bytes(), &numbers].concat()
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

fn written(ending: &str) -> Vec<u8> {
    let heights = heights().map(|z| 1e-9 * f64::from(z)).collect();
    let map = HeightMap::new(POINTS, [1e-6; 2], heights, 0.0).expect("a map");
    let mut file = Cursor::new(Vec::new());
    let format = MapFormat::of_ending(ending).expect("a format");
    format.write(&mut file, &map, &[]).expect("a file in memory");
    file.into_inner()
}
