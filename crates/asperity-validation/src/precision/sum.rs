//! Cost and error of summing asperities, by method.
//!
//! All methods add area and load of every asperity above the flat, evaluated one by one. Only the
//! deterministic model runs as in production, with all its other results.

use std::hint::black_box;
use std::ops::Range;

use rayon::ThreadPoolBuilder;

use super::Cost;
use super::timing::{Candidate, medians};
use crate::stability::wide::{Wide, relative_error};
use asperity::numeric::{Sum, in_chunks};
use asperity::{
    Asperities, AsperitySet, Deterministic, Draw, MicroContact, Model, Ordered, Population, ReferencePlane,
    Response, SetError, Shape,
};

/// Separations are spread evenly from the first to the last of these, d/sigma.
pub const SEPARATIONS: [f64; 2] = [4.0, 0.0];

/// So many separations where the number of asperities or threads is varied.
pub const POINTS: usize = 10;

/// So many asperities where the number of separations is varied.
pub const ASPERITIES: usize = 30_000;

/// How terms are added.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Adding {
    /// One after the other, on one thread.
    Naive,
    /// In fixed chunks of 4,096, which are then added one after the other.
    Chunks,
    /// The same with the rounding error of every addition kept.
    Compensated,
    /// As the deterministic model does: compensated, in the registers of the machine, on all threads, with everything else
    /// that it answers.
    Model,
}

/// A summation method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Way {
    /// How terms are added.
    pub adding: Adding,
    /// Whether the asperities are ordered by height first, as part of the work, so that those below the flat are
    /// never touched.
    pub ordered: bool,
}

impl Way {
    /// All of them.
    pub const ALL: [Self; 8] = {
        const fn way(adding: Adding, ordered: bool) -> Way {
            Way { adding, ordered }
        }
        [
            way(Adding::Naive, false),
            way(Adding::Chunks, false),
            way(Adding::Compensated, false),
            way(Adding::Naive, true),
            way(Adding::Chunks, true),
            way(Adding::Compensated, true),
            way(Adding::Model, false),
            Self::SHIPPED,
        ]
    };

    /// The method of the deterministic model.
    pub const SHIPPED: Self = Self { adding: Adding::Model, ordered: true };

    /// As tables name it.
    pub const fn name(self) -> &'static str {
        match (self.adding, self.ordered) {
            (Adding::Naive, false) => "naive",
            (Adding::Naive, true) => "naive, ordered",
            (Adding::Chunks, false) => "chunks",
            (Adding::Chunks, true) => "chunks, ordered",
            (Adding::Compensated, false) => "compensated",
            (Adding::Compensated, true) => "compensated, ordered",
            (Adding::Model, false) => "vectorised",
            (Adding::Model, true) => "shipped",
        }
    }

    /// Area (m^2) and load (N) at each separation, sigma, from the mean height 0.
    fn answer(self, problem: &Problem, separations: &[f64]) -> Vec<[f64; 2]> {
        let Problem { contact, set, plane } = problem;
        if self.adding == Adding::Model {
            let model = Deterministic::new(*contact, set.spheres(), *plane);
            let area = set.nominal_area();
            let values =
                |response: Response| [response.area_ratio.total() * area, response.pressure.total() * area];
            return if self.ordered {
                model.respond_all(separations).into_iter().map(values).collect()
            } else {
                separations.iter().map(|&h| values(model.respond(h))).collect()
            };
        }
        if self.ordered {
            let asperities = Ordered::new(set.spheres());
            return separations
                .iter()
                .map(|h| self.add_up(problem, *h, Some(asperities.above(h * plane.sigma))))
                .collect();
        }
        separations.iter().map(|h| self.add_up(problem, *h, None)).collect()
    }

    /// Adds those of `touching`, or of the whole set.
    fn add_up(self, problem: &Problem, h: f64, touching: Option<Asperities>) -> [f64; 2] {
        let set = (problem.set.heights(), problem.set.radii());
        let (heights, radii) = touching.map_or(set, |touching| (touching.heights(), touching.radii()));
        let separation = h * problem.plane.sigma;
        let plain = |range: Range<usize>| {
            let mut sums = [0.0; 2];
            problem.each(&heights[range.clone()], &radii[range], separation, |terms| {
                sums = [sums[0] + terms[0], sums[1] + terms[1]];
            });
            sums
        };
        let compensated = |range: Range<usize>| {
            let mut sums = [Sum::default(); 2];
            problem.each(&heights[range.clone()], &radii[range], separation, |terms| {
                sums[0] += terms[0];
                sums[1] += terms[1];
            });
            sums
        };
        match self.adding {
            Adding::Naive => plain(0..heights.len()),
            Adding::Chunks => in_chunks(heights.len(), plain, |sums: &mut [f64; 2], part| {
                *sums = [sums[0] + part[0], sums[1] + part[1]];
            }),
            Adding::Compensated | Adding::Model => {
                let join = |sums: &mut [Sum; 2], part: &[Sum; 2]| {
                    sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += *part);
                };
                in_chunks(heights.len(), compensated, join).map(|sum| sum.value())
            }
        }
    }
}

/// A random set and the contact that its asperities make.
struct Problem<'a> {
    contact: &'a dyn MicroContact,
    set: AsperitySet,
    plane: ReferencePlane,
}

impl<'a> Problem<'a> {
    fn new(
        contact: &'a dyn MicroContact,
        population: &Population,
        count: usize,
        seed: [u8; 32],
    ) -> Result<Self, SetError> {
        let set = population.set(count, Draw::Random(seed))?;
        Ok(Self { contact, set, plane: ReferencePlane { mean: 0.0, sigma: population.sigma } })
    }

    /// Hands over area and load of each asperity above the flat at `separation` (m).
    #[inline]
    fn each(&self, heights: &[f64], radii: &[f64], separation: f64, mut add: impl FnMut([f64; 2])) {
        for (z, b) in heights.iter().zip(radii) {
            if *z > separation {
                let contact = self.contact.contact(z - separation, Shape::sphere(*b));
                add([contact.area, contact.load]);
            }
        }
    }

    /// Area and load at one separation: the sum of the same terms in about 32 digits.
    fn exact(&self, h: f64) -> [Wide; 2] {
        /// Zero for a chunk to begin with.
        #[derive(Clone, Copy)]
        struct Exact([Wide; 2]);
        impl Default for Exact {
            fn default() -> Self {
                Self([Wide::ZERO; 2])
            }
        }
        let part = |range: Range<usize>| {
            let mut sums = [Wide::ZERO; 2];
            let (heights, radii) = (&self.set.heights()[range.clone()], &self.set.radii()[range]);
            self.each(heights, radii, h * self.plane.sigma, |[area, load]| {
                sums = [sums[0] + area, sums[1] + load];
            });
            Exact(sums)
        };
        let join = |sums: &mut Exact, part: &Exact| {
            sums.0 = [sums.0[0] + part.0[0], sums.0[1] + part.0[1]];
        };
        in_chunks(self.set.count(), part, join).0
    }
}

/// Cost of one method on one set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SumPoint {
    /// What is varied.
    pub sweep: Sweep,
    /// The method.
    pub way: Way,
    /// Asperities in the set.
    pub asperities: usize,
    /// Separations evaluated together.
    pub separations: usize,
    /// Threads.
    pub threads: usize,
    /// The largest relative error of the area over the separations, or over some of many.
    pub area_error: f64,
    /// The same of the load.
    pub load_error: f64,
    /// Both, ordering included.
    pub cost: Cost,
}

/// What a series of sums varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sweep {
    /// The number of asperities, on one thread.
    Asperities,
    /// The number of separations, on one thread.
    Separations,
    /// The number of threads.
    Threads,
}

impl Sweep {
    /// As tables name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Asperities => "asperities",
            Self::Separations => "separations",
            Self::Threads => "threads",
        }
    }
}

/// Settings of the sum benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct SumTask {
    /// Sizes of the sets, ascending.
    pub counts: Vec<usize>,
    /// Numbers of separations; of a set of [`ASPERITIES`].
    pub separations: Vec<usize>,
    /// Numbers of threads; they share the largest set of at most `most_for_threads` asperities.
    pub threads: Vec<usize>,
    /// See `threads`.
    pub most_for_threads: usize,
}

/// Why sums were not made.
#[derive(Debug, thiserror::Error)]
pub enum SumError {
    /// A population that makes no set.
    #[error(transparent)]
    Set(#[from] SetError),
    /// A system without threads.
    #[error("the system gives no threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

/// `count` separations, d/sigma, over the range; one alone is its middle.
pub(super) fn spread(count: usize) -> Vec<f64> {
    let [from, to] = SEPARATIONS;
    match count {
        1 => vec![0.5 * (from + to)],
        _ => (0..count).map(|k| from + (to - from) * k as f64 / (count - 1) as f64).collect(),
    }
}

/// Runs every method on random sets of a population; `seed(count)` seeds a set, `done` is called after each.
///
/// # Errors
/// See [`SumError`].
pub fn ways_on(
    contact: &dyn MicroContact,
    population: &Population,
    task: &SumTask,
    seed: impl Fn(usize) -> [u8; 32],
    done: impl Fn(usize),
) -> Result<Vec<SumPoint>, SumError> {
    let alone = ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut points = Vec::new();
    let keeps_digits = |way: &Way| matches!(way.adding, Adding::Compensated | Adding::Model);
    let ways: Vec<Way> = Way::ALL.into_iter().filter(keeps_digits).collect();
    let problem = Problem::new(contact, population, ASPERITIES, seed(ASPERITIES))?;
    for &separations in &task.separations {
        points.extend(alone.install(|| run(&problem, Sweep::Separations, &ways, separations)));
    }
    let shared = task.counts.iter().copied().filter(|&count| count <= task.most_for_threads).max();
    for &count in &task.counts {
        let problem = Problem::new(contact, population, count, seed(count))?;
        points.extend(alone.install(|| run(&problem, Sweep::Asperities, &Way::ALL, POINTS)));
        if shared == Some(count) {
            for &threads in &task.threads {
                let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
                points.extend(pool.install(|| run(&problem, Sweep::Threads, &ways, POINTS)));
            }
        }
        done(count);
    }
    Ok(points)
}

/// Runs methods at this many separations, on the threads of the pool that it runs in.
fn run(problem: &Problem, sweep: Sweep, ways: &[Way], separations: usize) -> Vec<SumPoint> {
    let separations = spread(separations);
    // Of many separations, some are checked.
    let step = separations.len().div_ceil(POINTS);
    let exact: Vec<[Wide; 2]> = separations.iter().step_by(step).map(|&h| problem.exact(h)).collect();
    let mut answers = vec![Vec::new(); ways.len()];
    let mut candidates: Vec<Candidate> = ways
        .iter()
        .zip(&mut answers)
        .map(|(way, answer)| -> Candidate {
            Box::new(|| *answer = way.answer(problem, black_box(&separations)))
        })
        .collect();
    let seconds = medians(&mut candidates);
    drop(candidates);
    let points = ways.iter().zip(answers).zip(seconds).map(|((way, answer), seconds)| {
        let [area_error, load_error] = [0, 1].map(|which| {
            let pairs =
                answer.iter().step_by(step).zip(&exact).filter(|(_, exact)| exact[which] > Wide::ZERO);
            pairs.map(|(found, exact)| relative_error(found[which], exact[which])).fold(0.0, f64::max)
        });
        SumPoint {
            sweep,
            way: *way,
            asperities: problem.set.count(),
            separations: separations.len(),
            threads: rayon::current_num_threads(),
            area_error,
            load_error,
            cost: Cost { seconds: seconds / separations.len() as f64, error: area_error.max(load_error) },
        }
    });
    points.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::{Heights, Interface, Material, Zmc};

    #[test]
    fn what_loses_digits_and_what_does_not() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let contact = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
        let case = Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN };
        let task = SumTask {
            counts: vec![1000, 30_000],
            separations: vec![1, 4],
            threads: vec![2],
            most_for_threads: 5000,
        };
        let points = ways_on(&contact, &case, &task, |_| [5; 32], |_| ()).unwrap();
        assert_eq!(points.len(), 2 * 8 + 2 * 4 + 4);
        let at =
            |sweep, way: Way| points.iter().rfind(|point| point.sweep == sweep && point.way == way).unwrap();
        for ordered in [false, true] {
            let error = |adding| at(Sweep::Asperities, Way { adding, ordered }).cost.error;
            assert!(error(Adding::Compensated) < 3e-16);
            assert!(error(Adding::Naive) > 3.0 * error(Adding::Compensated));
            assert!(error(Adding::Naive) < 1e-12);
        }
        assert!(at(Sweep::Asperities, Way::SHIPPED).cost.error < 1e-14);
        assert_eq!(at(Sweep::Threads, Way::SHIPPED).threads, 2);
        assert_eq!(at(Sweep::Threads, Way::SHIPPED).asperities, 1000);
        assert_eq!(at(Sweep::Separations, Way::SHIPPED).separations, 4);
        assert!(points.iter().all(|point| point.cost.seconds > 0.0));
    }
}
