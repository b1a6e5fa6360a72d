//! Boundary elements on maps whose summits do not scatter: none, one, or all equally high.

use std::f64::consts::PI;

use super::*;
use crate::results::run_in;

const ALONE: &str = "law = \"hertz\"\nmodels = [\"reference\"]\n";
const POINTS: usize = 64;
const HEIGHT: f64 = 1e-6;
const LENGTH: f64 = 200e-6;

/// A map of so many points on a square of `LENGTH`, and the results of boundary elements on it.
fn solved(compare: &str, file: &str, height: impl Fn(f64, f64) -> f64) -> Result<Box<dyn Outcome>, String> {
    let folder = tempfile::tempdir().unwrap();
    write_map(folder.path().join("map.npy"), [POINTS; 2], |i, j| {
        let [x, y] = [i, j].map(|index| index as f64 / POINTS as f64);
        HEIGHT * height(x, y)
    });
    let pixel = LENGTH / POINTS as f64;
    let head = concat!("title = \"t\"\n", steel!(), "[compare]\nrough = \"steel\"\nflat = \"steel\"\n");
    let surface =
        format!("[surface.a.file]\npath = \"map.npy\"\npixel = \"{pixel:e} m\"\nlevel = \"none\"\n{file}\n");
    run_in(folder.path(), &format!("{head}{compare}\n{surface}"))
}

fn wave(x: f64, y: f64) -> f64 {
    (2.0 * PI * x).cos() * (2.0 * PI * y).cos()
}

/// p* of [`wave`], at which it is in full contact: 2^.5 pi E* h/lambda.
fn full() -> f64 {
    2f64.sqrt() * PI * 0.5 * 210e9 / (1.0 - 0.09) * HEIGHT / LENGTH
}

/// Against conjugate gradients with Fourier transforms (numpy, Polonsky and Keer 1999) on the same points, and near full contact against
/// Johnson, Greenwood and Higginson (1985).
#[test]
fn a_wave_with_equal_summits_is_solved() {
    let loads = [0.1, 0.3, 0.9, 0.99, 1.01];
    let pressures = loads.map(|load| format!("\"{:e} Pa\"", load * full()));
    let compare = format!("{ALONE}pressure = [{}]\n", pressures.join(", "));
    let outcome = solved(&compare, "periodic = true", wave).unwrap();
    let rows = table(&*outcome, "reference.csv").unwrap();
    assert_eq!(rows.len(), loads.len());
    for (row, [area, gap]) in
        rows.iter().zip([[0.19189453, 0.38489060], [0.52099609, 0.12497168], [0.95263672, 6.54826e-4]])
    {
        assert!((number(row, "raw_area_ratio") - area).abs() < 2.0 / 4096.0, "{row:?}");
        assert!((number(row, "mean_gap_m") / HEIGHT - gap).abs() < 1e-3 * gap, "{row:?}");
    }
    let nearly = number(&rows[3], "raw_area_ratio");
    assert!((nearly - (1.0 - 0.03 / (2.0 * PI))).abs() < 4.0 / 4096.0, "{nearly}");
    assert_eq!(number(&rows[4], "raw_area_ratio"), 1.0);
    assert!(number(&rows[4], "mean_gap_m").abs() < 1e-6 * HEIGHT);
    let curve = of_model(&*outcome, "reference");
    assert_eq!(curve.len(), loads.len());
    for (solved, row) in rows.iter().zip(&curve) {
        for file in [solved, row] {
            assert_eq!(file["area_ratio"], solved["raw_area_ratio"]);
        }
        assert_eq!(row["separation_m"], solved["mean_gap_m"]);
        assert!(row["separation_over_sigma"].is_empty() && number(solved, "plane_offset_m") == 0.0);
    }
    let at_load = table(&*outcome, "results.csv").unwrap();
    assert!(at_load[0]["separation_over_sigma"].is_empty());
    assert!(
        outcome
            .files()
            .iter()
            .all(|(file, content)| !String::from_utf8_lossy(content).contains("NaN")
                || panic!("{file} has NaN"))
    );
    assert!(table(&*outcome, "verdicts.csv").is_none_or(|rows| rows.is_empty()));
    let surface = &table(&*outcome, "surfaces.csv").unwrap()[0];
    assert!((number(surface, "sq_m") / (0.5 * HEIGHT) - 1.0).abs() < 1e-12 && surface["sigma_m"] == "0.0");
    let page = outcome.outline().markdown();
    assert!(page.contains("2 summits that are equally high") && !page.contains("NaN"), "{page}");
    assert!(serde_json::to_string(&outcome.records()).is_ok());
}

/// Hertz's contact radius of a ball, and what neither has a summit nor repeats.
#[test]
fn a_ball_a_grating_and_dimples_are_solved() {
    let radius = 2e-3;
    let off = |x: f64| LENGTH * (x - 0.5 - 0.5 / POINTS as f64);
    let ball = |x: f64, y: f64| -(off(x).powi(2) + off(y).powi(2)) / (2.0 * radius) / HEIGHT;
    let compare =
        |force: &str| format!("{ALONE}force = [\"{force}\"]\nreference = {{ boundary = \"finite\" }}\n");
    let outcome = solved(&compare("2 N"), "", ball).unwrap();
    let row = &table(&*outcome, "reference.csv").unwrap()[0];
    let load = number(row, "pressure_pa") * LENGTH * LENGTH;
    let contact = (0.75 * load * radius / (0.5 * 210e9 / 0.91)).cbrt();
    let found = (number(row, "raw_area_ratio") * LENGTH * LENGTH / PI).sqrt();
    assert!((found / contact - 1.0).abs() < 0.02, "{found} {contact}");

    let grating = |x: f64, _: f64| if (4.0 * x).fract() < 0.5 { 1.0 } else { 0.0 };
    let dimples = |x: f64, y: f64| {
        let away = |z: f64| (4.0 * z).fract() - 0.5;
        -(0.1 - away(x).powi(2) - away(y).powi(2)).max(0.0)
    };
    let pressed = format!("{ALONE}pressure = [\"10 MPa\", \"100 MPa\"]\n");
    for (name, height) in [("grating", &grating as &dyn Fn(f64, f64) -> f64), ("dimples", &dimples)] {
        let outcome = solved(&pressed, "periodic = true", height).unwrap();
        let areas = column(&table(&*outcome, "reference.csv").unwrap(), "raw_area_ratio");
        assert!(areas[0] > 0.0 && areas[1] <= 1.0 && areas[0] <= areas[1], "{name}: {areas:?}");
        assert!(
            outcome.files().iter().all(|(_, csv)| !String::from_utf8_lossy(csv).contains("NaN")),
            "{name}"
        );
    }
}

#[test]
fn a_model_that_is_asked_for_names_the_way_out() {
    for models in ["", "models = [\"statistical\"]\n", THREE] {
        let refused =
            solved(&format!("law = \"hertz\"\n{models}pressure = \"10 MPa\"\n"), "periodic = true", wave);
        let message = refused.err().unwrap();
        assert!(
            message.contains("equally high") && message.contains("`models = [\"reference\"]`"),
            "{message}"
        );
    }
    let refused = solved(&format!("{ALONE}separation = [1, 2]\n"), "periodic = true", wave).err().unwrap();
    assert!(refused.contains("separations"), "{refused}");
}
