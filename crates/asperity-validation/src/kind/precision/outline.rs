//! The page of `[precision]`: of integral, sum, surface and boundary elements a finding, a figure of time against error, and the table.

use super::run::PrecisionResults;
use crate::precision::integral::{IntegralPoint, Rule};
use crate::precision::reference::ReferencePoint;
use crate::precision::sum::{Method, POINTS, SEPARATIONS, SumPoint};
use crate::precision::surface::{Statistic, SurfacePoint};
use crate::precision::{Case, Cost};
use asperity_contact_framework::report::format::{
    count, input_number, input_quantity, number, percent, quantity,
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
    let per_case = |line: fn(&PrecisionResults, &str) -> Option<String>| {
        results.cases.iter().filter_map(move |case| line(results, &case.name))
    };
    let lines = per_case(integral_line).chain(per_case(sum_line));
    let lines = lines.chain(surface_line(&results.maps)).chain(reference_line(&results.contacts));
    sections::findings(&mut page, lines);
    let separations: Vec<String> = results.separations.iter().map(|&h| input_number(h)).collect();
    let [from, to] = SEPARATIONS;
    section(
        &mut page,
        "Integral",
        &format!(
            "Area and load at d/σ = {}; reference: a tanh-sinh rule in 32 digits, from the equations of the law only. Errors below 3e-17 are \
             shown at 3e-17. Gauss-Legendre (`gauss-quad`) by its order and adaptive Gauss-Kronrod (`quad-rs`) by its tolerance compute area \
             and load alone, over the whole range to a density of exp(-40), or split where the law changes with w^½ as variable. The shipped \
             rule also returns regimes, contacts and stiffness.",
            separations.join(", ")
        ),
        (
            "integral.svg",
            integral_figure(results),
            "Time against error of quadrature rules; cross: the shipped rule.",
        ),
        &tables.view::<&IntegralPoint>(),
    );
    section(
        &mut page,
        "Sum",
        &format!(
            "Random sets at {POINTS} separations from {from} to {to} σ, on one thread; reference: the sum of the same terms in 32 digits. \
             *Naive*: one term after the other; *compensated*: with the rounding error of every addition. The shipped sum also returns \
             regimes, contacts, stiffness and sampling errors.",
        ),
        (
            "sum.svg",
            sum_figure(results),
            "Time against error of sums; the number of asperities increases along each line.",
        ),
        &tables.view::<&SumPoint>(),
    );
    section(
        &mut page,
        "Surface",
        "Gaussian surfaces with the autocorrelation exp(-(r/l)²), for which the five-point summits on a grid are known in theory. *Bias*: theory \
         on this grid relative to a fine grid, which has 1.306 times the summits of a continuous surface (Nayak). *Scatter*: deviation of a \
         single map from theory on its own grid, root mean square.",
        (
            "surface.svg",
            surface_figure(&results.maps),
            "Time for a map and its summits against bias and scatter together. The size of the map increases along each line; where the line \
             turns up, only a finer grid reduces the error.",
        ),
        &tables.view::<&SurfacePoint>(),
    );
    section(
        &mut page,
        "Boundary elements",
        "A paraboloid on a half-space under a given load (Hertz), solved to a relative dual gap of 1e-11. The area is that of the points in \
         contact, and the same corrected for its border. The load is compared at the computed indentation. `[solver-validation]` \
         compares further solutions.",
        (
            "boundary_elements.svg",
            reference_figure(&results.contacts),
            "Time for map, kernel and contact against error; the number of pixels per contact radius increases along each line.",
        ),
        &tables.view::<&ReferencePoint>(),
    );
    sections::notes(&mut page, &results.metadata);
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
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
        "Law {}; {} threads for surfaces and boundary elements. Each time is the median of runs of all candidates in turn; it varies between \
         machines and between runs. Ratios are significant beyond about 10 %.",
        escape(&results.law),
        results.threads,
    ));
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

/// What was measured, a figure and its table; nothing without rows.
fn section(page: &mut Page, title: &str, method: &str, figure: (&str, Figure, &str), view: &View) {
    if view.is_empty() {
        return;
    }
    let (file, figure, caption) = figure;
    page.heading(2, title).paragraph(method).figure(file, figure, caption);
    page.details(3, &format!("Times and errors: {}", title.to_lowercase()), |page| {
        page.view(view);
    });
}

fn time(seconds: f64) -> String {
    quantity(seconds, "s")
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

fn integral_line(results: &PrecisionResults, case: &str) -> Option<String> {
    /// Within this the shipped rule is compared with the fastest other one.
    const LEVEL: f64 = 1e-12;
    let of_case = || results.integrals.iter().filter(|point| point.case == case);
    let shipped = of_case().find(|point| point.rule == Rule::Shipped)?;
    let others = of_case().filter(|point| point.rule != Rule::Shipped);
    let other = fastest(others, LEVEL, |point| cost(&point.cost));
    let comparison = other.map_or_else(
        || "no other rule is within 1e-12".to_owned(),
        |other| {
            let effort = other.rule.order().map_or_else(String::new, |order| format!(", order {order}"));
            let ratio = times(other.cost.seconds / shipped.cost.seconds);
            format!(
                "the fastest other rule within 1e-12, {}{effort}, takes {ratio} times as long",
                other.rule.name()
            )
        },
    );
    Some(format!(
        "**Integral, {}**: {} per separation with an error of {}; {comparison}.",
        escape(case),
        time(shipped.cost.seconds),
        number(shipped.cost.error()),
    ))
}

fn sum_line(results: &PrecisionResults, case: &str) -> Option<String> {
    let largest = results.sums.iter().map(|point| point.asperities).max()?;
    let of = |method: Method| {
        let is_it = |point: &&SumPoint| {
            (point.case.as_str(), point.asperities, point.method) == (case, largest, method)
        };
        results.sums.iter().find(is_it).map(|point| point.cost)
    };
    let (naive, shipped) = (of(Method::Naive)?, of(Method::Shipped)?);
    Some(format!(
        "**Sum, {}**: {} asperities take {} per separation with an error of {}; the naive sum takes {} times as long with an error of {}.",
        escape(case),
        count(largest),
        time(shipped.seconds),
        number(shipped.error()),
        times(naive.seconds / shipped.seconds),
        number(naive.error()),
    ))
}

fn surface_line(maps: &[SurfacePoint]) -> Option<String> {
    /// A radius within this is sought.
    const LEVEL: f64 = 0.03;
    let map = fastest(maps.iter(), LEVEL, |map| (map.error(Statistic::Radius), map.seconds))?;
    Some(format!(
        "**Surface**: the fastest map with the mean asperity radius within {} has {} points per correlation length and a side of {} correlation \
         lengths ({}).",
        percent(LEVEL),
        input_number(map.per_length),
        input_number(map.lengths),
        time(map.seconds),
    ))
}

fn reference_line(contacts: &[ReferencePoint]) -> Option<String> {
    /// An area within this is sought.
    const LEVEL: f64 = 0.01;
    let contact = fastest(contacts.iter(), LEVEL, |contact| cost(&contact.cost))?;
    Some(format!(
        "**Boundary elements**: {} pixels per contact radius give the area within {} and the load within {} ({}).",
        contact.pixels,
        percent(contact.cost.area_error),
        percent(contact.cost.load_error),
        time(contact.cost.seconds),
    ))
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

fn surface_figure(maps: &[SurfacePoint]) -> Figure {
    let grids: Vec<&[SurfacePoint]> = maps.chunk_by(|a, b| a.per_length == b.per_length).collect();
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

fn reference_figure(contacts: &[ReferencePoint]) -> Figure {
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
        let places = contacts.iter().map(|contact| (error(contact), 1e3 * contact.cost.seconds)).collect();
        series(plot, places, name, Colour::Series(k), marker)
    });
    plot.into()
}
