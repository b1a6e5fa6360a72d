//! The results of a case at one load: what the models, and the reference, say there.

use super::results::{CaseResults, CaseStudy};
use crate::Response;
use crate::compare::{
    ByQuantity, ComparedQuantity, ContactResult, CurvePoint, Difference, ModelKind, ReferencePoint, Scatter,
    error_over_positions, student_quantile,
};
use crate::model::Exceeded;
use crate::spot::SpotValues;

/// The models, and the reference, at the load of a case, or at the middle one of its loads.
#[derive(Debug, Clone)]
pub struct LoadResults {
    /// Limits of admissible loads that are exceeded there.
    pub exceeded: Exceeded,
    /// Statistical and deterministic model and reference, as far as they were run.
    pub models: Vec<ModelResult>,
}

/// A model or the reference at one load; over several realisations the mean.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelResult {
    /// The model; `None` for the reference.
    pub model: Option<ModelKind>,
    /// Its results.
    pub point: PointResult,
    /// The 95 % intervals of its [values](PointResult::value), where there are such.
    pub intervals: ByQuantity<Option<[f64; 2]>>,
}

/// What one model says at a load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointResult {
    /// Nominal pressure, Pa.
    pub pressure: f64,
    /// Separation, m, and over sigma.
    pub separation: Option<[f64; 2]>,
    /// Real over nominal contact area.
    pub area_ratio: f64,
    /// Contacts per nominal area, 1/m^2; `None` of the reference.
    pub contact_density: Option<f64>,
    /// -dp/dd, Pa/m.
    pub stiffness: Option<f64>,
    /// Conductances per nominal area (S/m^2, W/(m^2 K)) and shear stress (Pa); 0 where there is none.
    pub spots: SpotValues,
    /// Shares of the load in elastic, elastic-plastic and plastic contacts; `None` of the reference, and without contact.
    pub shares: Option<[f64; 3]>,
}

impl From<&PointResult> for ContactResult {
    fn from(point: &PointResult) -> Self {
        let &PointResult { pressure, separation, area_ratio, stiffness, spots, .. } = point;
        Self { pressure, separation_over_sigma: separation.map(|[_, h]| h), area_ratio, stiffness, spots }
    }
}

impl From<&Response> for PointResult {
    fn from(response: &Response) -> Self {
        Self {
            pressure: response.pressure.total(),
            separation: Some([response.separation, response.separation_over_sigma]),
            area_ratio: response.area_ratio.total(),
            contact_density: Some(response.contact_density),
            stiffness: Some(response.stiffness),
            spots: response.spots,
            shares: response.pressure.shares(),
        }
    }
}

impl From<&ReferencePoint> for PointResult {
    fn from(point: &ReferencePoint) -> Self {
        Self {
            pressure: point.pressure,
            separation: point.separation.zip(point.separation_over_sigma).map(|(d, h)| [d, h]),
            area_ratio: point.area_ratio,
            contact_density: None,
            stiffness: point.stiffness,
            spots: point.spots,
            shares: None,
        }
    }
}

impl PointResult {
    /// Load over real contact area, Pa; `None` without contact.
    pub fn mean_real_pressure(&self) -> Option<f64> {
        (self.area_ratio > 0.0).then(|| self.pressure / self.area_ratio)
    }

    /// A quantity as it is compared; `None` where there is none.
    pub fn value(&self, quantity: ComparedQuantity) -> Option<f64> {
        quantity.value(self)
    }

    fn mean(all: &[Self]) -> Option<Self> {
        let count = all.len() as f64;
        let mean = |of: &dyn Fn(&Self) -> Option<f64>| Some(all.iter().map(of).sum::<Option<f64>>()? / count);
        let separation = [0, 1].map(|k| mean(&|one| Some(one.separation?[k])));
        let shares = [0, 1, 2].map(|k| mean(&|one| Some(one.shares?[k])));
        Some(Self {
            pressure: mean(&|one| Some(one.pressure))?,
            separation: separation[0].zip(separation[1]).map(|(d, h)| [d, h]),
            area_ratio: mean(&|one| Some(one.area_ratio))?,
            contact_density: mean(&|one| one.contact_density),
            stiffness: mean(&|one| one.stiffness),
            spots: std::array::from_fn(|k| all.iter().map(|one| one.spots[k]).sum::<f64>() / count),
            shares: shares[0].zip(shares[1]).zip(shares[2]).map(|((a, b), c)| [a, b, c]),
        })
    }
}

/// Points by their model, `None` that of the reference.
type PointsOfModels = Vec<(Option<ModelKind>, PointResult)>;

impl CaseResults {
    /// Whether each model, and the reference, was asked for one point only, so that its curves are points.
    pub fn is_single(&self) -> bool {
        let curves = &self.comparison.curves;
        let points = |kind: ModelKind| curves.iter().filter(|point| point.kind == kind).count();
        let of_reference = self.reference.as_ref().map_or(0, |curve| curve.points.len());
        let of_models = [ModelKind::Statistical, ModelKind::Deterministic].map(points);
        of_models.into_iter().chain([of_reference]).max() == Some(1)
    }

    /// What was computed at the nominal pressure `pressure` (Pa) of a pair.
    fn at_load(&self, pressure: f64) -> PointsOfModels {
        let pair = self.comparison.pairs_at_load().find(|pair| pair.target == pressure);
        let models = pair.into_iter().flat_map(|pair| {
            [(ModelKind::Statistical, &pair.statistical), (ModelKind::Deterministic, &pair.deterministic)]
        });
        let models = models.map(|(kind, response)| (Some(kind), PointResult::from(response)));
        let reference = self.reference.as_ref().and_then(|curve| curve.at_load(pressure));
        models.chain(reference.map(|point| (None, PointResult::from(point)))).collect()
    }

    /// What was computed at the middle point of each curve, by the load.
    fn in_the_middle(&self) -> PointsOfModels {
        let middle = |kind: ModelKind| {
            let of_model = self.comparison.curves.iter().filter(|point| point.kind == kind);
            let mut points: Vec<&CurvePoint> = of_model.collect();
            points.sort_by(|a, b| a.response.pressure.total().total_cmp(&b.response.pressure.total()));
            Some((Some(kind), PointResult::from(&points.get(points.len() / 2)?.response)))
        };
        let reference = self.reference.as_ref().and_then(|curve| {
            let mut points: Vec<&ReferencePoint> = curve.points.iter().collect();
            points.sort_by(|a, b| a.pressure.total_cmp(&b.pressure));
            Some((None, PointResult::from(*points.get(points.len() / 2)?)))
        });
        let models = [ModelKind::Statistical, ModelKind::Deterministic].into_iter().filter_map(middle);
        models.chain(reference).collect()
    }
}

impl CaseStudy {
    /// The results at the load that was asked for; of several loads at the middle one of those that are admissible (and at which the
    /// reference was run), or of all where none is. Loads that the spec prescribes go before those of a separation sweep.
    pub fn results_at_load(&self) -> LoadResults {
        match self.reported_load() {
            Some(at) if !self.first().is_single() => self.results_at(at.load),
            at => self.results_of(at, &CaseResults::in_the_middle),
        }
    }

    /// The results at the nominal pressure `load` (Pa) of a pair.
    pub fn results_at(&self, load: f64) -> LoadResults {
        let at = self.verdicts.differences.iter().find(|at| at.load == load);
        self.results_of(at, &|case| case.at_load(load))
    }

    /// The results that each realisation has, with intervals of those `at` a load.
    fn results_of(
        &self,
        at: Option<&Difference>,
        of_realisation: &dyn Fn(&CaseResults) -> PointsOfModels,
    ) -> LoadResults {
        let each: Vec<PointsOfModels> = self.realisations.iter().map(of_realisation).collect();
        let model = |&(model, _): &(Option<ModelKind>, PointResult)| {
            let of_model =
                |all: &PointsOfModels| all.iter().find(|(other, _)| *other == model).map(|(_, point)| *point);
            let points: Vec<PointResult> = each.iter().map(of_model).collect::<Option<_>>()?;
            let point = PointResult::mean(&points)?;
            let of_models = at.map_or([None; 2], |at| at.of_models);
            let half = model.and_then(|kind| of_models[usize::from(kind == ModelKind::Deterministic)]);
            let interval = |quantity: ComparedQuantity| {
                if points.len() > 1 && self.verdicts.shifts > 1 {
                    let quantile = at?.estimates[quantity as usize]?.quantile;
                    return interval_of_positions(&points, quantity, half?[quantity as usize], quantile);
                }
                if points.len() > 1 {
                    let values: Option<Vec<f64>> = points.iter().map(|one| one.value(quantity)).collect();
                    return values.map(|values| interval_of_mean(&values));
                }
                let (value, half) = (quantity.scaled(point.value(quantity)?), half?[quantity as usize]);
                Some([value - half, value + half].map(|end| quantity.unscaled(end)))
            };
            Some(ModelResult { model, point, intervals: ComparedQuantity::ALL.map(interval) })
        };
        LoadResults {
            exceeded: at.map_or_else(Exceeded::default, Difference::exceeded),
            models: each[0].iter().filter_map(model).collect(),
        }
    }

    /// The differences at the load at which results are reported; `None` where the models are not compared at equal load.
    pub fn reported_load(&self) -> Option<&Difference> {
        let differences = &self.verdicts.differences;
        let has_reference = |at: &&Difference| {
            self.first().reference.as_ref().is_some_and(|curve| curve.at_load(at.load).is_some())
        };
        let curves = &self.first().comparison.curves;
        let is_prescribed =
            |at: &&Difference| curves.iter().any(|point| point.prescribed_pressure == Some(at.load));
        let loads = narrow(differences.iter().collect(), &is_prescribed);
        let loads = narrow(loads, &has_reference);
        let loads = narrow(loads, &|at| at.exceeded().is_none());
        loads.get(loads.len() / 2).copied()
    }
}

/// Those of the loads for which a condition holds; all where it holds for none.
fn narrow<'a>(loads: Vec<&'a Difference>, holds: &dyn Fn(&&Difference) -> bool) -> Vec<&'a Difference> {
    let held: Vec<&Difference> = loads.iter().copied().filter(|at| holds(at)).collect();
    if held.is_empty() { loads } else { held }
}

/// The 95 % interval of the mean of at least two values.
fn interval_of_mean(values: &[f64]) -> [f64; 2] {
    let Scatter { mean, deviation } = Scatter::new(values);
    let half = student_quantile(values.len()) * deviation / (values.len() as f64).sqrt();
    [mean - half, mean + half]
}

/// The same of a mean over relative positions of two bodies, where the blocks of the first give the half-width `half`
/// ([scaled](ComparedQuantity::scaled)) of `quantile` standard errors.
fn interval_of_positions(
    points: &[PointResult],
    quantity: ComparedQuantity,
    half: f64,
    quantile: f64,
) -> Option<[f64; 2]> {
    let values: Option<Vec<f64>> =
        points.iter().map(|one| Some(quantity.scaled(one.value(quantity)?))).collect();
    let Scatter { mean, deviation } = Scatter::new(&values?);
    let half = quantile * error_over_positions(half / quantile, deviation * deviation, points.len());
    half.is_finite().then(|| [mean - half, mean + half].map(|end| quantity.unscaled(end)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_over_realisations_has_students_interval() {
        let [low, high] = interval_of_mean(&[1.0, 3.0]);
        // 12.706 standard errors of 1.
        assert!((low + 10.706_204_7).abs() < 1e-6 && (high - 14.706_204_7).abs() < 1e-6, "{low} {high}");
    }

    #[test]
    fn a_quantity_that_one_realisation_lacks_has_no_mean() {
        let one = PointResult {
            pressure: 2.0,
            separation: Some([1e-9, 1.0]),
            area_ratio: 0.02,
            contact_density: Some(4.0),
            stiffness: None,
            spots: Default::default(),
            shares: Some([0.5, 0.5, 0.0]),
        };
        let other = PointResult { area_ratio: 0.04, stiffness: Some(1.0), shares: None, ..one };
        let mean = PointResult::mean(&[one, other]).unwrap();
        assert_eq!((mean.stiffness, mean.shares), (None, None));
        assert!((mean.area_ratio - 0.03).abs() < 1e-15);
        assert!((mean.mean_real_pressure().unwrap() - 2.0 / 0.03).abs() < 1e-12);
    }
}
