//! Where a deeper asperity has less area or load, told on the page of a comparison.

use crate::kind::compare::layer_page::under;
use crate::kind::compare::results::{FallResults, SurfaceResults};
use asperity::sphere::Falling;
use asperity_framework::contact::LayerMetadata;
use asperity_framework::report::format::{listed, thickness};
use asperity_framework::report::format::{percent, quantity};
use asperity_framework::report::page::escape;

/// A stretch this narrow, of its beginning, is a jump of the law.
const NARROW: f64 = 1e-9;

/// A line for the area and one for the load of one surface under one law, where they fall.
pub fn lines(subject: &str, found: &SurfaceResults, law: &str, layer: Option<&LayerMetadata>) -> Vec<String> {
    Falling::ALL.into_iter().filter_map(|of| line(subject, found, law, layer, of)).collect()
}

fn line(
    subject: &str,
    found: &SurfaceResults,
    law: &str,
    layer: Option<&LayerMetadata>,
    of: Falling,
) -> Option<String> {
    let falling = || found.falls.iter().filter(|found| found.law == law && found.fall.of == of);
    let FallResults { radius, fall, thickness: under_it, .. } =
        falling().max_by(|a, b| a.fall.loss().total_cmp(&b.fall.loss()))?;
    let mut names: Vec<String> = falling().filter_map(|found| found.thickness).map(thickness).collect();
    names.dedup();
    let (with, place) = match (layer, *under_it) {
        (Some(layer), Some(t)) => {
            (format!(", with {} of {}", escape(&layer.name), listed(&names)), format!(" {}", under(layer, t)))
        }
        _ => (String::new(), String::new()),
    };
    let consequence = match of {
        Falling::Area => "",
        Falling::Load => {
            " A pressure may then be reached more than once on approach; the answers are the first."
        }
    };
    let [from, to] = [fall.from.indentation, fall.to.indentation];
    let stretch = if to <= from * (1.0 + NARROW) {
        format!("at once at w = {}", quantity(from, "m"))
    } else {
        format!("between w = {} and {}", quantity(from, "m"), quantity(to, "m"))
    };
    Some(format!(
        "**{}**: the {} of an asperity can fall as it is pressed deeper{with}. That of one of radius {}{place} falls by {} {stretch} \
         (looked at: the sharpest, the mean and the bluntest, as deep as the highest is pressed here).{consequence}",
        escape(subject),
        of.name(),
        quantity(*radius, "m"),
        percent(fall.loss()),
    ))
}
