//! Description of a surface: the same text in the terminal, in a comparison and on a page of its own.

mod figures;
mod generation;
mod properties;

use crate::surface::fitness;
use crate::surface::found::{MapFacts, Surface};
use asperity::topography::theory::Expected;
use asperity_framework::report::format::{count, number, percent, ratio};
use asperity_framework::report::page::Page;
pub use figures::unit as length_unit;
pub use properties::sentence;
use properties::{columns, properties, table};

/// Adds tables and figures of a surface to a page, those that most readers want first.
pub fn section(page: &mut Page, surface: &Surface, assumed: Option<&asperity::Population>) {
    let name = &surface.name;
    if let Some(map) = &surface.map {
        height_map(page, surface, map);
    }
    fitness::section(page, surface);
    asperities(page, surface, assumed);
    page.details(3, &format!("{name}: properties"), |page| {
        page.table(["property", "value"], properties(surface).into_iter().map(Vec::from));
        if let Some(map) = &surface.map {
            if let Some(made) = &map.generation {
                generation::section(page, surface, map, made);
            }
            theory(page, surface, map);
        }
    });
    if let Some(map) = &surface.map {
        page.details(3, &format!("{name}: heights and spectrum"), |page| spectra(page, name, map));
    }
}

fn height_map(page: &mut Page, surface: &Surface, map: &MapFacts) {
    let Some(picture) = &map.whole.picture else { return };
    let missing = if map.roughness.missing > 0 { " Missing points are white." } else { "" };
    let marked = map.spike_places();
    let spikes = match map.spikes.as_ref().map_or(0, |spikes| spikes.left.count()) {
        0 => String::new(),
        1 => "One spike is circled. ".to_owned(),
        found => format!("{} spikes are circled. ", count(found)),
    };
    let name = &surface.name;
    let caption =
        format!("{spikes}Height map of {name}; the colour scale covers 99.5 % of the points.{missing}");
    page.figure(&format!("{name}-heights.svg"), figures::heights(name, picture, &marked), &caption);
}

/// Distribution of heights, spectrum and autocorrelation of a map.
fn spectra(page: &mut Page, name: &str, map: &MapFacts) {
    if let Some(counts) = &map.whole.distribution {
        page.figure(
            &format!("{name}-height-distribution.svg"),
            figures::distribution(name, counts),
            &format!("Height distribution of the points of {name}, with a Gaussian of equal Sq."),
        );
    }
    if let Some(figure) = figures::spectrum(name, &map.whole) {
        let window = if map.generation.is_some() {
            ""
        } else {
            " A Hann window suppresses edge effects; missing points are set to the mean."
        };
        page.figure(
            &format!("{name}-spectrum.svg"),
            figure,
            &format!(
                "Power spectral density of {name}, averaged over rings of wave number q; its integral over the plane of wave \
                 vectors is Sq².{window}"
            ),
        );
    }
    if let Some(correlation) = &map.whole.autocorrelation {
        page.figure(
            &format!("{name}-autocorrelation.svg"),
            figures::autocorrelation(name, correlation),
            &format!("Autocorrelation of {name} along both axes; Sal is the shortest lag at which it decreases to 0.2."),
        );
    }
}

/// Heights and radii of the asperities.
fn asperities(page: &mut Page, surface: &Surface, assumed: Option<&asperity::Population>) {
    let (figure, beyond) = figures::asperities(surface, assumed);
    let beyond = if beyond > 0.0 {
        format!(" Outside the axes: {} of the asperities.", percent(beyond))
    } else {
        String::new()
    };
    let name = &surface.name;
    let caption = if surface.statistics.radius_cv == 0.0 {
        format!("Height distribution of the asperities of {name}; all have the same radius.{beyond}")
    } else {
        format!(
            "Asperities of {name}: number per cell of normalised radius and normalised height, with both distributions.{beyond}"
        )
    };
    page.figure(&format!("{name}-asperities.svg"), figure, &caption);
}

/// Summits found and expected for a Gaussian surface: header and rows. `None` where there is no theory.
fn theory_table(surface: &Surface, map: &MapFacts) -> Option<(Vec<&'static str>, Vec<Vec<String>>)> {
    let expected = [
        (map.expected.as_ref(), ["five-point theory", "found / theory"]),
        (map.nayak.as_ref(), ["Nayak", "found / Nayak"]),
    ];
    let expected: Vec<(&Expected, [&str; 2])> =
        expected.into_iter().filter_map(|(theory, header)| theory.map(|theory| (theory, header))).collect();
    if expected.is_empty() {
        return None;
    }
    let statistics = &surface.statistics;
    let sq = map.roughness.moments.sq;
    let plane = surface.mean_plane.unwrap_or_default();
    let found = [
        surface.set.density(),
        statistics.radius_of_mean_curvature.recip(),
        (statistics.mean_height - plane) / sq,
        (statistics.sigma / sq).powi(2),
    ];
    let of = |expected: &Expected| {
        [expected.density, expected.curvature, expected.height / sq, expected.height_variance / (sq * sq)]
    };
    let names = [
        "density [1/m²]",
        "mean curvature [1/m]",
        "mean height above the mean plane / Sq",
        "variance of heights / Sq²",
    ];
    let header =
        ["summits", "found"].into_iter().chain(expected.iter().flat_map(|(_, header)| *header)).collect();
    let row = |k: usize| {
        let mut row = vec![names[k].to_owned(), number(found[k])];
        for (theory, _) in &expected {
            row.extend([number(of(theory)[k]), ratio(found[k] / of(theory)[k])]);
        }
        row
    };
    Some((header, (0..names.len()).map(row).collect()))
}

/// Summits found compared with theory for a Gaussian surface.
fn theory(page: &mut Page, surface: &Surface, map: &MapFacts) {
    let Some((header, rows)) = theory_table(surface, map) else { return };
    page.paragraph(&format!(
        "The {} summits found, compared with theory for a Gaussian surface:",
        map.neighbours.name()
    ));
    page.table(header, rows);
    let five_point = "Five-point theory: a Gaussian surface with the autocorrelation of this one at neighbouring points, on the same grid. ";
    page.paragraph(&format!(
        "{}Nayak: a continuous isotropic Gaussian surface with the same m0, m2 and m4; on a fine grid the five-point \
         criterion finds 1.306 times as many summits, because it includes saddles.",
        if map.expected.is_some() { five_point } else { "" }
    ));
}

/// Tables for a terminal.
pub fn for_terminal(surface: &Surface) -> String {
    let which = match surface.realisations {
        1 => String::new(),
        count => format!(", the first of {count} realisations"),
    };
    let mut tables = format!("surface {}{which}\n{}", surface.name, table(properties(surface)));
    let mut add = |header: &[&str], rows: Vec<Vec<String>>| {
        if !rows.is_empty() {
            tables.push('\n');
            tables.push_str(&columns(header, &rows));
        }
    };
    if let Some(map) = &surface.map {
        if let Some(made) = &map.generation {
            add(&generation::HEAD, generation::rows(surface, map, made));
        }
        if let Some((header, rows)) = theory_table(surface, map) {
            add(&header, rows);
        }
    }
    let checks = fitness::for_terminal(surface);
    if !checks.is_empty() {
        tables.push('\n');
        tables.push_str(&table(checks));
    }
    tables
}
