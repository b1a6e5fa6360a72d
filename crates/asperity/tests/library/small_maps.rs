//! Maps too small for blocks: model-based intervals where a process can be fitted to them, and none where it cannot.

use asperity::compare::{Accepted, ComparedQuantity, NotModelled, Support};
use asperity::study::{Basis, CaseStudy, LawContact, verdicts};
use asperity::surface::{Preparation, SummitSearch};
use asperity::topography::Level;
use asperity::topography::generate::{Plateau, Process, Seeds, SpectrumOf, SurfaceGenerator, Unfitted};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::topography::summits::Neighbours;
use asperity::{HeightMap, Heights, Material, contact_law};

const POINTS: usize = 192;
const PIXEL: f64 = 1e-6;

fn process(roll_off: f64, sigma: f64) -> Process {
    let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: roll_off * PIXEL, cut_off: 3.0 * PIXEL };
    let spectrum = Spectrum::new(shape, Lay::default()).unwrap();
    Process { spectrum, of: SpectrumOf::Gaussian, sigma, heights: Heights::GAUSSIAN }
}

/// A window of a map of twice the side, its heights times an amplitude at each place along x from 0 to 1.
fn window(roll_off: f64, plateau: Option<Plateau>, amplitude: impl Fn(f64) -> f64) -> HeightMap {
    let side = 2 * POINTS;
    let process = process(roll_off, 1e-7);
    let generator = SurfaceGenerator { points: [side; 2], pixel: [PIXEL; 2], process, plateau };
    let (map, _) = generator.surface(Seeds { process: [4; 32], plateau: [5; 32] }).unwrap();
    let rows = map.heights().chunks(side).take(POINTS).enumerate();
    let heights = rows.flat_map(|(x, row)| {
        let amplitude = amplitude(x as f64 / POINTS as f64);
        row[..POINTS].iter().map(move |z| amplitude * z)
    });
    HeightMap::new([POINTS; 2], [PIXEL; 2], heights.collect(), f64::EPSILON).unwrap()
}

fn study(map: &HeightMap) -> CaseStudy {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    let laws = [LawContact::bare(contact_law::named("zmc").unwrap(), &steel, &steel).unwrap()];
    let preparation = Preparation { level: Level::Plane, ..Preparation::none(Neighbours::Four) };
    let surface = SummitSearch::new(preparation).surface("small", map).unwrap();
    verdicts(&surface, &laws, &[5e6, 2e7, 6e7], Accepted::DEFAULT).unwrap().remove(0)
}

fn reason(case: &CaseStudy) -> Option<NotModelled> {
    match case.verdicts.basis {
        Basis::TooSmall { not_modelled, .. } => not_modelled,
        _ => None,
    }
}

#[test]
fn a_stationary_map_of_ten_correlation_lengths_has_model_based_intervals() {
    let case = study(&window(55.0, None, |_| 1.0));
    assert_eq!(case.verdicts.basis, Basis::ModelBased);
    let estimates = || case.verdicts.differences.iter().flat_map(|at| at.estimates.iter().flatten());
    assert!(estimates().any(|one| one.support == Support::Generated && one.interval().is_some()));
    let again = study(&window(55.0, None, |_| 1.0));
    assert_eq!(again.verdicts.differences, case.verdicts.differences, "intervals follow from the seed");
}

#[test]
fn no_interval_is_claimed_where_no_process_describes_the_map() {
    let patchy = study(&window(55.0, None, |x| 1.0 + 0.45 * (6.0 * x).sin()));
    assert_eq!(reason(&patchy), Some(NotModelled::Unfitted(Unfitted::Patchy)));
    let long = study(&window(180.0, None, |_| 1.0));
    assert_eq!(reason(&long), Some(NotModelled::Unfitted(Unfitted::TooShort)));
}

/// Plateaus are no transform of a Gaussian surface: the process does not reproduce the difference on such a map, and its interval is wider for it.
#[test]
fn intervals_are_wider_where_the_process_describes_the_map_less() {
    let error = |plateau: Option<Plateau>| {
        let case = study(&window(55.0, plateau, |_| 1.0));
        assert_eq!(case.verdicts.basis, Basis::ModelBased);
        case.verdicts.differences[2].estimates[ComparedQuantity::Area as usize].unwrap().error.unwrap()
    };
    let [stationary, worn] = [None, Some(Plateau { process: process(12.0, 3e-8), height: 3e-8 })].map(error);
    assert!(worn > 1.5 * stationary, "{stationary} {worn}");
}

/// What holds on the map itself is said without any interval.
#[test]
fn the_difference_on_the_map_is_given_without_an_interval() {
    let case = study(&window(180.0, None, |_| 1.0));
    assert!(!case.verdicts.on_map.is_empty());
    // The halves agree in sign at some load, by at most the largest difference of any of them.
    let on_halves =
        |one: &asperity::compare::Estimate| matches!(one.support, Support::Halves(least) if least > 0.0);
    let estimates = || case.verdicts.differences.iter().flat_map(|at| at.estimates.iter().flatten());
    assert!(estimates().any(on_halves), "{:?}", case.verdicts.differences);
    let results = case.results_at_load();
    assert_eq!(results.models.len(), 2);
    let [integral, sum] = [0, 1].map(|k| results.models[k].point);
    assert!((integral.pressure / sum.pressure - 1.0).abs() < 1e-9 && sum.area_ratio > 0.0);
}
