//! A surface under one law by layer thickness: Fig. 6 of Pasaribu and Schipper (2005), and thickness as an axis.

use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::table::Tables;
use asperity_contact_framework::report::view::View;

use crate::kind::compare::figures::layers;
use crate::kind::compare::series::Series;
use crate::model_tables::CurveRow;

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
