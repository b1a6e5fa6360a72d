//! What every page says: the bodies, the sources, the files.

use super::format::{count, number, quantity};
use super::page::Page;
use crate::experiment::MapFacts;
use crate::experiment::results::Head;

/// The bodies and the spec.
pub fn what_was_run(page: &mut Page, head: &Head) {
    page.heading(2, "What was run");
    let value = |value: Option<f64>| value.map_or_else(|| "never yields".to_owned(), |v| quantity(v, "Pa"));
    let roles = |name: &str| match (name == head.bodies.rough, name == head.bodies.flat) {
        (true, true) => "rough and flat",
        (true, false) => "rough",
        (false, true) => "flat",
        (false, false) => "not used",
    };
    page.table(
        ["material", "body", "E", "ν", "H"],
        head.materials.iter().map(|(name, body)| {
            vec![
                name.clone(),
                roles(name).to_owned(),
                quantity(body.young(), "Pa"),
                number(body.poisson()),
                value(body.hardness()),
            ]
        }),
    );
    page.paragraph(&format!(
        "Reduced modulus E* = {}; hardness of the softer body: {}. Seed {}; spec `{}.toml`, SHA-256 `{}`. Asperity {}.",
        quantity(head.reduced_modulus, "Pa"),
        value(head.hardness),
        head.seed,
        head.stem,
        head.spec_sha256,
        env!("CARGO_PKG_VERSION"),
    ));
}

/// The papers behind what was run.
pub fn sources(page: &mut Page, head: &Head) {
    page.heading(2, "Sources");
    page.bullets(head.papers.iter().map(|paper| paper.full));
}

/// What a height map is, as rows of a table.
pub fn map_rows(map: &MapFacts) -> Vec<[String; 2]> {
    let pair = |values: [f64; 2]| {
        if values[0] == values[1] {
            quantity(values[0], "m")
        } else {
            format!("{} × {}", quantity(values[0], "m"), quantity(values[1], "m"))
        }
    };
    let or_none = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), number);
    let moments = &map.moments;
    let steps = &map.quantisation;
    let mut rows = vec![
        ["map".to_owned(), format!("{} × {} points of {}", map.points[0], map.points[1], pair(map.pixel))],
        ["missing points".to_owned(), count(map.missing)],
        ["levelled by".to_owned(), map.level.name().to_owned()],
        ["Sa, Sq".to_owned(), format!("{}, {}", quantity(moments.sa, "m"), quantity(moments.sq, "m"))],
        ["Ssk, Sku".to_owned(), format!("{}, {}", or_none(moments.ssk), or_none(moments.sku))],
        [
            "five-point summits, of points tested".to_owned(),
            format!("{} of {}", count(map.summits), count(map.tested)),
        ],
        [
            "height step of the instrument".to_owned(),
            steps.step.map_or_else(|| "none found".to_owned(), |step| quantity(step, "m")),
        ],
        [
            "height levels, distinct curvatures".to_owned(),
            format!("{}, {}", count(steps.levels), count(steps.distinct_curvatures)),
        ],
        ["median drop from a summit to its neighbours".to_owned(), quantity(steps.median_drop, "m")],
    ];
    if let Some(filter) = &map.filter {
        rows.push(["Gaussian filter (ISO 16610-61)".to_owned(), filter.clone()]);
    }
    if map.plateaus > 0 {
        rows.push(["plateaus, of them dropped".to_owned(), format!("{}, {}", map.plateaus, map.dropped)]);
    }
    rows
}
