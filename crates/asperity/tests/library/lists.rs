//! Lists of asperities as text: units, separators, decimal commas, headers.

use std::path::Path;

use crate::files::array;
use crate::formats::file;
use crate::formats::instrument::stored;
use crate::formats::refused::{Good, described};
use asperity::progress::Silent;
use asperity::{AsperityList, Ellipse, ListError, ListOptions};

const METRES: ListOptions = ListOptions { as_ellipses: false, unit: None };
const MICROMETRES: ListOptions = ListOptions { as_ellipses: false, unit: Some(1e-6) };
const ELLIPSES: ListOptions = ListOptions { as_ellipses: true, unit: None };

/// The same list by the check and by the reading.
fn read(path: &Path, options: ListOptions) -> Result<AsperityList, ListError> {
    let (list, count) =
        (AsperityList::read(path, options, &Silent), AsperityList::check(path, options, &Silent));
    let words = |error: &ListError| error.to_string();
    assert_eq!(list.as_ref().map(AsperityList::count).map_err(words), count.as_ref().copied().map_err(words));
    list
}

/// Heights and radii, m.
fn spheres(bytes: impl AsRef<[u8]>, options: ListOptions) -> (Vec<f64>, Vec<f64>) {
    let (_folder, path) = file(bytes);
    let set = read(&path, options).unwrap().set(1.0).unwrap();
    (set.heights().to_vec(), set.radii().to_vec())
}

fn refused(bytes: impl AsRef<[u8]>, options: ListOptions) -> String {
    let (_folder, path) = file(bytes);
    described(&read(&path, options).unwrap_err())
}

pub fn good() -> Vec<Good> {
    let spheres = array("<f8", false, "(2, 2)", &stored::<f64>([1e-9, 1e-6].repeat(2).into_iter(), false));
    let ellipses = [1e-9, 1e-6, 1e6, 1e6].repeat(2);
    let ellipses = array("<f8", false, "(2, 4)", &stored::<f64>(ellipses.into_iter(), false));
    vec![
        Good { error: |bytes| refused(bytes, METRES), ..Good::whole("list", "") },
        Good { error: |bytes| refused(bytes, MICROMETRES), ..Good::whole("list in um", "") },
        Good { error: |bytes| refused(bytes, ELLIPSES), ..Good::whole("list of ellipses", "") },
        Good { error: |bytes| refused(bytes, METRES), ..Good::whole("array of spheres", spheres) },
        Good { error: |bytes| refused(bytes, ELLIPSES), ..Good::whole("array of ellipses", ellipses) },
    ]
}

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
    let values = stored::<f64>([0.05, 20.0, -0.125, 4.0].into_iter(), false);
    assert_close(spheres(array("<f8", false, "(2, 2)", &values), MICROMETRES), &list, "array");
}

#[test]
fn curvatures_have_the_reciprocal_unit() {
    for (text, unit) in [
        ("height [um],radius [um],kx [1/um],ky [mm^-1]\n1,2,0.5,2000\n", None),
        ("height;radius;kx;ky\n1;2;0,5;2\n", Some(1e-6)),
    ] {
        let (_folder, path) = file(text);
        let set = read(&path, ListOptions { unit, ..ELLIPSES }).unwrap().set(1.0).unwrap();
        assert_eq!(set.ellipses(), Some(&[Ellipse::new(5e5, 2e6)][..]), "{text}");
    }
}

#[test]
fn a_header_is_at_most_ten_thousand_columns_wide_and_shown_in_part() {
    let header = |others: usize| format!("height;radius{}\n", ";a".repeat(others));
    let rows = format!("1;2{}\n", ";3".repeat(9_998));
    assert_eq!(spheres(header(9_998) + &rows, METRES).0, [1.0]);
    let error = refused(header(9_999), METRES);
    assert_eq!(error, "Wide: line 1 names more than 10000 columns; allowed: at most 10000");
    let error = refused("a;".repeat(9_000) + "\n", METRES);
    assert!(error.contains("(found: a, a, a, ") && error.len() < 500, "{error}");
    let error = refused(format!("height [{}];radius\n1;2\n", "u".repeat(1000)), METRES);
    assert!(error.contains("has the unit \"uuu") && error.len() < 300, "{error}");
}
