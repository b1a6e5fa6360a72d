//! Matrices and points in plain text.

use super::*;
use asperity::topography::RoughnessParameters;

#[test]
fn a_matrix_of_numbers_with_every_separator() {
    for (separator, missing) in [
        (" ", "NaN"),
        ("\t", "BAD"),
        ("\t", ""),
        (";", ""),
        ("; ", "nan"),
        (",", ""),
        (", ", "--"),
        ("  ", "n/a"),
    ] {
        let text = lines(separator, missing);
        let head = assert_map(&text, IN_NM, 1e-9, PIXEL);
        assert_eq!((head.pixel, head.has_unit), (None, false));
        assert_map(format!("\u{feff}# a comment\r\n\r\n{}", text.replace('\n', "\r\n")), IN_NM, 1e-9, PIXEL);
        if separator.trim() != "," {
            assert_map(text.replace('.', ","), IN_NM, 1e-9, PIXEL);
        }
        if ![" ", "  "].contains(&separator) {
            assert_map(
                text.replace('\n', &format!("{}\n", separator.trim_end_matches(' '))),
                IN_NM,
                1e-9,
                PIXEL,
            );
        }
    }
}

#[test]
fn a_header_gives_the_size_and_the_unit() {
    for (micro, unit, factor) in
        [("µm", "nm", 1e-9), ("μm", "µm", 1e-6), ("um", "m", 1.0), ("µm", "Å", 1e-10)]
    {
        let text = format!(
            "# Channel: Topography\n# Width: 10 {micro}\n# Height: 12 {micro}\n# Value units: {unit}\n{}",
            lines("\t", "NaN")
        );
        if factor < 1.0 {
            let head = assert_map(&text, ReadOptions::default(), factor, PIXEL);
            assert!(head.has_unit && head.pixel.is_some());
        } else {
            assert_refused!(TooTall, "holds a height of 1.35e1 m", &text);
        }
        // The same in Latin-1.
        let latin: Vec<u8> =
            text.chars().filter_map(|roughness| u8::try_from(u32::from(roughness)).ok()).collect();
        if factor == 1e-9 {
            assert_map(latin, ReadOptions::default(), factor, PIXEL);
        }
    }
    let text = format!("# Width: 1,5 mm\n# Height: 0.012 mm\n# Value units: um\n{}", lines(" ", "NaN"));
    let (_folder, path) = file(&text);
    assert!((metadata(&path).unwrap().pixel.unwrap()[0] / 3e-4 - 1.0).abs() < 1e-15);
    let given = |pixel, unit| height_map(&path, ReadOptions { pixel, unit }).unwrap_err();
    assert!(matches!(given(Some(PIXEL), None), ReadError::Options(ReadOptionsError::PixelHeld { .. })));
    assert!(matches!(given(None, Some(1e-6)), ReadError::Options(ReadOptionsError::UnitHeld { .. })));
    // A mark of a missing point, where the unit is held.
    let marked = "# Width: 3 um\n# Height: 3 um\n# Value units: m\n1e-9 2e-9 1e10\n0 0 0\n0 0 3.4e38\n";
    let (_folder, path) = file(marked);
    assert_eq!(RoughnessParameters::new(&height_map(&path, ReadOptions::default()).unwrap()).missing, 2);
}

#[test]
fn bad_text_is_refused_with_its_place() {
    assert_refused!(Mismatch, "line 1 has \"this\" for a number", "this is no array\n");
    assert_refused!(
        Mismatch,
        "line 2 has \"Prose\" for a number",
        "# Head\nProse, with commas; and 1.5 numbers.\n"
    );
    assert_refused!(Mismatch, "begins with \"\\x00\\x01", b"\0\x01\x02\x03 binary");
    assert_refused!(Corrupt, "is empty", "");
    assert_refused!(Corrupt, "holds no number", "# only a comment\n");
    assert_refused!(Corrupt, "line 3, column 2: found \"oops\"", "1 2 3 4\n1 2 3 4\n1 oops 3 4\n");
    assert_refused!(Corrupt, "is ragged: line 3 holds 3 numbers; allowed: 4", "1 2 3 4\n1 2 3 4\n1 2 3\n");
    assert_refused!(Unsupported, "UTF-16", b"\xff\xfe1\0 \x002\0");
    assert_refused!(Unsupported, "commas beside", "1,234.5;2,0;3,0\n");
    assert_refused!(Unsupported, "commas beside", "1, 2 3 4\n1 2 3 4\n1 2 3 4\n");
    assert_refused!(Unsupported, "commas that may", "0,05,1,10,2,15\n0,05,1,10,2,15\n0,05,1,10,2,15\n");
    let header = |lines: &str| format!("{lines}\n0 1 2\n3 4 5\n0 1 2\n");
    assert_refused!(Unsupported, "Value units missing", header("# Width: 3 um\n# Height: 3 um"));
    assert_refused!(
        Unsupported,
        "values in \"V\"",
        header("# Width: 3 um\n# Height: 3 um\n# Value units: V")
    );
    assert_refused!(
        Unsupported,
        "the Width \"3 ft\"",
        header("# Width: 3 ft\n# Height: 3 um\n# Value units: m")
    );
}

/// The map as points x y z, the missing one left out, in a mixed order.
pub fn points(step: [f64; 2], round: impl Fn(f64) -> f64) -> String {
    let place = |k: usize| ((k * 7 % (NX * NY)) / NY, (k * 7) % NY);
    (0..NX * NY)
        .map(place)
        .filter(|&(ix, iy)| !z(ix, iy).is_nan())
        .map(|(ix, iy)| {
            let [x, y] = [10.0 + step[0] * ix as f64, -3.0 + step[1] * iy as f64].map(&round);
            format!("{x} {y} {}\n", z(ix, iy))
        })
        .collect()
}

#[test]
fn points_of_a_grid_in_any_order() {
    let in_um = ReadOptions { pixel: None, unit: Some(1e-6) };
    let text = points([0.5, 0.25], |x| x);
    let head = assert_map(&text, in_um, 1e-6, [0.5e-6, 0.25e-6]);
    assert_eq!((head.pixel, head.has_unit), (Some([0.5, 0.25]), false));
    assert_map(format!("X;Y;Z\n{}", text.replace(' ', ";")), in_um, 1e-6, [0.5e-6, 0.25e-6]);
    assert_map(text.replace(' ', ","), in_um, 1e-6, [0.5e-6, 0.25e-6]);
    // Rounded to a tenth of a pixel, the steps are of different lengths.
    let rounded = points([0.337, 0.25], |x| (x * 30.0).round() / 30.0);
    let (_folder, path) = file(&rounded);
    let map = height_map(&path, in_um).unwrap();
    assert_eq!((map.points(), RoughnessParameters::new(&map).missing), ([NX, NY], 1));
    assert!((map.pixel()[0] / 0.337e-6 - 1.0).abs() < 0.02);
    // Noise far below a pixel does not make lines of its own.
    let mut noise = 0.0;
    let noisy: String = points([0.5, 0.25], |x| x)
        .lines()
        .map(|line| {
            noise = (noise + 0.618) % 1.0;
            let (x, rest) = line.split_once(' ').unwrap();
            format!("{} {rest}\n", x.parse::<f64>().unwrap() + 1e-5 * noise)
        })
        .collect();
    let (_folder, path) = file(&noisy);
    assert_eq!(height_map(&path, in_um).unwrap().points(), [NX, NY]);
}

#[test]
fn points_of_no_grid_are_refused() {
    let grid = points([0.5, 0.25], |x| x);
    assert_refused!(Unsupported, "two points at 10 -3", format!("{grid}10 -3 1\n"));
    assert_refused!(Unsupported, "no equidistant lines along x", format!("{grid}10.17 -3 1\n"));
    assert_refused!(Unsupported, "all at y = 1", "1 1 0\n2 1 0\n3 1 0\n4 1 0\n");
    assert_refused!(Unsupported, "more than three in four missing", {
        (0..100).map(|k| format!("{k} {k} 0\n")).collect::<String>()
    });
    assert_refused!(Unsupported, "two points", "0 0 0\n1 1 0\n1e9 1e9 0\n3 3 0\n");
    assert_refused!(UnitsInColumns, "names columns with units", format!("x [um] y [um] z [um]\n{grid}"));
    assert_refused!(Corrupt, "point 5 of", "0 0 0\n1 0 0\n0 1 0\n1 1 0\nnan 2 0\n");
}

#[test]
fn opd_1_as_text_and_as_points_is_the_same_surface() {
    let opd = opd();
    let [nx, ny] = opd.points();
    let (mut matrix, mut points) = (String::new(), String::new());
    let size = |count: usize| count as f64 * opd.pixel()[0] * 1e6;
    matrix += &format!("# Width: {} µm\n# Height: {} µm\n# Value units: nm\n", size(nx), size(ny));
    for iy in 0..ny {
        for ix in 0..nx {
            let z = opd.heights()[ix * ny + iy];
            matrix += &format!("{}\t", z * 1e9);
            if !z.is_nan() {
                points += &format!("{:.4}\t{:.4}\t{}\n", size(ix), size(iy), z * 1e6);
            }
        }
        matrix += "\n";
    }
    assert_opd(matrix, ReadOptions::default(), 1e-15);
    // Coordinates with four decimals of a micrometre; the unit goes for all three columns.
    let in_um = ReadOptions { pixel: None, unit: Some(1e-6) };
    let (_folder, path) = file(&points);
    let pixel = height_map(&path, in_um).unwrap().pixel();
    assert!(pixel.iter().all(|size| (size / opd.pixel()[0] - 1.0).abs() < 1e-5), "{pixel:?}");
    let exact: String = (0..nx * ny)
        .filter(|&k| !opd.heights()[k].is_nan())
        .map(|k| format!("{} {} {}\n", size(k / ny), size(k % ny), opd.heights()[k] * 1e6))
        .collect();
    assert_opd(exact, in_um, 1e-15);
}

#[test]
fn digits_tell_the_precision_but_few_of_them_are_steps() {
    for (number, precision) in [("12.345", f64::EPSILON), ("12.34567", 0.5e-6), ("0.0001234567e-3", 0.5e-6)] {
        let (_folder, path) = file(lines(" ", "NaN").replacen("1.25", number, 1));
        let found = height_map(&path, IN_NM).unwrap().precision();
        assert!((found / precision - 1.0).abs() < 1e-14, "{number}: {found}");
    }
}
