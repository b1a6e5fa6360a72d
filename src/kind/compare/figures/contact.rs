//! The contact of the reference at one load: its pressures on a part of the map, and their distribution.

use asperity_contact_framework::report::format::{count, input_quantity, percent, quantity};
use asperity_contact_framework::report::page::Page;
use asperity_plot::{Axis, Colour, ColourMap, Figure, Layer, Marker, Plot, Raster};

use crate::kind::compare::names::under;
use crate::kind::compare::reference::{ContactView, Part};
use crate::kind::compare::results::{CompareResults, SurfaceResults};
use crate::surface::section::length_unit;

/// The contact at one load, and its distribution of pressures.
pub fn contact_figures(
    page: &mut Page,
    results: &CompareResults,
    found: &SurfaceResults,
    view: &ContactView,
    name: &str,
) {
    let layer = results.contact.layer.as_ref().zip(view.thickness);
    let layer = layer.map_or_else(String::new, |(layer, thickness)| format!(", {}", under(layer, thickness)));
    let material = match view.cap {
        None => "elastic".to_owned(),
        Some(cap) => format!("capped at {}", quantity(cap, "Pa")),
    };
    let at = format!("{} ({material}{layer})", input_quantity(view.load, "Pa"));
    let title = format!("{}{layer}, {material}, {}", found.surface.name, input_quantity(view.load, "Pa"));
    let part = if view.part.is_whole { "" } else { ", part of the map" };
    let summits = view.sum.as_ref().map_or_else(String::new, |sum| {
        format!(
            " Of {} asperities in contact in the sum ({}), {} touch here (rings; others: crosses).",
            count(sum.count),
            sum.law,
            count(sum.touched),
        )
    });
    page.figure(
        &format!("{}-reference-contact{name}.svg", found.surface.name),
        contact(view, &title),
        &format!(
            "Contact pressure of the reference at {at}{part}; {} of the points touch.{summits}",
            percent(view.raw_area_ratio),
        ),
    );
    page.figure(
        &format!("{}-reference-pressures{name}.svg", found.surface.name),
        pressures(view, &title),
        &format!(
            "Distribution of the contact pressure at {at}, over its mean {}. Near zero it is that of the grid.",
            quantity(view.mean_pressure, "Pa")
        ),
    );
}

/// The pressures on a part of the map, and the asperities that the sum has in contact.
fn contact(view: &ContactView, title: &str) -> Figure {
    const GIGA: f64 = 1e9;
    let Part { corner, sides, points: [nx, ny], pressures, .. } = &view.part;
    let (length, unit) = length_unit(sides[0].max(sides[1]));
    // An image has x fastest, a map y.
    let values = (0..*ny).flat_map(|iy| (0..*nx).map(move |ix| pressures[ix * ny + iy] / GIGA)).collect();
    let ends = [0, 1].map(|axis| (corner[axis] / length, (corner[axis] + sides[axis]) / length));
    let axis = |name: &str, (from, to): (f64, f64)| Axis::linear(format!("{name} ({unit})")).range(from, to);
    let mut plot = Plot::new(format!("Contact pressure: {title}"), axis("x", ends[0]), axis("y", ends[1]))
        .height(480.0)
        .equal_aspect()
        .with(Layer::raster(Raster {
            x: ends[0],
            y: ends[1],
            columns: *nx,
            rows: *ny,
            values,
            map: ColourMap::Sequential,
            limits: Some((0.0, view.cap.unwrap_or(f64::INFINITY).min(HIGHEST * view.mean_pressure) / GIGA)),
            label: "contact pressure (GPa)".to_owned(),
        }));
    let Some(sum) = &view.sum else { return plot.into() };
    for (is_touched, marker, name) in [
        (true, Marker::Ring, "in contact in the sum and in the reference"),
        (false, Marker::Cross, "in contact in the sum only"),
    ] {
        let places = sum.places.iter().filter(|(_, touched)| *touched == is_touched);
        let places: Vec<(f64, f64)> = places.map(|([x, y], _)| (x / length, y / length)).collect();
        if !places.is_empty() {
            plot = plot.with(Layer::points(places, marker).coloured(Colour::Deterministic).named(name));
        }
    }
    plot.into()
}

/// Upper end of the colours in mean contact pressures, unless the largest pressure is below.
const HIGHEST: f64 = 3.0;

fn pressures(view: &ContactView, title: &str) -> Figure {
    let edges: Vec<f64> = (0..=view.density.len()).map(|k| k as f64 * view.bin).collect();
    let mut plot = Plot::new(
        format!("Distribution of contact pressure: {title}"),
        Axis::linear("contact pressure over its mean"),
        Axis::linear("density of points in contact"),
    )
    .with(Layer::bars(&edges, &view.density).coloured(Colour::Reference).named("reference"));
    if let Some(cap) = view.cap {
        plot = plot.with(Layer::at_x(cap / view.mean_pressure, "largest pressure"));
    }
    plot.into()
}
