//! Coverage of intervals: made-up intervals, and windows of small processes.

use asperity::compare::{CONTACTS_PER_GROUP, ComparedQuantity, Estimate, GROUPS, Support};
use asperity::contact_law::named;
use asperity::spot::{Conduction, SpotProperties};
use asperity::study::LawContact;
use asperity::topography::generate::{Process, SpectrumOf, SurfaceGenerator};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::{Heights, Material, WithSpots};
use asperity_evidence::coverage::{Coverage, EndlessProcess, QuantityEstimate, WindowResults, WindowTask};

const PIXEL: f64 = 1e-6;

fn estimate(contrast: f64, error: Option<f64>, independent_error: Option<f64>) -> QuantityEstimate {
    let estimate =
        Estimate { contrast, error, quantile: 2.0, bound: 0.0, independent_error, support: Support::Sampled };
    QuantityEstimate { estimate, independent_error, contacts: 100.0, area_ratio: 0.01 }
}

fn coverage_of(windows: &[QuantityEstimate]) -> Option<Coverage> {
    Coverage::new("one", 1.0, ComparedQuantity::Area, windows)
}

#[test]
fn intervals_that_hold_the_mean_are_counted() {
    // The mean is 2. Intervals: 1 to 3, 0 to 2 (which ends at the mean), 3.5 to 4.5, and none.
    let windows = [
        estimate(2.0, Some(0.5), Some(0.01)),
        estimate(1.0, Some(0.5), None),
        estimate(4.0, Some(0.25), Some(0.01)),
        estimate(1.0, None, Some(1.0)),
    ];
    let coverage = coverage_of(&windows).unwrap();
    assert_eq!((coverage.windows, coverage.truth, coverage.scatter), (4, 2.0, 2f64.sqrt()));
    assert_eq!((coverage.claimed.intervals, coverage.claimed.covered), (3, 2));
    assert_eq!(coverage.claimed.coverage(), Some(2.0 / 3.0));
    assert_eq!(coverage.claimed.coverage_error(), Some((2.0f64 / 27.0).sqrt()));
    assert_eq!(coverage.claimed_share(), 0.75);
    let stated = coverage.error_over_scatter(&coverage.claimed).unwrap();
    assert!((stated - 1.25 / 3.0 / 2f64.sqrt()).abs() < 1e-15);
    // Errors of independent asperities: 0.01 holds at the mean only.
    assert_eq!((coverage.independent.intervals, coverage.independent.covered), (3, 2));
    assert_eq!(coverage_of(&windows[..1]), None);
    let none = coverage_of(&[estimate(1.0, None, None), estimate(2.0, None, None)]).unwrap();
    assert_eq!((none.claimed.coverage(), none.claimed.coverage_error()), (None, None));
    assert_eq!(none.error_over_scatter(&none.independent), None);
}

fn steel() -> LawContact {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    LawContact::bare(named("hertz").unwrap(), &steel, &steel).unwrap()
}

fn process(name: &'static str, points: usize, roll_off: f64, cut_off: f64) -> EndlessProcess {
    let [roll_off, cut_off] = [roll_off, cut_off].map(|pixels| pixels * PIXEL);
    let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off, cut_off };
    let spectrum = Spectrum::new(shape, Lay::default()).unwrap();
    let process = Process { spectrum, of: SpectrumOf::Gaussian, sigma: 1e-7, heights: Heights::GAUSSIAN };
    let patches = Spectrum::new(SpectrumShape::Gaussian(20.0 * PIXEL), Lay::default()).unwrap();
    let generator = SurfaceGenerator { points: [2 * points; 2], pixel: [PIXEL; 2], process, plateau: None };
    let patches = (name == "patchy").then_some((0.5, patches));
    EndlessProcess { name, generator, patches, second: None, seed: 5 }
}

/// The windows of two maps of a process at loads of `contacts`, of which those of the first are studied.
fn results(process: &EndlessProcess, contacts: &[f64]) -> (Vec<f64>, Vec<WindowResults>) {
    let law = steel();
    let loads = process.loads(&*law.contact, contacts).unwrap();
    let thermal = Some(Conduction::new([1.0; 2]).unwrap());
    let spots = SpotProperties { thermal, ..SpotProperties::default() };
    let law = LawContact { contact: Box::new(WithSpots::new(law.contact, spots)), ..law };
    let task = WindowTask { law: &law, loads: &loads, generates: false, seed: 1 };
    let of_map = |map: usize| {
        let windows = process.windows(&format!("map {map}")).unwrap();
        let run = |positions: &Vec<_>| task.run("window", positions, map == 0).unwrap();
        windows.iter().map(run).collect::<Vec<_>>()
    };
    let windows = (0..2).flat_map(of_map).collect();
    (loads, windows)
}

/// The quantities that are compared.
const COMPARED: [ComparedQuantity; 4] = [
    ComparedQuantity::Separation,
    ComparedQuantity::Area,
    ComparedQuantity::Stiffness,
    ComparedQuantity::ThermalConductance,
];

fn estimates(window: &WindowResults, load: f64) -> Vec<QuantityEstimate> {
    COMPARED.map(|quantity| window.estimate(load, quantity).unwrap()).to_vec()
}

#[test]
fn windows_of_short_waves_have_intervals_where_contacts_are_many() {
    let short = process("short", 256, 10.0, 3.0);
    let (loads, windows) = results(&short, &[20.0, 200.0]);
    assert_eq!(windows.len(), 8);
    assert!(loads[0] < loads[1]);
    let least = CONTACTS_PER_GROUP * GROUPS as f64;
    for window in &windows {
        assert!(window.correlation > 0.005 && window.correlation < 0.03, "{}", window.correlation);
        for (load, claims) in loads.iter().zip([false, true]) {
            for of in estimates(window, *load) {
                assert_eq!(of.contacts >= least, claims, "{of:?}");
                assert_eq!(of.estimate.interval().is_some(), claims, "{of:?}");
                assert_eq!(of.independent_error.is_some(), claims);
            }
        }
    }
    // The same to the bit, whatever the threads.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(pool.install(|| results(&short, &[20.0, 200.0])).1, windows);
}

/// Of two bodies the interval at several relative positions is narrower than that at one, and the same at one position as of one map.
#[test]
fn positions_of_two_bodies_narrow_the_interval() {
    let errors = |shifts: usize| {
        let second = Some((Box::new(process("other", 256, 10.0, 3.0)), shifts));
        let pair = EndlessProcess { second, ..process("short", 256, 10.0, 3.0) };
        let (loads, windows) = results(&pair, &[200.0]);
        let error = |window: &WindowResults| estimates(window, loads[0])[1].estimate.error;
        windows.iter().map(error).collect::<Vec<_>>()
    };
    let [one, four] = [errors(1), errors(4)];
    let pairs: Vec<(f64, f64)> =
        one.iter().zip(&four).filter_map(|(one, four)| Some(((*one)?, (*four)?))).collect();
    assert!(pairs.len() > 4, "{pairs:?}");
    let mean = |of: fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / pairs.len() as f64;
    assert!(mean(|pair| pair.1) < 0.9 * mean(|pair| pair.0), "{pairs:?}");
    // The floor of the part that positions share.
    assert!(pairs.iter().all(|(one, four)| *four >= 0.5 * one), "{pairs:?}");
}

#[test]
fn long_or_patchy_waves_have_no_interval() {
    for (name, roll_off) in [("long", 100.0), ("patchy", 10.0)] {
        let (loads, windows) = results(&process(name, 256, roll_off, 3.0), &[200.0]);
        for window in &windows {
            assert!(name == "long" || window.is_patchy);
            for of in estimates(window, loads[0]) {
                assert_eq!(of.estimate.error, None, "{name}");
            }
        }
        // Random groups of asperities would give one.
        let independent = |window: &WindowResults| estimates(window, loads[0])[0].independent_error;
        assert!(windows.iter().any(|window| independent(window).is_some()), "{name}");
    }
}

#[test]
fn windows_without_contacts_are_refused() {
    let contact = steel().contact;
    let too_many = process("short", 128, 10.0, 3.0).loads(&*contact, &[50.0, 1e5]).unwrap_err();
    assert!(too_many.to_string().contains("100000 effective contacts are not reached"), "{too_many}");
}

/// The first map is studied: there the verdicts are those of the windows, with what they depend on.
#[test]
fn verdicts_of_studied_windows_are_those_of_the_windows() {
    let (_, windows) = results(&process("short", 256, 10.0, 3.0), &[100.0, 200.0]);
    let mut decided = 0;
    for (index, window) in windows.iter().enumerate() {
        assert_eq!(window.studied.is_some(), index < 4);
        let Some(studied) = &window.studied else { continue };
        let mut own = window.verdicts.clone();
        own.retain(|verdict| verdict.quantity != ComparedQuantity::ThermalConductance);
        assert_eq!(studied.len(), own.len());
        for (studied, own) in studied.iter().zip(&own) {
            assert_eq!(
                (studied.load, studied.quantity, studied.verdict),
                (own.load, own.quantity, own.verdict)
            );
            assert_eq!(studied.contrast, own.contrast);
            decided += 1;
        }
    }
    assert!(decided > 0);
}
