//! Input as people have it: one value, whole numbers as floats, lists with units and other separators, files in the way.

use super::*;

/// A spec of three equal lists and a population.
fn spec(unit: &str) -> String {
    let lists = ["metres", "units", "key"].map(|name| {
        let key = if name == "key" { "unit = \"um\"\n" } else { "" };
        format!("[surface.{name}.asperities]\nfile = \"{name}.csv\"\nnominal-area = \"1e-8 m^2\"\n{key}")
    });
    let bodies = SMALL
        .split("separation = ")
        .next()
        .unwrap()
        .replace("title = \"small\"", "title = \"t\"\nseed = 1e3");
    let population = SMALL.split("[surface.drawn.population]").nth(1).unwrap().replace("2000", "2e3");
    format!("{bodies}{unit}\n{}[surface.drawn.population]{population}", lists.concat())
}

#[test]
fn one_value_whole_floats_and_lists_in_any_unit_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let (mut metres, mut units, mut key) = (
        "height,radius\n".to_owned(),
        "height [nm]; radius [mm]\n".to_owned(),
        "height\tradius\n".to_owned(),
    );
    for i in 0..200 {
        let height = i % 97;
        metres += &format!("{height}e-9,1e-6\n");
        units += &format!("{height},0; 0,001\n");
        key += &format!("{height}e-3\t1\n");
    }
    for (name, text) in [("metres", &metres), ("units", &units), ("key", &key)] {
        fs::write(folder.path().join(format!("{name}.csv")), text).unwrap();
    }
    let (path, out) = (folder.path().join("mine.toml"), folder.path().join("reports"));
    fs::write(&path, spec("force = \"1 mN\"\npressure = [\"1 MPa\"]\nseparation = 2")).unwrap();
    run(&path, &out, &[]);
    let summary = summary(&out, "mine");
    assert_eq!((&summary["seed"], &summary["surfaces"]["drawn"]["asperities"]), (&1000.into(), &2000.into()));
    let of = |name: &str, key: &str| summary["surfaces"][name][key].as_f64().unwrap();
    for name in ["units", "key"] {
        assert_eq!(of(name, "asperities"), 200.0);
        for quantity in ["sigma_m", "mean_height_m", "mean_radius_m"] {
            let (found, wanted) = (of(name, quantity), of("metres", quantity));
            assert!((found / wanted - 1.0).abs() < 1e-14, "{name} {quantity}: {found} {wanted}");
        }
    }
    let curves = rows(&out, "mine", "curves.csv");
    let of_key = curves
        .iter()
        .filter(|row| row["surface"] == "key" && row["law"] == "hertz" && row["model"] == "statistical");
    let mut controls: Vec<(String, f64)> =
        of_key.map(|row| (row["control"].clone(), number(row, "target"))).collect();
    controls.sort_by(|a, b| a.0.cmp(&b.0));
    let wanted = [("force", 1e-3), ("pressure", 1e6), ("separation", 2.0)];
    assert_eq!(controls, wanted.map(|(control, target)| (control.to_owned(), target)));
}

#[test]
fn a_check_reads_every_row_of_a_list() {
    let folder = tempfile::tempdir().unwrap();
    let rows: String = (0..5000).map(|i| format!("{i}e-12,1e-6\n")).collect();
    for name in ["metres", "units", "key"] {
        fs::write(folder.path().join(format!("{name}.csv")), format!("height,radius\n{rows}")).unwrap();
    }
    let path = folder.path().join("mine.toml");
    fs::write(&path, spec("pressure = \"1 MPa\"")).unwrap();
    let plan = text(&experiment(&["check", "mine.toml"], folder.path()).stdout);
    assert!(plan.contains("5000 asperities listed in metres.csv"), "{plan}");
    fs::write(folder.path().join("units.csv"), format!("height,radius\n{rows}1e-9,0\n")).unwrap();
    let said = refused(&["check", "mine.toml"], folder.path());
    assert!(
        said.contains("surface.units.asperities.file: units.csv, line 5002, column `radius`: found `0`"),
        "{said}"
    );
}
