//! What the contact conducts, and how it resists sliding.

use asperity::compare::{ComparedQuantity, ModelKind};
use asperity::numeric::two_digits;
use asperity::study::ModelResult;
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{input_quantity, number, quantity, range, signed};

use super::row::{model_name, relative_to};
use super::{Card, area};
use crate::kind::compare::correlations::{Correlated, Formula};
use crate::model_tables::REFERENCE;
use crate::presentation::quantity_name;

impl Card<'_> {
    /// "Thermal: 52 kW/(m² K), 19.2 mm² K/W, 4.8 K/W on 4 mm² (sum; 95 % interval 48 to 56); integral +3 %, boundary elements +12 %." for each
    /// conductance that is asked for, then how far correlations in use are off.
    pub(super) fn conductances(&self) -> Vec<String> {
        let of = [
            (ComparedQuantity::ElectricalConductance, "Electrical"),
            (ComparedQuantity::ThermalConductance, "Thermal"),
        ];
        let conductances = of.into_iter().filter_map(|(quantity, name)| self.conductance(quantity, name));
        conductances
            .chain(of.into_iter().filter_map(|(quantity, name)| self.cluster(quantity, name)))
            .chain(self.correlations())
            .collect()
    }

    /// "Electrical, 0.262 mm² between larger bodies: 177 µΩ (boundary elements), Greenwood's cluster 182 µΩ, the sum's spots without each other 109 µΩ."
    /// Of one finite map.
    fn cluster(&self, compared: ComparedQuantity, name: &str) -> Option<String> {
        if self.case.realisations.len() > 1 {
            return None;
        }
        let at_load = self.case.results_at_load();
        let curve = self.case.first().reference.as_ref()?;
        let load = at_load.models.iter().find(|one| one.model.is_none())?.point.pressure;
        let at = curve.points.iter().position(|point| point.pressure == load)?;
        let index = compared.spot()? as usize;
        let whole = Some(curve.points[at].of_cluster[index]).filter(|whole| *whole > 0.0)?;
        let is_thermal = compared == ComparedQuantity::ThermalConductance;
        let unit = if is_thermal { "K/W" } else { "Ω" };
        let resistance = |conductance: f64, area: f64| quantity((conductance * area).recip(), unit);
        // That of the sum is without the border of a map that does not repeat.
        let map = self.surface.map.as_ref()?;
        let of_map: f64 =
            map.points.iter().zip(map.pixel).map(|(points, pixel)| *points as f64 * pixel).product();
        let of_sum = self.surface.set.nominal_area();
        let greenwood = curve.clusters.get(at).map(|both| both[index]).filter(|cluster| *cluster > 0.0);
        let greenwood = greenwood.map_or_else(String::new, |cluster| {
            format!(", Greenwood's cluster {}", resistance(cluster, of_sum))
        });
        let sum = at_load.models.iter().find(|one| one.model == Some(ModelKind::Deterministic));
        // The sum's heat flows through the medium in the gap, too.
        let alone =
            sum.and_then(|sum| sum.point.value(compared)).filter(|_| !(is_thermal && self.has_medium));
        let alone = alone.map_or_else(String::new, |alone| {
            format!(", the sum's spots without each other {}", resistance(alone, of_sum))
        });
        let text = |rest: &str| {
            let whole = resistance(whole, of_map);
            format!("{name}, {} between larger bodies: {whole} (boundary elements){rest}.", area(of_map))
        };
        Some(fitting([text(&[greenwood.clone(), alone].concat()), text(&greenwood), text("")]))
    }

    /// "Correlations on this map, against boundary elements: Cooper-Mikic-Yovanovich (plastic) +5 to +19 %, within ±20 % from 1 to 12.8 MPa; Mikic
    /// (elastic) -71 to -68 %." Once where both conductances have the same. "Finite map, against boundary elements: Greenwood's cluster of spots +5
    /// to +9 %." Why there are none.
    fn correlations(&self) -> Vec<String> {
        let correlations = match &self.correlations {
            Ok(correlations) => correlations,
            Err(reason) => return vec![format!("Correlations: {reason}.")],
        };
        let groups = correlations.chunk_by(|a, b| (a.quantity, a.against) == (b.quantity, b.against));
        let text = |group: &[Correlated]| {
            let against = if group[0].against == REFERENCE { "boundary elements" } else { "the sum" };
            let each: Vec<String> = group.iter().map(correlation).collect();
            format!("against {against}: {}.", each.join("; "))
        };
        let mut texts: Vec<(&Correlated, String)> = groups.map(|group| (&group[0], text(group))).collect();
        texts.sort_by_key(|(found, _)| found.formula == Formula::Cluster);
        let line = |(found, text): &(&Correlated, String)| {
            let mut same = texts.iter().filter(|(other, _)| other.formula == found.formula);
            let of = if same.all(|(_, other)| other == text) {
                String::new()
            } else {
                format!(" of the {}", quantity_name(found.quantity))
            };
            match found.formula {
                Formula::Cluster => format!("Finite map{of}, {text}"),
                Formula::Interface(_) => format!("Correlations{of} on this map, {text}"),
            }
        };
        let mut lines: Vec<String> = texts.iter().map(line).collect();
        lines.dedup();
        lines
    }

    fn conductance(&self, compared: ComparedQuantity, name: &str) -> Option<String> {
        let at_load = self.case.results_at_load();
        let model = main_model(&at_load.models, compared)?;
        let value = model.point.value(compared)?;
        let (unit, scale) = match compared {
            ComparedQuantity::ElectricalConductance => ("S/mm²", 1e-6),
            _ => ("kW/(m² K)", 1e-3),
        };
        let shown = |value: f64| number(scale * value);
        let resistance = value.recip();
        let (of_area, whole) = match compared {
            ComparedQuantity::ElectricalConductance => (
                format!("{} cm²", quantity(1e4 * resistance, "Ω")),
                quantity(resistance / self.load_area, "Ω"),
            ),
            _ => (
                format!("{} mm² K/W", number(1e6 * resistance)),
                quantity(resistance / self.load_area, "K/W"),
            ),
        };
        // The area of a map is seldom that of the joint.
        let on = if self.load_area == self.surface.set.nominal_area() {
            String::new()
        } else {
            format!(", {whole} on {}", area(self.load_area))
        };
        let interval = interval(model, compared, &shown);
        let others = self.elastic(others(&at_load.models, model, compared));
        let text = |on: &str| {
            let model = model_name(model.model);
            format!("{name}: {} {unit}, {of_area}{on} ({model}{interval}){others}.", shown(value))
        };
        Some(fitting([text(&on), text("")]))
    }

    /// "Coefficient 0.12 (sum; 95 % interval 0.11 to 0.13); integral +3 %, boundary elements -5 %."
    pub(super) fn friction(&self) -> Option<String> {
        let compared = ComparedQuantity::Friction;
        let at_load = self.case.results_at_load();
        let model = main_model(&at_load.models, compared)?;
        let value = model.point.value(compared)?;
        let interval = interval(model, compared, &number);
        let others = self.elastic(others(&at_load.models, model, compared));
        Some(format!("Coefficient {} ({}{interval}){others}.", number(value), model_name(model.model)))
    }
}

/// "Mikic (elastic) -71 to -68 %", and where it is within what is accepted.
fn correlation(found: &Correlated) -> String {
    let [low, high] = found.range().map(|at| signed(two_digits(100.0 * at)));
    let size = if low == high { low } else { format!("{low} to {high}") };
    let accepted = number(100.0 * found.accepted);
    let within = match found.within() {
        None => String::new(),
        Some([from, to]) if from == to => format!(", within ±{accepted} % at {}", input_quantity(from, "Pa")),
        Some(loads) => format!(", within ±{accepted} % from {}", range(loads, "Pa")),
    };
    format!("{} {size} %{within}", found.formula.label())
}

/// The sum, or else the integral or the reference.
fn main_model(models: &[ModelResult], compared: ComparedQuantity) -> Option<&ModelResult> {
    let order = [Some(ModelKind::Deterministic), Some(ModelKind::Statistical), None];
    let find = |kind| models.iter().find(|one| one.model == kind && one.point.value(compared).is_some());
    order.into_iter().find_map(find)
}

/// "; 95 % interval 48 to 56"; empty without one.
fn interval(model: &ModelResult, compared: ComparedQuantity, shown: &dyn Fn(f64) -> String) -> String {
    let ends = model.intervals[compared as usize];
    ends.map_or_else(String::new, |[low, high]| format!("; 95 % interval {} to {}", shown(low), shown(high)))
}

/// "; integral +3 %, boundary elements +12 %".
fn others(models: &[ModelResult], model: &ModelResult, compared: ComparedQuantity) -> String {
    let of = |one: &ModelResult| one.point.value(compared);
    let others = models.iter().filter(|other| other.model != model.model);
    let texts: Vec<String> = others.filter_map(|other| relative_to(other, model, of)).collect();
    if texts.is_empty() { String::new() } else { format!("; {}", texts.join(", ")) }
}
