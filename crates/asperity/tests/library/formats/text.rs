//! Matrices and points in plain text.

use super::refused::Good;
use super::*;
use asperity::topography::read::{LeftOut, NamedUnits};

pub fn good() -> Vec<Good> {
    let header = "# Width: 3 um\n# Height: 3 um\n# Value units: nm\n0 1 2\n3 4 5\n0 1 2\n";
    let lines_of = |line: fn(usize) -> String| (0..100).map(line).collect::<String>();
    vec![
        Good::whole("text", ""),
        Good::whole("text of a matrix", lines(" ", "NaN")),
        Good::whole("text with a header", header),
        Good::whole("text of points", points([0.5, 0.25], |x| x)),
        Good::whole("text of a line of points", lines_of(|k| format!("{k} {k} 0\n"))),
        Good::whole("text of a profile", lines_of(|k| format!("{k} {}\n", k % 7))),
    ]
}

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
    for (micro, unit, factor) in [("µm", "nm", 1e-9), ("μm", "µm", 1e-6), ("µm", "Å", 1e-10)] {
        let text = format!(
            "# Channel: Topography\n# Width: 10 {micro}\n# Height: 12 {micro}\n# Value units: {unit}\n{}",
            lines("\t", "NaN")
        );
        let head = assert_map(&text, AS_IT_IS, factor, PIXEL);
        assert!(head.has_unit && head.pixel.is_some());
        // The same in Latin-1.
        let latin: Vec<u8> =
            text.chars().filter_map(|roughness| u8::try_from(u32::from(roughness)).ok()).collect();
        if factor == 1e-9 {
            assert_map(latin, AS_IT_IS, factor, PIXEL);
        }
    }
    let text = format!("# Width: 1,5 mm\n# Height: 0.012 mm\n# Value units: um\n{}", lines(" ", "NaN"));
    let (_folder, path) = file(&text);
    assert!((metadata(&path).unwrap().pixel.unwrap()[0] / 3e-4 - 1.0).abs() < 1e-15);
    // What is given replaces what is stated: of numbers as they are written.
    let read = |pixel, unit| height_map(&path, ReadOptions { pixel, unit }).unwrap();
    let (own, other) = (read(None, None), read(Some(PIXEL), Some(LengthUnits { xy: 1.0, z: 1e-9 })));
    assert_eq!(other.pixel(), PIXEL);
    assert!(
        own.heights()
            .iter()
            .zip(other.heights())
            .all(|(own, other)| own.is_nan() || (own - other * 1e3).abs() < 1e-20)
    );
    let in_um = read(None, Some(LengthUnits::same(1e-6)));
    assert!(
        (in_um.pixel()[0] / own.pixel()[0] / 1e-3 - 1.0).abs() < 1e-12
            && in_um.heights()[0] == own.heights()[0]
    );
    // A mark of a missing point, where the unit is held.
    let marked = "# Width: 3 um\n# Height: 3 um\n# Value units: m\n1e-9 2e-9 1e10\n0 0 0\n0 0 3.4e38\n";
    assert_eq!(RoughnessParameters::new(&read_map(marked, AS_IT_IS)).missing, 2);
}

#[test]
fn tabs_before_the_first_numbers_begin_no_cells() {
    let line = |iy: usize| format!("  {}.50   2.50   {}.25   1.00\r\n", iy * 3 % 7, iy * iy % 5);
    let text = format!("\t\t\t{}", (0..6).map(line).collect::<String>().trim_start());
    let head = read_head(&text);
    assert_eq!((head.points, &head.notes[..]), ([4, 6], &[][..]));
}

/// Of the lines above a table that is quoted which may hold what is not known.
#[test]
fn a_note_quotes_the_line_of_a_pixel() {
    let rows = "1 2 3 4\n2 3 4 5\n1 2 4 5\n3 2 1 0\n";
    let notes = read_head(format!("Profile: X Y\nPixel size = 25 um\nDate today\n{rows}")).notes;
    assert!(notes[0].contains("(\"Pixel size = 25 um\")"), "{notes:?}");
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
    let in_um = ReadOptions { pixel: None, unit: Some(LengthUnits::same(1e-6)) };
    let text = points([0.5, 0.25], |x| x);
    let head = assert_map(&text, in_um, 1e-6, [0.5e-6, 0.25e-6]);
    assert_eq!((head.pixel, head.has_unit), (Some([0.5, 0.25]), false));
    assert_map(format!("X;Y;Z\n{}", text.replace(' ', ";")), in_um, 1e-6, [0.5e-6, 0.25e-6]);
    assert_map(text.replace(' ', ","), in_um, 1e-6, [0.5e-6, 0.25e-6]);
    // Rounded to a tenth of a pixel, the steps are of different lengths.
    let rounded = points([0.337, 0.25], |x| (x * 30.0).round() / 30.0);
    let map = read_map(&rounded, in_um);
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
    assert_eq!(read_map(&noisy, in_um).points(), [NX, NY]);
}

#[test]
fn units_in_the_names_of_columns_are_read_and_hold() {
    let grid = points([0.5, 0.25], |x| x);
    let head = assert_map(format!("x [um] y [um] z [nm]\n{grid}"), AS_IT_IS, 1e-9, [0.5e-6, 0.25e-6]);
    assert!(!head.has_unit && matches!(head.named, NamedUnits::Known(_)));
    assert_map(format!("# x [um] y [um] z [nm]\n{grid}"), AS_IT_IS, 1e-9, [0.5e-6, 0.25e-6]);
    let pandas = format!(",x_um,y_um,height_nm\n{}", indexed(&grid.replace(' ', ",")));
    assert!(assert_map(pandas, AS_IT_IS, 1e-9, [0.5e-6, 0.25e-6]).left_out.index_column);
    let given = ReadOptions { unit: Some(LengthUnits { xy: 1e-5, z: 1e-8 }), ..AS_IT_IS };
    let named = format!("x [um] y [um] z [nm]\n{grid}");
    let same = ReadOptions { unit: Some(LengthUnits { xy: 1e-6, z: 1e-9 }), ..AS_IT_IS };
    assert_map(&named, same, 1e-9, [0.5e-6, 0.25e-6]);
    let other = ReadOptions { unit: Some(LengthUnits::same(1e-6)), ..AS_IT_IS };
    let head = assert_map(&named, other, 1e-6, [0.5e-6, 0.25e-6]);
    assert_eq!(head.replaced_units(&other).unwrap().to_string(), "um of x and y, nm of z");
    assert_eq!(head.replaced_units(&same), None);
    // Units that are not clear are an error unless others are given.
    let unclear = format!("x [px] y [px] z [nm]\n{grid}");
    assert_map(&unclear, given, 1e-8, [0.5e-5, 0.25e-5]);
    let (_folder, path) = file(&unclear);
    let error = height_map(&path, AS_IT_IS).unwrap_err().to_string();
    assert!(error.contains("in line 1: \"x [px] y [px] z [nm]\"; allowed: one unit of length"), "{error}");
}

/// Lines with their numbers, from 0, in a first column.
fn indexed(lines: &str) -> String {
    lines.lines().enumerate().map(|(k, line)| format!("{k},{line}\n")).collect()
}

/// Lines with a name in a first column.
fn named(lines: &str) -> String {
    lines.lines().map(|line| format!("\"r{}\",{line}\n", line.len())).collect()
}

#[test]
fn numbers_and_names_of_columns_and_lines_are_no_heights() {
    let matrix = lines(",", "");
    let numbers = |from: usize| (from..from + NX).map(|k| k.to_string()).collect::<Vec<_>>().join(",");
    let names = (0..NX).map(|k| format!("\"V{k}\"")).collect::<Vec<_>>().join(",");
    for (text, header, index_column) in [
        (format!("{}\n{matrix}", numbers(0)), Some(1), false),
        (format!("{}\n{matrix}", numbers(1)), Some(1), false),
        (format!("# a comment\n{names}\n{matrix}"), Some(2), false),
        (format!(",{}\n{}", numbers(0), indexed(&matrix)), Some(1), true),
        (format!("line,{}\n{}", numbers(0), indexed(&matrix)), Some(1), true),
        (format!("{}\n{}", numbers(0), indexed(&matrix)), Some(1), true),
        (format!("\"\",{names}\n{}", named(&matrix)), Some(1), true),
        (indexed(&matrix), None, true),
        (matrix.clone(), None, false),
    ] {
        let head = assert_map(&text, IN_NM, 1e-9, PIXEL);
        assert_eq!(head.left_out, LeftOut { header, index_column, ..LeftOut::default() }, "{text}");
    }
    // An inclined plane of whole numbers is a map.
    let plane: String =
        (0..6).map(|y| (0..6).map(|x| format!("{} ", x + y)).collect::<String>() + "\n").collect();
    let (_folder, path) = file(&plane);
    assert_eq!(
        (metadata(&path).unwrap().points, metadata(&path).unwrap().left_out),
        ([6, 6], LeftOut::default())
    );
}

/// Coordinates that are equally spaced to their last digit are no heights; a tilted plane is.
#[test]
fn coordinates_of_columns_and_lines_are_no_heights() {
    let height = |ix: usize, iy: usize| ((ix * 7 + iy * 5) % 11) as f64 * 0.25;
    let row = |values: Vec<String>| values.join(" ") + "\n";
    let matrix = |column: &dyn Fn(usize) -> String| -> String {
        (0..10).map(|iy| column(iy) + &row((0..9).map(|ix| height(ix, iy).to_string()).collect())).collect()
    };
    let across = || row((0..9).map(|k| format!("{:.4}", 0.8 * k as f64)).collect());
    let along = |iy: usize| format!("{:.2} ", -1.5 + iy as f64 / 3.0);
    let none = |_: usize| String::new();
    for (text, header, index_column, spacing) in [
        (format!("0 {}{}", across(), matrix(&along)), Some(1), true, [Some(0.8), Some(1.0 / 3.0)]),
        (format!("y/x {}{}", across(), matrix(&along)), Some(1), true, [None, Some(1.0 / 3.0)]),
        (format!("{}{}", across(), matrix(&along)), Some(1), true, [Some(0.8), Some(1.0 / 3.0)]),
        (format!("{}{}", across(), matrix(&none)), Some(1), false, [Some(0.8), None]),
        (matrix(&along), None, true, [None, Some(1.0 / 3.0)]),
        (matrix(&none), None, false, [None, None]),
    ] {
        let (_folder, path) = file(&text);
        let head = metadata(&path).unwrap();
        assert_eq!(
            (head.points, head.left_out.header, head.left_out.index_column),
            ([9, 10], header, index_column),
            "{text}"
        );
        for (found, wanted) in head.left_out.spacing.iter().zip(spacing) {
            assert_eq!(
                found.map(|step| (step * 100.0).round()),
                wanted.map(|step: f64| (step * 100.0).round()),
                "{text}"
            );
        }
        let map = height_map(&path, IN_NM).unwrap();
        assert!((0..90).all(|k| (map.heights()[k] - height(k / 10, k % 10) * 1e-9).abs() < 1e-15), "{text}");
    }
    let plane: String = (0..9)
        .map(|y| row((0..9).map(|x| format!("{:.2}", 0.8 * x as f64 + 0.3 * y as f64)).collect()))
        .collect();
    assert_eq!(read_head(&plane).points, [9, 9]);
}

/// By save -ascii, writematrix, and dlmwrite with another separator.
#[test]
fn exports_of_matlab_are_read() {
    let exponents = |z: f64| format!("{z:.16e}").replace('e', "e+0").replace("+0-", "-0");
    let ascii = |z: f64| if z.is_nan() { "NaN".to_owned() } else { exponents(z) };
    let lines = (0..NY).map(|iy| (0..NX).map(|ix| format!("{:>26}", ascii(z(ix, iy)))).collect::<String>());
    let text = lines.collect::<Vec<_>>().join("\n");
    assert!(text.contains("   1.25") && text.contains("e-01"), "{text}");
    assert_map(&text, IN_NM, 1e-9, PIXEL);
    for separator in [",", "\t", ";"] {
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(separator) + "\n";
        assert_map(text.lines().map(words).collect::<String>(), IN_NM, 1e-9, PIXEL);
    }
}

#[test]
fn marks_of_missing_points_are_stated_or_named() {
    let text = lines(" ", "-9999");
    let read = |text: &str, missing: Option<Marks>| {
        let (_folder, path) = file(text);
        let file = MapFile { missing, ..MapFile::new(&path, IN_NM) };
        file.height_map().map(|map| RoughnessParameters::new(&map).missing)
    };
    let error = read(&text, None).unwrap_err();
    assert!(matches!(error, ReadError::Mark { count: 1, .. }), "{error}");
    assert_eq!(read(&text, marks(&[-9999.0])).unwrap(), 1);
    assert_eq!(read(&text, marks(&[])).unwrap(), 0, "a height");
    // In the unit of the file where the format has one.
    let header = "# Width: 3 um\n# Height: 3 um\n# Value units: nm\n";
    let (_folder, path) = file(format!("{header}{}", lines(" ", "-99.5")));
    let file = MapFile { missing: marks(&[-99.5]), ..MapFile::new(&path, AS_IT_IS) };
    assert_eq!(RoughnessParameters::new(&file.height_map().unwrap()).missing, 1);
}

#[test]
fn a_transposed_text_has_its_lines_along_y() {
    let (_folder, path) = file(lines(" ", "NaN"));
    let straight = height_map(&path, IN_NM).unwrap();
    let file = MapFile { transpose: true, ..MapFile::new(&path, IN_NM) };
    let turned = file.height_map().unwrap();
    assert_eq!((turned.points(), turned.pixel()), ([NY, NX], PIXEL));
    assert_eq!(file.metadata().unwrap().points, [NY, NX]);
    for (ix, iy) in (0..NX).flat_map(|ix| (0..NY).map(move |iy| (ix, iy))) {
        assert_eq!(turned.heights()[iy * NX + ix].to_bits(), straight.heights()[ix * NY + iy].to_bits());
    }
    // A pixel of the file goes with its axis.
    let (_folder, path) = self::file(points([0.5, 0.25], |x| x));
    let options = ReadOptions { pixel: None, unit: Some(LengthUnits::same(1e-6)) };
    let turned = MapFile { transpose: true, ..MapFile::new(&path, options) }.height_map().unwrap();
    assert_eq!(turned.pixel(), [0.25e-6, 0.5e-6]);
}

#[test]
fn digits_tell_the_precision_but_few_of_them_are_steps() {
    for (number, precision) in [("12.345", f64::EPSILON), ("12.34567", 0.5e-6), ("0.0001234567e-3", 0.5e-6)] {
        let found = read_map(lines(" ", "NaN").replacen("1.25", number, 1), IN_NM).precision();
        assert!((found / precision - 1.0).abs() < 1e-14, "{number}: {found}");
    }
}
