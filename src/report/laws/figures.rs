//! The pictures of several laws.

use std::f64::consts::PI;

use super::super::plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};
use crate::compare::{AtLoad, Influence, Kind, Measure};
use crate::contact::Contact;
use crate::experiment::{LARGEST_SLOPE, LawOnOne, LawsResults};

/// How many standard errors a band shows: 95 % of all draws lie within.
const BAND: f64 = 1.96;

type Line = Vec<(f64, f64)>;

/// The colour of a law in every picture: the first, which the others are compared with, is black.
fn colour(law: usize) -> Colour {
    const OTHERS: [usize; 7] = [0, 1, 2, 3, 4, 5, 7];
    const BLACK: usize = 6;
    Colour::Series(law.checked_sub(1).map_or(BLACK, |other| OTHERS[other % OTHERS.len()]))
}

/// Laws of one regime are limits of the others.
fn dash(law: &LawOnOne) -> Dash {
    if law.passes_regimes { Dash::Solid } else { Dash::Dashed }
}

/// What a panel of the one asperity shows of a contact at an indentation (m).
type Shown<'a> = &'a dyn Fn(f64, &Contact) -> f64;

/// All laws against w/wc, their boundaries marked on the curves.
fn panel(results: &LawsResults, plot: Plot, shown: Shown) -> Plot {
    let unit = results.critical.indentation;
    let at = |w: f64, contact: &Contact| (w / unit, shown(w, contact));
    let mut plot = plot;
    let whole = results.radius / unit;
    if let Some(steep) = super::steep_from(results) {
        plot = plot.with(Layer::region_x(steep / unit, whole, format!("a > {LARGEST_SLOPE} R")));
    }
    plot = plot.with(Layer::region_x(whole, f64::INFINITY, "w > R"));
    // The first law comes last, so that it is not hidden.
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
    Axis::log("indentation w/w_c")
}

/// Load and area in their critical values over all decades.
pub fn curves(results: &LawsResults) -> String {
    let (load, area) = (results.critical.load, results.critical.area);
    let plot =
        |title: &str, label: &str| Plot::new(title, indentation_axis(), Axis::log(label)).height(420.0);
    let panels = vec![
        panel(results, plot("load", "load P/P_c").legend(Legend::Below), &|_, contact| contact.load / load),
        panel(results, plot("real contact area", "area A/A_c").legend(Legend::Hidden), &|_, contact| {
            contact.area / area
        }),
    ];
    Figure::row("Load and area of one asperity under every law", panels).svg()
}

/// What tells the laws from each other: mean pressure over hardness, area over the elastic one.
pub fn differences(results: &LawsResults, hardness: f64) -> String {
    /// Above twice the elastic area nothing but a fit out of its range, above the hardness nothing but Hertz.
    const HIGHEST: [f64; 2] = [1.3, 3.0];
    let radius = results.radius;
    let plot = |title: &str, label: &str, highest: f64| {
        Plot::new(title, indentation_axis(), Axis::linear(label).range(0.0, highest)).height(420.0)
    };
    let pressure = plot("mean pressure", "mean pressure P/(A H)", HIGHEST[0]).legend(Legend::Below);
    let area = plot("area over the elastic one", "area A/(π R w)", HIGHEST[1]).legend(Legend::Hidden);
    let panels = vec![
        panel(results, pressure, &|_, contact| contact.load / contact.area / hardness),
        panel(results, area, &|w, contact| contact.area / (PI * radius * w)),
    ];
    Figure::row("Mean pressure and area of one asperity under every law", panels).svg()
}

/// Load over that of Hertz and area over the elastic one where laws jump.
pub fn jumps(results: &LawsResults) -> Option<String> {
    /// Room at both ends, in ratios.
    const ROOM: f64 = 1.6;
    let unit = results.critical.indentation;
    let all = || results.laws.iter().flat_map(|law| &law.boundaries).filter(|at| super::is_jump(at));
    let first = all().map(|at| at.indentation / unit).reduce(f64::min)?;
    let last = all().map(|at| at.indentation / unit).reduce(f64::max)?;
    let (from, to) = (first / ROOM, last * ROOM);
    let (critical, radius) = (results.critical, results.radius);
    let elastic = move |w: f64| critical.load * (w / unit).powf(1.5);
    let plot = |title: &str, y: Axis| Plot::new(title, indentation_axis().range(from, to), y).height(420.0);
    let load = plot("load over the elastic one", Axis::linear("load over Hertz's").range(0.0, 1.6));
    let area = plot("area over the elastic one", Axis::linear("area A/(π R w)").range(0.8, 2.4));
    let panels = vec![
        panel(results, load.legend(Legend::Below), &|w, contact| contact.load / elastic(w)),
        panel(results, area.legend(Legend::Hidden), &|w, contact| contact.area / (PI * radius * w)),
    ];
    Some(Figure::row("Where laws jump", panels).svg())
}

/// On one surface at equal load: each law's sum beside that of the first law, and integral beside sum under the first.
pub fn law_or_model(results: &LawsResults, influence: &Influence) -> String {
    let first = &influence.laws[0];
    let separation = Axis::linear(format!("d/σ minus that of the sum under {first}"));
    let area = Axis::log(format!("real area over that of the sum under {first}"));
    let panels = vec![
        beside(results, influence, Measure::Separation, Plot::new("separation", load_axis(), separation))
            .legend(Legend::Below),
        beside(results, influence, Measure::Area, Plot::new("real contact area", load_axis(), area))
            .legend(Legend::Hidden),
    ];
    Figure::row("Law against adding-up at equal load", panels).svg()
}

fn load_axis() -> Axis {
    Axis::log("nominal pressure p (MPa)")
}

fn beside(results: &LawsResults, influence: &Influence, measure: Measure, plot: Plot) -> Plot {
    const MEGA: f64 = 1e6;
    let shown = |difference: f64| match measure {
        Measure::Separation => difference,
        Measure::Area => difference.exp(),
    };
    let line = |of: &dyn Fn(&AtLoad) -> f64| -> Line {
        influence.loads.iter().map(|at| (at.pressure / MEGA, shown(of(at)))).collect()
    };
    let mut plot = plot.height(420.0);
    let counting: Vec<f64> = influence.counting().map(|at| at.pressure / MEGA).collect();
    if let (Some(&lowest), Some(&highest)) = (counting.first(), counting.last()) {
        let loads = || influence.loads.iter().map(|at| at.pressure / MEGA);
        if loads().any(|load| load < lowest) {
            plot = plot.with(Layer::region_x(0.0, lowest, "few contacts"));
        }
        if loads().any(|load| load > highest) {
            plot = plot.with(Layer::region_x(highest, f64::INFINITY, "asperities interact"));
        }
    }
    for (index, law) in results.laws.iter().enumerate().skip(1) {
        let points = line(&|at| at.deviation(measure, index, Kind::Deterministic));
        let layer = Layer::line(points).coloured(colour(index)).dashed(dash(law));
        plot = plot.with(layer.named(format!("{}, sum", law.law)).thin());
    }
    let band = influence.loads.iter().filter_map(|at| {
        let (gap, half) = (at.gap(measure, 0), BAND * at.sampling_error(measure, 0)?);
        Some((at.pressure / MEGA, shown(gap - half), shown(gap + half)))
    });
    let name = format!("{}, integral (band: 95 % of other samples)", influence.laws[0]);
    plot.with(Layer::band(band.collect::<Vec<_>>()).coloured(colour(0)).named(name.clone()))
        .with(Layer::line(line(&|at| at.gap(measure, 0))).coloured(colour(0)).named(name).thick())
}
