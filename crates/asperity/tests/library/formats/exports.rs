//! Texts as programs of instruments export them: their headers, their words for missing points, and lines above a table that are not known.

use super::refused::Good;
use super::*;

pub fn good() -> Vec<Good> {
    vec![
        Good::whole("text of zygo", zygo("ASCII", "2e-6") + "#\n1 2 3\n#\n"),
        Good::whole("text of keyence", keyence(ENGLISH, ",", "\"", ".")),
    ]
}

#[test]
fn headers_of_gwyddion_are_read_in_every_language() {
    // German, French with its blanks, Czech, Spanish, Italian, Portuguese, Russian, Japanese with wide colons, Korean, Chinese.
    for [channel, width, height, unit] in [
        ["Kanal:", "Breite:", "Höhe:", "Value units:"],
        ["Canal\u{a0}:", "Largeur\u{a0}:", "Hauteur\u{a0}:", "Unités\u{a0}:"],
        ["Kanál:", "Šířka:", "Výška:", "Jednotky hodnot:"],
        ["Canal:", "Anchura:", "Altura:", "Unidades de valor:"],
        ["Canale:", "Larghezza:", "Altezza:", "unità valore:"],
        ["Canal:", "Largura:", "Altura:", "Unidades do valor:"],
        ["Канал:", "Ширина:", "Высота:", "Единицы измерения:"],
        ["チャネル：", "幅：", "高さ：", "値の単位："],
        ["채널:", "폭:", "높이:", "값 단위:"],
        ["通道：", "宽度：", "高度：", "值单位："],
    ] {
        let head = format!("# {channel} Z 5 µm\n# {width} 10,0 µm\n# {height} 12000\u{a0}nm\n# {unit} nm\n");
        let head = assert_map(head + &lines("\t", "NaN"), AS_IT_IS, 1e-9, PIXEL);
        assert!(head.has_unit && head.notes.is_empty());
        let without = format!("# {width} 10 µm\n# {height} 12 µm\n# {unit} V\n{}", lines("\t", "NaN"));
        assert!(matches!(refused(&without), ReadError::Unsupported(_)), "{without}");
        // Numbers without a unit are asked for one.
        let bare = without.replace(" V\n", "\n");
        assert!(matches!(refused(&bare), ReadError::Options(_)), "{bare}");
        assert_map(bare, ReadOptions { unit: IN_NM.unit, ..AS_IT_IS }, 1e-9, PIXEL);
    }
    // Comments that are no such header.
    for comments in ["# Pixel: 1 um\n# Range: 3 um\n", "# Step: 1 um\n# Range: 3 um\n# Date: 2024-01-02\n"] {
        let head = assert_map(format!("{comments}{}", lines("\t", "NaN")), IN_NM, 1e-9, PIXEL);
        assert_eq!((head.pixel, head.has_unit), (None, false));
    }
}

const ENGLISH: [&str; 5] = ["Measurement data type", "Horizontal", "Vertical", "XY Calibration", "Unit"];

/// A text of a Keyence VK in one of its languages.
fn keyence(labels: [&str; 5], separator: &str, quote: &str, point: &str) -> String {
    let [mode, across, down, xy, unit] = labels;
    let text = format!(
        "{mode};ImageDataCsv\nDate;2024-01-02 10:11:12\n{across};5\n{down};4\n{xy};2000.000;nm\n{unit};nm\n\nHeight\n{}",
        lines(";", "")
    );
    let quoted = |cell: &str| format!("{quote}{cell}{quote}");
    let line = |line: &str| line.split(';').map(quoted).collect::<Vec<_>>().join(separator) + "\r\n";
    let lines = text.lines().map(|text| if text.is_empty() { "\r\n".to_owned() } else { line(text) });
    lines.collect::<String>().replace('.', point)
}

#[test]
fn headers_of_keyence_are_read_with_and_without_quotes() {
    let square = [PIXEL[0]; 2];
    for (separator, quote, point) in
        [(",", "\"", "."), (",", "", "."), (";", "\"", ","), (";", "", ","), ("\t", "", ".")]
    {
        let text = keyence(ENGLISH, separator, quote, point);
        let head = assert_map(format!("\u{feff}{text}"), AS_IT_IS, 1e-9, square);
        assert_eq!(
            (head.format, head.has_unit, &*head.notes),
            ("a text of a Keyence microscope", true, &[][..])
        );
        // Excel saves it as UTF-16.
        let wide: Vec<u8> = format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_map(wide, AS_IT_IS, 1e-9, square);
    }
    // In the encodings of Japan and China the µ has two bytes, the labels any.
    for (micro, label) in [(&b"\x83\xca"[..], &b"\x8d\x82\x82\xb3"[..]), (b"\xa6\xcc", b"\xb5\xa5\xce\xbb")] {
        let labels = ["@", "@ ", "@  ", "XY@", "@@"];
        let text = keyence(labels, ",", "\"", ".").replace("2000.000", "2").replace("\"nm\"", "\"#\"");
        let bytes: Vec<u8> = text
            .bytes()
            .flat_map(|byte| match byte {
                b'@' => label.to_vec(),
                b'#' => [micro, b"m"].concat(),
                _ => vec![byte],
            })
            .collect();
        let head = read_head(&bytes);
        assert_eq!((head.pixel, head.has_unit), (Some([2e-6; 2]), true));
    }
    // Light has no unit of length: it is asked for.
    let light = keyence(ENGLISH, ",", "\"", ".").replace("\"Unit\",\"nm\"", "\"Unit\",\"\"");
    assert_map(light, ReadOptions { unit: IN_NM.unit, ..AS_IT_IS }, 1e-9, square);
}

/// The header of a Zygo text of this kind.
fn zygo(kind: &str, resolution: &str) -> String {
    format!(
        "Zygo {kind} Data File - Format 1\n0 9 2 0 \"Tue Jan 02 10:11:12 2024\"\n0 0 0 0 0 0\n10 20 {NX} {NY}\n\"\"\n\"\"\n\"\"\n\
         0 0.5 6.328e-07 0.5 1 0 {resolution} 1704190272\n1200 1200 0 0 1 0 \"\"\n0 0 1 36 0 1 0 0 0 0\n1 1 100 0 0 0 0 0 0\n\
         0 \"\"\n1 0.01\n#\n"
    )
}

#[test]
fn texts_of_zygo_are_read() {
    let point = |ix: usize, iy: usize| {
        let z = z(ix, iy);
        let z = if z.is_nan() { "No Data".to_owned() } else { z.to_string() };
        format!("{}\t{}  {z}\n", ix + 10, iy + 20)
    };
    let points: String = (0..NX * NY).map(|k| point(k % NX, k / NX)).collect();
    let head = assert_map(zygo("XYZ", "0.000002") + &points + "#\n", AS_IT_IS, 1e-6, [2e-6; 2]);
    assert_eq!((head.format, head.has_unit), ("a text of Zygo", true));
    let crlf = (zygo("XYZ", "2e-6") + &points + "#\n").replace('\n', "\r\n");
    assert_map(crlf, AS_IT_IS, 1e-6, [2e-6; 2]);
    // A camera that is not calibrated.
    let head =
        assert_map(zygo("XYZ", "0") + &points, ReadOptions { pixel: Some(PIXEL), unit: None }, 1e-6, PIXEL);
    assert_eq!(head.pixel, None);
}

#[test]
fn texts_of_nanoscope_are_read_with_and_without_a_header() {
    let table = lines(",", "");
    let header = "\\*File list\n\\Version: 0x09400000\n\\*Ciao scan list\n\\Lines: 4\n\\*Ciao image list\n\\Scan Size: 10 12 ~m\n\
                  \\@2:Image Data: S [DeflectionError] \"Deflection Error\"\n\\*Ciao image list\n\\Scan Size: 10 12 ~m\n\
                  \\@2:Image Data: S [Height] \"Height\"\n\\*File list end";
    let both = format!("\\Exported image units: V\n{table}\\Exported image units: nm\n{table}");
    let quoted: String = header.lines().map(|line| format!("\"{}\"\n", line.replace('"', "\"\""))).collect();
    for header in [format!("{header}\n"), quoted, header.replacen('\\', "?", 1) + "\n"] {
        let text = format!("{header}{both}").replace('\n', "\r\n");
        let head = assert_map(&text, AS_IT_IS, 1e-9, PIXEL);
        assert_eq!((head.format, head.has_unit), ("a text of Nanoscope", true));
        assert_eq!(channels(&text), ["Height", "\"Deflection Error\" (V)"]);
    }
    let bare = format!("\\Exported image units: nm\n{}", lines("\t", "NaN"));
    let head = assert_map(bare, ReadOptions { pixel: Some(PIXEL), unit: None }, 1e-9, PIXEL);
    assert_eq!((head.pixel, head.has_unit), (None, true));
}

/// Lines above a table that no known program writes are left out, which a note says.
#[test]
fn lines_above_a_table_are_left_out_with_a_word() {
    for (head, found) in [
        (
            "Instrument XY Export v1.2\nDate: 2024-01-02, 5.5\nOperator: me\n",
            "is read from line 4 on: what stands above (\"Instrument XY Export v1.2\")",
        ),
        ("h=650, w=650.5\n", "is read from line 2 on"),
        ("\"Model\",\"K\"\n\n\"Pitch\",\"0.5\"\n", "is read from line 4 on"),
        ("5\n4\n", "is read from line 3 on"),
        ("# a comment\n5 4\n", "is read from line 3 on: what stands above (\"5 4\")"),
        ("4\t5\t1.7465\r\nZ-data (um)\r\n", "is read from line 3 on"),
        ("[Header]\nRows=4\n[Data]\n", "is read from line 4 on"),
    ] {
        for separator in [" ", ";", "\t", ","] {
            let head = match head {
                // So many numbers in a line could be a row that is cut.
                "4\t5\t1.7465\r\nZ-data (um)\r\n" => "4\t5\r\nZ-data (um)\r\n",
                _ => head,
            };
            let read = assert_map(format!("{head}{}", lines(separator, "***")), IN_NM, 1e-9, PIXEL);
            assert!(matches!(&read.notes[..], [note] if note.contains(found)), "{:?} {found}", read.notes);
        }
    }
    // Names of columns below such lines, and points.
    let points = super::text::points([0.5, 0.25], |x| x);
    let text = format!("Export of a program\nDate: today\nx [um] y [um] z [nm]\n{points}");
    let head = assert_map(text, AS_IT_IS, 1e-9, [0.5e-6, 0.25e-6]);
    assert!(
        head.notes[0].contains("from line 3 on")
            && matches!(head.named, asperity::topography::read::NamedUnits::Known(_))
    );
}

#[test]
fn words_of_missing_points_are_known_or_can_be_given() {
    let words = "***|*|#N/A|#NV|1.#IND|-1.#IND00|1.#QNAN|1.#INF|VOID|BAD|NoData|n/a|---|?|nan(ind)|No Data|NULL|#DIV/0!";
    for word in words.split('|') {
        for separator in [" ", ";", "\t", ","] {
            assert_map(lines(separator, word), IN_NM, 1e-9, PIXEL);
        }
        // The first line and the first cell too.
        let text = format!("{word} {word} {word} {word} {word}\n{}", lines(" ", word));
        let map = read_map(text, IN_NM);
        assert_eq!((map.points(), RoughnessParameters::new(&map).missing), ([NX, NY + 1], NX + 1), "{word}");
    }
    for word in ["dropout", "n.m.", "~", "not measured"] {
        let given = |text: &str| {
            let (_folder, path) = file(text);
            let words = Marks { heights: Vec::new(), words: vec![word.to_owned()] };
            let file = MapFile { missing: Some(words), ..MapFile::new(&path, IN_NM) };
            RoughnessParameters::new(&file.height_map().unwrap()).missing
        };
        // Blanks beside commas say nothing.
        for separator in if word.contains(' ') { [" ", ";"] } else { [";", ","] } {
            let row = [word; NX].join(separator) + "\n";
            for (text, missing, line) in [
                (lines(separator, word), 1, 2),
                (row.clone() + &lines(separator, word), NX + 1, 1),
                (lines(separator, word).replace("\n-2", &format!("\n{word}")), 2, 2),
            ] {
                let (_folder, path) = file(&text);
                let error = height_map(&path, IN_NM).unwrap_err();
                assert!(matches!(error, ReadError::Word { .. }), "{error}: {text}");
                // A line of several words is no row of a table, unlike one of one word several times.
                if !word.contains(' ') || separator != " " {
                    assert!(error.to_string().starts_with(&format!("line {line}, column ")), "{error}");
                }
                if let (1, ReadError::Word { word: found, .. }) = (missing, &error) {
                    assert_eq!(found, word);
                }
                assert_eq!(given(&text), missing, "{text}");
            }
        }
    }
}
