//! Results as the page shows them: pieces of the report, curves to lay over others, fitness checks with what remedies them.

use asperity::HeightMap;
use asperity::compare::ModelKind;
use asperity::law::Body;
use asperity::surface::Surface;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::remedy::FrontEnd;
use asperity_contact_framework::report::page::{Page, Pieces};
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_workbench::engine::Heights;
use serde_json::{Map, Value, json};

use crate::kind::compare::Extent;
use crate::kind::compare::card::Card;
use crate::kind::compare::figures::main_figure::of_case_with_map;
use crate::kind::compare::results::CompareResults;
use crate::kind::compare::rows::SurfaceCase;
use crate::surface::keys;
use crate::surface::rows::{self, SurfaceRow};
use crate::surface::section::section;

/// The most cases of which each has its card.
pub const MOST_CARDS: usize = 3;

/// Lines of a card that need no interval.
const WITHOUT_INTERVAL: [&str; 4] = ["result", "conductance", "friction", "difference"];

pub fn page(page: Page, warnings: Vec<String>) -> Value {
    json!({ "cases": [], "page": page.read_in(FrontEnd::Workbench).pieces(true), "warnings": told(&warnings) })
}

/// A comparison: each of few cases with its card, or the page of many; of an `extent` with intervals the folded sections, too.
pub fn comparison(results: &CompareResults, extent: Extent) -> Value {
    let has_intervals = extent >= Extent::Intervals;
    let all: Vec<SurfaceCase> = SurfaceCase::all(results).collect();
    let is_few = all.len() <= MOST_CARDS;
    let cases: Vec<Value> = all
        .iter()
        .map(|case| {
            let mut page = Page::new(case.name(results));
            if is_few {
                let lines = Card::new(*case).lines().into_iter();
                let shown = lines.filter(|line| has_intervals || WITHOUT_INTERVAL.contains(&line.key.as_str()));
                page.card(shown.collect());
                of_case_with_map(&mut page, results, *case);
            }
            let coated = results.contact.layer.as_ref().map(|layer| {
                let bodies = &results.contact.bodies;
                let name = if layer.on == Body::Rough { &bodies.rough } else { &bodies.flat };
                format!("{}, {name}", if layer.on == Body::Rough { "rough body" } else { "flat" })
            });
            json!({
                "name": case.name(results),
                "coated": coated.filter(|_| case.first().thickness != Some(0.0)),
                "thickness_m": case.first().thickness.map(|thickness| if thickness.is_finite() { json!(thickness) } else { json!("inf") }),
                "pieces": page.read_in(FrontEnd::Workbench).pieces(false),
                "curves": curves(case),
            })
        })
        .collect();
    let page = (has_intervals || !is_few).then(|| {
        let tables = Tables::new(results.tables());
        let Pieces { card, mut figures, lead, sections, title } =
            results.page(&tables).read_in(FrontEnd::Workbench).pieces(has_intervals);
        // Those of the cases are there already.
        if is_few && results.surfaces.len() == 1 && all.len() == 1 {
            figures.clear();
        }
        json!(Pieces { card, figures, lead, sections, title })
    });
    json!({ "cases": cases, "page": page, "warnings": told(&results.warnings()) })
}

/// Warnings that name the controls of the page.
fn told(warnings: &[String]) -> Vec<String> {
    warnings.iter().map(|warning| FrontEnd::Workbench.text(warning)).collect()
}

/// Each model of a case by load: pressure (Pa), area ratio, d/sigma, contacts per area (1/m²), mean pressure in the contacts (Pa).
fn curves(case: &SurfaceCase) -> Value {
    let points = &case.first().comparison.curves;
    let model = |kind: ModelKind| {
        let mut of_model: Vec<_> =
            points.iter().filter(|point| point.kind == kind).map(|point| &point.response).collect();
        of_model.retain(|response| response.pressure.total() > 0.0);
        of_model.sort_by(|a, b| a.pressure.total().total_cmp(&b.pressure.total()));
        let column = |value: &dyn Fn(&asperity::Response) -> f64| {
            of_model.iter().map(|response| value(response)).collect::<Vec<f64>>()
        };
        json!({
            "pressure_pa": column(&|response| response.pressure.total()),
            "area_ratio": column(&|response| response.area_ratio.total()),
            "separation_over_sigma": column(&|response| response.separation_over_sigma),
            "contact_density_per_m2": column(&|response| response.contact_density),
            "mean_real_pressure_pa": column(&|response| response.pressure.total() / response.area_ratio.total()),
        })
    };
    let models = [ModelKind::Statistical, ModelKind::Deterministic];
    let fields: Map<String, Value> =
        models.into_iter().map(|kind| (kind.name().to_owned(), model(kind))).collect();
    fields.into()
}

/// A surface: what the page of a report says of it, its checks with the keys that remedy them, and its map.
pub fn surface(surface: &Surface) -> Value {
    let tables = Tables::new(rows::tables([SurfaceRow::new(surface)]));
    let mut page = Page::new(&surface.name);
    section(&mut page, &tables, surface, None);
    let map = surface.map.as_ref().map(|map| {
        json!({
            "points": map.points,
            "pixel_m": map.pixel,
            "missing": map.roughness.missing,
            "sq_m": map.roughness.moments.sq,
            "mean_m": map.roughness.moments.mean,
            "distribution": map.whole.distribution,
            "spikes_m": map.spike_places(),
            "is_blocked": surface.is_blocked(),
        })
    });
    // The preparation that `fit` found, as keys that do the same.
    let found = surface.fit.as_ref().and_then(|fit| keys(fit).join("\n").parse::<toml::Table>().ok());
    let fitness = Table::new(rows::fitness(surface)).records();
    let fitness: Vec<Value> = fitness.as_array().into_iter().flatten().cloned().map(with_keys).collect();
    json!({
        "name": surface.name,
        "asperities": surface.set.count(),
        "page": page.read_in(FrontEnd::Workbench).pieces(true),
        "fitness": fitness,
        "found": found,
        "map": map,
        "warnings": told(&surface.warnings),
    })
}

/// A row of the checks, with its remedy as keys of `[surface.NAME.file]`.
fn with_keys(mut row: Value) -> Value {
    let setting = row["setting"].as_str().map(|setting| setting.trim_matches('`').to_owned());
    let keys = setting.and_then(|setting| setting.parse::<toml::Table>().ok());
    row["keys"] = json!(keys);
    row
}

/// The heights of a map with at most `most` points along an axis: every so many of its own.
pub fn heights(map: &HeightMap, most: usize) -> Heights {
    let [nx, ny] = map.points();
    let every = nx.max(ny).div_ceil(most).max(1);
    let along = |count: usize| (0..count).step_by(every);
    let heights = along(nx)
        .flat_map(|ix| along(ny).map(move |iy| ix * ny + iy))
        .map(|at| map.heights()[at] as f32)
        .collect();
    Heights {
        points: [along(nx).len(), along(ny).len()],
        pixel: map.pixel().map(|size| size * every as f64),
        every,
        heights,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_map_is_shown_by_points_of_its_own() {
        let map = HeightMap::new([5, 3], [1.0, 2.0], (0..15).map(f64::from).collect(), 0.0).unwrap();
        let all = heights(&map, 5);
        assert_eq!((all.points, all.every, all.heights.len()), ([5, 3], 1, 15));
        let few = heights(&map, 3);
        assert_eq!((few.points, few.every, few.pixel), ([3, 2], 2, [2.0, 4.0]));
        assert_eq!(few.heights, [0.0, 2.0, 6.0, 8.0, 12.0, 14.0]);
    }
}
