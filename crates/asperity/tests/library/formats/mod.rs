//! Measured height maps in every format: known values, round trips, bad input of each kind.

use asperity::HeightMap;
use asperity::topography::read::{
    LengthUnits, MapFile, Marks, Metadata, ReadError, ReadOptions, height_map, metadata,
};
use asperity::topography::{Level, RoughnessParameters, Rows};
use std::path::{Path, PathBuf};

mod al3d;
mod bcr;
mod channels;
mod datx;
mod exports;
mod gsf;
mod gwy;
mod ibw;
pub mod instrument;
mod jpk;
mod metropro;
mod nanoscope;
mod nid;
mod opd;
mod park;
mod plu;
pub mod refused;
mod samples;
pub mod sdf;
mod sur;
mod text;
mod tiff;
mod vk;
mod written;
mod x3p;

const NX: usize = 5;
const NY: usize = 4;

/// Heights of the map that is written in every format, by its indices; one point is missing.
fn z(ix: usize, iy: usize) -> f64 {
    if (ix, iy) == (3, 1) { f64::NAN } else { [0.0, 1.25, -7.5, 3.0, 11.0][ix] - 2.0 * iy as f64 }
}

pub fn file(bytes: impl AsRef<[u8]>) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    // The name is arbitrary: formats are identified by their content.
    let path = folder.path().join("map.dat");
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

/// The name of the channel that is read, and the others as messages list them.
fn channels(bytes: impl AsRef<[u8]>) -> Vec<String> {
    let channel = read_head(bytes).channel.unwrap();
    std::iter::once(channel.name).chain(channel.others.iter().map(ToString::to_string)).collect()
}

fn read_head(bytes: impl AsRef<[u8]>) -> Metadata {
    let (_folder, path) = file(bytes);
    metadata(&path).unwrap()
}

fn read_map(bytes: impl AsRef<[u8]>, given: ReadOptions) -> HeightMap {
    let (_folder, path) = file(bytes);
    height_map(&path, given).unwrap()
}

fn refused(bytes: impl AsRef<[u8]>) -> ReadError {
    let (_folder, path) = file(bytes);
    let given = ReadOptions { pixel: Some([1e-6; 2]), unit: None };
    let from_head = metadata(&path).and_then(|head| Ok(head.pixel(&AS_IT_IS).or(head.pixel(&given))?));
    from_head.and_then(|_| height_map(&path, AS_IT_IS)).unwrap_err()
}

/// Asserts that `bytes` hold the map above, its heights in units of `unit` and its pixel as given.
fn assert_map(bytes: impl AsRef<[u8]>, given: ReadOptions, unit: f64, pixel: [f64; 2]) -> Metadata {
    let (head, map) = instrument::read(bytes, None, given);
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-14 * b.abs();
    let [x, y] = map.pixel();
    assert!(close(x, pixel[0]) && close(y, pixel[1]), "{x} {y}");
    for (k, &found) in map.heights().iter().enumerate() {
        let wanted = z(k / NY, k % NY) * unit;
        assert!(close(found, wanted) || found.is_nan() && wanted.is_nan(), "{k}: {found} {wanted}");
    }
    head
}

/// The map as lines of text, x running along a line.
fn lines(separator: &str, missing: &str) -> String {
    let word = |ix, iy| if z(ix, iy).is_nan() { missing.to_owned() } else { z(ix, iy).to_string() };
    let line = |iy| (0..NX).map(|ix| word(ix, iy)).collect::<Vec<_>>().join(separator) + "\n";
    (0..NY).map(line).collect()
}

const PIXEL: [f64; 2] = [2e-6, 3e-6];
/// What files state is not replaced.
const AS_IT_IS: ReadOptions = ReadOptions { pixel: None, unit: None };
const IN_NM: ReadOptions = ReadOptions { pixel: Some(PIXEL), unit: Some(LengthUnits::same(1e-9)) };

/// Heights in lines along x, as SDF and X3P store them.
fn in_lines() -> impl Iterator<Item = f64> {
    (0..NX * NY).map(|k| z(k % NX, k / NX))
}

/// Heights that mark missing points.
fn marks(heights: &[f64]) -> Option<Marks> {
    Some(Marks { heights: heights.to_vec(), words: Vec::new() })
}

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/library/formats").join(name)
}

#[test]
fn the_page_of_formats_names_every_ending() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/formats.md");
    let page = std::fs::read_to_string(page).unwrap();
    for ending in asperity::topography::read::endings() {
        assert!(page.contains(&format!("`.{ending}`")), "{ending}");
    }
}
