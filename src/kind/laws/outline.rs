//! The page of several laws: what matters more on surfaces, contact law or summation method, and how the laws differ on a single asperity.

use asperity::compare::{Dominance, Dominant, Measure};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{input_number, input_quantity, listed, number, quantity};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Reading, Table, Tables};
use asperity_contact_framework::report::view::View;
use serde_json::{Map, Value, json};

use super::figures;
use super::results::LawsResults;
use super::rows::{BoundaryRow, ChoiceRow, DominanceRow, InfluenceRow, LawRow, tables};
use crate::kind::compare::outline;
use crate::kind::compare::results::SurfaceResults;
use crate::presentation::limits_note;
use crate::surface::section;

impl Outcome for LawsResults {
    fn metadata(&self) -> &Metadata {
        &self.compare.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.compare.warnings()
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let compared = &self.compare;
        let mut page = Page::new(&compared.metadata.title);
        for measure in Measure::ALL {
            if let Some(answer) = answer(measure, &findings(self, measure)) {
                page.lead(&answer);
            }
        }
        for measure in Measure::ALL {
            let view = tables.view::<DominanceRow>();
            let view = by_measure(view, measure, &DOMINANCE, Reading::Percent).columns(&OVERVIEW);
            page.view(&match measure {
                Measure::Separation => view.label("law_range", "range over the laws (σ)"),
                Measure::Area => view,
            });
        }
        page.note(include_str!("notes/influence.md"));
        sections::warnings(&mut page, &self.warnings());
        outline::verdicts(&mut page, tables);
        for surface in &compared.surfaces {
            on_surface(&mut page, self, tables, surface);
        }
        on_asperity(&mut page, self, tables);
        page.heading(2, "Laws").view(&tables.view::<LawRow>()).note(include_str!("notes/laws.md"));
        for surface in &compared.surfaces {
            section::section(&mut page, tables, &surface.surface, Some(&surface.realisations[0].population));
        }
        sections::notes(&mut page, &compared.metadata);
        sections::what_was_run(&mut page, &compared.metadata, &compared.contact);
        limits_note(&mut page);
        sections::run_again(&mut page, &compared.metadata, None);
        sections::sources(&mut page, &compared.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let mut facts = self.compare.facts()?;
        let asperity = json!({
            "radius_m": self.radius,
            "curvature_ratio": self.curvature_ratio,
            "critical_indentation_m": self.critical.indentation,
            "critical_load_n": self.critical.load,
            "critical_area_m2": self.critical.area,
            "end_of_small_strains_m": self.end_of_small_strains(),
        });
        facts.insert("asperity".to_owned(), asperity);
        Ok(facts)
    }
}

/// Columns of the first view.
const OVERVIEW: [&str; 8] = [
    "surface",
    "matters_more",
    "law_range",
    "largest_law_range",
    "models_difference",
    "standard_error",
    "most_deviating_law",
    "law_range_without_it",
];

/// Columns of magnitudes in sigma or relative.
const DOMINANCE: [&str; 5] =
    ["law_range", "largest_law_range", "models_difference", "standard_error", "law_range_without_it"];

/// Columns of signed differences in sigma or relative.
const CHOICE: [&str; 3] =
    ["statistical_from_first", "deterministic_from_first", "statistical_from_deterministic"];

/// The rows of one measure on the first realisations, `differences` in sigma or, of areas, as `relative`.
fn by_measure<'a>(view: View<'a>, measure: Measure, differences: &[&str], relative: Reading) -> View<'a> {
    let view = view.only("measure", measure.name()).only("realisation", 1u64);
    match measure {
        Measure::Separation => view,
        Measure::Area => differences.iter().fold(view, |view, name| view.read_as(name, relative)),
    }
}

/// What matters more on a surface, or why that is not said.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Finding {
    Decided(Dominant),
    NoInterval,
    NoLoad,
}

impl Finding {
    /// In the order in which they are said.
    fn all() -> impl Iterator<Item = Self> {
        Dominant::ALL.into_iter().map(Self::Decided).chain([Self::NoInterval, Self::NoLoad])
    }

    fn new(dominance: Option<&Dominance>) -> Self {
        match dominance.map(|dominance| (dominance.dominant(), dominance.sampling)) {
            None => Self::NoLoad,
            Some((Dominant::Undecided, None)) => Self::NoInterval,
            Some((dominant, _)) => Self::Decided(dominant),
        }
    }

    /// The finding, and its reason where nothing matters more.
    fn words(self) -> [&'static str; 2] {
        match self {
            Self::Decided(Dominant::Law) => ["the contact law", ""],
            Self::Decided(Dominant::Summation) => ["the summation method", ""],
            Self::Decided(Dominant::Equal) => ["both equally", ""],
            Self::Decided(Dominant::Undecided) => ["cannot be told", " (within the sampling uncertainty)"],
            Self::NoInterval => ["cannot be told", " (no sampling interval is claimed)"],
            Self::NoLoad => ["not evaluated", " (no load is admissible under every law)"],
        }
    }
}

/// What matters more on each surface by a measure.
fn findings(results: &LawsResults, measure: Measure) -> Vec<(String, Finding)> {
    let surfaces = results.compare.surfaces.iter();
    let first = surfaces.filter_map(|surface| results.first_influence(&surface.surface.name));
    let each = first.map(|influence| {
        let mut dominances = influence.dominances.iter();
        (influence.surface.clone(), Finding::new(dominances.find(|dominance| dominance.measure == measure)))
    });
    each.collect()
}

/// "**What matters more for d/σ**: the contact law on case-1; the summation method on case-2." `None` without surfaces.
fn answer(measure: Measure, findings: &[(String, Finding)]) -> Option<String> {
    /// More surfaces are counted.
    const MOST_NAMED: usize = 3;
    let part = |finding: Finding| {
        let [what, why] = finding.words();
        let names: Vec<String> =
            findings.iter().filter(|(_, each)| *each == finding).map(|(name, _)| escape(name)).collect();
        match names.len() {
            0 => None,
            1..=MOST_NAMED => Some(format!("{what} on {}{why}", listed(&names))),
            more => Some(format!("{what} on {more} surfaces{why}")),
        }
    };
    let parts: Vec<String> = Finding::all().filter_map(part).collect();
    let quantity = match measure {
        Measure::Separation => "d/σ",
        Measure::Area => "real area",
    };
    (!parts.is_empty()).then(|| format!("**What matters more for {quantity}**: {}.", parts.join("; ")))
}

/// The figure and the views of one surface.
fn on_surface(page: &mut Page, results: &LawsResults, tables: &Tables, surface: &SurfaceResults) {
    let name = &surface.surface.name;
    let Some(influence) = results.first_influence(name) else { return };
    page.heading(2, &format!("{name}: contact law or summation method?"));
    if influence.dominances.is_empty() {
        page.paragraph("No load is admissible under every law, so the effects are not compared.");
    }
    page.figure(
        &format!("{name}-law-or-model.svg"),
        figures::law_or_model(results, &influence.influence),
        &format!(
            "The contact law matters more where the coloured lines lie further apart than the black line from zero (or one). All at equal \
             load, relative to the sum under {}; bands: 1.96 standard errors of the difference between the models; shaded: loads beyond \
             the admissible range.{}",
            influence.influence.laws[0],
            figures::outside(results, &influence.influence),
        ),
    );
    for measure in Measure::ALL {
        let title = match measure {
            Measure::Separation => "separation",
            Measure::Area => "real area",
        };
        page.details(3, &format!("{name}: {title} law by law and load by load"), |page| {
            let choices = tables.view::<ChoiceRow>().only("surface", name.as_str());
            page.view(&by_measure(choices, measure, &CHOICE, Reading::SignedPercent));
            let loads = tables.view::<InfluenceRow>().only("surface", name.as_str());
            let loads = by_measure(loads, measure, &[], Reading::Plain);
            page.view(&loads.each_decade("pressure_pa", 1.0).without(&["counts"]));
        });
    }
    if let Some(mean) = &surface.surface.ellipticity {
        page.paragraph(&format!(
            "Under an elliptic law the statistical model uses the mean curvature (radius {}), under the others the radius {}; part of the \
             effect of the law is due to this.",
            quantity(mean.mean_curvature.recip(), "m"),
            input_quantity(surface.realisations[0].population.radius, "m"),
        ));
    }
}

/// The laws on a single asperity.
fn on_asperity(page: &mut Page, results: &LawsResults, tables: &Tables) {
    let critical = &results.critical;
    page.heading(2, "Single asperity");
    let ellipse = match results.curvature_ratio {
        1.0 => String::new(),
        ratio => format!(
            " Elliptic laws use the same mean curvature and a ratio of principal curvatures of {}.",
            input_number(ratio)
        ),
    };
    page.paragraph(&format!(
        "Radius R = {}. Indentations are normalised by the onset of yield of a sphere after Zhao, Maietta and Chang: wc = (0.3 π)² R (H/E*)² \
         = {}; Pc = {} and Ac = {} are Hertz's load and area there.{ellipse}",
        input_quantity(results.radius, "m"),
        quantity(critical.indentation, "m"),
        quantity(critical.load, "N"),
        quantity(critical.area, "m²"),
    ));
    if let Some(end) = results.end_of_small_strains() {
        page.paragraph(&format!(
            "Strains are small up to w/wc = {}; beyond, the curves extrapolate the laws.",
            number(end / critical.indentation)
        ));
    }
    page.figure(
        "asperity-curves.svg",
        figures::curves(results),
        "Load and real contact area of one asperity under every law. Circles: both sides of each boundary between two formulas.",
    );
    if let Some(hardness) = results.compare.contact.hardness {
        page.figure(
            "asperity-differences.svg",
            figures::differences(results, hardness),
            "Mean contact pressure over hardness, and area over that of an elastic contact.",
        );
    }
    if let Some(figure) = figures::jumps(results) {
        page.figure(
            "asperity-jumps.svg",
            figure,
            "Jumps of the laws: load and area over those of an elastic contact at equal indentation.",
        );
    }
    page.heading(3, "Boundaries between two formulas").view(&tables.view::<BoundaryRow>());
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::compare::{Effect, Group};

    const LAW: Finding = Finding::Decided(Dominant::Law);

    #[test]
    fn surfaces_are_named_with_what_matters_more_on_them() {
        let findings = |each: &[(&str, Finding)]| -> Vec<(String, Finding)> {
            each.iter().map(|(name, finding)| (name.to_string(), *finding)).collect()
        };
        let some = findings(&[("a", Finding::NoInterval), ("b", LAW), ("c", LAW), ("d", Finding::new(None))]);
        assert_eq!(
            answer(Measure::Area, &some).unwrap(),
            "**What matters more for real area**: the contact law on b and c; cannot be told on a (no sampling interval is claimed); \
             not evaluated on d (no load is admissible under every law)."
        );
        let many = findings(&["a", "b", "c", "d"].map(|name| (name, LAW)));
        assert!(answer(Measure::Area, &many).unwrap().ends_with("the contact law on 4 surfaces."));
        assert_eq!(answer(Measure::Separation, &[]), None);
    }

    #[test]
    fn what_is_found_depends_on_both_effects_and_the_sampling_error() {
        let effect = |mean| Effect { mean, largest: mean, at: 1.0 };
        let of = |law, summation, error: Option<f64>| {
            Finding::new(Some(&Dominance {
                measure: Measure::Area,
                group: Group::All,
                law: effect(law),
                summation: effect(summation),
                sampling: error.map(effect),
                without_furthest: None,
            }))
        };
        let found = [
            of(3.0, 1.0, Some(0.1)),
            of(1.0, 3.0, Some(0.1)),
            of(1.0, 1.0, Some(0.1)),
            of(3.0, 1.0, Some(1.0)),
            of(3.0, 1.0, None),
        ];
        let decided = Finding::Decided;
        let expected = [
            LAW,
            decided(Dominant::Summation),
            decided(Dominant::Equal),
            decided(Dominant::Undecided),
            Finding::NoInterval,
        ];
        assert_eq!(found, expected);
    }
}
