//! Headers of `.npy` files, and arrays that stay on disk.

use asperity::npy::{Header, NpyError, write};
use asperity::progress::Silent;
use asperity::topography::read::{LengthUnits, MapFile, Marks, ReadError, ReadOptions};

use crate::files::array;
use crate::formats::refused::Good;

fn header(bytes: &[u8]) -> Result<Header, NpyError> {
    Header::parse(bytes, bytes.len() as u64)
}

/// A version 1.0 file of six float64 under this text.
fn under(text: &str) -> Vec<u8> {
    let length = (text.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], text.as_bytes(), &[0; 48]].concat()
}

#[test]
fn a_header_may_be_written_in_any_way_of_python() {
    for text in [
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n",
        "{'shape':(2,3),'descr':'<f8','fortran_order':False}",
        " { \"shape\" : [ 2 , 3 ] , \"fortran_order\" : False , \"descr\" : \"<f8\" , 'more' : {} } \n",
    ] {
        let found = header(&under(text)).unwrap();
        assert_eq!((found.rows, found.columns, found.is_fortran()), (2, 3, false), "{text}");
    }
    assert!(header(&under("{'descr': '|u1', 'fortran_order': True, 'shape': (6, 8)}")).unwrap().is_fortran());
}

pub fn good() -> Vec<Good> {
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3)}";
    let whole = array("<f8", false, "(2, 3)", &[0; 48]);
    let long = [b"\x93NUMPY\x02\x00", &(1u32 << 21).to_le_bytes()[..], &vec![b' '; 1 << 21]].concat();
    vec![
        Good {
            file: |text| under(std::str::from_utf8(&text).unwrap()),
            ..Good::whole("header of npy", header)
        },
        Good::whole("npy", &*whole),
        Good::whole("npy and five bytes", [whole, vec![0; 5]].concat()),
        Good::whole("npy of a long header", long),
        Good::whole("npy of brackets", under(&header.replace("(2, 3)", &"(".repeat(60_000)))),
    ]
}

#[test]
fn what_is_no_array_is_told_apart() {
    assert!(matches!(header(b"height,radius\n"), Err(NpyError::NotNpy)));
    assert!(matches!(header(b""), Err(NpyError::Empty)));
}

#[test]
fn marks_of_missing_points_of_an_array_on_disk() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.npy");
    let mut heights: Vec<f64> = (0..30).map(|k| f64::from(k * k % 17)).collect();
    heights[7] = -9999.0;
    write(std::fs::File::create(&path).unwrap(), [5, 6], heights).unwrap();
    let options = ReadOptions { pixel: Some([1e-6, 2e-6]), unit: Some(LengthUnits::same(1e-9)) };
    let straight = MapFile::new(&path, options);
    let error = straight.rows(&Silent).err().unwrap();
    assert!(matches!(error, ReadError::Mark { value: -9999.0, count: 1, .. }), "{error}");
    let missing = Some(Marks { heights: vec![-9999.0], words: Vec::new() });
    let straight = MapFile { missing, ..straight };
    let words = Marks { heights: Vec::new(), words: vec!["***".to_owned()] };
    let error = MapFile { missing: Some(words), ..straight.clone() }.metadata().unwrap_err();
    assert_eq!(
        error.to_string(),
        "is .npy, which holds numbers only; allowed: numbers for its missing points"
    );
    let turned = MapFile { transpose: true, ..straight.clone() };
    assert!(straight.stays_on_disk().unwrap() && !turned.stays_on_disk().unwrap());
    let map = straight.rows(&Silent).unwrap();
    let mut row = [0.0; 6];
    map.read(1, &mut row);
    assert!(row[1].is_nan() && row[0] == 36.0 % 17.0 * 1e-9, "{row:?}");
    let turned = turned.height_map().unwrap();
    assert_eq!((turned.points(), turned.pixel()), ([6, 5], [1e-6, 2e-6]));
    assert!(turned.heights()[5 + 1].is_nan() && turned.heights()[1] == row[0]);
}

#[test]
fn an_array_has_as_many_values_as_its_shape_says() {
    for count in [5, 7] {
        let error = write(Vec::new(), [2, 3], vec![0.0; count]).unwrap_err();
        assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput);
    }
    // The numbers begin at a multiple of 64 bytes.
    let mut bytes = Vec::new();
    write(&mut bytes, [0, 3], []).unwrap();
    assert_eq!((header(&bytes).unwrap().rows, bytes.len()), (0, 128));
}
