//! Where a deeper asperity has less area or load, told on the page of a comparison.

use super::format::{percent, quantity};
use super::layer::{listed, thickness, under};
use super::page::escape;
use crate::experiment::results::{CaseResults, LayerHead};
use crate::sphere::{Fall, Falling};

/// A line for the area and one for the load of one surface under one law, where they fall.
pub fn lines(subject: &str, cases: &[&CaseResults], layer: Option<&LayerHead>) -> Vec<String> {
    Falling::ALL.into_iter().filter_map(|of| line(subject, cases, layer, of)).collect()
}

fn line(subject: &str, cases: &[&CaseResults], layer: Option<&LayerHead>, of: Falling) -> Option<String> {
    let falls_of =
        |case: &CaseResults| case.falls.iter().filter(|(_, fall)| fall.of == of).copied().collect::<Vec<_>>();
    let falling: Vec<(&CaseResults, (f64, Fall))> =
        cases.iter().flat_map(|case| falls_of(case).into_iter().map(move |found| (*case, found))).collect();
    let (case, (radius, fall)) = falling.iter().max_by(|a, b| a.1.1.loss().total_cmp(&b.1.1.loss()))?;
    let mut names: Vec<String> =
        falling.iter().filter_map(|(case, _)| case.thickness).map(thickness).collect();
    names.dedup();
    let (with, place) = match (layer, case.thickness) {
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
    Some(format!(
        "**{}**: the {} of an asperity can fall as it is pressed deeper{with}. That of one of radius {}{place} falls by {} between w = {} and \
         {} (looked at: the sharpest, the mean and the bluntest, as deep as the highest is pressed here).{consequence}",
        escape(subject),
        of.name(),
        quantity(*radius, "m"),
        percent(fall.loss()),
        quantity(fall.from.indentation, "m"),
        quantity(fall.to.indentation, "m"),
    ))
}
