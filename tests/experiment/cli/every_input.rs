//! Every command on every kind of input: each format of maps, lists, populations, generated maps and pairs.

use asperity::npy;

use super::*;
use crate::results::write_map;

/// Samples of formats, and the options that some need; all are cut, so that boundary elements take little.
const SAMPLES: [(&str, &[&str]); 18] = [
    ("samples/asylum.ibw", &[]),
    ("samples/jpk-map.jpk", &[]),
    ("samples/nanosurf.gwy", &[]),
    ("samples/park.tiff", &[]),
    ("samples/st-al3d-1.al3d", &[]),
    ("samples/st-bcrf-1.bcrf", &[]),
    ("samples/st-di-3.spm", &[]),
    ("samples/st-metropro-1.dat", &[]),
    ("samples/st-nid-1.nid", &[]),
    ("samples/st-opd-1.opd", &[]),
    ("samples/st-plu-1.plu", &[]),
    ("samples/st-sur-2.sur", &[]),
    ("samples/zygo_test.datx", &[]),
    ("surface_binary.x3p", &[]),
    ("iso1_surface_binary.sdf", &[]),
    ("waves.npy", &["--pixel", "1 um"]),
    ("matrix.txt", &["--pixel", "1 um", "--unit", "um"]),
    ("points.txt", &["--unit", "xy=um, z=nm"]),
];

fn height(i: usize, j: usize) -> f64 {
    let (x, y) = (i as f64, j as f64);
    1e-7 * ((0.9 * x + (0.31 * y).sin()).sin() * (0.7 * y + (0.23 * x).cos()).cos()
        + 0.3 * (0.41 * x * y / 9.0).sin())
}

/// The inputs that no sample holds, of 40 points a side.
fn write_inputs(folder: &Path) {
    const SIDE: usize = 40;
    let all = || (0..SIDE * SIDE).map(|k| (k / SIDE, k % SIDE));
    let file = |name: &str| fs::File::create(folder.join(name)).unwrap();
    write_map(folder.join("waves.npy"), [SIDE; 2], height);
    let line =
        |j: usize| (0..SIDE).map(|i| format!("{:.6}", 1e6 * height(i, j))).collect::<Vec<_>>().join(" ");
    fs::write(folder.join("matrix.txt"), (0..SIDE).map(line).collect::<Vec<_>>().join("\n")).unwrap();
    let points: String = all().map(|(j, i)| format!("{i} {j} {:.4}\n", 1e9 * height(i, j))).collect();
    fs::write(folder.join("points.txt"), points).unwrap();
    let rows = (0..2000).flat_map(|k| [height(k, 7 * k), 2e-5 + 1e-6 * height(k, k) / 1e-7]);
    npy::write(file("list.npy"), [2000, 2], rows).unwrap();
    let rows: String = (0..300).map(|k| format!("{:e},{:e}\n", height(k, 3 * k), 2e-5)).collect();
    fs::write(folder.join("list.csv"), format!("height [m],radius [m]\n{rows}")).unwrap();
    let generated = generated!("a", 64, "0.5 um", "0.1 um", "16 um" to "4 um");
    let body = |name: &str| generated.replace("surface.a", &format!("surface.{name}"));
    let list = |file: &str| format!("asperities]\nfile = \"{file}\"\nnominal-area = \"3e-8 m^2\"\n");
    for (name, surfaces) in [
        ("list-npy", format!("[surface.a.{}", list("list.npy"))),
        ("list-csv", format!("[surface.a.{}", list("list.csv"))),
        ("population", results::population("a", 2000, "")),
        ("generated", generated.to_owned()),
        (
            "pair",
            [
                "surfaces = [\"a\"]\n[surface.a.pair]\na = \"b\"\nb = \"c\"\nshifts = 2\n",
                &body("b"),
                &body("c"),
            ]
            .concat(),
        ),
    ] {
        let models = if ["generated", "pair"].contains(&name) {
            "models = [\"statistical\", \"deterministic\", \"reference\"]\n"
        } else {
            ""
        };
        let text = format!(
            "title = \"t\"\n{}[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\npressure = [\"1 MPa\", \"3 MPa\"]\n{models}{surfaces}",
            steel!()
        );
        fs::write(folder.join(format!("{name}.toml")), text).unwrap();
    }
}

#[test]
fn every_command_runs_on_every_input() {
    let folder = tempfile::tempdir().unwrap();
    write_inputs(folder.path());
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/asperity/tests/library/formats");
    let mut wrong = Vec::new();
    let mut expect = |arguments: &[&str], refusal: Option<&str>| {
        let output = experiment(arguments, folder.path());
        let said = text(&output.stderr);
        let is_right = match refusal {
            None => output.status.success(),
            Some(words) => output.status.code() == Some(2) && said.contains(words),
        };
        if !is_right {
            wrong.push(format!("{arguments:?}: {:?} {said}", output.status.code()));
        }
    };
    for (name, options) in SAMPLES {
        let path =
            if name.contains('.') && samples.join(name).is_file() { samples.join(name) } else { name.into() };
        let file = path.to_str().unwrap();
        let force = ["--out", "out", "--force", "--threads", "1"];
        let with = |command: &[&str], more: &[&str]| -> Vec<String> {
            [command, &[file], options, more, &force].concat().into_iter().map(str::to_owned).collect()
        };
        for (command, more) in [
            (&["surface"][..], &[][..]),
            (&["export", "map"], &[]),
            (&["export", "asperities"], &[]),
            (&["export", "patches"], &["--pressure", "1 MPa"]),
        ] {
            let arguments = with(command, more);
            let has_gaps = ["opd", "datx", "sdf"].iter().any(|ending| name.ends_with(ending));
            let refusal = (command == ["export", "patches"] && has_gaps)
                .then_some("allowed for boundary elements: at most 1 %");
            expect(&arguments.iter().map(String::as_str).collect::<Vec<_>>(), refusal);
        }
    }
    let no_map = "has no height map";
    for (spec, map, asperities, patches) in [
        (
            "list-npy.toml",
            Some(no_map),
            Some("allowed: a surface whose asperities are found"),
            Some("has no boundary elements"),
        ),
        (
            "list-csv.toml",
            Some(no_map),
            Some("allowed: a surface whose asperities are found"),
            Some("has no boundary elements"),
        ),
        ("population.toml", Some(no_map), None, Some("has no boundary elements")),
        ("generated.toml", None, None, None),
        ("pair.toml", None, None, None),
    ] {
        let chosen: &[&str] =
            if spec == "pair.toml" { &["--surface", "a", "--realisation", "1"] } else { &[] };
        expect(&["check", spec], None);
        expect(&["run", spec], None);
        expect(&["surface", spec], None);
        expect(&[&["export", "map", spec], chosen].concat(), map);
        expect(&[&["export", "asperities", spec], chosen].concat(), asperities);
        let one: &[&str] = if spec == "pair.toml" { &["--realisation", "1"] } else { &[] };
        expect(&[&["export", "patches", spec], one].concat(), patches);
        expect(&["export", "interface", spec, "--beyond"], None);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn several_files_have_a_report_each_and_one_table_of_answers() {
    let folder = tempfile::tempdir().unwrap();
    write_inputs(folder.path());
    fs::create_dir(folder.path().join("other")).unwrap();
    for name in ["other/waves.npy", "waves.002", "waves.004"] {
        fs::copy(folder.path().join("waves.npy"), folder.path().join(name)).unwrap();
    }
    let files = ["waves.npy", "other/waves.npy", "waves.002", "waves.004", "missing.npy"];
    let output =
        experiment(&[&["surface"][..], &files, &["--pixel", "1 um", "--quiet"]].concat(), folder.path());
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let reports = folder.path().join("reports");
    for name in ["surface-waves", "surface-waves-npy", "surface-waves-002", "surface-waves-004"] {
        assert!(reports.join(name).join("report.html").is_file(), "{name}");
    }
    let answers = fs::read_to_string(reports.join("answers.csv")).unwrap();
    assert_eq!(answers.lines().count(), 1 + files.len(), "{answers}");
    assert!(answers.lines().last().unwrap().starts_with("missing.npy,,missing.npy"), "{answers}");
    let said = text(&output.stdout);
    assert!(said.lines().count() == files.len() && said.starts_with("waves.npy: "), "{said}");
    assert!(said.lines().last().unwrap().matches("missing.npy").count() == 1, "{said}");
    // The same names again, and nothing but errors where that is asked for.
    let again = experiment(
        &["surface", "other/waves.npy", "waves.npy", "--pixel", "1 um", "--silent"],
        folder.path(),
    );
    assert!(again.status.success() && again.stdout.is_empty(), "{}", text(&again.stdout));
    assert_eq!(fs::read_dir(&reports).unwrap().flatten().filter(|entry| entry.path().is_dir()).count(), 4);
    // One report alone, its answer in few lines.
    let one =
        text(&experiment(&["surface", "waves.npy", "--pixel", "1 um", "--quiet"], folder.path()).stdout);
    assert!(one.starts_with("Result") && one.contains("May the integral replace the sum?"), "{one}");
}

#[test]
fn a_part_of_a_map_is_as_the_part_alone() {
    let folder = tempfile::tempdir().unwrap();
    write_inputs(folder.path());
    write_map(folder.path().join("part.npy"), [30; 2], |i, j| height(5 + i, 10 + j));
    let columns = |file: &str, options: &[&str]| {
        let arguments =
            [&["export", "asperities", file, "--format", "npy", "--quiet", "--force"], options].concat();
        succeeds(&arguments, folder.path());
        let name = format!("{}-asperities.npy", file.split('.').next().unwrap());
        fs::read(folder.path().join(name)).unwrap()
    };
    let alone = columns("part.npy", &["--pixel", "1 um"]);
    let crop = ["--crop-x", "5 um, 35 um", "--crop-y", "10 um, 40 um"];
    assert_eq!(columns("waves.npy", &[&["--pixel", "1 um"], &crop[..]].concat()), alone);
    let turned = ["--crop-y", "5 um, 35 um", "--crop-x", "10 um, 40 um", "--transpose", "--pixel", "1 um"];
    assert_ne!(columns("waves.npy", &turned), alone);
    for ends in ["5 um, 50 um", "30 um, 5 um", "5 um, 6 um", "5 um"] {
        let said = refused(&["surface", "waves.npy", "--pixel", "1 um", "--crop-x", ends], folder.path());
        assert_message(module_path!(), &format!("--crop-x {ends}"), &said);
    }
}

/// What is advised of a surface can be followed: no boundary elements on a map with holes, no L filter that stands already or is too short, and
/// all at once what a file does not say.
#[test]
fn advice_can_be_followed() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, side: usize, height: &dyn Fn(usize, usize) -> f64| {
        write_map(folder.path().join(name), [side; 2], height);
    };
    let said = |arguments: &[&str]| {
        let output = experiment(&[&["surface"], arguments].concat(), folder.path());
        text(&output.stdout) + &text(&output.stderr)
    };
    let hole = |of: usize| move |i: usize, j: usize| if i < of && j < of { f64::NAN } else { height(i, j) };
    write("holed.npy", 40, &hole(5));
    write("whole.npy", 40, &hole(2));
    let holed = said(&["holed.npy", "--pixel", "1 um"]);
    assert!(
        holed.contains("Not possible: more than 1 % of the map is missing") && !holed.contains("--reference"),
        "{holed}"
    );
    assert!(said(&["whole.npy", "--pixel", "1 um"]).contains("--reference"));
    // A tilt that levelling keeps is longer than any map of it.
    let long = |i: usize, j: usize| 1e-6 * i as f64 + height(i, j);
    write("long.npy", 40, &long);
    let first = said(&["long.npy", "--pixel", "1 um", "--level", "none"]);
    assert!(first.contains("or an L filter (`--l \"6.7 µm\"`)"), "{first}");
    write("few.npy", 12, &long);
    let few = said(&["few.npy", "--pixel", "1 um", "--level", "none"]);
    assert!(few.contains("long-waves") && !few.contains("or an L filter"), "{few}");
    let mut bare = b"Gwyddion Simple Field 1.0\nXRes=4\nYRes=4\n\0\0\0\0".to_vec();
    bare.truncate(bare.len() / 4 * 4);
    bare.extend((0..16u8).flat_map(|k| f32::from(k * k % 7).to_le_bytes()));
    fs::write(folder.path().join("bare.gsf"), bare).unwrap();
    let asked = said(&["bare.gsf"]);
    assert!(asked.contains("such as `--unit um`; and the pixel, such as `--pixel \"0.8 um\"`"), "{asked}");
}
