//! The page of several laws: what matters more on surfaces, contact law or summation method, and how the laws differ on a single asperity.

use asperity::compare::{Dominance, Dominant, Measure};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{number, percent, quantity};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Reading, Table, Tables};
use asperity_contact_framework::report::view::View;
use serde_json::{Map, Value, json};

use super::figures;
use super::rows::{
    BoundaryRow, ChoiceRow, DominanceRow, InfluenceRow, LawRow, LawsResults, SurfaceInfluence, reported,
    tables,
};
use crate::kind::compare::outline;
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
        page.lead(&answer(self));
        for surface in &compared.surfaces {
            law_or_model(&mut page, self, &surface.surface.name);
        }
        sections::warnings(&mut page, &self.warnings());
        page.heading(2, "What matters more?");
        for measure in Measure::ALL {
            let view = tables.view::<DominanceRow>();
            let view = by_measure(view, measure, &DOMINANCE, Reading::Percent).columns(&OVERVIEW);
            page.view(&match measure {
                Measure::Separation => view.label("law_range", "range over the laws (σ)"),
                Measure::Area => view,
            });
        }
        for surface in &compared.surfaces {
            by_law(&mut page, tables, &surface.surface.name);
        }
        page.details(2, "Single asperity", |page| on_asperity(page, self, tables));
        page.details(2, "Laws", |page| {
            page.view(&tables.view::<LawRow>().without(&["description"]));
        });
        outline::verdicts(&mut page, tables);
        for surface in &compared.surfaces {
            page.details(2, &format!("Surface {}", surface.surface.name), |page| {
                let population = &surface.realisations[0].population;
                section::section(page, tables, &surface.surface, Some(population));
            });
        }
        sections::notes(&mut page, &compared.metadata);
        sections::what_was_run(&mut page, &compared.metadata, &compared.contact, |page| {
            page.paragraph("Method: [theory](../../docs/theory.md#law-or-summation).");
        });
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

/// On how many surfaces which of both matters more, by each measure, and how far laws and models are apart.
fn answer(results: &LawsResults) -> String {
    let surfaces = results.compare.surfaces.iter();
    let first: Vec<&SurfaceInfluence> =
        surfaces.filter_map(|surface| results.first_influence(&surface.surface.name)).collect();
    let of_measure = |measure| {
        let all = first.iter().flat_map(|influence| &influence.dominances);
        all.filter(|dominance| dominance.measure == measure).copied().collect::<Vec<Dominance>>()
    };
    let sentences = Measure::ALL.map(|measure| matters_more(&of_measure(measure), measure, first.len()));
    let sentences: Vec<String> = sentences.into_iter().rev().flatten().collect();
    if sentences.is_empty() {
        return "No load is admissible under every law, so that laws and summation are not compared."
            .to_owned();
    }
    sentences.join(" ")
}

/// "The summation changes the separation more than the contact law on 2 of 3 surfaces: by up to 1.1 σ against
/// 0.13 σ." `None` where nothing is compared.
fn matters_more(dominances: &[Dominance], measure: Measure, surfaces: usize) -> Option<String> {
    let count = |what: Dominant| dominances.iter().filter(|dominance| dominance.dominant() == what).count();
    let size = |effect: f64| match measure {
        Measure::Separation => format!("{} σ", number(reported(measure, effect))),
        Measure::Area => percent(reported(measure, effect)),
    };
    let law = ("contact law", count(Dominant::Law), Dominant::Law);
    let summation = ("summation", count(Dominant::Summation), Dominant::Summation);
    let [(first, more, dominant), (second, less, _)] =
        if law.1 > summation.1 { [law, summation] } else { [summation, law] };
    let effects = |dominance: &Dominance| {
        let [law, summation] = [dominance.law.mean, dominance.summation.mean];
        if dominant == Dominant::Law { [law, summation] } else { [summation, law] }
    };
    // Both on the surface with the largest effect of what matters more.
    let of_first =
        dominances.iter().filter(|dominance| more == 0 || dominance.dominant() == dominant).map(effects);
    let [of_first, of_second] = of_first.max_by(|a, b| a[0].total_cmp(&b[0]))?.map(size);
    let name = match measure {
        Measure::Separation => "separation",
        Measure::Area => "contact area",
    };
    Some(match more {
        0 => format!(
            "Which changes the {name} more, {first} or {second}, cannot be told on any of {surfaces} surfaces (up to {of_first} against \
             {of_second})."
        ),
        _ => {
            let less = if less == 0 { String::new() } else { format!(", less on {less}") };
            format!(
                "The {first} changes the {name} more than the {second} on {more} of {surfaces} surfaces{less}: by up to {of_first} \
                 against {of_second} (mean over loads)."
            )
        }
    })
}

fn law_or_model(page: &mut Page, results: &LawsResults, name: &str) {
    let Some(SurfaceInfluence { influence, .. }) = results.first_influence(name) else { return };
    page.figure(
        &format!("{name}-law-or-model.svg"),
        figures::law_or_model(results, influence),
        &format!(
            "{name}: the law matters more where coloured lines lie further apart than the black one from zero (or one). At equal load, \
             relative to the sum under {}; bands: 95 %; shaded: not admissible.{}",
            influence.laws[0],
            figures::outside(results, influence),
        ),
    );
}

fn by_law(page: &mut Page, tables: &Tables, name: &str) {
    for measure in Measure::ALL {
        let title = match measure {
            Measure::Separation => "separation",
            Measure::Area => "real area",
        };
        page.details(2, &format!("{name}: {title} law by law and load by load"), |page| {
            let choices = tables.view::<ChoiceRow>().only("surface", name);
            page.view(&by_measure(choices, measure, &CHOICE, Reading::SignedPercent));
            let loads = tables.view::<InfluenceRow>().only("surface", name);
            let loads = by_measure(loads, measure, &[], Reading::Plain);
            page.view(&loads.each_decade("pressure_pa", 1.0).without(&["counts"]));
        });
    }
}

fn on_asperity(page: &mut Page, results: &LawsResults, tables: &Tables) {
    let critical = &results.critical;
    let mut unit = vec![
        vec!["radius R".to_owned(), quantity(results.radius, "m")],
        vec!["ratio of principal curvatures (elliptic laws)".to_owned(), number(results.curvature_ratio)],
        vec!["indentation at first yield, wc".to_owned(), quantity(critical.indentation, "m")],
        vec!["Hertz's load at wc, Pc".to_owned(), quantity(critical.load, "N")],
        vec!["Hertz's area at wc, Ac".to_owned(), quantity(critical.area, "m²")],
    ];
    unit.extend(
        results
            .end_of_small_strains()
            .map(|end| vec!["small strains up to w/wc".to_owned(), number(end / critical.indentation)]),
    );
    page.table(["asperity", "value"], unit);
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
    use asperity::compare::{Effect, Group};

    use super::*;

    fn dominance(law: f64, summation: f64, error: Option<f64>) -> Dominance {
        let effect = |mean| Effect { mean, largest: mean, at: 1.0 };
        Dominance {
            measure: Measure::Area,
            group: Group::All,
            law: effect(law),
            summation: effect(summation),
            sampling: error.map(effect),
            without_furthest: None,
        }
    }

    #[test]
    fn surfaces_are_counted_by_what_matters_more_on_them() {
        let law = dominance(0.3, 0.1, Some(0.01));
        let summation = dominance(0.1, 0.4, Some(0.01));
        let equal = dominance(0.1, 0.1, Some(0.01));
        let unknown = dominance(0.3, 0.1, None);
        let answer = |all: &[Dominance], measure| matters_more(all, measure, 6);
        assert_eq!(
            answer(&[law, dominance(0.5, 0.2, Some(0.01)), summation, equal, unknown], Measure::Separation)
                .unwrap(),
            "The contact law changes the separation more than the summation on 2 of 6 surfaces, less on 1: by up to 0.5 σ against \
             0.2 σ (mean over loads)."
        );
        let of_area = answer(&[law, summation], Measure::Area).unwrap();
        assert!(
            of_area.ends_with(
                "on 1 of 6 surfaces, less on 1: by up to 49.2 % against 10.5 % (mean over loads)."
            ),
            "{of_area}"
        );
        let of_neither = answer(&[equal, unknown], Measure::Area).unwrap();
        assert!(of_neither.contains("summation or contact law, cannot be told on any"), "{of_neither}");
        assert_eq!(answer(&[], Measure::Area), None);
    }
}
