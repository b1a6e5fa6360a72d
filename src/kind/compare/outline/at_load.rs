//! What the models say at the load, in a sentence.

use asperity::compare::ModelKind;
use asperity::study::{CaseStudy, ModelResult};
use asperity::surface::Surface;
use asperity_contact_framework::report::format::{input_quantity, number, percent, quantity, signed};

use super::limit::{is_unreached, limit_words};

/// "At 5 N on 4 mm² (1.25 MPa): real contact area 3200 µm² (0.08 %) in 180 contacts at 1.55 GPa, 97 % of the load elastic-plastic, by the sum; 3600 µm²
/// by the integral, 3000 µm² (-5 % against the sum) by boundary elements."; on a `nominal` area (m²). `None` where neither sum nor integral was run.
pub fn results(case: &CaseStudy, surface: &Surface, nominal: f64) -> Option<String> {
    let at_load = case.results_at_load();
    let of = |kind: ModelKind| at_load.models.iter().find(|one| one.model == Some(kind));
    let (model, name) = of(ModelKind::Deterministic)
        .map(|one| (one, "sum"))
        .or_else(|| of(ModelKind::Statistical).map(|one| (one, "integral")))?;
    let mut marks: Vec<String> = at_load.exceeded.limits().map(limit_words).collect();
    let overlaps = at_load.models.iter().any(|one| one.model.is_some() && one.point.area_ratio > 1.0);
    marks.extend(
        overlaps.then(|| "asperities overlap completely: no model of separate asperities holds".to_owned()),
    );
    marks.extend(surface.is_blocked().then(|| "map not fit".to_owned()));
    let marks = if marks.is_empty() { String::new() } else { format!(" [{}]", marks.join("; ")) };
    let pressure = model.point.pressure;
    let [force, nominal_area, pressure] =
        [quantity(pressure * nominal, "N"), area(nominal), input_quantity(pressure, "Pa")];
    let own = surface.set.nominal_area();
    // As the reader sees them: a side times a pixel is not the stated area to the last digit.
    let sample = if area(own) == area(nominal) {
        String::new()
    } else {
        let count = model
            .point
            .contact_density
            .map_or_else(String::new, |density| format!("{} on ", contacts(density * own)));
        format!("; from {count}a surface of {}", area(own))
    };
    let mut others = others(&at_load.models, model, name, nominal);
    if case.reported_load().is_some_and(|at| is_unreached(case, at.load)) {
        others.push_str("; no boundary elements, because no contact carries so high a pressure");
    }
    Some(format!(
        "At {force} on {nominal_area} ({pressure}{sample}){marks}: {} by the {name}{others}.",
        contact(model, nominal, case.realisations.len() > 1)
    ))
}

/// "real contact area 3200 µm² (0.08 %) in 180 contacts at 1.55 GPa, 97 % of the load elastic-plastic"; of one surface, or the mean of several.
fn contact(result: &ModelResult, nominal: f64, is_mean: bool) -> String {
    let point = &result.point;
    let ratio = point.area_ratio;
    let interval = result.area_interval.map_or_else(String::new, |ends| {
        let [low, high] = ends.map(|end| area((end * nominal).max(0.0)));
        let of = if is_mean { " of the mean" } else { "" };
        format!(", 95 % interval{of} {low} to {high}")
    });
    let mut text = format!("real contact area {} ({}{interval})", area(ratio * nominal), percent(ratio));
    if let Some(density) = point.contact_density {
        text.push_str(&format!(" in {}", contacts(density * nominal)));
    }
    if let Some(pressure) = point.mean_real_pressure() {
        text.push_str(&format!(" at {}", quantity(pressure, "Pa")));
    }
    let Some([elastic, elastic_plastic, plastic]) = point.shares else { return text };
    let yielded = [(elastic_plastic, "elastic-plastic"), (plastic, "plastic")];
    let parts: Vec<String> = yielded
        .iter()
        .filter(|(share, _)| *share > 0.0005)
        .enumerate()
        .map(|(k, (share, name))| {
            format!("{}{} {name}", percent(*share), if k == 0 { " of the load" } else { "" })
        })
        .collect();
    let parts = if parts.is_empty() && elastic > 0.0 { vec!["all elastic".to_owned()] } else { parts };
    format!("{text}, {}", parts.join(", "))
}

/// "180 contacts", of a mean over realisations or of another area perhaps no whole number.
fn contacts(count: f64) -> String {
    let text = if count < 99.5 { number(count) } else { number(count.round()) };
    if text == "1" { "1 contact".to_owned() } else { format!("{text} contacts") }
}

/// "; 3600 µm² by the integral, 3000 µm² (-5 % against the sum) by boundary elements": on a `nominal` area; the difference of the reference is to the area
/// of `model`.
fn others(models: &[ModelResult], model: &ModelResult, name: &str, nominal: f64) -> String {
    let other = |one: &&ModelResult| one.model != model.model && one.point.area_ratio > 0.0;
    let text = |one: &ModelResult| {
        let real = area(one.point.area_ratio * nominal);
        match one.model {
            Some(ModelKind::Statistical) => format!("{real} by the integral"),
            Some(ModelKind::Deterministic) => format!("{real} by the sum"),
            None => {
                let difference = one.point.area_ratio / model.point.area_ratio - 1.0;
                format!("{real} ({} % against the {name}) by boundary elements", signed(100.0 * difference))
            }
        }
    };
    let all: Vec<String> =
        models.iter().filter(other).filter(|_| model.point.area_ratio > 0.0).map(text).collect();
    if all.is_empty() { String::new() } else { format!("; {}", all.join(", ")) }
}

/// An area (m²): in mm² from 0.01 mm² to 1 m², in µm² from 0.01 µm².
pub fn area(area: f64) -> String {
    if (1e-8..1.0).contains(&area) {
        format!("{} mm²", number(1e6 * area))
    } else if (1e-14..1e-8).contains(&area) {
        format!("{} µm²", number(1e12 * area))
    } else {
        quantity(area, "m²")
    }
}
