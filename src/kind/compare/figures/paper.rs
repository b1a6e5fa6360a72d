//! Figures of Pasaribu and Schipper (2005), in the paper's axes.

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::report::page::Page;
use asperity_plot::{Figure, Plot};

use super::curves::{Setting, all_loads};
use super::differences::shown_loads;
use super::layers::panels_by_load;
use super::lines::Units;
use crate::kind::compare::results::{CompareResults, SurfaceResults};
use crate::kind::compare::rows::SurfaceCase;
use crate::kind::compare::series::Series;
use crate::paper::title;
use crate::surface::section::radii_against_heights;

/// Adds those that the spec reproduces.
pub fn figures(page: &mut Page, results: &CompareResults, series: &[Series]) {
    for &number in &results.figures_of_paper {
        let (figure, what, how) = match number {
            3 => (radii(results), "radii against heights of the asperities", "Colour: asperities per cell"),
            4 => (
                separations(results),
                "separation against load",
                "Bands: 95 % intervals; grey: not admissible",
            ),
            _ => (
                thicknesses(series),
                "separation and real contact area against load by layer thickness",
                "Thin lines: not admissible",
            ),
        };
        let title = title(number, what);
        page.figure(
            &format!("figure-{number}-of-paper.svg"),
            figure.titled(title.as_str()),
            &format!("{title}. {how}."),
        );
    }
}

/// The surfaces whose radii differ, as the paper's do; all where those of none do.
fn rough(results: &CompareResults) -> Vec<&SurfaceResults> {
    let all: Vec<&SurfaceResults> = results.surfaces.iter().collect();
    let differ: Vec<&SurfaceResults> =
        all.iter().copied().filter(|results| results.surface.statistics.radius_cv > 0.0).collect();
    if differ.is_empty() { all } else { differ }
}

fn radii(results: &CompareResults) -> Figure {
    let panel = |results: &&SurfaceResults| {
        radii_against_heights(
            &results.surface,
            Some(&results.realisations[0].population),
            &results.surface.name,
        )
    };
    Figure::row("", rough(results).iter().map(panel).collect())
}

fn separations(results: &CompareResults) -> Figure {
    let surfaces = rough(results);
    let cases = surfaces.iter().flat_map(|surface| SurfaceCase::on_surface(surface));
    let panel = |case: SurfaceCase| -> Plot {
        let units = Units::new(results, case.surface);
        let valid = &case.verdicts().admissible;
        let shown = shown_loads(valid, all_loads(case.first()));
        let setting = Setting { case: case.first(), valid, units, loads: units.ratios(), shown };
        setting.plot(ComparedQuantity::Separation, &[], Vec::new()).titled(case.name(results)).height(300.0)
    };
    Figure::row("", cases.map(panel).collect())
}

fn thicknesses(series: &[Series]) -> Figure {
    let panels = series.iter().flat_map(|series| {
        panels_by_load(series).map(|plot| plot.titled(series.subject.as_str()).height(300.0))
    });
    Figure::grid("", 2, panels.collect())
}
