//! What the models say at the load.

use asperity::compare::ModelKind;
use asperity::study::ModelResult;
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{input_quantity, number, percent, quantity, signed};

use super::{Card, area};

impl Card<'_> {
    /// "5 N on 4 mm² (1.25 MPa): 3200 µm² in 180 contacts at 1.55 GPa, 97 % elastic-plastic (sum); integral +13 %, boundary elements -5 %."
    /// `None` where nothing was run.
    pub(super) fn result(&self) -> Option<String> {
        let at_load = self.case.results_at_load();
        let find = |kind| at_load.models.iter().find(|one| one.model == kind);
        let order = [Some(ModelKind::Deterministic), Some(ModelKind::Statistical), None];
        let model = order.into_iter().find_map(find)?;
        let nominal = self.load_area;
        let pressure = model.point.pressure;
        let load = format!(
            "{} on {} ({})",
            quantity(pressure * nominal, "N"),
            area(nominal),
            input_quantity(pressure, "Pa")
        );
        let real = area(model.point.area_ratio * nominal);
        let others: Vec<String> = at_load
            .models
            .iter()
            .filter(|other| other.model != model.model)
            .filter_map(|other| relative_to(other, model, |one| Some(one.point.area_ratio)))
            .collect();
        let others = if others.is_empty() { String::new() } else { format!("; {}", others.join(", ")) };
        let others = self.elastic(others);
        let [contacts, mean, regime] = details(model, nominal);
        let text = |contacts: &str, mean: &str, regime: &str| {
            format!("{load}: {real}{contacts}{mean}{regime} ({}){others}.", model_name(model.model))
        };
        Some(fitting([
            text(&contacts, &mean, &regime),
            text(&contacts, &mean, ""),
            text(&contacts, "", ""),
            text("", "", ""),
        ]))
    }
}

pub(super) fn model_name(model: Option<ModelKind>) -> &'static str {
    match model {
        Some(ModelKind::Deterministic) => "sum",
        Some(ModelKind::Statistical) => "integral",
        None => "boundary elements",
    }
}

/// "integral +13 %": a quantity `of` a model against that of another; `None` without contact.
pub(super) fn relative_to(
    other: &ModelResult,
    model: &ModelResult,
    of: impl Fn(&ModelResult) -> Option<f64>,
) -> Option<String> {
    let ratio = of(other)? / of(model)?;
    // Less is beyond the digits of every result.
    const LEAST: f64 = 0.05;
    let percent = 100.0 * (ratio - 1.0);
    let difference = if percent.abs() < LEAST { "< 0.1".to_owned() } else { signed(percent) };
    (ratio > 0.0 && ratio.is_finite()).then(|| format!("{} {difference} %", model_name(other.model)))
}

/// The number of contacts, their mean pressure, and the regime with the largest share of the load.
fn details(model: &ModelResult, nominal: f64) -> [String; 3] {
    let point = &model.point;
    let contacts = point.contact_density.map_or_else(String::new, |density| {
        let count = density * nominal;
        let count = if count < 99.5 { number(count) } else { number(count.round()) };
        format!(" in {count} {}", if count == "1" { "contact" } else { "contacts" })
    });
    let mean =
        point.mean_real_pressure().map_or_else(String::new, |mean| format!(" at {}", quantity(mean, "Pa")));
    let regime = point.shares.map_or_else(String::new, |shares| {
        let names = ["elastic", "elastic-plastic", "plastic"];
        let largest = (0..3).max_by(|&a, &b| shares[a].total_cmp(&shares[b])).unwrap_or(0);
        format!(", {} {}", percent(shares[largest]), names[largest])
    });
    [contacts, mean, regime]
}
