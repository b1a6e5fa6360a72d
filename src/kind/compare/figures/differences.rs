//! The figures behind the verdicts: differences between the models, and between each and the reference, against load, with
//! what is accepted.

use asperity::compare::{
    AdmissibleRange, AgainstReference, Cause, ComparedQuantity, Contributions, Difference, Estimate,
};
use asperity::study::Verdicts;
use asperity_contact_framework::report::format::capitalised;
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

use super::curves::Units;
use crate::presentation::{cause_colour, difference_unit, quantity_name};

fn axis(compared: ComparedQuantity, units: &Units, label: &str) -> Axis {
    match compared {
        ComparedQuantity::Separation => units.separation_difference(label),
        _ => Axis::linear(format!("{label} (%)")),
    }
}

/// Differences over load, with how they are drawn.
struct Curve<'a> {
    name: String,
    colour: Colour,
    dash: Dash,
    differences: &'a [Difference],
    has_intervals: bool,
}

impl Curve<'_> {
    /// The loads at which a quantity is compared, with its estimates.
    fn estimates(&self, compared: ComparedQuantity) -> impl Iterator<Item = (&Difference, Estimate)> + Clone {
        self.differences.iter().filter_map(move |at| Some((at, at.estimates[compared as usize]?)))
    }
}

/// The differences of area, separation and stiffness between the models at equal load that were compared, a plot without a title
/// each.
pub fn between_models(verdicts: &Verdicts, units: &Units) -> Vec<(ComparedQuantity, Plot)> {
    let curves = [Curve {
        name: "statistical − deterministic".to_owned(),
        colour: Colour::Statistical,
        dash: Dash::Solid,
        differences: &verdicts.differences,
        has_intervals: true,
    }];
    let plot = |compared: ComparedQuantity| {
        let label = match compared {
            ComparedQuantity::Area => "area",
            ComparedQuantity::Friction => "friction",
            ComparedQuantity::ElectricalConductance | ComparedQuantity::ThermalConductance => "conductance",
            other => quantity_name(other),
        };
        let axis = axis(compared, units, &format!("difference in {label}"));
        (compared, panel("", axis, verdicts, units, &curves, compared).height(150.0))
    };
    compared(&curves).map(plot).collect()
}

fn compared(curves: &[Curve]) -> impl Iterator<Item = ComparedQuantity> {
    ComparedQuantity::REPORTED
        .into_iter()
        .filter(|&quantity| curves.iter().any(|curve| curve.estimates(quantity).next().is_some()))
}

/// The same of both models and the reference.
pub fn against_reference(
    verdicts: &Verdicts,
    against: &AgainstReference,
    units: &Units,
    finding: &str,
) -> Figure {
    let [statistical, sum] = &against.models;
    let curves = [
        Curve {
            name: "statistical − reference".to_owned(),
            colour: Colour::Statistical,
            dash: Dash::Dashed,
            differences: statistical,
            has_intervals: true,
        },
        Curve {
            name: "deterministic − reference".to_owned(),
            colour: Colour::Deterministic,
            dash: Dash::Solid,
            differences: sum,
            has_intervals: true,
        },
    ];
    let panel = |compared: ComparedQuantity| {
        let axis = axis(compared, units, "difference");
        panel(&capitalised(quantity_name(compared)), axis, verdicts, units, &curves, compared)
    };
    Figure::row(finding, compared(&curves).map(panel).collect())
}

fn panel(
    title: &str,
    axis: Axis,
    verdicts: &Verdicts,
    units: &Units,
    curves: &[Curve],
    compared: ComparedQuantity,
) -> Plot {
    let shown = |contrast: f64| difference_unit(compared).1 * compared.reported(contrast);
    let accepted = difference_unit(compared).1 * verdicts.accepted.limit(compared);
    let loads = curves.iter().flat_map(|curve| curve.differences).map(|at| at.load);
    let all = curves.iter().flat_map(|curve| curve.estimates(compared));
    let in_view = all.filter(|(at, _)| at.exceeded().is_none());
    let ends = in_view.flat_map(|(_, found)| found.interval().unwrap_or([found.contrast; 2])).map(shown);
    let [low, high] =
        ends.fold([-VIEW * accepted, VIEW * accepted], |[low, high], end| [low.min(end), high.max(end)]);
    let room = 0.05 * (high - low);
    let [from, to] = shown_loads(&verdicts.admissible, loads).map(megapascals);
    let loads = units.pressure().range(from, to);
    let mut plot = Plot::new(title, loads, axis.range(low - room, high + room)).height(210.0);
    // A figure of its own names what it shades; below curves that do it needs no name.
    for region in invalid(&verdicts.admissible, 1e-6, if title.is_empty() { "" } else { NOT_ADMISSIBLE }) {
        plot = plot.with(region);
    }
    // After the narrow regions: its label has more places.
    plot =
        plot.with(Layer::region_y(-accepted, accepted, "accepted").coloured(Colour::Series(2))).with_zero();
    for curve in curves.iter().filter(|curve| curve.has_intervals) {
        let band = curve.estimates(compared).filter_map(|(at, found)| {
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
        let line = curve.estimates(compared).map(|(at, found)| (megapascals(at.load), shown(found.contrast)));
        let line: Vec<(f64, f64)> = line.collect();
        let line = if line.len() == 1 {
            Layer::points(line, Marker::Circle).coloured(curve.colour)
        } else {
            Layer::line(line).coloured(curve.colour).dashed(curve.dash)
        };
        plot = plot.with(line.named(&curve.name));
    }
    plot
}

const INTERVAL: &str = "95 % interval";

/// Margin of the load axis at both ends, as a ratio.
pub const MARGIN: f64 = 1.3;

/// How much of the axis is shown at least, in accepted differences.
const VIEW: f64 = 1.5;

/// First and last load that a figure shows of those `tested`: the admissible ones, and some beyond them.
pub fn shown_loads(valid: &AdmissibleRange, tested: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    /// So far beyond the admissible loads, as a ratio.
    const BEYOND: f64 = 4.0;
    let all = [tested.clone().fold(f64::INFINITY, f64::min) / MARGIN, tested.fold(0.0, f64::max) * MARGIN];
    let ends = valid.stretches.iter().flatten().copied();
    let [low, high] = [ends.clone().fold(f64::INFINITY, f64::min), ends.fold(0.0, f64::max)];
    if low > high { all } else { [all[0].max(low / BEYOND), all[1].min(high * BEYOND)] }
}

pub fn megapascals(pressure: f64) -> f64 {
    1e-6 * pressure
}

/// The name of loads that are not admissible.
pub const NOT_ADMISSIBLE: &str = "not admissible";

/// The loads that are not admissible as shaded regions of an axis that shows the pressure (Pa) times `scale`.
pub fn invalid(valid: &AdmissibleRange, scale: f64, name: &str) -> Vec<Layer> {
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
    let label = |index: usize| if index == 0 || index == last { name } else { "" };
    let gaps = gaps.filter(|(index, _)| is_invalid(*index));
    gaps.map(|(index, gap)| Layer::region_x(gap[0], gap[1], label(index))).collect()
}

/// The quantities that are divided on the page.
const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Separation, ComparedQuantity::Area];

/// The contributions over the load, stacked, with the difference; one panel per quantity; `finding` is what it shows, in words.
/// `None` where too few contacts carry every load.
pub fn by_cause(verdicts: &Verdicts, units: &Units, finding: &str) -> Option<Figure> {
    let is_divided = verdicts
        .attribution
        .iter()
        .any(|at| QUANTITIES.into_iter().any(|quantity| at.contributions(quantity).is_some()));
    let panels = QUANTITIES.into_iter().map(|quantity| contributions(verdicts, units, quantity));
    is_divided.then(|| Figure::row(finding, panels.collect()))
}

fn contributions(verdicts: &Verdicts, units: &Units, quantity: ComparedQuantity) -> Plot {
    let divided = || verdicts.attribution.iter().map(|at| (megapascals(at.load), at.contributions(quantity)));
    let load: Vec<f64> = divided().map(|(load, _)| load).collect();
    let ends = [load.iter().copied().fold(f64::INFINITY, f64::min), load.iter().copied().fold(0.0, f64::max)];
    let y = match quantity {
        ComparedQuantity::Separation => units.separation_difference("contribution"),
        _ => Axis::linear("ln(area ratio of the models)"),
    };
    let parts = Cause::ALL.map(|cause| {
        divided().map(|(_, parts)| parts.map_or(f64::NAN, |parts| parts.part(cause))).collect::<Vec<f64>>()
    });
    let axis = units.pressure().range(ends[0] / MARGIN, ends[1] * MARGIN);
    let mut plot = Plot::new(capitalised(quantity_name(quantity)), axis, y).height(240.0);
    for region in invalid(&verdicts.admissible, 1e-6, NOT_ADMISSIBLE) {
        plot = plot.with(region);
    }
    let stacked = Cause::ALL.into_iter().zip(&parts);
    plot = plot.with_contributions(
        &load,
        stacked.map(|(cause, part)| (cause.label(), cause_colour(cause), &part[..])),
    );
    let radii =
        divided().map(|(load, parts)| (load, parts.map_or(f64::NAN, |parts| parts.radii.mean.contrast)));
    plot = plot.with(
        Layer::line(radii)
            .coloured(Colour::Radii)
            .dashed(Dash::Dashed)
            .named("spread and correlation of radii together"),
    );
    let gap = divided().map(|(load, parts)| (load, parts.map_or(f64::NAN, Contributions::gap)));
    plot = plot
        .with_zero()
        .with(Layer::line(gap).coloured(Colour::Sum).thick().named("statistical − deterministic"));
    let missed: Vec<(f64, f64)> = verdicts
        .attribution
        .iter()
        .filter_map(|at| Some((megapascals(at.load), verdicts.missed(quantity, at.load)?.contrast)))
        .collect();
    if missed.is_empty() {
        return plot;
    }
    let name = "deterministic − reference";
    let line = Layer::line(missed.iter().copied()).coloured(Colour::Deterministic).dashed(Dash::DashDot);
    plot.with(line.named(name))
        .with(Layer::points(missed, Marker::Triangle).coloured(Colour::Deterministic).named(name))
}
