//! Reading `.npy` arrays and lists of asperities.

use std::path::{Path, PathBuf};

use crate::common::assert_message;
use asperity::npy::NpyError;
use asperity::progress::Silent;
use asperity::surface::{NoAsperities, Preparation, SummitSearch};
use asperity::topography::read::{LengthUnits, ReadOptions, height_map, metadata, rows};
use asperity::topography::summits::Neighbours;
use asperity::topography::{RoughnessParameters, Rows};
use asperity::{AsperityList, Ellipse, ListColumn, ListError, ListOptions, npy};

const ELLIPSES: ListOptions = ListOptions { as_ellipses: true, unit: None };

/// A `.npy` of version 1 with the given type, order and bytes.
pub(super) fn array(descr: &str, fortran: bool, shape: &str, data: &[u8]) -> Vec<u8> {
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

fn file(name: &str, bytes: &[u8]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn read(bytes: &[u8]) -> Vec<f64> {
    let (_folder, path) = file("a.npy", bytes);
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
                let (_folder, path) = file("a.npy", &array(&format!("{order}{}", $code), false, "(2, 3)", &data));
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
    let data: Vec<u8> = [1.0, f64::NAN, 1e31f64].iter().flat_map(|v| v.to_le_bytes()).collect();
    let (_folder, path) = file("a.npy", &array("<f8", false, "(1, 3)", &data));
    let mut row = [0.0; 3];
    npy::OnDisk::open(&path).unwrap().row(0, &mut row).unwrap();
    assert!(row[0] == 1.0 && row[1].is_nan() && row[2].is_nan());
    let (_folder, path) = file("a.npy", &array("<f8", true, "(1, 3)", &data));
    assert!(matches!(npy::OnDisk::open(&path), Err(NpyError::FortranOrder)));
    let (_folder, path) = file("a.npy", &array("<f8", false, "(1, 3)", &data[..23]));
    assert!(matches!(npy::OnDisk::open(&path), Err(NpyError::Truncated { .. })));
}

#[test]
fn what_is_given_beside_an_array_is_its_pixel_and_its_unit() {
    let data: Vec<u8> = [20.0f32; 12].iter().flat_map(|v| v.to_le_bytes()).collect();
    let (_folder, path) = file("map.npy", &array("<f4", false, "(3, 4)", &data));
    let pixel = Some([1e-6, 2e-6]);
    let map = height_map(&path, ReadOptions { pixel, unit: Some(LengthUnits::same(1e-9)) }).unwrap();
    assert!(map.pixel() == [1e-6, 2e-6] && map.heights().iter().all(|z| (z / 20e-9 - 1.0).abs() < 1e-15));
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
    let columns: Vec<u8> =
        [0.0f64, -10.0, 1.0, 11.0, 2.0, 12.0].iter().flat_map(|v| v.to_le_bytes()).collect();
    assert_eq!(read(&array("<f8", true, "(2, 3)", &columns)), VALUES.map(f64::from));
}

#[test]
fn a_map_has_its_pixel_and_its_missing_points() {
    let mut heights = [1.0f32; 12];
    (heights[5], heights[6]) = (f32::NAN, f32::INFINITY);
    let data: Vec<u8> = heights.iter().flat_map(|v| v.to_le_bytes()).collect();
    let (_folder, path) = file("map.npy", &array("<f4", false, "(3, 4)", &data));
    assert_eq!(metadata(&path).unwrap().points, [3, 4]);
    let map = height_map(&path, ReadOptions { pixel: Some([1e-6, 2e-6]), unit: None }).unwrap();
    assert_eq!(
        (map.points(), map.pixel(), RoughnessParameters::new(&map).missing),
        ([3, 4], [1e-6, 2e-6], 2)
    );
}

#[test]
fn what_is_no_array_is_told_apart() {
    let refused = |bytes: &[u8]| {
        let (_folder, path) = file("a.npy", bytes);
        npy::matrix(&path).unwrap_err()
    };
    let whole = array("<f8", false, "(2, 3)", &[0; 48]);
    assert!(matches!(refused(b"height,radius\n"), NpyError::NotNpy));
    assert!(matches!(refused(&array("<c16", false, "(2, 3)", &[0; 96])), NpyError::NumberType(_)));
    assert!(matches!(refused(&array("<f8", false, "(6,)", &[0; 48])), NpyError::Dimensions(_)));
    // A file truncated anywhere, also within its header, is an error, never a panic.
    for length in [0, 6, 9, 11, 40, 127, whole.len() - 1] {
        let error = refused(&whole[..length]);
        let is_short = match length {
            0 => matches!(error, NpyError::Empty),
            1..128 => matches!(error, NpyError::TruncatedHeader),
            _ => matches!(error, NpyError::Truncated { found: 47, .. }),
        };
        assert!(is_short, "{length}: {error}");
    }
    let twice = refused(&[&whole[..], &[0; 5]].concat());
    assert!(matches!(twice, NpyError::Trailing { rows: 2, columns: 3, extra: 5 }), "{twice}");
    for shape in ["(1000000, 1000000)", "(9223372036854775807, 9223372036854775807)"] {
        let error = refused(&array("<f8", false, shape, &[0; 8]));
        assert!(matches!(error, NpyError::Truncated { .. } | NpyError::TooLarge), "{shape}: {error}");
    }
    // A header that claims a length of four gigabytes.
    let mut long = b"\x93NUMPY\x02\x00".to_vec();
    long.extend(u32::MAX.to_le_bytes());
    assert!(matches!(refused(&long), NpyError::TruncatedHeader));
}

/// Heights and radii of a list.
fn spheres(path: &Path) -> (Vec<f64>, Vec<f64>) {
    let set = AsperityList::read(path, ListOptions::default(), &Silent).unwrap().set(1.0).unwrap();
    (set.heights().to_vec(), set.radii().to_vec())
}

#[test]
fn a_list_may_be_an_array_of_two_columns() {
    let data: Vec<u8> = [2e-9, 1e-6, -3e-9, 2e-6f64].iter().flat_map(|v| v.to_le_bytes()).collect();
    let (_folder, path) = file("list.npy", &array("<f8", false, "(2, 2)", &data));
    assert_eq!(spheres(&path), (vec![2e-9, -3e-9], vec![1e-6, 2e-6]));
    let (_folder, path) = file("wide.npy", &array("<f8", false, "(1, 4)", &data));
    assert_eq!(spheres(&path), (vec![2e-9], vec![1e-6]));
    let (_folder, path) = file("long.npy", &array("<f8", false, "(4, 1)", &data));
    assert!(matches!(
        AsperityList::read(&path, ListOptions::default(), &Silent),
        Err(ListError::Shape { rows: 4, columns: 1, .. })
    ));
}

/// Either memory order and byte order, more rows than are read at a time; the first bad value is named.
#[test]
fn a_long_array_is_read_in_pieces() {
    const ROWS: usize = 20_000;
    let (z, b) = (|row: usize| row as f64 * 1e-12 - 1e-9, |row: usize| 1e-6 + row as f64 * 1e-12);
    let by_rows: Vec<f64> = (0..ROWS).flat_map(|row| [z(row), b(row)]).collect();
    let by_columns: Vec<f64> = (0..ROWS).map(z).chain((0..ROWS).map(b)).collect();
    let bytes = |values: &[f64], big: bool| -> Vec<u8> {
        values.iter().flat_map(|v| if big { v.to_be_bytes() } else { v.to_le_bytes() }).collect()
    };
    let shape = format!("({ROWS}, 2)");
    for (dtype, fortran, data) in [
        ("<f8", false, bytes(&by_rows, false)),
        (">f8", false, bytes(&by_rows, true)),
        ("<f8", true, bytes(&by_columns, false)),
    ] {
        let (_folder, path) = file("long.npy", &array(dtype, fortran, &shape, &data));
        let (heights, radii) = spheres(&path);
        assert!(heights.into_iter().eq((0..ROWS).map(z)), "{dtype} {fortran}");
        assert!(radii.into_iter().eq((0..ROWS).map(b)), "{dtype} {fortran}");
    }
    let mut bad = by_rows.clone();
    (bad[2 * 19_000 + 1], bad[2 * 9_000], bad[2 * 9_000 + 1]) = (0.0, f64::NAN, -1.0);
    let (_folder, path) = file("bad.npy", &array("<f8", false, &shape, &bytes(&bad, false)));
    let error = AsperityList::read(&path, ListOptions::default(), &Silent).unwrap_err().to_string();
    assert!(error.contains("row 9001 of 20000, column `height`: found NaN"), "{error}");
}

/// Columns in any order, or four of an array; they are heights, radii and the principal curvatures.
#[test]
fn a_list_of_ellipses_has_two_curvatures_more() {
    let text = "kx,height,ky,name,radius\n1e6,2e-9,4e6,a,1e-6\n5e5,-3e-9,5e5,b,2e-6\n";
    let data: Vec<u8> = [2e-9, 1e-6, 1e6, 4e6, -3e-9, 2e-6, 5e5, 5e5f64].map(f64::to_le_bytes).concat();
    for (_folder, path) in
        [file("list.csv", text.as_bytes()), file("list.npy", &array("<f8", false, "(2, 4)", &data))]
    {
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

#[test]
fn curvatures_that_are_missing_or_none_are_refused() {
    let refused = |name: &str, bytes: &[u8]| {
        let (_folder, path) = file(name, bytes);
        AsperityList::read(&path, ELLIPSES, &Silent).unwrap_err()
    };
    let columns = [("radius", ListColumn::Kx), ("radius,ky", ListColumn::Kx), ("radius,kx", ListColumn::Ky)];
    for (others, missing) in columns {
        let header = format!("height,{others}");
        let error = refused("list.csv", format!("{header}\n").as_bytes());
        assert!(matches!(error, ListError::Column { column, .. } if column == missing), "{error}");
        assert_message(module_path!(), &header, &error.to_string());
    }
    let two: Vec<u8> = [1.0f64; 4].map(f64::to_le_bytes).concat();
    let error = refused("list.npy", &array("<f8", false, "(2, 2)", &two));
    assert!(matches!(error, ListError::Shape { rows: 2, columns: 2, .. }), "{error}");
    assert_message(module_path!(), "two columns", &error.to_string());
    for bad in ["0", "-1e5", "inf", "NaN", "1e31", "flat"] {
        let text = format!("height,radius,kx,ky\n1e-9,1e-6,1e6,1e6\n1e-9,1e-6,1e6,{bad}\n");
        let error = refused("list.csv", text.as_bytes()).to_string();
        assert!(error.contains("line 3, column `ky`"), "{error}");
        assert_message(module_path!(), bad, &error);
        let Ok(value) = bad.parse::<f64>() else { continue };
        let data: Vec<u8> = [1e-9, 1e-6, 1e6, 1e6, 1e-9, 1e-6, value, 1e6].map(f64::to_le_bytes).concat();
        let error = refused("list.npy", &array("<f8", false, "(2, 4)", &data)).to_string();
        assert!(error.contains("row 2 of 2, column `kx`"), "{error}");
    }
}

/// Another program writes the file anew, which first makes it empty: never a signal, nor the heights of two contents.
#[test]
fn a_file_that_becomes_shorter_while_it_is_read_is_an_error() {
    const SIDE: usize = 100;
    let data: Vec<u8> = (0..SIDE * SIDE).flat_map(|k| ((k * k % 97) as f64 * 1e-9).to_le_bytes()).collect();
    let (_folder, path) = file("a.npy", &array("<f8", false, "(100, 100)", &data));
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
    let data: Vec<u8> = VALUES.iter().flat_map(|&v| f64::from(v).to_le_bytes()).collect();
    for version in [2, 3] {
        let mut bytes = array("<f8", false, "(2, 3)", &data);
        bytes[6] = version;
        bytes.splice(10..10, [0, 0]);
        assert_eq!(read(&bytes), VALUES.map(f64::from));
        let (_folder, path) = file("a.npy", &bytes);
        let mut row = [0.0; 3];
        npy::OnDisk::open(&path).unwrap().row(1, &mut row).unwrap();
        assert_eq!(row, [-10.0, 11.0, 12.0]);
    }
}

#[test]
fn a_map_is_the_same_row_by_row_and_as_a_whole() {
    let data: Vec<u8> = (0..12i16).flat_map(|v| (v * v).to_le_bytes()).collect();
    let pixel = Some([1e-6, 2e-6]);
    for fortran in [false, true] {
        let (_folder, path) = file("map.npy", &array("<i2", fortran, "(3, 4)", &data));
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
