//! The page: which cause leads where, a map for each load, the contributions over the skewness, and all numbers.

use asperity::compare::ComparedQuantity;
use asperity::topography::fitness::LARGEST_SLOPE;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{input_quantity, number, signed};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::{Outcome, fields};
use asperity_plot::Figure;
use serde_json::{Map, Value, json};

use super::figures::{contributions, heights_or_radii, leading_causes, nearer, verdicts};
use super::findings::{Findings, NearerCounts, VerdictCounts};
use super::plan::Axis;
use super::results::{CausesResults, GridPoint, QUANTITIES};
use super::rows::{CauseRow, LeadRow, tables};
use crate::presentation::quantity_name;

impl Outcome for CausesResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        let mut warnings = self.contact.caveats.clone();
        warnings.extend(steep(self));
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
            page.view(&tables.view::<LeadRow>()).note(include_str!("notes/leads.md"));
            if self.axis == Axis::Bandwidth {
                page.note(include_str!("notes/bandwidth.md"));
            }
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
        sections::what_was_run(&mut page, &self.metadata, &self.contact);
        page.paragraph(&format!(
            "Laws: {}; {} surfaces of each point of the grid, {}.",
            self.laws.join(", "),
            self.realisations,
            self.common
        ));
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
    "without_surface",
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
    caption: "Which model is nearer to boundary elements. A cell: statistical | deterministic model less the reference. Empty: not compared, since the load is not admissible or the area of the reference exceeds 5 %",
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
    let of_law = |law: usize| {
        let of_quantity = |quantity| {
            let counts = NearerCounts::new(results, quantity, law);
            let strained = match counts.beyond_small_strains {
                0 => String::new(),
                count => format!(" ({count} beyond small strains)"),
            };
            format!(
                "{} integral {}, sum {} of {}{strained}",
                quantity_name(quantity),
                counts.statistical,
                counts.deterministic,
                counts.compared
            )
        };
        format!("{}: {}", results.laws[law], QUANTITIES.map(of_quantity).join("; "))
    };
    let laws: Vec<String> = (0..results.laws.len()).map(of_law).collect();
    format!(
        "How often each model is nearer to boundary elements, by 95 % intervals point by point. {}. Elsewhere it cannot be told, or both are as near.",
        laws.join(". ")
    )
}

/// How often the integral may replace the sum, and how far both are apart.
fn of_verdicts(results: &CausesResults) -> String {
    let of_quantity = |quantity: ComparedQuantity| {
        let counts = VerdictCounts::new(results, quantity);
        let (unit, size) = if quantity == ComparedQuantity::Separation { ("σ", 1.0) } else { ("%", 100.0) };
        let range = counts.range.map_or_else(String::new, |range| {
            let [low, high] = range.map(|contrast| signed(size * quantity.reported(contrast)));
            format!(" ({low} to {high} {unit})")
        });
        format!(
            "{} {} within, {} beyond, of {}{range}",
            quantity_name(quantity),
            counts.within,
            counts.beyond,
            counts.compared
        )
    };
    let made = || results.points.iter().filter(|point| point.surfaces.is_ok());
    let is_admissible = |point: &&GridPoint| {
        results.conditions().any(|condition| point.at(condition).is_some_and(|at| at.exceeded.is_none()))
    };
    format!(
        "{} of {} points of the grid have surfaces with what is asked for, {} of these at admissible loads. The verdicts at those points and loads: {}.",
        made().count(),
        results.points.len(),
        made().filter(is_admissible).count(),
        QUANTITIES.map(of_quantity).join("; ")
    )
}

/// The name of some skewnesses, and whether one belongs to them.
type Class = (&'static str, fn(f64) -> bool);

/// How often radii and heights contribute more than the other, by the sign of the skewness.
fn of_causes(results: &CausesResults) -> String {
    let of_class = |(name, is_in_class): Class| {
        let of_quantity = |quantity| {
            let all: Vec<Findings> = results
                .conditions()
                .map(|condition| Findings::new(results, quantity, condition, &is_in_class))
                .collect();
            let count = |of: fn(&Findings) -> usize| all.iter().map(of).sum::<usize>();
            format!(
                "{} radii {}, heights {} of {}",
                quantity_name(quantity),
                count(|findings| findings.radii_exceed),
                count(|findings| findings.heights_exceed),
                count(|findings| findings.divided)
            )
        };
        format!("Skewness {name}: {}", QUANTITIES.map(of_quantity).join("; "))
    };
    let classes: [Class; 3] = [("below 0", |s| s < 0.0), ("0", |s| s == 0.0), ("above 0", |s| s > 0.0)];
    let has_points = |class: &Class| results.points.iter().any(|point| class.1(point.skewness));
    let classes: Vec<String> = classes.into_iter().filter(has_points).map(of_class).collect();
    format!(
        "Where the models differ by more than is known to be accepted, which contributes more, with 95 % intervals apart. {}. Radii: their \
         spread and their correlation with the heights together.",
        classes.join(". ")
    )
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
                    "Contributions to the difference in {}, means over the surfaces with 95 % intervals; a panel for each row of the grid. {}.",
                    quantity_name(quantity),
                    results.at(condition),
                ),
            );
        }
    }
}
