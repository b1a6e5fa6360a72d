//! Cost of a curve of many separations within a tolerance, compared with the exact curve.

use std::hint::black_box;
use std::iter;

use super::sum::spread;
use super::timing::{Candidate, medians};
use asperity::compare::Kind;
use asperity::{
    Curve, Deterministic, Draw, MicroContact, Model, Population, ReferencePlane, Response, SetError,
    Statistical, respond_within,
};

/// Settings of the curve benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTask {
    /// Asperities in the set that is summed.
    pub asperities: usize,
    /// Separations of the curve.
    pub separations: usize,
    /// Tolerances, ascending.
    pub tolerances: Vec<f64>,
}

/// One curve of one model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// The model.
    pub kind: Kind,
    /// The tolerance; `None` of an exact curve.
    pub tolerance: Option<f64>,
    /// Separations.
    pub separations: usize,
    /// Separations at which the model was evaluated.
    pub evaluated: usize,
    /// The largest relative error of the area against the exact curve.
    pub area_error: f64,
    /// The same of the load.
    pub load_error: f64,
    /// Seconds for the whole curve.
    pub seconds: f64,
}

impl CurvePoint {
    /// The larger of both errors.
    pub fn error(&self) -> f64 {
        self.area_error.max(self.load_error)
    }
}

/// The curves of both models.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveFindings {
    /// Asperities in the set that was summed.
    pub asperities: usize,
    /// Model by model: the exact curve, then by tolerance.
    pub points: Vec<CurvePoint>,
}

impl CurveFindings {
    /// The time of a curve over that of the exact curve of its model.
    pub fn time_ratio(&self, point: &CurvePoint) -> f64 {
        let exact = self.points.iter().find(|exact| exact.kind == point.kind);
        exact.map_or(f64::NAN, |exact| point.seconds / exact.seconds)
    }

    /// The curves of a model of which separations were interpolated, by tolerance.
    pub fn interpolated(&self, kind: Kind) -> impl Iterator<Item = &CurvePoint> {
        self.points.iter().filter(move |point| point.kind == kind && point.evaluated < point.separations)
    }
}

/// Curves of the integral and of a random set of a population, which `seed` decides.
///
/// # Errors
/// A population or count that makes no set.
pub fn curves_of(
    contact: &dyn MicroContact,
    population: &Population,
    task: &CurveTask,
    seed: [u8; 32],
) -> Result<CurveFindings, SetError> {
    let set = population.set(task.asperities, Draw::Random(seed))?;
    let plane = ReferencePlane { mean: 0.0, sigma: population.sigma };
    let mut points = curves(Kind::Statistical, &Statistical::new(contact, population.clone()), task);
    points.extend(curves(Kind::Deterministic, &Deterministic::new(contact, set.spheres(), plane), task));
    Ok(CurveFindings { asperities: task.asperities, points })
}

/// All separations exactly, and within each tolerance.
fn curves(kind: Kind, model: &dyn Model, task: &CurveTask) -> Vec<CurvePoint> {
    let separations = &spread(task.separations)[..];
    let curve = |tolerance: Option<f64>| match tolerance {
        Some(tolerance) => respond_within(model, black_box(separations), tolerance),
        None => {
            Curve { responses: model.respond_all(black_box(separations)), evaluated: separations.to_vec() }
        }
    };
    let tolerances = || iter::once(None).chain(task.tolerances.iter().copied().map(Some));
    let mut found: Vec<Option<Curve>> = tolerances().map(|_| None).collect();
    let mut candidates: Vec<Candidate> = Vec::new();
    for (tolerance, found) in tolerances().zip(&mut found) {
        candidates.push(Box::new(move || *found = Some(curve(tolerance))));
    }
    let seconds = medians(&mut candidates);
    drop(candidates);
    let found: Vec<Curve> = found.into_iter().flatten().collect();
    let point = |((curve, seconds), tolerance): ((&Curve, f64), Option<f64>)| {
        let error = |of: fn(&Response) -> f64| largest_error(&curve.responses, &found[0].responses, of);
        CurvePoint {
            kind,
            tolerance,
            separations: curve.responses.len(),
            evaluated: curve.evaluated.len(),
            area_error: error(|response| response.area_ratio.total()),
            load_error: error(|response| response.pressure.total()),
            seconds,
        }
    };
    found.iter().zip(seconds).zip(tolerances()).map(point).collect()
}

fn largest_error(found: &[Response], exact: &[Response], of: fn(&Response) -> f64) -> f64 {
    let relative =
        |(found, exact): (f64, f64)| if found == exact { 0.0 } else { (found / exact - 1.0).abs() };
    found.iter().map(of).zip(exact.iter().map(of)).map(relative).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::{Heights, Interface, Material, Zmc};

    #[test]
    fn a_looser_tolerance_takes_fewer_evaluations_and_holds() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let contact = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
        let case = Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN };
        let task = CurveTask { asperities: 20_000, separations: 8000, tolerances: vec![1e-6, 5e-3, 1e-2] };
        let found = curves_of(&contact, &case, &task, [5; 32]).unwrap();
        assert_eq!(found.points.len(), 2 * 4);
        for curves in found.points.chunks(4) {
            let [exact, all, within @ ..] = curves else { unreachable!() };
            for exact in [exact, all] {
                assert_eq!((exact.separations, exact.evaluated, exact.error()), (8000, 8000, 0.0));
            }
            let timed = [(exact, 2.0), (all, 7.0)].map(|(point, seconds)| CurvePoint { seconds, ..*point });
            let timed = CurveFindings { asperities: 1, points: timed.to_vec() };
            assert_eq!(timed.time_ratio(&timed.points[1]), 3.5);
            for point in within {
                assert!(point.error() <= point.tolerance.unwrap(), "{point:?}");
                assert!(point.separations == 8000 && point.seconds > 0.0);
                assert!(point.area_error > 0.0 && point.load_error > 0.0);
            }
            assert!(within[0].evaluated > within[1].evaluated && within[1].evaluated < 2000, "{within:?}");
            assert!(found.interpolated(exact.kind).eq(within), "{curves:?}");
        }
    }
}
