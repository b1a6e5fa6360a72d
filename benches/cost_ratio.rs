//! Cost ratios of layers and laws: sums over a million asperities at 50 separations from 4 to 0 sigma, medians of
//! alternating runs. The same asperities are in contact, so that a ratio is also the one per contacting asperity.

use std::hint::black_box;
use std::time::Instant;

use asperity::{Asperities, Deterministic, Draw, Ellipse, Ellipses, MicroContact, Model, ReferencePlane};
use asperity_benches::{CASES, flats, laws};

const ROUNDS: usize = 15;

/// Asperities and the micro-contact to sum over them.
struct Sums<'a> {
    name: &'a str,
    contact: &'a dyn MicroContact,
    asperities: Asperities<'a>,
}

fn main() {
    for (case, population) in CASES {
        let set = population.set(1_000_000, Draw::Random([1; 32])).expect("a million asperities");
        let spheres = set.spheres();
        let under = |name, contact, asperities| Sums { name, contact, asperities };
        let flats = flats();
        let layers = flats.iter().map(|(flat, contact)| under(flat, &**contact, spheres));
        alternate(case, population.sigma, &layers.collect::<Vec<_>>());

        // Ellipses with curvature ratios from 1 to 10.
        let ellipse = |k: usize| Ellipse {
            mean_curvature: population.radius.recip(),
            curvature_ratio: 1.0 + 9.0 * (k % 1000) as f64 / 999.0,
        };
        let ellipses = (0..set.count()).map(ellipse).collect();
        let set = set.clone().with_ellipses(ellipses).expect("one ellipse per asperity");
        let start = Instant::now();
        let ellipses = Ellipses::new(&set).expect("a set of ellipses");
        println!(
            "{case}: equivalent spheres of a million ellipses {:.1} ms",
            1e3 * start.elapsed().as_secs_f64()
        );
        let [laws, elliptic] = [false, true].map(laws);
        let of_spheres = laws.iter().map(|(law, contact)| under(law, &**contact, spheres));
        let of_ellipses = elliptic.iter().map(|(law, contact)| under(law, &**contact, ellipses.asperities()));
        alternate(case, population.sigma, &of_spheres.chain(of_ellipses).collect::<Vec<_>>());
    }
}

/// Runs all in turn and prints each median and its ratio to the first.
fn alternate(case: &str, sigma: f64, all: &[Sums]) {
    let separations: Vec<f64> = (0..50).map(|k| 4.0 - 4.0 * f64::from(k) / 49.0).collect();
    let mut times = vec![Vec::new(); all.len()];
    for _ in 0..ROUNDS {
        for (sums, times) in all.iter().zip(&mut times) {
            let model =
                Deterministic::new(sums.contact, sums.asperities, ReferencePlane { mean: 0.0, sigma });
            let start = Instant::now();
            black_box(model.respond_all(&separations));
            times.push(start.elapsed().as_secs_f64());
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_unstable_by(f64::total_cmp);
        times[ROUNDS / 2]
    };
    let medians: Vec<f64> = times.iter_mut().map(median).collect();
    for (sums, time) in all.iter().zip(&medians) {
        let first = all[0].name;
        println!("{case}/{}: {:.1} ms, {:.2} times {first}", sums.name, 1e3 * time, time / medians[0]);
    }
}
