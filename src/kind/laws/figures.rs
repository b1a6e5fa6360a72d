//! The figures of several laws.

use std::f64::consts::PI;

use asperity::Contact;
use asperity::compare::{AtLoad, Influence, Measure, ModelKind};
use asperity::numeric::extremes;
use asperity::sphere::LARGEST_SLOPE;
use asperity_contact_framework::report::format::listed;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};

use super::rows::{LawOnAsperity, LawsResults};

/// Half-width of a band in standard errors: 95 % of all samples lie within.
const BAND: f64 = 1.96;

type Line = Vec<(f64, f64)>;

/// The colour of a law in every figure: the first, which the others are compared with, is black.
fn colour(law: usize) -> Colour {
    const OTHERS: [usize; 7] = [0, 1, 2, 3, 4, 5, 7];
    const BLACK: usize = 6;
    Colour::Series(law.checked_sub(1).map_or(BLACK, |other| OTHERS[other % OTHERS.len()]))
}

/// Laws of a single regime are dashed: they are limiting cases.
fn dash(law: &LawOnAsperity) -> Dash {
    if law.is_elastic_plastic { Dash::Solid } else { Dash::Dashed }
}

/// What a panel of the single asperity shows of a contact at an indentation (m).
type Ordinate<'a> = &'a dyn Fn(f64, &Contact) -> f64;

/// All laws against w/wc, their boundaries marked on the curves.
fn panel(results: &LawsResults, plot: Plot, ordinate: Ordinate) -> Plot {
    let unit = results.critical.indentation;
    let at = |w: f64, contact: &Contact| (w / unit, ordinate(w, contact));
    let mut plot = plot;
    let whole = results.radius / unit;
    if let Some(end) = results.end_of_small_strains() {
        plot = plot.with(Layer::region_x(end / unit, whole, format!("a > {LARGEST_SLOPE} R")));
    }
    plot = plot.with(Layer::region_x(whole, f64::INFINITY, "w > R"));
    // The first law is named first and drawn last, so that it is not hidden.
    plot = plot.with(
        Layer::line([]).coloured(colour(0)).dashed(dash(&results.laws[0])).named(&results.laws[0].law).thin(),
    );
    let mut order: Vec<usize> = (0..results.laws.len()).collect();
    order.rotate_left(1);
    for &index in &order {
        let law = &results.laws[index];
        let line: Line = law.curve.trace.iter().map(|point| at(point.indentation, &point.contact)).collect();
        let line = Layer::line(line).coloured(colour(index)).dashed(dash(law)).named(&law.law);
        plot = plot.with(line.thin());
    }
    for &index in &order {
        let law = &results.laws[index];
        let within = |w: f64| {
            let [first, .., last] = &law.curve.points[..] else { return false };
            (first.indentation..=last.indentation).contains(&w)
        };
        let sides: Line = law
            .boundaries
            .iter()
            .filter(|boundary| within(boundary.indentation))
            .flat_map(|boundary| {
                [&boundary.below, &boundary.above].map(|side| at(boundary.indentation, side))
            })
            .collect();
        plot = plot.with(Layer::points(sides, Marker::Circle).coloured(colour(index)));
    }
    plot
}

fn indentation_axis() -> Axis {
    Axis::log("indentation w/wc")
}

/// Load and area in their critical values over all decades.
pub fn curves(results: &LawsResults) -> Figure {
    let (load, area) = (results.critical.load, results.critical.area);
    let plot =
        |title: &str, label: &str| Plot::new(title, indentation_axis(), Axis::log(label)).height(420.0);
    let panels = vec![
        panel(results, plot("Load", "load P/Pc").legend(Legend::Below), &|_, contact| contact.load / load),
        panel(results, plot("Real contact area", "area A/Ac").legend(Legend::Hidden), &|_, contact| {
            contact.area / area
        }),
    ];
    Figure::row("Load and area of a single asperity, all laws", panels)
}

/// Differences between the laws: mean pressure over hardness, area over the elastic area.
pub fn differences(results: &LawsResults, hardness: f64) -> Figure {
    /// Only a fit out of its range exceeds twice the elastic area, only Hertz the hardness.
    const HIGHEST: [f64; 2] = [1.3, 3.0];
    let radius = results.radius;
    let plot = |title: &str, label: &str, highest: f64| {
        Plot::new(title, indentation_axis(), Axis::linear(label).range(0.0, highest)).height(420.0)
    };
    let pressure = plot("Mean pressure", "mean pressure P/(A H)", HIGHEST[0]).legend(Legend::Below);
    let area = plot("Area over elastic area", "area A/(π R w)", HIGHEST[1]).legend(Legend::Hidden);
    let panels = vec![
        panel(results, pressure, &|_, contact| contact.load / contact.area / hardness),
        panel(results, area, &|w, contact| contact.area / (PI * radius * w)),
    ];
    Figure::row("Mean contact pressure and area of a single asperity, all laws", panels)
}

/// Load over that of Hertz and area over the elastic area where laws jump.
pub fn jumps(results: &LawsResults) -> Option<Figure> {
    /// Margin at both ends, as a ratio.
    const MARGIN: f64 = 1.6;
    let unit = results.critical.indentation;
    let jumps = results.laws.iter().flat_map(|law| &law.boundaries).filter(|at| at.is_jump());
    let [first, last] = extremes(jumps.map(|at| at.indentation / unit))?;
    let (from, to) = (first / MARGIN, last * MARGIN);
    let (critical, radius) = (results.critical, results.radius);
    let elastic = move |w: f64| critical.load * (w / unit).powf(1.5);
    let plot = |title: &str, y: Axis| Plot::new(title, indentation_axis().range(from, to), y).height(420.0);
    let load = plot("Load over elastic load", Axis::linear("load over Hertz load").range(0.0, 1.7));
    let area = plot("Area over elastic area", Axis::linear("area A/(π R w)").range(0.8, 2.4));
    let panels = vec![
        panel(results, load.legend(Legend::Below), &|w, contact| contact.load / elastic(w)),
        panel(results, area.legend(Legend::Hidden), &|w, contact| contact.area / (PI * radius * w)),
    ];
    Some(Figure::row("Jumps of the laws", panels))
}

/// On one surface at equal load: each law's sum relative to that of the first law, and integral relative to sum under the first.
pub fn law_or_model(results: &LawsResults, influence: &Influence) -> Figure {
    let first = &influence.laws[0];
    let label = |measure| match measure {
        Measure::Separation => format!("d/σ − d/σ of the sum under {first}"),
        Measure::Area => format!("real area / area of the sum under {first}"),
    };
    let plot = |measure, title: &str, legend| {
        let y = Axis::linear(label(measure));
        let y = match range(results, influence, measure) {
            Some([low, high]) => y.range(low, high),
            None => y,
        };
        let plot = Plot::new(title, Axis::log("nominal pressure p (MPa)"), y).height(420.0).legend(legend);
        beside(results, influence, measure, plot)
    };
    let panels = vec![
        plot(Measure::Separation, "Separation", Legend::Below),
        plot(Measure::Area, "Real contact area", Legend::Hidden),
    ];
    Figure::row("Contact law against summation method at equal load", panels)
}

/// A difference of separations, or a ratio of areas.
fn ordinate(measure: Measure, difference: f64) -> f64 {
    match measure {
        Measure::Separation => difference,
        Measure::Area => difference.exp(),
    }
}

/// Axis range for the elastic-plastic laws and the models at admissible loads; limiting cases may lie outside.
fn range(results: &LawsResults, influence: &Influence, measure: Measure) -> Option<[f64; 2]> {
    /// Above and below, of the range.
    const MARGIN: f64 = 0.15;
    let members = || (0..results.laws.len()).filter(|&law| results.laws[law].is_elastic_plastic);
    let of_load = |at: &AtLoad| {
        let mut needed = vec![0.0];
        needed.extend(members().map(|law| at.deviation(measure, law, ModelKind::Deterministic)));
        let half = BAND * at.sampling_error(measure, 0).unwrap_or(0.0);
        needed.extend([at.gap(measure, 0) - half, at.gap(measure, 0) + half]);
        needed
    };
    let needed = influence.counting().flat_map(of_load).map(|difference| ordinate(measure, difference));
    let [low, high] = extremes(needed)?;
    let margin = MARGIN * (high - low);
    (margin > 0.0).then_some([low - margin, high + margin])
}

/// " Off the axes: hertz.": the laws whose sums are there at all admissible loads. Empty if there is none.
pub fn outside(results: &LawsResults, influence: &Influence) -> String {
    let is_outside = |law: usize, measure: Measure| {
        let differences = influence.counting().map(|at| at.deviation(measure, law, ModelKind::Deterministic));
        let ends = extremes(differences.map(|difference| ordinate(measure, difference)));
        let axis = range(results, influence, measure);
        ends.zip(axis).is_some_and(|([least, most], [low, high])| most < low || least > high)
    };
    let is_named = |law: &usize| Measure::ALL.into_iter().any(|measure| is_outside(*law, measure));
    let names: Vec<String> =
        (0..results.laws.len()).filter(is_named).map(|law| influence.laws[law].clone()).collect();
    if names.is_empty() { String::new() } else { format!(" Off the axes: {}.", listed(&names)) }
}

fn beside(results: &LawsResults, influence: &Influence, measure: Measure, plot: Plot) -> Plot {
    const MEGA: f64 = 1e6;
    let line = |of: &dyn Fn(&AtLoad) -> f64| -> Line {
        influence.loads.iter().map(|at| (at.pressure / MEGA, ordinate(measure, of(at)))).collect()
    };
    let mut plot = plot;
    let counting: Vec<f64> = influence.counting().map(|at| at.pressure / MEGA).collect();
    if let (Some(&lowest), Some(&highest)) = (counting.first(), counting.last()) {
        let loads = || influence.loads.iter().map(|at| at.pressure / MEGA);
        if loads().any(|load| load < lowest) {
            plot = plot.with(Layer::region_x(0.0, lowest, "not admissible"));
        }
        if loads().any(|load| load > highest) {
            plot = plot.with(Layer::region_x(highest, f64::INFINITY, "not admissible"));
        }
    }
    let name = format!("{}, integral", influence.laws[0]);
    let band = influence.loads.iter().filter_map(|at| {
        let (gap, half) = (at.gap(measure, 0), BAND * at.sampling_error(measure, 0)?);
        Some((at.pressure / MEGA, ordinate(measure, gap - half), ordinate(measure, gap + half)))
    });
    plot = plot
        .with(Layer::at_y(ordinate(measure, 0.0), ""))
        .with(Layer::band(band.collect::<Vec<_>>()).coloured(colour(0)).named(name.clone()))
        .with(Layer::line(line(&|at| at.gap(measure, 0))).coloured(colour(0)).named(name).thick());
    for (index, law) in results.laws.iter().enumerate().skip(1) {
        let points = line(&|at| at.deviation(measure, index, ModelKind::Deterministic));
        let layer = Layer::line(points).coloured(colour(index)).dashed(dash(law));
        plot = plot.with(layer.named(format!("{}, sum", law.law)).thin());
    }
    plot
}
