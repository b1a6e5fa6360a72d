//! Several realisations of surfaces in one report.

use super::*;

/// Two realisations of a random surface and of a population in one report.
#[test]
fn realisations_are_in_every_table_and_differ() {
    let (folder, _, out) = small();
    let spec = folder.path().join("several.toml");
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
    run(&spec, &out, &[]);
    let table = |name: &str| rows(&out, "several", name);
    let mut pressures: std::collections::BTreeMap<(String, String), Vec<String>> = Default::default();
    for row in table("curves.csv") {
        if row["model"] == "deterministic" && row["control"] == "pressure" {
            let key = (row["surface"].clone(), row["realisation"].clone());
            pressures.entry(key).or_default().push(row["area_ratio"].clone());
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
    let is_at_9_mpa = |row: &Row, load: &str| {
        row["surface"] == "random" && row["law"] == "hertz" && (number(row, load) / 9e6 - 1.0).abs() < 1e-9
    };
    let pairs = table("comparison.csv");
    let at_9_mpa = pairs.iter().filter(|row| row["pairing"] == "load" && is_at_9_mpa(row, "target"));
    let found: Vec<f64> = at_9_mpa.map(|row| number(row, "difference_separation_over_sigma")).collect();
    assert_eq!(found.len(), 3);
    let mean = found.iter().sum::<f64>() / 3.0;
    let deviation = (found.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / 2.0).sqrt();
    let differences = table("differences.csv");
    let of_separation = |row: &&Row| row["quantity"] == "separation" && is_at_9_mpa(row, "pressure_pa");
    let row = differences.iter().find(of_separation).unwrap();
    let error = deviation / 3f64.sqrt();
    assert!((number(row, "difference") - mean).abs() < 1e-12);
    close(number(row, "standard_error"), error, 1e-9);
    // Student's quantile with two degrees of freedom.
    assert!((number(row, "high") - mean - 4.302_652_73 * error).abs() < 1e-6 * error);
    let spread = table("spread.csv");
    let row = spread.iter().find(|row| is_at_9_mpa(row, "pressure_pa")).unwrap();
    close(number(row, "difference"), mean, 1e-9);
    close(number(row, "difference_deviation"), deviation, 1e-9);
    let of_random = |file: &str, column: &str| {
        number(table(file).iter().find(|row| row["surface"] == "random").unwrap(), column)
    };
    assert_eq!(of_random("generation_processes.csv", "skewness"), -1.0);
    assert!(of_random("summit_theory.csv", "five_point") > 0.0);
}
