//! `experiment surface`.

use super::*;
use crate::results::{typed, waves, write_map};

#[test]
fn a_surface_is_described() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("reports");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let look = |arguments: &[&str]| succeeds(&[&["surface"], arguments].concat(), folder.path());
    let message = |arguments: &[&str]| refused(&[&["surface"], arguments].concat(), folder.path());
    let opd = root.join("experiments/surfaces/opd-1.npy");
    let opd = opd.to_str().unwrap();

    let said = text(&look(&[opd, "--pixel", "196.73303177114576 nm"]).stdout);
    for words in ["24,714", "304,784", "6.71 nm", "-0.367", "4.54", "autocorrelation length Sal"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    for file in
        ["opd-1-heights.svg", "opd-1-spectrum.svg", "opd-1-autocorrelation.svg", "opd-1-asperities.svg"]
    {
        assert!(out.join("surface-opd-1").join(file).exists(), "{file}");
    }
    let map = &summary(&out, "surface-opd-1")["surfaces"]["opd-1"]["height_map"];
    assert_eq!(map["summits"], 24714);
    // Sal from the definition in numpy: unbiased pairs about the mean, least distance to 0.2 over all directions.
    assert!((map["autocorrelation_length_m"].as_f64().unwrap() / 3.64e-6 - 1.0).abs() < 0.01);

    let x3p = look(&[root.join("experiments/surfaces/x3p-2.x3p").to_str().unwrap()]);
    assert!(text(&x3p.stdout).contains("2,916"), "{}", text(&x3p.stderr));
    let spec = look(&[root.join("experiments/heights-of-one-spectrum.toml").to_str().unwrap(), "--silent"]);
    assert!(spec.stdout.is_empty());
    assert!(out.join("heights-of-one-spectrum-surfaces/honed-heights.svg").exists());

    // Another file of that name does not take its place, the same one does.
    let heights = waves(96, [32.0, 8.0], 5);
    write_map(folder.path().join("opd-1.npy"), [96; 2], |i, j| heights[i * 96 + j]);
    look(&["opd-1.npy", "--pixel", "0.2 um"]);
    assert!(out.join("surface-opd-1-npy").is_dir());
    let taken = message(&["opd-1.npy", "--pixel", "0.2 um", "--name", "surface-opd-1"]);
    assert!(taken.contains("allowed: --name NAME"), "{taken}");
    look(&["opd-1.npy", "--pixel", "0.2 um", "--name", "copy"]);
    look(&["opd-1.npy", "--pixel", "2.1e-7"]);

    for arguments in [
        &["opd-1.npy"][..],
        &["opd-1.npy", "--pixel", "0,5 um"],
        &["opd-1.npy", "--pixel", "1 um, 2 um, 3 um"],
        &["opd-1.npy", "--pixel", "0.2 um", "--unit", "inch"],
        &["opd-1.npy", "--pixel", "0.2 um", "--level", "quartic"],
        &["opd-1.npy", "--pixel", "0.2 um", "--unit", "xy=um"],
        &["opd-1.npy", "--pixel", "0.2 um", "--missing", "x"],
        &["opd-1.npy", "--pixel", "0.2 um", "--neighbours", "six"],
        &["opd-1.npy", "--pixel", "0.2 um", "--s", "3"],
        &["opd-1.npy", "--pixel", "0.2 um", "--s", "3 um", "--l", "2 um"],
        &["opd-1.npy", "--pixel", "0.2 um", "--name", ""],
        &["opd-1.npy", "--pixel", "0.2 um", "--name", "../up"],
    ] {
        let said = message(arguments);
        assert!(!said.contains("(command line)") && !said.contains(" | "), "no spec is cited: {said}");
        assert_message(module_path!(), &arguments.join(" "), &said);
    }
    for file in ["nowhere.npy", root.join("Cargo.lock").to_str().unwrap()] {
        assert!(message(&[file]).contains(file), "{file}");
    }
    let both = message(&[root.join("experiments/gw-zmc-limit.toml").to_str().unwrap(), "--pixel", "1 um"]);
    assert!(both.contains("is a spec"), "{both}");
}

/// `surfaces` of the summary, the rows of two tables of surfaces, and the page of surfaces, for which `map.txt` holds heights.
fn look(words: &str, heights: &str) -> (serde_json::Value, [Vec<serde_json::Value>; 2], String) {
    let folder = tempfile::tempdir().unwrap();
    let bodies = SMALL.split("[surface.list").next().unwrap();
    fs::write(folder.path().join("look.toml"), format!("{bodies}{words}")).unwrap();
    fs::write(folder.path().join("map.txt"), heights).unwrap();
    succeeds(&["surface", "look.toml"], folder.path());
    let out = folder.path().join("reports");
    let report = fs::read_to_string(out.join("look-surfaces/report.md")).unwrap();
    let surfaces = summary(&out, "look-surfaces")["surfaces"].take();
    let tables = ["generation_processes.csv", "summit_theory.csv"].map(|file| {
        fs::read(out.join("look-surfaces").join(file))
            .map_or_else(|_| Vec::new(), |csv| typed(results::rows(&csv)))
    });
    (surfaces, tables, report)
}

#[test]
fn a_random_surface_is_generated_as_specified() {
    let grid = "points = [128, 96]\npixel = [\"1 um\", \"0.8 um\"]\nsigma = \"0.2 um\"\n";
    let lay = "spectrum.gaussian = { correlation-length = [\"8 um\", \"3 um\"], angle = \"30 deg\" }";
    let (surfaces, [made, theory], _) = look(
        &format!(
            "[surface.one.generate]\n{grid}{lay}\n[surface.two.generate]\n{grid}{lay}\nneighbours = \"eight\"
[surface.honed.generate]\n{grid}spectrum.exponential.correlation-length = \"4 um\"
plateau = {{ height = \"-50 nm\", sigma = \"20 nm\", spectrum.exponential.correlation-length = \"2 um\" }}
[surface.mapped.generate]\n{grid}{lay}\nheights.weibull.shape = 2\nspectrum-of = \"gaussian\"\n"
        ),
        "",
    );
    let processes = |name: &str| -> Vec<serde_json::Value> {
        made.iter().filter(|process| process["surface"] == name).cloned().collect()
    };
    let process = &processes("one")[0];
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    assert_eq!((&process["spectrum"], &process["cut_off_m"]), (&"gaussian".into(), &serde_json::Value::Null));
    close(number(&process["correlation_length_m"]), 3e-6, 1e-12);
    close(number(&process["elongation"]), 8.0 / 3.0, 1e-12);
    close(number(&process["angle_rad"]), 30f64.to_radians(), 1e-12);
    assert_ne!(
        surfaces["one"]["height_map"]["sq_m"], surfaces["two"]["height_map"]["sq_m"],
        "of its own name"
    );
    close(number(&processes("honed")[1]["plateau_height_m"]), -5e-8, 1e-12);
    assert_eq!(processes("mapped")[0]["spectrum_of"], "gaussian");

    assert_eq!(surfaces["one"]["height_map"]["summit_definition"], "five-point");
    assert_eq!(surfaces["two"]["height_map"]["summit_definition"], "eight-neighbour");
    let five_point =
        |name: &str| theory.iter().find(|row| row["surface"] == name).unwrap()["five_point"].clone();
    assert!(five_point("one").is_number() && five_point("two").is_null(), "none for other summits");
}

#[test]
fn tables_of_a_surface_agree_with_its_summary() {
    let (surfaces, [_, theory], report) = look(
        "[surface.met.generate]
points = 512
spectrum.self-affine.hurst = 0.8
summits = { radius = \"20 um\", sigma = \"48 nm\", density = \"6e10 /m^2\" }
",
        "",
    );
    let (met, map) = (&surfaces["met"], &surfaces["met"]["height_map"]);
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    for name in ["σ of the summit heights, m", "density of the summits, 1/m²"] {
        let cells = row(&report, name);
        assert_eq!(cells[1], cells[2], "{name}");
    }
    for axis in ["x", "y"] {
        let along = format::number(number(&map[format!("m2_along_{axis}")]));
        assert_eq!(row(&report, &format!("m2 along {axis}"))[1], along);
    }
    let along = ["x", "y"].map(|axis| number(&map[format!("m4_along_{axis}_per_m2")]));
    close(2.0 * number(&map["m4_per_m2"]), along[0] + along[1], 1e-12);
    let cells = row(&report, "density, 1/m²");
    let theory = &theory[0];
    let density = number(&met["density_per_m2"]);
    assert_eq!(number(&theory["found"]), density);
    let expected = ["five_point", "nayak"].map(|name| number(&theory[name]));
    assert_eq!([2, 4].map(|k| cells[k].clone()), expected.map(format::number));
    assert_eq!([3, 5].map(|k| cells[k].clone()), expected.map(|theory| format::number(density / theory)));
    let saddles = &row(&report, "summits whose smaller principal curvature is not positive")[1];
    assert_eq!(saddles.replace(',', ""), map["summits_with_a_saddle"].to_string());
    assert!(number(&met["offset_to_mean_plane_m"]) > 0.0, "summits are above the mean plane");
}

#[test]
fn a_measured_map_is_processed_as_specified() {
    let file = "path = \"map.txt\"\npixel = \"1 um\"\nunit = \"nm\"\n";
    let (surfaces, _, report) = look(
        &format!(
            "[surface.raw.file]\n{file}level = \"none\"\n[surface.level.file]\n{file}
[surface.bowl.file]\n{file}level = \"quadratic\"\nneighbours = \"eight\"\nfilter = {{ s = \"3 um\" }}\n"
        ),
        &rough([50, 40], 500.0),
    );
    let number = |name: &str, key: &str| surfaces[name][key].as_f64().unwrap();
    let map = |name: &str| &surfaces[name]["height_map"];
    let level = |name: &str| map(name)["level"].as_str().unwrap().to_owned();
    assert_eq!(["raw", "level", "bowl"].map(level), ["none", "plane", "quadratic"]);
    assert!(number("raw", "mean_height_m") > 5e-7 && number("level", "mean_height_m") < 1e-7);
    close(number("raw", "offset_to_mean_plane_m"), number("level", "offset_to_mean_plane_m"), 0.05);
    let sq = map("raw")["sq_m"].as_f64().unwrap();
    let found = &row(&report, "mean height above the mean plane / Sq")[1];
    assert_eq!(*found, format::number(number("raw", "offset_to_mean_plane_m") / sq));
    assert_eq!(map("bowl")["summit_definition"], "eight-neighbour");
    assert!(map("bowl")["filter"].as_str().unwrap().starts_with("S = 3"));
    assert!(map("bowl")["sq_m"].as_f64().unwrap() < 0.7 * map("level")["sq_m"].as_f64().unwrap());
}

#[test]
fn doubtful_maps_are_reported() {
    let words = |unit: &str| {
        format!(
            "[surface.a.file]\npath = \"map.txt\"\npixel = \"1 um\"\nlevel = \"none\"\nunit = \"{unit}\"\n"
        )
    };
    let warned = |unit: &str, heights: &str| {
        let (surfaces, _, _) = look(&words(unit), heights);
        surfaces["a"]["warnings"].to_string()
    };
    let heights = rough([50, 40], 500.0);
    assert!(!warned("nm", &heights).contains("r.m.s. slope"));
    assert!(warned("um", &heights).contains("the r.m.s. slope is "));
    let equal = "0 0 0 0 0 0 0\n0 1.5 0 1.5 0 1.5 0\n".repeat(3) + "0 0 0 0 0 0 0\n";
    assert!(warned("nm", &equal).contains("has 9 summits that are equally high"), "{}", warned("nm", &equal));
}

#[test]
fn maps_of_labs_are_read_from_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("reports");
    let run = |file: &str, arguments: &[&str]| {
        let name = format!("r{}", arguments.concat().replace([' ', '=', ',', '.', '-'], ""));
        let all = [&["surface", file, "--name", &name, "--out", out.to_str().unwrap()], arguments].concat();
        let output = experiment(&all, folder.path());
        (output.status.success(), text(&output.stderr), text(&output.stdout), name)
    };
    let heights = rough([50, 40], 500.0);
    let columns: Vec<String> = (0..50).map(|k| k.to_string()).collect();
    let marked = heights.replacen(heights.split_whitespace().next().unwrap(), "-9999", 1);
    fs::write(folder.path().join("pandas.csv"), format!("{}\n{marked}", columns.join(" ")).replace(' ', ","))
        .unwrap();
    let in_nm = ["--pixel", "1 um, 2 um", "--unit", "nm"];
    let (is_read, error, ..) = run("pandas.csv", &in_nm);
    assert!(!is_read && error.contains("pandas.csv holds the height -9999 at 1 point"), "{error}");
    let (is_read, error, _, name) = run("pandas.csv", &[&in_nm[..], &["--missing", "-9999"]].concat());
    assert!(is_read && error.contains("line 1 of its file names or numbers the columns"), "{error}");
    assert!(
        error.contains("x runs along the lines of its file (50 points of 1 µm), y from line to line"),
        "{error}"
    );
    let map = |name: &str| summary(&out, name)["surfaces"]["pandas"]["height_map"].clone();
    let size = |map: &serde_json::Value| [map["points_x"].clone(), map["points_y"].clone()];
    assert_eq!(size(&map(&name)), [50, 40]);
    let arguments = [&in_nm[..], &["--missing", "-9999", "--transpose"]].concat();
    let (_, error, _, name) = run("pandas.csv", &arguments);
    assert!(error.contains("without `--transpose` they are exchanged"), "{error}");
    assert_eq!(size(&map(&name)), [40, 50]);

    // A pixel in metres, and the heights of a file in metres read as nanometres.
    for (arguments, words) in [
        (
            &["--pixel", "196.733 m", "--unit", "nm", "--missing", "-9999"][..],
            "slope: the map is 9.84 km wide along x",
        ),
        (
            &["--pixel", "0.01 m", "--unit", "nm", "--missing", "-9999"],
            "less than that of any polished surface",
        ),
    ] {
        let (is_read, error, card, _) = run("pandas.csv", arguments);
        assert!(is_read && error.contains(words), "{error}");
        assert!(card.contains("No conclusion until the map is fit: "), "{card}");
    }

    let points: String = (0..2000)
        .zip(heights.split_whitespace())
        .map(|(k, z)| format!("{},{},{z}\n", 0.5 * f64::from(k % 50), 0.5 * f64::from(k / 50)))
        .collect();
    fs::write(folder.path().join("points.csv"), format!("x (µm), y (µm), height (nm)\n{points}")).unwrap();
    let sq = |name: &str| summary(&out, name)["surfaces"]["points"]["height_map"].clone();
    let (is_read, error, _, name) = run("points.csv", &[]);
    assert!(is_read, "{error}");
    close(sq(&name)["pixel_x_m"].as_f64().unwrap(), 5e-7, 1e-9);
    let found = sq(&name)["sq_m"].as_f64().unwrap();
    // What is given counts, and a warning names both.
    let (is_read, error, _, name) = run("points.csv", &["--unit", "xy=mm, z=nm"]);
    assert!(
        is_read
            && error.contains(
                "its file states lengths in um of x and y, nm of z; mm of x and y, nm of z, as `--unit` says"
            ),
        "{error}"
    );
    close(sq(&name)["pixel_x_m"].as_f64().unwrap(), 5e-4, 1e-9);
    let (is_read, error, _, name) = run("points.csv", &["--pixel", "2 um"]);
    assert!(
        is_read
            && error.contains("its file states a pixel of 500 nm; 2 µm, as `--pixel` says, is used instead"),
        "{error}"
    );
    close(sq(&name)["pixel_x_m"].as_f64().unwrap(), 2e-6, 1e-9);

    // Points in an unknown unit hold their pixel: only the unit can be stated.
    fs::write(folder.path().join("points.csv"), format!("x, y, height\n{points}")).unwrap();
    let (is_read, error, card, _) = run("points.csv", &["--unit", "xy=m, z=nm"]);
    assert!(is_read, "{error}");
    assert!(error.contains("Remedy: `--unit`"), "{error}");
    assert!(![card, error].iter().any(|said| said.contains("--pixel")));
    let (.., name) = run("points.csv", &["--unit", "xy=um, z=nm"]);
    close(sq(&name)["sq_m"].as_f64().unwrap(), found, 1e-9);

    // Lines above the table, and a table in which there is a single summit.
    fs::write(folder.path().join("headed.txt"), format!("Export 1.2\nUnits: nm\n{heights}")).unwrap();
    let (is_read, error, ..) = run("headed.txt", &in_nm);
    let note = "its file is read from line 3 on: what stands above (\"Units: nm\") is no row of its table";
    assert!(is_read && error.contains(note), "{error}");
    let (is_read, error, ..) = run("headed.txt", &["--unit", "nm"]);
    assert!(
        !is_read && error.contains("no pixel size") && error.contains("is read from line 3 on"),
        "{error}"
    );
    let (_, rest) = heights.trim_start().split_once(' ').unwrap();
    fs::write(folder.path().join("marked.txt"), format!("lost {rest}")).unwrap();
    let (is_read, error, ..) = run("marked.txt", &in_nm);
    assert!(!is_read && error.contains("marked.txt line 1, column 1: found \"lost\""), "{error}");
    let (is_read, error, ..) = run("marked.txt", &[&in_nm[..], &["--missing", "lost, -9999"]].concat());
    assert!(is_read, "{error}");
    fs::write(folder.path().join("small.txt"), "0 0 0 0\n0 3 0 1\n0 0 0 0\n0 1 0 2\n").unwrap();
    let (is_read, error, ..) = run("small.txt", &["--pixel", "1 um", "--unit", "nm", "--level", "none"]);
    assert!(is_read && error.contains("the map has one summit only on 4 x 4 points; "), "{error}");
}

/// What cannot be carried out is refused before anything runs.
#[test]
fn options_of_a_surface_are_checked_before_it_runs() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("map.txt"), rough([50, 40], 500.0)).unwrap();
    for arguments in [
        &["--align-lines", "--level", "plane"][..],
        &["--missing", "--fit"],
        &["--force", "5 N"],
        &["--save-spec", "none/mine.toml"],
        &["--save-spec", "map.txt"],
    ] {
        let said = refused(&[&MAP[..], arguments].concat(), folder.path());
        assert_message(module_path!(), &arguments.join(" "), &said);
        assert!(!folder.path().join("reports").exists(), "{arguments:?}");
    }
    fs::rename(folder.path().join("map.txt"), folder.path().join("2 maps.txt")).unwrap();
    // A file is no load.
    succeeds(&["surface", "--force", "2 maps.txt", "--pixel", "1 um", "--unit", "nm"], folder.path());
}

/// `--fit` prints its steps, keeps what is stated, and saves the spec that does the same by hand.
#[test]
fn a_fit_is_told_and_saved_by_its_keys() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("reports");
    let al3d = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments/surfaces/al3d-1.npy");
    fs::copy(al3d, folder.path().join("rough.npy")).unwrap();
    let arguments =
        ["surface", "rough.npy", "--pixel", "438.027 nm", "--level", "cubic", "--fit", "--save-spec"];
    let output = succeeds(&[&arguments[..], &["by-hand.toml", "--load", "0.1 N"]].concat(), folder.path());
    let said = text(&output.stdout);
    assert!(said.contains("steps  height step over median drop"), "{said}");
    assert!(said.contains("filter = { s = \"3.5 µm\" }") && said.contains("applied"), "{said}");
    let spec = fs::read_to_string(folder.path().join("by-hand.toml")).unwrap();
    assert!(!spec.contains("fit ="), "{spec}");
    for key in ["outliers = \"keep\"", "level = \"cubic\"", "filter = { s = \"3.5 µm\" }", "force = "] {
        assert_eq!(spec.matches(key).count(), 1, "{key}: {spec}");
    }
    let report = fs::read_to_string(out.join("surface-rough/report.md")).unwrap();
    assert!(report.contains("# The same by hand") && !report.contains("fit = \"auto\""), "{report}");
    assert!(out.join("surface-rough/fit_steps.csv").exists());
    run(&folder.path().join("by-hand.toml"), &out, &[]);
    let [auto, hand] = ["surface-rough", "by-hand"].map(|name| summary(&out, name));
    assert_eq!(auto["surfaces"]["rough"]["sigma_m"], hand["surfaces"]["rough"]["sigma_m"]);
    assert_eq!(auto["results"], hand["results"]);
    assert!(auto["fitness"].as_array().unwrap().iter().all(|check| check["blocks"] == false));
}

/// Filters that cannot be meant are refused or named, not blamed on units; what the warnings advise are options of the command line.
#[test]
fn filters_that_cannot_be_meant_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let heights = waves(256, [24.0, 12.0], 9);
    let spike = |i, j| if (i, j) == (100, 90) { 3e-6 } else { 0.0 };
    write_map(folder.path().join("map.npy"), [256; 2], |i, j| heights[i * 256 + j] + spike(i, j));
    let map = ["surface", "map.npy", "--pixel", "1 um", "--load", "0.1 N"];
    for l in ["1 um", "4 um"] {
        let said = refused(&[&map[..], &["--l", l, "--outliers", "remove"]].concat(), folder.path());
        assert_message(module_path!(), &format!("--l {l}"), &said);
    }
    let warned = |more: &[&str]| text(&succeeds(&[&map[..], more].concat(), folder.path()).stderr);
    let said = warned(&["--s", "0.5 um"]);
    assert!(said.contains("its S filter of 500 nm has hardly any effect"), "{said}");
    assert!(said.contains("Remedy: `--outliers remove`") && !said.contains("outliers = "), "{said}");
    let enough = warned(&["--s", "4 um", "--l", "60 um", "--outliers", "remove"]);
    assert!(!enough.contains("filter of"), "{enough}");
}

/// A sine has no summits of different heights: it is described, and boundary elements answer.
#[test]
fn a_wave_is_described_without_models() {
    let folder = tempfile::tempdir().unwrap();
    let wave = |i: usize, _: usize| 1e-6 * (std::f64::consts::TAU * i as f64 / 64.0).sin();
    write_map(folder.path().join("sine.npy"), [64; 2], wave);
    let described = |more: &[&str]| {
        let all = [&["surface", "sine.npy", "--pixel", "1 um", "--level", "none"], more].concat();
        text(&succeeds(&all, folder.path()).stdout)
    };
    let said = described(&[]);
    for words in ["707 nm", "1.5", "Neither applies", "`--reference`"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    assert!(!said.contains("NaN"), "{said}");
    let answered = described(&["--reference", "--pressure", "10 MPa", "--name", "pressed"]);
    assert!(answered.contains("(boundary elements)") && answered.contains("Neither applies"), "{answered}");
    let swept = described(&["--reference", "--name", "swept"]);
    assert!(swept.contains("(boundary elements)"), "{swept}");
}
