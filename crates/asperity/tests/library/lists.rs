//! Lists of asperities as text: units, separators, decimal commas, headers, and what is refused.

use crate::common::assert_message;
use asperity::progress::Silent;
use asperity::{AsperityList, Ellipse, ListColumn, ListError, ListOptions};

fn with<T>(bytes: impl AsRef<[u8]>, look: impl FnOnce(&std::path::Path) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.txt");
    std::fs::write(&path, bytes).unwrap();
    look(&path)
}

/// Heights and radii, m.
fn spheres(bytes: impl AsRef<[u8]>, options: ListOptions) -> (Vec<f64>, Vec<f64>) {
    with(bytes, |path| {
        let list = AsperityList::read(path, options, &Silent).unwrap();
        assert_eq!(AsperityList::check(path, options, &Silent).unwrap(), list.count());
        let set = list.set(1.0).unwrap();
        (set.heights().to_vec(), set.radii().to_vec())
    })
}

/// The same error of the check and of the reading.
fn refused(bytes: impl AsRef<[u8]>, options: ListOptions) -> ListError {
    with(bytes, |path| {
        let error = AsperityList::read(path, options, &Silent).unwrap_err();
        assert_eq!(AsperityList::check(path, options, &Silent).unwrap_err().to_string(), error.to_string());
        error
    })
}

const METRES: ListOptions = ListOptions { as_ellipses: false, unit: None };
const MICROMETRES: ListOptions = ListOptions { as_ellipses: false, unit: Some(1e-6) };

/// Scaling rounds once more than the number alone.
fn assert_close(found: (Vec<f64>, Vec<f64>), wanted: &(Vec<f64>, Vec<f64>), text: &str) {
    for (found, wanted) in [(&found.0, &wanted.0), (&found.1, &wanted.1)] {
        assert_eq!(found.len(), wanted.len(), "{text}");
        let near = |(found, wanted): (&f64, &f64)| (found / wanted - 1.0).abs() <= 2.0 * f64::EPSILON;
        assert!(found.iter().zip(wanted).all(near), "{text}: {found:?}");
    }
}

#[test]
fn every_separator_unit_and_decimal_mark_gives_the_same_list() {
    let list = (vec![5e-8, -1.25e-7], vec![2e-5, 4e-6]);
    for text in [
        "height,radius\n5e-8,2e-5\n-1.25e-7,4e-6\n",
        "height;radius\n5e-8;2e-5\n-1,25e-7;4e-6\n",
        "Height [nm]; Radius [um]\n50;20\n-125;4\n",
        "Height (nm);Radius (µm);\n50,0;20,0;\n-125,0;4,0;\n",
        "height [nm]\tradius [um]\n50\t20\n-125\t4\n",
        "height [nm] radius [um]\n 50   20\n-125\t 4\n\n",
        "radius (mm), name, height [um]\n0.02, \"a, b\", 0.05\n0.004, c, -0.125\n",
        "\"height\",\"radius\"\n\"5e-8\",\"2e-5\"\n\"-1.25e-7\",\"4e-6\"\n",
        "# height radius\n5e-8 2e-5\n-1.25e-7 4e-6\n",
        "# made by hand\n# height[nm]; radius[um]\n50;20\n-125;4\n",
        "\u{feff}height,radius\r\n5e-8,2e-5\r\n# a comment\r\n-1.25e-7,4e-6",
    ] {
        assert_close(spheres(text, METRES), &list, text);
    }
    assert_close(spheres(b"height (\xb5m);radius (\xb5m)\n0,05;20\n-0,125;4\n", METRES), &list, "Latin-1");
    assert_close(spheres("height,radius\n0.05,20\n-0.125,4\n", MICROMETRES), &list, "option");
    let array = |values: [f64; 4]| {
        let values = values.map(f64::to_le_bytes).concat();
        super::files::array("<f8", false, "(2, 2)", &values)
    };
    assert_close(spheres(array([0.05, 20.0, -0.125, 4.0]), MICROMETRES), &list, "array");
}

#[test]
fn curvatures_have_the_reciprocal_unit() {
    let options = |unit| ListOptions { as_ellipses: true, unit };
    for (text, unit) in [
        ("height [um],radius [um],kx [1/um],ky [mm^-1]\n1,2,0.5,2000\n", None),
        ("height;radius;kx;ky\n1;2;0,5;2\n", Some(1e-6)),
    ] {
        let set =
            with(text, |path| AsperityList::read(path, options(unit), &Silent).unwrap().set(1.0).unwrap());
        assert_eq!(set.ellipses(), Some(&[Ellipse::new(5e5, 2e6)][..]), "{text}");
    }
}

#[test]
fn a_bad_row_is_named_with_its_line_and_its_content() {
    for text in [
        "height,radius\n1e-9,1e-6\n\n1e-9,wide\n",
        "height,radius\n,1e-6\n",
        "height [um] radius [um]\n1 2\n1 inf\n",
        "height,radius\n1e-9,1e-6\n2e-9\n",
        "height,radius\n0,5,1,2\n",
        "height;radius\n1.5;2\n1,5;2\n",
        "height,radius,height\n1,2,3\n",
        "height [inch],radius\n1,2\n",
        "# by hand\n1e-9,1e-6\n",
        "z;r\n1;2\n",
        "# only comments\n",
        "height,radius\n",
    ] {
        assert_message(module_path!(), &format!("{text:?}"), &refused(text, METRES).to_string());
    }
    let error = refused("height [um],radius\n1,2\n", MICROMETRES);
    assert!(matches!(error, ListError::UnitHeld { line: 1 }), "{error}");
    assert!(matches!(refused(b"\xff\xfeh\0e\0", METRES), ListError::Encoding));
    let wide = ListOptions { as_ellipses: true, unit: None };
    let error = refused("height,radius,kx [um],ky\n1,2,3,4\n", wide);
    assert!(matches!(&error, ListError::Unit { column: ListColumn::Kx, .. }), "{error}");
    assert_message(module_path!(), "kx [um]", &error.to_string());
}

/// As by the reading.
#[test]
fn a_bad_value_of_an_array_is_found_by_the_check() {
    let values = [1e-9, 1e-6, f64::NAN, 1e-6].map(f64::to_le_bytes).concat();
    let error = refused(super::files::array("<f8", false, "(2, 2)", &values), METRES).to_string();
    assert!(error.contains("row 2 of 2, column `height`: found NaN"), "{error}");
}

#[test]
fn a_header_is_at_most_ten_thousand_columns_wide_and_shown_in_part() {
    let header = |others: usize| format!("height;radius{}\n", ";a".repeat(others));
    let rows = format!("1;2{}\n", ";3".repeat(9_998));
    assert_eq!(spheres(header(9_998) + &rows, METRES).0, [1.0]);
    let error = refused(header(9_999), METRES).to_string();
    assert_eq!(error, "line 1 names more than 10000 columns; allowed: at most 10000");
    let error = refused("a;".repeat(9_000) + "\n", METRES).to_string();
    assert!(error.contains("(found: a, a, a, ") && error.len() < 500, "{error}");
    let error = refused(format!("height [{}];radius\n1;2\n", "u".repeat(1000)), METRES).to_string();
    assert!(error.contains("has the unit \"uuu") && error.len() < 300, "{error}");
}
