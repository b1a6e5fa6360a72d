//! Of a random surface, what was asked for and what was reached.

use super::words::or_dash;
use crate::surface::found::{GenerationFacts, MapFacts, Surface};
use asperity::Heights;
use asperity::topography::generate::{Process, SpectrumOf, SurfaceGenerator};
use asperity::topography::spectrum::SpectrumShape;
use asperity_framework::report::format::{number, percent, quantity};
use asperity_framework::report::page::Page;

/// Says how a surface was made, and how far it is from what was asked for.
pub fn section(page: &mut Page, surface: &Surface, map: &MapFacts, made: &GenerationFacts) {
    page.paragraph(&format!(
        "{} is a random surface, periodic at its borders: {}.",
        surface.name,
        generator(&made.generator)
    ));
    if let Some(cut) = made.cut {
        page.paragraph(&format!(
            "The finer process has cut {} of the points. Standard deviations, heights and spectra asked for are those of the two \
             processes; what they leave together has Sq, Ssk and Sku as in the table above.",
            percent(cut)
        ));
        return;
    }
    page.table(HEAD, rows(surface, map, made));
    if let Some((_, tried)) = made.target {
        page.paragraph(&format!(
            "With this Hurst exponent, these heights and this cut-off in pixels, density × radius × σ depends on the bandwidth of the \
             spectrum alone: it was searched for over {tried} surfaces of the same random numbers, then heights were scaled to σ and lengths to the density. What is asked of Sq and the \
             spectrum is what the search found.",
        ));
    }
    page.paragraph(
        "Sq, Ssk, Sku and the spectrum asked for are those of an endless surface; one map, about its own mean, scatters about \
         them.",
    );
    let process = &made.generator.process;
    if process.heights != Heights::GAUSSIAN {
        page.paragraph(match process.of {
            SpectrumOf::Heights => {
                "The map from Gaussian to other heights changes a spectrum: the Gaussian field was given the one that becomes what \
                 was asked for, as far as there is such a field."
            }
            SpectrumOf::Gaussian => {
                "The map from Gaussian to other heights changes a spectrum: the one asked for is that of the Gaussian field before."
            }
        });
    }
}

/// What was asked for and what was reached.
pub const HEAD: [&str; 4] = ["quantity", "asked", "reached", "off"];

/// Rows below [`HEAD`]; none where a finer process has cut the surface, of which nothing is asked.
pub fn rows(surface: &Surface, map: &MapFacts, made: &GenerationFacts) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    if made.cut.is_some() {
        return rows;
    }
    if let Some((target, _)) = &made.target {
        rows.push(ratio("mean radius of the summits", target.radius, surface.statistics.mean_radius, "m"));
        rows.push(ratio("σ of the summit heights", target.sigma, surface.statistics.sigma, "m"));
        rows.push(ratio("density of the summits", target.density, surface.set.density(), "1/m²"));
    }
    let (process, moments) = (&made.generator.process, &map.roughness.moments);
    rows.push(ratio("Sq", process.sigma, moments.sq, "m"));
    rows.push(difference("Ssk", process.heights.skewness(), moments.ssk));
    rows.push(difference("Sku", process.heights.kurtosis(), moments.sku));
    if let (Some(asked), Some(reached)) = (&map.whole.asked, &map.whole.spectrum) {
        let [low, high] = asked.quartiles_of(reached).map(number);
        let reached = format!("{low} to {high} times");
        rows.push(vec![
            "spectrum, middle half of its rings".to_owned(),
            "1".to_owned(),
            reached,
            String::new(),
        ]);
    }
    rows
}

fn ratio(what: &str, asked: f64, reached: f64, unit: &str) -> Vec<String> {
    /// What is off by less is off by rounding.
    const ROUNDING: f64 = 1e-12;
    let off = Some((reached / asked - 1.0).abs()).filter(|&off| off > ROUNDING).unwrap_or(0.0);
    vec![what.to_owned(), quantity(asked, unit), quantity(reached, unit), percent(off)]
}

fn difference(what: &str, asked: f64, reached: Option<f64>) -> Vec<String> {
    let apart = reached.map_or_else(String::new, |reached| number((reached - asked).abs()));
    vec![what.to_owned(), number(asked), or_dash(reached), apart]
}

/// A generator in words.
fn generator(generator: &SurfaceGenerator) -> String {
    let process = |process: &Process| {
        let length = |length: f64| quantity(length, "m");
        let shape = match process.spectrum.shape() {
            SpectrumShape::SelfAffine { hurst, roll_off, cut_off } => format!(
                "self-affine spectrum with Hurst exponent {}, roll-off at a wavelength of {} and cut-off at {} ({} times \
                 shorter)",
                number(hurst),
                length(roll_off),
                length(cut_off),
                number(roll_off / cut_off)
            ),
            SpectrumShape::Gaussian(l) => {
                format!("Gaussian autocorrelation with correlation length {}", length(l))
            }
            SpectrumShape::Exponential(l) => {
                format!("exponential autocorrelation with correlation length {}", length(l))
            }
        };
        let lay = process.spectrum.lay();
        let lay = if lay.elongation == 1.0 {
            String::new()
        } else {
            let (times, comparative) = if lay.elongation > 1.0 {
                (lay.elongation, "longer")
            } else {
                (lay.elongation.recip(), "shorter")
            };
            let angle = number(lay.angle.to_degrees());
            format!(" across a lay at {angle}° to the x axis, {} times {comparative} along it", number(times))
        };
        format!("{shape}{lay}; heights {} with standard deviation {}", process.heights, length(process.sigma))
    };
    match &generator.plateau {
        None => process(&generator.process),
        Some(plateau) => format!(
            "{}; cut by a finer process whose mean plane is {} {}: {}",
            process(&generator.process),
            quantity(plateau.height.abs(), "m"),
            if plateau.height < 0.0 { "lower" } else { "higher" },
            process(&plateau.process)
        ),
    }
}
