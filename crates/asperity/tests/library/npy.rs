//! Headers of `.npy` files: round trips, and errors for damaged ones.

use asperity::HeightMap;
use asperity::npy::{Header, HeaderError, NpyError, OnDisk, matrix, write};
use asperity::progress::Silent;
use asperity::topography::read::{LengthUnits, MapFile, Marks, ReadError, ReadOptions, height_map};

use super::files::array;
use crate::common::assert_message;

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

#[test]
fn what_a_header_says_wrongly_is_named() {
    let of = |entries: &str| format!("{{'descr': '<f8', 'fortran_order': False, {entries}}}");
    let of_type = |descr: &str| format!("{{'descr': {descr}, 'fortran_order': False, 'shape': (2, 3)}}");
    for text in [
        "{'fortran_order': False, 'shape': (2, 3)}",
        "{'descr': '<f8', 'shape': (2, 3)}",
        "{'descr': '<f8', 'fortran_order': 0, 'shape': (2, 3)}",
        &of(""),
        &of("'shape': (-2, 3)"),
        &of("'shape': 6"),
        &of("'shape': (6)"),
        &of("'shape': ()"),
        &of("'shape': (1, 2, 3)"),
        &of("'shape': (2, 99999999999999999999)"),
        &of("'shape': (2, 3)} or more"),
        &of("'shape': (2, 3"),
        &of("'shape': (2 3)"),
        &of("shape: (2, 3)"),
        &of("'shape': T"),
        &of_type("8"),
        &of_type("[('x', '<f4'), ('é\\'', '<f4')]"),
        &of_type("'|f8'"),
        &of_type("'<f2'"),
        &of_type("'|b1'"),
        &of_type("'<f8\\'"),
        "'descr'",
        "{'descr'",
        "{",
        "",
    ] {
        assert_message(module_path!(), text, &header(&under(text)).unwrap_err().to_string());
    }
    assert!(header(&under(&of(&"(".repeat(60_000)))).is_err());
    let mut bytes = array("<f8", false, "(2, 3)", &[0; 48]);
    (bytes[6], bytes[7]) = (4, 1);
    assert!(matches!(header(&bytes), Err(NpyError::Header(HeaderError::Version(4, 1)))));
    let mut bytes = array("<f8", false, "(2, 3)", &[0; 48]);
    bytes[12] = 0xff;
    assert!(matches!(header(&bytes), Err(NpyError::Header(HeaderError::Encoding))));
    let long = [b"\x93NUMPY\x02\x00", &(1u32 << 21).to_le_bytes()[..], &vec![b' '; 1 << 21]].concat();
    assert!(matches!(header(&long), Err(NpyError::Header(HeaderError::TooLong(2097152)))));
}

#[test]
fn no_damage_to_an_array_is_a_panic() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("array.npy");
    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    let mut read = 0;
    for (descr, is_fortran) in [("<f8", false), (">f8", true)] {
        let sample = array(descr, is_fortran, "(4, 5)", &[0x3f; 160]);
        for _ in 0..2000 {
            let mut bytes = sample.clone();
            for _ in 0..=random(3) {
                let place = random(bytes.len());
                match random(4) {
                    0 => bytes[place] = random(256) as u8,
                    1 => bytes[place] = b"0123456789(){}[]',:<>|ufi TF-"[random(29)],
                    2 if random(10) == 0 => bytes.truncate(place + 1),
                    _ => drop(bytes.splice(place..place, [bytes[place], b'9'])),
                }
            }
            std::fs::write(&path, &bytes).unwrap();
            let (matrix, on_disk) = (matrix(&path), OnDisk::in_either_order(&path));
            assert_eq!(matrix.is_ok(), on_disk.is_ok());
            if let (Ok(matrix), Ok(on_disk)) = (matrix, on_disk) {
                assert_eq!([matrix.rows, matrix.columns], on_disk.points());
                assert_eq!(matrix.values.len(), matrix.rows * matrix.columns);
                read += 1;
            }
        }
    }
    // Numbers and padding may be anything.
    assert!(read > 100, "{read}");
}

#[test]
fn what_is_written_reads_back_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.npy");
    let heights =
        vec![0.1, -2.5e-9, f64::MIN_POSITIVE, 3.0, f64::NAN, -0.0, 1e-300, 7.0, 1.0 / 3.0, 1.0, 2.0, 3.0];
    let map = HeightMap::new([3, 4], [1e-6, 2e-6], heights, f64::EPSILON).unwrap();
    map.write_npy(&path).unwrap();
    let found = height_map(&path, ReadOptions { pixel: Some([1e-6, 2e-6]), unit: None }).unwrap();
    assert_eq!(found.points(), map.points());
    assert!(found.heights().iter().zip(map.heights()).all(|(a, b)| a.to_bits() == b.to_bits()));
    // The numbers begin at a multiple of 64 bytes.
    assert_eq!(std::fs::metadata(&path).unwrap().len(), 128 + 12 * 8);
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
    let mut bytes = Vec::new();
    write(&mut bytes, [0, 3], []).unwrap();
    assert_eq!((header(&bytes).unwrap().rows, bytes.len()), (0, 128));
}
