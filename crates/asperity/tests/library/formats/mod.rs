//! Measured height maps in every format: known values, round trips, bad input of each kind.

use asperity::HeightMap;
use asperity::topography::read::{
    ChannelName, LengthUnits, MapFile, Marks, Metadata, ReadError, ReadOptions, height_map, metadata,
};
use asperity::topography::summits::five_point;
use asperity::topography::{Level, Moments, RoughnessParameters, Rows};
use std::path::{Path, PathBuf};

/// Asserts that reading bytes fails with this kind of error and its message; of several bytes of one expression the value tells which.
macro_rules! assert_refused {
    ($kind:ident, $bytes:expr $(, $value:expr)?) => {
        let input = stringify!($bytes).to_owned() $(+ &format!(" of {:?}", $value))?;
        let error = $crate::formats::refused($bytes);
        assert!(matches!(error, asperity::topography::read::ReadError::$kind { .. }), "{error:?}");
        $crate::common::assert_message(module_path!(), &input, &error.to_string());
    };
}

mod al3d;
mod bcr;
mod channels;
mod damage;
mod datx;
mod exports;
mod gsf;
mod gwy;
mod ibw;
mod instrument;
mod jpk;
mod metropro;
mod nanoscope;
mod nid;
mod opd;
mod park;
mod plu;
mod samples;
mod sdf;
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

fn file(bytes: impl AsRef<[u8]>) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    // The name is arbitrary: formats are identified by their content.
    let path = folder.path().join("map.dat");
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

/// The channels of a file that are not read, as messages list them.
fn others(channel: &ChannelName) -> Vec<String> {
    channel.others.iter().map(ToString::to_string).collect()
}

fn refused(bytes: impl AsRef<[u8]>) -> ReadError {
    let (_folder, path) = file(bytes);
    let given = ReadOptions { pixel: Some([1e-6; 2]), unit: None };
    let from_head =
        metadata(&path).and_then(|head| Ok(head.pixel(&ReadOptions::default()).or(head.pixel(&given))?));
    from_head.and_then(|_| height_map(&path, ReadOptions::default())).unwrap_err()
}

/// Asserts that a file is said to be truncated where it ends at these lengths.
fn assert_truncated(whole: &[u8], lengths: impl Iterator<Item = usize>) {
    for length in lengths {
        let error = refused(&whole[..length]);
        let is_it = matches!(&error, ReadError::Corrupt(text) if text.contains("is truncated"));
        assert!(is_it, "{length}: {error:?}");
    }
}

/// Asserts that `bytes` hold the map above, its heights in units of `unit` and its pixel as given.
fn assert_map(bytes: impl AsRef<[u8]>, given: ReadOptions, unit: f64, pixel: [f64; 2]) -> Metadata {
    assert_channel(bytes, None, given, unit, pixel)
}

/// The same of a channel.
fn assert_channel(
    bytes: impl AsRef<[u8]>,
    channel: Option<&str>,
    given: ReadOptions,
    unit: f64,
    pixel: [f64; 2],
) -> Metadata {
    let (_folder, path) = file(&bytes);
    let file = MapFile { channel: channel.map(str::to_owned), ..MapFile::new(&path, given) };
    let head = file.metadata().unwrap();
    let map = file.height_map().unwrap();
    assert_eq!((head.points, map.points()), ([NX, NY], [NX, NY]));
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

fn measured(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../experiments/surfaces").join(name)
}

fn opd() -> HeightMap {
    height_map(&measured("opd-1.npy"), ReadOptions { pixel: Some([1.9673303177114576e-7; 2]), unit: None })
        .unwrap()
}

/// Asserts that a file gives the heights of opd-1 to the relative precision of its largest height.
fn assert_opd(bytes: impl AsRef<[u8]>, given: ReadOptions, precision: f64) {
    let (_folder, path) = file(bytes);
    let (opd, map) = (opd(), height_map(&path, given).unwrap());
    assert_eq!(
        (opd.points(), RoughnessParameters::new(&opd).missing),
        (map.points(), RoughnessParameters::new(&map).missing)
    );
    assert!(map.pixel().iter().all(|size| (size / opd.pixel()[0] - 1.0).abs() < 1e-9), "{:?}", map.pixel());
    let largest = opd.heights().iter().fold(0.0f64, |largest, z| largest.max(z.abs()));
    let far = |(a, b): (&f64, &f64)| (a - b).abs() > precision * largest;
    assert_eq!(opd.heights().iter().zip(map.heights()).filter(|&pair| far(pair)).count(), 0);
    let levelled = Level::Plane.apply(&map).unwrap();
    let moments = Moments::from_rows(&levelled);
    let found = [moments.sq * 1e9, moments.ssk.unwrap(), moments.sku.unwrap()];
    for (found, exact) in found.into_iter().zip([6.711, -0.367, 4.538]) {
        assert!((found - exact).abs() <= 5e-4, "{found} for {exact}");
    }
    assert_eq!(five_point(&levelled).heights.len(), 24714);
}

#[test]
fn no_damage_to_a_file_is_a_panic() {
    let numbers: Vec<u8> = in_lines().flat_map(f64::to_le_bytes).collect();
    let header = "# Width: 10 um\n# Height: 12 um\n# Value units: nm\n";
    let samples = [
        format!("{header}{}", lines("\t", "NaN")).into_bytes(),
        lines(";", "").into_bytes(),
        text::points([0.5, 0.25], |x| x).into_bytes(),
        sdf::Sdf::of("ISO-1.0", 7).text(&lines(" ", "BAD")).into_bytes(),
        sdf::Sdf::of("ISO-2.0", 7).binary(&numbers),
        x3p::X3p::linked("D", "1e-9", numbers.clone()).bytes(),
    ];
    samples.iter().for_each(|sample| damage::damage(sample));
}

#[test]
fn the_page_of_formats_names_every_ending() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/formats.md");
    let page = std::fs::read_to_string(page).unwrap();
    for ending in asperity::topography::read::endings() {
        assert!(page.contains(&format!("`.{ending}`")), "{ending}");
    }
}
