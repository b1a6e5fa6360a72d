//! σ and d of the asperities or of the surface: generated surfaces, populations, and what the reading changes.

use std::path::Path;

use asperity::compare::{Control, ModelKind};
use asperity::distribution::gaussian_moment;
use asperity::study::CaseResults;
use asperity::topography::Rows;
use asperity::topography::generate::SigmaOf;
use asperity::topography::read::{ReadOptions, height_map};
use asperity::{Population, SurfaceHeights, npy};
use asperity_contact_framework::Outcome;
use asperity_experiment::kind::compare::readings::loads_by_reading;
use asperity_experiment::kind::compare::results::CompareResults;

use crate::Report;
use crate::results::{self, table};

/// A comparison under Hertz, whose integral has a closed form.
fn run(separations: &str, surfaces: &str) -> Box<dyn Outcome> {
    let spec = format!(
        "title = \"t\"\nseed = 3\n{}[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"hertz\"\n\
         separation = {{ values = {separations} }}\n{surfaces}",
        steel!(),
    );
    results::run(&spec).unwrap()
}

fn population(name: &str, sigma: &str, heights: &str) -> String {
    format!(
        "[surface.{name}.population]\nradius = \"20 um\"\nsigma = \"{sigma}\"\ndensity = \"6e10 /m^2\"\ncount = 100000\n\
         draw = \"quantiles\"\nheights = \"{heights}\"\n"
    )
}

/// Greenwood and Williamson's pressure at a separation (m) from the mean asperity height.
fn greenwood_williamson(population: &Population, modulus: f64, separation: f64) -> f64 {
    let &Population { radius, sigma, density, .. } = population;
    let moment = gaussian_moment(1.5, separation / sigma);
    4.0 / 3.0 * density * modulus * radius.sqrt() * sigma.powf(1.5) * moment
}

fn pressure(results: &CaseResults, kind: ModelKind, h: f64) -> f64 {
    let curves = &results.comparison.curves;
    let at = |target: f64| target == h;
    let mut points = curves.iter().filter(|point| point.kind == kind && point.control == Control::Separation);
    points.find(|point| at(point.target)).unwrap().response.pressure.total()
}

/// Sq is prescribed, and d is measured from the mean plane in Sq, by both models.
#[test]
fn a_generated_surface_has_sigma_of_its_surface() {
    let surface = "[surface.a.generate]\npoints = 512\nspectrum.self-affine = { hurst = 0.8 }\n\
                   summits = { radius = \"20 um\", sigma = \"48 nm\", density = \"6e10 /m^2\", heights = \"surface\" }\n";
    let outcome = run("[2, 1]", surface);
    let page = outcome.outline().markdown();
    assert!(page.contains("| separations from | mean plane of the surface |"), "{page}");
    assert!(!page.contains("Two readings"), "there is one reading only");
    let results: CompareResults = crate::downcast(outcome);
    let found = &results.surfaces[0];
    let surface = &found.surface;
    assert_eq!(surface.separations_of(), SigmaOf::Surface);
    let moments = surface.map.as_ref().unwrap().roughness.moments;
    assert!((moments.sq / 48e-9 - 1.0).abs() < 1e-12, "{}", moments.sq);
    assert!((surface.statistics.mean_radius / 20e-6 - 1.0).abs() < 1e-3);
    assert!((surface.set.density() / 6e10 - 1.0).abs() < 1e-3);
    // The summits scatter less than the surface and lie above its mean plane.
    assert!(surface.statistics.sigma < 0.95 * moments.sq);
    assert!(surface.offset_to_mean_plane().unwrap() > 0.5 * moments.sq);
    for h in [2.0, 1.0] {
        let separation = h * moments.sq - (surface.statistics.mean_height - moments.mean);
        let expected = greenwood_williamson(
            &found.realisations[0].population,
            results.contact.reduced_modulus,
            separation,
        );
        let integral = pressure(found.cases[0].first(), ModelKind::Statistical, h);
        assert!((integral / expected - 1.0).abs() < 1e-9, "{integral} and {expected}");
        // The sum is over the same asperities, from the same plane.
        let sum = pressure(found.cases[0].first(), ModelKind::Deterministic, h);
        assert!((0.5..1.5).contains(&(sum / integral)), "{sum} and {integral}");
    }
}

#[test]
fn the_same_numbers_in_both_readings_are_compared() {
    let surfaces = [population("a", "48 nm", "gaussian"), population("b", "48 nm", "surface")].concat();
    let outcome = run("[3, 2, 1.5, 1]", &surfaces);
    let page = outcome.outline().markdown();
    assert!(page.contains("## Two readings of σ and d"), "{page}");
    let rows = table(&*outcome, "readings.csv").unwrap().len();
    let results: CompareResults = crate::downcast(outcome);
    let readings = loads_by_reading(&results.surfaces);
    assert_eq!(rows, readings.len());
    let (radius, sigma, density) = (20e-6, 48e-9, 6e10);
    let surface = SurfaceHeights { radius, sigma, density };
    let modulus = results.contact.reduced_modulus;
    let asperities = Population { radius, sigma, density, heights: asperity::Heights::GAUSSIAN };
    let converted = Population { sigma: surface.asperity_sigma().unwrap(), ..asperities.clone() };
    // d/sigma = 1.5 is not among those of the table.
    assert_eq!(readings.len(), 6);
    for loads in &readings {
        assert_eq!(loads.surfaces, ["a", "b"]);
        let d = loads.separation * sigma;
        let expected = greenwood_williamson(&converted, modulus, d - surface.mean_asperity_height())
            / greenwood_williamson(&asperities, modulus, d);
        let tolerance = if loads.kind == ModelKind::Statistical { 1e-9 } else { 0.01 };
        assert!((loads.ratio() / expected - 1.0).abs() < tolerance, "{loads:?}: {expected}");
        // At one sigma of the surface, more than 5 % of it is in contact.
        assert_eq!(loads.is_admissible(), loads.separation > 1.0, "{loads:?}");
    }
}

#[test]
fn other_numbers_or_other_separations_are_not_compared() {
    let same = |sigma| [population("a", "48 nm", "gaussian"), population("b", sigma, "surface")].concat();
    let one_reading = [population("a", "48 nm", "surface"), population("b", "48 nm", "surface")].concat();
    let other_heights =
        [population("a", "48 nm", "exponential"), population("b", "48 nm", "surface")].concat();
    for (separations, surfaces) in [
        ("[3, 2, 1]", same("50 nm")),
        ("[2.5, 1.5]", same("48 nm")),
        ("[3, 2, 1]", one_reading),
        ("[3, 2, 1]", other_heights),
    ] {
        let outcome = run(separations, &surfaces);
        assert!(!outcome.outline().markdown().contains("Two readings"));
        let results: CompareResults = crate::downcast(outcome);
        assert!(loads_by_reading(&results.surfaces).is_empty());
    }
}

/// The same heights, near zero and at 1 m: the offset is reported, and costs no digit of any result.
#[test]
fn an_offset_of_a_list_costs_no_digits() {
    let folder = tempfile::tempdir().unwrap();
    let list = |name: &str, offset: f64| {
        let path = folder.path().join(format!("{name}.csv"));
        let lines = (0..500).map(|k| {
            let height = offset + f64::EPSILON * f64::from((k * k * 7) % 1009 * 100_000);
            format!("{height:?},{:?}\n", 1e-5 * f64::from(1 + k % 7))
        });
        std::fs::write(&path, format!("height,radius\n{}", lines.collect::<String>())).unwrap();
        format!("[surface.{name}.asperities]\nfile = {path:?}\nnominal-area = \"1 mm^2\"\n")
    };
    let results: CompareResults = crate::downcast(run("[2, 1, 0]", &(list("near", 0.0) + &list("far", 1.0))));
    let [near, far] = [0, 1].map(|k| &results.surfaces[k]);
    assert_eq!([near.surface.origin, far.surface.origin], [0.0, 1.0]);
    let [low, high] = [near, far].map(|found| found.surface.reported_statistics());
    assert!((high.mean_height - 1.0 - low.mean_height).abs() < 2.0 * f64::EPSILON);
    assert!((high.sigma / low.sigma - 1.0).abs() < 2e-15);
    for kind in [ModelKind::Statistical, ModelKind::Deterministic] {
        for h in [2.0, 1.0, 0.0] {
            let [low, high] = [near, far].map(|found| pressure(found.cases[0].first(), kind, h));
            assert!((low == 0.0 && high == 0.0) || (high / low - 1.0).abs() < 1e-14, "{high} for {low}");
        }
    }
}

/// The same of a map: an X3P file whose offset of z is 1 m, and its heights without the offset.
#[test]
fn the_offset_of_an_x3p_file_is_reported_and_costs_no_digits() {
    let folder = tempfile::tempdir().unwrap();
    let formats = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/asperity/tests/library/formats");
    let far = formats.join("surface_placed_binary.x3p");
    let map = height_map(&far, ReadOptions::default()).unwrap();
    assert_eq!(map.offset(), 1.0);
    let near = folder.path().join("near.npy");
    npy::write(std::fs::File::create(&near).unwrap(), map.points(), map.heights().iter().copied()).unwrap();
    let found = |level: &str| {
        let both = format!(
            "[surface.near.file]\npath = {near:?}\npixel = \"1 um\"\nlevel = \"{level}\"\n\
             [surface.far.file]\npath = {far:?}\nlevel = \"{level}\"\n"
        );
        let results: CompareResults = crate::downcast(run("[1]", &both));
        let [near, far] = [0, 1].map(|k| results.surfaces[k].surface.reported_statistics());
        assert!((far.sigma / near.sigma - 1.0).abs() < 1e-14, "{level}: {} for {}", far.sigma, near.sigma);
        far.mean_height - near.mean_height
    };
    assert_eq!(found("plane"), 0.0);
    assert!((found("none") - 1.0).abs() < 2.0 * f64::EPSILON);
}
