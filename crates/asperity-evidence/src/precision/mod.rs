//! Run time against error: what an integral, a sum, a random surface and a contact by boundary elements cost, and how exact they are
//! for it.
//!
//! Times are medians of runs made in alternation. Errors of integrals and sums are against evaluations in about 32 digits that share
//! neither the rule nor the code with what they check ([`exact`](crate::exact), and the exact sums of [`sum`]).
//!
//! | module | what is measured |
//! |---|---|
//! | [`integral`] | rules of quadrature, by order or tolerance |
//! | [`sum`] | summation methods, by number of asperities |
//! | [`surface`] | summits of a random map relative to an infinite surface on a fine grid, by pixel and side |

pub mod integral;
pub mod sum;
pub mod surface;
mod timing;

use crate::exact::Bodies;
use crate::exact::CoveredLaw;
use crate::program::{Drawing, Evidence, Failed, Form, Program, Task};
use crate::solver::{BenchmarkQuantity, hertz};
use crate::wide::{Wide, relative_error};
use asperity::{Heights, Material, Population, literature};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::format::{count, input_number, number, one_digit, quantity};
use asperity_contact_framework::report::table::{Column, Row, Schema, Table};
use asperity_plot::{Axis, Colour, Figure, Layer, Marker, Plot};
use integral::{IntegralPoint, Rule, integrals};
use rayon::ThreadPoolBuilder;
use sum::{Method, SumPoint, sums};
use surface::{Maps, SurfacePoint, maps};
use timing::{Candidate, medians};

/// Two populations of Table 1 of Pasaribu and Schipper (2005): in case 1 most contacts are elastic, in case 2 almost all have yielded.
const CASES: [Case; 2] = [
    Case { name: "case-1", radius: 2e-5, sigma: 4.8e-8, density: 6e10 },
    Case { name: "case-2", radius: 1.6e-6, sigma: 2.6e-7, density: 9e10 },
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

pub const PRECISION: Program = Program {
    name: "precision",
    forms: [
        Form::new("quadrature rules, sums of up to 1e6 asperities, random maps, boundary elements", 2e8, 5e7),
        Form::new(
            "quadrature rules, sums of up to 1e8 asperities, random maps, boundary elements",
            5.7e9,
            2.3e9,
        ),
    ],
    tables: || {
        vec![
            Schema::of::<&IntegralPoint>(),
            Schema::of::<&SumPoint>(),
            Schema::of::<&SurfacePoint>(),
            Schema::of::<&ContactPoint>(),
        ]
    },
    run,
};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    pub name: &'static str,
    pub radius: f64,
    pub sigma: f64,
    pub density: f64,
}

impl Case {
    pub fn population(&self) -> Population {
        let Self { radius, sigma, density, .. } = *self;
        Population { radius, sigma, density, heights: Heights::GAUSSIAN }
    }
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

/// Hertz's contact by boundary elements on one grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    pub pixels: usize,
    /// Relative error of the area of the points in contact, not corrected for the border.
    pub counted_area_error: f64,
    /// Per contact, map and kernel included: the corrected area, and the load at the computed indentation over Hertz's load there.
    pub cost: Cost,
}

pub fn contacts(pixels: &[usize]) -> Result<Vec<ContactPoint>, Failed> {
    let benchmarks: Vec<_> = pixels.iter().map(|&pixels| hertz(pixels)).collect::<Result<_, _>>()?;
    let candidate =
        |&pixels: &usize| -> Candidate { Box::new(move || _ = std::hint::black_box(hertz(pixels))) };
    let seconds = medians(&mut pixels.iter().map(candidate).collect::<Vec<_>>());
    let points = pixels.iter().zip(&benchmarks).zip(seconds).map(|((&pixels, benchmarks), seconds)| {
        let error = |quantity: BenchmarkQuantity| {
            let benchmark = benchmarks.iter().find(|benchmark| benchmark.quantity == quantity);
            benchmark.map_or(f64::NAN, |benchmark| benchmark.error)
        };
        ContactPoint {
            pixels,
            counted_area_error: error(BenchmarkQuantity::RawArea).abs(),
            cost: Cost {
                seconds,
                area_error: error(BenchmarkQuantity::Area).abs(),
                // The load is given; Hertz's grows with the indentation to the power 3/2.
                load_error: ((1.0 + error(BenchmarkQuantity::Indentation)).powf(-1.5) - 1.0).abs(),
            },
        }
    });
    Ok(points.collect())
}

fn run(task: &Task) -> Result<Evidence, Failed> {
    let counts = if task.is_full { &COUNTS[..] } else { &COUNTS[..SHORT_COUNTS] };
    let steps = CASES.len() * (1 + counts.len()) + Maps::ALL.count() + 1;
    task.progress.stage("errors and times", steps as f64);
    let step = || task.progress.advance(1.0);
    let (young, poisson, hardness) = STEEL;
    let steel = Material::new(young, poisson, Some(hardness), None)?;
    let bodies = Bodies { law: CoveredLaw::zmc(), rough: steel, flat: steel, layer: None };
    let contact = bodies.contact()?;
    let single = ThreadPoolBuilder::new().num_threads(1).build()?;
    let (mut of_integrals, mut of_sums) = (Vec::new(), Vec::new());
    for case in &CASES {
        let points = integrals(&bodies, case, &SEPARATIONS)?;
        of_integrals.extend(points.ok_or("the reference integral does not settle in 32 digits")?);
        step();
        for &count in counts {
            let seed = task.stream_seed(&format!("sum {} {count}", case.name));
            of_sums.extend(single.install(|| sums(&*contact, case, count, seed))?);
            step();
        }
    }
    let maps = maps(&Maps::ALL, |[i, j], k| task.stream_seed(&format!("grid {i} {j} {k}")), step)?;
    let contacts = contacts(&PIXELS)?;
    step();
    let mut papers = contact.papers();
    papers.extend(bodies.law.chosen().papers());
    papers.extend([
        literature::PASARIBU_SCHIPPER_2005,
        literature::ZHAO_MAIETTA_CHANG_2000,
        literature::GREENWOOD_1984,
        literature::NAYAK_1971,
    ]);
    Ok(Evidence {
        claim: claim(&of_integrals, &of_sums),
        warnings: contact.caveat().into_iter().collect(),
        drawings: drawings(&of_integrals, &of_sums, &maps, &contacts),
        tables: vec![
            Table::new(&of_integrals),
            Table::new(&of_sums),
            Table::new(&maps),
            Table::new(&contacts),
        ],
        set_up: vec![format!(
            "Steel on steel under ZMC: cases 1 and 2 of Table 1 of Pasaribu and Schipper (2005). Surfaces and boundary elements run on {} \
             threads. Method: [theory](../../docs/theory.md#run-time-against-error).",
            rayon::current_num_threads()
        )],
        papers,
        ..Evidence::default()
    })
}

/// Rules are compared within this error.
const LEVEL: f64 = 1e-12;

/// What the shipped rule and the shipped sum take, how exact they are, and how many times as long others take that are as exact.
fn claim(integrals: &[IntegralPoint], sums: &[SumPoint]) -> String {
    // Over the cases, the shipped method's longest time and largest error, and the smallest ratio of another one's time.
    let compared = |points: Vec<(&str, bool, Cost)>| {
        let (mut time, mut error, mut ratio) = (0f64, 0f64, f64::INFINITY);
        for (case, _, cost) in points.iter().filter(|(_, is_shipped, _)| *is_shipped) {
            let others = points.iter().filter(|(of, is_shipped, _)| of == case && !is_shipped);
            let others = others.filter(|(.., other)| other.error() <= LEVEL);
            time = time.max(cost.seconds);
            error = error.max(cost.error());
            ratio = others.map(|(.., other)| other.seconds / cost.seconds).fold(ratio, f64::min);
        }
        // Two significant digits.
        let ratio = number(format!("{ratio:.1e}").parse().unwrap_or(ratio));
        [quantity(time, "s"), one_digit(error), ratio]
    };
    let rules = integrals.iter().map(|point| (point.case, point.rule == Rule::Shipped, point.cost));
    let [integral, integral_error, rule_ratio] = compared(rules.collect());
    let most = sums.iter().map(|point| point.asperities).max().unwrap_or(0);
    let of_most = sums.iter().filter(|point| point.asperities == most && point.method != Method::Compensated);
    let methods = of_most.map(|point| (point.case, point.method == Method::Shipped, point.cost));
    let [sum, sum_error, naive_ratio] = compared(methods.collect());
    format!(
        "The integral takes at most {integral} per separation, with errors up to {integral_error}; other rules within 1e-12 take at least \
         {rule_ratio} times as long. The sum of {} asperities takes at most {sum}, with errors up to {sum_error}; the naive sum takes at \
         least {naive_ratio} times as long.",
        count(most),
    )
}

/// Smaller errors are shown at this value.
const FLOOR: f64 = 3e-17;

/// A method with its errors and times; the shipped one is told from the others.
type Series = (String, bool, Vec<(f64, f64)>);

/// Time against error: in each panel a line with markers for each method.
fn drawing(file: &'static str, time: &str, panels: Vec<(&str, Vec<Series>)>, caption: &str) -> Drawing {
    let panel = |(title, series): (&str, Vec<Series>)| {
        let plot = Plot::new(title, Axis::log("relative error"), Axis::log(time)).height(430.0);
        series.into_iter().enumerate().fold(plot, |plot, (k, (name, is_shipped, points))| {
            let points: Vec<_> = points.into_iter().map(|(error, time)| (error.max(FLOOR), time)).collect();
            let colour = if is_shipped { Colour::Deterministic } else { Colour::Series(k) };
            let marker = if is_shipped { Marker::Cross } else { Marker::Circle };
            plot.with(Layer::line(points.clone()).named(&name).coloured(colour))
                .with(Layer::points(points, marker).named(&name).coloured(colour))
        })
    };
    let figure = Figure::row("Time against error", panels.into_iter().map(panel).collect());
    Drawing { file, figure, caption: caption.to_owned() }
}

fn drawings(
    integrals: &[IntegralPoint],
    sums: &[SumPoint],
    maps: &[SurfacePoint],
    contacts: &[ContactPoint],
) -> Vec<Drawing> {
    let of_integral = |case: &Case| {
        let points: Vec<&IntegralPoint> = integrals.iter().filter(|point| point.case == case.name).collect();
        let rules = points.chunk_by(|a, b| a.rule.name() == b.rule.name()).map(|points| {
            let places = points.iter().map(|point| (point.cost.error(), 1e6 * point.cost.seconds));
            (points[0].rule.name().to_owned(), points[0].rule == Rule::Shipped, places.collect())
        });
        (case.name, rules.collect())
    };
    let of_sum = |case: &Case| {
        let methods = Method::ALL.map(|method| {
            let points = sums.iter().filter(|point| point.case == case.name && point.method == method);
            let time = |point: &SumPoint| 1e9 * point.cost.seconds / point.asperities as f64;
            let places = points.map(|point| (point.cost.error(), time(point)));
            (method.name().to_owned(), method == Method::Shipped, places.collect())
        });
        (case.name, methods.to_vec())
    };
    let of_maps = |(title, statistic): (&'static str, usize)| {
        let grids = maps.chunk_by(|a, b| a.per_length == b.per_length).map(|maps| {
            let places = maps.iter().map(|map| (map.error(statistic), map.seconds));
            (format!("points per length: {}", input_number(maps[0].per_length)), false, places.collect())
        });
        (title, grids.collect())
    };
    let of_contacts = |name: &str, error: fn(&ContactPoint) -> f64| {
        let places = contacts.iter().map(|contact| (error(contact), 1e3 * contact.cost.seconds));
        (name.to_owned(), false, places.collect())
    };
    let errors = vec![
        of_contacts("area, points counted", |contact| contact.counted_area_error),
        of_contacts("area, corrected", |contact| contact.cost.area_error),
        of_contacts("load", |contact| contact.cost.load_error),
    ];
    vec![
        drawing(
            "integral.svg",
            "time per separation (µs)",
            CASES.iter().map(of_integral).collect(),
            "Time against error of quadrature rules at d/σ = -1, 0, 1, 2, 3, 4, the larger of area and load. Cross: the shipped rule, which \
             also returns regimes, contacts and stiffness. Smaller errors are shown at 3e-17.",
        ),
        drawing(
            "sum.svg",
            "time per asperity and separation (ns)",
            CASES.iter().map(of_sum).collect(),
            "Time against error of sums at 10 separations from 4 to 0 σ, on one thread; the number of asperities increases along each line.",
        ),
        drawing(
            "surface.svg",
            "time for a map and its summits (s)",
            [("Density of summits", surface::DENSITY), ("Mean radius", surface::RADIUS)]
                .map(of_maps)
                .to_vec(),
            "Time for a map and its summits against bias and scatter together. The map grows along each line; where the line turns up, only \
             a finer grid reduces the error.",
        ),
        drawing(
            "boundary_elements.svg",
            "time per contact (ms)",
            vec![("Hertz's contact", errors)],
            "Time for map, kernel and Hertz's contact against error; the number of pixels per contact radius increases along each line.",
        ),
    ]
}

impl Row for &IntegralPoint {
    const FILE: &'static str = "integral.csv";
    const ROWS: &'static str = "One row for each case, quadrature rule and effort.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case, "Case: the population that is integrated.";
            rule["text"] = row.rule.name(), "Quadrature rule, split where the law changes its formula with the square root of the indentation as variable; `shipped` is the rule of this program.";
            order["count"] = row.rule.order(), "Nodes per piece of the range; empty where the rule has a tolerance or is fixed.";
            tolerance["1", input] = row.rule.tolerance(), "Tolerance of the rule; empty where it has an order or is fixed.";
            evaluations_per_separation["1"] = row.evaluations, "Mean number of contacts evaluated per separation; empty where the rule does not report it.";
            area_error["1", scale(1.0)] = row.cost.area_error, "Largest relative error of the area over the separations, against 32 digits.";
            load_error["1", scale(1.0)] = row.cost.load_error, "Largest relative error of the load over the separations, against 32 digits.";
            seconds_per_separation["s", label("time per separation"), ignored] = row.cost.seconds, "Time per separation.";
        }
    }
}

impl Row for &SumPoint {
    const FILE: &'static str = "sum.csv";
    const ROWS: &'static str = "One row for each case, number of asperities and summation method.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case, "Case: the population of which a random set is summed.";
            method["text"] = row.method.name(), "Summation method, on one thread: `naive`, one term after the other; `compensated`, the same with the rounding error of each addition kept; `shipped`, the sum of this program at all separations together.";
            asperities["count"] = row.asperities, "Asperities in the set.";
            area_error["1", scale(1.0)] = row.cost.area_error, "Largest relative error of the area over the separations, against 32 digits.";
            load_error["1", scale(1.0)] = row.cost.load_error, "Largest relative error of the load over the separations, against 32 digits.";
            seconds_per_separation["s", label("time per separation"), ignored] = row.cost.seconds, "Time per separation.";
        }
    }
}

impl Row for &SurfacePoint {
    const FILE: &'static str = "surface.csv";
    const ROWS: &'static str = "One row for each resolution and size of random maps.";

    fn columns() -> Vec<Column<Self>> {
        columns! { map: Self =>
            points_per_length["1", input] = map.per_length, "Points per correlation length.";
            lengths["1", label("side [l]"), input] = map.lengths, "Side of the map in correlation lengths.";
            points["count"] = map.points, "Points along a side.";
            summits["1"] = map.summits, "Mean number of summits.";
            density_bias["1", signed_percent] = map.bias[0], "Expected summit density on this grid over that on a fine grid, minus 1.";
            radius_bias["1", signed_percent] = map.bias[1], "Expected radius 1/(mean curvature) on this grid over that on a fine grid, minus 1.";
            sigma_bias["1", label("σ bias"), signed_percent] = map.bias[2], "Expected standard deviation of summit heights on this grid over that on a fine grid, minus 1.";
            density_scatter["1", percent] = map.scatter[0], "Root mean square error of the summit density of a map, relative to that expected on this grid.";
            radius_scatter["1", percent] = map.scatter[1], "Root mean square error of the radius of a map, relative to that expected on this grid.";
            sigma_scatter["1", label("σ scatter"), percent] = map.scatter[2], "Root mean square error of the standard deviation of the heights of a map, relative to that expected on this grid.";
            seconds_per_map["s", label("time per map"), ignored] = map.seconds, "Median time for a map and its summits.";
        }
    }
}

impl Row for &ContactPoint {
    const FILE: &'static str = "boundary_elements.csv";
    const ROWS: &'static str = "One row for each resolution of Hertz's contact solved by boundary elements.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            pixels_per_contact_radius["count"] = row.pixels, "Pixels per contact radius.";
            counted_area_error["1", percent, scale(1.0)] = row.counted_area_error, "Relative error of the area of the points in contact.";
            area_error["1", percent, scale(1.0)] = row.cost.area_error, "Relative error of the area corrected for its border.";
            load_error["1", percent, scale(1.0)] = row.cost.load_error, "Relative error of the load at the computed indentation, against Hertz's load there.";
            seconds_per_contact["s", label("time per contact"), ignored] = row.cost.seconds, "Time for map, kernel and contact.";
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finer_grid_is_nearer_to_hertz() {
        let points = contacts(&[4, 16]).unwrap();
        let [coarse, fine] = &points[..] else { panic!("{points:?}") };
        assert!(fine.cost.area_error < 0.012 && fine.cost.load_error < 5e-4, "{fine:?}");
        assert!(coarse.cost.load_error > 4.0 * fine.cost.load_error, "{points:?}");
        assert!(coarse.counted_area_error > 2.0 * fine.counted_area_error, "{points:?}");
    }
}
