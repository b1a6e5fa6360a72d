//! Seconds, as medians of runs made in alternation.

use std::hint::black_box;
use std::time::Instant;

use asperity::numeric::median;

pub type Candidate<'a, T> = Box<dyn Fn() -> T + 'a>;

/// Shortest duration of a measurement, s, which makes the overhead of clock and loop negligible.
const SHORTEST: f64 = 1e-3;

/// What takes longer is run fewer times, and what takes longer still once, s.
const LONG: [f64; 2] = [2e-2, 2.0];

/// Runs of each candidate, of those that take long, and of those that take longer still.
const RUNS: [usize; 3] = [5, 3, 1];

/// What each candidate gives, and the median time of a call of it, s. All are run in turn, again and again, so that what disturbs the
/// machine for a while disturbs all alike.
pub fn medians<T>(candidates: &[Candidate<T>]) -> Vec<(T, f64)> {
    let mut times = vec![Vec::new(); candidates.len()];
    // The first call of a short one fetches code and data; the second determines the number of calls per measurement.
    let (mut results, mut calls) = (Vec::new(), Vec::new());
    for (candidate, times) in candidates.iter().zip(&mut times) {
        let start = Instant::now();
        results.push(candidate());
        let first = start.elapsed().as_secs_f64();
        if first > LONG[0] {
            times.push(first);
            calls.push((1, RUNS[1 + usize::from(first > LONG[1])] - 1));
        } else {
            let once = seconds(candidate, 1);
            calls.push(((SHORTEST / once.max(1e-9)).ceil().max(1.0) as usize, RUNS[0]));
        }
    }
    for run in 0..RUNS[0] {
        for ((candidate, &(calls, runs)), times) in candidates.iter().zip(&calls).zip(&mut times) {
            if run < runs {
                times.push(seconds(candidate, calls));
            }
        }
    }
    let medians = times.iter_mut().map(|times| median(times).unwrap_or(f64::NAN));
    results.into_iter().zip(medians).collect()
}

fn seconds<T>(candidate: &Candidate<T>, calls: usize) -> f64 {
    let start = Instant::now();
    for _ in 0..calls {
        black_box(candidate());
    }
    start.elapsed().as_secs_f64() / calls as f64
}
