//! `[surface.NAME.pair]`: two rough bodies.

use std::path::Path;

use asperity::compare::{ComparedQuantity, Estimate, Repeats};
use asperity::contact_law::named;
use asperity::study::{Basis, Shortcut};
use asperity::{Flat, Material, MeanRadius, Model};
use asperity_contact_framework::Outcome;
use asperity_experiment::kind::compare::results::CompareResults;

use crate::results::{self, ON_STEEL, number, table};

/// A generated surface.
fn body(name: &str, sigma: &str, points: usize) -> String {
    format!(
        "[surface.{name}.generate]\npoints = {points}\npixel = \"1 um\"\nsigma = \"{sigma}\"\n\
         spectrum.self-affine = {{ hurst = 0.8, roll-off = \"40 um\", cut-off = \"8 um\" }}\n"
    )
}

fn run(surfaces: &[String]) -> CompareResults {
    compared("", surfaces)
}

fn compared(compare: &str, surfaces: &[String]) -> CompareResults {
    let loads = "pressure = [\"5 MPa\", \"10 MPa\", \"20 MPa\"]\n";
    let spec = [ON_STEEL, loads, compare, "\n", &surfaces.join("\n")].concat();
    crate::downcast(results::run(&spec).unwrap())
}

fn pair(keys: &str) -> String {
    format!("[surface.both.pair]\na = \"a\"\nb = \"b\"\n{keys}\n")
}

/// Simplification, model and error of the area of each row of `two_bodies.csv`.
fn errors_of_area(results: &CompareResults) -> Vec<(String, String, f64)> {
    let rows = table(results, "two_bodies.csv").unwrap();
    let errors = rows.iter().map(|row| number(row, "area_error"));
    rows.iter()
        .zip(errors)
        .map(|(row, error)| (row["simplification"].clone(), row["model"].clone(), error))
        .collect()
}

#[test]
fn a_rough_body_against_a_smooth_one_is_that_body() {
    let surfaces = [body("a", "100 nm", 512), body("b", "0.001 nm", 512), pair("shifts = 1")];
    let results = compared("surfaces = [\"a\", \"both\"]", &surfaces);
    let [alone, both] = &results.surfaces[..] else { panic!("two surfaces") };
    let points = |surface: usize| {
        let case = &results.surfaces[surface].cases[0];
        let at = case.results_at(1e7);
        at.models.iter().map(|model| model.point).collect::<Vec<_>>()
    };
    let errors = errors_of_area(&results);
    let smooth: Vec<f64> =
        errors.iter().filter(|(what, ..)| what == "smooth b").map(|(.., error)| *error).collect();
    assert!(smooth.len() == 2 && smooth.iter().all(|error| error.abs() < 1e-3), "{errors:?}");
    // So is the sum of variances; towards a smooth body the pairs of Greenwood and Tripp have no limit.
    assert!(errors.iter().all(|(what, ..)| what != "greenwood-tripp"), "{errors:?}");
    let warnings = &both.surface.warnings;
    assert!(
        warnings.iter().any(|warning| warning.contains("no integral of Greenwood and Tripp")),
        "{warnings:?}"
    );
    for (alone, both) in points(0).into_iter().zip(points(1)) {
        assert!((both.area_ratio / alone.area_ratio - 1.0).abs() < 1e-3, "{alone:?} {both:?}");
    }
    assert_eq!(alone.surface.set.count(), both.surface.set.count());
    assert_eq!((both.surface.repeats, both.cases[0].verdicts.shifts), (Repeats::Shifts, 1));
}

/// The heights of bodies that are independent add their variances, and asperities of the sum are higher and sharper than those of one.
#[test]
fn the_heights_of_both_bodies_add_up() {
    let bodies = [body("a", "60 nm", 512), body("b", "80 nm", 512)];
    let results = run(&[&bodies[..], &[pair("shifts = 2\nrotations = true")]].concat());
    let sq = |surface: usize| results.surfaces[surface].surface.map.as_ref().unwrap().roughness.moments.sq;
    let expected = sq(0).hypot(sq(1));
    assert!((sq(2) / expected - 1.0).abs() < 0.05, "{} {expected}", sq(2));
    assert!(results.surfaces[2].surface.warnings.iter().any(|warning| warning.contains("rotated by 0, 90")));
}

/// Of the error of the first position, which its blocks give, the scatter between positions averages out.
#[test]
fn relative_positions_share_the_heights() {
    let of = |keys: &str| {
        let results = run(&[body("a", "100 nm", 1024), body("b", "50 nm", 1024), pair(keys)]);
        results.surfaces.into_iter().nth(2).unwrap().cases.remove(0)
    };
    let [one, four] = [of("shifts = 1"), of("shifts = 4")];
    assert!(matches!(four.verdicts.basis, Basis::Blocks { .. }), "{:?}", four.verdicts.basis);
    let area = |at: usize, case: &asperity::study::CaseStudy| -> Estimate {
        case.verdicts.differences[at].estimates[ComparedQuantity::Area as usize].unwrap()
    };
    for at in 0..3 {
        let each: Vec<f64> = four
            .realisations
            .iter()
            .map(|case| case.differences[at].estimates[ComparedQuantity::Area as usize].unwrap().contrast)
            .collect();
        assert_eq!(each[0], area(at, &one).contrast, "the first position");
        assert!(each[1..].iter().all(|other| *other != each[0]), "other positions: {each:?}");
        let mean = each.iter().sum::<f64>() / 4.0;
        let variance = each.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / 3.0;
        let own = area(at, &one).error.unwrap().powi(2);
        let expected = (0.25 * variance + (own - variance).max(0.25 * own)).sqrt();
        let found = area(at, &four);
        assert!(
            (found.error.unwrap() / expected - 1.0).abs() < 1e-12 && (found.contrast - mean).abs() < 1e-14
        );
        assert_eq!(found.quantile, area(at, &one).quantile);
    }
    let at = four.results_at(1e7);
    let sum = &at.models[1];
    let [low, high] = sum.intervals[ComparedQuantity::Area as usize].unwrap();
    assert!(low < sum.point.area_ratio && sum.point.area_ratio < high);
}

/// Maps that do not repeat count where they overlap; the finer one is resampled.
#[test]
fn measured_maps_overlap() {
    let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments/surfaces/opd-1.npy");
    let map = map.display();
    let a = format!("[surface.a.file]\npath = \"{map}\"\npixel = \"200 nm\"\n");
    let b = format!("[surface.b.file]\npath = \"{map}\"\npixel = \"100 nm\"\ntranspose = true\n");
    let results = run(&[a, b, pair("shifts = 2")]);
    let [a, _, both] = &results.surfaces[..] else { panic!("three surfaces") };
    let facts = both.surface.map.as_ref().unwrap();
    assert_eq!(facts.pixel, [200e-9; 2]);
    assert!(facts.points[0] < a.surface.map.as_ref().unwrap().points[0]);
    let caveat = both.surface.warnings.iter().find(|warning| warning.contains("two rough bodies")).unwrap();
    assert!(
        caveat.contains("2 random relative positions") && caveat.contains("% of the smaller map"),
        "{caveat}"
    );
}

/// Each body alone has more contact area than both at the same load, and the integrals are those of the library.
#[test]
fn simplifications_of_two_rough_bodies() {
    let surfaces = [body("a", "100 nm", 512), body("b", "60 nm", 512), pair("shifts = 2")];
    let results = run(&surfaces);
    let errors = errors_of_area(&results);
    let error = |wanted: &str, model: &str| {
        let found = errors.iter().find(|(what, by, _)| what == wanted && by == model);
        found.unwrap_or_else(|| panic!("{wanted}, {model}: {errors:?}")).2
    };
    for model in ["statistical", "deterministic"] {
        // Without the rougher body more is lost.
        assert!(error("smooth a", model) > error("smooth b", model), "{errors:?}");
        assert!(error("smooth b", model) > 0.05, "{errors:?}");
    }
    let surface = &results.surfaces[2].surface;
    let bodies =
        surface.bodies.as_ref().unwrap().each_ref().map(|body| body.population(MeanRadius::Arithmetic));
    assert_eq!(bodies[0].radius, results.surfaces[0].surface.statistics.mean_radius);
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    let contact = named("zmc").unwrap().interface(&steel, &Flat::Bare(steel)).unwrap();
    let at = results.surfaces[2].cases[0].results_at_load();
    for shortcut in Shortcut::ALL {
        let model = shortcut.model(&*contact, &bodies).unwrap();
        for found in &at.models {
            let response = model.respond(model.separation_at(found.point.pressure).unwrap());
            let expected = response.area_ratio.total() / found.point.area_ratio - 1.0;
            let by = found.model.unwrap().name();
            assert!((error(shortcut.name(), by) - expected).abs() < 1e-6, "{shortcut:?} {by}");
        }
    }
}

/// Of two populations the integral is over the asperities of their composite.
#[test]
fn populations_have_a_composite() {
    let population = |name: &str, sigma: &str| {
        format!(
            "[surface.{name}.population]\nradius = \"20 um\"\nsigma = \"{sigma}\"\ndensity = \"6e10 /m^2\"\n\
             count = 1000\nheights = \"surface\"\n"
        )
    };
    let of = |second: &str| {
        let surfaces = [population("a", "48 nm"), population("b", second), pair("")];
        compared("models = [\"statistical\"]", &surfaces)
    };
    let results = of("48 nm");
    let [alone, _, both] = &results.surfaces[..] else { panic!("three surfaces") };
    let [alone, composite] = [alone, both].map(|found| found.surface.nominal.clone().unwrap());
    // Twice the same roughness: heights and curvatures grow by the root of two.
    let ratios = [
        composite.sigma / alone.sigma,
        alone.radius / composite.radius,
        2f64.sqrt() * composite.density / alone.density,
    ];
    assert!(ratios.iter().all(|ratio| (ratio / 2f64.sqrt() - 1.0).abs() < 1e-12), "{ratios:?}");
    let names: Vec<String> = errors_of_area(&results).into_iter().map(|(what, ..)| what).collect();
    assert_eq!(names, ["smooth b", "smooth a", "variances-added", "greenwood-tripp"]);
    let unequal = of("22 nm");
    let names: Vec<String> = errors_of_area(&unequal).into_iter().map(|(what, ..)| what).collect();
    assert_eq!(names, ["smooth b", "smooth a", "variances-added"]);
    let warnings = &unequal.surfaces[2].surface.warnings;
    assert!(warnings.iter().any(|warning| warning.contains("at least 0.5")), "{warnings:?}");
}

/// p(h/sigma) of two equal elastic bodies, and of two that no isotropic Gaussian surface has.
#[test]
fn the_curve_of_greenwood_and_tripp() {
    let run = |compare: &str, sigma: &str| {
        let head = ON_STEEL.replace("zmc", "hertz");
        let body = |name: &str| {
            format!(
                "[surface.{name}.population]\nradius = \"10 um\"\nsigma = \"{sigma}\"\ndensity = \"2e10 /m^2\"\ncount = 1000\n"
            )
        };
        let models = "models = [\"statistical\"]\nsurfaces = [\"both\"]\n";
        let text = [&head, compare, models, &body("a"), &body("b"), &pair("")].concat();
        results::run(&text).unwrap()
    };
    let rows = |results: &dyn Outcome| table(results, "greenwood_tripp.csv").unwrap();
    // By adaptive quadrature (scipy).
    const MOMENTS: [f64; 8] = [
        6.1663421900e-01,
        2.4040157067e-01,
        8.0562335571e-02,
        2.2863056021e-02,
        5.4237051975e-03,
        1.0636889501e-03,
        1.7087299621e-04,
        2.2312407198e-05,
    ];
    let separations = "separation = [0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4]\n";
    let found = run(separations, "0.2 um");
    let curve = rows(&*found);
    assert_eq!(curve.len(), 9);
    let modulus = 0.5 * 210e9 / (1.0 - 0.3f64.powi(2));
    let (sigma, radius, density) = (0.2e-6 * 2f64.sqrt(), 10e-6, 2e10);
    for (row, (moment, k)) in curve.iter().zip(MOMENTS.into_iter().zip(0..)) {
        let h = 0.5 * f64::from(k);
        let scale = 16.0 * 2f64.sqrt() * std::f64::consts::PI / 15.0
            * (density * radius * sigma).powi(2)
            * (sigma / radius).sqrt()
            * modulus;
        let law = 4.4086e-5 * (4.0 - h).powf(6.804);
        for (column, value) in [
            ("separation_over_sigma", h),
            ("separation_m", h * sigma),
            ("f_5_2", moment),
            ("pressure_pa", scale * moment),
            ("power_law", law),
            ("power_law_error", law / moment - 1.0),
        ] {
            assert!(
                (number(row, column) - value).abs() <= 1e-7 * value.abs(),
                "{column} at {h}: {}",
                row[column]
            );
        }
    }
    let default = rows(&*run("pressure = \"5 MPa\"\n", "0.2 um"));
    assert_eq!((default.len(), number(&default[25], "separation_over_sigma")), (41, 2.5));

    // eta R sigma of 0.012 is below that of any surface: the statistical model is the curve.
    let pairs = run(separations, "60 nm");
    let curve = rows(&*pairs);
    let statistical = table(&*pairs, "curves.csv").unwrap();
    assert_eq!(statistical.len(), 9);
    for (row, point) in curve.iter().zip(&statistical) {
        for column in ["separation_over_sigma", "pressure_pa", "area_ratio"] {
            assert!(
                (number(row, column) / number(point, column) - 1.0).abs() < 1e-12
                    || row[column] == point[column]
            );
        }
    }
    assert!(pairs.warnings().iter().any(|warning| warning.contains("no isotropic Gaussian surface")));
}

/// A map of heights on coarse steps carries no verdict, and no pair with it does; two fit ones do.
#[test]
fn an_unfit_body_blocks_its_pair() {
    let map = |name: &str| {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments/surfaces").join(name).display().to_string()
    };
    let a = body("a", "100 nm", 512);
    let coarse = format!("[surface.b.file]\npath = \"{}\"\npixel = \"1.66 um\"\n", map("plu-1.npy"));
    let blocked = run(&[a.clone(), coarse, pair("shifts = 2")]);
    let both = &blocked.surfaces[2].surface;
    assert!(both.fitness().iter().any(|finding| finding.is_blocking()), "{:?}", both.fitness());
    assert!(both.warnings.iter().any(|warning| warning.starts_with("b: ")), "{:?}", both.warnings);
    let fit = run(&[a, body("b", "60 nm", 512), pair("shifts = 2")]);
    assert!(fit.surfaces[2].surface.fitness().iter().all(|finding| !finding.is_blocking()));
}
