//! The figure behind the verdicts: the differences between the models against load, with what is accepted.

use asperity::compare::{ComparedQuantity, Difference, ValidRange};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

use crate::kind::compare::findings::Verdicts;

/// Differences of area, separation and stiffness at equal load, one panel each.
pub fn differences(verdicts: &Verdicts) -> String {
    let panels = [
        (ComparedQuantity::Area, "area (%)", 100.0),
        (ComparedQuantity::Separation, "separation (σ)", 1.0),
        (ComparedQuantity::Stiffness, "stiffness (%)", 100.0),
    ];
    let is_compared = |compared: ComparedQuantity| {
        verdicts.differences.iter().any(|at| at.estimates[compared as usize].is_some())
    };
    let panels = panels.into_iter().filter(|(compared, ..)| is_compared(*compared));
    let plots = panels.map(|(compared, label, unit)| panel(verdicts, compared, label, unit)).collect();
    Figure::column("Statistical minus deterministic model at equal load", plots).svg()
}

fn panel(verdicts: &Verdicts, compared: ComparedQuantity, label: &str, unit: f64) -> Plot {
    let shown = |contrast: f64| unit * compared.reported(contrast);
    let estimate = |at: &Difference| at.estimates[compared as usize];
    let accepted = unit * verdicts.accepted.of(compared);
    let loads = verdicts.differences.iter().map(|at| megapascals(at.load));
    let axis = Axis::log("nominal pressure (MPa)")
        .range(loads.clone().fold(f64::INFINITY, f64::min) / MARGIN, loads.fold(0.0, f64::max) * MARGIN);
    let points = verdicts.differences.iter().filter_map(|at| Some((at, estimate(at)?)));
    let line: Vec<(f64, f64)> =
        points.clone().map(|(at, found)| (megapascals(at.load), shown(found.contrast))).collect();
    let band: Vec<(f64, f64, f64)> = points
        .clone()
        .filter_map(|(at, found)| {
            let [low, high] = found.interval()?;
            Some((megapascals(at.load), shown(low), shown(high)))
        })
        .collect();
    let in_view = points.filter(|(at, _)| at.exceeded().is_none());
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
    if let &[(load, low, high)] = &band[..] {
        // One load has no band to fill: an error bar.
        plot = plot.with(
            Layer::line([(load, low), (load, high)])
                .coloured(Colour::Statistical)
                .named("95 % interval")
                .thick(),
        );
    } else if !band.is_empty() {
        plot = plot.with(Layer::band(band).coloured(Colour::Statistical).named("95 % interval"));
    }
    let line = if line.len() == 1 {
        Layer::points(line, Marker::Circle).coloured(Colour::Statistical)
    } else {
        Layer::line(line).coloured(Colour::Statistical).dashed(Dash::Solid)
    };
    plot.with(line.named("statistical − deterministic"))
}

/// Margin of the load axis at both ends, as a ratio.
const MARGIN: f64 = 1.3;

/// How much of the axis is shown at least, in accepted differences.
const VIEW: f64 = 1.5;

fn megapascals(pressure: f64) -> f64 {
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
