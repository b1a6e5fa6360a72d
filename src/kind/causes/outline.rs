//! The page: which cause leads where, a map for each load, the contributions over the skewness, and all numbers.

use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{input_quantity, number};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::{Outcome, fields};
use serde_json::{Map, Value, json};

use super::figures::{contributions, heights_or_radii, leading_causes};
use super::findings::Findings;
use super::results::{CausesResults, QUANTITIES};
use super::rows::{CauseRow, LeadRow, tables};
use crate::presentation::quantity_name;

impl Outcome for CausesResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.contact.caveats.clone()
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        page.lead(&answer(self));
        for load in 0..self.loads.len() {
            page.figure(
                &format!("heights-or-radii-{}.svg", load + 1),
                heights_or_radii(self, load),
                &format!(
                    "Heights against radii at {}, with the difference between the models in each cell; empty: load not admissible.",
                    self.at(load)
                ),
            );
        }
        sections::warnings(&mut page, &self.warnings());
        page.heading(2, "Which cause leads how often");
        for load in 0..self.loads.len() {
            page.figure(
                &format!("causes-{}.svg", load + 1),
                leading_causes(self, load),
                &format!(
                    "Leading of the three causes at {}. Grey: none leads; empty: load not admissible.",
                    self.at(load)
                ),
            );
        }
        page.view(&tables.view::<LeadRow>());
        page.note(include_str!("notes/leads.md"));
        page.details(2, "Contributions over the skewness", |page| over_skewness(page, self));
        page.details(2, "Surfaces, means over the realisations", |page| {
            let first =
                tables.view::<CauseRow>().columns(SURFACE).first_of_each(&["skewness", "wavelengths"]);
            page.view(&first);
        });
        for quantity in QUANTITIES {
            page.details(
                2,
                &format!("Contributions to the difference in {}", quantity_name(quantity)),
                |page| {
                    let view = tables.view::<CauseRow>().only("quantity", quantity.name());
                    page.view(&view.columns(CONTRIBUTIONS));
                },
            );
        }
        sections::notes(&mut page, &self.metadata);
        sections::what_was_run(&mut page, &self.metadata, &self.contact);
        page.paragraph(&format!(
            "Law `{}`; {} surfaces of each skewness and bandwidth, {} points along each side, σ = {}, root mean square gradient {}, \
             self-affine with the Hurst exponent {}.",
            self.law,
            self.realisations,
            self.points.first().map_or(0, |point| point.points),
            input_quantity(self.sigma, "m"),
            number(self.gradient),
            number(self.hurst)
        ));
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let mut facts = fields(&ContactSummary::new(&self.contact))?;
        facts.insert("law".to_owned(), json!(self.law));
        facts.insert("surfaces".to_owned(), json!(self.points.len() * self.realisations));
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
    "nayak_alpha",
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

/// How often radii and heights contribute more than the other, over all loads.
fn answer(results: &CausesResults) -> String {
    let findings = Findings::all(results);
    let of_quantity = |quantity| {
        let all: Vec<&Findings> = findings.iter().filter(|findings| findings.quantity == quantity).collect();
        let count = |of: fn(&Findings) -> usize| all.iter().map(|findings| of(findings)).sum::<usize>();
        format!(
            "in {}, radii in {} and heights in {} of {} cases",
            quantity_name(quantity),
            count(|findings| findings.radii_exceed),
            count(|findings| findings.heights_exceed),
            count(|findings| findings.divided)
        )
    };
    format!(
        "Which contributes more to the difference between the models, with 95 % intervals apart: {}. Radii: their spread and their \
         correlation with the heights together.",
        QUANTITIES.map(of_quantity).join("; ")
    )
}

impl CausesResults {
    /// "6.92 MPa (0.002 E* times the gradient)".
    fn at(&self, load: usize) -> String {
        let pressure = self.loads[load];
        format!("{} ({} E* times the gradient)", input_quantity(pressure, "Pa"), number(pressure / self.unit))
    }
}

/// The contributions at each load, over the skewness.
fn over_skewness(page: &mut Page, results: &CausesResults) {
    for (load, pressure) in results.loads.iter().enumerate() {
        for quantity in QUANTITIES {
            page.figure(
                &format!("contributions-{}-{}.svg", load + 1, quantity.name()),
                contributions(results, quantity, load),
                &format!(
                    "Contributions to the difference in {} at {}, means over the surfaces with 95 % intervals; one panel for each bandwidth.",
                    quantity_name(quantity),
                    input_quantity(*pressure, "Pa"),
                ),
            );
        }
    }
}
