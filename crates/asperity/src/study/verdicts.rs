//! Verdicts on one surface under one law and thickness.

use crate::compare::{Accepted, AdmissibleRange, Attribution, Comparison, Difference, Stretch, Verdict};

use super::reference::ReferenceVerdicts;
use super::results::CaseResults;
use crate::surface::{Independence, Surface};

/// Whether the statistical model may be used instead of the sum, at which loads.
#[derive(Debug)]
pub struct Verdicts {
    /// The differences between the models at equal load, by growing load; over several realisations their mean.
    pub differences: Vec<Difference>,
    /// The differences divided among their causes, by growing load; over several realisations their mean. Empty where none
    /// is asked for.
    pub attribution: Vec<Attribution>,
    /// What is accepted.
    pub accepted: Accepted,
    /// The loads that are admissible.
    pub admissible: AdmissibleRange,
    /// The verdicts: quantity by quantity, by growing load.
    pub stretches: Vec<Stretch>,
    /// What the intervals rest on.
    pub basis: Basis,
    /// Standard error of the separation's difference over that of independent asperities: the median over the valid
    /// loads.
    pub over_independent: Option<f64>,
    /// Nominal area of one realisation, m^2.
    pub area: f64,
    /// Whether a failed fitness check of the surface keeps it from carrying a verdict.
    pub is_blocked: bool,
    /// Both models against the reference, where one was run at some load of both.
    pub reference: Option<ReferenceVerdicts>,
}

/// What 95 % intervals rest on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Basis {
    /// Blocks of a map, each left out in turn.
    Blocks {
        /// Number of blocks.
        count: usize,
        /// Sides of a block, m.
        sides: [f64; 2],
        /// Sides of a block in correlation lengths, of heights or of the amplitude of the roughness.
        lengths: [f64; 2],
    },
    /// A map too small for blocks: no interval.
    TooSmall {
        /// Correlation lengths, of heights or of the amplitude of the roughness, along x and y, m; infinite where the correlation does not decay.
        correlation: [f64; 2],
    },
    /// A list that is not said to be one of independent draws, and has no places: no interval.
    Unstated,
    /// Independent asperities, in groups of which each is left out in turn.
    Asperities,
    /// The scatter of realisations.
    Realisations(usize),
}

impl Basis {
    /// The name in tables.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Blocks { .. } => "blocks",
            Self::TooSmall { .. } | Self::Unstated => "none",
            Self::Asperities => "independent",
            Self::Realisations(_) => "realisations",
        }
    }

    fn new(surface: &Surface, realisations: usize) -> Self {
        if realisations > 1 {
            return Self::Realisations(realisations);
        }
        match &surface.independence {
            Independence::Blocks(blocks) => Self::Blocks {
                count: blocks.counts[0] * blocks.counts[1],
                sides: blocks.sides,
                lengths: [0, 1].map(|axis| blocks.sides[axis] / blocks.correlation.longest()[axis]),
            },
            Independence::TooSmall(error) => Self::TooSmall { correlation: error.correlation.longest() },
            Independence::Unstated => Self::Unstated,
            Independence::Asperities | Independence::Realisations => Self::Asperities,
        }
    }
}

impl Verdicts {
    /// Of a case on all realisations; `surface` is the first.
    pub fn new(surface: &Surface, realisations: &[CaseResults], accepted: Accepted) -> Self {
        let of_each: Vec<Vec<Difference>> =
            realisations.iter().map(|case| case.differences.clone()).collect();
        let mut differences =
            if let [only] = &of_each[..] { only.clone() } else { Difference::over(&of_each) };
        differences.sort_by(|a, b| a.load.total_cmp(&b.load));
        let of_each: Vec<Vec<Attribution>> =
            realisations.iter().map(|case| case.attribution.clone()).collect();
        let mut attribution =
            if let [only] = &of_each[..] { only.clone() } else { Attribution::over(&of_each) };
        attribution.sort_by(|a, b| a.load.total_cmp(&b.load));
        Self {
            accepted,
            attribution,
            admissible: if differences.is_empty() {
                of_one_model(&realisations[0].comparison)
            } else {
                AdmissibleRange::new(differences.iter().map(|at| (at.load, at.exceeded())))
            },
            stretches: Stretch::all(&differences, &accepted),
            basis: Basis::new(surface, realisations.len()),
            over_independent: over_independent(&differences),
            area: surface.set.nominal_area(),
            is_blocked: surface.is_blocked(),
            reference: ReferenceVerdicts::new(realisations, &accepted),
            differences,
        }
    }
}

/// Where one model was run, its admissible range.
fn of_one_model(comparison: &Comparison) -> AdmissibleRange {
    let points = comparison.curves.iter().zip(comparison.exceeded());
    let loads = points.map(|(point, exceeded)| (point.response.pressure.total(), exceeded));
    AdmissibleRange::new(loads.filter(|(load, _)| *load > 0.0))
}

impl Verdicts {
    /// A verdict as tables name it; `blocked` on a surface that may not carry one.
    pub fn name(&self, verdict: Verdict) -> &'static str {
        if self.is_blocked { "blocked" } else { verdict.name() }
    }

    /// Whether one surface was compared, not several realisations.
    pub fn has_one_surface(&self) -> bool {
        !matches!(self.basis, Basis::Realisations(_))
    }

    /// The least area (m^2) of surface at which a stretch that cannot be told could be; `None` where that cannot be said.
    pub fn area_needed(&self, stretch: &Stretch) -> Option<f64> {
        let now = match self.basis {
            Basis::Realisations(count) => self.area * count as f64,
            _ => self.area,
        };
        stretch.area_needed.or_else(|| stretch.growth.map(|growth| growth * now))
    }
}

/// The median ratio of the standard error of the separation's difference to that of independent asperities.
fn over_independent(differences: &[Difference]) -> Option<f64> {
    let ratio = |at: &Difference| {
        let estimate = at.estimates[0].filter(|_| at.exceeded().is_none())?;
        Some(estimate.error? / estimate.independent_error?)
    };
    let mut ratios: Vec<f64> =
        differences.iter().filter_map(ratio).filter(|ratio| ratio.is_finite()).collect();
    ratios.sort_by(f64::total_cmp);
    ratios.get(ratios.len() / 2).copied()
}
