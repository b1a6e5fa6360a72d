//! How long one micro-contact, one integral and one sum take. Compare them with each other in one
//! run: this is a ratio, not a promise.

use std::hint::black_box;
use std::time::Instant;

use asperity::asperity::{Draw, HeightDensity, Ordered, Population};
use asperity::coating::{Coating, Rule};
use asperity::interface::{Interface, Layered, MicroContact};
use asperity::law::{Hertz, Law, Shape, Zmc};
use asperity::material::Material;
use asperity::model::{Datum, Deterministic, Model, Statistical, at_pressure};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

const CASES: [(&str, Population); 2] = [
    ("case 1", Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: HeightDensity::Gaussian }),
    ("case 2", Population { radius: 1.6e-6, sigma: 2.6e-7, density: 9e10, heights: HeightDensity::Gaussian }),
];

fn interface<L: Law>(law: L) -> Interface<L> {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).expect("steel is a material");
    Interface::bare(law, &steel, &steel).expect("every law knows steel")
}

fn laws() -> [(&'static str, Box<dyn MicroContact>); 2] {
    [("hertz", Box::new(interface(Hertz))), ("zmc", Box::new(interface(Zmc::default())))]
}

/// ZMC on steel, bare and under lead and a hard ceramic: the coated over the bare is the price of a layer.
fn flats() -> [(String, Box<dyn MicroContact>); 7] {
    let material =
        |young, poisson, hardness| Material::new(young, poisson, Some(hardness), None).expect("a material");
    let steel = material(210e9, 0.3, 7.6e9);
    let under = |layer: &Material, thickness: f64| -> Box<dyn MicroContact> {
        let coating = Coating::new(layer, &steel, thickness, Rule::Gao).expect("a coating");
        Box::new(Layered::new(Zmc::default(), &steel, &steel, coating).expect("a contact"))
    };
    let (lead, ceramic) = (material(18e9, 0.35, 0.17e9), material(400e9, 0.2, 21e9));
    [
        ("bare".to_owned(), Box::new(interface(Zmc::default()))),
        ("10 nm of lead".to_owned(), under(&lead, 1e-8)),
        ("50 nm of lead".to_owned(), under(&lead, 5e-8)),
        ("1 um of lead".to_owned(), under(&lead, 1e-6)),
        ("10 nm of ceramic".to_owned(), under(&ceramic, 1e-8)),
        ("50 nm of ceramic".to_owned(), under(&ceramic, 5e-8)),
        ("1 um of ceramic".to_owned(), under(&ceramic, 1e-6)),
    ]
}

/// The integral at one separation under a layer, and finding its breakpoints, which a model does once.
fn coated(c: &mut Criterion) {
    let mut group = c.benchmark_group("coated");
    for (case, population) in CASES {
        for (flat, contact) in flats() {
            let model = Statistical::new(&*contact, population);
            for h in [0.0, 2.0] {
                group.bench_function(BenchmarkId::new(format!("integral at {h}, {case}"), &flat), |b| {
                    b.iter(|| model.respond(black_box(h)));
                });
            }
            group.bench_function(BenchmarkId::new(format!("breakpoints, {case}"), &flat), |b| {
                b.iter(|| contact.breakpoints(black_box(Shape::sphere(population.radius))));
            });
        }
    }
    group.finish();
}

/// The price of a layer: the sum over a million asperities at 50 separations under it over the bare sum, medians of runs
/// that alternate. The same asperities touch, so that this is the ratio per contacting asperity.
fn price(_: &mut Criterion) {
    const ROUNDS: usize = 15;
    // Criterion's filters do not reach what is not its own.
    if std::env::args().skip(1).any(|word| !word.starts_with('-') && word != "price") {
        return;
    }
    let separations: Vec<f64> = (0..50).map(|k| 4.0 - 4.0 * f64::from(k) / 49.0).collect();
    for (case, population) in CASES {
        let set = population.set(1_000_000, Draw::Random([1; 32])).expect("a million asperities");
        let ordered = Ordered::new(&set);
        let flats = flats();
        let mut times = vec![Vec::new(); flats.len()];
        for _ in 0..ROUNDS {
            for ((_, contact), times) in flats.iter().zip(&mut times) {
                let model =
                    Deterministic::new(&**contact, &ordered, Datum { mean: 0.0, sigma: population.sigma });
                let start = Instant::now();
                black_box(separations.iter().map(|&h| model.respond(h).pressure.total()).sum::<f64>());
                times.push(start.elapsed().as_secs_f64());
            }
        }
        let medians: Vec<f64> = times
            .into_iter()
            .map(|mut times| {
                times.sort_unstable_by(f64::total_cmp);
                times[ROUNDS / 2]
            })
            .collect();
        for ((flat, _), median) in flats.iter().zip(&medians) {
            println!("price/{case}/{flat}: {:.1} ms, {:.2} times bare", 1e3 * median, median / medians[0]);
        }
    }
}

/// 1000 indentations from far below yield to full plasticity.
fn law(c: &mut Criterion) {
    let mut group = c.benchmark_group("law");
    let indentations: Vec<f64> = (0..1000).map(|k| 1e-10 * 1.01f64.powi(k)).collect();
    group.throughput(Throughput::Elements(indentations.len() as u64));
    for (name, contact) in laws() {
        group.bench_function(name, |b| {
            b.iter(|| {
                indentations
                    .iter()
                    .map(|&w| contact.contact(black_box(w), Shape::sphere(2e-5)).load)
                    .sum::<f64>()
            });
        });
    }
    group.finish();
}

/// Area, load, regimes and stiffness at one separation.
fn integral(c: &mut Criterion) {
    let mut group = c.benchmark_group("integral");
    for (law, contact) in laws() {
        for (case, population) in CASES {
            let model = Statistical::new(&*contact, population);
            group.bench_function(BenchmarkId::new(law, case), |b| b.iter(|| model.respond(black_box(2.0))));
        }
    }
    let zmc = interface(Zmc::default());
    let model = Statistical::new(&zmc, CASES[0].1);
    group.bench_function("load control", |b| b.iter(|| at_pressure(&model, black_box(1e6))));
    group.finish();
}

/// A million asperities at 50 separations from 4 to 0 sigma, and their ordering.
fn sum(c: &mut Criterion) {
    let mut group = c.benchmark_group("sum");
    group.sample_size(10);
    let separations: Vec<f64> = (0..50).map(|k| 4.0 - 4.0 * f64::from(k) / 49.0).collect();
    for (case, population) in CASES {
        let set = population.set(1_000_000, Draw::Random([1; 32])).expect("a million asperities");
        group.bench_function(BenchmarkId::new("ordering", case), |b| b.iter(|| Ordered::new(&set)));
        let ordered = Ordered::new(&set);
        for (law, contact) in laws() {
            let model = Deterministic::new(&*contact, &ordered, Datum { mean: 0.0, sigma: population.sigma });
            group.bench_function(BenchmarkId::new(law, case), |b| {
                b.iter(|| separations.iter().map(|&h| model.respond(h).pressure.total()).sum::<f64>());
            });
        }
    }
    group.finish();
}

criterion_group!(benches, law, integral, sum, coated, price);
criterion_main!(benches);
