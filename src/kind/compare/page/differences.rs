//! The figures behind the verdicts: differences between the models, and between each and the reference, against load, with
//! what is accepted.

use asperity::compare::{AgainstReference, ComparedQuantity, Difference, Estimate, ValidRange};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

use crate::kind::compare::findings::Verdicts;

/// The quantities in the order of their panels, with their axes and the factor from a share or sigma to its unit.
const PANELS: [(ComparedQuantity, &str, f64); 3] = [
    (ComparedQuantity::Area, "area (%)", 100.0),
    (ComparedQuantity::Separation, "separation (σ)", 1.0),
    (ComparedQuantity::Stiffness, "stiffness (%)", 100.0),
];

/// Differences over load, with how they are drawn.
struct Curve<'a> {
    name: &'static str,
    colour: Colour,
    dash: Dash,
    differences: &'a [Difference],
}

impl Curve<'_> {
    /// The loads at which a quantity is compared, with its estimates.
    fn of(&self, compared: ComparedQuantity) -> impl Iterator<Item = (&Difference, Estimate)> + Clone {
        self.differences.iter().filter_map(move |at| Some((at, at.estimates[compared as usize]?)))
    }
}

/// Differences of area, separation and stiffness between the models at equal load, one panel each.
pub fn differences(verdicts: &Verdicts) -> String {
    let curve = Curve {
        name: "statistical − deterministic",
        colour: Colour::Statistical,
        dash: Dash::Solid,
        differences: &verdicts.differences,
    };
    figure("Statistical minus deterministic model at equal load", verdicts, &[curve])
}

/// The same of both models and the reference.
pub fn against_reference(verdicts: &Verdicts, against: &AgainstReference) -> String {
    let [statistical, sum] = &against.models;
    let curves = [
        Curve {
            name: "statistical − reference",
            colour: Colour::Statistical,
            dash: Dash::Dashed,
            differences: statistical,
        },
        Curve {
            name: "deterministic − reference",
            colour: Colour::Deterministic,
            dash: Dash::Solid,
            differences: sum,
        },
    ];
    figure("Both models minus the reference at equal load", verdicts, &curves)
}

fn figure(title: &str, verdicts: &Verdicts, curves: &[Curve]) -> String {
    let is_compared =
        |compared: ComparedQuantity| curves.iter().any(|curve| curve.of(compared).next().is_some());
    let panels = PANELS.into_iter().filter(|(compared, ..)| is_compared(*compared));
    let plots = panels.map(|(compared, label, unit)| panel(verdicts, curves, compared, label, unit));
    Figure::column(title, plots.collect()).svg()
}

fn panel(verdicts: &Verdicts, curves: &[Curve], compared: ComparedQuantity, label: &str, unit: f64) -> Plot {
    let shown = |contrast: f64| unit * compared.reported(contrast);
    let accepted = unit * verdicts.accepted.of(compared);
    let loads = curves.iter().flat_map(|curve| curve.differences).map(|at| megapascals(at.load));
    let axis = Axis::log("nominal pressure (MPa)")
        .range(loads.clone().fold(f64::INFINITY, f64::min) / MARGIN, loads.fold(0.0, f64::max) * MARGIN);
    let all = curves.iter().flat_map(|curve| curve.of(compared));
    let in_view = all.filter(|(at, _)| at.exceeded().is_none());
    let ends = in_view.flat_map(|(_, found)| found.interval().unwrap_or([found.contrast; 2])).map(shown);
    let [low, high] =
        ends.fold([-VIEW * accepted, VIEW * accepted], |[low, high], end| [low.min(end), high.max(end)]);
    let room = 0.05 * (high - low);
    let mut plot = Plot::new("", axis, Axis::linear(label).range(low - room, high + room))
        .height(210.0)
        .with(Layer::region_y(-accepted, accepted, "accepted").coloured(Colour::Series(2)));
    for region in invalid(&verdicts.valid, 1e-6) {
        plot = plot.with(region);
    }
    plot = plot.with(Layer::at_y(0.0, ""));
    for curve in curves {
        let band = curve.of(compared).filter_map(|(at, found)| {
            let [low, high] = found.interval()?;
            Some((megapascals(at.load), shown(low), shown(high)))
        });
        let band: Vec<(f64, f64, f64)> = band.collect();
        if let &[(load, low, high)] = &band[..] {
            // One load has no band to fill: an error bar.
            let bar = Layer::line([(load, low), (load, high)]).coloured(curve.colour);
            plot = plot.with(bar.named(INTERVAL).thick());
        } else if !band.is_empty() {
            plot = plot.with(Layer::band(band).coloured(curve.colour).named(INTERVAL));
        }
    }
    for curve in curves {
        let line = curve.of(compared).map(|(at, found)| (megapascals(at.load), shown(found.contrast)));
        let line: Vec<(f64, f64)> = line.collect();
        let line = if line.len() == 1 {
            Layer::points(line, Marker::Circle).coloured(curve.colour)
        } else {
            Layer::line(line).coloured(curve.colour).dashed(curve.dash)
        };
        plot = plot.with(line.named(curve.name));
    }
    plot
}

/// The intervals in the legend.
const INTERVAL: &str = "95 % interval";

/// Margin of the load axis at both ends, as a ratio.
pub const MARGIN: f64 = 1.3;

/// How much of the axis is shown at least, in accepted differences.
const VIEW: f64 = 1.5;

/// A pressure in Pa as one in MPa.
pub fn megapascals(pressure: f64) -> f64 {
    1e-6 * pressure
}

/// The loads beyond the valid range as shaded regions of an axis that shows the pressure (Pa) times `scale`.
pub fn invalid(valid: &ValidRange, scale: f64) -> Vec<Layer> {
    const LABEL: &str = "not valid";
    let mut ends = vec![0.0];
    ends.extend(valid.stretches.iter().flatten().map(|load| load * scale));
    ends.push(f64::INFINITY);
    let last = ends.len() / 2 - 1;
    let gaps = ends.chunks_exact(2).enumerate();
    // Beyond the loads that were tested nothing is known.
    let is_invalid = |index: usize| match index {
        0 => !valid.below.is_none() || last == 0,
        index if index == last => !valid.above.is_none(),
        _ => true,
    };
    let label = |index: usize| if index == 0 || index == last { LABEL } else { "" };
    let gaps = gaps.filter(|(index, _)| is_invalid(*index));
    gaps.map(|(index, gap)| Layer::region_x(gap[0], gap[1], label(index))).collect()
}
