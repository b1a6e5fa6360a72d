//! The boundary element reference: its results load by load, a look at the contact, and the distribution of pressures.

use asperity::bem::Boundary;
use asperity::compare::{Kind, ReferenceCurve, ReferencePoint};
use asperity_framework::report::format::{count, input_quantity, number, percent, quantity};
use asperity_framework::report::page::{Page, escape};
use asperity_plot::{Axis, Colour, ColourMap, Layer, Marker, Plot, Raster};

use super::names::under;
use crate::kind::compare::answers::CaseResults;
use crate::kind::compare::reference::{ContactView, Part};
use crate::kind::compare::results::{CompareResults, ReferenceMetadata, SurfaceResults};
use crate::surface::section::length_unit;

/// The section on one surface; nothing where no reference was run.
pub fn section(page: &mut Page, results: &CompareResults, found: &SurfaceResults) {
    let Some(metadata) = &results.reference else { return };
    let cases: Vec<(&CaseResults, &ReferenceCurve)> =
        found.first.cases.iter().filter_map(|case| Some((case, case.reference.as_ref()?))).collect();
    let Some((_, first)) = cases.first() else { return };
    page.heading(2, &format!("{}: the reference", found.surface.name));
    page.paragraph(&method(metadata, found, first));
    let mut lines: Vec<String> =
        metadata.elastic.iter().map(|case| format!("{}.", escape(&case.to_string()))).collect();
    lines.extend(interpolated(first));
    lines.extend(cases.iter().filter_map(|(case, curve)| unreached(results, case, curve)));
    page.bullets(lines);
    table(page, results, found, &cases);
    /// More contacts, as of many thicknesses, are left to the tables.
    const MOST_VIEWS: usize = 4;
    for (index, view) in found.contacts.iter().take(MOST_VIEWS).enumerate() {
        let name = if found.contacts.len() == 1 { String::new() } else { format!("-{}", index + 1) };
        look(page, results, found, view, &name);
    }
}

/// What was solved.
fn method(metadata: &ReferenceMetadata, found: &SurfaceResults, curve: &ReferenceCurve) -> String {
    let points = found.surface.map.as_ref().map_or([0; 2], |map| map.points);
    let [nx, ny] = points.map(|points| points * metadata.refine);
    let boundary = match curve.boundary {
        Boundary::Periodic => "The map is continued periodically.",
        Boundary::Mirrored => "Beyond its edges the map is continued by its mirror images.",
        Boundary::Finite => {
            "The map is a patch on a half-space: its mean gap includes the compliance of the patch and the pressure at the edges of a \
             rigid flat, so that separation and stiffness do not compare with those of the models and are left out."
        }
    };
    let is_single = found.others.is_empty();
    format!(
        "Boundary elements on the same map as the models ({nx} × {ny} points, levelled and filtered, boundary `{}`) and the same bodies, \
         without asperities: the rough surface deforms as a whole, so that contacts interact and merge. {boundary} The solution at each load \
         has a relative dual gap of at most {:e}. The separation is the mean gap, zero at points in contact, less the height of the plane \
         that the models measure from above the mean plane; the area is corrected for the perimeter of the contacts. Error of \
         discretisation, steps and convolutions: `reference.csv`.{}",
        curve.boundary.name(),
        metadata.error,
        if is_single { "" } else { " Shown: the first realisation." },
    )
}

fn interpolated(curve: &ReferenceCurve) -> Option<String> {
    (curve.interpolated > 0).then(|| {
        let unit = if curve.interpolated == 1 { "missing point was" } else { "missing points were" };
        format!("{} {unit} interpolated for the reference alone.", count(curve.interpolated))
    })
}

/// The loads that no contact carries.
fn unreached(results: &CompareResults, case: &CaseResults, curve: &ReferenceCurve) -> Option<String> {
    let lowest = curve.unreached.iter().copied().reduce(f64::min)?;
    let cap = curve.cap?;
    Some(format!(
        "{}: {} of its loads, from {}, are at or above the largest contact pressure, {}, which no contact carries.",
        escape(&case_name(results, case)),
        curve.unreached.len(),
        quantity(lowest, "Pa"),
        quantity(cap, "Pa"),
    ))
}

/// "law zmc", with the layer where there is one.
fn case_name(results: &CompareResults, case: &CaseResults) -> String {
    let layer = results.contact.layer.as_ref().zip(case.thickness);
    let layer = layer.map_or_else(String::new, |(layer, thickness)| format!(", {}", under(layer, thickness)));
    format!("law {}{layer}", case.law)
}

/// Both models and the reference at the loads of the reference.
fn table(
    page: &mut Page,
    results: &CompareResults,
    found: &SurfaceResults,
    cases: &[(&CaseResults, &ReferenceCurve)],
) {
    let kinds: Vec<Kind> = [Kind::Statistical, Kind::Deterministic]
        .into_iter()
        .filter(|&kind| {
            cases.iter().any(|(case, _)| case.comparison.curves.iter().any(|point| point.kind == kind))
        })
        .collect();
    let short = |kind: &Kind| if *kind == Kind::Statistical { "stat." } else { "det." };
    let has_several = cases.len() > 1;
    let mut header = Vec::new();
    if has_several {
        header.push("case".to_owned());
    }
    header.push("p".to_owned());
    for quantity in ["A/A_nom", "d/σ"] {
        header.extend(kinds.iter().map(|kind| format!("{quantity} {}", short(kind))));
        header.push(format!("{quantity} ref."));
        if quantity == "A/A_nom" {
            header.push("points in contact".to_owned());
        }
    }
    header.extend(["at the cap".to_owned(), "dual gap".to_owned()]);
    let rows = cases.iter().flat_map(|(case, curve)| {
        let mut points: Vec<&ReferencePoint> = curve.points.iter().collect();
        points.sort_by(|a, b| a.pressure.total_cmp(&b.pressure));
        points.dedup_by_key(|point| point.pressure);
        let kinds = &kinds;
        points.into_iter().map(move |point| {
            let mut row = Vec::new();
            if has_several {
                row.push(case_name(results, case));
            }
            let mark = if is_valid_at(found, case, point.pressure) { "" } else { " *" };
            row.push(format!("{}{mark}", input_quantity(point.pressure, "Pa")));
            let models: Vec<Option<[f64; 2]>> =
                kinds.iter().map(|&kind| of_model(case, kind, point.pressure)).collect();
            let shown = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), number);
            row.extend(models.iter().map(|values| shown(values.map(|values| values[0]))));
            row.extend([number(point.area_ratio), number(point.raw_area_ratio)]);
            row.extend(models.iter().map(|values| shown(values.map(|values| values[1]))));
            row.push(shown(point.separation_over_sigma));
            row.push(if curve.cap.is_some() {
                percent(point.capped_area_ratio / point.raw_area_ratio.max(f64::MIN_POSITIVE))
            } else {
                "–".to_owned()
            });
            row.push(number(point.error));
            row
        })
    });
    page.table(header, rows);
    page.paragraph(
        "\\* Beyond the valid range of the models. Points in contact: share of the points of the map, before the correction for the \
         perimeter. At the cap: share of the points in contact that carry the largest pressure.",
    );
}

fn is_valid_at(found: &SurfaceResults, case: &CaseResults, load: f64) -> bool {
    let cases = found.first.cases.iter().zip(&found.findings.cases);
    let mut findings = cases.filter(|(one, _)| std::ptr::eq(*one, case));
    let is_within = |[from, to]: &[f64; 2]| (*from..=*to).contains(&load);
    findings.all(|(_, findings)| findings.verdicts.valid.stretches.iter().any(is_within))
}

/// Area ratio and d/sigma of a model at a load (Pa).
fn of_model(case: &CaseResults, kind: Kind, load: f64) -> Option<[f64; 2]> {
    let pair =
        case.comparison.pairs.iter().find(|pair| case.reference_of(pair).is_some() && pair.target == load);
    let of_pair = pair.map(|pair| match kind {
        Kind::Statistical => &pair.statistical,
        Kind::Deterministic => &pair.deterministic,
    });
    let mut curves = case.comparison.curves.iter().filter(|point| point.kind == kind);
    let is_there = |response: &asperity::Response| response.pressure.total() == load;
    let own = || {
        let point =
            curves.find(|point| point.prescribed_pressure == Some(load) || is_there(&point.response))?;
        Some(&point.response)
    };
    let response = of_pair.or_else(own)?;
    Some([response.area_ratio.total(), response.separation_over_sigma])
}

/// The contact at one load, and its distribution of pressures.
fn look(page: &mut Page, results: &CompareResults, found: &SurfaceResults, view: &ContactView, name: &str) {
    let layer = results.contact.layer.as_ref().zip(view.thickness);
    let layer = layer.map_or_else(String::new, |(layer, thickness)| format!(", {}", under(layer, thickness)));
    let material = match view.cap {
        None => "elastic".to_owned(),
        Some(cap) => format!("contact pressure at most {}", quantity(cap, "Pa")),
    };
    let at = format!("{} ({material}{layer})", input_quantity(view.load, "Pa"));
    let part =
        if view.part.is_whole { "The map." } else { "A part of the map with the contact area of the whole." };
    let summits = view.sum.as_ref().map_or_else(String::new, |sum| {
        let missed = sum.count - sum.touched;
        format!(
            " Of {} asperities in contact in the sum (law {}) on the whole map, {} touch in the reference too (rings) and {} do not \
             (crosses).",
            count(sum.count),
            escape(&sum.law),
            count(sum.touched),
            count(missed),
        )
    });
    page.figure(
        &format!("{}-reference-contact{name}.svg", found.surface.name),
        contact(view),
        &format!(
            "Contact pressure of the reference at {at}, where {} of the points are in contact. {part}{summits}",
            percent(view.raw_area_ratio),
        ),
    );
    page.figure(
        &format!("{}-reference-pressures{name}.svg", found.surface.name),
        pressures(view),
        &format!(
            "Distribution of the contact pressure at {at}, over its mean {}.",
            quantity(view.mean_pressure, "Pa")
        ),
    );
}

/// The pressures on a part of the map, and the asperities that the sum has in contact.
fn contact(view: &ContactView) -> String {
    const GIGA: f64 = 1e9;
    let Part { corner, sides, points: [nx, ny], pressures, .. } = &view.part;
    let (length, unit) = length_unit(sides[0].max(sides[1]));
    // An image has x fastest, a map y.
    let values = (0..*ny).flat_map(|iy| (0..*nx).map(move |ix| pressures[ix * ny + iy] / GIGA)).collect();
    let ends = [0, 1].map(|axis| (corner[axis] / length, (corner[axis] + sides[axis]) / length));
    let axis = |name: &str, (from, to): (f64, f64)| Axis::linear(format!("{name} [{unit}]")).range(from, to);
    let mut plot = Plot::new("Contact pressure", axis("x", ends[0]), axis("y", ends[1]))
        .height(560.0)
        .equal_aspect()
        .with(Layer::raster(Raster {
            x: ends[0],
            y: ends[1],
            columns: *nx,
            rows: *ny,
            values,
            map: ColourMap::Sequential,
            limits: Some((0.0, view.cap.unwrap_or(HIGHEST * view.mean_pressure) / GIGA)),
            label: "contact pressure [GPa]".to_owned(),
        }));
    let Some(sum) = &view.sum else { return plot.svg() };
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
    plot.svg()
}

/// Upper end of the colours of an elastic contact, in mean contact pressures.
const HIGHEST: f64 = 3.0;

fn pressures(view: &ContactView) -> String {
    let edges: Vec<f64> = (0..=view.density.len()).map(|k| k as f64 * view.bin).collect();
    let mut plot = Plot::new(
        "Distribution of contact pressure",
        Axis::linear("contact pressure over its mean"),
        Axis::linear("density of points in contact"),
    )
    .with(Layer::bars(&edges, &view.density).coloured(Colour::Reference).named("reference"));
    if let Some(cap) = view.cap {
        plot = plot.with(Layer::at_x(cap / view.mean_pressure, "largest pressure"));
    }
    plot.svg()
}
