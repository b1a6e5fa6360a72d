//! Coverage of intervals in every case: everything that the report contains.

use std::ops::Range;

use super::plan::WindowPlan;
use super::spec::Intervals;
use crate::coverage::{CheckCount, Coverage, CoveredQuantity, PlantedSpikes, VerdictCount};
use asperity::Heights;
use asperity_contact_framework::contact::ContactMetadata;
use asperity_contact_framework::metadata::Metadata;

/// The coverage that intervals of 95 % may have.
pub const BAND: [f64; 2] = [0.93, 0.97];

/// The same of model-based intervals, which are wide rather than narrow.
pub const MODEL_BASED_BAND: [f64; 2] = [0.93, 0.98];

/// Where intervals are claimed in a smaller share of the windows, these are not typical of all.
pub const NEARLY_ALL: f64 = 0.9;

/// The same of model-based intervals, which are withheld by what is measured on a window.
pub const HALF: f64 = 0.5;

/// Where intervals are claimed in a smaller share of the windows, their coverage is not known.
pub const RARELY: f64 = 0.05;

/// Coverage of intervals in every case.
#[derive(Debug)]
pub struct CoverageResults {
    /// What every experiment has.
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    /// The law, as tables name it.
    pub law: String,
    /// What all cases share.
    pub windows: WindowPlan,
    /// Which intervals are claimed.
    pub intervals: Intervals,
    pub cases: Vec<CaseResults>,
    /// Windows of the process of a case with spikes planted in them: first those without.
    pub spikes: Option<SpikesResults>,
}

/// Coverage in the windows of one random process.
#[derive(Debug, Clone)]
pub struct CaseResults {
    /// Its name in the spec.
    pub name: String,
    /// Longest wavelength of the power law, m.
    pub roll_off: f64,
    /// Which intervals are claimed.
    pub intervals: Intervals,
    /// What the roughness is, besides its heights, in words; empty where it is isotropic and homogeneous.
    pub roughness: String,
    pub heights: Heights,
    /// Windows.
    pub windows: usize,
    /// Share of the windows whose roughness is found to be patchy.
    pub patchy: f64,
    /// Median over the windows of the larger correlation length of x and y, m; infinite where that of most does not decay.
    pub correlation: f64,
    pub loads: Vec<LoadCoverage>,
    /// Verdicts in all windows: `within` and `beyond`.
    pub verdicts: VerdictCount,
    /// Those that are very likely by a model-based interval.
    pub likely: VerdictCount,
    /// Those that are very likely by differences far beyond what is accepted on all halves of a window.
    pub far_beyond: VerdictCount,
    /// Verdicts in the windows that were also studied under other treatments.
    pub studied: VerdictCount,
    /// The same, of which those that depend on a choice are not counted as decided.
    pub robust: VerdictCount,
    /// Of the windows studied, those that a fitness check blocks.
    pub blocked: usize,
    /// Fitness checks, none of which should find a fault.
    pub checks: Vec<CheckCount>,
}

/// Windows with spikes.
#[derive(Debug, Clone)]
pub struct SpikesResults {
    /// Name of the case whose process the windows are of.
    pub case: String,
    /// First without spikes, then for each number and height of them.
    pub each: Vec<SpikedResults>,
}

/// Verdicts in windows with spikes of one number and height.
#[derive(Debug, Clone)]
pub struct SpikedResults {
    /// The spikes; `None` of the same windows without.
    pub planted: Option<PlantedSpikes>,
    /// Windows in which spikes are found, so that no verdict is given.
    pub found: usize,
    /// Verdicts in all windows; none in those in which spikes are found.
    pub verdicts: VerdictCount,
    /// The same, of which those that depend on the removal of narrow points are not counted as decided.
    pub without_suspects: VerdictCount,
    /// The same of those that depend on any choice.
    pub robust: VerdictCount,
}

/// Coverage at one load.
#[derive(Debug, Clone)]
pub struct LoadCoverage {
    /// The load, Pa.
    pub load: f64,
    /// The d/sigma at which loads are compared.
    pub separation: f64,
    /// Quantities that have values in at least two windows.
    pub coverages: Vec<(CoveredQuantity, Coverage)>,
}

impl Intervals {
    /// The coverage that they may have.
    pub fn band(self) -> [f64; 2] {
        match self {
            Self::Blocks => BAND,
            Self::ModelBased => MODEL_BASED_BAND,
        }
    }

    /// The same in words.
    pub fn band_name(self) -> &'static str {
        match self {
            Self::Blocks => "93 to 97 %",
            Self::ModelBased => "93 to 98 %",
        }
    }

    /// The share of windows from which on those with an interval count as typical.
    pub fn typical(self) -> f64 {
        match self {
            Self::Blocks => NEARLY_ALL,
            Self::ModelBased => HALF,
        }
    }
}

/// Sums over all cases.
pub fn total(cases: &[CaseResults], of: fn(&CaseResults) -> &VerdictCount) -> VerdictCount {
    cases.iter().fold(VerdictCount::default(), |sum, case| sum.plus(of(case)))
}

impl CaseResults {
    /// Over all loads and quantities.
    pub fn coverages(&self) -> impl Iterator<Item = &(CoveredQuantity, Coverage)> {
        self.loads.iter().flat_map(|load| &load.coverages)
    }

    fn claimed_in(&self, shares: Range<f64>) -> impl Iterator<Item = (&(CoveredQuantity, Coverage), f64)> {
        let claimed =
            self.coverages().filter(move |(_, coverage)| shares.contains(&coverage.claimed_share()));
        claimed.filter_map(|pair| Some((pair, pair.1.claimed.coverage()?)))
    }

    /// Those in which nearly all windows have an interval, each with the coverage of these.
    pub fn claimed(&self) -> impl Iterator<Item = (&(CoveredQuantity, Coverage), f64)> {
        self.claimed_in(self.intervals.typical()..f64::INFINITY)
    }

    /// The same of those in which a part of the windows has an interval.
    pub fn claimed_in_part(&self) -> impl Iterator<Item = (&(CoveredQuantity, Coverage), f64)> {
        self.claimed_in(RARELY..self.intervals.typical())
    }

    /// Those of [`Self::claimed`] whose coverage is not within the band.
    pub fn outside(&self) -> impl Iterator<Item = (&(CoveredQuantity, Coverage), f64)> {
        let [low, high] = self.intervals.band();
        self.claimed().filter(move |(_, coverage)| !(low..=high).contains(coverage))
    }
}
