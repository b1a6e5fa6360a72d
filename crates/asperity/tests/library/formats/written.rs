//! Maps that are written and read back.

use std::io::{Read, Write};

use asperity::progress::Silent;
use asperity::surface::{AnalysisDepth, Preparation, Step, SummitSearch};
use asperity::topography::summits::Neighbours;
use asperity::topography::write::{FORMATS, GwyField, MapFormat, Note, gwy, whole_file};
use asperity::topography::{Filter, read};

use super::refused::Good;
use super::*;

fn format(ending: &str) -> &'static MapFormat {
    MapFormat::of_ending(ending).unwrap()
}

fn notes() -> Vec<Note> {
    vec![("Preparation", "level = \"plane\" & s < 2 µm".to_owned()), ("Origin", "two\nlines".to_owned())]
}

/// A map of numbers that no format may round: sizes whose quotients are not representable, a border that is missing, zeros of both
/// signs, the smallest number, many digits.
fn odd(points: [usize; 2], pixel: [f64; 2]) -> HeightMap {
    let height = |k: usize| match (k / points[1], k % points[1]) {
        (0, _) | (_, 0) | (4, 3) => f64::NAN,
        (1, 1) => -0.0,
        (1, 2) => f64::from_bits(1),
        _ => (k as f64).sin() * 1e-7 / 3.0,
    };
    HeightMap::new(points, pixel, (0..points[0] * points[1]).map(height).collect(), 0.0).unwrap()
}

/// The bits of heights, all missing ones alike.
fn bits(heights: &[f64]) -> Vec<u64> {
    heights.iter().map(|z| if z.is_nan() { u64::MAX } else { z.to_bits() }).collect()
}

#[test]
fn a_map_is_read_back_to_the_bit_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    for (points, pixel) in [
        ([7, 5], [15.0 * 1e-7, 1e-6 / 7.0]),
        ([31, 49], [25.0 * 1e-7, 9.0 * 1e-7]),
        ([5, 9], [9.0 * 1e-7, 1.1e-3]),
    ] {
        let map = odd(points, pixel);
        let assert_read_back = |path: &Path, has_pixel: bool| {
            let options = ReadOptions { pixel: Some(pixel).filter(|_| !has_pixel), unit: None };
            let found = read::height_map(path, options).unwrap();
            assert_eq!((found.points(), found.pixel()), (points, pixel), "{path:?}");
            assert_eq!(bits(found.heights()), bits(map.heights()), "{path:?}");
        };
        for format in FORMATS {
            let path = folder.path().join(format!("a.{}", format.ending));
            format.write_file(&path, &map, &notes()).unwrap();
            assert_read_back(&path, format.holds_notes);
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), FORMATS.len(), "a part is left");
        let array = folder.path().join("a.npy");
        map.write_npy(&array).unwrap();
        assert_read_back(&array, false);
    }
}

/// The size of three points of 13e-7 over their number is another pixel.
#[test]
fn the_pixel_of_a_gwy_is_the_stated_one_unless_it_was_rescaled() {
    let (points, pixel) = ([3, 3], [13.0 * 1e-7; 2]);
    assert_ne!(pixel[0] * 3.0 / 3.0, pixel[0]);
    let map = HeightMap::new(points, pixel, (0..9).map(f64::from).collect(), 0.0).unwrap();
    let mut bytes = std::io::Cursor::new(Vec::new());
    format("GWY").write(&mut bytes, &map, &[]).unwrap();
    let bytes = bytes.into_inner();
    assert_eq!(read_map(&bytes, AS_IT_IS).pixel(), pixel);
    let place = bytes.windows(6).position(|found| found == b"xreal\0").unwrap() + 7;
    let mut rescaled = bytes;
    rescaled[place..place + 8].copy_from_slice(&6e-6f64.to_le_bytes());
    assert_eq!(read_map(&rescaled, AS_IT_IS).pixel()[0], 2e-6);
}

#[test]
fn an_x3p_keeps_the_offset_and_its_check_sums() {
    let map = odd([7, 5], [1e-6, 2e-6]).with_offset(1.0 / 3.0);
    let mut bytes = std::io::Cursor::new(Vec::new());
    format("x3p").write(&mut bytes, &map, &notes()).unwrap();
    let found = read_map(bytes.get_ref(), AS_IT_IS);
    assert_eq!((found.offset(), bits(found.heights())), (1.0 / 3.0, bits(map.heights())));
    let mut archive = zip_of(bytes.get_ref());
    let mut text = String::new();
    archive.by_name("main.xml").unwrap().read_to_string(&mut text).unwrap();
    assert!(text.contains("Preparation: level = \"plane\" &amp; s &lt; 2 µm\nOrigin: two lines"), "{text}");
    let mut data = Vec::new();
    archive.by_name("bindata/data.bin").unwrap().read_to_end(&mut data).unwrap();
    let third_of_second_line = 7 + 2;
    assert_eq!(data[8 * third_of_second_line..][..8], map.heights()[2 * 5 + 1].to_le_bytes());
}

fn zip_of(bytes: &[u8]) -> zip::ZipArchive<std::io::Cursor<&[u8]>> {
    zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap()
}

#[test]
fn a_gwy_of_two_fields_has_both_as_channels() {
    let map = odd([7, 5], [1e-6, 2e-6]);
    let mut bytes = std::io::Cursor::new(Vec::new());
    let fields = [
        GwyField { title: "Contact pressure", unit: "Pa", map: &map },
        GwyField { title: "Height", unit: "m", map: &map },
    ];
    gwy(&mut bytes, &fields, &notes()).unwrap();
    let (_folder, path) = file(bytes.get_ref());
    let channel = metadata(&path).unwrap().channel.unwrap();
    assert_eq!(channel.name, "Height");
    assert_eq!(channel.others[0].to_string(), "\"Contact pressure\" (Pa)");
    assert_eq!(bits(height_map(&path, AS_IT_IS).unwrap().heights()), bits(map.heights()));
}

const GRID: &str = "# Grid: 4 x 4 points, 1 x 2\n# x [m] y [m] z [m]\n0 0 1\n1 0 2\n0 2 3\n3 6 4\n1 2 5\n";

pub fn good() -> Vec<Good> {
    vec![Good::whole("text of points of a grid", GRID)]
}

#[test]
fn the_stated_grid_of_columns_is_that_of_the_map() {
    let map = read_map(GRID, AS_IT_IS);
    assert_eq!((map.points(), map.pixel()), ([4, 4], [1.0, 2.0]));
    assert_eq!(map.heights()[15], 4.0);
    // A comment of another program.
    let other = "# Grid: regular\n0 0 1\n1 0 2\n2 0 3\n0 1 4\n1 1 5\n2 1 6\n0 2 6\n1 2 6\n2 2 6\n";
    assert_eq!(read_map(other, AS_IT_IS).points(), [3, 3]);
}

#[test]
fn a_map_is_given_after_every_step_of_its_preparation() {
    let points = [64, 48];
    let mut heights: Vec<f64> = (0..points[0] * points[1])
        .map(|k| 1e-9 * k as f64 + 1e-7 * ((k / 48) as f64 * 0.7).sin() * ((k % 48) as f64 * 0.9).cos())
        .collect();
    heights[1000] += 1e-4;
    let map = HeightMap::new(points, [1e-6; 2], heights, 0.0).unwrap();
    let preparation = Preparation {
        removes_spikes: true,
        tip: Some(2e-6),
        level: Level::Plane,
        filter: Some(Filter::new(Some(2.5e-6), None).unwrap()),
        ..Preparation::none(Neighbours::Four)
    };
    let search = SummitSearch { keeps_map: true, ..SummitSearch::new(preparation) };
    let mut found: Vec<(Step, HeightMap)> = Vec::new();
    search.each_step(&map, |step, map| found.push((step, HeightMap::from_rows(map)))).unwrap();
    let steps: Vec<&str> = found.iter().map(|(step, _)| step.name()).collect();
    assert_eq!(steps, ["measured", "spikes-removed", "eroded", "levelled", "filtered"]);
    assert_eq!(found[0].1, map);
    assert!(found[1].1.heights()[1000].is_nan());
    let searched = search.surface("a", &map).unwrap().prepared.unwrap();
    assert_eq!(bits(found[4].1.heights()), bits(searched.map.heights()));
    // What was written of the last step has the same asperities.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("filtered.gwy");
    format("gwy").write_file(&path, &found[4].1, &[]).unwrap();
    let again = height_map(&path, AS_IT_IS).unwrap();
    let none = SummitSearch {
        depth: AnalysisDepth::Asperities,
        progress: &Silent,
        ..SummitSearch::new(Preparation::none(Neighbours::Four))
    };
    let (one, other) = (search.surface("a", &map).unwrap(), none.surface("a", &again).unwrap());
    assert_eq!(bits(one.set.heights()), bits(other.set.heights()));
    assert_eq!(bits(one.set.radii()), bits(other.set.radii()));
}

/// A process that was killed leaves a file beside its place, which the next one that writes the same file removes.
#[test]
fn what_killed_processes_left_goes() {
    let folder = tempfile::tempdir().unwrap();
    let beside = |name: &str| folder.path().join(name);
    let others = [".a.txt.4242x", ".b.txt.4242", ".a.txt"];
    for name in [".a.txt.4242"].iter().chain(&others) {
        std::fs::write(beside(name), "half").unwrap();
    }
    whole_file(&beside("a.txt"), |out| out.write_all(b"whole")).unwrap();
    assert_eq!(std::fs::read(beside("a.txt")).unwrap(), b"whole");
    assert!(!beside(".a.txt.4242").exists() && others.iter().all(|name| beside(name).exists()));
    // Another process that writes it holds a lock.
    let other = std::fs::File::create(beside(".a.txt.4243")).unwrap();
    other.lock().unwrap();
    whole_file(&beside("a.txt"), |_| Err(std::io::ErrorKind::StorageFull.into())).unwrap_err();
    assert_eq!(std::fs::read(beside("a.txt")).unwrap(), b"whole");
    assert!(beside(".a.txt.4243").exists());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2 + others.len());
}
