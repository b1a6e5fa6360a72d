//! Error maps.

use crate::report::plot::{Axis, Colour, ColourMap, Dash, Layer, Plot, Raster};
use crate::stability::Map;

/// log10 of the errors at both ends of the colours: a tenth of a rounding, and a thousand roundings.
const COLOURS: (f64, f64) = (-17.0, -13.0);

/// One map.
pub fn map(map: &Map) -> String {
    let [columns, rows] = map.cells;
    // Outer edges of the outermost cells.
    let edges = |[from, to]: [f64; 2], cells: usize| {
        let half = 0.5 * (to - from) / (cells - 1) as f64;
        (from - half, to + half)
    };
    let [x, y] = [edges(map.ends[0], columns), edges(map.ends[1], rows)];
    let axis = |label: &str, (from, to): (f64, f64)| Axis::linear(label).range(from, to);
    let raster = Raster {
        x,
        y,
        columns,
        rows,
        values: map.errors.iter().map(|error| error.max(1e-30).log10()).collect(),
        map: ColourMap::Sequential,
        limits: Some(COLOURS),
        label: "log₁₀ of the relative error".into(),
    };
    let title = format!("Error of the {}", map.of);
    let mut plot = Plot::new(title, axis(map.axes[0], x), axis(map.axes[1], y)).with(Layer::raster(raster));
    if map.name == "transition" {
        let line = |points: Vec<(f64, f64)>, name: &str| {
            Layer::line(points).coloured(Colour::Neutral).dashed(Dash::Dashed).named(name)
        };
        let end = |y: f64| (10f64.powf(y) + 1.0).log10();
        let (from, to) = y;
        let place = |k: i32| from + (to - from) * f64::from(k) / 200.0;
        plot = plot
            .with(line(vec![(0.0, from), (0.0, to)], "w₁"))
            .with(line((0..=200).map(place).map(|y| (end(y), y)).collect(), "w₂"));
    }
    plot.svg()
}

/// What a map shows.
pub fn caption(map: &Map) -> &'static str {
    match map.name {
        "separation" => {
            "The integral of a bare pair of steels under ZMC. White: no error, or less than a tenth of a rounding; the darkest blue stands for 1e-13 and more."
        }
        "transition" => {
            "One contact of that pair for any ratio c = w₂/w₁. Between w₁ and w₂ the error grows as 1/(c − 1) where c is near 1: the rounding of w₁ \
             itself moves the area so far. Further right the contact is plastic, further left elastic."
        }
        _ => {
            "One contact under a layer a tenth as stiff and as hard as the flat; at the left there is next to no layer, at the right nothing but \
             layer. Steps: regimes."
        }
    }
}
