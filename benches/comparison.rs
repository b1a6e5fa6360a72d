//! The process that the scripts in `benches/comparison` time: reads one task per line from standard input and answers
//! each with its run time in seconds and its results. A script runs it and the comparison programs alternately.

use std::hint::black_box;
use std::io::{BufRead, Write};
use std::path::Path;
use std::time::Instant;

use asperity::bem::{Boundary, ElasticPair, Options, Solver};
use asperity::progress::Silent;
use asperity::topography::generate::gaussian;
use asperity::topography::read::{ReadOptions, height_map};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::topography::summits::{Detail, Neighbours, find};
use asperity::{
    AsperityList, AsperitySet, Deterministic, HeightMap, ListOptions, Material, MicroContact, Model,
    Population, ReferencePlane, Response, Statistical, Zmc, npy,
};
use asperity_fft::{Complex64, FftDirection, complex, complex_to_real, real_to_complex};
use rayon::prelude::*;

fn main() -> std::io::Result<()> {
    let mut out = std::io::stdout();
    let mut surface: Option<HeightMap> = None;
    let mut asperities: Option<(Population, AsperitySet)> = None;
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let answer = match words[..] {
            ["generate", points, spectrum, seed] => generate(points, spectrum, seed, &mut surface),
            ["summits"] => surface.as_ref().map(summits),
            ["drop"] => {
                surface = None;
                Some("0".to_owned())
            }
            ["asperities", case, path] => {
                asperities = read(case, path);
                asperities.as_ref().map(|(_, set)| set.count().to_string())
            }
            ["sums", ref separations @ ..] => {
                asperities.as_ref().and_then(|(population, set)| sums(population, set, separations))
            }
            ["integral", case, ref separations @ ..] => integral(case, separations),
            ["map", path] => {
                surface = unit_square(path);
                surface.as_ref().map(|map| map.heights().len().to_string())
            }
            ["contacts", out, error, ref loads @ ..] => {
                surface.as_ref().and_then(|map| contacts(map, out, error, loads))
            }
            ["transforms", points] => points.parse().ok().map(transforms),
            _ => None,
        };
        writeln!(out, "{}", answer.unwrap_or_else(|| format!("unknown task: {line}")))?;
        out.flush()?;
    }
    Ok(())
}

/// A self-affine surface on unit pixels, Hurst exponent 0.8: `full` has waves from an eighth of the side to two pixels,
/// `cut` from 32 to 8 pixels.
fn generate(points: &str, spectrum: &str, seed: &str, surface: &mut Option<HeightMap>) -> Option<String> {
    let n: usize = points.parse().ok()?;
    let (roll_off, cut_off) = match spectrum {
        "full" => (n as f64 / 8.0, 2.0),
        "cut" => (32.0, 8.0),
        _ => return None,
    };
    let spectrum =
        Spectrum::new(SpectrumShape::SelfAffine { hurst: 0.8, roll_off, cut_off }, Lay::default()).ok()?;
    *surface = None;
    let start = Instant::now();
    let heights = gaussian(&spectrum.on_grid([n, n], [1.0; 2]), 1.0, [seed.parse().ok()?; 32]);
    let seconds = start.elapsed().as_secs_f64();
    *surface = Some(HeightMap::new([n, n], [1.0; 2], heights, f64::EPSILON).ok()?.periodic());
    Some(format!("{seconds} {}", peak_bytes()))
}

/// Five-point summits with heights and curvatures: answers with their number and the sum of their curvatures.
fn summits(surface: &HeightMap) -> String {
    let (seconds, found) = median_of_three(|| find(surface, Neighbours::Four, Detail::default()));
    format!("{seconds} {} {}", found.heights.len(), found.curvatures.iter().sum::<f64>())
}

/// Reads a list of asperities; its nominal area follows from the density of a case of Table 1.
fn read(case: &str, path: &str) -> Option<(Population, AsperitySet)> {
    let population = population(case)?;
    let list = AsperityList::read(Path::new(path), ListOptions::default(), &Silent).ok()?;
    let area = list.count() as f64 / population.density;
    Some((population, list.set(area).ok()?))
}

/// Steel on steel: the sums at all separations (in sigma), sorting included.
fn sums(population: &Population, set: &AsperitySet, separations: &[&str]) -> Option<String> {
    let separations = numbers(separations)?;
    let contact = asperity_benches::bare(Zmc::default());
    let (seconds, responses) = median_of_three(|| curve(&*contact, set, population.sigma, &separations));
    Some(answer(seconds, &responses))
}

/// The part that is timed: sorting and the sums.
fn curve(contact: &dyn MicroContact, set: &AsperitySet, sigma: f64, separations: &[f64]) -> Vec<Response> {
    Deterministic::new(contact, set.spheres(), ReferencePlane { mean: 0.0, sigma }).respond_all(separations)
}

/// Steel on steel: the integral; its time is the mean per separation (in sigma) over many rounds, on one thread.
fn integral(case: &str, separations: &[&str]) -> Option<String> {
    /// Total number of evaluations, at least.
    const CALLS: usize = 10_000;
    let (population, separations) = (population(case)?, numbers(separations)?);
    let contact = asperity_benches::bare(Zmc::default());
    let model = Statistical::new(&*contact, population);
    let rounds = CALLS.div_ceil(separations.len().max(1));
    let start = Instant::now();
    for _ in 0..rounds {
        black_box(model.respond_all(black_box(&separations)));
    }
    let seconds = start.elapsed().as_secs_f64() / (rounds * separations.len()) as f64;
    let responses: Vec<Response> = separations.iter().map(|&h| model.respond(h)).collect();
    Some(answer(seconds, &responses))
}

/// A map in a `.npy` file, on a unit square.
fn unit_square(path: &str) -> Option<HeightMap> {
    let map = height_map(Path::new(path), ReadOptions { pixel: Some([1.0; 2]), unit: None }).ok()?;
    let points = map.points();
    HeightMap::new(points, points.map(|count| (count as f64).recip()), map.into_heights(), 0.0).ok()
}

/// Boundary elements with E* = 1 at mean pressures, periodic, the solver made anew: wall and CPU seconds, then of each load
/// the share of points in contact, steps and convolutions. The last pressures are written to `out`.
fn contacts(map: &HeightMap, out: &str, error: &str, loads: &[&str]) -> Option<String> {
    let body = Material::new(2.0, 0.0, None, None).ok()?;
    let pair = ElasticPair::new(&body, &body, None);
    let options = Options { boundary: Boundary::Periodic, error: error.parse().ok()?, cap: None };
    let (loads, start, cpu) = (numbers(loads)?, Instant::now(), cpu_seconds());
    let solver = Solver::new(map, &pair, &options).ok()?;
    let solved: Result<Vec<_>, _> = loads.iter().map(|&load| solver.at_pressure(load, &Silent)).collect();
    let (seconds, cpu) = (start.elapsed().as_secs_f64(), cpu_seconds() - cpu);
    let solved = solved.ok()?;
    let pressures = solved.last()?.pressures().iter().copied();
    npy::write(std::fs::File::create(out).ok()?, map.points(), pressures).ok()?;
    let mut words = vec![seconds, cpu];
    for contact in &solved {
        words.extend([contact.raw_area_ratio(), contact.steps as f64, contact.convolutions as f64]);
    }
    Some(words.iter().map(f64::to_string).collect::<Vec<_>>().join(" "))
}

/// The transforms of one convolution on a square of `points`, without moving a number between rows and columns: wall seconds.
fn transforms(points: usize) -> String {
    let (forward, backward) = (real_to_complex(points), complex_to_real(points));
    let columns = [FftDirection::Forward, FftDirection::Inverse].map(|way| complex(points, way));
    let run = || {
        let row =
            || (forward.make_input_vec(), forward.make_output_vec(), vec![Complex64::default(); points]);
        (0..points).into_par_iter().for_each_init(row, |(line, waves, scratch), _| {
            let _ = forward.process_with_scratch(line, waves, &mut scratch[..forward.get_scratch_len()]);
            let _ = backward.process_with_scratch(waves, line, &mut scratch[..backward.get_scratch_len()]);
        });
        let column = || (vec![Complex64::default(); points], vec![Complex64::default(); points]);
        (0..points / 2).into_par_iter().for_each_init(column, |(line, scratch), _| {
            columns.iter().for_each(|plan| {
                plan.process_with_scratch(line, &mut scratch[..plan.get_inplace_scratch_len()]);
            });
        });
    };
    run();
    median_of_three(run).0.to_string()
}

/// User and system time of this process, to 0.01 s; 0 where the system does not report it.
fn cpu_seconds() -> f64 {
    const TICKS_PER_SECOND: f64 = 100.0;
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<f64> = text
        .rsplit(')')
        .next()
        .map_or_else(Vec::new, |rest| rest.split_whitespace().filter_map(|word| word.parse().ok()).collect());
    // utime and stime, after the state, which is no number.
    fields.get(10..12).map_or(0.0, |ticks| ticks.iter().sum::<f64>() / TICKS_PER_SECOND)
}

fn population(case: &str) -> Option<Population> {
    asperity_benches::CASES.get(case.parse::<usize>().ok()?).map(|(_, population)| population.clone())
}

fn numbers(words: &[&str]) -> Option<Vec<f64>> {
    words.iter().map(|word| word.parse().ok()).collect()
}

/// The time, then of each response contact density, area ratio and pressure by regime, and the standard errors of both
/// where there are any; printed so that they read back to the same f64.
fn answer(seconds: f64, responses: &[Response]) -> String {
    let mut words = vec![seconds];
    for response in responses {
        words.push(response.contact_density);
        words.extend(response.area_ratio.0.into_iter().chain(response.pressure.0));
        words.extend(response.sampling.iter().flat_map(|error| [error.area_ratio, error.pressure]));
    }
    words.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

/// The median time of three runs in seconds, as for the comparison programs, and the result of the last: threads just
/// woken may share a processor for longer than a run takes.
fn median_of_three<T>(run: impl Fn() -> T) -> (f64, T) {
    let timed = || {
        let start = Instant::now();
        let found = run();
        (start.elapsed().as_secs_f64(), found)
    };
    let (first, second, (third, found)) = (timed().0, timed().0, timed());
    let mut seconds = [first, second, third];
    seconds.sort_by(f64::total_cmp);
    (seconds[1], found)
}

/// Peak memory of this process, bytes; 0 where the system does not report it.
fn peak_bytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) * 1024
}
