//! Coverage of intervals: made-up intervals, and windows of small processes.

use asperity::compare::{CONTACTS_PER_GROUP, ComparedQuantity, Estimate, GROUPS, Support};
use asperity::contact_law::named;
use asperity::spot::{Conduction, SpotProperties};
use asperity::study::LawContact;
use asperity::topography::fitness::Check;
use asperity::topography::generate::{Process, SpectrumOf};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::{Heights, Material, WithSpots};
use asperity_validation::coverage::{
    Controls, Coverage, CoveredQuantity, EndlessProcess, ExaminedWindow, Maps, Patches, PlantedSpikes,
    QuantityEstimate, Roughness, SecondBody, StudyTask, Unusable, WindowResults, WindowTask, spiked_windows,
    windows_of,
};

const PIXEL: f64 = 1e-6;

fn estimate(contrast: f64, error: Option<f64>, independent_error: Option<f64>) -> QuantityEstimate {
    let estimate =
        Estimate { contrast, error, quantile: 2.0, bound: 0.0, independent_error, support: Support::Sampled };
    QuantityEstimate { estimate, independent_error, contacts: 100.0, area_ratio: 0.01 }
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
    let coverage = Coverage::new(&windows).unwrap();
    assert_eq!((coverage.windows, coverage.truth, coverage.scatter), (4, 2.0, 2f64.sqrt()));
    assert_eq!((coverage.claimed.intervals, coverage.claimed.covered), (3, 2));
    assert_eq!(coverage.claimed.coverage(), Some(2.0 / 3.0));
    assert_eq!(coverage.claimed.coverage_error(), Some((2.0f64 / 27.0).sqrt()));
    assert_eq!(coverage.claimed_share(), 0.75);
    let stated = coverage.error_over_scatter(&coverage.claimed).unwrap();
    assert!((stated - 1.25 / 3.0 / 2f64.sqrt()).abs() < 1e-15);
    // Errors of independent asperities: 0.01 holds at the mean only.
    assert_eq!((coverage.independent.intervals, coverage.independent.covered), (3, 2));
    assert_eq!(Coverage::new(&windows[..1]), None);
    let none = Coverage::new(&[estimate(1.0, None, None), estimate(2.0, None, None)]).unwrap();
    assert_eq!((none.claimed.coverage(), none.claimed.coverage_error()), (None, None));
    assert_eq!(none.error_over_scatter(&none.independent), None);
}

fn steel() -> LawContact {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    LawContact::bare(named("hertz").unwrap(), &steel, &steel).unwrap()
}

fn process(name: &str, points: usize, roll_off: f64, cut_off: f64) -> EndlessProcess {
    let [roll_off, cut_off] = [roll_off, cut_off].map(|pixels| pixels * PIXEL);
    let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off, cut_off };
    let spectrum = Spectrum::new(shape, Lay::default()).unwrap();
    let process = Process { spectrum, of: SpectrumOf::Gaussian, sigma: 1e-7, heights: Heights::GAUSSIAN };
    let patches = (name == "patchy").then(|| Patches::new(0.5, 20.0 * PIXEL).unwrap());
    EndlessProcess::new(name, Roughness { process, plateau: None, patches }, points, PIXEL, 5).unwrap()
}

/// Two maps of a process at loads of `contacts`, of which the first is studied.
fn examined(process: &EndlessProcess, contacts: &[f64]) -> (Controls, Vec<ExaminedWindow>) {
    let law = steel();
    let controls = process.controls(&*law.contact, contacts).unwrap();
    let thermal = Some(Conduction::new([1.0; 2]).unwrap());
    let conducting = WithSpots::new(steel().contact, SpotProperties { thermal, ..SpotProperties::default() });
    let task = WindowTask { contact: &conducting, controls: controls.clone(), small: None };
    let study = StudyTask { law: &law, loads: &controls.loads, seed: 1 };
    let windows =
        windows_of(process, (&task, &study), Maps { count: 2, studied: 1, checked: 2 }, || ()).unwrap();
    (controls, windows)
}

fn results(process: &EndlessProcess, contacts: &[f64]) -> (Controls, Vec<WindowResults>) {
    let (controls, windows) = examined(process, contacts);
    (controls, windows.into_iter().map(|window| window.results).collect())
}

#[test]
fn windows_of_short_waves_have_intervals_where_contacts_are_many() {
    let short = process("short", 256, 10.0, 3.0);
    let (controls, windows) = results(&short, &[20.0, 200.0]);
    assert_eq!(windows.len(), 8);
    assert!(controls.loads[0] < controls.loads[1] && controls.separations[0] > controls.separations[1]);
    let least = CONTACTS_PER_GROUP * GROUPS as f64;
    for (index, window) in windows.iter().enumerate() {
        assert!(window.correlation > 0.005 && window.correlation < 0.03, "{}", window.correlation);
        for (load, claims) in [false, true].into_iter().enumerate() {
            for (quantity, estimate) in CoveredQuantity::ALL.iter().zip(&window.estimates[load]) {
                let estimate = estimate.unwrap();
                assert_eq!(estimate.contacts >= least, claims, "{}: {}", quantity.name(), estimate.contacts);
                assert_eq!(estimate.estimate.interval().is_some(), claims, "{}", quantity.name());
                // Asperities are taken as independent in one window of each map.
                assert_eq!(estimate.independent_error.is_some(), claims && index % 4 == 0);
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
    let of = |shifts: usize| {
        let second = SecondBody { process: process("other", 256, 10.0, 3.0), shifts };
        results(&process("short", 256, 10.0, 3.0).against(second), &[200.0]).1
    };
    let [one, four] = [of(1), of(4)];
    let error = |window: &WindowResults| window.estimates[0][1].unwrap().estimate.error;
    let pairs = one.iter().zip(&four).filter_map(|(one, four)| Some((error(one)?, error(four)?)));
    let pairs: Vec<(f64, f64)> = pairs.collect();
    assert!(pairs.len() > 4, "{pairs:?}");
    let mean = |of: fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / pairs.len() as f64;
    assert!(mean(|pair| pair.1) < 0.9 * mean(|pair| pair.0), "{pairs:?}");
    // The floor of the part that positions share.
    assert!(pairs.iter().all(|(one, four)| *four >= 0.5 * one), "{pairs:?}");
}

#[test]
fn long_waves_have_no_interval() {
    let (_, windows) = results(&process("long", 256, 100.0, 3.0), &[200.0]);
    for estimate in windows.iter().flat_map(|window| &window.estimates).flatten() {
        assert_eq!(estimate.unwrap().estimate.error, None);
    }
    // Random groups of asperities would give one.
    let is_some = |estimate: &Option<QuantityEstimate>| estimate.unwrap().independent_error.is_some();
    assert!(windows.iter().step_by(4).flat_map(|window| &window.estimates[0]).any(is_some));
}

#[test]
fn windows_without_contacts_or_summits_are_refused() {
    let contact = steel().contact;
    let too_many = process("short", 128, 10.0, 3.0).controls(&*contact, &[50.0, 1e5]).unwrap_err();
    assert!(matches!(too_many, Unusable::FewContacts { wanted: 1e5, .. }), "{too_many}");
    let few = process("smooth", 64, 60.0, 60.0).controls(&*contact, &[50.0]).unwrap_err();
    assert!(matches!(few, Unusable::FewSummits(_)), "{few}");
    assert!(few.to_string().starts_with("a window has "), "{few}");
}

#[test]
fn patchy_windows_have_no_interval() {
    let (_, windows) = results(&process("patchy", 256, 10.0, 3.0), &[200.0]);
    assert!(windows.iter().all(|window| window.is_patchy));
    for estimate in windows.iter().flat_map(|window| &window.estimates).flatten() {
        assert_eq!(estimate.unwrap().estimate.error, None);
    }
}

/// The first map is studied: there the verdicts are those of the windows, with what they depend on.
#[test]
fn verdicts_of_studied_windows_are_those_of_the_windows() {
    let (_, windows) = examined(&process("short", 256, 10.0, 3.0), &[100.0, 200.0]);
    let mut decided = 0;
    for (index, window) in windows.iter().enumerate() {
        assert_eq!(window.studied.is_some(), index < 4);
        assert_eq!(window.findings.len() > 2, index < 4, "all checks, or spikes and lines");
        assert!(window.findings.iter().all(|finding| !finding.is_blocking()), "{:?}", window.findings);
        let Some(studied) = &window.studied else { continue };
        // Other treatments are studied without conductance.
        let mut own = window.results.verdicts();
        own.retain(|verdict| verdict.quantity != ComparedQuantity::ThermalConductance);
        assert_eq!(studied.len(), own.len());
        for (studied, own) in studied.iter().zip(&own) {
            assert_eq!(
                (studied.load, studied.quantity, studied.verdict),
                (own.load, own.quantity, own.verdict)
            );
            assert!((studied.contrast - own.contrast).abs() < 1e-6);
            decided += 1;
        }
    }
    assert!(decided > 0);
}

#[test]
fn high_spikes_are_found_and_low_ones_are_suspected() {
    let process = process("spiked", 256, 12.0, 4.0);
    let law = steel();
    let controls = process.controls(&*law.contact, &[150.0]).unwrap();
    let study = StudyTask { law: &law, loads: &controls.loads, seed: 1 };
    let planted = [4.0, 12.0].map(|deviations| PlantedSpikes { count: 20, deviations });
    let windows = spiked_windows(&process, &study, 1, &planted, || ()).unwrap();
    for studies in &windows {
        let found = |k: usize| {
            let mut spikes = studies[k].findings.iter().filter(|one| one.check == Check::Spikes);
            spikes.next().is_some_and(|one| !one.has_passed())
        };
        assert_eq!([found(0), found(1), found(2)], [false, false, true]);
        assert!(!studies[0].verdicts.is_empty() && studies[2].verdicts.is_empty());
    }
}
