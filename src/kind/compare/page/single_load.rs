//! The answer where the spec asks for one load or one separation: in N, Pa, nm and µm², model by model, and by the reference where it was run.

use asperity::compare::{Control, Kind, ReferencePoint};
use asperity::{Exceeded, Response};
use asperity_framework::report::format::{count, listed, number, percent, quantity};
use asperity_framework::report::page::Page;

use super::names::{subject, under};
use crate::kind::compare::answers::CaseResults;
use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// Whether each model, and the reference, was asked for one point only, so that its curves are points.
pub fn is_single(case: &CaseResults) -> bool {
    let curves = &case.comparison.curves;
    let points = |kind| curves.iter().filter(|point| point.kind == kind).count();
    let of_reference = case.reference.as_ref().map_or(0, |curve| curve.points.len());
    let is_empty = curves.is_empty() && of_reference == 0;
    !is_empty && points(Kind::Statistical) <= 1 && points(Kind::Deterministic) <= 1 && of_reference <= 1
}

/// A table for each surface, law and thickness with one load or one separation; of more than two thicknesses there is a table
/// by load already.
pub fn answers(page: &mut Page, results: &CompareResults) {
    const MOST_THICKNESSES: usize = 2;
    for found in &results.surfaces {
        let cases = &found.first.cases;
        let thicknesses = |law: &str| cases.iter().filter(|case| case.law == law).count();
        let is_shown = |case: &&CaseResults| {
            is_single(case)
                && !case.comparison.curves.is_empty()
                && thicknesses(&case.law) <= MOST_THICKNESSES
        };
        cases.iter().filter(is_shown).for_each(|case| answer(page, results, found, case));
    }
}

fn answer(page: &mut Page, results: &CompareResults, found: &SurfaceResults, case: &CaseResults) {
    let curves = &case.comparison.curves;
    let layer = results.contact.layer.as_ref().zip(case.thickness);
    let layer = layer.map_or_else(String::new, |(layer, thickness)| format!(", {}", under(layer, thickness)));
    let name = subject(results, found, &case.law);
    let at = if curves[0].control == Control::Separation { "separation" } else { "load" };
    page.heading(2, &format!("{name}{layer}: results at this {at}"));
    let area = found.surface.set.nominal_area();
    let responses: Vec<&Response> = curves.iter().map(|point| &point.response).collect();
    let mut header = vec![String::new()];
    header.extend(curves.iter().map(|point| format!("{} model", point.kind.name())));
    if let [_, _] = responses[..] {
        header.push("statistical − deterministic".to_owned());
    }
    let reference = case.reference.as_ref().and_then(|curve| curve.points.first());
    header.extend(reference.map(|_| "reference".to_owned()));
    let cells = |row: &Row| {
        let mut cells = row.cells(&responses, area);
        cells.extend(reference.map(|point| row.shown_or_none((row.of_reference)(point, area))));
        cells
    };
    page.table(header, ROWS.iter().map(cells));
    let exceeded = case.comparison.exceeded().fold(Exceeded::default(), Exceeded::union);
    let limits: Vec<String> = exceeded.limits().map(|limit| limit.name().replace('-', " ")).collect();
    let mut remarks = Vec::new();
    if !limits.is_empty() {
        remarks.push(format!("Beyond the valid range: {}.", listed(&limits)));
    }
    if !found.others.is_empty() {
        remarks.push(format!("First of {} realisations.", found.count()));
    }
    if !remarks.is_empty() {
        page.paragraph(&remarks.join(" "));
    }
}

/// A row of the table: a quantity of a response on a nominal area (m²).
struct Row {
    name: &'static str,
    /// The value; `None` without contact.
    value: fn(&Response, f64) -> Option<f64>,
    /// The same of the reference; `None` where it has none.
    of_reference: fn(&ReferencePoint, f64) -> Option<f64>,
    shown: fn(f64) -> String,
    /// Whether the difference is relative to the deterministic model.
    is_relative: bool,
}

const ROWS: [Row; 9] = [
    Row {
        name: "load",
        value: |r, area| Some(r.pressure.total() * area),
        of_reference: |p, area| Some(p.pressure * area),
        shown: |load| quantity(load, "N"),
        is_relative: true,
    },
    Row {
        name: "nominal pressure",
        value: |r, _| Some(r.pressure.total()),
        of_reference: |p, _| Some(p.pressure),
        shown: |pressure| quantity(pressure, "Pa"),
        is_relative: true,
    },
    Row {
        name: "separation (from the mean asperity height)",
        value: |r, _| Some(r.separation),
        of_reference: |p, _| p.separation,
        shown: |d| format!("{} nm", number(1e9 * d)),
        is_relative: false,
    },
    Row {
        name: "separation in σ",
        value: |r, _| Some(r.separation_over_sigma),
        of_reference: |p, _| p.separation_over_sigma,
        shown: |d| format!("{} σ", number(d)),
        is_relative: false,
    },
    Row {
        name: "real contact area",
        value: |r, area| Some(r.area_ratio.total() * area),
        of_reference: |p, area| Some(p.area_ratio * area),
        shown: |real| format!("{} µm²", number(1e12 * real)),
        is_relative: true,
    },
    Row {
        name: "real contact area, of the nominal",
        value: |r, _| Some(r.area_ratio.total()),
        of_reference: |p, _| Some(p.area_ratio),
        shown: percent,
        is_relative: true,
    },
    Row {
        name: "contacts",
        value: |r, area| Some(r.contact_density * area),
        of_reference: |_, _| None,
        shown: |contacts| {
            // A large number is a count; the integral has fractions of a contact.
            if contacts < 100.0 { number(contacts) } else { count(contacts.round() as usize) }
        },
        is_relative: true,
    },
    Row {
        name: "mean contact pressure",
        value: |r, _| r.mean_real_pressure(),
        of_reference: |p, _| p.mean_real_pressure(),
        shown: |pressure| quantity(pressure, "Pa"),
        is_relative: true,
    },
    Row {
        name: "stiffness",
        value: |r, area| Some(r.stiffness * area),
        of_reference: |p, area| Some(p.stiffness? * area),
        shown: |stiffness| format!("{} N/µm", number(1e-6 * stiffness)),
        is_relative: true,
    },
];

/// Where a quantity does not apply.
const NONE: &str = "–";

impl Row {
    fn shown_or_none(&self, value: Option<f64>) -> String {
        value.map_or_else(|| NONE.to_owned(), self.shown)
    }

    fn cells(&self, responses: &[&Response], area: f64) -> Vec<String> {
        /// A load is met to rounding.
        const ROUNDING: f64 = 1e-9;
        let values: Vec<Option<f64>> =
            responses.iter().map(|response| (self.value)(response, area)).collect();
        let mut cells = vec![self.name.to_owned()];
        cells.extend(values.iter().map(|value| self.shown_or_none(*value)));
        if let [statistical, deterministic] = values[..] {
            let pair = statistical.zip(deterministic);
            cells.push(match pair {
                Some((s, d)) if !self.is_relative => signed((self.shown)((s - d).abs()), s < d),
                Some((s, d)) if d != 0.0 => {
                    let relative = s / d - 1.0;
                    let relative = if relative.abs() < ROUNDING { 0.0 } else { relative };
                    signed(percent(relative.abs()), relative < 0.0)
                }
                _ => NONE.to_owned(),
            });
        }
        cells
    }
}

fn signed(size: String, is_negative: bool) -> String {
    let is_zero = size.starts_with("0 ");
    format!(
        "{}{size}",
        if is_zero {
            ""
        } else if is_negative {
            "−"
        } else {
            "+"
        }
    )
}
