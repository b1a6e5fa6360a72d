//! Cost of a curve of many separations within a tolerance, compared with all of them and with a few of them exact.

use std::hint::black_box;

use super::sum::spread;
use super::timing::{Candidate, medians};
use asperity::compare::Kind;
use asperity::{
    Curve, Deterministic, Draw, MicroContact, Model, Population, ReferencePlane, Response, SetError,
    Statistical, respond_within,
};

/// The tolerances at which a curve of a thousand separations is to cost no more than twice one of fifty: a sum has a kink
/// at every asperity, an integral has none.
pub const EASY: [(Kind, f64); 2] = [(Kind::Statistical, 1e-8), (Kind::Deterministic, 1e-4)];

/// Settings of the curve benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTask {
    /// Asperities in the set that is summed.
    pub asperities: usize,
    /// Separations of the curve.
    pub separations: usize,
    /// Separations of the exact curve that it is held against.
    pub beside: usize,
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
    /// Model by model: few separations exactly, all of them exactly, then by tolerance.
    pub points: Vec<CurvePoint>,
}

impl CurveFindings {
    /// Few separations, exactly: what the other curves of a model are held against.
    pub fn yardstick(&self, kind: Kind) -> Option<&CurvePoint> {
        self.points.iter().find(|point| point.kind == kind)
    }

    /// The time of a curve over that of its yardstick.
    pub fn times(&self, point: &CurvePoint) -> f64 {
        self.yardstick(point.kind).map_or(f64::NAN, |yardstick| point.seconds / yardstick.seconds)
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

/// Few separations exactly, all exactly, and all within each tolerance.
fn curves(kind: Kind, model: &dyn Model, task: &CurveTask) -> Vec<CurvePoint> {
    let (few, all) = (spread(task.beside), spread(task.separations));
    let exactly = |separations: &[f64]| Curve {
        responses: model.respond_all(black_box(separations)),
        evaluated: separations.to_vec(),
    };
    let tolerances = || [None, None].into_iter().chain(task.tolerances.iter().copied().map(Some));
    let mut found: Vec<Option<Curve>> = tolerances().map(|_| None).collect();
    let mut candidates: Vec<Candidate> = Vec::new();
    for (place, (tolerance, found)) in tolerances().zip(&mut found).enumerate() {
        let separations = if place == 0 { &few } else { &all };
        candidates.push(Box::new(move || {
            *found = Some(match tolerance {
                Some(tolerance) => respond_within(model, black_box(separations), tolerance),
                None => exactly(separations),
            });
        }));
    }
    let seconds = medians(&mut candidates);
    drop(candidates);
    let found: Vec<Curve> = found.into_iter().flatten().collect();
    let point = |(place, ((curve, seconds), tolerance)): (usize, ((&Curve, f64), Option<f64>))| {
        let exact = &found[place.min(1)].responses;
        let error = |of: fn(&Response) -> f64| largest_error(&curve.responses, exact, of);
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
    found.iter().zip(seconds).zip(tolerances()).enumerate().map(point).collect()
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
    fn a_looser_tolerance_asks_for_fewer_answers_and_is_held() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let contact = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
        let case = Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN };
        let task = CurveTask {
            asperities: 200_000,
            separations: 400,
            beside: 20,
            tolerances: vec![1e-9, 1e-5, 1e-2],
        };
        let found = curves_of(&contact, &case, &task, [5; 32]).unwrap();
        assert_eq!(found.points.len(), 2 * 5);
        for curves in found.points.chunks(5) {
            let [few, all, within @ ..] = curves else { unreachable!() };
            assert_eq!((few.separations, few.evaluated, few.error()), (20, 20, 0.0));
            assert_eq!((all.separations, all.evaluated, all.error()), (400, 400, 0.0));
            let timed = [(few, 2.0), (all, 7.0)].map(|(point, seconds)| CurvePoint { seconds, ..*point });
            let timed = CurveFindings { asperities: 1, points: timed.to_vec() };
            assert_eq!(timed.times(&timed.points[1]), 3.5);
            for point in within {
                let tolerance = point.tolerance.unwrap();
                assert!(point.error() <= tolerance, "{point:?}");
                assert!(point.separations == 400 && point.seconds > 0.0);
            }
            assert!(within[0].evaluated > within[2].evaluated, "{within:?}");
            // What is interpolated is not exact.
            assert!(within[2].area_error > 0.0 && within[2].load_error > 0.0);
        }
    }
}
