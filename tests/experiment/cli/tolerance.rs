//! `tolerance` in `[compare]`.

use super::*;

const SPEC: &str = concat!(
    r#"
title = "a fine curve"
seed = 3
"#,
    steel!(),
    r#"[compare]
rough = "steel"
flat = "steel"
law = "zmc"
separation = { from = 3, to = 0, points = 4001 }
[surface.drawn.population]
"#,
    case_1!(),
    r#"count = 5000
"#
);

#[test]
fn a_curve_within_a_tolerance_says_so_and_holds_it() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("reports");
    let mut curves = Vec::new();
    for (name, tolerance) in
        [("exact", ""), ("near", "tolerance = { statistical = 1e-8, deterministic = 1e-2 }\nseparation = {")]
    {
        let spec = folder.path().join(format!("{name}.toml"));
        let words =
            if tolerance.is_empty() { SPEC.to_owned() } else { SPEC.replace("separation = {", tolerance) };
        fs::write(&spec, words).unwrap();
        let output = run(&spec, &out, &[]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let mut reader = csv::Reader::from_path(out.join(name).join("curves.csv")).unwrap();
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), 2 * 4001);
        curves.push(rows);
    }
    let mut differing = 0;
    // So many integrals within 1e-8 would take more than all of them, exactly.
    for (exact, near) in curves[0].iter().zip(&curves[1]) {
        let within = if &exact[4] == "statistical" { 0.0 } else { 1e-2 };
        // Pressure and area ratio.
        for column in [9, 11] {
            let [exact, near] = [exact, near].map(|row| row[column].parse::<f64>().unwrap());
            assert!((near - exact).abs() <= within * exact, "{near} for {exact}");
            differing += usize::from(near != exact);
        }
    }
    assert!(differing > 2 * 2000, "{differing}");
    let read = |name: &str, file: &str| fs::read_to_string(out.join(name).join(file)).unwrap();
    assert!(read("near", "report.md").contains("| deterministic | 1e-2 |"));
    assert!(!read("exact", "report.md").contains("largest error of interpolation"));
    let summary: serde_json::Value = serde_json::from_str(&read("near", "summary.json")).unwrap();
    assert_eq!(summary["tolerance"]["statistical"], 1e-8);
    let summary: serde_json::Value = serde_json::from_str(&read("exact", "summary.json")).unwrap();
    assert!(summary.get("tolerance").is_none());
}
