//! The page of a sphere on layers: load, changes of regime, accuracy of the effective-modulus models.

mod figures;
mod rule;

use super::run::{IndentationResults, LawCurves, LayerResults, OverlayFit};
use crate::kind::indentation::shown::Shown;
use asperity::layer::exact_sphere::LARGEST_RATIO;
use asperity::sphere::{Curve, Decrease, DecreasingQuantity, LARGEST_SLOPE, RegimeChange};
use asperity_framework::report::format::{count, input_quantity, number, quantity, ratio};
use asperity_framework::report::page::{Page, escape};
use asperity_framework::report::sections;

/// Name of a layer in a sentence, with thickness and rule where layers differ in them.
fn subject(results: &IndentationResults, found: &LayerResults) -> String {
    let same = |other: &&LayerResults| other.name == found.name;
    let others: Vec<&LayerResults> = results.layers.iter().filter(same).collect();
    let mut subject = found.name.clone();
    if others.iter().any(|other| other.thickness != found.thickness) {
        subject.push_str(&format!(" {}", input_quantity(found.thickness, "m")));
    }
    if others.iter().any(|other| other.rule != found.rule) {
        subject.push_str(&format!(" by {}", found.rule.name()));
    }
    subject
}

pub fn page(results: &IndentationResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    let of_layer = |found: &LayerResults| {
        let mut lines: Vec<String> =
            found.laws.iter().map(|law| summary_lines(results, found, law)).collect();
        lines.push(format!("**{}**: {}", escape(&subject(results, found)), rule::sentence(found)));
        lines
    };
    sections::findings(&mut page, results.layers.iter().flat_map(of_layer));
    sections::warnings(&mut page, &results.warnings());
    if results.layers.len() > 1 {
        rule::all(&mut page, results);
    }
    for (k, found) in results.layers.iter().enumerate() {
        page.heading(2, &format!("{}, {}", found.name, input_quantity(found.thickness, "m")));
        let name = |law: &str, what: &str| {
            let label = format!("{}-{}{law}-{what}", k + 1, found.name);
            let plain = |c: char| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
            label.chars().map(plain).collect::<String>() + ".svg"
        };
        for law in &found.laws {
            curves(&mut page, results, found, law, &name);
        }
        rule::section(&mut page, found, &name("", "rule"));
    }
    sections::notes(&mut page, &results.metadata);
    what_was_run(&mut page, results);
    limits(&mut page, results);
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

/// Regimes up to the largest indentation, and the loads there.
fn summary_lines(results: &IndentationResults, found: &LayerResults, law: &LawCurves) -> String {
    let last = |curve: &Curve| curve.points.last().map_or(f64::NAN, |point| point.contact.load);
    let regimes: Vec<&str> = law.coated.sequence().into_iter().map(|regime| regime.name()).collect();
    let change = |change: &RegimeChange| {
        let beyond = if law.coated.is_within(change) { "" } else { " (beyond the indentation range)" };
        format!("{}{beyond}", quantity(change.indentation, "m"))
    };
    let changes: Vec<String> = law.coated.changes.iter().map(change).collect();
    let changes = match changes.len() {
        0 => format!("the contact is {} throughout", regimes.join(", ")),
        _ => format!("the regimes are {}, with changes at {}", regimes.join(", "), changes.join(", ")),
    };
    let end = results.indentations.last().copied().unwrap_or(f64::NAN);
    format!(
        "**{}, law {}**: {changes}. At w = {} the load is {} (uncoated {}, bulk layer material {}).{}",
        escape(&subject(results, found)),
        escape(&law.law),
        input_quantity(end, "m"),
        quantity(last(&law.coated), "N"),
        quantity(last(&law.uncoated), "N"),
        quantity(last(&law.all_layer), "N"),
        law.coated.decreases.iter().map(decrease).collect::<String>(),
    )
}

fn decrease(decrease: &Decrease) -> String {
    let unit = match decrease.of {
        DecreasingQuantity::Area => "m²",
        DecreasingQuantity::Load => "N",
    };
    let value = |contact| quantity(decrease.of.of(contact), unit);
    format!(
        " The {} decreases with increasing indentation from w = {} to {}: from {} to {}.",
        decrease.of.name(),
        quantity(decrease.from.indentation, "m"),
        quantity(decrease.to.indentation, "m"),
        value(&decrease.from.contact),
        value(&decrease.to.contact),
    )
}

fn what_was_run(page: &mut Page, results: &IndentationResults) {
    page.heading(2, "Set-up");
    let role = |name: &str| {
        let is_layer = results.layers.iter().any(|found| found.name == name);
        let roles = [("ball", name == results.ball), ("flat", name == results.flat), ("layer", is_layer)];
        let roles: Vec<&str> = roles.into_iter().filter(|role| role.1).map(|role| role.0).collect();
        if roles.is_empty() { "not used".to_owned() } else { roles.join(", ") }
    };
    sections::materials(page, &results.metadata, &results.materials, role);
    let thickness = |found: &LayerResults| {
        format!(
            "{}, {} (effective-modulus model {})",
            escape(&found.name),
            input_quantity(found.thickness, "m"),
            found.rule.name()
        )
    };
    let layers: Vec<String> = results.layers.iter().map(thickness).collect();
    let [from, to] =
        [results.indentations.first(), results.indentations.last()].map(|w| w.copied().unwrap_or(f64::NAN));
    page.paragraph(&format!(
        "Ball of radius {} on a flat of {}; layers: {}; {} indentations from {} to {}. {}",
        input_quantity(results.radius, "m"),
        escape(&results.flat),
        layers.join("; "),
        count(results.indentations.len()),
        input_quantity(from, "m"),
        input_quantity(to, "m"),
        sections::provenance(&results.metadata),
    ));
}

fn curves(
    page: &mut Page,
    results: &IndentationResults,
    found: &LayerResults,
    law: &LawCurves,
    name: &impl Fn(&str, &str) -> String,
) {
    page.heading(3, &format!("Law {}", law.law));
    let label = format!("-{}", law.law);
    page.figure(
        &name(&label, "load"),
        figures::load(results, found, law),
        "Load and indentation: coated (coloured by regime), uncoated, bulk layer material, and the exact elastic solution \
         for ball, layer and substrate. Left: logarithmic axes; right: linear axes.",
    );
    page.figure(
        &name(&label, "ratios"),
        figures::ratios(results, found, law),
        "The same curves normalised by Hertz without a layer: load over (4/3) E* R^½ w^(3/2) with E* of the uncoated pair, \
         and real contact area over π R w.",
    );
    let rows = Shown::of(law).into_iter().flat_map(|(shown, curve)| {
        curve.changes.iter().map(move |change| {
            vec![
                shown.name().to_owned(),
                quantity(change.indentation, "m"),
                quantity(change.load, "N"),
                change.from.name().to_owned(),
                change.to.name().to_owned(),
                if curve.is_within(change) { "within" } else { "beyond" }.to_owned(),
            ]
        })
    });
    let rows: Vec<Vec<String>> = rows.collect();
    if !rows.is_empty() {
        page.paragraph("All changes of regime, including those outside the indentation range:");
        page.table(["curve", "indentation", "load", "from", "to", "indentation range"], rows);
    }
    if let Some((file, points)) = &results.overlay {
        overlay(page, file, points, law);
    }
}

fn overlay(page: &mut Page, file: &str, points: &[(f64, f64)], law: &LawCurves) {
    let Some(OverlayFit { mean_ratio, largest_factor }) = law.fit else { return };
    let pairs = points.iter().zip(&law.at_overlay).map(|(&(w, measured), &coated)| (w, measured, coated));
    page.paragraph(&format!(
        "Measured points of {} against the coated curve at the same indentation: the measured load is {} times the coated \
         one in the geometric mean; the largest deviation is a factor of {}.",
        escape(file),
        number(mean_ratio),
        number(largest_factor),
    ));
    page.table(
        ["indentation", "measured load", "coated load", "measured / coated"],
        pairs.map(|(w, measured, coated)| {
            vec![
                input_quantity(w, "m"),
                quantity(measured, "N"),
                quantity(coated, "N"),
                ratio(measured / coated),
            ]
        }),
    );
}

fn limits(page: &mut Page, results: &IndentationResults) {
    page.heading(2, "Limits of validity");
    let mut lines = vec![
        "`coated` uses an effective-modulus model and a hardness model of the layered solid. The accuracy of the former \
         without yielding is shown above; the latter is not checked against an exact solution here."
            .to_owned(),
        "`exact-elastic` is purely elastic: beyond the first change of regime it is the load of bodies that remain elastic \
         throughout. Friction and adhesion are neglected; the layer is perfectly bonded to its substrate."
            .to_owned(),
        format!(
            "The ball is modelled as a paraboloid under small strains, which is valid while the contact radius is well \
             below the radius of the ball; here it reaches {} of it (a warning is given above {LARGEST_SLOPE}).",
            number(results.largest_slope())
        ),
    ];
    for found in &results.layers {
        let left_out = found.unsolved();
        if left_out > 0 {
            lines.push(format!(
                "{}: {left_out} of {} exact points are omitted because the contact radius exceeds {LARGEST_RATIO} layer \
                 thicknesses.",
                escape(&subject(results, found)),
                found.exact.len()
            ));
        }
    }
    page.bullets(lines);
}
