//! The page: which results have a limit, then surface by surface figures and views of the tables, then the criterion.

use asperity::compare::{Cause, ComparedQuantity};
use asperity_contact_framework::metadata::{ContactSummary, Metadata};
use asperity_contact_framework::report::format::{capitalised, input_quantity, signed};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Reading, Table, Tables};
use asperity_contact_framework::report::view::View;
use asperity_contact_framework::{Outcome, fields};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};
use serde_json::{Map, Value, json};

use super::results::{
    Asperities, Gap, IntervalResults, QUANTITIES, Scale, ScaleResults, Series, SurfaceResults, TrendQuantity,
    Variation, gaps, main_load,
};
use super::rows::{GapRow, LeadRow, LimitRow, ScaleRow, tables};
use super::run::{Convergence, Trend};
use crate::presentation::{cause_colour, quantity_name};
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
                asperities(surface),
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
        if let Some(figure) = gap(series, load) {
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

const MICRO: f64 = 1e6;
const HEIGHT: f64 = 360.0;

fn axis<'a>(all: impl IntoIterator<Item = &'a Series>, label: &str) -> Axis {
    /// Margin at both ends of an axis, as a ratio.
    const MARGIN: f64 = 1.3;
    let lengths = all.into_iter().flat_map(|series| series.scales.iter().map(|scale| MICRO * scale.length));
    let [low, high] =
        lengths.fold([f64::INFINITY, 0.0], |[low, high], at| [f64::min(low, at), f64::max(high, at)]);
    Axis::log(label).range(low / MARGIN, high * MARGIN)
}

/// Density and radii on logarithmic axes.
pub fn asperities(surface: &SurfaceResults) -> Figure {
    let plot = |title: &str, label: &str| {
        let lengths = axis(&surface.series, "sampling interval or nesting index (µm)");
        Plot::new(title, lengths, Axis::log(label)).height(HEIGHT).legend(Legend::Below)
    };
    let with = |plot: Plot, (colour, marker, name), value: fn(&Asperities) -> f64| {
        surface.series.iter().fold(plot, |plot, series| {
            let (variation, dash) = match series.variation {
                Variation::Interval => ("sampling interval", Dash::Solid),
                Variation::Filter => ("S filter", Dash::Dashed),
            };
            let point = |(scale, results): (&Scale, &ScaleResults)| {
                (MICRO * scale.length, value(&results.asperities))
            };
            let points: Vec<(f64, f64)> = series.results().map(point).collect();
            let name = format!("{name}{variation}");
            plot.with(Layer::line(points.clone()).coloured(colour).dashed(dash).named(name.clone()))
                .with(Layer::points(points, marker).coloured(colour).named(name))
        })
    };
    let mean = (Colour::Series(0), Marker::Circle, "mean, ");
    let curvature = (Colour::Series(1), Marker::Square, "1/(mean curvature), ");
    let density = (Colour::Series(0), Marker::Circle, "");
    let density =
        with(plot("Asperity density", "density (1/µm²)"), density, |all| all.density / (MICRO * MICRO));
    let radii = with(plot("Radii", "radius (µm)"), mean, |all| MICRO * all.statistics.mean_radius);
    let radii = with(radii, curvature, |all| MICRO * all.statistics.radius_of_mean_curvature);
    Figure::row("Asperities against the length that is varied", vec![density, radii])
}

/// The gap in separation and area and its parts; `None` where fewer than two lengths are admissible.
pub fn gap(series: &Series, load: usize) -> Option<Figure> {
    let panels: Vec<Plot> =
        QUANTITIES.into_iter().filter_map(|quantity| panel(series, load, quantity)).collect();
    (!panels.is_empty()).then(|| Figure::row("Gap between the models and its parts", panels))
}

fn panel(series: &Series, load: usize, quantity: ComparedQuantity) -> Option<Plot> {
    const GAP: &str = "statistical − deterministic";
    let gaps = gaps(series, load, quantity);
    if gaps.len() < 2 {
        return None;
    }
    let over_length = |y: &dyn Fn(&Gap) -> Option<f64>| {
        gaps.iter().filter_map(|gap| Some((MICRO * gap.length, y(gap)?))).collect::<Vec<(f64, f64)>>()
    };
    let lengths: Vec<f64> = gaps.iter().map(|gap| MICRO * gap.length).collect();
    let parts = Cause::ALL.map(|cause| {
        gaps.iter().map(|gap| gap.parts.map_or(f64::NAN, |parts| parts.part(cause))).collect::<Vec<f64>>()
    });
    let stacked = Cause::ALL.into_iter().zip(&parts);
    let stacked = stacked.map(|(cause, part)| (cause.label(), cause_colour(cause), &part[..]));
    let x = axis([series], &format!("{} (µm)", series.variation.label()));
    let y = match quantity {
        ComparedQuantity::Separation => "separation (σ)",
        _ => "ln(area ratio of the models)",
    };
    let mut plot = Plot::new(capitalised(quantity_name(quantity)), x, Axis::linear(y))
        .height(HEIGHT)
        .legend(Legend::Below)
        .with_contributions(&lengths, stacked)
        .with_zero();
    for end in [0, 1] {
        let ends = over_length(&|gap| Some(gap.difference.interval()?[end]));
        if !ends.is_empty() {
            let line = Layer::line(ends).coloured(Colour::Sum).dashed(Dash::Dashed).thin();
            plot = plot.with(line.named("95 % interval"));
        }
    }
    let line = over_length(&|gap| Some(gap.difference.contrast));
    Some(
        plot.with(Layer::line(line.clone()).coloured(Colour::Sum).thick().named(GAP))
            .with(Layer::points(line, Marker::Circle).coloured(Colour::Sum).named(GAP)),
    )
}
