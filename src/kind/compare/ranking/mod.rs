//! How far each statistical model of a surface is from the sum and from the reference, and what it costs.

pub(super) mod tables;

use asperity::compare::{ComparedQuantity, Kind, Pair, Pairing, ReferenceCurve, of_each_decade};
use asperity::distribution::{HeightModel, HeightsError};
use asperity::topography::joint::JointDensity;
use asperity::work::{CountedContact, Counter};
use asperity::{
    ContactLaw, Heights, MeanRadius, MicroContact, Model, ReferencePlane, Response, SummitShape, joint_model, reached_at,
};
use asperity_framework::contact::LawPlan;

use super::answers::CaseResults;
use super::models::SurfaceModels;
use super::plan::Setup;
use super::statistical::StatisticalModel;
use crate::surface::Surface;

/// Loads per decade at which models are compared.
const PER_DECADE: f64 = 3.0;

/// A statistical model that takes part.
#[derive(Debug, Clone, PartialEq)]
pub enum Candidate {
    /// A height density and one radius.
    Separate(StatisticalModel),
    /// Summits of a continuous Gaussian surface (Nayak 1971; Greenwood 2006).
    NayakGreenwood,
    /// Five-point summits of a Gaussian surface on the grid of the map (Greenwood 1984).
    FivePoint,
}

impl Candidate {
    /// All of them, the simplest first.
    fn all() -> Vec<Self> {
        let given = [Heights::GAUSSIAN, Heights::EXPONENTIAL].map(HeightModel::Given);
        let heights: Vec<HeightModel> = given.into_iter().chain(HeightModel::FITTED).collect();
        let radii = [MeanRadius::Arithmetic, MeanRadius::InverseMeanCurvature, MeanRadius::InContact];
        let separate = radii.into_iter().flat_map(|mean_radius| {
            let of = move |heights: &HeightModel| StatisticalModel { heights: Some(heights.clone()), mean_radius };
            heights.iter().map(of).collect::<Vec<_>>()
        });
        separate.map(Self::Separate).chain([Self::NayakGreenwood, Self::FivePoint]).collect()
    }

    /// The name in tables.
    pub fn name(&self) -> String {
        match self {
            Self::Separate(StatisticalModel { heights, mean_radius }) => {
                let heights = heights.as_ref().map_or("gaussian", HeightModel::name);
                let radius = match mean_radius {
                    MeanRadius::Arithmetic => "arithmetic",
                    MeanRadius::InverseMeanCurvature => "inverse-mean-curvature",
                    MeanRadius::InContact => "in-contact",
                };
                format!("{heights}, {radius}")
            }
            Self::NayakGreenwood => "nayak-greenwood".to_owned(),
            Self::FivePoint => "five-point".to_owned(),
        }
    }
}

/// The largest contrast of a model, with its load, Pa.
pub type Largest = Option<(f64, f64)>;

/// A model on one surface under one law.
#[derive(Debug, Clone)]
pub struct Ranked {
    /// The model.
    pub candidate: Candidate,
    /// The largest difference from the sum in each of [`ComparedQuantity::ALL`].
    pub from_sum: [Largest; 3],
    /// The largest difference from the reference; `None` where there is none.
    pub from_reference: [Largest; 3],
    /// Contacts evaluated per load.
    pub evaluations: f64,
}

/// The models on one surface under one law.
#[derive(Debug, Clone, Default)]
pub struct Ranking {
    /// Those that apply.
    pub models: Vec<Ranked>,
    /// Those that do not, and why.
    pub inapplicable: Vec<(Candidate, String)>,
    /// The loads at which the models were compared, Pa.
    pub loads: Vec<f64>,
}

/// The ranking of each case of a surface; nothing where only one model was run, or no ranking is asked for.
pub(super) fn rank(setup: Setup, surface: &Surface, cases: &[CaseResults]) -> Vec<Ranking> {
    let has_both = [Kind::Statistical, Kind::Deterministic].iter().all(|kind| setup.models.contains(kind));
    if !(has_both && setup.is_ranked) {
        return Vec::new();
    }
    setup.progress.stage("other statistical models", cases.len() as f64);
    let built: Vec<(Candidate, Result<Built, HeightsError>)> =
        Candidate::all().into_iter().map(|candidate| (candidate.clone(), Built::of(&candidate, surface, setup))).collect();
    let of_case = |(law, case): (&LawPlan, &CaseResults)| {
        let ranking = of_case(&built, law, case);
        setup.progress.advance(1.0);
        ranking
    };
    setup.laws.iter().zip(cases).map(of_case).collect()
}

/// A candidate on one surface.
enum Built<'a> {
    Separate(SurfaceModels<'a>),
    Joint(JointDensity, ReferencePlane),
}

impl<'a> Built<'a> {
    fn of(candidate: &Candidate, surface: &'a Surface, setup: Setup) -> Result<Self, HeightsError> {
        let needs_map = || HeightsError::from("it needs a map");
        let joint = |density: Option<JointDensity>| {
            let density = density.ok_or("no isotropic Gaussian surface has these moments")?;
            let mean = surface.plane_above_mean_plane().ok_or_else(needs_map)?;
            Ok(Self::Joint(density, ReferencePlane { mean, sigma: surface.plane.sigma }))
        };
        let roughness = surface.map.as_ref().map(|map| &map.roughness);
        match candidate {
            Candidate::Separate(model) => {
                Ok(Self::Separate(SurfaceModels::new(surface, model, setup.law_specs, false)?))
            }
            Candidate::NayakGreenwood => {
                joint(JointDensity::nayak(roughness.ok_or_else(needs_map)?.spectral_moments()))
            }
            Candidate::FivePoint => {
                let map = surface.map.as_ref().ok_or_else(needs_map)?;
                joint(JointDensity::five_point(&map.roughness.drops, map.roughness.moments.sq, map.pixel))
            }
        }
    }

    fn model<'b>(&'b self, contact: &'b dyn MicroContact, law: &ContactLaw, candidate: &Candidate) -> Box<dyn Model + 'b> {
        match self {
            Self::Separate(models) => models.statistical(contact, law),
            Self::Joint(density, plane) => {
                let shape = if law.is_elliptic() && *candidate == Candidate::NayakGreenwood {
                    SummitShape::Ellipse
                } else if *candidate == Candidate::NayakGreenwood {
                    SummitShape::GeometricMean
                } else {
                    SummitShape::ArithmeticMean
                };
                Box::new(joint_model(contact, density, shape, *plane))
            }
        }
    }
}

fn of_case(
    built: &[(Candidate, Result<Built, HeightsError>)],
    law: &LawPlan,
    case: &CaseResults,
) -> Ranking {
    let valid: Vec<Pair> = case
        .comparison
        .pairs
        .iter()
        .filter(|pair| pair.pairing == Pairing::Load && pair.is_valid())
        .copied()
        .collect();
    let mut pairs = of_each_decade(ascending(&valid), |pair| pair.target, PER_DECADE);
    // The loads of the reference, too.
    let has_reference = |pair: &&Pair| case.reference_of(pair).is_some();
    pairs.extend(valid.iter().filter(has_reference).copied());
    let pairs = ascending(&pairs);
    let loads: Vec<f64> = pairs.iter().map(|pair| pair.target).collect();
    let mut ranking = Ranking { loads: loads.clone(), ..Ranking::default() };
    for (candidate, built) in built {
        let built = match built {
            Ok(built) => built,
            Err(error) => {
                ranking.inapplicable.push((candidate.clone(), error.to_string()));
                continue;
            }
        };
        let counter = Counter::default();
        let contact = CountedContact::new(&*law.contact, &counter);
        let responses = reached_at(&*built.model(&contact, &law.spec, candidate), &loads);
        let work = counter.work();
        let responses: Vec<Option<Response>> =
            responses.into_iter().map(|reached| reached.map(|reached| reached.response)).collect();
        ranking.models.push(Ranked {
            candidate: candidate.clone(),
            from_sum: ComparedQuantity::ALL.map(|quantity| from_sum(quantity, case, &pairs, &responses)),
            from_reference: ComparedQuantity::ALL
                .map(|quantity| from_reference(quantity, case.reference.as_ref(), &loads, &responses)),
            evaluations: (work.nodes + work.single_contacts) as f64 / loads.len().max(1) as f64,
        });
    }
    ranking
}

fn ascending(pairs: &[Pair]) -> Vec<Pair> {
    let mut pairs = pairs.to_vec();
    pairs.sort_by(|a, b| a.target.total_cmp(&b.target));
    pairs.dedup_by(|a, b| a.target == b.target);
    pairs
}

/// The largest of contrasts with their loads; `None` where one is missing.
fn largest(contrasts: impl Iterator<Item = Option<(f64, f64)>>) -> Largest {
    let all: Option<Vec<(f64, f64)>> = contrasts.collect();
    all?.into_iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))
}

fn from_sum(
    quantity: ComparedQuantity,
    case: &CaseResults,
    pairs: &[Pair],
    responses: &[Option<Response>],
) -> Largest {
    let is_compared = |load: f64| {
        let at = case.differences.iter().find(|at| at.load == load);
        at.is_some_and(|at| at.estimates[quantity as usize].is_some())
    };
    let compared = pairs.iter().zip(responses).filter(|(pair, _)| is_compared(pair.target));
    largest(compared.map(|(pair, response)| {
        let pair = Pair { statistical: (*response)?, ..*pair };
        Some((quantity.contrast(&pair)?, pair.target))
    }))
}

fn from_reference(
    quantity: ComparedQuantity,
    reference: Option<&ReferenceCurve>,
    loads: &[f64],
    responses: &[Option<Response>],
) -> Largest {
    let reference = reference?;
    let compared = loads.iter().zip(responses).filter_map(|(&load, response)| Some((load, response, reference.at_load(load)?)));
    largest(compared.map(|(load, response, point)| Some((point.contrast(quantity, response.as_ref()?)?, load))))
}
