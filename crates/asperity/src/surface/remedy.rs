//! What a preparation can do about a failed fitness check.

use super::{MapFacts, Preparation};
use crate::numeric::two_digits;
use crate::topography::fitness::{Check, Finding, Lines, Measure};
use crate::topography::{Filter, FilterError, Level};

/// A change of the preparation of a map that a failed check calls for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Remedy {
    /// Spikes become missing points.
    RemoveSpikes,
    /// Lines are set to the same mean height.
    AlignLines(Lines),
    /// A form of a higher degree is removed.
    Level(Level),
    /// An S filter of this nesting index, m.
    ShortWaves(f64),
    /// An L filter of this nesting index, m.
    LongWaves(f64),
}

/// Nesting indices (pixels) of the first S filter against noise, and against height steps and a pixel that cuts the roughness off.
const NOISE: f64 = 4.0;
const STEPS: f64 = 8.0;

/// By so much a filter is changed that was not enough.
const LONGER: f64 = 2.0;
const SHORTER: f64 = 2.0 / 3.0;

/// The L filter that leaves enough patches on most maps, of the shorter side.
const OF_SIDE: f64 = 1.0 / 6.0;

/// L filters to try, of the shorter side: the first that is enough changes the map least.
const SIDES: [f64; 5] = [1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 6.0, 1.0 / 8.0];

/// S filters to try, of the first.
const LONGER_BY: [f64; 3] = [1.0, 2.0, 4.0];

impl Remedy {
    /// The next remedy of a failed check on a map as it was prepared; `None` where no preparation helps, or none further.
    pub fn new(finding: &Finding, map: &MapFacts) -> Option<Self> {
        let filter = map.filter;
        let pixel = map.pixel[0].max(map.pixel[1]);
        let short = |least: f64| {
            let now = filter.and_then(|filter| filter.s()).unwrap_or_default();
            Self::ShortWaves(two_digits((LONGER * now).max(least * pixel)))
        };
        let long = || {
            let side = [0, 1].map(|axis| map.points[axis] as f64 * map.pixel[axis]);
            let now = filter.and_then(|filter| filter.l()).unwrap_or(f64::INFINITY);
            Self::LongWaves(two_digits((SHORTER * now).min(OF_SIDE * side[0].min(side[1]))))
        };
        match finding.measure {
            Measure::Spikes => {
                let removed = map.spikes.as_ref().is_some_and(|spikes| spikes.removed > 0);
                (!removed).then_some(Self::RemoveSpikes)
            }
            Measure::LineOffsets => {
                let lines = map.offsets.unwrap_or_default().lines();
                map.aligned.is_none().then_some(Self::AlignLines(lines))
            }
            Measure::FormShare => Some(map.level.next().map_or_else(long, Self::Level)),
            Measure::StepOverDrop | Measure::CurvatureGrowth => Some(short(STEPS)),
            Measure::NoiseGrowth | Measure::GrowthRise => Some(short(NOISE)),
            Measure::LengthOverSide => Some(long()),
            Measure::SharedHeight
            | Measure::SlopeCorrelation
            | Measure::AspectRatio
            | Measure::DensityOverTheory
            | Measure::CurvatureOverTheory
            | Measure::RadiusOverTip
            | Measure::Untraced
            | Measure::Slope
            | Measure::LeastSlope
            | Measure::NominalArea => None,
        }
    }

    /// The remedies of its kind to try on a map as it was prepared, the one that changes least first.
    pub fn gentle_first(self, map: &MapFacts) -> Vec<Self> {
        let side = [0, 1].map(|axis| map.points[axis] as f64 * map.pixel[axis]);
        let now = map.filter.and_then(|filter| filter.l()).unwrap_or(f64::INFINITY);
        match self {
            Self::ShortWaves(first) => {
                LONGER_BY.map(|factor| Self::ShortWaves(two_digits(factor * first))).to_vec()
            }
            Self::LongWaves(_) => {
                let all = SIDES.map(|part| two_digits(part * side[0].min(side[1])));
                all.into_iter().filter(|l| *l < now).map(Self::LongWaves).collect()
            }
            _ => vec![self],
        }
    }

    /// Whether it takes out waves, which only a remedied fault is worth.
    pub fn is_filter(self) -> bool {
        matches!(self, Self::ShortWaves(_) | Self::LongWaves(_))
    }

    /// The preparation with this remedy.
    ///
    /// # Errors
    /// An S filter that is not below the L filter.
    pub fn applied(self, preparation: Preparation) -> Result<Preparation, FilterError> {
        let [s, l] = match preparation.filter {
            Some(filter) => [filter.s(), filter.l()],
            None => [None; 2],
        };
        Ok(match self {
            Self::RemoveSpikes => Preparation { removes_spikes: true, ..preparation },
            Self::AlignLines(lines) => Preparation { aligned: Some(lines), ..preparation },
            Self::Level(level) => Preparation { level, ..preparation },
            Self::ShortWaves(s) => Preparation { filter: Some(Filter::new(Some(s), l)?), ..preparation },
            Self::LongWaves(l) => Preparation { filter: Some(Filter::new(s, Some(l))?), ..preparation },
        })
    }
}

impl MapFacts {
    /// The checks that failed so that no verdict may rest on the map, in the order in which their faults are remedied: units first,
    /// which change everything; heights that are wrong; spikes, which raise slopes and noise; lines and form, unless aligning the lines would take out
    /// form; then filters. Steep slopes come last: spikes and noise may be their cause.
    pub fn blocking_in_order(&self) -> Vec<&Finding> {
        let can_be_aligned = self.offsets.unwrap_or_default().can_be_aligned();
        let rank = |finding: &&Finding| match finding.check {
            _ if finding.is_of_units() => 0,
            Check::EqualHeights => 1,
            Check::Spikes => 1,
            Check::Lines if can_be_aligned => 2,
            Check::Form => 3,
            Check::Lines => 4,
            Check::Steps => 5,
            Check::FinePixel => 6,
            Check::Tip | Check::CoarsePixel => 7,
            Check::LongWaves => 8,
            Check::Lay => 9,
            Check::Slope => 10,
        };
        let mut blocking: Vec<&Finding> = self.blocking().collect();
        blocking.sort_by_key(rank);
        blocking
    }
}

/// The L filter (m) that leaves enough patches on most maps with these sides, m: a sixth of the shorter one.
pub fn usual_long_filter(sides: [f64; 2]) -> f64 {
    two_digits(OF_SIDE * sides[0].min(sides[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::summits::Neighbours;

    #[test]
    fn remedies_change_their_own_key_only() {
        let none = Preparation::none(Neighbours::Four);
        let filtered = Remedy::ShortWaves(2e-6).applied(none).unwrap();
        let both = Remedy::LongWaves(8e-5).applied(filtered).unwrap();
        let filter = both.filter.unwrap();
        assert_eq!((filter.s(), filter.l()), (Some(2e-6), Some(8e-5)));
        assert_eq!(Preparation { filter: None, ..both }, none);
        assert!(Remedy::ShortWaves(1e-4).applied(both).is_err());
        let aligned = Remedy::AlignLines(Lines::Y).applied(both).unwrap();
        assert_eq!(aligned, Preparation { aligned: Some(Lines::Y), ..both });
    }
}
