//! `[indentation]`.

use super::*;

const SPHERE: &str = concat!(
    r#"
title = "sphere"
"#,
    steel!(),
    lead!(),
    r#"[indentation]
ball = "steel"
radius = "1 mm"
flat = "steel"
layer = { material = "lead", thickness = "1 um" }
law = ["hertz", "zmc"]
indentation = { from = "10 nm", to = "5 um", points = 5 }
overlay = "points.csv"
"#
);

/// A folder with a sphere on a layer, and points that were measured.
fn sphere() -> (tempfile::TempDir, PathBuf, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("sphere.toml");
    fs::write(&spec, SPHERE).unwrap();
    fs::write(folder.path().join("points.csv"), "indentation, load\n1e-6, 4\n").unwrap();
    let out = folder.path().join("reports");
    (folder, spec, out)
}

#[test]
fn a_sphere_has_its_tables_and_a_warning() {
    let (_folder, spec, out) = sphere();
    let output = run(&spec, &out, &[]);
    assert!(output.status.success());
    assert!(
        text(&output.stderr).contains("layers 0.5 to 2 times as stiff as the substrate; this one is not"),
        "{}",
        text(&output.stderr)
    );
    let table = |name: &str| {
        let mut reader = csv::Reader::from_path(out.join("sphere").join(name)).unwrap();
        let header = reader.headers().unwrap().iter().collect::<Vec<_>>().join(",");
        (header, reader.records().map(Result::unwrap).collect::<Vec<_>>())
    };
    let (header, rows) = table("indentation.csv");
    assert_eq!(
        header,
        "layer,layer_thickness_m,rule,law,curve,indentation_m,load_n,area_m2,contact_radius_m,mean_pressure_pa,\
         stiffness_n_per_m,regime"
    );
    // Three curves a law, the exact one once; it has neither law nor regime.
    assert_eq!(rows.len(), (2 * 3 + 1) * 5);
    for row in &rows {
        assert_eq!(&row[4] == "exact-elastic", row[3].is_empty() && row[11].is_empty(), "{row:?}");
        assert!((5..11).all(|k| row[k].parse::<f64>().unwrap() > 0.0), "{row:?}");
    }
    let (header, rows) = table("regimes.csv");
    assert_eq!(header, "layer,layer_thickness_m,rule,law,curve,indentation_m,load_n,from,to,within_sweep");
    assert!(rows.iter().all(|row| &row[3] == "zmc" && row[7] != row[8]));
    let (header, rows) = table("rule.csv");
    assert_eq!(
        header,
        "layer,layer_thickness_m,rule,indentation_m,contact_radius_over_thickness,load_over_exact,area_over_exact"
    );
    assert_eq!(rows.len(), 2 * 5);
    let (header, rows) = table("overlay.csv");
    assert_eq!(
        header,
        "layer,layer_thickness_m,rule,law,indentation_m,measured_load_n,coated_load_n,measured_over_coated"
    );
    assert_eq!(rows.len(), 2);
    let reports = out.to_str().unwrap();
    assert!(experiment(&["verify", reports, "--out", reports], Path::new(".")).status.success());
}

#[test]
fn a_sphere_runs_again_when_its_measured_points_change() {
    let (folder, spec, out) = sphere();
    let said = || text(&run(&spec, &out, &[]).stdout);
    assert!(said().contains("written"));
    assert!(said().contains("unchanged"));
    fs::write(folder.path().join("points.csv"), "indentation, load\n1e-6, 5\n").unwrap();
    assert!(said().contains("written"));
    let output = experiment(&["check", spec.to_str().unwrap()], folder.path());
    let plan = text(&output.stdout);
    assert!(plan.contains("a ball of steel") && plan.contains("1 measured points"), "{plan}");
}
