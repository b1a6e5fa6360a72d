//! The page: which results have a limit, then surface by surface figures and views of the tables, then the criterion.

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{input_quantity, quantity, signed};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Reading, Table, Tables};
use asperity_contact_framework::report::view::View;
use asperity_contact_framework::{Outcome, fields};
use serde_json::{Map, Value, json};

use super::figures;
use super::findings::main_load;
use super::quantity::TrendQuantity;
use super::results::{IntervalResults, QUANTITIES, Series, SurfaceResults, Variation};
use super::rows::{GapRow, LeadRow, LimitRow, ScaleRow, tables};
use super::trend::Trend;
use crate::presentation::{limits_note, quantity_name};
use crate::surface::fitness::in_short;
use crate::surface::{section, warnings};

impl Outcome for IntervalResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        let mut lines = warnings(self.surfaces.iter().map(|surface| &surface.surface));
        lines.extend(self.implausible.iter().chain(&self.contact.caveats).cloned());
        lines
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        let answers =
            |variation| self.surfaces.iter().filter_map(move |surface| answer(self, surface, variation));
        answers(Variation::Interval).for_each(|line| {
            page.lead(&line);
        });
        page.bullets(answers(Variation::Filter));
        sections::warnings(&mut page, &self.warnings());
        for surface in &self.surfaces {
            surface_section(&mut page, tables, self, surface);
        }
        page.heading(2, "What is called a limit").note(include_str!("notes/criterion.md"));
        sections::notes(&mut page, &self.metadata);
        sections::what_was_run(&mut page, &self.metadata, &self.contact);
        page.paragraph(&format!("Law {}.", escape(&self.law)));
        limits_note(&mut page);
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let mut facts = fields(&ContactSummary::new(&self.contact))?;
        facts.insert("law".to_owned(), json!(self.law));
        Ok(facts)
    }
}

/// Which of the main quantities have a limit on a surface that is varied so; for a map that is not fit, why, once.
fn answer(results: &IntervalResults, surface: &SurfaceResults, variation: Variation) -> Option<String> {
    if surface.surface.is_blocked() {
        return (variation == Variation::Interval)
            .then(|| format!("**{}**: {}", escape(&surface.surface.name), in_short(&surface.surface)[0]));
    }
    let series = surface.series.iter().find(|series| series.variation == variation)?;
    Some(outcomes(series, main_load(surface, &results.loads).map(|load| results.loads[load])))
}

/// "**ground, sampling interval from 2 µm to 1 µm**: density +24 % (approaching); mean radius -41 % (no limit)."
fn outcomes(series: &Series, load: Option<f64>) -> String {
    const MAIN: [TrendQuantity; 3] =
        [TrendQuantity::Density, TrendQuantity::MeanRadius, TrendQuantity::DeterministicArea];
    let item = |trend: &Trend| {
        let change = signed((100.0 * trend.quantity.relative(trend.change).unwrap_or(trend.change)).round());
        let at = trend.load.map_or_else(String::new, |load| format!(" at {}", input_quantity(load, "Pa")));
        let [quantity, outcome] =
            [trend.quantity.name(), trend.outcome.name()].map(|name| name.replace('-', " "));
        format!("{quantity}{at} {change} % ({outcome})")
    };
    let is_main =
        |trend: &&Trend| MAIN.contains(&trend.quantity) && (trend.load.is_none() || trend.load == load);
    let main: Vec<&Trend> = series.trends.iter().filter(is_main).collect();
    let mut items: Vec<String> = main.iter().copied().map(item).collect();
    if main.iter().all(|trend| trend.load.is_none()) {
        items.push(
            "deterministic area at loads that are not admissible at one of the three finest lengths"
                .to_owned(),
        );
    }
    let (name, variation) = (escape(&series.surface), series.variation.label());
    match &series.scales[..] {
        [finest, second, ..] if !main.is_empty() => {
            let [from, to] = [second, finest].map(|scale| quantity(scale.length, "m"));
            format!("**{name}, {variation} from {from} to {to}**: {}.", items.join("; "))
        }
        _ => format!("**{name}, {variation}**: no asperities at one of the three finest lengths."),
    }
}

const NO_GAP: &str =
    "The gap between the models is not given: at no length is a load admissible for both models.";

fn surface_section(page: &mut Page, tables: &Tables, results: &IntervalResults, surface: &SurfaceResults) {
    let name = surface.surface.name.as_str();
    let load = main_load(surface, &results.loads);
    let pressure = load.map(|load| results.loads[load]);
    page.heading(2, &format!("Surface {name}"));
    page.figure(
        &format!("{name}-over-length.svg"),
        figures::asperities(surface),
        "Asperity density and radii against the sampling interval (solid) and the nesting index of the S filter (dashed). A straight \
         line is a power law without a limit, a level end towards the left a limit.",
    );
    let limits = tables.view::<LimitRow>().only("surface", name);
    let limits = limits.filter("pressure_pa", |cell| cell.is_empty() || cell.number() == pressure);
    page.heading(3, "Towards the finest length").view(&limits.without(&["remainder", "tolerance"]));
    match load.zip(pressure) {
        Some(load) => gap_section(page, tables, surface, load),
        None => {
            page.paragraph(NO_GAP);
        }
    }
    page.details(3, &format!("{name}: asperities by length"), |page| {
        page.view(&tables.view::<ScaleRow>().only("surface", name));
    });
    page.details(3, &format!("{name}: the surface"), |page| {
        section::section(page, tables, &surface.surface, None);
    });
}

/// The gap between the models at the load of an index and its pressure (Pa).
fn gap_section(page: &mut Page, tables: &Tables, surface: &SurfaceResults, (load, pressure): (usize, f64)) {
    let (name, at) = (surface.surface.name.as_str(), input_quantity(pressure, "Pa"));
    page.heading(3, &format!("Gap between the models at {at}"));
    for quantity in QUANTITIES {
        let leads = tables.view::<LeadRow>().only("surface", name).only("pressure_pa", pressure);
        let leads = leads.only("quantity", quantity.name());
        page.view(&differences_of(leads, quantity, &["smallest_difference", "largest_difference"]));
    }
    for series in &surface.series {
        let variation = series.variation.label();
        let file = if series.variation == Variation::Interval { "interval" } else { "filter" };
        if let Some(figure) = figures::gap(series, load) {
            page.figure(
                &format!("{name}-gap-{file}.svg"),
                figure,
                &format!(
                    "The gap between the models (black, with its 95 % interval) and its parts, stacked, against the {variation}, at {at}."
                ),
            );
        }
    }
    for quantity in QUANTITIES {
        page.details(3, &format!("{name}: gap in {} at {at} by length", quantity_name(quantity)), |page| {
            let gaps = tables.view::<GapRow>().only("surface", name).only("pressure_pa", pressure);
            let gaps = gaps.only("quantity", quantity.name()).without(&["multiple"]);
            page.view(&differences_of(gaps, quantity, &["difference", "low", "high"]));
        });
    }
}

/// Columns of differences in percent of the area, or in σ of the separation.
fn differences_of<'a>(view: View<'a>, quantity: ComparedQuantity, columns: &[&str]) -> View<'a> {
    let is_area = quantity == ComparedQuantity::Area;
    let reading = if is_area { Reading::SignedPercent } else { Reading::Signed };
    columns.iter().fold(view, |view, name| view.read_as(name, reading))
}

#[cfg(test)]
mod tests {
    use super::super::results::Scale;
    use super::super::trend::Point;
    use super::*;

    #[test]
    fn a_line_has_the_outcome_of_every_quantity_that_is_known() {
        let lengths = [1e-6, 2e-6, 4e-6];
        let scale = |&length: &f64| Scale { multiple: 1.0, length, results: Err(String::new()) };
        let series = |variation, trends| {
            let scales = lengths.iter().map(scale).collect();
            Series { surface: "a".into(), variation, scales, trends }
        };
        let trend = |quantity, load, exponent: f64| {
            let point = |&length: &f64| Point { length, value: exponent * length.ln(), without: None };
            let points: Vec<Point> = lengths.iter().map(point).collect();
            Trend::new(quantity, load, &points, &[], 0.05).unwrap()
        };
        let trends = vec![
            trend(TrendQuantity::Density, None, -1.0),
            trend(TrendQuantity::MeanRadius, None, 0.0),
            trend(TrendQuantity::DeterministicArea, Some(1e6), 0.0),
        ];
        let intervals = series(Variation::Interval, trends);
        let line =
            "**a, sampling interval from 2 µm to 1 µm**: density +100 % (no limit); mean radius 0 % (limit)";
        let at_load = format!("{line}; deterministic area at 1 MPa 0 % (limit).");
        assert_eq!(outcomes(&intervals, Some(1e6)), at_load);
        let beyond = "deterministic area at loads that are not admissible at one of the three finest lengths";
        assert_eq!(outcomes(&intervals, None), format!("{line}; {beyond}."));
        let none = series(Variation::Filter, Vec::new());
        let line = "**a, S nesting index**: no asperities at one of the three finest lengths.";
        assert_eq!(outcomes(&none, None), line);
    }
}
