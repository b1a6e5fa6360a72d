//! Error maps.

use crate::stability::Map;
use asperity_contact_framework::report::format::number;
use asperity_plot::{Axis, Colour, ColourMap, Dash, Figure, Layer, Plot, Raster};

/// log10 of the errors at both ends of the colours: a tenth of a rounding, and a hundred roundings or the worst.
const COLOURS: [f64; 2] = [-17.0, -14.0];

pub fn error_map(map: &Map) -> Figure {
    let [columns, rows] = map.cells;
    // Outer edges of the outermost cells.
    let edges = |axis: usize| {
        let [from, to] = map.ends[axis];
        let half = 0.5 * (to - from) / (map.cells[axis] - 1) as f64;
        (from - half, to + half)
    };
    let (x, y) = (edges(0), edges(1));
    let axis = |label: &str, (from, to): (f64, f64)| Axis::linear(label).range(from, to);
    let worst = map.errors.iter().copied().filter(|error| error.is_finite()).fold(0.0, f64::max);
    let raster = Raster {
        x,
        y,
        columns,
        rows,
        values: map.errors.iter().map(|error| error.max(1e-30).log10()).collect(),
        map: ColourMap::Sequential,
        limits: Some((COLOURS[0], worst.log10().ceil().max(COLOURS[1]))),
        label: "log₁₀ of the relative error".into(),
    };
    let title = format!(
        "Error of the {}: at most {} ({} units of rounding)",
        map.quantity,
        number(worst),
        number((worst / (0.5 * f64::EPSILON)).round())
    );
    let plot = Plot::new(title, axis(map.axes[0], x), axis(map.axes[1], y)).with(Layer::raster(raster));
    let boundary = |plot: Plot, (place, name): &(f64, &str)| {
        let line = Layer::line([(*place, y.0), (*place, y.1)]).coloured(Colour::Neutral);
        plot.with(line.dashed(Dash::Dashed).named(*name))
    };
    let boundaries: &[(f64, &str)] =
        if map.name == "transition" { &[(0.0, "w₁"), (1.0, "w₂ = c w₁")] } else { &[] };
    boundaries.iter().fold(plot, boundary).into()
}

pub fn caption(map: &Map) -> &'static str {
    match map.name {
        "separation" => {
            "Relative error of the integral for steel on steel under ZMC. White: below a tenth of the unit roundoff, or zero."
        }
        "transition" => {
            "Relative error of a single steel contact for any ratio c = w₂/w₁: elastic left of w₁, plastic right of w₂. Between them it \
             grows as 1/(c − 1), by the rounding of w₁ alone."
        }
        _ => {
            "Relative error of a single contact under a layer a tenth as stiff and as hard as the flat, from uncoated (left) to bulk \
             layer material (right). Stripes: elastic (top) and plastic (bottom) contacts."
        }
    }
}
