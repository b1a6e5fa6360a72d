//! The page of `[precision]`: of integral, sum, surface and boundary elements a figure of time against error, and the table.

use super::run::PrecisionResults;
use crate::precision::integral::{IntegralPoint, Rule};
use crate::precision::reference::ReferencePoint;
use crate::precision::sum::{Method, POINTS, SEPARATIONS, SumPoint};
use crate::precision::surface::{Statistic, SurfacePoint};
use crate::precision::{Case, Cost};
use asperity_contact_framework::report::format::{
    capitalised, count, input_number, input_quantity, listed, number, one_digit, percent, quantity,
};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::Tables;
use asperity_contact_framework::report::view::View;
use asperity_plot::{Axis, Colour, Figure, Layer, Marker, Plot};

/// Smaller errors are shown at this value.
const FLOOR: f64 = 3e-17;

pub fn page(results: &PrecisionResults, tables: &Tables) -> Page {
    let mut page = Page::new(&results.metadata.title);
    page.lead(&answer(results));
    let separations: Vec<String> = results.separations.iter().map(|&h| input_number(h)).collect();
    let [from, to] = SEPARATIONS;
    let parts = [
        Part {
            title: "Integral",
            file: "integral.svg",
            draw: integral_figure,
            caption: format!(
                "Time against error of quadrature rules at d/σ = {}. Cross: the shipped rule, which also returns regimes, contacts and \
                 stiffness. Smaller errors are shown at 3e-17.",
                separations.join(", ")
            ),
            view: tables.view::<&IntegralPoint>(),
        },
        Part {
            title: "Sum",
            file: "sum.svg",
            draw: sum_figure,
            caption: format!(
                "Time against error of sums at {POINTS} separations from {from} to {to} σ, on one thread; the number of asperities increases \
                 along each line."
            ),
            view: tables.view::<&SumPoint>(),
        },
        Part {
            title: "Surface",
            file: "surface.svg",
            draw: surface_figure,
            caption: "Time for a map and its summits against bias and scatter together. The map grows along each line; where the line turns \
                      up, only a finer grid reduces the error."
                .to_owned(),
            view: tables.view::<&SurfacePoint>(),
        },
        Part {
            title: "Boundary elements",
            file: "boundary_elements.svg",
            draw: reference_figure,
            caption: "Time for map, kernel and Hertz's contact against error; the number of pixels per contact radius increases along each \
                      line."
                .to_owned(),
            view: tables.view::<&ReferencePoint>(),
        },
    ];
    let parts = || parts.iter().filter(|part| !part.view.is_empty());
    for part in parts() {
        page.figure(part.file, (part.draw)(results), &part.caption);
    }
    for part in parts() {
        page.details(2, &format!("Times and errors: {}", part.title.to_lowercase()), |page| {
            page.view(&part.view);
        });
    }
    sections::notes(&mut page, &results.metadata);
    sections::what_was_run(&mut page, &results.metadata, &results.contact, |page| {
        page.bullets(results.cases.iter().map(|Case { name, population }| {
            format!(
                "{}: radius {}, σ = {}, {} asperities per m².",
                escape(name),
                input_quantity(population.radius, "m"),
                input_quantity(population.sigma, "m"),
                input_number(population.density),
            )
        }));
        page.paragraph(&format!(
        "Law {}; {} threads for surfaces and boundary elements. Method: [theory](../../docs/theory.md#run-time-against-error).",
        escape(&results.law),
        results.threads,
    ));
    });
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

/// What was measured: a figure and its table; neither is shown without rows.
struct Part<'a> {
    title: &'static str,
    file: &'static str,
    draw: fn(&PrecisionResults) -> Figure,
    caption: String,
    view: View<'a>,
}

/// What integral and sum take and how exact they are, and what a map and a contact take.
fn answer(results: &PrecisionResults) -> String {
    let cases = || results.cases.iter().map(|case| case.name.as_str());
    let of_integrals = cases().filter_map(|case| integral(&results.integrals, case)).collect::<Vec<_>>();
    let of_sums = cases().filter_map(|case| sum(&results.sums, case)).collect::<Vec<_>>();
    let asperities = results.sums.iter().map(|point| point.asperities).max();
    let integral = Comparison::slowest(&of_integrals).map(|slowest| {
        let others = slowest.others.map_or_else(
            || "no other rule is within 1e-12".to_owned(),
            |ratio| format!("other rules within 1e-12 take at least {} times as long", times(ratio)),
        );
        format!(
            "The integral takes at most {} per separation, with errors up to {}; {others}.",
            slowest.time(),
            slowest.error()
        )
    });
    let sum = Comparison::slowest(&of_sums).zip(asperities).map(|(slowest, asperities)| {
        let naive = slowest.others.map_or_else(String::new, |ratio| {
            format!("; the naive sum takes at least {} times as long", times(ratio))
        });
        format!(
            "The sum of {} asperities takes at most {}, with errors up to {}{naive}.",
            count(asperities),
            slowest.time(),
            slowest.error()
        )
    });
    let sentences = integral.into_iter().chain(sum).chain(map_and_contact(results));
    sentences.collect::<Vec<_>>().join(" ")
}

/// The shipped method, and how many times as long the fastest other one takes that is as exact as asked for.
#[derive(Debug, Clone, Copy)]
struct Comparison {
    shipped: Cost,
    others: Option<f64>,
}

impl Comparison {
    /// The longest time, the largest error and the smallest ratio of several.
    fn slowest(all: &[Self]) -> Option<Self> {
        all.iter().copied().reduce(|a, b| Self {
            shipped: Cost {
                seconds: a.shipped.seconds.max(b.shipped.seconds),
                area_error: a.shipped.area_error.max(b.shipped.area_error),
                load_error: a.shipped.load_error.max(b.shipped.load_error),
            },
            others: a.others.into_iter().chain(b.others).reduce(f64::min),
        })
    }

    fn time(&self) -> String {
        quantity(self.shipped.seconds, "s")
    }

    fn error(&self) -> String {
        one_digit(self.shipped.error())
    }
}

/// A ratio of times to two significant digits.
fn times(ratio: f64) -> String {
    number(format!("{ratio:.1e}").parse().unwrap_or(ratio))
}

/// The fastest of some points within an error.
fn fastest<'a, P>(
    points: impl Iterator<Item = &'a P>,
    level: f64,
    cost: impl Fn(&P) -> (f64, f64),
) -> Option<&'a P> {
    let within = points.filter(|point| cost(point).0 <= level);
    within.min_by(|a, b| cost(a).1.total_cmp(&cost(b).1))
}

fn cost(cost: &Cost) -> (f64, f64) {
    (cost.error(), cost.seconds)
}

fn integral(points: &[IntegralPoint], case: &str) -> Option<Comparison> {
    /// Within this the shipped rule is compared with the fastest other one.
    const LEVEL: f64 = 1e-12;
    let of_case = || points.iter().filter(|point| point.case == case);
    let shipped = of_case().find(|point| point.rule == Rule::Shipped)?.cost;
    let others = of_case().filter(|point| point.rule != Rule::Shipped);
    let other = fastest(others, LEVEL, |point| cost(&point.cost));
    Some(Comparison { shipped, others: other.map(|other| other.cost.seconds / shipped.seconds) })
}

/// Of the largest number of asperities.
fn sum(points: &[SumPoint], case: &str) -> Option<Comparison> {
    let largest = points.iter().map(|point| point.asperities).max()?;
    let of = |method: Method| {
        let is_it = |point: &&SumPoint| {
            (point.case.as_str(), point.asperities, point.method) == (case, largest, method)
        };
        points.iter().find(is_it).map(|point| point.cost)
    };
    let shipped = of(Method::Shipped)?;
    Some(Comparison { shipped, others: of(Method::Naive).map(|naive| naive.seconds / shipped.seconds) })
}

fn map_and_contact(results: &PrecisionResults) -> Option<String> {
    /// A mean radius within this, and an area.
    const LEVELS: [f64; 2] = [0.03, 0.01];
    let time = |seconds: f64| quantity(seconds, "s");
    let map = fastest(results.maps.iter(), LEVELS[0], |map| (map.error(Statistic::Radius), map.seconds));
    let map = map.map(|map| {
        format!("a map whose mean radius is within {} takes {}", percent(LEVELS[0]), time(map.seconds))
    });
    let contact = fastest(results.contacts.iter(), LEVELS[1], |contact| cost(&contact.cost));
    let contact = contact.map(|contact| {
        let area = percent(LEVELS[1]);
        format!("boundary elements take {} for Hertz's area within {area}", time(contact.cost.seconds),)
    });
    let parts: Vec<String> = map.into_iter().chain(contact).collect();
    (!parts.is_empty()).then(|| format!("{}.", capitalised(&listed(&parts))))
}

/// Time against error: a line with a marker at each point, named once.
fn series(plot: Plot, points: Vec<(f64, f64)>, name: &str, colour: Colour, marker: Marker) -> Plot {
    let points: Vec<_> = points.into_iter().map(|(error, time)| (error.max(FLOOR), time)).collect();
    plot.with(Layer::line(points.clone()).named(name).coloured(colour))
        .with(Layer::points(points, marker).named(name).coloured(colour))
}

const MARKERS: [Marker; 4] = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Circle];

/// The colour of the shipped method.
const SHIPPED: Colour = Colour::Series(6);

const ERROR: &str = "relative error (the larger of area and load)";

/// Points with an adjacent name in common, together.
fn by_name<P>(points: Vec<&P>, name: impl Fn(&P) -> &'static str) -> Vec<Vec<&P>> {
    points.chunk_by(|a, b| name(a) == name(b)).map(<[&P]>::to_vec).collect()
}

fn per_case(results: &PrecisionResults, title: &str, plot: impl Fn(&str) -> Plot) -> Figure {
    Figure::row(title, results.cases.iter().map(|case| plot(&case.name)).collect())
}

fn integral_figure(results: &PrecisionResults) -> Figure {
    per_case(results, "Integral: time against error", |case| {
        let points = results.integrals.iter().filter(|point| point.case == case).collect();
        let time = Axis::log("time per separation (µs)");
        let plot = Plot::new(case, Axis::log(ERROR).range(FLOOR / 1.5, 3.0), time).height(430.0);
        let rules = by_name(points, |point: &IntegralPoint| point.rule.name());
        rules.iter().enumerate().fold(plot, |plot, (k, points)| {
            let rule = points[0].rule;
            let places = points.iter().map(|point| (point.cost.error(), 1e6 * point.cost.seconds));
            let is_shipped = rule == Rule::Shipped;
            let marker = if is_shipped { Marker::Cross } else { MARKERS[k % MARKERS.len()] };
            let colour = if is_shipped { SHIPPED } else { Colour::Series(k) };
            series(plot, places.collect(), rule.name(), colour, marker)
        })
    })
}

fn sum_figure(results: &PrecisionResults) -> Figure {
    per_case(results, "Sum: time against error", |case| {
        let plot = Plot::new(case, Axis::log(ERROR), Axis::log("time per asperity and separation (ns)"));
        Method::ALL.into_iter().zip(MARKERS).enumerate().fold(plot, |plot, (k, (method, marker))| {
            let is_it = |point: &&SumPoint| point.case == case && point.method == method;
            let place =
                |point: &SumPoint| (point.cost.error(), 1e9 * point.cost.seconds / point.asperities as f64);
            let places = results.sums.iter().filter(is_it).map(place).collect();
            let colour = if method == Method::Shipped { SHIPPED } else { Colour::Series(k) };
            series(plot, places, method.name(), colour, marker)
        })
    })
}

fn surface_figure(results: &PrecisionResults) -> Figure {
    let grids: Vec<&[SurfacePoint]> = results.maps.chunk_by(|a, b| a.per_length == b.per_length).collect();
    let plot = |title: &str, statistic: Statistic| {
        let error = Axis::log(format!("relative error of the {}", title.to_lowercase()));
        let plot = Plot::new(title, error, Axis::log("time for a map and its summits (s)"));
        grids.iter().enumerate().fold(plot, |plot, (index, maps)| {
            let places = maps.iter().map(|map| (map.error(statistic), map.seconds)).collect();
            let name = format!("points per length: {}", input_number(maps[0].per_length));
            series(plot, places, &name, Colour::Ordered { index, of: grids.len() }, Marker::Circle)
        })
    };
    let plots = vec![plot("Density of summits", Statistic::Density), plot("Mean radius", Statistic::Radius)];
    Figure::row("Surface: time against error", plots)
}

fn reference_figure(results: &PrecisionResults) -> Figure {
    type Error = (&'static str, fn(&ReferencePoint) -> f64);
    let errors: [Error; 3] = [
        ("area, points counted", |contact| contact.counted_area_error),
        ("area, corrected", |contact| contact.cost.area_error),
        ("load", |contact| contact.cost.load_error),
    ];
    let plot = Plot::new(
        "Boundary elements: time against error",
        Axis::log("relative error"),
        Axis::log("time per contact (ms)"),
    );
    let plot = errors.iter().zip(MARKERS).enumerate().fold(plot, |plot, (k, ((name, error), marker))| {
        let places =
            results.contacts.iter().map(|contact| (error(contact), 1e3 * contact.cost.seconds)).collect();
        series(plot, places, name, Colour::Series(k), marker)
    });
    plot.into()
}
