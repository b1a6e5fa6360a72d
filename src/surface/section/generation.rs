//! Target and obtained properties of a random surface.

use super::properties::or_dash;
use crate::surface::found::{GenerationFacts, MapFacts, Surface};
use asperity::Heights;
use asperity::topography::generate::{Process, SigmaOf, SpectrumOf, SurfaceGenerator, Target};
use asperity::topography::spectrum::SpectrumShape;
use asperity_framework::report::format::{input_number, input_quantity, number, percent, quantity};
use asperity_framework::report::page::Page;

/// How a surface was generated, and its deviation from the target.
pub fn section(page: &mut Page, surface: &Surface, map: &MapFacts, made: &GenerationFacts) {
    page.paragraph(&format!(
        "{} is a periodic random surface: {}.",
        surface.name,
        generator(&made.generator)
    ));
    if let Some(cut) = made.cut {
        page.paragraph(&format!(
            "The finer process has truncated {} of the points. The specified standard deviations, heights and spectra are \
             those of the two processes; Sq, Ssk and Sku of the resulting surface are in the table above.",
            percent(cut)
        ));
        return;
    }
    page.table(HEAD, rows(surface, map, made));
    if let Some((target, tried)) = made.target {
        let results = match target.sigma_of {
            SigmaOf::Summits => "The targets of Sq and of the spectrum result from this iteration.",
            SigmaOf::Surface => {
                "Sq of this map is prescribed, the standard deviation of its summit heights is not; the target of the spectrum \
                 results from this iteration."
            }
        };
        page.paragraph(&format!(
            "For this Hurst exponent, height distribution and cut-off in pixels, density × radius × σ depends on the \
             bandwidth of the spectrum only. The bandwidth was found by iteration over {tried} surfaces from the same \
             random numbers; heights were then scaled to σ and lengths to the density. {results}",
        ));
    }
    let is_sq_prescribed = made.target.is_some_and(|(target, _)| target.sigma_of == SigmaOf::Surface);
    page.paragraph(&format!(
        "Targets of {}Ssk, Sku and the spectrum are those of an infinite surface; a single map, about its own mean, \
         scatters about them.",
        if is_sq_prescribed { "" } else { "Sq, " }
    ));
    let process = &made.generator.process;
    if process.heights != Heights::GAUSSIAN {
        page.paragraph(match process.of {
            SpectrumOf::Heights => {
                "The transform from Gaussian to other heights changes the spectrum: the spectrum of the Gaussian field was \
                 chosen so that the transformed field has the target spectrum, as far as such a field exists."
            }
            SpectrumOf::Gaussian => {
                "The transform from Gaussian to other heights changes the spectrum: the target is that of the Gaussian \
                 field before the transform."
            }
        });
    }
}

/// Header of [`rows`].
pub const HEAD: [&str; 4] = ["quantity", "target", "obtained", "deviation"];

/// Rows below [`HEAD`]; none for a surface truncated by a finer process, which has no target.
pub fn rows(surface: &Surface, map: &MapFacts, made: &GenerationFacts) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    if made.cut.is_some() {
        return rows;
    }
    if let Some((target, _)) = &made.target {
        rows.push(ratio("mean radius of the summits", target.radius, surface.statistics.mean_radius, "m"));
        if target.sigma_of == SigmaOf::Summits {
            rows.push(ratio("σ of the summit heights", target.sigma, surface.statistics.sigma, "m"));
        }
        rows.push(ratio("density of the summits", target.density, surface.set.density(), "1/m²"));
    }
    let (process, moments) = (&made.generator.process, &map.roughness.moments);
    rows.push(match &made.target {
        Some((Target { sigma, sigma_of: SigmaOf::Surface, .. }, _)) => {
            ratio("σ of the surface heights, Sq", *sigma, moments.sq, "m")
        }
        _ => ratio("Sq", process.sigma, moments.sq, "m"),
    });
    rows.push(difference("Ssk", process.heights.skewness(), moments.ssk));
    rows.push(difference("Sku", process.heights.kurtosis(), moments.sku));
    if let (Some(target), Some(obtained)) = (&map.whole.target, &map.whole.spectrum) {
        let [low, high] = target.quartiles_of(obtained).map(number);
        let obtained = format!("{low} to {high} times");
        rows.push(vec![
            "spectrum, interquartile range of its rings".to_owned(),
            "1".to_owned(),
            obtained,
            String::new(),
        ]);
    }
    rows
}

fn ratio(what: &str, target: f64, obtained: f64, unit: &str) -> Vec<String> {
    /// Smaller deviations are rounding.
    const ROUNDING: f64 = 1e-12;
    let off = Some((obtained / target - 1.0).abs()).filter(|&off| off > ROUNDING).unwrap_or(0.0);
    vec![what.to_owned(), input_quantity(target, unit), quantity(obtained, unit), percent(off)]
}

fn difference(what: &str, target: f64, obtained: Option<f64>) -> Vec<String> {
    let apart = obtained.map_or_else(String::new, |obtained| number((obtained - target).abs()));
    vec![what.to_owned(), input_number(target), or_dash(obtained), apart]
}

/// Description of a generator.
fn generator(generator: &SurfaceGenerator) -> String {
    let process = |process: &Process| {
        let length = |length: f64| input_quantity(length, "m");
        let shape = match process.spectrum.shape() {
            SpectrumShape::SelfAffine { hurst, roll_off, cut_off } => format!(
                "self-affine spectrum with Hurst exponent {}, roll-off at a wavelength of {} and cut-off at {} ({} times \
                 shorter)",
                input_number(hurst),
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
            let angle = input_number(lay.angle.to_degrees());
            format!(
                " across a lay at {angle}° to the x axis, {} times {comparative} along it",
                input_number(times)
            )
        };
        format!("{shape}{lay}; heights {} with standard deviation {}", process.heights, length(process.sigma))
    };
    match &generator.plateau {
        None => process(&generator.process),
        Some(plateau) => format!(
            "{}; truncated by a finer process whose mean plane is {} {}: {}",
            process(&generator.process),
            input_quantity(plateau.height.abs(), "m"),
            if plateau.height < 0.0 { "lower" } else { "higher" },
            process(&plateau.process)
        ),
    }
}
