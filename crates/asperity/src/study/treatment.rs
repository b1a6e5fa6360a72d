//! Treatments of a measured map that a colleague would question.

use crate::MeanRadius;
use crate::topography::summits::Neighbours;
use crate::topography::{Filter, Level};

use super::statistical::StatisticalModel;
use crate::surface::{MapFacts, Preparation};

/// A choice made in the analysis of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Choice {
    /// The nesting index of the S filter.
    ShortWaves,
    /// What a summit is.
    Summits,
    /// The mean radius of the statistical model.
    MeanRadius,
    /// The form removed.
    Level,
    /// Whether spikes, and points that could be some, are removed.
    Spikes,
    /// The part of the map.
    Part,
}

impl Choice {
    /// All choices.
    pub const ALL: [Self; 6] =
        [Self::ShortWaves, Self::Summits, Self::MeanRadius, Self::Level, Self::Spikes, Self::Part];

    /// Whether a verdict depends on the choice already where another treatment leaves it open. Points that may be wrong decide nothing;
    /// other treatments move a difference by parts of its interval on any surface, and halves of a map are other samples.
    pub const fn leaves_open(self) -> bool {
        matches!(self, Self::Spikes)
    }

    /// The name in summaries.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ShortWaves => "short-wavelength-cut-off",
            Self::Summits => "summits",
            Self::MeanRadius => "mean-radius",
            Self::Level => "level",
            Self::Spikes => "spikes",
            Self::Part => "part",
        }
    }
}

/// One other way to treat a map, or to take the mean radius of its asperities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Treatment {
    /// An S filter of this nesting index, m; or none.
    ShortWaves(Option<f64>),
    /// Other summits.
    Summits(Neighbours),
    /// The other mean radius.
    MeanRadius(MeanRadius),
    /// Another form removed.
    Level(Level),
    /// Spikes removed.
    SpikesRemoved,
    /// This many single points removed that are as narrow as spikes, but lower.
    SuspectsRemoved(usize),
    /// One half of the map, 0 or 1.
    Half(usize),
}

/// Nesting indices of S filters, in pixels.
const PIXELS: [f64; 4] = [2.0, 4.0, 8.0, 16.0];

impl Treatment {
    /// The treatments of a map that was prepared so, with the facts found, other than its own.
    pub fn all(own: &Preparation, model: &StatisticalModel, map: &MapFacts) -> Vec<Self> {
        let mut all = vec![Self::Summits(match own.neighbours {
            Neighbours::Four => Neighbours::Eight,
            Neighbours::Eight => Neighbours::Four,
        })];
        all.extend(model.joint.is_none().then_some(Self::MeanRadius(model.mean_radius.other())));
        all.extend(own.level.previous().map(Self::Level));
        all.extend(own.level.next().map(Self::Level));
        all.extend(short_waves(own.filter, map).into_iter().map(Self::ShortWaves));
        if let Some(spikes) = &map.spikes {
            all.extend((spikes.left.count() > 0).then_some(Self::SpikesRemoved));
            let suspects = spikes.left.suspects.len();
            all.extend((suspects > 0).then_some(Self::SuspectsRemoved(suspects)));
        }
        all.extend([0, 1].map(Self::Half));
        all
    }

    /// The choice that it makes in another way.
    pub fn choice(&self) -> Choice {
        match self {
            Self::ShortWaves(_) => Choice::ShortWaves,
            Self::Summits(_) => Choice::Summits,
            Self::MeanRadius(_) => Choice::MeanRadius,
            Self::Level(_) => Choice::Level,
            Self::SpikesRemoved | Self::SuspectsRemoved(_) => Choice::Spikes,
            Self::Half(_) => Choice::Part,
        }
    }

    /// The preparation of a map that is otherwise prepared as `own`.
    pub fn preparation(&self, own: Preparation) -> Preparation {
        match *self {
            Self::ShortWaves(s) => {
                let l = own.filter.and_then(|filter| filter.l());
                Preparation { filter: Filter::new(s, l).ok(), ..own }
            }
            Self::Summits(neighbours) => Preparation { neighbours, ..own },
            Self::MeanRadius(_) => own,
            Self::Level(level) => Preparation { level, ..own },
            Self::SpikesRemoved => Preparation { removes_spikes: true, ..own },
            Self::SuspectsRemoved(_) => Preparation { removes_suspects: true, ..own },
            Self::Half(half) => Preparation { half: Some(half), ..own },
        }
    }
}

/// Nesting indices other than that of `own`: none, and 2 to 16 pixels, as far as the L filter and the map allow.
fn short_waves(own: Option<Filter>, map: &MapFacts) -> Vec<Option<f64>> {
    /// Nesting indices closer than this ratio are the same.
    const SAME: f64 = 1.1;
    let s = own.and_then(|filter| filter.s());
    let l = own.and_then(|filter| filter.l());
    let pixel = map.pixel[0].max(map.pixel[1]);
    let is_other = |index: &f64| {
        s.is_none_or(|s| (s / index).max(index / s) > SAME) && l.is_none_or(|l| *index < 0.5 * l)
    };
    let is_allowed = |index: &f64| {
        Filter::new(Some(*index), l).is_ok_and(|filter| filter.check(map.points, map.pixel).is_ok())
    };
    let mut all: Vec<Option<f64>> = s.map(|_| None).into_iter().collect();
    all.extend(PIXELS.map(|pixels| pixels * pixel).into_iter().filter(is_other).filter(is_allowed).map(Some));
    all
}
