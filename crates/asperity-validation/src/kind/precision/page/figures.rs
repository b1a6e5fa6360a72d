//! The figures: error along x, time along y.

use crate::kind::precision::run::CasePrecision;
use crate::precision::curve::{CurveFindings, CurvePoint};
use crate::precision::grid::{GridFindings, GridPoint, Statistic};
use crate::precision::integral::Family;
use crate::precision::integral::{IntegralFindings, Rule};
use crate::precision::list::ListPoint;
use crate::precision::sampling::{SamplingFindings, separation, stated};
use crate::precision::sum::{SumPoint, Sweep, Way};
use crate::precision::{Cost, LEVELS};
use asperity::compare::{Kind, LimitPoint, Quantity};
use asperity_framework::report::format::input_number;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

/// Smaller errors are shown at this value.
const FLOOR: f64 = 3e-17;

/// The colour of the shipped method.
const SHIPPED: Colour = Colour::Series(6);

fn error_axis() -> Axis {
    Axis::log("relative error (the larger of area and load)").range(FLOOR / 1.5, 3.0)
}

fn work(cost: &Cost) -> (f64, f64) {
    (cost.error.max(FLOOR), 1e6 * cost.seconds)
}

/// A line with a marker at each point, named once.
fn series(points: Vec<(f64, f64)>, name: &str, colour: Colour, dash: Dash, marker: Marker) -> [Layer; 2] {
    [
        Layer::line(points.clone()).named(name).coloured(colour).dashed(dash),
        Layer::points(points, marker).named(name).coloured(colour),
    ]
}

/// The rules of a figure: family, split, substituted, and how they are called.
type Use = (Family, bool, bool, &'static str);

fn rules_plot(title: &str, found: &IntegralFindings, uses: &[Use]) -> Plot {
    let mut plot = Plot::new(title, error_axis(), Axis::log("time per separation (µs)")).height(430.0);
    for level in LEVELS {
        plot = plot.with(Layer::at_x(level, ""));
    }
    for (k, (family, split, substituted, name)) in uses.iter().enumerate() {
        let is_it =
            |rule: &Rule| (rule.family, rule.split, rule.substituted) == (*family, *split, *substituted);
        let points = found.points.iter().filter(|point| is_it(&point.rule)).map(|point| work(&point.cost));
        let marker = [Marker::Circle, Marker::Square, Marker::Triangle][k % 3];
        for layer in series(points.collect(), name, Colour::Series(k), Dash::Solid, marker) {
            plot = plot.with(layer);
        }
    }
    if let Some(shipped) = found.shipped() {
        let at = work(&shipped.cost);
        plot = plot
            .with(Layer::at_y(at.1, "").coloured(SHIPPED).dashed(Dash::Dotted))
            .with(Layer::points([at], Marker::Cross).coloured(SHIPPED).named("the shipped rule"))
            .with(Layer::note(at, "shipped").coloured(SHIPPED));
    }
    plot
}

/// Gauss-Legendre, with and without what makes its integrand smooth.
pub fn legendre(found: &IntegralFindings) -> Figure {
    let uses = [
        (Family::Legendre, false, false, "plain"),
        (Family::Legendre, false, true, "substituted"),
        (Family::Legendre, true, false, "split"),
        (Family::Legendre, true, true, "split and substituted"),
        (Family::Panels, true, true, "split and substituted, in panels"),
    ];
    rules_plot("Gauss-Legendre by order", found, &uses).into()
}

/// All other rules.
pub fn rules(found: &IntegralFindings) -> Figure {
    let gauss = [
        (Family::Panels, true, true, "Legendre in panels"),
        (Family::Jacobi, true, false, "Jacobi"),
        (Family::ChebyshevFirst, true, true, "Chebyshev, first kind"),
        (Family::ChebyshevSecond, true, true, "Chebyshev, second kind"),
        (Family::Laguerre, false, false, "Laguerre"),
        (Family::Laguerre, true, true, "Legendre, then Laguerre"),
        (Family::Hermite, false, false, "Hermite"),
    ];
    let others = [
        (Family::Midpoint, true, true, "midpoint"),
        (Family::Trapezoid, true, true, "trapezoid"),
        (Family::Simpson, true, true, "Simpson"),
        (Family::Kronrod, false, false, "Gauss-Kronrod, plain"),
        (Family::Kronrod, true, false, "Gauss-Kronrod, split"),
        (Family::Kronrod, true, true, "Gauss-Kronrod, split and substituted"),
    ];
    let plots = vec![
        rules_plot("Gauss rules by order", found, &gauss),
        rules_plot("Equal steps, and adaptive by tolerance", found, &others),
    ];
    Figure::row("Other rules", plots)
}

/// Methods that visit every asperity are dashed.
fn way_style(way: Way) -> (Colour, Dash, Marker) {
    if way == Way::SHIPPED {
        return (SHIPPED, Dash::Solid, Marker::Cross);
    }
    let dash = if way.ordered { Dash::Solid } else { Dash::Dashed };
    let marker = if way.ordered { Marker::Circle } else { Marker::Square };
    (Colour::Series(way.adding as usize), dash, marker)
}

fn with_ways(mut plot: Plot, points: &[&SumPoint], place: impl Fn(&SumPoint) -> (f64, f64)) -> Plot {
    for way in Way::ALL {
        let line: Vec<_> = points.iter().filter(|p| p.way == way).map(|p| place(p)).collect();
        let (colour, dash, marker) = way_style(way);
        if !line.is_empty() {
            for layer in series(line, way.name(), colour, dash, marker) {
                plot = plot.with(layer);
            }
        }
    }
    plot
}

fn per_asperity(point: &SumPoint) -> f64 {
    1e9 * point.cost.seconds / point.asperities as f64
}

/// Summation methods: time against error by the number of asperities, and time against their number.
pub fn sums(case: &CasePrecision) -> Figure {
    let points: Vec<&SumPoint> = case.sums.iter().filter(|p| p.sweep == Sweep::Asperities).collect();
    let axis = || Axis::log("time per asperity and separation (ns)");
    let error = Axis::log("relative error (the larger of area and load)");
    let left = Plot::new("Time against error", error, axis());
    let right = Plot::new("Time against size", Axis::log("number of asperities"), axis());
    let left = with_ways(left, &points, |p| (p.cost.error.max(FLOOR), per_asperity(p)));
    let right = with_ways(right, &points, |p| (p.asperities as f64, per_asperity(p)));
    Figure::row(format!("{}: summation methods", case.name), vec![left, right])
}

/// Time by the number of separations, with and without ordering.
pub fn separations(case: &CasePrecision) -> Figure {
    let points: Vec<&SumPoint> = case.sums.iter().filter(|p| p.sweep == Sweep::Separations).collect();
    let plot = Plot::new(
        format!("{}: time by the number of separations", case.name),
        Axis::log("number of separations"),
        Axis::log("time per separation (µs), ordering included"),
    );
    with_ways(plot, &points, |p| (p.separations as f64, 1e6 * p.cost.seconds)).into()
}

/// Curves within a tolerance: time by tolerance and by error.
pub fn curves(found: &CurveFindings) -> Figure {
    let plot = |kind: Kind, title: &str| {
        let milliseconds = |point: &CurvePoint| 1e3 * point.seconds;
        let of_kind = || found.points.iter().filter(move |point| point.kind == kind);
        let [least, most] = of_kind()
            .map(milliseconds)
            .fold([f64::INFINITY, 0.0], |[least, most], time| [time.min(least), time.max(most)]);
        let within = || of_kind().filter_map(|point| Some((point.tolerance?, point)));
        let errors = found
            .interpolated(kind)
            .map(|point| (point.error().max(FLOOR), milliseconds(point)))
            .collect::<Vec<_>>();
        let mut plot = Plot::new(
            title,
            Axis::log("relative error (the larger of area and load)"),
            // Around the horizontal line too.
            Axis::log("time of the curve (ms)").range(0.6 * least, 1.6 * most),
        );
        let by_tolerance: Vec<_> =
            within().map(|(tolerance, point)| (tolerance, milliseconds(point))).collect();
        for layer in series(by_tolerance, "tolerance", Colour::Series(0), Dash::Solid, Marker::Circle) {
            plot = plot.with(layer);
        }
        if !errors.is_empty() {
            plot = plot.with(Layer::points(errors, Marker::Cross).coloured(SHIPPED).named("error found"));
        }
        if let Some(exact) = of_kind().find(|point| point.tolerance.is_none()) {
            plot = plot.with(Layer::at_y(milliseconds(exact), "exact".to_owned()).dashed(Dash::Dashed));
        }
        plot
    };
    let plots = vec![plot(Kind::Statistical, "The integral"), plot(Kind::Deterministic, "The sum")];
    Figure::row("Curves within a tolerance", plots)
}

/// Time per asperity of a list, by the length of the list.
pub fn lists(points: &[ListPoint]) -> Figure {
    let each = |seconds: fn(&ListPoint) -> f64| -> Vec<(f64, f64)> {
        let size = |point: &ListPoint| point.asperities as f64;
        points.iter().map(|point| (size(point), 1e9 * seconds(point) / size(point))).collect()
    };
    let separations = points.first().map_or(0, |point| point.separations);
    let read = each(|point| point.read_seconds);
    let sum = each(|point| point.sum_seconds);
    let times = || read.iter().chain(&sum).map(|(_, time)| *time);
    let [least, most] = [times().fold(f64::INFINITY, f64::min), times().fold(0.0, f64::max)];
    // With margins, so that nearly horizontal lines look horizontal.
    let axis = Axis::log("time per asperity (ns)").range(0.3 * least, 2.0 * most);
    let mut plot = Plot::new("Time per asperity of a list", Axis::log("number of asperities"), axis);
    let summing = format!("summing at {separations} separations");
    for (k, (line, name)) in [(read, "reading the file"), (sum, &summing)].into_iter().enumerate() {
        for layer in series(line, name, Colour::Series(k), Dash::Solid, Marker::Circle) {
            plot = plot.with(layer);
        }
    }
    plot.into()
}

/// Scatter of random sets, measured and estimated; then the time.
pub fn sampling(found: &SamplingFindings) -> Figure {
    let mut separations: Vec<f64> = found.points.iter().map(separation).collect();
    separations.sort_by(f64::total_cmp);
    separations.dedup();
    let of = separations.len();
    let size = Axis::log("number of asperities");
    let mut left = Plot::new("Error against size", size, Axis::log("relative error of the load"));
    let mut right = Plot::new(
        "Time against error",
        Axis::log("relative error of the load"),
        Axis::log("time to draw and sum a set (s)"),
    );
    let error = |point: &LimitPoint| point.scatter(Quantity::Load).1;
    for (index, h) in separations.iter().enumerate() {
        let colour = Colour::Ordered { index, of };
        let points: Vec<&LimitPoint> = found.points.iter().filter(|point| separation(point) == *h).collect();
        let measured: Vec<_> = points.iter().map(|point| (point.count as f64, error(point))).collect();
        let said = points.iter().map(|point| (point.count as f64, stated(point, Quantity::Load)));
        let name = format!("d/σ = {}", input_number(*h));
        left = left
            .with(
                Layer::line(said.collect::<Vec<_>>())
                    .coloured(colour)
                    .dashed(Dash::Dashed)
                    .named("estimated by the sums"),
            )
            .with(Layer::points(measured, Marker::Circle).coloured(colour).named(&name));
        let time = |point: &&LimitPoint| {
            let seconds = found.seconds.iter().find(|(count, _)| *count == point.count)?.1;
            Some((error(point), seconds))
        };
        for layer in
            series(points.iter().filter_map(time).collect(), &name, colour, Dash::Solid, Marker::Circle)
        {
            right = right.with(layer);
        }
    }
    if let Some(point) = found.points.iter().find(|point| point.is_fitted()) {
        left = left.with(Layer::slope((point.count as f64, 0.3 * error(point)), -0.5, "slope −1/2"));
    }
    Figure::row("Random sets of growing size", vec![left, right])
}

fn statistic_name(statistic: Statistic) -> &'static str {
    match statistic {
        Statistic::Density => "density",
        Statistic::Radius => "radius of the mean curvature",
        Statistic::Sigma => "σ of the heights",
    }
}

/// Effect of a finer grid and a larger map on the statistics of summits.
pub fn grid(found: &GridFindings) -> Figure {
    let largest = found.points.iter().map(|point| point.lengths).fold(0.0, f64::max);
    let of_largest: Vec<&GridPoint> = found.points.iter().filter(|point| point.lengths == largest).collect();
    let mut left = Plot::new(
        "Bias of the grid (theory)",
        Axis::log("points per correlation length"),
        Axis::log("absolute value of the relative error"),
    );
    let mut right = Plot::new(
        "Scatter of the maps (measured)",
        Axis::log("number of summits"),
        Axis::log("relative error, r.m.s."),
    );
    for (k, statistic) in Statistic::ALL.into_iter().enumerate() {
        let name = statistic_name(statistic);
        let bias = of_largest.iter().map(|point| (point.per_length, point.bias[k].abs())).collect();
        for layer in series(bias, name, Colour::Series(k), Dash::Solid, Marker::Circle) {
            left = left.with(layer);
        }
        let scatter = found.points.iter().map(|point| (point.summits, point.scatter[k]));
        right = right.with(
            Layer::points(scatter.collect::<Vec<_>>(), Marker::Circle)
                .coloured(Colour::Series(k))
                .named(name),
        );
    }
    let [bias, scatter] = [of_largest.first(), found.points.first().as_ref()].map(|point| point.copied());
    if let Some(point) = bias {
        left = left.with(Layer::slope((point.per_length, 0.3 * point.bias[1].abs()), -2.0, "slope −2"));
    }
    if let Some(point) = scatter {
        right = right.with(Layer::slope((point.summits, 2.5 * point.scatter[1]), -0.5, "slope −1/2"));
    }
    Figure::row("Summits of random maps", vec![left, right])
}

/// Both errors of the radius together against the time that a map takes.
pub fn surface_work(found: &GridFindings) -> Figure {
    let mut grids: Vec<f64> = found.points.iter().map(|point| point.per_length).collect();
    grids.dedup();
    let mut plot = Plot::new(
        "Time against error: the radius of the mean curvature from one map",
        Axis::log("relative error: bias of the grid and scatter together"),
        Axis::log("time for a map and its summits (s)"),
    );
    for (index, per_length) in grids.iter().enumerate() {
        let points = found.points.iter().filter(|point| point.per_length == *per_length);
        let line = points.map(|point| (point.error(Statistic::Radius), point.seconds)).collect();
        let unit = if *per_length == 1.0 { "point" } else { "points" };
        let name = format!("{} {unit} per length", input_number(*per_length));
        let colour = Colour::Ordered { index, of: grids.len() };
        for layer in series(line, &name, colour, Dash::Solid, Marker::Circle) {
            plot = plot.with(layer);
        }
    }
    plot.into()
}
