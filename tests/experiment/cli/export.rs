//! `experiment export map|asperities|patches`: what is written gives the same results when it is read.

use asperity::npy;

use super::*;
use crate::results::write_map;

const PIXEL: &str = "0.9e-6";

/// A spec of both models and boundary elements on the surface `a`, at two loads, under a law for spheres and one for ellipses.
fn spec(surface: &str) -> String {
    let lists = surface.starts_with("asperities");
    let models = if lists { "" } else { "models = [\"statistical\", \"deterministic\", \"reference\"]\n" };
    format!(
        "title = \"t\"\nseed = 4\n{}[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = [\"zmc\", \"elliptic-hertz\"]\n\
         separation = [2, 1]\npressure = [\"2 MPa\", \"9 MPa\"]\nrobustness = false\n{models}[surface.a.{surface}\n",
        steel!()
    )
}

/// A folder with a measured map that has a slope and missing points, and the spec `orig.toml` on it.
fn measured() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let wave = |k: usize, f: f64| ((k % 97) as f64 * f).sin();
    write_map(folder.path().join("map.npy"), [60, 48], |i, j| {
        let (k, ix, iy) = (i * 48 + j, i as f64, j as f64);
        let rough = (ix * 1.1 + wave(k, 0.3)).sin() * (iy * 1.3 + wave(k, 0.7)).cos();
        if k == 777 { f64::NAN } else { 1e-9 * ix + 4e-8 * rough + 1e-8 * wave(k * k, 1.7) }
    });
    let surface = format!("file]\npath = \"map.npy\"\npixel = {PIXEL}\nfilter = {{ s = \"2.5 um\" }}\n");
    fs::write(folder.path().join("orig.toml"), spec(&surface)).unwrap();
    folder
}

fn export(folder: &Path, arguments: &[&str]) -> String {
    text(&succeeds(&[&["export"], arguments].concat(), folder).stdout)
}

fn message(folder: &Path, arguments: &[&str]) -> String {
    refused(&[&["export"], arguments].concat(), folder)
}

/// A table of a report on `surface`.
fn tables(folder: &Path, name: &str, surface: &str) -> impl Fn(&str) -> String {
    fs::write(folder.join(format!("{name}.toml")), spec(surface)).unwrap();
    report(folder, name)
}

fn report(folder: &Path, name: &str) -> impl Fn(&str) -> String {
    succeeds(&["run", &format!("{name}.toml"), "--quiet"], folder);
    let report = folder.join("reports").join(name);
    move |table| fs::read_to_string(report.join(table)).unwrap()
}

#[test]
fn a_prepared_map_in_every_format_gives_the_same_curves() {
    let folder = measured();
    let folder = folder.path();
    let orig = report(folder, "orig");
    let said = export(folder, &["map", "orig.toml", "--out", "maps"]);
    assert_eq!(
        said,
        "maps/orig-measured.gwy written\nmaps/orig-levelled.gwy written\nmaps/orig-filtered.gwy written\n"
    );
    for ending in ["gwy", "x3p", "xyz", "npy"] {
        export(
            folder,
            &["map", "orig.toml", "--format", ending, "--step", "filtered", "--out", "maps", "--force"],
        );
        let pixel = if ending == "npy" { format!("pixel = {PIXEL}\n") } else { String::new() };
        let surface = format!("file]\npath = \"maps/orig-filtered.{ending}\"\nlevel = \"none\"\n{pixel}");
        let again = tables(folder, ending, &surface);
        for table in ["curves.csv", "comparison.csv", "reference.csv", "surfaces.csv"] {
            assert!(again(table) == orig(table), "{ending}: {table}");
        }
    }
    // The map as measured gives all of it, by the same preparation.
    export(folder, &["map", "orig.toml", "--format", "x3p", "--step", "measured"]);
    let surface = "file]\npath = \"orig-measured.x3p\"\nfilter = { s = \"2.5 um\" }\n";
    let again = tables(folder, "measured", surface);
    for table in ["curves.csv", "differences.csv", "verdicts.csv", "fitness.csv", "height_maps.csv"] {
        assert!(again(table) == orig(table), "{table}");
    }
    let notes = fs::read_to_string(folder.join("maps/orig-filtered.json")).unwrap();
    let notes: serde_json::Value = serde_json::from_str(&notes).unwrap();
    assert_eq!(
        (&notes["points"], &notes["pixel_m"]),
        (&serde_json::json!([60, 48]), &serde_json::json!([9e-7, 9e-7]))
    );
    assert_eq!(notes["Preparation"], "level = \"plane\", filter = { s = \"2.5e-6 m\" }");
    assert!(notes["File"].as_str().unwrap().starts_with("map.npy, SHA-256 "), "{notes}");
    // The command line does the same with a file.
    export(
        folder,
        &["map", "map.npy", "--pixel", PIXEL, "--s", "2.5 um", "--step", "filtered", "--format", "npy"],
    );
    let [one, other] =
        ["maps/orig-filtered.npy", "map-filtered.npy"].map(|file| fs::read(folder.join(file)).unwrap());
    assert!(one == other);
}

#[test]
fn asperities_as_text_and_as_array_give_the_same_curves() {
    let folder = measured();
    let folder = folder.path();
    let orig = report(folder, "orig");
    let models = |table: String| {
        table.lines().filter(|line| !line.contains("reference")).collect::<Vec<_>>().join("\n")
    };
    for (name, ending) in [("text", "csv"), ("array", "npy")] {
        export(folder, &["asperities", "orig.toml", "--format", ending]);
        let list = fs::read_to_string(folder.join("orig-asperities.csv")).unwrap();
        let area = list.lines().find_map(|line| line.strip_prefix("# Nominal area (m^2): ")).unwrap();
        let surface = format!("asperities]\nfile = \"orig-asperities.{ending}\"\nnominal-area = {area}\n");
        let again = tables(folder, name, &surface);
        // The header names the models, the rows are those of both.
        assert_eq!(models(again("curves.csv")), models(orig("curves.csv")), "{ending}");
    }
    let generated = "generate]\npoints = 64\npixel = \"1 um\"\nsigma = \"50 nm\"\nrealisations = 2\n\
                     spectrum.self-affine = { hurst = 0.8, roll-off = \"32 um\", cut-off = \"8 um\" }\n";
    fs::write(folder.join("random.toml"), spec(generated)).unwrap();
    assert!(
        message(folder, &["asperities", "random.toml"])
            .contains("has 2 realisations of surface a; allowed: --realisation 1 to 2")
    );
    assert!(
        export(folder, &["asperities", "random.toml", "--realisation", "2"])
            .starts_with("./random-2-asperities.csv")
    );
    export(folder, &["map", "random.toml", "--realisation", "1", "--format", "xyz"]);
    let map = fs::read_to_string(folder.join("random-1-measured.xyz")).unwrap();
    assert!(
        map.contains("# Seed: 4\n")
            && map.contains("# Read by a spec with: level = \"none\", periodic = true\n"),
        "{map:.800}"
    );
}

#[test]
fn the_contact_of_a_load_is_that_of_the_report() {
    let folder = measured();
    let folder = folder.path();
    let orig = report(folder, "orig");
    export(folder, &["patches", "orig.toml", "--pressure", "9 MPa", "--format", "npy", "--out", "c"]);
    let notes = fs::read_to_string(folder.join("c/orig-plastic-contact.json")).unwrap();
    let notes: serde_json::Value = serde_json::from_str(&notes).unwrap();
    let number = |key: &str| notes[key].as_str().unwrap().parse::<f64>().unwrap();
    let reference = results::rows(orig("reference.csv").as_bytes());
    let row = reference.iter().find(|row| results::number(row, "pressure_pa") == 9e6).unwrap();
    let cell = |name: &str| results::number(row, name);
    assert_eq!(number("Points in contact over all points"), cell("raw_area_ratio"));
    assert_eq!(number("Contact area over nominal area"), cell("area_ratio"));
    assert_eq!(number("Mean gap (m)"), cell("mean_gap_m"));
    let pressures = npy::matrix(&folder.join("c/orig-plastic-pressures.npy")).unwrap();
    let patches = npy::matrix(&folder.join("c/orig-plastic-patches.npy")).unwrap();
    assert_eq!([pressures.rows, pressures.columns], [60, 48]);
    let mean = pressures.values.iter().sum::<f64>() / (60.0 * 48.0);
    assert!((mean / 9e6 - 1.0).abs() < 1e-9, "{mean}");
    assert!(pressures.values.iter().zip(&patches.values).all(|(&p, &number)| (p > 0.0) == (number > 0.0)));
    assert_eq!(patches.values.iter().copied().fold(0.0, f64::max), number("Patches"));
    // A pixel for each point, the first y at the top.
    let png = png::Decoder::new(std::io::BufReader::new(
        fs::File::open(folder.join("c/orig-plastic-contact.png")).unwrap(),
    ));
    let mut png = png.read_info().unwrap();
    let mut pixels = vec![0; png.output_buffer_size().unwrap()];
    let frame = png.next_frame(&mut pixels).unwrap();
    assert_eq!((frame.width, frame.height), (60, 48));
    assert_eq!(&png.info().palette.as_ref().unwrap()[..3], [255; 3]);
    for (k, p) in pressures.values.iter().enumerate() {
        assert_eq!(pixels[(k % 48) * 60 + k / 48] == 0, *p == 0.0, "{k}");
    }
    let mut chunks = png.info().utf8_text.iter();
    let load = chunks.find(|chunk| chunk.keyword == "Nominal pressure (Pa)").unwrap();
    assert_eq!(load.get_text().unwrap(), "9e6");
    // The loads of the spec, and that of the command line on a file.
    let said = export(folder, &["patches", "orig.toml", "--out", "all"]);
    assert!(
        said.contains("all/orig-elastic-2-MPa-contact.gwy written\n")
            && said.contains("all/orig-plastic-9-MPa-contact.png"),
        "{said}"
    );
    let file = ["patches", "map.npy", "--pixel", PIXEL, "--s", "2.5 um"];
    let load = ["--pressure", "9 MPa", "--material", "steel-100Cr6"];
    assert!(export(folder, &[&file[..], &load].concat()).ends_with("./map-contact.gwy written\n"));
}

#[test]
fn what_cannot_be_exported_says_what_can() {
    let folder = measured();
    let folder = folder.path();
    let two =
        spec("population]\nradius = \"2 um\"\nsigma = \"50 nm\"\ndensity = \"1e10 /m^2\"\ncount = 100\n")
            .replace(", \"reference\"", "")
            .replace(", \"elliptic-hertz\"", "")
            + "[surface.b.file]\npath = \"map.npy\"\npixel = \"1 um\"\n";
    fs::write(folder.join("two.toml"), two).unwrap();
    for arguments in [
        &["map", "two.toml"][..],
        &["map", "two.toml", "--surface", "c"],
        &["map", "two.toml", "--surface", "a"],
        &["map", "two.toml", "--surface", "b", "--realisation", "2"],
        &["map", "orig.toml", "--s", "1 um"],
        &["map", "orig.toml", "--step", "eroded", "--out", "none"],
        &["patches", "two.toml", "--surface", "b"],
        &["patches", "map.npy", "--pixel", "1 um"],
        &["patches", "orig.toml", "--pressure", "9 mm"],
    ] {
        assert_message(module_path!(), &arguments.join(" "), &message(folder, arguments));
    }
    let one = fs::read_to_string(folder.join("orig.toml")).unwrap().replace(", \"elliptic-hertz\"", "");
    fs::write(folder.join("one.toml"), one).unwrap();
    let hard = message(folder, &["patches", "one.toml", "--pressure", "9 GPa"]);
    assert!(hard.contains("not below the hardness"), "{hard}");
    export(folder, &["map", "orig.toml", "--step", "levelled"]);
    let before = fs::read(folder.join("orig-levelled.gwy")).unwrap();
    let taken = message(folder, &["map", "orig.toml"]);
    assert!(taken.contains("orig-levelled.gwy: found a file of this name; allowed: --force"), "{taken}");
    assert!(!folder.join("orig-measured.gwy").exists(), "nothing is written where something is refused");
    assert!(fs::read(folder.join("orig-levelled.gwy")).unwrap() == before);
}
