//! Area or load that decreases with increasing indentation.

use asperity::sphere::DecreasingQuantity;
use asperity_framework::contact::LayerMetadata;
use asperity_framework::report::format::{input_quantity, listed, percent, quantity, thickness};
use asperity_framework::report::page::escape;

use super::names::{subject, under};
use crate::kind::compare::answers::DecreaseResults;
use crate::kind::compare::findings::Decreasing;
use crate::kind::compare::results::CompareResults;

/// A line for the area and one for the load of each surface under each law, where they decrease.
pub fn lines(results: &CompareResults) -> Vec<String> {
    let layer = results.contact.layer.as_ref();
    let mut lines = Vec::new();
    for found in &results.surfaces {
        for law in &found.findings.laws {
            let subject = subject(results, found, &law.law);
            lines.extend(law.decreasing.iter().map(|found| line(&subject, found, layer)));
        }
    }
    lines
}

fn line(subject: &str, found: &Decreasing, layer: Option<&LayerMetadata>) -> String {
    let DecreaseResults { radius, decrease, thickness: under_it, .. } = &found.worst;
    let names: Vec<String> = found.thicknesses.iter().copied().map(thickness).collect();
    let (with, place) = match (layer, *under_it) {
        (Some(layer), Some(t)) => {
            let is_finite = found.thicknesses.iter().all(|t| *t > 0.0 && t.is_finite());
            let places = if is_finite {
                format!("with {} of {}", escape(&layer.name), listed(&names))
            } else {
                listed(&found.thicknesses.iter().map(|&t| under(layer, t)).collect::<Vec<_>>())
            };
            (format!(", {places}"), format!(" {}", under(layer, t)))
        }
        _ => (String::new(), String::new()),
    };
    let consequence = match found.of {
        DecreasingQuantity::Area => "",
        DecreasingQuantity::Load => {
            " The same pressure is then reached at several separations; the first on approach is reported."
        }
    };
    let [from, to] = [decrease.from.indentation, decrease.to.indentation];
    let stretch = if decrease.is_jump() {
        format!("abruptly at w = {}", quantity(from, "m"))
    } else {
        format!("between w = {} and {}", quantity(from, "m"), quantity(to, "m"))
    };
    format!(
        "**{}**: the {} per asperity can decrease with increasing indentation{with}: at radius {}{place} by {} {stretch} \
         (checked for the smallest, the mean and the largest radius, up to the largest indentation of this \
         experiment).{consequence}",
        escape(subject),
        found.of.name(),
        input_quantity(*radius, "m"),
        percent(decrease.loss()),
    )
}
