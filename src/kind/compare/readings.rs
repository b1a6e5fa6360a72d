//! Two readings of the same numbers: sigma and d as those of the asperities, or of the surface.

use asperity::Response;
use asperity::compare::{Control, ModelKind};
use asperity::study::{CaseResults, CaseStudy};
use asperity::topography::generate::SigmaOf;

use crate::kind::compare::results::SurfaceResults;

/// The d/sigma at which readings are compared.
const SEPARATIONS: [f64; 3] = [1.0, 2.0, 3.0];

/// One model at the same d/sigma under both readings; means over the realisations.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadLoads {
    /// The surface whose sigma is that of the asperities, and the one whose sigma is that of the surface.
    pub surfaces: [String; 2],
    /// The law, as tables name it.
    pub law: String,
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    pub kind: ModelKind,
    /// d/sigma.
    pub separation: f64,
    pub answers: [ReadAnswer; 2],
}

/// Means over the realisations of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadAnswer {
    /// Nominal pressure, Pa.
    pub pressure: f64,
    /// Whether the model is within its admissible range in each realisation.
    pub is_admissible: bool,
}

impl ReadLoads {
    /// Load with sigma of the surface over that with sigma of the asperities.
    pub fn ratio(&self) -> f64 {
        self.answers[1].pressure / self.answers[0].pressure
    }

    pub fn is_admissible(&self) -> bool {
        self.answers.iter().all(|answer| answer.is_admissible)
    }
}

/// The loads of the surfaces of a comparison that have the same specified numbers and differ in whose sigma and d they are: pair by pair of
/// surfaces, law by law, separation by separation, model by model.
pub fn loads_by_reading(surfaces: &[SurfaceResults]) -> Vec<ReadLoads> {
    let of_reading = |wanted| {
        surfaces.iter().filter_map(move |results| {
            let numbers = results.surface.specified()?;
            (results.surface.separations_of() == wanted).then_some((results, numbers))
        })
    };
    let mut loads = Vec::new();
    for (asperities, numbers) in of_reading(SigmaOf::Summits) {
        for (surface, _) in of_reading(SigmaOf::Surface).filter(|(_, others)| *others == numbers) {
            loads.extend(read_loads([asperities, surface]));
        }
    }
    loads
}

/// The loads of two surfaces, case by case.
fn read_loads(surfaces: [&SurfaceResults; 2]) -> Vec<ReadLoads> {
    let mut loads = Vec::new();
    for (first_case, second_case) in surfaces[0].cases.iter().zip(&surfaces[1].cases) {
        for separation in SEPARATIONS {
            for kind in [ModelKind::Statistical, ModelKind::Deterministic] {
                let [first, second] = [first_case, second_case].map(|case| mean_load(case, kind, separation));
                let (Some(first), Some(second)) = (first, second) else { continue };
                if first.pressure > 0.0 {
                    loads.push(ReadLoads {
                        surfaces: surfaces.map(|results| results.surface.name.clone()),
                        law: first_case.first().law.clone(),
                        thickness: first_case.first().thickness,
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
fn mean_load(case: &CaseStudy, kind: ModelKind, separation: f64) -> Option<ReadAnswer> {
    let responses: Option<Vec<Response>> =
        case.realisations.iter().map(|results| response(results, kind, separation)).collect();
    let responses = responses?;
    let sum: f64 = responses.iter().map(|response| response.pressure.total()).sum();
    // An integral has no single contacts: the limits of both models hold.
    let is_admissible = case.realisations.iter().all(|results| {
        let both = [ModelKind::Statistical, ModelKind::Deterministic];
        both.into_iter()
            .filter_map(|kind| response(results, kind, separation))
            .all(|response| response.exceeded().is_none())
    });
    Some(ReadAnswer { pressure: sum / responses.len() as f64, is_admissible })
}

fn response(results: &CaseResults, kind: ModelKind, separation: f64) -> Option<Response> {
    /// Rounding of a sweep's steps.
    const ROUNDING: f64 = 1e-9;
    let is_there = |h: f64| (h - separation).abs() < ROUNDING;
    let mut points = results.comparison.curves.iter();
    let point = points
        .find(|point| point.kind == kind && point.control == Control::Separation && is_there(point.target));
    point.map(|point| point.response)
}
