//! The page: which cause leads where, a map for each load, the contributions over the skewness, and all numbers.

use asperity::compare::{Cause, ComparedQuantity, ModelKind, Verdict};
use asperity::topography::fitness::LARGEST_SLOPE;
use asperity_contact_framework::metadata::{ContactSummary, Metadata};
use asperity_contact_framework::report::format::{capitalised, input_quantity, listed, number, signed};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::{Outcome, fields};
use asperity_plot::{Axis as PlotAxis, Colour, Dash, Figure, Layer, Legend, Marker, Plot};
use serde_json::{Map, Value, json};

use super::Axis;
use super::results::{CausesResults, GridPoint, QUANTITIES};
use super::rows::{CauseRow, Findings, LeadRow, NearerCounts, VerdictCounts, tables};
use crate::presentation::{cause_colour, difference_unit, quantity_name};

impl Outcome for CausesResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        let mut warnings = self.contact.caveats.clone();
        warnings.extend(steep(self));
        warnings.extend(strained(self));
        warnings
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        page.lead(&answer(self));
        match (self.has_reference, self.axis) {
            (true, _) => maps(&mut page, self, &NEARER),
            (false, Axis::Kurtosis) => maps(&mut page, self, &VERDICTS),
            (false, Axis::Bandwidth) => maps(&mut page, self, &HEIGHTS_OR_RADII),
        }
        sections::warnings(&mut page, &self.warnings());
        if self.has_reference || self.axis == Axis::Kurtosis {
            page.details(2, "Why the models differ: heights or radii", |page| {
                maps(page, self, &HEIGHTS_OR_RADII);
            });
        }
        if self.has_reference || self.axis == Axis::Bandwidth {
            page.details(2, "May the integral replace the sum?", |page| maps(page, self, &VERDICTS));
        }
        page.details(2, "Which cause leads how often", |page| {
            maps(page, self, &LEADING);
            page.view(&tables.view::<LeadRow>());
        });
        if self.axis == Axis::Bandwidth {
            page.details(2, "Contributions over the skewness", |page| over_skewness(page, self));
        }
        page.details(2, "Surfaces, means over the realisations", |page| {
            let first = tables.view::<CauseRow>().columns(SURFACE);
            page.view(&first.first_of_each(&["skewness", "wavelengths", "kurtosis"]));
        });
        for quantity in QUANTITIES {
            page.details(2, &format!("All numbers: {}", quantity_name(quantity)), |page| {
                let view = tables.view::<CauseRow>().only("quantity", quantity.name());
                let view = view.filter("without_surface", |cell| cell.text().is_empty());
                page.view(&view.clone().columns(CONTRIBUTIONS).without_constant(&["law"]));
                page.view(&view.columns(DISTANCES).without_constant(&["law"]));
            });
        }
        sections::notes(&mut page, &self.metadata);
        sections::what_was_run(&mut page, &self.metadata, &self.contact, |page| {
            page.paragraph(&format!(
            "Laws: {}; {} surfaces of each point of the grid, {}. Method: [theory](../../docs/theory.md#why-the-models-differ).",
            self.laws.join(", "),
            self.realisations,
            self.common
        ));
        });
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let mut facts = fields(&ContactSummary::new(&self.contact))?;
        facts.insert("law".to_owned(), json!(self.laws.join(", ")));
        let made = self.points.iter().filter(|point| point.surfaces.is_ok()).count();
        facts.insert("surfaces".to_owned(), json!(made * self.realisations));
        Ok(facts)
    }
}

const SURFACE: &[&str] = &[
    "skewness",
    "surface_skewness",
    "kurtosis",
    "surface_kurtosis",
    "wavelengths",
    "nayak_alpha",
    "gradient",
    "asperities",
    "asperity_skewness",
    "radius_cv",
    "height_radius_correlation",
    "plasticity_index",
];

const CONTRIBUTIONS: &[&str] = &[
    "skewness",
    "kurtosis",
    "nayak_alpha",
    "law",
    "pressure_pa",
    "difference",
    "from_heights",
    "from_heights_low",
    "from_heights_high",
    "from_radii_and_correlation",
    "from_radii_and_correlation_low",
    "from_radii_and_correlation_high",
    "from_radii",
    "from_radii_with_other_mean_radius",
    "from_correlation",
    "leading_cause",
    "limits",
];

const DISTANCES: &[&str] = &[
    "skewness",
    "kurtosis",
    "nayak_alpha",
    "law",
    "pressure_pa",
    "low",
    "high",
    "verdict",
    "statistical_from_reference",
    "deterministic_from_reference",
    "farther",
    "farther_low",
    "farther_high",
    "nearer",
    "is_homogeneous",
];

/// A map of the grid for each law and load.
struct GridMap {
    file: &'static str,
    draw: fn(&CausesResults, [usize; 2]) -> Figure,
    caption: &'static str,
}

const HEIGHTS_OR_RADII: GridMap = GridMap {
    file: "heights-or-radii",
    draw: heights_or_radii,
    caption: "Heights against radii, with the difference between the models in each cell. Empty: load not admissible on some surface",
};

const LEADING: GridMap = GridMap {
    file: "causes",
    draw: leading_causes,
    caption: "Leading of the three causes. Grey: none leads; empty: load not admissible on some surface",
};

const VERDICTS: GridMap = GridMap {
    file: "verdicts",
    draw: verdicts,
    caption: "Statistical minus deterministic model against what is accepted. Empty: no such surface was made",
};

const NEARER: GridMap = GridMap {
    file: "nearer",
    draw: nearer,
    caption: "Which model is nearer to boundary elements. A cell: statistical | deterministic model less the reference. Empty: load not admissible, or area of the reference above 5 %",
};

fn maps(page: &mut Page, results: &CausesResults, map: &GridMap) {
    for condition in results.conditions() {
        let caption = format!("{}. {}.", map.caption, results.at(condition));
        page.figure(&results.file(map.file, condition), (map.draw)(results, condition), &caption);
    }
}

/// What the page is about, counted over all laws, loads and points of the grid.
fn answer(results: &CausesResults) -> String {
    match (results.has_reference, results.axis) {
        (true, _) => of_nearness(results),
        (false, Axis::Kurtosis) => of_verdicts(results),
        (false, Axis::Bandwidth) => of_causes(results),
    }
}

/// How often each model is nearer to the reference.
fn of_nearness(results: &CausesResults) -> String {
    let of_quantity = |quantity: ComparedQuantity| {
        let counts = NearerCounts::new(results, quantity);
        let sum = ("sum", counts.deterministic);
        let integral = ("integral", counts.statistical);
        let [(first, more), (second, less)] =
            if sum.1 >= integral.1 { [sum, integral] } else { [integral, sum] };
        format!(
            "In {} the {first} is nearer to boundary elements in {more} of {} cases, the {second} in {less}.",
            quantity_name(quantity),
            counts.compared
        )
    };
    format!(
        "{} Elsewhere 95 % intervals do not tell, or both are as near.",
        QUANTITIES.map(of_quantity).join(" ")
    )
}

/// How often the integral may replace the sum, and how far both are apart.
fn of_verdicts(results: &CausesResults) -> String {
    let all = QUANTITIES.map(|quantity| (quantity, VerdictCounts::new(results, quantity)));
    let within = all.each_ref().map(|(quantity, counts)| {
        format!("in {} of {} cases for {}", counts.within, counts.compared, quantity_name(*quantity))
    });
    let ranges = all.iter().filter_map(|(quantity, counts)| {
        let (unit, size) = difference_unit(*quantity);
        let [low, high] = counts.range?.map(|contrast| signed(size * quantity.reported(contrast)));
        Some(format!("{low} to {high} {unit}"))
    });
    let ranges: Vec<String> = ranges.collect();
    let differences = match &ranges[..] {
        [] => "No load is admissible at any grid point.".to_owned(),
        ranges => {
            format!("The integral may replace the sum {}. It differs by {}.", listed(&within), listed(ranges))
        }
    };
    let made = || results.points.iter().filter(|point| point.surfaces.is_ok());
    let is_admissible = |point: &&GridPoint| {
        results.conditions().any(|condition| point.at(condition).is_some_and(|at| at.exceeded.is_none()))
    };
    format!(
        "{differences} Of {} grid points, {} have surfaces with what is asked for, {} of them admissible loads.",
        results.points.len(),
        made().count(),
        made().filter(is_admissible).count(),
    )
}

/// How often radii and heights contribute more than the other.
fn of_causes(results: &CausesResults) -> String {
    let of_quantity = |quantity| {
        let all = || results.conditions().map(|condition| Findings::new(results, quantity, condition));
        let count = |of: fn(&Findings) -> usize| all().map(|findings| of(&findings)).sum::<usize>();
        let heights = ("heights", count(|findings| findings.heights_exceed));
        let radii = ("radii", count(|findings| findings.radii_exceed));
        let [(first, more), (second, less)] =
            if heights.1 >= radii.1 { [heights, radii] } else { [radii, heights] };
        let quantity = quantity_name(quantity);
        match count(|findings| findings.divided) {
            0 => format!("No difference in {quantity} needs a cause."),
            cases => format!(
                "{} explain the difference in {quantity} better than {second} in {more} of {cases} cases, {second} in {less}.",
                capitalised(first)
            ),
        }
    };
    format!(
        "{} Cases: grid points and loads whose difference is not known to be accepted.",
        QUANTITIES.map(of_quantity).join(" ")
    )
}

/// How many comparisons with the reference are beyond small strains.
fn strained(results: &CausesResults) -> Option<String> {
    let counts = QUANTITIES.map(|quantity| NearerCounts::new(results, quantity));
    let strained: usize = counts.iter().map(|counts| counts.beyond_small_strains).sum();
    (strained > 0).then(|| {
        format!(
            "{strained} of {} comparisons with boundary elements are beyond small strains: they hold for lower surfaces of the same shape",
            counts.iter().map(|counts| counts.compared).sum::<usize>()
        )
    })
}

/// How many points have slopes that a measured map would be cautioned for.
fn steep(results: &CausesResults) -> Option<String> {
    let gradients =
        || results.points.iter().filter_map(|point| Some(point.surfaces.as_ref().ok()?.reached.gradient));
    let steep = gradients().filter(|gradient| *gradient > LARGEST_SLOPE).count();
    (steep > 0).then(|| {
        format!(
            "{steep} of {} points have an r.m.s. gradient above {} (at most {}): the laws assume small slopes",
            gradients().count(),
            number(LARGEST_SLOPE),
            number(gradients().fold(0.0, f64::max))
        )
    })
}

impl CausesResults {
    /// "Law zmc at 6.92 MPa (0.002 E* times the gradient)".
    fn at(&self, [law, load]: [usize; 2]) -> String {
        let pressure = self.loads[load];
        let multiple = self
            .unit
            .map_or_else(String::new, |unit| format!(" ({} E* times the gradient)", number(pressure / unit)));
        format!("Law {} at {}{multiple}", self.laws[law], input_quantity(pressure, "Pa"))
    }

    /// The file of a figure: numbered by load, and with the law where there are several.
    fn file(&self, stem: &str, [law, load]: [usize; 2]) -> String {
        let law = if self.laws.len() > 1 { format!("-{}", law + 1) } else { String::new() };
        format!("{stem}{law}-{}.svg", load + 1)
    }
}

/// The contributions at each load, over the skewness.
fn over_skewness(page: &mut Page, results: &CausesResults) {
    for condition in results.conditions() {
        for quantity in QUANTITIES {
            page.figure(
                &results.file(&format!("contributions-{}", quantity.name()), condition),
                contributions(results, quantity, condition),
                &format!(
                    "Contributions to the difference in {}, means over the surfaces with 95 % intervals; a panel per row of the grid. {}.",
                    quantity_name(quantity),
                    results.at(condition),
                ),
            );
        }
    }
}

fn rows(results: &CausesResults) -> Vec<&[GridPoint]> {
    let same = |a: &GridPoint, b: &GridPoint| match results.axis {
        Axis::Bandwidth => a.wavelengths == b.wavelengths,
        Axis::Kurtosis => a.kurtosis == b.kurtosis,
    };
    results.points.chunk_by(same).collect()
}

/// Where a row lies on the second axis: Nayak's alpha, the mean over its surfaces, or the kurtosis.
fn place(results: &CausesResults, row: &[GridPoint]) -> f64 {
    match results.axis {
        Axis::Kurtosis => row[0].kurtosis,
        Axis::Bandwidth => {
            let alphas: Vec<f64> =
                row.iter().filter_map(|point| Some(point.surfaces.as_ref().ok()?.reached.alpha)).collect();
            alphas.iter().sum::<f64>() / alphas.len() as f64
        }
    }
}

/// Edges half way between values.
fn edges(values: &[f64]) -> Vec<f64> {
    let inner = values.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let (first, last) = (values[0], values[values.len() - 1]);
    let (low, high) = (values[1] - first, last - values[values.len() - 2]);
    std::iter::once(first - 0.5 * low).chain(inner).chain([last + 0.5 * high]).collect()
}

/// What a cell of a map says: its colour, the name of the colour, and its text.
type Cell = (Colour, &'static str, String);

/// A difference that needs no cause.
const WITHIN: (Colour, &str) = (Colour::Reference, "within what is accepted");

/// Heights against radii, whose spread and correlation count together.
pub fn heights_or_radii(results: &CausesResults, condition: [usize; 2]) -> Figure {
    map(results, "Heights or radii", "difference", |point, quantity| {
        let parts = point.parts(condition, quantity)?;
        let heights = parts.of_cause(Cause::Heights);
        let (colour, name) = if point.unaccepted(condition, quantity).is_none() {
            WITHIN
        } else if heights.exceeds(&parts.radii) {
            (Colour::Heights, "heights contribute more")
        } else if parts.radii.exceeds(heights) {
            (Colour::Radii, "radii (spread and correlation) contribute more")
        } else {
            (Colour::Neutral, "intervals overlap")
        };
        Some((colour, name, reported(quantity, parts.gap())))
    })
}

pub fn leading_causes(results: &CausesResults, condition: [usize; 2]) -> Figure {
    map(results, "Leading causes", "difference", |point, quantity| {
        let parts = point.parts(condition, quantity)?;
        let none = (Colour::Neutral, "none leads");
        let (colour, name) = match point.unaccepted(condition, quantity) {
            None => WITHIN,
            Some(parts) => parts.leading().map_or(none, |cause| (cause_colour(cause), cause.label())),
        };
        Some((colour, name, reported(quantity, parts.gap())))
    })
}

/// Whether the integral may replace the sum.
pub fn verdicts(results: &CausesResults, condition: [usize; 2]) -> Figure {
    map(results, "Verdicts", "difference", |point, quantity| {
        let (estimate, verdict) = point.quantity(condition, quantity)?.difference?;
        let text = reported(quantity, estimate.contrast);
        Some(match verdict {
            Some(Verdict::Within | Verdict::VeryLikelyWithin) => (WITHIN.0, WITHIN.1, text),
            Some(Verdict::Beyond | Verdict::VeryLikelyBeyond) => {
                (Colour::Deterministic, "beyond what is accepted", text)
            }
            Some(Verdict::CannotTell) => (Colour::Neutral, "cannot tell", text),
            None => (Colour::Others, "load not admissible", text),
        })
    })
}

/// Which model is nearer to the reference; a cell has the distances of both.
pub fn nearer(results: &CausesResults, condition: [usize; 2]) -> Figure {
    map(results, "Nearer to boundary elements", "integral | sum less reference", |point, quantity| {
        let at = point.quantity(condition, quantity)?;
        let [statistical, deterministic, _] = at.against?;
        let (colour, name) = match at.nearer_model() {
            Some(ModelKind::Statistical) => (Colour::Statistical, "integral nearer"),
            Some(ModelKind::Deterministic) => (Colour::Deterministic, "sum nearer"),
            None => (Colour::Neutral, "cannot be told, or both as near"),
        };
        let text = [statistical, deterministic].map(|estimate| reported(quantity, estimate.contrast));
        Some((colour, name, text.join(" | ")))
    })
}

/// A contrast in sigma with one decimal, or in percent: what fits into a cell.
fn reported(quantity: ComparedQuantity, contrast: f64) -> String {
    match quantity {
        ComparedQuantity::Separation => format!("{contrast:+.1}").replace('-', "−"),
        _ => format!("{:+.0}", 100.0 * quantity.reported(contrast)).replace('-', "−"),
    }
}

fn map(
    results: &CausesResults,
    title: &str,
    what: &str,
    cell: impl Fn(&GridPoint, ComparedQuantity) -> Option<Cell>,
) -> Figure {
    let panel = |quantity| map_of(results, quantity, what, &|point| cell(point, quantity));
    let over = match results.axis {
        Axis::Bandwidth => "over skewness and bandwidth",
        Axis::Kurtosis => "over skewness and kurtosis",
    };
    Figure::row(format!("{title} {over}"), QUANTITIES.map(panel).into())
}

fn map_of(
    results: &CausesResults,
    quantity: ComparedQuantity,
    what: &str,
    cell: &dyn Fn(&GridPoint) -> Option<Cell>,
) -> Plot {
    let rows = rows(results);
    let x = edges(&rows[0].iter().map(|point| point.skewness).collect::<Vec<_>>());
    let places = rows.iter().map(|row| place(results, row));
    let (y, y_axis) = match results.axis {
        Axis::Bandwidth => {
            let y: Vec<f64> = edges(&places.map(f64::ln).collect::<Vec<_>>());
            (y.into_iter().map(f64::exp).collect(), PlotAxis::log("Nayak's α"))
        }
        Axis::Kurtosis => (edges(&places.collect::<Vec<_>>()), PlotAxis::linear("kurtosis of the heights")),
    };
    let range = |axis: PlotAxis, edges: &[f64]| axis.range(edges[0], edges[edges.len() - 1]);
    let (unit, _) = difference_unit(quantity);
    let title = format!("{}, {what} in {unit}", capitalised(quantity_name(quantity)));
    let x_axis = range(PlotAxis::linear("skewness of the heights"), &x);
    let mut plot = Plot::new(title, x_axis, range(y_axis, &y))
        .height(60.0 * rows.len().max(5) as f64)
        .legend(Legend::Below);
    for (row, points) in rows.iter().enumerate() {
        for (column, point) in points.iter().enumerate() {
            let Some((colour, name, text)) = cell(point) else { continue };
            let (from, to) = ((x[column], y[row]), (x[column + 1], y[row + 1]));
            plot = plot.with(Layer::tile(from, to, &text).coloured(colour).named(name));
        }
    }
    plot
}

pub fn contributions(results: &CausesResults, quantity: ComparedQuantity, condition: [usize; 2]) -> Figure {
    let panels = rows(results).into_iter().map(|row| lines(results, row, quantity, condition));
    Figure::row("Contributions over the skewness", panels.collect())
}

fn lines(
    results: &CausesResults,
    row: &[GridPoint],
    quantity: ComparedQuantity,
    condition: [usize; 2],
) -> Plot {
    let label = match quantity {
        ComparedQuantity::Separation => "separation (σ)",
        _ => "ln(area ratio)",
    };
    let place = number(place(results, row));
    let title = match results.axis {
        Axis::Bandwidth => format!("α = {place}"),
        Axis::Kurtosis => format!("kurtosis {place}"),
    };
    let x = edges(&row.iter().map(|point| point.skewness).collect::<Vec<_>>());
    let mut plot = Plot::new(
        title,
        PlotAxis::linear("skewness of the heights").range(x[0], x[x.len() - 1]),
        PlotAxis::linear(label),
    )
    .height(240.0)
    .with_zero();
    let divided = || row.iter().filter_map(|point| Some((point.skewness, point.parts(condition, quantity)?)));
    let markers = [Marker::Circle, Marker::Square, Marker::Triangle];
    for (cause, marker) in Cause::ALL.into_iter().zip(markers) {
        let points: Vec<(f64, f64)> = divided().map(|(x, parts)| (x, parts.part(cause))).collect();
        let band = divided().filter_map(|(x, parts)| {
            let [low, high] = parts.of_cause(cause).interval()?;
            Some((x, low, high))
        });
        let colour = cause_colour(cause);
        plot = plot
            .with(Layer::band(band).coloured(colour).named(cause.label()))
            .with(Layer::line(points.iter().copied()).coloured(colour).named(cause.label()))
            .with(Layer::points(points, marker).coloured(colour).named(cause.label()));
    }
    let radii = divided().map(|(x, parts)| (x, parts.radii.mean.contrast));
    plot = plot.with(
        Layer::line(radii)
            .coloured(Colour::Radii)
            .dashed(Dash::Dashed)
            .named("spread and correlation together"),
    );
    let gap = divided().map(|(x, parts)| (x, parts.gap()));
    plot.with(Layer::line(gap).coloured(Colour::Sum).thick().named("statistical − deterministic"))
}
