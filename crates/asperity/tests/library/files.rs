//! Reading `.npy` arrays and lists of asperities.

use std::path::Path;

use crate::formats::file;
use crate::formats::instrument::stored;
use asperity::npy::NpyError;
use asperity::progress::Silent;
use asperity::surface::{NoAsperities, Preparation, SummitSearch};
use asperity::topography::read::{LengthUnits, ReadOptions, height_map, metadata, rows};
use asperity::topography::summits::Neighbours;
use asperity::topography::{RoughnessParameters, Rows};
use asperity::{AsperityList, Ellipse, ListOptions, npy};

const ELLIPSES: ListOptions = ListOptions { as_ellipses: true, unit: None };

/// A `.npy` of version 1 with the given type, order and bytes.
pub fn array(descr: &str, fortran: bool, shape: &str, data: &[u8]) -> Vec<u8> {
    let fortran = if fortran { "True" } else { "False" };
    let mut head = format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}");
    while (10 + head.len()) % 64 != 63 {
        head.push(' ');
    }
    head.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((head.len() as u16).to_le_bytes());
    bytes.extend(head.bytes());
    bytes.extend(data);
    bytes
}

fn doubles(values: &[f64]) -> Vec<u8> {
    stored::<f64>(values.iter().copied(), false)
}

fn read(bytes: &[u8]) -> Vec<f64> {
    let (_folder, path) = file(bytes);
    let matrix = npy::matrix(&path).unwrap();
    assert_eq!((matrix.rows, matrix.columns), (2, 3));
    matrix.values
}

const VALUES: [i8; 6] = [0, 1, 2, -10, 11, 12];

#[test]
fn rows_on_disk_are_those_of_the_array() {
    macro_rules! check {
        ($($kind:ty, $code:literal;)*) => {$(
            for (order, big) in [("<", false), (">", true)] {
                let bytes = |v: i8| {
                    let value = v as $kind;
                    if big { value.to_be_bytes() } else { value.to_le_bytes() }
                };
                let data: Vec<u8> = VALUES.iter().flat_map(|&v| bytes(v)).collect();
                let (_folder, path) = file(array(&format!("{order}{}", $code), false, "(2, 3)", &data));
                let matrix = npy::matrix(&path).unwrap();
                assert_eq!(matrix.values, VALUES.map(|v| v as $kind as f64));
                let on_disk = npy::OnDisk::open(&path).unwrap();
                assert_eq!((on_disk.points(), on_disk.precision()), ([2, 3], matrix.precision));
                let mut row = [0.0; 3];
                for ix in 0..2 {
                    on_disk.row(ix, &mut row).unwrap();
                    assert_eq!(row, matrix.values[3 * ix..][..3]);
                }
            }
        )*};
    }
    check! {
        f32, "f4"; f64, "f8"; i8, "i1"; i16, "i2"; i32, "i4"; i64, "i8"; u8, "u1"; u16, "u2"; u32, "u4"; u64, "u8";
    }
    let data = doubles(&[1.0, f64::NAN, 1e31]);
    let (_folder, path) = file(array("<f8", false, "(1, 3)", &data));
    let mut row = [0.0; 3];
    npy::OnDisk::open(&path).unwrap().row(0, &mut row).unwrap();
    assert!(row[0] == 1.0 && row[1].is_nan() && row[2].is_nan());
    let (_folder, path) = file(array("<f8", true, "(1, 3)", &data));
    assert!(matches!(npy::OnDisk::open(&path), Err(NpyError::FortranOrder)));
    let (_folder, path) = file(array("<f8", false, "(1, 3)", &data[..23]));
    assert!(matches!(npy::OnDisk::open(&path), Err(NpyError::Truncated { .. })));
}

#[test]
fn what_is_given_beside_an_array_is_its_pixel_and_its_unit() {
    let mut heights = [20.0; 12];
    (heights[5], heights[6]) = (f64::NAN, f64::INFINITY);
    let (_folder, path) = file(array("<f4", false, "(3, 4)", &stored::<f32>(heights.into_iter(), false)));
    assert_eq!(metadata(&path).unwrap().points, [3, 4]);
    let pixel = Some([1e-6, 2e-6]);
    let map = height_map(&path, ReadOptions { pixel, unit: Some(LengthUnits::same(1e-9)) }).unwrap();
    assert_eq!((map.points(), map.pixel()), ([3, 4], [1e-6, 2e-6]));
    let of_20_nm = map.heights().iter().filter(|&&z| (z / 20e-9 - 1.0).abs() < 1e-15).count();
    assert_eq!((of_20_nm, RoughnessParameters::new(&map).missing), (10, 2));
    let refused = |given| height_map(&path, given).unwrap_err().to_string();
    assert!(refused(ReadOptions { pixel: None, unit: None }).contains("holds no pixel size"));
    // Twenty metres: micrometres without their unit.
    assert!(
        refused(ReadOptions { pixel, unit: None }).contains("holds a height of 2e1 m; allowed: at most 10 m")
    );
}

#[test]
fn fortran_order_is_turned_so_that_the_first_index_is_x() {
    // Columns first: (0, -10), (1, 11), (2, 12).
    let columns = doubles(&[0.0, -10.0, 1.0, 11.0, 2.0, 12.0]);
    assert_eq!(read(&array("<f8", true, "(2, 3)", &columns)), VALUES.map(f64::from));
}

/// Heights and radii of a list.
fn spheres(path: &Path) -> (Vec<f64>, Vec<f64>) {
    let set = AsperityList::read(path, ListOptions::default(), &Silent).unwrap().set(1.0).unwrap();
    (set.heights().to_vec(), set.radii().to_vec())
}

/// Either memory order and byte order, more rows than are read at a time; the first bad value is named.
#[test]
fn a_long_array_is_read_in_pieces() {
    const ROWS: usize = 20_000;
    let (z, b) = (|row: usize| row as f64 * 1e-12 - 1e-9, |row: usize| 1e-6 + row as f64 * 1e-12);
    let by_rows: Vec<f64> = (0..ROWS).flat_map(|row| [z(row), b(row)]).collect();
    let by_columns: Vec<f64> = (0..ROWS).map(z).chain((0..ROWS).map(b)).collect();
    let bytes = |values: &[f64], big: bool| stored::<f64>(values.iter().copied(), big);
    let shape = format!("({ROWS}, 2)");
    for (dtype, fortran, data) in [
        ("<f8", false, bytes(&by_rows, false)),
        (">f8", false, bytes(&by_rows, true)),
        ("<f8", true, bytes(&by_columns, false)),
    ] {
        let (_folder, path) = file(array(dtype, fortran, &shape, &data));
        let (heights, radii) = spheres(&path);
        assert!(heights.into_iter().eq((0..ROWS).map(z)), "{dtype} {fortran}");
        assert!(radii.into_iter().eq((0..ROWS).map(b)), "{dtype} {fortran}");
    }
    let mut bad = by_rows.clone();
    (bad[2 * 19_000 + 1], bad[2 * 9_000], bad[2 * 9_000 + 1]) = (0.0, f64::NAN, -1.0);
    let (_folder, path) = file(array("<f8", false, &shape, &bytes(&bad, false)));
    let error = AsperityList::read(&path, ListOptions::default(), &Silent).unwrap_err().to_string();
    assert!(error.contains("row 9001 of 20000, column `height`: found NaN"), "{error}");
}

/// Columns in any order, or four of an array; they are heights, radii and the principal curvatures.
#[test]
fn a_list_of_ellipses_has_two_curvatures_more() {
    let text = "kx,height,ky,name,radius\n1e6,2e-9,4e6,a,1e-6\n5e5,-3e-9,5e5,b,2e-6\n";
    let data = doubles(&[2e-9, 1e-6, 1e6, 4e6, -3e-9, 2e-6, 5e5, 5e5]);
    for (_folder, path) in [file(text), file(array("<f8", false, "(2, 4)", &data))] {
        let set = AsperityList::read(&path, ELLIPSES, &Silent).unwrap().set(1.0).unwrap();
        assert_eq!(set.ellipses(), Some(&[Ellipse::new(1e6, 4e6), Ellipse::new(5e5, 5e5)][..]));
        assert_eq!((set.heights(), set.radii()), (&[2e-9, -3e-9][..], &[1e-6, 2e-6][..]));
        // Spheres ignore the curvatures.
        assert_eq!(spheres(&path), (vec![2e-9, -3e-9], vec![1e-6, 2e-6]));
        assert_eq!(
            AsperityList::read(&path, ListOptions::default(), &Silent).unwrap().set(1.0).unwrap().ellipses(),
            None
        );
    }
    assert_eq!((Ellipse::new(1e6, 4e6).mean_curvature, Ellipse::new(4e6, 1e6).curvature_ratio), (2.5e6, 4.0));
}

/// Another program writes the file anew, which first makes it empty: never a signal, nor the heights of two contents.
#[test]
fn a_file_that_becomes_shorter_while_it_is_read_is_an_error() {
    const SIDE: usize = 100;
    let data = stored::<f64>((0..SIDE * SIDE).map(|k| (k * k % 97) as f64 * 1e-9), false);
    let (_folder, path) = file(array("<f8", false, "(100, 100)", &data));
    let on_disk = npy::OnDisk::open(&path).unwrap();
    let mut row = [0.0; SIDE];
    let map = rows(&path, ReadOptions { pixel: Some([1e-6; 2]), unit: None }, &Silent).unwrap();
    map.read(99, &mut row);
    assert!(map.is_whole() && row.iter().all(|z| z.is_finite()));
    std::fs::File::options().write(true).open(&path).unwrap().set_len(5000).unwrap();
    on_disk.row(0, &mut row).unwrap();
    assert!(matches!(on_disk.row(99, &mut row), Err(NpyError::Shortened)));
    let mut pieces = [&mut row[..1]];
    assert!(matches!(on_disk.columns(99, &mut pieces), Err(NpyError::Shortened)));
    let search = SummitSearch::new(Preparation::none(Neighbours::Four));
    assert!(matches!(search.surface("a", &*map), Err(NoAsperities::Shortened)));
    assert!(!map.is_whole());
}

/// Versions 2 and 3 store the length of the header in four bytes.
#[test]
fn later_versions_have_a_longer_head() {
    let data = doubles(&VALUES.map(f64::from));
    for version in [2, 3] {
        let mut bytes = array("<f8", false, "(2, 3)", &data);
        bytes[6] = version;
        bytes.splice(10..10, [0, 0]);
        assert_eq!(read(&bytes), VALUES.map(f64::from));
        let (_folder, path) = file(&bytes);
        let mut row = [0.0; 3];
        npy::OnDisk::open(&path).unwrap().row(1, &mut row).unwrap();
        assert_eq!(row, [-10.0, 11.0, 12.0]);
    }
}

#[test]
fn a_map_is_the_same_row_by_row_and_as_a_whole() {
    let data = stored::<i16>((0..12).map(|v| f64::from(v * v)), false);
    let pixel = Some([1e-6, 2e-6]);
    for fortran in [false, true] {
        let (_folder, path) = file(array("<i2", fortran, "(3, 4)", &data));
        let in_metres = ReadOptions { pixel, unit: None };
        for error in [height_map(&path, in_metres).err(), rows(&path, in_metres, &Silent).err()] {
            assert!(error.unwrap().to_string().contains("holds a height of 1.21e2 m"));
        }
        let given = ReadOptions { pixel, unit: Some(LengthUnits::same(1e-9)) };
        let (whole, rows) = (height_map(&path, given).unwrap(), rows(&path, given, &Silent).unwrap());
        assert_eq!((whole.points(), whole.pixel()), (rows.points(), rows.pixel()));
        // Whole numbers are exact, scaled ones are rounded.
        assert_eq!((whole.precision(), rows.precision()), (f64::EPSILON, f64::EPSILON));
        let mut row = [0.0; 4];
        for ix in 0..3 {
            rows.read(ix, &mut row);
            assert_eq!(row, whole.heights()[4 * ix..][..4]);
        }
    }
}
