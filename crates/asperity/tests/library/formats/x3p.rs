//! X3P.

use std::io::Write;

use super::instrument::{assert_heights, edited, stored};
use super::refused::Good;
use super::*;

/// The main.xml of a map of 5 x 4 heights in metres.
const MAIN: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">\
    <Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>\
    <CX><AxisType>I</AxisType><DataType>D</DataType><Increment>2e-6</Increment><Offset>7</Offset></CX>\
    <CY><AxisType>I</AxisType><DataType>D</DataType><Increment>3e-6</Increment><Offset>7</Offset></CY>\
    <CZ><AxisType>A</AxisType><DataType>D</DataType><!-- none may be there -->\
    <Increment>1</Increment><Offset></Offset></CZ></Axes></Record1><Record3>\
    <MatrixDimension><SizeX>5</SizeX><SizeY>4</SizeY><SizeZ>1</SizeZ></MatrixDimension>\
    <DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3></p:ISO5436_2>";

fn zipped(files: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, content) in files {
        archive.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(content).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

fn metres() -> Vec<u8> {
    stored::<f64>(in_lines().map(|z| z * 1e-9), false)
}

/// A file of the map with this main.xml.
fn with(main: impl Into<Vec<u8>>) -> Vec<u8> {
    zipped(&[("main.xml", main.into()), ("bindata/data.bin", metres())])
}

/// The same with a third file.
fn with_file(main: impl Into<Vec<u8>>, name: &str, content: impl Into<Vec<u8>>) -> Vec<u8> {
    zipped(&[("main.xml", main.into()), ("bindata/data.bin", metres()), (name, content.into())])
}

/// A file where a list of points that are valid has this content and another check sum.
fn listing_valid_points(valid: Vec<u8>) -> Vec<u8> {
    let link =
        "<ValidPointsLink>valid.bin</ValidPointsLink><MD5ChecksumValidPoints>0123</MD5ChecksumValidPoints>";
    with_file(MAIN.replace("</DataLink>", &format!("{link}</DataLink>")), "valid.bin", valid)
}

/// An archive whose entries state a method or a flag, in their headers and in the directory.
fn stating(offset: usize, value: u8) -> Vec<u8> {
    let mut bytes = with(MAIN);
    for place in 0..bytes.len() {
        match &bytes[place..] {
            [b'P', b'K', 3, 4, ..] => bytes[place + offset] = value,
            [b'P', b'K', 1, 2, ..] => bytes[place + offset + 2] = value,
            _ => {}
        }
    }
    bytes
}

pub fn good() -> Vec<Good> {
    let of_main = |main: &str| zipped(&[("main.xml", main.into())]);
    let many = |of: fn(usize) -> String| (0..201).map(of).collect::<String>();
    let nested = many(|k| format!("<a xmlns:a{k}=\"{k}\">")) + &"</a>".repeat(201);
    // Zeros, as many as the header says.
    let large = edited(MAIN, &[["<SizeX>5", "<SizeX>4096"], ["<SizeY>4", "<SizeY>2100"]]);
    let zeros = vec![0; 8 * 4096 * 2100];
    vec![
        Good { file: with, ..Good::whole("x3p", MAIN) },
        Good { file: listing_valid_points, ..Good::whole("valid points of x3p", [0xff; 3]) },
        Good {
            file: |sum| with_file(MAIN, "md5checksum.hex", sum),
            ..Good::whole("sum of x3p", *b"00 *main.xml")
        },
        Good::whole("archive of x3p", with(MAIN)),
        Good::whole("x3p packed by bzip2", stating(8, 12)),
        Good::whole("x3p with a password", stating(6, 1)),
        Good::whole("x3p of zeros", zipped(&[("main.xml", large.into()), ("bindata/data.bin", zeros)])),
        Good::whole("x3p of two maps", zipped(&[("a/main.xml", MAIN.into()), ("b/main.xml", MAIN.into())])),
        Good::whole("x3p in an archive", zipped(&[("scan.x3p", with(MAIN))])),
        Good::whole("a document", zipped(&[("word/document.xml", vec![])])),
        Good::whole("a page", of_main("<html/>")),
        Good::whole("x3p of blanks", of_main(&" ".repeat(40 << 20))),
        Good::whole("x3p of many elements", of_main(&format!("<a>{}</a>", "<a/>".repeat(500_000)))),
        Good::whole("x3p of many attributes", of_main(&format!("<a{}/>", many(|k| format!(" a{k}=\"\""))))),
        Good::whole("x3p of many namespaces", of_main(&nested)),
        // What looks like attributes elsewhere is none.
        Good::whole("x3p of signs", of_main(&format!("<a><!-- {0} -->{0}</a>", "=".repeat(300)))),
    ]
}

/// No number depends on the name of the root, on its namespaces or on what there is one of.
#[test]
fn names_that_no_number_depends_on_are_free() {
    for change in [
        ["p:ISO5436_2", "ISO5436"],
        ["p:ISO5436_2", "p:anything"],
        ["<FeatureType>SUR</FeatureType>", ""],
        ["<FeatureType>SUR", "<FeatureType>sur"],
        ["<AxisType>I</AxisType>", ""],
        ["<Revision>ISO5436 - 2000</Revision>", ""],
        // No increment is one metre.
        ["<Increment>1</Increment>", ""],
    ] {
        assert!(assert_map(with(edited(MAIN, &[change])), AS_IT_IS, 1e-9, PIXEL).has_unit);
    }
    // An encoding other than declared, after a byte order mark.
    assert_map(with(format!("\u{feff}{MAIN}")), AS_IT_IS, 1e-9, PIXEL);
    assert_map(with([MAIN.as_bytes(), b"<!-- \xb5m -->"].concat()), AS_IT_IS, 1e-9, PIXEL);
}

/// Programs that edit main.xml leave its check sum as it was; the heights have one of their own.
#[test]
fn a_stale_check_sum_is_a_note_where_that_of_the_heights_is_right() {
    use md5::{Digest, Md5};
    let sum: String = Md5::digest(metres()).iter().map(|byte| format!("{byte:02X}")).collect();
    let stating = |sum: &str| {
        let md5 = format!("</PointDataLink><MD5ChecksumPointData>{sum}</MD5ChecksumPointData>");
        with_file(MAIN.replace("</PointDataLink>", &md5), "md5checksum.hex", *b"00 *main.xml")
    };
    let head = assert_map(stating(&sum), AS_IT_IS, 1e-9, PIXEL);
    assert!(
        matches!(&head.notes[..], [note] if note.starts_with("was changed after its check sums")),
        "{head:?}"
    );
    for sum in [sum.replacen(&sum[..1], "x", 1), String::new()] {
        let error = refused(stating(&sum));
        assert!(matches!(&error, ReadError::Corrupt(text) if text.starts_with("is damaged")), "{error}");
    }
    // The sum of the heights, as SurfaceTopography writes it.
    let other = with_file(MAIN, "md5checksum.hex", format!("{sum} *bindata/data.bin"));
    assert!(assert_map(other, AS_IT_IS, 1e-9, PIXEL).notes.is_empty());
}

/// A unit and a pixel that are given count in place of those of the file.
#[test]
fn what_the_file_states_can_be_replaced() {
    let x3p = with(MAIN);
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
    let folder = [("scan/main.xml", MAIN.into()), ("scan/bindata/data.bin", metres())];
    assert_map(zipped(&folder), AS_IT_IS, 1e-9, PIXEL);
}

#[test]
fn x3p_of_every_data_type_scaled_and_moved() {
    // Eighths of a nanometre below 2 um.
    macro_rules! check {
        ($($kind:ty, $code:literal;)*) => {$(
            let main = edited(MAIN, &[
                ["<DataType>D</DataType><!--", concat!("<DataType>", $code, "</DataType><!--")],
                ["<Increment>1<", "<Increment>1.25e-10<"],
                ["<Offset><", "<Offset>-2e-6<"],
                ["</DataLink>", "<ValidPointsLink>./bindata\\valid.bin</ValidPointsLink></DataLink>"],
            ]);
            let numbers = stored::<$kind>(in_lines().map(|z| 8.0 * z), false);
            // One bit a point, the lowest first; the point (3, 1) is number 8.
            let valid = ("bindata/valid.bin", vec![0xff, 0xfe, 0x0f]);
            let bytes = zipped(&[("main.xml", main.into()), ("bindata/data.bin", numbers), valid]);
            assert_heights(bytes, None, PIXEL, |ix, iy| 1e-9 * z(ix, iy) - 2e-6);
        )*};
    }
    check! { i16, "I"; i32, "L"; f32, "F"; f64, "D"; }
    // A mark that instruments write.
    let marked = stored::<f64>(in_lines().map(|z| if z.is_nan() { 1e10 } else { z * 1e-9 }), false);
    let bytes = zipped(&[("main.xml", MAIN.into()), ("bindata/data.bin", marked)]);
    assert_map(bytes, AS_IT_IS, 1e-9, PIXEL);
}
