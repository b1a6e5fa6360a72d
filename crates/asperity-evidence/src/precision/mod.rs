//! Run time against error: what an integral, a sum and a contact by boundary elements cost, and how exact they are for it.
//!
//! Times are medians of runs made in alternation. Errors of integrals and sums are against evaluations in about 32 digits that share
//! neither the rule nor the code with what they check ([`exact`](crate::exact), and the exact sums of [`sum`]).

pub mod integral;
pub mod sum;
mod timing;

use crate::exact::{Bodies, CoveredLaw};
use crate::solver::{BenchmarkQuantity, hertz};
use crate::wide::{Wide, relative_error};
use crate::{Drawing, Evidence, Failed, Form, Program, Task};
use asperity::{Heights, Material, Population, literature, named_enum};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::format::{count, number, one_digit, quantity};
use asperity_contact_framework::report::table::{Column, Row, Schema, Table};
use asperity_plot::{Axis, Colour, Figure, Layer, Marker, Plot};
use indexmap::IndexSet;
use integral::integrals;
use rayon::ThreadPoolBuilder;
use sum::sums;
use timing::{Candidate, medians};

/// Two populations of Table 1 of Pasaribu and Schipper (2005): in case 1 most contacts are elastic, in case 2 almost all have yielded.
const CASES: [(&str, Population); 2] = [
    ("case-1", Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN }),
    ("case-2", Population { radius: 1.6e-6, sigma: 2.6e-7, density: 9e10, heights: Heights::GAUSSIAN }),
];

/// Young's modulus (Pa), Poisson's ratio and hardness (Pa) of both bodies (section 4.1), under ZMC.
const STEEL: (f64, f64, f64) = (210e9, 0.3, 7.6e9);

/// d/sigma of the integrals.
const SEPARATIONS: [f64; 6] = [-1.0, 0.0, 1.0, 2.0, 3.0, 4.0];

/// Sizes of the sets that are summed; the largest take minutes and some 6 GB of memory.
const COUNTS: [usize; 6] = [1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];
const SHORT_COUNTS: usize = 4;

/// Pixels per contact radius of boundary elements.
const PIXELS: [usize; 6] = [4, 8, 16, 32, 64, 128];

/// What the library does, as against the methods that it is compared with.
const SHIPPED: &str = "shipped";

pub const PRECISION: Program = Program {
    name: "precision",
    forms: [
        Form::new("quadrature rules, sums of up to 1e6 asperities, boundary elements", 2e8, 4e7),
        Form::new("quadrature rules, sums of up to 1e8 asperities, boundary elements", 5.7e9, 2.3e9),
    ],
    tables: || vec![Schema::of::<&Point>()],
    run,
};

named_enum! {
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Problem {
        Integral = "integral",
        Sum = "sum",
        BoundaryElements = "boundary elements",
    }
}

/// A method with one effort.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    pub problem: Problem,
    pub case: &'static str,
    pub method: &'static str,
    /// What time grows with: nodes, asperities or pixels; or the tolerance. `None` of the shipped integral, which is fixed.
    pub effort: Option<f64>,
    /// Contacts that an integral evaluates, in the mean of the separations; `None` where the rule does not report it.
    pub evaluations: Option<f64>,
    pub cost: Cost,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Seconds per separation, or per contact.
    pub seconds: f64,
    /// The largest relative error of the area over the separations.
    pub area_error: f64,
    pub load_error: f64,
}

impl Cost {
    /// Of area and load at several separations, which take `seconds` in all.
    fn new(seconds: f64, values: &[[f64; 2]], exact: &[[Wide; 2]]) -> Self {
        let [area_error, load_error] = [0, 1].map(|which| {
            let pairs = values.iter().zip(exact).filter(|(_, exact)| exact[which] > Wide::ZERO);
            pairs.map(|(value, exact)| relative_error(value[which], exact[which])).fold(0.0, f64::max)
        });
        Self { seconds: seconds / values.len() as f64, area_error, load_error }
    }

    pub fn error(&self) -> f64 {
        self.area_error.max(self.load_error)
    }
}

/// Hertz's contact by boundary elements, map and kernel included: the area counted and corrected, and the load at the computed
/// indentation over Hertz's load there.
pub fn contacts(pixels: &[usize]) -> Result<Vec<Point>, Failed> {
    let candidate = |&pixels: &usize| -> Candidate<_> { Box::new(move || hertz(pixels)) };
    let measured = medians(&pixels.iter().map(candidate).collect::<Vec<_>>());
    let mut points = Vec::new();
    for (&pixels, (benchmarks, seconds)) in pixels.iter().zip(measured) {
        let benchmarks = benchmarks?;
        let error = |quantity: BenchmarkQuantity| {
            let benchmark = benchmarks.iter().find(|benchmark| benchmark.quantity == quantity);
            benchmark.map_or(f64::NAN, |benchmark| benchmark.error)
        };
        // The load is given; Hertz's grows with the indentation to the power 3/2.
        let load_error = ((1.0 + error(BenchmarkQuantity::Indentation)).powf(-1.5) - 1.0).abs();
        let areas = [("area counted", BenchmarkQuantity::RawArea), (SHIPPED, BenchmarkQuantity::Area)];
        points.extend(areas.map(|(method, area)| Point {
            problem: Problem::BoundaryElements,
            case: "hertz",
            method,
            effort: Some(pixels as f64),
            evaluations: None,
            cost: Cost { seconds, area_error: error(area).abs(), load_error },
        }));
    }
    Ok(points)
}

fn run(task: &Task) -> Result<Evidence, Failed> {
    let counts = if task.is_full { &COUNTS[..] } else { &COUNTS[..SHORT_COUNTS] };
    let steps = CASES.len() * (1 + counts.len()) + 1;
    task.progress.stage("errors and times", steps as f64);
    let step = || task.progress.advance(1.0);
    let (young, poisson, hardness) = STEEL;
    let steel = Material::new(young, poisson, Some(hardness), None)?;
    let bodies = Bodies { law: CoveredLaw::zmc(), rough: steel, flat: steel, layer: None };
    let contact = bodies.contact()?;
    let single = ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut points = Vec::new();
    for (case, population) in &CASES {
        points.extend(integrals(&bodies, case, population, &SEPARATIONS)?);
        step();
    }
    for (case, population) in &CASES {
        for &count in counts {
            let seed = task.stream_seed(&format!("sum {case} {count}"));
            points.extend(single.install(|| sums(&*contact, case, population, count, seed))?);
            step();
        }
    }
    points.extend(contacts(&PIXELS)?);
    step();
    let mut papers = contact.papers();
    papers.extend(bodies.law.chosen().papers());
    papers.extend([literature::PASARIBU_SCHIPPER_2005, literature::ZHAO_MAIETTA_CHANG_2000]);
    Ok(Evidence {
        claim: claim(&points),
        warnings: contact.caveat().into_iter().collect(),
        drawings: vec![drawing(&points)],
        tables: vec![Table::new(&points)],
        set_up: vec![format!(
            "Steel on steel under ZMC: cases 1 and 2 of Table 1 of Pasaribu and Schipper (2005). Boundary elements run on {} threads. \
             Method: [theory](../../docs/theory.md#run-time-against-error).",
            rayon::current_num_threads()
        )],
        papers,
        ..Evidence::default()
    })
}

/// Methods are compared within this error.
const LEVEL: f64 = 1e-12;

/// What the shipped rule and the shipped sum take, how exact they are, and how many times as long others take that are as exact.
fn claim(points: &[Point]) -> String {
    // Over the cases, the shipped method's longest time and largest error, and the smallest ratio of another one's time.
    let compared = |problem: Problem, effort: Option<f64>| {
        let is_of =
            move |point: &&Point| point.problem == problem && (effort.is_none() || point.effort == effort);
        let (mut time, mut error, mut ratio) = (0f64, 0f64, f64::INFINITY);
        for Point { case, cost, .. } in points.iter().filter(is_of).filter(|point| point.method == SHIPPED) {
            let others = points.iter().filter(is_of).filter(|other| other.case == *case);
            let others = others.filter(|other| other.method != SHIPPED && other.cost.error() <= LEVEL);
            time = time.max(cost.seconds);
            error = error.max(cost.error());
            ratio = others.map(|other| other.cost.seconds / cost.seconds).fold(ratio, f64::min);
        }
        // Two significant digits.
        let ratio = number(format!("{ratio:.1e}").parse().unwrap_or(ratio));
        [quantity(time, "s"), one_digit(error), ratio]
    };
    let [integral, integral_error, rule_ratio] = compared(Problem::Integral, None);
    let sums = points.iter().filter(|point| point.problem == Problem::Sum);
    let most = sums.filter_map(|point| point.effort).fold(0.0, f64::max);
    let [sum, sum_error, sum_ratio] = compared(Problem::Sum, Some(most));
    format!(
        "The integral takes at most {integral} per separation, with errors up to {integral_error}; other rules within 1e-12 take at least \
         {rule_ratio} times as long. The sum of {} asperities takes at most {sum}, with errors up to {sum_error}; other sums within 1e-12 \
         take at least {sum_ratio} times as long.",
        count(most as usize),
    )
}

/// Smaller errors are shown at this value.
const FLOOR: f64 = 3e-17;

/// Time against error: a panel for each case of each problem, a line with markers for each method.
fn drawing(points: &[Point]) -> Drawing {
    let panels = points.chunk_by(|a, b| (a.problem, a.case) == (b.problem, b.case)).map(|of_case| {
        let title = format!("{}, {}", of_case[0].problem.name(), of_case[0].case);
        let plot = Plot::new(title, Axis::log("relative error"), Axis::log("time (s)")).height(320.0);
        let methods: IndexSet<&str> = of_case.iter().map(|point| point.method).collect();
        methods.into_iter().enumerate().fold(plot, |plot, (k, method)| {
            let of_method = of_case.iter().filter(|point| point.method == method);
            let places = of_method.map(|point| (point.cost.error().max(FLOOR), point.cost.seconds));
            let places: Vec<(f64, f64)> = places.collect();
            let is_shipped = method == SHIPPED;
            let colour = if is_shipped { Colour::Deterministic } else { Colour::Series(k) };
            let marker = if is_shipped { Marker::Cross } else { Marker::Circle };
            plot.with(Layer::line(places.clone()).named(method).coloured(colour))
                .with(Layer::points(places, marker).named(method).coloured(colour))
        })
    });
    Drawing {
        file: "precision.svg",
        figure: Figure::grid("Time against error", 2, panels.collect()),
        caption: "Time per separation or contact against the larger error of area and load; the effort grows along each line. Integrals are \
                  over d/σ = -1, 0, 1, 2, 3, 4, sums at 10 separations from 4 to 0 σ on one thread. Cross: what the program does, which \
                  also returns regimes, contacts and stiffness. Smaller errors are shown at 3e-17."
            .to_owned(),
    }
}

impl Row for &Point {
    const FILE: &'static str = "precision.csv";
    const ROWS: &'static str = "One row for each problem, case, method and effort.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            problem["text"] = row.problem.name(), "Problem: `integral` over a population, `sum` over a random set of it, or `boundary elements`, which solve Hertz's contact.";
            case["text"] = row.case, "Case: the population, or `hertz`.";
            method["text"] = row.method, "Method: `shipped` is that of this program. Integrals: `gauss-legendre` or `gauss-kronrod`, split where the law changes its formula with the square root of the indentation as variable. Sums, on one thread: `naive`, one term after the other, or `compensated`, the same with the rounding error of each addition kept. Boundary elements: `area counted`, not corrected for the border.";
            effort["1", input] = row.effort, "Nodes per piece (`gauss-legendre`), relative tolerance (`gauss-kronrod`), asperities (sums) or pixels per contact radius; empty of the shipped integral.";
            evaluations_per_separation["1"] = row.evaluations, "Mean number of contacts that an integral evaluates per separation; empty where the rule does not report it.";
            area_error["1", scale(1.0)] = row.cost.area_error, "Largest relative error of the area over the separations, against 32 digits; of boundary elements against Hertz.";
            load_error["1", scale(1.0)] = row.cost.load_error, "The same of the load; of boundary elements at the computed indentation, against Hertz's load there.";
            seconds_per_result["s", label("time"), ignored] = row.cost.seconds, "Time per separation, or for map, kernel and contact.";
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finer_grid_is_nearer_to_hertz() {
        let points = contacts(&[4, 16]).unwrap();
        let [coarse_counted, coarse, fine_counted, fine] = &points[..] else { panic!("{points:?}") };
        assert!(fine.cost.area_error < 0.012 && fine.cost.load_error < 5e-4, "{fine:?}");
        assert!(coarse.cost.load_error > 4.0 * fine.cost.load_error, "{points:?}");
        assert!(coarse_counted.cost.area_error > 2.0 * fine_counted.cost.area_error, "{points:?}");
    }
}
