//! The boundary element reference: its results load by load, the contact at one load, and the distribution of pressures.

use asperity::bem::Boundary;
use asperity::compare::{Kind, ReferenceCurve, ReferencePoint, ValidRange};
use asperity_framework::report::format::{count, input_quantity, number, percent, quantity};
use asperity_framework::report::page::{Page, escape};
use asperity_plot::{Axis, Colour, ColourMap, Figure, Layer, Marker, Plot, Raster};

use super::names::under;
use crate::kind::compare::answers::CaseResults;
use crate::kind::compare::reference::{ContactView, Part};
use crate::kind::compare::results::{CompareResults, ReferenceMetadata, SurfaceResults};
use crate::surface::section::length_unit;

/// The section on one surface; nothing where no reference was run.
pub fn section(page: &mut Page, results: &CompareResults, found: &SurfaceResults) {
    let Some(metadata) = &results.reference else { return };
    let cases = ReferenceCase::all(found);
    let Some(first) = cases.first().map(|on| on.curve) else { return };
    page.details(2, &format!("{}: the reference", found.surface.name), |page| {
        write(page, results, found, metadata, &cases, first);
    });
}

fn write(
    page: &mut Page,
    results: &CompareResults,
    found: &SurfaceResults,
    metadata: &ReferenceMetadata,
    cases: &[ReferenceCase],
    first: &ReferenceCurve,
) {
    page.paragraph(&method(metadata, found, first));
    let mut lines: Vec<String> =
        metadata.elastic.iter().map(|case| format!("{}.", escape(&case.to_string()))).collect();
    lines.extend(interpolated(first));
    lines.extend(cases.iter().filter_map(|on| unreached(results, on.case, on.curve)));
    page.bullets(lines);
    let points = found.surface.map.as_ref().map_or([0; 2], |map| map.points);
    let all_points = points.iter().map(|&count| (count * metadata.refine) as f64).product();
    table(page, results, cases, all_points);
    /// More contacts, as of many thicknesses, are left to the tables.
    const MOST_VIEWS: usize = 4;
    for (index, view) in found.contacts.iter().take(MOST_VIEWS).enumerate() {
        let name = if found.contacts.len() == 1 { String::new() } else { format!("-{}", index + 1) };
        contact_figures(page, results, found, view, &name);
    }
}

/// What is said of a case where there is nothing beside the reference.
pub fn alone_sentence(case: &CaseResults) -> String {
    let points = case.reference.iter().flat_map(|curve| &curve.points);
    let mut points: Vec<&ReferencePoint> = points.collect();
    points.sort_by(|a, b| a.pressure.total_cmp(&b.pressure));
    let at = |point: &&ReferencePoint| {
        let separation = point.separation_over_sigma.map(|h| format!(" and a separation of {} σ", number(h)));
        format!(
            "a real contact area of {} of the nominal one{} at {}",
            percent(point.area_ratio),
            separation.unwrap_or_default(),
            input_quantity(point.pressure, "Pa")
        )
    };
    let found = match &points[..] {
        [] => "no load was solved".to_owned(),
        [only] => at(only),
        [first, .., last] => format!("{}, {}", at(first), at(last)),
    };
    format!("the reference alone was run: {found}.")
}

/// The same of each surface where several thicknesses are compared.
pub fn alone(results: &CompareResults) -> impl Iterator<Item = String> {
    let is_alone = |found: &&SurfaceResults| {
        models(&ReferenceCase::all(found)).is_empty() && results.reference.is_some()
    };
    results.surfaces.iter().filter(is_alone).map(|found| {
        format!(
            "**{}**: the reference alone was run, so that no models are compared.",
            escape(&found.surface.name)
        )
    })
}

/// A case with a reference.
struct ReferenceCase<'a> {
    case: &'a CaseResults,
    curve: &'a ReferenceCurve,
    /// Where the models are valid.
    valid: &'a ValidRange,
}

impl<'a> ReferenceCase<'a> {
    fn all(found: &'a SurfaceResults) -> Vec<Self> {
        let cases = found.first.cases.iter().zip(&found.findings.cases);
        let referred = cases.filter_map(|(case, findings)| {
            Some(Self { case, curve: case.reference.as_ref()?, valid: &findings.verdicts.valid })
        });
        referred.collect()
    }

    /// The loads, ascending, each once.
    fn points(&self) -> Vec<&'a ReferencePoint> {
        let mut points: Vec<&ReferencePoint> = self.curve.points.iter().collect();
        points.sort_by(|a, b| a.pressure.total_cmp(&b.pressure));
        points.dedup_by_key(|point| point.pressure);
        points
    }

    /// Whether the models are valid at a load (Pa).
    fn is_valid_at(&self, load: f64) -> bool {
        self.valid.stretches.iter().any(|[from, to]| (*from..=*to).contains(&load))
    }
}

/// What was solved.
fn method(metadata: &ReferenceMetadata, found: &SurfaceResults, curve: &ReferenceCurve) -> String {
    let points = found.surface.map.as_ref().map_or([0; 2], |map| map.points);
    let [nx, ny] = points;
    let map = if metadata.refine > 1 {
        let [finer_x, finer_y] = points.map(|points| points * metadata.refine);
        format!(
            "the map of the models ({nx} × {ny} points, levelled and filtered), interpolated to {finer_x} × {finer_y} points by its own waves"
        )
    } else {
        format!("the map of the models ({nx} × {ny} points, levelled and filtered)")
    };
    let is_measured = found.surface.map.as_ref().is_some_and(|map| map.generation.is_none());
    let boundary = match curve.boundary {
        Boundary::Periodic if is_measured => {
            "The map is continued periodically: steps at the edges of a measured map touch first (`boundary = \"mirrored\"` has none)."
        }
        Boundary::Periodic => "The map is continued periodically.",
        Boundary::Mirrored => "Beyond its edges the map is continued by its mirror images.",
        Boundary::Finite => {
            "The map is a patch on a half-space: its mean gap includes the compliance of the patch and the pressure at the edges of a \
             rigid flat, so that separation and stiffness do not compare with those of the models and are left out."
        }
    };
    let is_single = found.others.is_empty();
    let separation = match curve.boundary {
        Boundary::Finite => "",
        _ => {
            "The separation is the mean gap, zero at points in contact, less the height of the plane that the models measure from above \
             the mean plane. "
        }
    };
    format!(
        "Boundary elements on {map}, boundary `{}`, with the same bodies and without asperities: the rough surface deforms as a whole, so that contacts interact and merge. {boundary} The solution at each load \
         has a relative dual gap of at most {:e}. {separation}The area is corrected for the perimeter of the contacts. Steps and \
         convolutions: `reference.csv`.{}",
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
    Some(format!(
        "{}: no reference from {} on, since no contact carries more than {}.",
        escape(&case_name(results, case)),
        quantity(lowest, "Pa"),
        quantity(curve.cap?, "Pa"),
    ))
}

/// "law zmc", with the layer where there is one.
fn case_name(results: &CompareResults, case: &CaseResults) -> String {
    let layer = results.contact.layer.as_ref().zip(case.thickness);
    let layer = layer.map_or_else(String::new, |(layer, thickness)| format!(", {}", under(layer, thickness)));
    format!("law {}{layer}", case.law)
}

/// The models that were run in some case.
fn models(cases: &[ReferenceCase]) -> Vec<Kind> {
    let is_run = |kind: &Kind| {
        cases.iter().any(|on| on.case.comparison.curves.iter().any(|point| point.kind == *kind))
    };
    [Kind::Statistical, Kind::Deterministic].into_iter().filter(is_run).collect()
}

/// Points in contact below which an area is a matter of single points.
const FEW_POINTS: f64 = 100.0;

/// Both models and the reference at the loads of the reference; `all_points` of its grid.
fn table(page: &mut Page, results: &CompareResults, cases: &[ReferenceCase], all_points: f64) {
    let kinds = models(cases);
    let has_several = cases.len() > 1;
    let of_each = |quantity: &str| {
        let short = |kind: &Kind| if *kind == Kind::Statistical { "stat." } else { "det." };
        let mut names: Vec<String> = kinds.iter().map(|kind| format!("{quantity} {}", short(kind))).collect();
        names.push(format!("{quantity} ref."));
        names
    };
    let mut header: Vec<String> = has_several.then(|| "case".to_owned()).into_iter().collect();
    header.push("p".to_owned());
    header.extend(of_each("A/A_nom"));
    header.push("points in contact".to_owned());
    header.extend(of_each("d/σ"));
    header.extend(["at the cap", "dual gap"].map(str::to_owned));
    let rows = cases.iter().flat_map(|on| {
        let name = has_several.then(|| case_name(results, on.case));
        let kinds = &kinds;
        on.points().into_iter().map(move |point| {
            let mut cells: Vec<String> = name.clone().into_iter().collect();
            cells.extend(row(on, point, kinds, all_points));
            cells
        })
    });
    page.table(header, rows);
    let mark = if kinds.is_empty() { "" } else { "\\* Beyond the valid range of the models. " };
    page.paragraph(&format!(
        "{mark}Points in contact: share of the points, before the correction for the perimeter; † fewer than {FEW_POINTS} points, so that \
         the area depends on the grid. At the cap: share of the points in contact that carry the largest pressure.",
    ));
}

/// One load.
fn row(on: &ReferenceCase, point: &ReferencePoint, kinds: &[Kind], all_points: f64) -> Vec<String> {
    let shown = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), number);
    let is_valid = kinds.is_empty() || on.is_valid_at(point.pressure);
    let models: Vec<Option<[f64; 2]>> =
        kinds.iter().map(|&kind| of_model(on.case, kind, point.pressure)).collect();
    let of_models = |index: usize| models.iter().map(move |values| shown(values.map(|values| values[index])));
    let capped = on.curve.cap.filter(|_| point.raw_area_ratio > 0.0);
    let capped = capped.map(|_| percent(point.capped_area_ratio / point.raw_area_ratio));
    let mut cells =
        vec![format!("{}{}", input_quantity(point.pressure, "Pa"), if is_valid { "" } else { " *" })];
    cells.extend(of_models(0));
    let is_coarse = point.raw_area_ratio * all_points < FEW_POINTS;
    let in_contact = format!("{}{}", number(point.raw_area_ratio), if is_coarse { " †" } else { "" });
    cells.extend([number(point.area_ratio), in_contact]);
    cells.extend(of_models(1));
    cells.extend([
        shown(point.separation_over_sigma),
        capped.unwrap_or_else(|| "–".to_owned()),
        number(point.error),
    ]);
    cells
}

/// Area ratio and d/sigma of a model at a load (Pa).
pub(super) fn of_model(case: &CaseResults, kind: Kind, load: f64) -> Option<[f64; 2]> {
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
fn contact_figures(
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
        Some(cap) => format!("contact pressure at most {}", quantity(cap, "Pa")),
    };
    let at = format!("{} ({material}{layer})", input_quantity(view.load, "Pa"));
    let title = format!("{}{layer}, {material}, {}", found.surface.name, input_quantity(view.load, "Pa"));
    let part = if view.part.is_whole {
        "The map."
    } else {
        "A part of the map with the same share of points in contact as the whole."
    };
    let summits = view.sum.as_ref().map_or_else(String::new, |sum| {
        format!(
            " {} of the {} asperities in contact in the sum (law {}) touch in the reference too (rings; the others: crosses); {} of the points \
             in contact lie in patches without any of them.",
            count(sum.touched),
            count(sum.count),
            escape(&sum.law),
            percent(sum.without),
        )
    });
    page.figure(
        &format!("{}-reference-contact{name}.svg", found.surface.name),
        contact(view, &title),
        &format!(
            "Contact pressure of the reference at {at}, where {} of the points are in contact; colours end at {HIGHEST} mean contact pressures or the largest \
             pressure. {part}{summits}",
            percent(view.raw_area_ratio),
        ),
    );
    page.figure(
        &format!("{}-reference-pressures{name}.svg", found.surface.name),
        pressures(view, &title),
        &format!(
            "Distribution of the contact pressure at {at}, over its mean {}. An elastic pressure falls to zero at the edge of a contact; that \
             the density does not is due to the grid.",
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
