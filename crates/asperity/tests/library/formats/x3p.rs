//! X3P.

use asperity::topography::RoughnessParameters;
use std::f64::consts::TAU;
use std::io::Write;

use super::instrument::{assert_heights, stored};
use super::*;

#[test]
fn x3p_of_an_instrument_has_its_known_statistics() {
    let path = measured("x3p-2.x3p");
    assert_eq!(metadata(&path).unwrap().points, [650, 650]);
    let map = height_map(&path, ReadOptions::default()).unwrap();
    assert_eq!((map.points(), RoughnessParameters::new(&map).missing), ([650, 650], 0));
    let pixel = map.pixel().map(|size| (size * 1e10).round() / 10.0);
    assert_eq!(pixel, [127.7, 314.6]);
    let levelled = Level::Plane.apply(&map).unwrap();
    let moments = Moments::from_rows(&levelled);
    let found = [moments.sq * 1e9, moments.ssk.unwrap(), moments.sku.unwrap()];
    for (found, (exact, digit)) in found.into_iter().zip([(77.19, 5e-3), (-0.379, 5e-4), (2.985, 5e-4)]) {
        assert!((found - exact).abs() <= digit, "{found} for {exact}");
    }
    assert_eq!(five_point(&levelled).heights.len(), 2916);
}

#[test]
fn x3p_samples_hold_the_heights_they_were_made_of() {
    let wave = |x: f64, y: f64| {
        1e-6 * ((TAU * x / 24e-6).cos() * (TAU * y / 16e-6).cos() + 0.3 * (TAU * x / 9e-6).sin())
    };
    let none = (0..0, 0..0);
    let hole = (70..85, 40..52);
    for (name, points, missing, offset, digit) in [
        ("surface_binary", [200, 150], hole.clone(), 0.0, 2e-11),
        ("surface_binary_2017", [200, 150], hole.clone(), 0.0, 2e-11),
        ("surface_xml", [200, 150], hole, 0.0, 2e-11),
        ("surface_int32_binary", [120, 90], (40..50, 30..36), 0.0, 3e-16),
        ("surface_int32_xml", [120, 90], (40..50, 30..36), 0.0, 3e-16),
        ("surface_placed_binary", [120, 90], none.clone(), 1.0, 1e-20),
        ("surface_extensions_binary", [100, 80], none, 0.0, 1e-13),
    ] {
        let path = sample(&format!("{name}.x3p"));
        assert_eq!(metadata(&path).unwrap().points, points);
        let map = height_map(&path, ReadOptions::default()).unwrap();
        assert_eq!((map.points(), map.pixel(), map.offset()), (points, [1e-6; 2], offset));
        assert_eq!(RoughnessParameters::new(&map).missing, missing.0.len() * missing.1.len(), "{name}");
        for (k, found) in map.heights().iter().enumerate() {
            let (ix, iy) = (k / points[1], k % points[1]);
            if missing.0.contains(&ix) && missing.1.contains(&iy) {
                assert!(found.is_nan(), "{name} {ix} {iy}");
            } else {
                let wanted = wave(ix as f64 * 1e-6, iy as f64 * 1e-6);
                assert!((found - wanted).abs() <= digit, "{name} {ix} {iy}: {found} {wanted}");
            }
        }
    }
    for (name, words) in [("profile_int16_binary", "FeatureType = PRF"), ("point_cloud_int16_binary", "PCL")]
    {
        let error = metadata(&sample(&format!("{name}.x3p"))).unwrap_err();
        assert!(matches!(&error, ReadError::Unsupported(text) if text.contains(words)), "{error}");
    }
}

/// An X3P file that is written by hand; `axes` are increments and offset of z.
pub struct X3p {
    data_type: &'static str,
    increment: &'static str,
    offset: &'static str,
    size: [u64; 3],
    record3: String,
    files: Vec<(&'static str, Vec<u8>)>,
}

impl X3p {
    pub fn linked(data_type: &'static str, increment: &'static str, bytes: Vec<u8>) -> Self {
        let record3 = "<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink>".to_owned();
        let files = vec![("bindata/data.bin", bytes)];
        Self { data_type, increment, offset: "", size: [NX as u64, NY as u64, 1], record3, files }
    }

    fn xml(&self) -> String {
        let Self { data_type, increment, offset, size: [nx, ny, nz], record3, .. } = self;
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">\
             <Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>\
             <CX><AxisType>I</AxisType><DataType>D</DataType><Increment>2e-6</Increment><Offset>7</Offset></CX>\
             <CY><AxisType>I</AxisType><DataType>D</DataType><Increment>3e-6</Increment><Offset>7</Offset></CY>\
             <CZ><AxisType>A</AxisType><DataType>{data_type}</DataType><!-- none may be there -->\
             <Increment>{increment}</Increment><Offset>{offset}</Offset></CZ></Axes></Record1><Record3>\
             <MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>{nz}</SizeZ></MatrixDimension>\
             {record3}</Record3></p:ISO5436_2>"
        )
    }

    pub fn bytes(&self) -> Vec<u8> {
        zipped(&[&[("main.xml", self.xml().into_bytes())], &self.files[..]].concat())
    }
}

/// The map in nanometres.
fn whole() -> X3p {
    X3p::linked("D", "1e-9", stored::<f64>(in_lines(), false))
}

/// Its heights in metres.
fn metres() -> Vec<u8> {
    stored::<f64>(in_lines().map(|z| z * 1e-9), false)
}

fn zipped(files: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, content) in files {
        archive.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(content).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

/// No number depends on the name of the root, on its namespaces or on what there is one of.
#[test]
fn names_that_no_number_depends_on_are_free() {
    let x3p = whole();
    let data = x3p.files[0].1.clone();
    for (from, to) in [
        ("p:ISO5436_2", "ISO5436"),
        ("p:ISO5436_2", "p:anything"),
        ("<FeatureType>SUR</FeatureType>", ""),
        ("<FeatureType>SUR", "<FeatureType>sur"),
        ("<AxisType>I</AxisType>", ""),
        ("<Revision>ISO5436 - 2000</Revision>", ""),
    ] {
        let main = x3p.xml().replace(from, to).into_bytes();
        let bytes = zipped(&[("main.xml", main), ("bindata/data.bin", data.clone())]);
        assert_map(bytes, ReadOptions::default(), 1e-9, PIXEL);
    }
}

/// Programs that edit main.xml leave its check sum as it was; the heights have one of their own.
#[test]
fn a_stale_check_sum_is_a_note_where_that_of_the_heights_is_right() {
    use md5::{Digest, Md5};
    let x3p = whole();
    let data = x3p.files[0].1.clone();
    let sum: String = Md5::digest(&data).iter().map(|byte| format!("{byte:02X}")).collect();
    let with = |sum: &str, data: &[u8]| {
        let md5 = format!("</PointDataLink><MD5ChecksumPointData>{sum}</MD5ChecksumPointData>");
        let main = x3p.xml().replace("</PointDataLink>", &md5).into_bytes();
        let stale = b"00 *main.xml".to_vec();
        zipped(&[("main.xml", main), ("md5checksum.hex", stale), ("bindata/data.bin", data.to_vec())])
    };
    let head = assert_map(with(&sum, &data), ReadOptions::default(), 1e-9, PIXEL);
    assert!(
        matches!(&head.notes[..], [note] if note.starts_with("was changed after its check sums")),
        "{head:?}"
    );
    let mut other = data.clone();
    other[3] ^= 1;
    assert_refused!(Corrupt, with(&sum, &other));
    assert_refused!(Corrupt, with("", &data));
    // The sum of the heights, as SurfaceTopography writes it.
    let of_data = format!("{sum} *bindata/data.bin").into_bytes();
    let main = x3p.xml().into_bytes();
    let other = zipped(&[("main.xml", main), ("md5checksum.hex", of_data), ("bindata/data.bin", data)]);
    assert!(assert_map(other, ReadOptions::default(), 1e-9, PIXEL).notes.is_empty());
}

/// A unit and a pixel that are given count in place of those of the file.
#[test]
fn what_the_file_states_can_be_replaced() {
    let x3p = whole().bytes();
    let [x, y] = PIXEL;
    let of = |pixel, unit| ReadOptions { pixel, unit };
    let mm = Some(LengthUnits::same(1e-3));
    let head = assert_map(&x3p, of(None, mm), 1e-12, [x * 1e-3, y * 1e-3]);
    assert_eq!(head.replaced_units(&of(None, mm)), Some(LengthUnits::same(1.0)));
    assert_map(&x3p, of(Some([1e-6; 2]), None), 1e-9, [1e-6; 2]);
    assert_map(&x3p, of(Some([1e-6; 2]), mm), 1e-12, [1e-6; 2]);
    assert_map(&x3p, of(None, Some(LengthUnits { xy: 1e-3, z: 1.0 })), 1e-9, [x * 1e-3, y * 1e-3]);
    assert_map(&x3p, of(None, Some(LengthUnits { xy: 1.0, z: 1e-3 })), 1e-12, PIXEL);
    let metres = of(None, Some(LengthUnits::same(1.0)));
    assert_eq!(assert_map(&x3p, metres, 1e-9, PIXEL).replaced_units(&metres), None);
}

/// An archive of the folder rather than of its content.
#[test]
fn x3p_in_a_folder_of_the_archive_is_read() {
    let x3p = whole();
    let data = x3p.files[0].1.clone();
    let main = || x3p.xml().into_bytes();
    let folder = [("scan/main.xml", main()), ("scan/bindata/data.bin", data)];
    assert_map(zipped(&folder), ReadOptions::default(), 1e-9, PIXEL);
    let two = zipped(&[("a/main.xml", main()), ("b/main.xml", main())]);
    assert_refused!(Mismatch, two);
    let packed = zipped(&[("scan.x3p", x3p.bytes())]);
    assert_refused!(Mismatch, packed);
}

#[test]
fn x3p_of_every_data_type_scaled_and_moved() {
    // Eighths of a nanometre below 2 um.
    macro_rules! check {
        ($($kind:ty, $code:literal;)*) => {$(
            let numbers = stored::<$kind>(in_lines().map(|z| 8.0 * z), false);
            let mut x3p = X3p::linked($code, "1.25e-10", numbers);
            x3p.offset = "-2e-6";
            x3p.record3 = x3p.record3.replace("</DataLink>", "<ValidPointsLink>./bindata\\valid.bin</ValidPointsLink></DataLink>");
            // One bit a point, the lowest first; the point (3, 1) is number 8.
            x3p.files.push(("bindata/valid.bin", vec![0xff, 0xfe, 0x0f]));
            assert_heights(x3p.bytes(), None, PIXEL, |ix, iy| 1e-9 * z(ix, iy) - 2e-6);
        )*};
    }
    check! { i16, "I"; i32, "L"; f32, "F"; f64, "D"; }
    // NaN and the marks that instruments write; no increment is one metre.
    assert_map(X3p::linked("D", "", metres()).bytes(), ReadOptions::default(), 1e-9, PIXEL);
    let marked: Vec<u8> =
        in_lines().map(|z| if z.is_nan() { 1e10 } else { z * 1e-9 }).flat_map(f64::to_le_bytes).collect();
    assert_map(X3p::linked("D", "1", marked).bytes(), ReadOptions::default(), 1e-9, PIXEL);
    let mut listed = X3p::linked("D", "1e-9", Vec::new());
    listed.record3 = in_lines()
        .map(|z| if z.is_nan() { "<Datum/>\n".to_owned() } else { format!("<Datum> {z} </Datum>\n") })
        .collect();
    listed.record3 = format!("<DataList>{}</DataList>", listed.record3);
    let head = assert_map(listed.bytes(), ReadOptions::default(), 1e-9, PIXEL);
    assert!(head.has_unit);
    // An encoding other than declared, after a byte order mark.
    let bom = zipped(&[("main.xml", format!("\u{feff}{}", listed.xml()).into_bytes())]);
    assert_map(bom, ReadOptions::default(), 1e-9, PIXEL);
    let mut latin = listed.xml().into_bytes();
    latin.extend(b"<!-- \xb5m -->");
    assert_map(zipped(&[("main.xml", latin)]), ReadOptions::default(), 1e-9, PIXEL);
}

#[test]
fn bad_x3p_is_refused() {
    let numbers = metres();
    let whole = X3p::linked("D", "1", numbers.clone());
    let changed = |from: &str, to: &str| {
        assert!(whole.xml().contains(from));
        zipped(&[
            ("main.xml", whole.xml().replace(from, to).into_bytes()),
            ("bindata/data.bin", numbers.clone()),
        ])
    };
    assert_refused!(Mismatch, zipped(&[("word/document.xml", vec![])]));
    assert_refused!(Mismatch, zipped(&[("main.xml", b"<html/>".to_vec())]));
    assert_refused!(Unsupported, changed("SUR", "PRF"));
    assert_refused!(Unsupported, changed("<AxisType>I", "<AxisType>A"));
    assert_refused!(Unsupported, X3p::linked("Q", "1", vec![]).bytes());
    assert_refused!(Unsupported, changed("<SizeZ>1", "<SizeZ>2"));
    assert_refused!(TooTall, X3p::linked("D", "1e9", numbers.clone()).bytes());
    assert_refused!(Corrupt, changed("</Record3>", ""));
    assert_refused!(Corrupt, changed("<p:ISO5436_2", "<!DOCTYPE a [<!ENTITY b \"c\">]><p:ISO5436_2"));
    assert_refused!(Corrupt, changed("<Increment>2e-6</Increment>", ""));
    assert_refused!(Corrupt, changed("2e-6", "wide"));
    assert_refused!(Corrupt, changed("3e-6", "-3e-6"));
    assert_refused!(Corrupt, changed("<SizeX>5", "<SizeX>-5"));
    assert_refused!(Corrupt, changed("bindata/data.bin", "none.bin"));
    let md5 = "</PointDataLink><MD5ChecksumPointData>0123</MD5ChecksumPointData>";
    assert_refused!(Corrupt, changed("</PointDataLink>", md5));
    assert_refused!(
        Corrupt,
        zipped(&[
            ("main.xml", whole.xml().into_bytes()),
            ("md5checksum.hex", b"00 *main.xml".to_vec()),
            ("bindata/data.bin", numbers.clone()),
        ])
    );
    assert_refused!(Corrupt, changed("<SizeY>4", "<SizeY>5"));
    assert_refused!(Corrupt, changed("<SizeY>4", "<SizeY>3"));
    let huge = changed("<SizeX>5", "<SizeX>1000000000").to_vec();
    assert_refused!(Corrupt, huge);
    assert_refused!(Corrupt, changed("<SizeX>5", "<SizeX>10000000000000000000"));
    let list = "<DataList><Datum>1</Datum></DataList>";
    let link = &whole.record3;
    assert_refused!(Corrupt, changed(link, list));
    assert_refused!(Corrupt, changed(link, &list.replace('1', "1;2")));
    // A main.xml that unpacks to far more than the archive: forty megabytes of blanks.
    let bomb = zipped(&[("main.xml", vec![b' '; 40 << 20])]);
    assert!(bomb.len() < 100_000);
    assert_refused!(Unsupported, bomb);
    let bytes = whole.bytes();
    for length in (4..bytes.len()).step_by(7) {
        let error = refused(&bytes[..length]);
        assert!(matches!(error, ReadError::Corrupt(_)), "{length}: {error:?}");
    }
    // A file with any byte changed is an error or is read, never a panic.
    for place in 4..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[place] ^= 0x55;
        let (_folder, path) = file(&damaged);
        let _ = metadata(&path).and_then(|_| height_map(&path, ReadOptions::default()));
    }
}

#[test]
fn the_file_of_valid_points_is_checked_as_the_heights_are() {
    let mut x3p = X3p::linked("D", "1", metres());
    let valid =
        "<ValidPointsLink>valid.bin</ValidPointsLink><MD5ChecksumValidPoints>0123</MD5ChecksumValidPoints>";
    x3p.record3 = x3p.record3.replace("</DataLink>", &format!("{valid}</DataLink>"));
    x3p.files.push(("valid.bin", vec![0xff; 3]));
    assert_refused!(Corrupt, x3p.bytes());
    x3p.files[1].1.pop();
    let (_folder, path) = file(x3p.bytes());
    let error = metadata(&path).unwrap_err().to_string();
    assert!(error.contains("is truncated: valid.bin holds 2 bytes; allowed: 3"), "{error}");
}

#[test]
fn an_archive_that_is_packed_otherwise_is_not_called_damaged() {
    let whole = X3p::linked("D", "1", metres()).bytes();
    // In the header of each entry and in the directory: bzip2 as its method, or the flag of an encrypted one.
    for (offset, value) in [(8, 12), (6, 1)] {
        let mut bytes = whole.clone();
        for place in 0..bytes.len() {
            match &bytes[place..] {
                [b'P', b'K', 3, 4, ..] => bytes[place + offset] = value,
                [b'P', b'K', 1, 2, ..] => bytes[place + offset + 2] = value,
                _ => {}
            }
        }
        assert_refused!(Unsupported, bytes);
    }
}

/// Zeros, which agree with the header: nothing of their size is allocated.
#[test]
fn heights_that_no_instrument_measures_are_refused_before_they_are_unpacked() {
    let [nx, ny] = [4096u64, 2100];
    let mut file = X3p::linked("D", "1", vec![0; (8 * nx * ny) as usize]);
    file.size = [nx, ny, 1];
    let bytes = file.bytes();
    assert!(bytes.len() < 1 << 20);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("zeros.x3p");
    std::fs::write(&path, &bytes).unwrap();
    for error in [metadata(&path).err(), height_map(&path, ReadOptions::default()).err()] {
        let error = error.unwrap().to_string();
        assert!(error.contains("holds no measured heights: bindata/data.bin unpacks from "), "{error}");
        assert!(error.contains(" to 68812800 bytes; allowed: at most 200 times as many"), "{error}");
    }
}

/// What a parser of XML takes time or memory for, out of proportion to the bytes.
#[test]
fn an_xml_of_many_attributes_namespaces_or_elements_is_refused() {
    let x3p = |xml: String| zipped(&[("main.xml", xml.into_bytes())]);
    let many = |of: fn(usize) -> String| (0..201).map(of).collect::<String>();
    assert_refused!(Corrupt, x3p(format!("<a{}/>", many(|k| format!(" a{k}=\"\"")))));
    let nested = many(|k| format!("<a xmlns:a{k}=\"{k}\">"));
    assert_refused!(Corrupt, x3p(nested + &"</a>".repeat(201)));
    // What looks like attributes elsewhere is none.
    let text = format!("<a><!-- {0} -->{0}</a>", "=".repeat(300));
    assert_refused!(Mismatch, x3p(text));
    assert_refused!(Corrupt, x3p(format!("<a>{}</a>", "<a/>".repeat(500_000))));
}
