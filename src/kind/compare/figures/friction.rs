//! Boundary friction against the thickness of a layer.

use asperity::compare::ModelKind;
use asperity::study::FilmFriction;
use asperity_contact_framework::report::format::{input_quantity, number};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

use crate::kind::compare::series::Series;

/// The coefficient of both models, a panel for each load and a colour for each breakdown; nothing where friction is not asked for.
pub fn by_thickness(series: &Series) -> Option<Figure> {
    /// The most loads.
    const MOST: usize = 3;
    let mut loads: Vec<f64> = series.friction.iter().map(|found| found.pressure).collect();
    loads.dedup();
    if loads.is_empty() {
        return None;
    }
    // The ends and the middle.
    let step = (loads.len() - 1).max(1) as f64 / (MOST - 1) as f64;
    let shown: Vec<f64> = if loads.len() <= MOST {
        loads
    } else {
        (0..MOST).map(|k| loads[(step * k as f64).round() as usize]).collect()
    };
    let panels = shown.iter().map(|&load| panel(series, load)).collect();
    Some(Figure::row(format!("{}: coefficient of friction against layer thickness", series.subject), panels))
}

fn panel(series: &Series, load: f64) -> Plot {
    let at_load: Vec<&FilmFriction> =
        series.friction.iter().copied().filter(|found| found.pressure == load).collect();
    let mut breakdowns: Vec<f64> = at_load.iter().map(|found| found.breakdown).collect();
    breakdowns.sort_by(f64::total_cmp);
    breakdowns.dedup();
    let axis = Axis::log("layer thickness (nm)");
    let mut plot = Plot::new(input_quantity(load, "Pa"), axis, Axis::linear("coefficient of friction"));
    for found in at_load {
        let index = breakdowns.iter().position(|one| *one == found.breakdown).unwrap_or(0);
        let colour = Colour::Ordered { index, of: breakdowns.len() };
        let finite = found.points.iter().filter(|(t, _)| *t > 0.0 && t.is_finite());
        let line = Layer::line(finite.map(|&(t, coefficient)| (1e9 * t, coefficient))).coloured(colour);
        plot = if found.kind == ModelKind::Deterministic {
            let least = found.least().filter(|(t, _)| *t > 0.0 && t.is_finite());
            let least: Vec<(f64, f64)> = least.map(|(t, at)| (1e9 * t, at)).into_iter().collect();
            plot.with(line.named(format!("sum, breakdown at w = {} t", number(found.breakdown))))
                .with(Layer::points(least, Marker::Circle).coloured(colour).named("least of the sum"))
        } else {
            let name = format!("integral, w = {} t", number(found.breakdown));
            plot.with(line.dashed(Dash::Dashed).named(name))
        };
    }
    plot
}
