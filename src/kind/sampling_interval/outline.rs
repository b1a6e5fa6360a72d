//! The page: which results have a limit, then surface by surface figures and views of the tables, then the criterion.

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{input_quantity, signed};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Reading, Table, Tables};
use asperity_contact_framework::report::view::View;
use asperity_contact_framework::{Outcome, fields};
use serde_json::{Map, Value, json};

use super::figures;
use super::quantity::TrendQuantity;
use super::results::{IntervalResults, QUANTITIES, Series, SurfaceResults, Variation, main_load};
use super::rows::{GapRow, LeadRow, LimitRow, ScaleRow, tables};
use super::trend::{Convergence, Trend};
use crate::presentation::quantity_name;
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
        page.lead(&answer(self));
        for surface in &self.surfaces {
            let name = &surface.surface.name;
            page.figure(
                &format!("{name}-over-length.svg"),
                figures::asperities(surface),
                &format!(
                    "{name}: asperity density and radii against the sampling interval (solid) and the nesting index of the S filter \
                     (dashed). A straight line is a power law without a limit, a level end towards the left a limit."
                ),
            );
        }
        sections::warnings(&mut page, &self.warnings());
        page.heading(2, "Which results have a limit?");
        let limits = tables.view::<LimitRow>().only("variation", Variation::Interval.name());
        let limits = limits.filter("quantity", |cell| MAIN.iter().any(|main| cell.text() == main.name()));
        page.view(&limits.columns(&["surface", "quantity", "pressure_pa", "relative_change", "outcome"]));
        for surface in &self.surfaces {
            page.details(2, &format!("Surface {}", surface.surface.name), |page| {
                surface_section(page, tables, self, surface);
            });
        }
        sections::notes(&mut page, &self.metadata);
        sections::what_was_run(&mut page, &self.metadata, &self.contact, |page| {
            page.paragraph(&format!(
                "Law {}. Method: [theory](../../docs/theory.md#limits-over-the-sampling-interval).",
                escape(&self.law)
            ));
        });
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

/// What the answer is about.
const MAIN: [TrendQuantity; 3] =
    [TrendQuantity::Density, TrendQuantity::MeanRadius, TrendQuantity::DeterministicArea];

/// On how many surfaces asperities and contact area have a limit, and how much the area still changes.
fn answer(results: &IntervalResults) -> String {
    let fit = || results.surfaces.iter().filter(|surface| !surface.surface.is_blocked());
    let series: Vec<(&Series, Option<f64>)> = fit()
        .filter_map(|surface| {
            let load = main_load(surface, &results.loads).map(|load| results.loads[load]);
            let is_interval = |series: &&Series| series.variation == Variation::Interval;
            Some((surface.series.iter().find(is_interval)?, load))
        })
        .collect();
    let unfit = match results.surfaces.len() - fit().count() {
        0 => None,
        unfit => Some(format!("Of {unfit} surfaces nothing is concluded, because their maps are not fit.")),
    };
    let limits = (!series.is_empty()).then(|| limits(&series));
    limits.into_iter().chain(unfit).collect::<Vec<_>>().join(" ")
}

/// The same of surfaces over their sampling intervals, each with its load.
fn limits(series: &[(&Series, Option<f64>)]) -> String {
    let has_limit = |series: &Series, quantity: TrendQuantity, load: Option<f64>| {
        let is_it = |trend: &&Trend| trend.quantity == quantity && trend.load == load;
        series.trends.iter().find(is_it).map(|trend| trend.outcome == Convergence::Limit)
    };
    let asperities = series.iter().filter(|(series, _)| {
        let [density, radius, _] = MAIN.map(|quantity| has_limit(series, quantity, None));
        density == Some(true) && radius == Some(true)
    });
    let areas = series.iter().filter(|(series, load)| has_limit(series, MAIN[2], *load) == Some(true));
    let changes = series.iter().flat_map(|(series, load)| {
        let at_load = series.trends.iter().filter(|trend| trend.quantity == MAIN[2] && trend.load == *load);
        at_load.filter_map(move |trend| Some((series, trend.load?, trend.quantity.relative(trend.change)?)))
    });
    let largest = changes.max_by(|a, b| a.2.abs().total_cmp(&b.2.abs())).map(|(series, load, change)| {
        format!(
            " The last refinement changes that area by up to {} % ({} at {}).",
            signed((100.0 * change).round()),
            escape(&series.surface),
            input_quantity(load, "Pa")
        )
    });
    let (asperities, areas) = (asperities.count(), areas.count());
    let instrument = if asperities.min(areas) < series.len() {
        " What has no limit belongs to the instrument."
    } else {
        ""
    };
    format!(
        "As the sampling interval shrinks, asperity density and radius are known to have a limit on {asperities} of {} surfaces, the contact \
         area on {areas}.{instrument}{}",
        series.len(),
        largest.unwrap_or_default(),
    )
}

const NO_GAP: &str =
    "The gap between the models is not given: at no length is a load admissible for both models.";

fn surface_section(page: &mut Page, tables: &Tables, results: &IntervalResults, surface: &SurfaceResults) {
    let name = surface.surface.name.as_str();
    let load = main_load(surface, &results.loads);
    let pressure = load.map(|load| results.loads[load]);
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
    fn surfaces_with_a_limit_are_counted() {
        let lengths = [1e-6, 2e-6, 4e-6];
        let scale = |&length: &f64| Scale { multiple: 1.0, length, results: Err(String::new()) };
        let trend = |quantity, load, exponent: f64| {
            let point = |&length: &f64| Point { length, value: exponent * length.ln(), without: None };
            let points: Vec<Point> = lengths.iter().map(point).collect();
            Trend::new(quantity, load, &points, &[], 0.05).unwrap()
        };
        let series = |surface: &str, radius: f64, area: f64| {
            let trends = vec![
                trend(TrendQuantity::Density, None, 0.0),
                trend(TrendQuantity::MeanRadius, None, radius),
                trend(TrendQuantity::DeterministicArea, Some(1e6), area),
            ];
            let scales = lengths.iter().map(scale).collect();
            Series { surface: surface.into(), variation: Variation::Interval, scales, trends }
        };
        let [smooth, rough] = [series("a", 0.0, 0.0), series("b", 0.0, 1.0)];
        assert_eq!(
            limits(&[(&smooth, Some(1e6)), (&rough, Some(1e6))]),
            "As the sampling interval shrinks, asperity density and radius are known to have a limit on 2 of 2 surfaces, the contact area on \
             1. What has no limit belongs to the instrument. The last refinement changes that area by up to -50 % (b at 1 MPa)."
        );
        assert!(!limits(&[(&smooth, Some(1e6))]).contains("instrument"));
        let rough = series("b", 1.0, 0.0);
        let words = limits(&[(&smooth, None), (&rough, None)]);
        assert!(
            words.contains("a limit on 1 of 2 surfaces, the contact area on 0. What has no limit"),
            "{words}"
        );
    }
}
