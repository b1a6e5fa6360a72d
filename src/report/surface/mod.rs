//! What a surface is: the same words in the terminal, in a comparison and on a page of its own.

mod figures;
mod page;
mod words;

pub use page::page;

use super::format::{number, percent, quantity};
use super::page::Page;
use crate::experiment::{MapFacts, Surface};
use crate::surface::generate::{Process, Recipe};
use crate::surface::marginal::Marginal;
use crate::surface::spectrum::Shape;
use words::{or_dash, properties, table};

/// Adds tables and pictures of a surface to a page.
pub fn section(page: &mut Page, surface: &Surface, assumed: Option<&crate::asperity::Population>) {
    page.table(["property", "value"], properties(surface).into_iter().map(Vec::from));
    if let Some(map) = &surface.map {
        generation(page, surface, map);
        theory(page, surface, map);
        if let Some(picture) = &map.whole.picture {
            let caption = format!("Height map of {}, the mean plane at zero.", surface.name);
            page.figure(&format!("{}-heights.svg", surface.name), figures::heights(picture), &caption);
        }
        if let Some(svg) = figures::spectrum(&map.whole) {
            let window =
                if map.generation.is_some() { "" } else { " A Hann window keeps the borders from showing." };
            page.figure(
                &format!("{}-spectrum.svg", surface.name),
                svg,
                &format!(
                    "Power spectral density of {} over rings of wave numbers q; its integral over the plane of wave vectors is \
                     Sq².{window}",
                    surface.name
                ),
            );
        }
        if let Some(correlation) = &map.whole.autocorrelation {
            page.figure(
                &format!("{}-autocorrelation.svg", surface.name),
                figures::autocorrelation(correlation),
                &format!(
                    "Autocorrelation of {} along both axes; Sal is where it first falls to 0.2.",
                    surface.name
                ),
            );
        }
    }
    let (svg, beyond) = figures::asperities(surface, assumed);
    let beyond = if beyond > 0.0 {
        format!(" Outside the picture: {} of the asperities.", percent(beyond))
    } else {
        String::new()
    };
    let caption = format!(
        "The asperities of {}: radius over mean radius against normalised height, how many lie in each cell, and both \
         distributions.{beyond}",
        surface.name
    );
    page.figure(&format!("{}-asperities.svg", surface.name), svg, &caption);
}

/// Of a random surface, what was asked for and what was reached.
fn generation(page: &mut Page, surface: &Surface, map: &MapFacts) {
    let Some(made) = &map.generation else { return };
    page.paragraph(&format!(
        "{} is a random surface, periodic at its borders: {}.",
        surface.name,
        recipe(&made.recipe)
    ));
    let statistics = &surface.statistics;
    let off = |asked: f64, reached: f64| percent((reached / asked - 1.0).abs());
    let mut rows: Vec<[String; 4]> = Vec::new();
    let mut row = |what: &str, asked: f64, reached: f64, unit: &str| {
        rows.push([what.to_owned(), quantity(asked, unit), quantity(reached, unit), off(asked, reached)]);
    };
    if let Some((target, _)) = &made.target {
        row("mean radius of the summits", target.radius, statistics.mean_radius, "m");
        row("σ of the summit heights", target.sigma, statistics.sigma, "m");
        row("density of the summits", target.density, surface.set.density(), "1/m²");
    }
    let process = &made.recipe.process;
    let moments = &map.character.moments;
    if made.recipe.plateau.is_none() {
        row("Sq", process.sigma, moments.sq, "m");
        let mut moment = |what: &str, asked: f64, reached: Option<f64>| {
            rows.push([
                what.to_owned(),
                number(asked),
                or_dash(reached),
                reached
                    .map_or_else(String::new, |reached| format!("{} apart", number((reached - asked).abs()))),
            ]);
        };
        moment("Ssk", process.heights.skewness(), moments.ssk);
        moment("Sku", process.heights.kurtosis(), moments.sku);
    }
    if let (Some(asked), Some(reached)) = (&map.whole.asked, &map.whole.spectrum) {
        let ratio = asked.quartiles_of(reached);
        rows.push([
            "spectrum: variance by rings of wave numbers".to_owned(),
            "1".to_owned(),
            format!("{} to {} times (middle half of the rings)", number(ratio[0]), number(ratio[1])),
            String::new(),
        ]);
    }
    page.table(["quantity", "asked", "reached", "off"], rows.into_iter().map(Vec::from));
    if let Some((_, tried)) = made.target {
        page.paragraph(&format!(
            "Density × radius × σ depends on the bandwidth of the spectrum alone: it was searched for over {tried} surfaces of the \
             same random numbers, then heights were scaled to σ and lengths to the density. What is asked of Sq and the \
             spectrum is what the search found.",
        ));
    }
    let mut notes = vec![
        "Sq, Ssk, Sku and the spectrum asked for are those of all surfaces of the process; one surface scatters about them.",
    ];
    if process.heights != Marginal::Gaussian {
        notes.push("The map from Gaussian to other heights changes the spectrum: the one asked for is that of the Gaussian surface.");
    }
    page.paragraph(&notes.join(" "));
}

/// A recipe in words.
fn recipe(recipe: &Recipe) -> String {
    let process = |process: &Process| {
        let length = |length: f64| quantity(length, "m");
        let shape = match process.spectrum.shape() {
            Shape::SelfAffine { hurst, roll_off, cut_off } => format!(
                "self-affine spectrum with Hurst exponent {}, roll-off at a wavelength of {} and cut-off at {} ({} times \
                 shorter)",
                number(hurst),
                length(roll_off),
                length(cut_off),
                number(roll_off / cut_off)
            ),
            Shape::Gaussian(l) => format!("Gaussian autocorrelation with correlation length {}", length(l)),
            Shape::Exponential(l) => {
                format!("exponential autocorrelation with correlation length {}", length(l))
            }
        };
        let lay = process.spectrum.lay();
        let lay = if lay.elongation == 1.0 {
            String::new()
        } else {
            format!(
                ", {} times longer along a lay at {}° to the x axis",
                number(lay.elongation),
                number(lay.angle.to_degrees())
            )
        };
        format!("{shape}{lay}; heights {} with standard deviation {}", process.heights, length(process.sigma))
    };
    match &recipe.plateau {
        None => process(&recipe.process),
        Some(plateau) => format!(
            "{}; cut by a finer process {} above its mean plane: {}",
            process(&recipe.process),
            quantity(plateau.height, "m"),
            process(&plateau.process)
        ),
    }
}

/// How far the found summits are from what theory expects of a Gaussian surface.
fn theory(page: &mut Page, surface: &Surface, map: &MapFacts) {
    let expected = [map.expected, map.nayak];
    if expected.iter().all(Option::is_none) {
        return;
    }
    let statistics = &surface.statistics;
    let sq = map.character.moments.sq;
    let plane = surface.mean_plane.unwrap_or_default();
    let found = [
        surface.set.density(),
        statistics.radius_of_mean_curvature.recip(),
        (statistics.mean_height - plane) / sq,
        (statistics.sigma / sq).powi(2),
    ];
    let of = |expected: &crate::surface::theory::Expected| {
        [expected.density, expected.curvature, expected.height / sq, expected.height_variance / (sq * sq)]
    };
    let names = [
        "density [1/m²]",
        "mean curvature [1/m]",
        "mean height above the mean plane / Sq",
        "variance of heights / Sq²",
    ];
    let rows = (0..names.len()).map(|k| {
        let mut row = vec![names[k].to_owned(), number(found[k])];
        for theory in &expected {
            row.push(or_dash(theory.as_ref().map(|theory| of(theory)[k])));
            let ratio = theory.as_ref().map(|theory| found[k] / of(theory)[k]);
            row.push(ratio.map_or_else(|| "-".to_owned(), |ratio| format!("{ratio:.3}")));
        }
        row
    });
    page.paragraph(&format!(
        "The {} summits that were found, and those of a Gaussian surface:",
        map.neighbours.name()
    ));
    page.table(["summits", "found", "five-point theory", "found / theory", "Nayak", "found / Nayak"], rows);
    page.paragraph(
        "Five-point theory: a Gaussian surface with the autocorrelation of this one at neighbouring points, on the same grid. \
         Nayak: a continuous isotropic Gaussian surface with its m0, m2 and m4; on a fine grid five points count 1.306 times as \
         many, saddles among them.",
    );
}

/// Rows of a table for a terminal.
pub fn for_terminal(surface: &Surface) -> String {
    table(properties(surface))
}
