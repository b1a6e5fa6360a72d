//! Results of several laws on one asperity and on surfaces: everything that their report contains.

use std::f64::consts::PI;

use super::plan::Critical;
use crate::kind::compare::results::CompareResults;
use asperity::compare::{Dominance, Influence, Measure};
use asperity::sphere::{Boundary, Curve, LARGEST_SLOPE};
use asperity::{Contact, Paper};

/// Several laws on one asperity and on surfaces.
#[derive(Debug)]
pub struct LawsResults {
    /// Both models on the surfaces under every law.
    pub compare: CompareResults,
    /// 1/(mean curvature) of the single asperity, m.
    pub radius: f64,
    /// Its larger principal curvature over the smaller one.
    pub curvature_ratio: f64,
    /// The unit of indentation, load and area.
    pub critical: Critical,
    /// Law by law; the others are compared with the first.
    pub laws: Vec<LawOnOne>,
    /// Surface by surface, realisation by realisation.
    pub influences: Vec<SurfaceInfluence>,
    /// Where small strains end on the single asperity under the first law to exceed them; `None` if none does.
    pub end_of_small_strains: Option<SmallStrainEnd>,
}

impl LawsResults {
    /// What law and summation do on the first realisation of a surface.
    pub fn of_first(&self, surface: &str) -> Option<&SurfaceInfluence> {
        self.influences.iter().find(|found| found.surface == surface)
    }

    /// Whether strains are not small in a contact on the single asperity.
    pub fn is_beyond_small_strains(&self, contact: &Contact) -> bool {
        is_beyond_small_strains(contact, self.radius)
    }
}

/// Whether strains are not small in a contact on an asperity of radius `radius` (m): a/R is larger than
/// [`LARGEST_SLOPE`].
fn is_beyond_small_strains(contact: &Contact, radius: f64) -> bool {
    (contact.area / PI).sqrt() / radius > LARGEST_SLOPE
}

/// Where small strains end on the single asperity.
#[derive(Debug, Clone)]
pub struct SmallStrainEnd {
    /// The law, as tables name it.
    pub law: String,
    /// Indentation, m.
    pub indentation: f64,
}

impl SmallStrainEnd {
    /// The smallest indentation at which strains are not small under one of the laws.
    pub fn of(laws: &[LawOnOne], radius: f64) -> Option<Self> {
        let end = |law: &LawOnOne| {
            let trace = &law.curve.trace;
            let first = trace.iter().find(|point| is_beyond_small_strains(&point.contact, radius))?;
            Some(Self { law: law.law.clone(), indentation: first.indentation })
        };
        laws.iter().filter_map(end).min_by(|a, b| a.indentation.total_cmp(&b.indentation))
    }
}

/// The single asperity under one law.
#[derive(Debug)]
pub struct LawOnOne {
    /// The law, as tables name it.
    pub law: String,
    /// Description and range of validity, in one line.
    pub about: &'static str,
    /// Its papers.
    pub papers: Vec<Paper>,
    /// Whether contacts under it pass from elastic to something else.
    pub is_elastic_plastic: bool,
    /// Load, area and regime against indentation.
    pub curve: Curve,
    /// Boundaries between formulas.
    pub boundaries: Vec<Boundary>,
}

/// Effect of contact law and summation method on one realisation of a surface.
#[derive(Debug)]
pub struct SurfaceInfluence {
    /// The surface.
    pub surface: String,
    /// From 1.
    pub realisation: usize,
    /// The numbers, load by load.
    pub influence: Influence,
    /// Which of the two matters more: one per measure that allows a conclusion.
    pub dominances: Vec<Dominance>,
}

impl SurfaceInfluence {
    /// Which matters more by a measure.
    pub fn dominance(&self, measure: Measure) -> Option<&Dominance> {
        self.dominances.iter().find(|found| found.measure == measure)
    }
}
