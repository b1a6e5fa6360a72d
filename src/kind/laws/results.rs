//! Results of several laws on one asperity and on surfaces: everything that their report contains.

use std::f64::consts::PI;

use super::plan::Critical;
use crate::kind::compare::results::CompareResults;
use asperity::compare::{Dominance, Influence};
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
    pub laws: Vec<LawOnAsperity>,
    /// Surface by surface, realisation by realisation.
    pub influences: Vec<SurfaceInfluence>,
}

impl LawsResults {
    /// The effects on the first realisation of a surface.
    pub fn first_influence(&self, surface: &str) -> Option<&SurfaceInfluence> {
        self.influences.iter().find(|influence| influence.surface == surface)
    }

    /// Whether strains are not small in a contact on the single asperity: a/R is larger than [`LARGEST_SLOPE`].
    pub fn is_beyond_small_strains(&self, contact: &Contact) -> bool {
        (contact.area / PI).sqrt() / self.radius > LARGEST_SLOPE
    }

    /// The smallest indentation (m) of the single asperity at which strains are not small under one of the laws.
    pub fn end_of_small_strains(&self) -> Option<f64> {
        let end = |law: &LawOnAsperity| {
            let mut trace = law.curve.trace.iter();
            Some(trace.find(|point| self.is_beyond_small_strains(&point.contact))?.indentation)
        };
        self.laws.iter().filter_map(end).reduce(f64::min)
    }
}

/// The single asperity under one law.
#[derive(Debug)]
pub struct LawOnAsperity {
    /// The law, as tables name it.
    pub law: String,
    /// Description and range of validity, in one line.
    pub about: &'static str,
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
    pub surface: String,
    /// From 1.
    pub realisation: usize,
    /// The numbers, load by load.
    pub influence: Influence,
    /// Which of the two matters more: one per measure that allows a conclusion.
    pub dominances: Vec<Dominance>,
}
