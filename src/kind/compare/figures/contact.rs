//! Figures of measured maps: the contact of the reference, what is in contact load by load, differences over the S filter.

use asperity::compare::{ComparedQuantity, Difference};
use asperity::study::{CaseStudy, Treatment};
use asperity_contact_framework::report::format::{capitalised, count, input_quantity, percent, quantity};
use asperity_contact_framework::report::page::Page;
use asperity_plot::{Axis, Colour, ColourMap, Dash, Figure, Frames, Layer, Marker, Patches, Plot, Raster};

use crate::kind::compare::contact_map::{ContactMap, MapPatches};
use crate::kind::compare::reference::{ContactView, Part};
use crate::kind::compare::results::{CompareResults, SurfaceResults};
use crate::kind::compare::series::under;
use crate::presentation::quantity_name;
use crate::surface::section::{length_unit, nth};

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

/// Radius of the smallest circle over the side of the map: smaller ones would not be seen.
const LEAST: f64 = 0.003;

/// Adds the map of the surface `name`.
pub fn add(page: &mut Page, name: &str, map: &ContactMap) {
    let what = what(map);
    let slider = if map.loads.len() > 1 { "; in a browser a slider changes the load" } else { "" };
    let load = quantity(map.loads[map.reported].pressure, "Pa");
    page.figure(
        &format!("{name}-contact-map.svg"),
        figure(name, map),
        &format!("Height map of {name}, and what is {what} at {load}{slider}."),
    );
}

fn what(map: &ContactMap) -> &'static str {
    if map.is_of_sum { "in contact in the sum" } else { "in contact in the boundary elements" }
}

fn figure(name: &str, map: &ContactMap) -> Figure {
    let [nx, ny] = map.heights.points();
    let sides = [0, 1].map(|axis| [nx, ny][axis] as f64 * map.heights.pixel()[axis]);
    let (length, unit) = length_unit(sides[0].max(sides[1]));
    let ends = sides.map(|side| (0.0, side / length));
    // An image has x fastest, a map y.
    let heights: Vec<f64> = (0..ny)
        .flat_map(|iy| (0..nx).map(move |ix| ix * ny + iy))
        .map(|at| map.heights.heights()[at])
        .collect();
    let mut present: Vec<f64> = heights.iter().copied().filter(|z| !z.is_nan()).collect();
    // A few pits and peaks do not take all greys.
    let last = present.len().saturating_sub(1) as f64;
    let [low, high] = [0.005, 0.995].map(|share| nth(&mut present, (share * last) as usize).unwrap_or(0.0));
    let (height, height_unit) = length_unit(low.abs().max(high.abs()));
    let relief = Raster {
        x: ends[0],
        y: ends[1],
        columns: nx,
        rows: ny,
        values: heights.into_iter().map(|z| z / height).collect(),
        map: ColourMap::Relief,
        limits: Some((low / height, high / height)),
        label: format!("height ({height_unit})"),
    };
    let patches = match &map.patches {
        MapPatches::Circles { places, radii } => {
            let least = LEAST * sides[0].max(sides[1]);
            let shown = |radii: &Vec<f64>| radii.iter().map(|radius| radius.max(least) / length).collect();
            let centres = places.iter().map(|[x, y]| (x / length, y / length)).collect();
            Patches::Circles { centres, radii: radii.iter().map(shown).collect() }
        }
        MapPatches::Cells { cells: [columns, rows], covered } => {
            let turned = |one: &Vec<u8>| {
                (0..*rows)
                    .flat_map(|iy| (0..*columns).map(move |ix| ix * rows + iy))
                    .map(|at| one[at])
                    .collect()
            };
            let covered = covered.iter().map(turned).collect();
            Patches::Cells { x: ends[0], y: ends[1], cells: [*columns, *rows], covered }
        }
    };
    let names = map.loads.iter().map(|load| {
        let contacts =
            load.contacts.map_or_else(String::new, |contacts| format!("{} contacts, ", count(contacts)));
        format!("{}: {contacts}{} of the area", quantity(load.pressure, "Pa"), percent(load.area_ratio))
    });
    let frames = Frames { label: "load".to_owned(), names: names.collect(), shown: map.reported, patches };
    let axis = |name: &str, ends: (f64, f64)| Axis::linear(format!("{name} ({unit})")).range(ends.0, ends.1);
    Plot::new(format!("{name}: contacts on the height map"), axis("x", ends[0]), axis("y", ends[1]))
        .height(420.0)
        .equal_aspect()
        .with(Layer::raster(relief))
        .with(Layer::frames(frames).coloured(Colour::Deterministic).named(what(map)))
        .into()
}

/// How much of the axis is shown at least, in accepted differences.
const VIEW: f64 = 1.5;

/// Differences of area and separation against the nesting index; `None` where fewer than two filters gave an answer.
pub fn against_filter(case: &CaseStudy, surface: &SurfaceResults) -> Option<Figure> {
    let own_cut_off = surface.own_cut_off?;
    let verdicts = &case.verdicts;
    let map = surface.surface.map.as_ref()?;
    let pixel = map.pixel[0].max(map.pixel[1]);
    let (unit, scale) = if pixel < 1e-7 { ("nm", 1e9) } else { ("µm", 1e6) };
    let pixel = scale * pixel;
    let mut filtered: Vec<(f64, &[Difference])> = case
        .treated
        .iter()
        .filter_map(|one| match one.treatment {
            Treatment::ShortWaves(s) => Some((s.map_or(pixel, |s| scale * s), &one.differences[..])),
            _ => None,
        })
        .filter(|(_, differences)| !differences.is_empty())
        .collect();
    let has_none =
        own_cut_off.is_none() || case.treated.iter().any(|one| one.treatment == Treatment::ShortWaves(None));
    filtered.push((own_cut_off.map_or(pixel, |s| scale * s), &verdicts.differences));
    filtered.sort_by(|a, b| a.0.total_cmp(&b.0));
    if filtered.len() < 2 {
        return None;
    }
    let examined = case.treated_loads();
    if examined.is_empty() {
        return None;
    }
    let mut shown = vec![examined[0], examined[examined.len() / 2], examined[examined.len() - 1]];
    shown.dedup();
    let ends = [filtered[0].0 / 1.2, filtered[filtered.len() - 1].0 * 1.2];
    let panels = [
        (ComparedQuantity::Area, "difference (%)", 100.0),
        (ComparedQuantity::Separation, "difference (σ)", 1.0),
        (ComparedQuantity::Stiffness, "difference (%)", 100.0),
    ];
    let is_compared = |compared: ComparedQuantity| {
        verdicts.differences.iter().any(|at| at.estimates[compared as usize].is_some())
    };
    let panels = panels.into_iter().filter(|(compared, ..)| is_compared(*compared));
    let along = format!("S filter ({unit})");
    let plots = panels.map(|(compared, label, unit)| {
        let accepted = unit * verdicts.accepted.limit(compared);
        let axis = Axis::log(along.as_str()).range(ends[0], ends[1]);
        let values = filtered.iter().flat_map(|(_, differences)| differences.iter());
        let values = values.filter(|at| shown.contains(&at.load));
        let values =
            values.filter_map(|at| Some(unit * compared.reported(at.estimates[compared as usize]?.contrast)));
        let [low, high] = values.fold([-VIEW * accepted, VIEW * accepted], |[low, high], value| {
            [low.min(value), high.max(value)]
        });
        let room = 0.05 * (high - low);
        let mut plot = Plot::new(
            capitalised(quantity_name(compared)),
            axis,
            Axis::linear(label).range(low - room, high + room),
        )
        .height(210.0)
        .with(Layer::region_y(-accepted, accepted, "accepted").coloured(Colour::Series(2)))
        .with_zero();
        if has_none {
            plot = plot.with(Layer::at_x(pixel, "no filter"));
        }
        for ((place, load), dash) in shown.iter().enumerate().zip([Dash::Solid, Dash::Dashed, Dash::Dotted]) {
            let points = filtered.iter().filter_map(|(s, differences)| {
                let at = differences.iter().find(|at| at.load == *load)?;
                Some((*s, unit * compared.reported(at.estimates[compared as usize]?.contrast)))
            });
            let points: Vec<(f64, f64)> = points.collect();
            let colour = Colour::Series(place);
            plot = plot
                .with(
                    Layer::line(points.clone())
                        .coloured(colour)
                        .dashed(dash)
                        .named(input_quantity(*load, "Pa")),
                )
                .with(Layer::points(points, Marker::Circle).coloured(colour));
        }
        plot
    });
    let title =
        format!("{}: statistical − deterministic model at equal load, by S filter", surface.surface.name);
    Some(Figure::row(title.clone(), plots.collect()).headed(title))
}
