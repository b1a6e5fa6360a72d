//! Run times of contact laws, integrals and sums. They depend on the machine: compare ratios within one run.

use std::hint::black_box;

use asperity::{Deterministic, Draw, Model, ReferencePlane, Shape, Statistical, Zmc, at_pressure};
use asperity_benches::{CASES, bare, flats, laws};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

/// The integral at one separation under a layer, its breakpoints, and the model, which finds them once and evaluates contacts between them.
fn coated(c: &mut Criterion) {
    let mut group = c.benchmark_group("coated");
    for (case, population) in CASES {
        for (flat, contact) in flats() {
            let model = Statistical::new(&*contact, population.clone());
            for h in [0.0, 2.0] {
                group.bench_function(BenchmarkId::new(format!("integral at {h}, {case}"), flat), |b| {
                    b.iter(|| model.respond(black_box(h)));
                });
            }
            group.bench_function(BenchmarkId::new(format!("model, {case}"), flat), |b| {
                b.iter(|| Statistical::new(black_box(&*contact), population.clone()));
            });
            group.bench_function(BenchmarkId::new(format!("breakpoints, {case}"), flat), |b| {
                b.iter(|| contact.breakpoints(black_box(Shape::sphere(population.radius))));
            });
        }
    }
    group.finish();
}

/// 1000 indentations from far below yield to full plasticity.
fn law(c: &mut Criterion) {
    let mut group = c.benchmark_group("law");
    let indentations: Vec<f64> = (0..1000).map(|k| 1e-10 * 1.01f64.powi(k)).collect();
    group.throughput(Throughput::Elements(indentations.len() as u64));
    for (name, contact) in laws(false) {
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
    for (law, contact) in laws(false) {
        for (case, population) in CASES {
            let model = Statistical::new(&*contact, population.clone());
            group.bench_function(BenchmarkId::new(&law, case), |b| b.iter(|| model.respond(black_box(2.0))));
        }
    }
    let zmc = bare(Zmc::default());
    let model = Statistical::new(&*zmc, CASES[0].1.clone());
    group.bench_function("load control", |b| b.iter(|| at_pressure(&model, black_box(1e6))));
    group.finish();
}

/// A million asperities at 50 separations from 4 to 0 sigma, sorting included.
fn sum(c: &mut Criterion) {
    let mut group = c.benchmark_group("sum");
    group.sample_size(10);
    let separations: Vec<f64> = (0..50).map(|k| 4.0 - 4.0 * f64::from(k) / 49.0).collect();
    for (case, population) in CASES {
        let set = population.set(1_000_000, Draw::Random([1; 32])).expect("a million asperities");
        for (law, contact) in laws(false) {
            let model = Deterministic::new(
                &*contact,
                set.spheres(),
                ReferencePlane { mean: 0.0, sigma: population.sigma },
            );
            group.bench_function(BenchmarkId::new(&law, case), |b| {
                b.iter(|| model.respond_all(&separations));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, law, integral, sum, coated);
criterion_main!(benches);
