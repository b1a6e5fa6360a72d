//! One surface under one law and thickness: its answer, figures and tables.

use asperity::compare::{ComparedQuantity, Difference, of_each_decade};
use asperity::study::RealisationFacts;
use asperity_contact_framework::report::format::{input_quantity, number};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::table::{Reading, Tables};
use asperity_contact_framework::report::view::View;

use super::super::figures::curves::Units;
use crate::kind::compare::figures::curves::{self, Setting};
use crate::kind::compare::figures::{contact, differences as figure, layers, main_figure};
use crate::kind::compare::results::{CompareResults, SurfaceResults};
use crate::kind::compare::rows::{
    AttributionRow, CorrelationRow, LineRow, RobustnessRow, SpreadRow, SurfaceCase,
};
use crate::kind::compare::series::{Series, stem, subject, under};
use crate::model_tables::{CurveRow, PairRow};

/// Loads per decade in tables.
const PER_DECADE: f64 = 2.0;

impl SurfaceCase<'_> {
    /// The surface, with law and layer where there are several.
    pub fn name(&self, results: &CompareResults) -> String {
        let layer = results.contact.layer.as_ref().zip(self.first().thickness);
        let layer = layer.map_or_else(String::new, |(layer, t)| format!(", {}", under(layer, t)));
        format!("{}{layer}", subject(results, self.surface, &self.first().law))
    }

    /// The rows of a table that belong to it.
    fn rows<'t>(&self, view: View<'t>) -> View<'t> {
        let key = self.key();
        view.only("surface", key.surface).only("law", key.law).only("layer_thickness_m", key.thickness)
    }
}

/// Why the models differ, how sure the verdicts are, and the curves, folded.
pub fn section(page: &mut Page, results: &CompareResults, tables: &Tables, case: SurfaceCase) {
    let name = case.name(results);
    let stem = stem(case.surface, &case.first().law);
    let units = Units::new(results, case.surface);
    page.details(2, &format!("{name}: why do the models differ?"), |page| {
        why(page, tables, case, &stem, &units);
    });
    against_reference(page, case, &name, &stem, &units);
    page.details(2, &format!("{name}: other treatments of the map"), |page| {
        robustness(page, tables, case, &stem);
    });
    page.details(2, &format!("{name}: curves and tables"), |page| {
        if SurfaceCase::all(results).count() > 1 {
            main_figure::of_case(page, results, case);
        }
        regimes(page, case, &name, &stem, units);
        page.view(&case.rows(tables.view::<LineRow>()));
        page.view(&case.rows(tables.view::<CorrelationRow>()));
        page.view(&case.rows(tables.view::<SpreadRow>()).each_decade("pressure_pa", PER_DECADE));
        page.view(&by_load(tables, case).columns(&[
            "target",
            "statistical_separation_over_sigma",
            "deterministic_separation_over_sigma",
            "statistical_area_ratio",
            "deterministic_area_ratio",
            "statistical_mean_real_pressure_pa",
            "deterministic_mean_real_pressure_pa",
            "statistical_contacts",
            "deterministic_contacts",
            "limits",
        ]));
    });
}

/// Which intervals a figure of `differences` shows.
fn intervals(differences: &[Difference]) -> &'static str {
    let has_interval = |at: &Difference| at.estimates.iter().flatten().any(|one| one.interval().is_some());
    if differences.iter().any(has_interval) {
        "with 95 % intervals where they are claimed"
    } else {
        "no interval is claimed"
    }
}

/// Both models minus the reference; nothing where none was run, and of one load.
fn against_reference(page: &mut Page, case: SurfaceCase, name: &str, stem: &str, units: &Units) {
    let verdicts = case.verdicts();
    let Some(reference) = verdicts.reference.as_ref().filter(|_| !case.first().is_single()) else { return };
    let title = format!("{name}: each model minus the reference at equal load");
    let drawn = figure::against_reference(verdicts, &reference.against, units, &title);
    page.details(2, &format!("{name}: against the reference"), |page| {
        page.figure(
            &format!("{stem}-against-reference.svg"),
            drawn.headed(title.as_str()),
            &format!(
                "Each model minus the reference at equal load, {}. Green: accepted; grey: loads that are not admissible.",
                intervals(&reference.against.models.concat()),
            ),
        );
    });
}

/// Pairs at equal load of the first realisation.
fn by_load<'t>(tables: &'t Tables, case: SurfaceCase) -> View<'t> {
    let pairs = case.rows(tables.view::<PairRow>()).only("realisation", 1usize).only("pairing", "load");
    pairs.each_decade("target", PER_DECADE).label("target", "nominal pressure").unit("target", "Pa", "M")
}

/// What is shown of the contributions.
const PARTS: &[&str] =
    &["pressure_pa", "quantity", "cause", "contribution", "low", "high", "with_other_mean_radius"];

fn why(page: &mut Page, tables: &Tables, case: SurfaceCase, stem: &str, units: &Units) {
    let verdicts = case.verdicts();
    if verdicts.attribution.is_empty() {
        return;
    }
    const FINDING: &str = "Contributions of the causes to the difference between the models";
    if let Some(figure) = figure::by_cause(verdicts, units, FINDING).filter(|_| !case.first().is_single()) {
        page.figure(
            &format!("{stem}-causes.svg"),
            figure,
            "Contributions of heights, radii and their correlation to the difference between the models at equal load.",
        );
    }
    for quantity in [ComparedQuantity::Separation, ComparedQuantity::Area] {
        let loads: Vec<f64> = verdicts.divided(quantity).map(|(load, _)| load).collect();
        let loads = of_each_decade(loads, |load| *load, 1.0);
        let parts = case.rows(tables.view::<AttributionRow>()).only("quantity", quantity.name());
        let parts =
            parts.filter("pressure_pa", |cell| cell.number().is_some_and(|load| loads.contains(&load)));
        page.view(&parts.unit("pressure_pa", "Pa", "M").columns(PARTS));
    }
}

fn robustness(page: &mut Page, tables: &Tables, case: SurfaceCase, stem: &str) {
    let loads = case.case.treated_loads();
    let Some(&load) = loads.get(loads.len() / 2) else { return };
    if let Some(figure) =
        contact::against_filter(case.case, case.surface).filter(|_| !case.first().is_single())
    {
        page.figure(
                &format!("{stem}-filter.svg"),
                figure,
                "Differences between the models against the nesting index of the S filter; without a filter at one pixel; green: accepted.",
            );
    }
    let view = case.rows(tables.view::<RobustnessRow>()).only("at_pa", load).without(&["choice"]);
    page.view(
        &view
            .clone()
            .filter("quantity", |cell| cell.text() == "separation")
            .label("difference", "difference (σ)"),
    );
    let relative = view.filter("quantity", |cell| cell.text() != "separation");
    page.view(
        &["difference", "low", "high"]
            .into_iter()
            .fold(relative, |view, name| view.read_as(name, Reading::SignedPercent)),
    );
}

/// The share of the load by regime.
fn regimes(page: &mut Page, case: SurfaceCase, name: &str, stem: &str, units: Units) {
    if case.first().is_single() {
        return;
    }
    let loads = units.pressures();
    let valid = &case.verdicts().admissible;
    let setting = Setting { case: case.first(), valid, units, loads, shown: [0.0, f64::INFINITY] };
    if let Some(figure) = curves::regimes(&setting, name) {
        page.figure(&format!("{stem}-regimes.svg"), figure, "Share of the load by contact regime, by model.");
    }
}

pub fn statistical_model(page: &mut Page, surface: &SurfaceResults) {
    let RealisationFacts { population, model, .. } = &surface.realisations[0];
    let shape = population.heights.label().to_string();
    let inputs = match model.joint {
        Some(joint) => [joint.name().to_owned(), String::new(), String::new(), number(population.density)],
        None => [
            shape.split(" (").next().unwrap_or_default().to_owned(),
            input_quantity(population.sigma, "m"),
            format!("{} ({})", input_quantity(population.radius, "m"), model.mean_radius.name()),
            number(population.density),
        ],
    };
    page.table(["heights of the statistical model", "σ", "mean radius", "density (1/m²)"], [inputs.to_vec()]);
}

/// The contact in the reference at one load, of a few solutions.
pub fn contacts(page: &mut Page, results: &CompareResults, surface: &SurfaceResults) {
    /// More contacts, as of many thicknesses, are left to the tables.
    const MOST: usize = 4;
    page.details(3, &format!("{}: contact in the reference", surface.surface.name), |page| {
        for (index, view) in surface.contacts.iter().take(MOST).enumerate() {
            let name = if surface.contacts.len() == 1 { String::new() } else { format!("-{}", index + 1) };
            contact::contact_figures(page, results, surface, view, &name);
        }
    });
}

/// The figures by load and by thickness.
pub fn figures(series: &Series, page: &mut Page) {
    if let Some(figure) = layers::against_reference(series) {
        page.figure(
            &format!("{}-against-reference.svg", series.stem),
            figure,
            &format!(
                "{}: each model minus the reference at equal load, by layer thickness; green: accepted.",
                series.subject
            ),
        );
    }
    if !series.is_figure_of_paper {
        page.figure(
            &format!("{}-layers.svg", series.stem),
            layers::by_load(series),
            "Separation and real contact area against load, by layer thickness; thin lines: loads that are not admissible.",
        );
    }
    if series.findings.loads.is_empty() || series.findings.models.is_empty() || series.finite().count() < 2 {
        return;
    }
    page.figure(
        &format!("{}-thickness.svg", series.stem),
        layers::by_thickness(series),
        "Area, mean contact pressure and share of the load that yields against layer thickness; circles: admissible loads; markers at the \
         edges: uncoated and bulk.",
    );
    let Some(regimes) = layers::regimes(series) else { return };
    page.figure(
        &format!("{}-regimes.svg", series.stem),
        regimes,
        &format!(
            "Share of the load by contact regime against layer thickness ({} model); an asterisk marks a load that is not admissible \
             at some thickness.",
            series.findings.main_model().name()
        ),
    );
}

/// Both models at the loads at which thicknesses are compared.
pub fn table(series: &Series, page: &mut Page, tables: &Tables) {
    let loads = &series.findings.loads;
    if loads.is_empty() {
        page.paragraph(
            "Without `pressure` or `force` in the spec thicknesses are not compared at equal load.",
        );
        return;
    }
    if series.realisations > 1 {
        page.paragraph(&format!(
            "Shown: the first of {} {}; `curves.csv` has all.",
            series.realisations, series.repeats
        ));
    }
    let view =
        tables.view::<CurveRow>().only("surface", series.surface).only("law", series.cases[0].law.as_str());
    let view = view.only("realisation", 1usize);
    let at_pressures = view.clone().only("control", "pressure");
    let at_pressures =
        at_pressures.filter("target", |cell| cell.number().is_some_and(|load| loads.contains(&load)));
    page.view(&with_columns(at_pressures.label("target", "nominal pressure").unit("target", "Pa", "M")));
    let at_forces = view.only("control", "force");
    let at_forces = at_forces.filter("pressure_pa", |cell| {
        let is_near = |pressure: f64| loads.iter().any(|load| (pressure / load - 1.0).abs() < SAME_LOAD);
        cell.number().is_some_and(is_near)
    });
    page.view(&with_columns(at_forces.label("target", "force").unit("target", "N", "")));
}

/// Loads that differ by less, relatively, are the same one, found again.
const SAME_LOAD: f64 = 1e-6;

/// The columns of a table by thickness.
fn with_columns(view: View) -> View {
    view.columns(&[
        "target",
        "layer_thickness_m",
        "model",
        "contact_radius_over_thickness",
        "separation_over_sigma",
        "area_ratio",
        "mean_real_pressure_pa",
        "elastic_load_share",
        "elastic_plastic_load_share",
        "plastic_load_share",
        "limits",
    ])
}
