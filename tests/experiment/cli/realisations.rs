//! Several realisations of surfaces in one report.

use super::*;
use crate::results;

/// Two realisations of a random surface and of a population in one report.
#[test]
fn realisations_are_in_every_table_and_differ() {
    let folder = tempfile::tempdir().unwrap();
    let (spec, out) = (folder.path().join("several.toml"), folder.path().join("reports"));
    let words = format!(
        "{}
[surface.random.generate]
points = [96, 64]
pixel = [\"1 um\", \"0.8 um\"]
sigma = \"0.2 um\"
spectrum.exponential = {{ correlation-length = [\"8 um\", \"3 um\"], angle = \"30 deg\" }}
heights.johnson = {{ skewness = -1, kurtosis = 4.5 }}
realisations = 3
",
        SMALL
            .replace("count = 2000", "count = 2000\nrealisations = 2")
            .replace("[\"1 MPa\"]", "[\"1 MPa\", \"3 MPa\", \"9 MPa\", \"30 MPa\"]")
    );
    fs::write(&spec, words).unwrap();
    let rows: String = (0..500).map(|i| format!("{:e},1e-6\n", f64::from(i % 97) * 1e-9)).collect();
    fs::write(folder.path().join("list.csv"), format!("height,radius\n{rows}")).unwrap();
    let output = run(&spec, &out, &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let mut pressures: std::collections::BTreeMap<(String, String), Vec<String>> = Default::default();
    let mut reader = csv::Reader::from_path(out.join("several/curves.csv")).unwrap();
    let columns = reader.headers().unwrap().clone();
    let place = |name: &str| columns.iter().position(|column| column == name).unwrap();
    let [surface, realisation, model, control, area] =
        ["surface", "realisation", "model", "control", "area_ratio"].map(place);
    for row in reader.records().map(Result::unwrap) {
        if &row[model] == "deterministic" && &row[control] == "pressure" {
            let key = (row[surface].to_owned(), row[realisation].to_owned());
            pressures.entry(key).or_default().push(row[area].to_owned());
        }
    }
    let of = |surface: &str| -> Vec<&Vec<String>> {
        pressures.iter().filter(|(key, _)| key.0 == surface).map(|(_, areas)| areas).collect()
    };
    assert_eq!(of("random").len(), 3);
    for areas in of("random") {
        assert_eq!(areas.len(), 8, "four pressures, two laws");
    }
    assert!(of("random")[0] != of("random")[1] && of("random")[1] != of("random")[2]);
    let report = fs::read_to_string(out.join("several/report.md")).unwrap();
    assert!(report.contains("| realisations | 3 |"), "{report}");
    let random = summary(&out, "several")["surfaces"]["random"].take();
    assert_eq!(random["realisations"].as_array().unwrap().len(), 3);
    for key in ["sq_m", "ssk", "sku"] {
        assert_eq!(random["realisations"][0][key], random["height_map"][key], "{key}");
    }
    // What the report says over all realisations is what the pairs in the other table say.
    let mut reader = csv::Reader::from_path(out.join("several/comparison.csv")).unwrap();
    let columns = reader.headers().unwrap().clone();
    let place = |name: &str| columns.iter().position(|column| column == name).unwrap();
    let [pairing, target, difference] = ["pairing", "target", "difference_separation_over_sigma"].map(place);
    let pairs: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let at_9_mpa = pairs.iter().filter(|row| {
        [&row[0], &row[2], &row[pairing]] == ["random", "hertz", "load"]
            && (row[target].parse::<f64>().unwrap() / 9e6 - 1.0).abs() < 1e-9
    });
    let found: Vec<f64> = at_9_mpa.map(|row| row[difference].parse().unwrap()).collect();
    assert_eq!(found.len(), 3);
    let mean = found.iter().sum::<f64>() / 3.0;
    let deviation = (found.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / 2.0).sqrt();
    let mut reader = csv::Reader::from_path(out.join("several/differences.csv")).unwrap();
    let columns = reader.headers().unwrap().clone();
    let place = |name: &str| columns.iter().position(|column| column == name).unwrap();
    let row_of_9_mpa = reader.records().map(Result::unwrap).find(|row| {
        [&row[0], &row[1], &row[place("quantity")]] == ["random", "hertz", "separation"]
            && (row[place("pressure_pa")].parse::<f64>().unwrap() / 9e6 - 1.0).abs() < 1e-9
    });
    let row_of_9_mpa = row_of_9_mpa.unwrap();
    let number = |name: &str| row_of_9_mpa[place(name)].parse::<f64>().unwrap();
    let error = deviation / 3f64.sqrt();
    assert!(
        (number("difference") - mean).abs() < 1e-12 && (number("standard_error") / error - 1.0).abs() < 1e-9
    );
    // Student's quantile with two degrees of freedom.
    assert!((number("high") - mean - 4.302_652_73 * error).abs() < 1e-6 * error);
    let spread = crate::results::rows(&fs::read(out.join("several/spread.csv")).unwrap());
    let row = spread.iter().find(|row| {
        row["surface"] == "random"
            && row["law"] == "hertz"
            && (row["pressure_pa"].parse::<f64>().unwrap() / 9e6 - 1.0).abs() < 1e-9
    });
    let row = row.unwrap();
    close(row["difference"].parse().unwrap(), mean, 1e-9);
    close(row["difference_deviation"].parse().unwrap(), deviation, 1e-9);
    let of_random = |file: &str, column: &str| {
        let rows = results::rows(&std::fs::read(out.join("several").join(file)).unwrap());
        results::number(rows.iter().find(|row| row["surface"] == "random").unwrap(), column)
    };
    assert_eq!(of_random("generation_processes.csv", "skewness"), -1.0);
    assert!(of_random("summit_theory.csv", "five_point") > 0.0);
}
