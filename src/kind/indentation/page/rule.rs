//! Accuracy of the effective-modulus models.

use super::{figures, subject};
use crate::kind::indentation::run::{IndentationResults, LayerResults};
use asperity::ModulusModel;
use asperity::compare::{GOOD_RATIO, ModulusError};
use asperity_framework::report::format::{number, ratio};
use asperity_framework::report::page::Page;

/// Modulus ratio, and the largest error of each effective-modulus model.
pub fn sentence(found: &LayerResults) -> String {
    let [from, to] = GOOD_RATIO;
    let place = if found.check.is_good() { "within" } else { "outside" };
    let worst = |(rule, worst): (ModulusModel, &Option<ModulusError>)| {
        let worst = worst.as_ref()?;
        Some(format!(
            "the load by `{}` is {} {} times the exact one (at a/t = {}{})",
            rule.name(),
            if worst.ratio < 1.0 { "as little as" } else { "up to" },
            number(worst.ratio),
            number(worst.contact_ratio),
            if rule == found.rule { ", the model of this layer" } else { "" },
        ))
    };
    let worst: Vec<String> =
        ModulusModel::ALL.into_iter().zip(&found.check.worst).filter_map(worst).collect();
    let errors = match worst.len() {
        0 => "no contact is small enough for the exact solution".to_owned(),
        _ => format!("without yielding and at equal indentation, {}", worst.join("; ")),
    };
    format!(
        "E_l/E_s = {} is {place} the range {from} to {to} in which the effective-modulus model `gao` is accurate (Perriot \
         and Barthel 2004); {errors}.",
        number(found.check.modulus_ratio)
    )
}

/// The section on one layer.
pub fn section(page: &mut Page, found: &LayerResults, figure: &str) {
    page.heading(3, "Accuracy of the effective-modulus model");
    page.paragraph(&sentence(found));
    if found.errors[0].is_empty() {
        return;
    }
    page.figure(
        figure,
        figures::rule(found),
        "Accuracy of the effective-modulus models: elastic load over the exact elastic load at equal indentation, against \
         the exact contact radius over the layer thickness.",
    );
    page.paragraph(
        "Both models take the area of an elastic contact as π R w, as without a layer; the last column compares it with \
         the exact area.",
    );
    let [gao, series] = &found.check.reported;
    page.table(
        ["a/t", "w R/t²", "load: gao / exact", "load: series / exact", "area: π R w / exact"],
        gao.iter().zip(series).map(|(gao, series)| {
            vec![
                number(gao.contact_ratio),
                number(gao.indentation_ratio),
                ratio(gao.ratio),
                ratio(series.ratio),
                ratio(gao.indentation_ratio / gao.contact_ratio.powi(2)),
            ]
        }),
    );
}

/// Comparison of all layers.
pub fn all(page: &mut Page, results: &IndentationResults) {
    page.heading(2, "Accuracy of the effective-modulus models");
    page.figure(
        "rules.svg",
        figures::rules(results),
        "Accuracy of the effective-modulus models: elastic load over the exact elastic load at equal indentation, against \
         the exact contact radius over the layer thickness. One panel per model, one line per layer.",
    );
    let cells = |worst: &Option<ModulusError>| match worst {
        Some(worst) => [ratio(worst.ratio), number(worst.contact_ratio)],
        None => [String::new(), String::new()],
    };
    let rows = results.layers.iter().map(|found| {
        let [gao, series] = &found.check.worst;
        let mut row = vec![subject(results, found), number(found.check.modulus_ratio)];
        row.extend(cells(gao));
        row.extend(cells(series));
        row
    });
    page.table(["layer", "E_l/E_s", "gao / exact, worst", "at a/t", "series / exact, worst", "at a/t"], rows);
}
