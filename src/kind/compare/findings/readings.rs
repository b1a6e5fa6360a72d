//! Two readings of the same numbers: sigma and d as those of the asperities, or of the surface.

use asperity::Response;
use asperity::compare::{Control, Kind};
use asperity::numeric::extremes;
use asperity::topography::generate::SigmaOf;

use crate::kind::compare::answers::RealisationResults;
use crate::kind::compare::results::SurfaceResults;

/// The d/sigma at which readings are compared.
const SEPARATIONS: [f64; 3] = [1.0, 2.0, 3.0];

/// Loads of surfaces that have the same specified numbers and differ in whose sigma and d they are.
#[derive(Debug, Clone, PartialEq)]
pub struct Readings {
    /// Pair by pair of surfaces, law by law, separation by separation, model by model; at least one.
    pub loads: Vec<ReadLoads>,
}

/// One model at the same d/sigma under both readings; means over the realisations.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadLoads {
    /// The surface whose sigma is that of the asperities, and the one whose sigma is that of the surface.
    pub surfaces: [String; 2],
    /// The law, as tables name it.
    pub law: String,
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    /// The model.
    pub kind: Kind,
    /// d/sigma.
    pub separation: f64,
    /// Under each reading.
    pub answers: [ReadAnswer; 2],
}

/// Means over the realisations of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadAnswer {
    /// Nominal pressure, Pa.
    pub pressure: f64,
    /// Whether the model is within its valid range in each realisation.
    pub is_valid: bool,
}

impl ReadLoads {
    /// Load with sigma of the surface over that with sigma of the asperities.
    pub fn ratio(&self) -> f64 {
        self.answers[1].pressure / self.answers[0].pressure
    }

    /// Whether both answers are valid.
    pub fn is_valid(&self) -> bool {
        self.answers.iter().all(|answer| answer.is_valid)
    }
}

impl Readings {
    /// Of the surfaces of a comparison; `None` where no two have the same numbers in both readings, or none of
    /// d/sigma = 1, 2 and 3 is in the sweep.
    pub fn of(surfaces: &[SurfaceResults]) -> Option<Self> {
        let of_reading = |wanted| {
            surfaces.iter().filter_map(move |found| {
                let numbers = found.surface.specified()?;
                (found.surface.separations_of() == wanted).then_some((found, numbers))
            })
        };
        let mut loads = Vec::new();
        for (asperities, numbers) in of_reading(SigmaOf::Summits) {
            for (surface, _) in of_reading(SigmaOf::Surface).filter(|(_, others)| *others == numbers) {
                loads.extend(read_loads([asperities, surface]));
            }
        }
        (!loads.is_empty()).then_some(Self { loads })
    }

    /// Smallest and largest ratio of the loads.
    pub fn range(&self) -> Option<[f64; 2]> {
        extremes(self.loads.iter().map(ReadLoads::ratio))
    }

    /// The same where both loads are valid; `None` where none are.
    pub fn valid_range(&self) -> Option<[f64; 2]> {
        extremes(self.loads.iter().filter(|loads| loads.is_valid()).map(ReadLoads::ratio))
    }

    /// Smallest and largest d/sigma.
    pub fn separations(&self) -> Option<[f64; 2]> {
        extremes(self.loads.iter().map(|loads| loads.separation))
    }
}

/// The loads of two surfaces, case by case.
fn read_loads(surfaces: [&SurfaceResults; 2]) -> Vec<ReadLoads> {
    let mut loads = Vec::new();
    for (index, case) in surfaces[0].first.cases.iter().enumerate() {
        for separation in SEPARATIONS {
            for kind in [Kind::Statistical, Kind::Deterministic] {
                let [first, second] = surfaces.map(|found| answer(found, index, kind, separation));
                let (Some(first), Some(second)) = (first, second) else { continue };
                if first.pressure > 0.0 {
                    loads.push(ReadLoads {
                        surfaces: surfaces.map(|found| found.surface.name.clone()),
                        law: case.law.clone(),
                        thickness: case.thickness,
                        kind,
                        separation,
                        answers: [first, second],
                    });
                }
            }
        }
    }
    loads
}

/// Means of a model over the realisations at one separation; `None` where it is not in the sweep.
fn answer(found: &SurfaceResults, index: usize, kind: Kind, separation: f64) -> Option<ReadAnswer> {
    let all: Option<Vec<Response>> =
        found.realisations().map(|(_, answered)| response(answered, index, kind, separation)).collect();
    let all = all?;
    let pressure = all.iter().map(|response| response.pressure.total()).sum::<f64>() / all.len() as f64;
    // An integral has no single contacts: the limits of both models hold.
    let both = || [Kind::Statistical, Kind::Deterministic];
    let is_valid = found.realisations().all(|(_, answered)| {
        let all = both().into_iter().filter_map(|kind| response(answered, index, kind, separation));
        all.into_iter().all(|response| response.exceeded().is_none())
    });
    Some(ReadAnswer { pressure, is_valid })
}

fn response(answered: &RealisationResults, index: usize, kind: Kind, separation: f64) -> Option<Response> {
    /// Rounding of a sweep's steps.
    const ROUNDING: f64 = 1e-9;
    let curves = &answered.cases.get(index)?.comparison.curves;
    let is_there = |h: f64| (h - separation).abs() < ROUNDING;
    let point = curves
        .iter()
        .find(|point| point.kind == kind && point.control == Control::Separation && is_there(point.target));
    point.map(|point| point.response)
}
