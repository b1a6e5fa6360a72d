//! Results at all sampling intervals and under all S filters: everything that the report contains.

use asperity::compare::{Accepted, Attribution, ComparedQuantity, Contributions, Difference, Pair, State};
use asperity::{Exceeded, Statistics};
use asperity_framework::contact::ContactMetadata;
use asperity_framework::metadata::Metadata;

use super::quantity::Quantity;
use super::trend::Trend;
use crate::surface::Surface;

/// The same surfaces at several sampling intervals and under several S filters.
#[derive(Debug)]
pub struct IntervalResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The bodies.
    pub contact: ContactMetadata,
    /// Warnings about inputs that are hardly meant.
    pub implausible: Vec<String>,
    /// The law, as tables name it.
    pub law: String,
    /// Surface by surface, in file order.
    pub surfaces: Vec<SurfaceResults>,
}

/// One surface.
#[derive(Debug)]
pub struct SurfaceResults {
    /// As it is: at one pixel, with its own filter only.
    pub surface: Surface,
    /// Nominal pressures, Pa, ascending.
    pub loads: Vec<f64>,
    /// The largest differences that do not matter.
    pub accepted: Accepted,
    /// At its sampling intervals, and under its S filters, where there are any.
    pub series: Vec<Series>,
}

/// How a surface is varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variation {
    /// Every so many points of the map.
    Interval,
    /// An S filter on the map.
    Filter,
}

impl Variation {
    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Interval => "interval",
            Self::Filter => "s-filter",
        }
    }
}

/// One surface varied in one way.
#[derive(Debug)]
pub struct Series {
    /// What is varied.
    pub variation: Variation,
    /// From the finest.
    pub scales: Vec<Scale>,
    /// Each quantity from the coarser scales to the finest; those at a load load by load.
    pub trends: Vec<Trend>,
}

/// One sampling interval, or one nesting index.
#[derive(Debug)]
pub struct Scale {
    /// In pixels; of a filter in multiples of the smallest asked for.
    pub multiple: f64,
    /// Sampling interval (the longer of x and y) or nesting index, m.
    pub length: f64,
    /// Its asperities and both models on them, or why there are none.
    pub found: Result<Found, String>,
}

/// Asperities at one scale, and both models on them.
#[derive(Debug)]
pub struct Found {
    /// Number of asperities.
    pub asperities: usize,
    /// 1/m^2.
    pub density: f64,
    /// Of the asperities.
    pub statistics: Statistics,
    /// What separations are measured in, m.
    pub sigma: f64,
    /// Nayak's bandwidth parameter of the map, by differences at its interval; `None` for a flat one.
    pub alpha: Option<f64>,
    /// Greenwood and Williamson's; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// Both models at equal load, load by load.
    pub pairs: Vec<Pair>,
    /// Their differences, load by load.
    pub differences: Vec<Difference>,
    /// The differences divided among their causes.
    pub attributions: Vec<Attribution>,
    /// All with each block of the map left out; `None` of a map that is too small for blocks.
    pub blocks: Option<BlocksLeftOut>,
}

/// What remains of a surface without each of its blocks.
#[derive(Debug)]
pub struct BlocksLeftOut {
    /// The shares of the blocks in the nominal area.
    pub shares: Vec<f64>,
    /// The quantities of the asperities without each block, in the order of [`Quantity::ALL`], as contrasts are formed; `None` where
    /// nothing is left.
    pub quantities: Vec<[Option<f64>; Quantity::COUNT]>,
    /// Both models without each block, load by load.
    pub states: Vec<Vec<Option<[State; 2]>>>,
}

impl Found {
    /// The limits of the valid range that are exceeded at the load of index `load`.
    pub fn exceeded(&self, load: usize) -> Exceeded {
        self.differences[load].exceeded()
    }

    /// The difference in a quantity at the load of index `load`, divided among its causes; `None` where too few contacts carry it.
    pub fn parts(&self, load: usize, quantity: ComparedQuantity) -> Option<&Contributions> {
        self.attributions.get(load)?.of(quantity)
    }

    /// A quantity, at the load of index `load` where it depends on one, on the scale on which changes are formed: the logarithm of
    /// what is positive. `None` beyond the valid range.
    pub fn value(&self, quantity: Quantity, load: usize) -> Option<f64> {
        if !quantity.is_at_load() {
            return quantity.of_asperities(self.density, &self.statistics, self.alpha, self.plasticity_index);
        }
        let at = self.differences.get(load).filter(|at| at.exceeded().is_none())?;
        let pair = self.pairs.get(load)?;
        let compared = |compared: ComparedQuantity| Some(at.estimates[compared as usize]?.contrast);
        match quantity {
            Quantity::AreaOfSum => Some(pair.deterministic.area_ratio.total().ln()),
            Quantity::AreaOfIntegral => Some(pair.statistical.area_ratio.total().ln()),
            Quantity::SeparationGap => compared(ComparedQuantity::Separation),
            Quantity::AreaGap => compared(ComparedQuantity::Area),
            _ => None,
        }
    }

    /// The same without each block; `None` where it is not known without each of them, and at a load of which no interval is
    /// claimed.
    pub fn without(&self, quantity: Quantity, load: usize) -> Option<Vec<f64>> {
        let blocks = self.blocks.as_ref()?;
        if !quantity.is_at_load() {
            return blocks.quantities.iter().map(|all| all[quantity as usize]).collect();
        }
        self.differences[load].estimates[ComparedQuantity::Area as usize]?.error?;
        let of = |states: &Vec<Option<[State; 2]>>| {
            let [integral, sum] = states[load]?;
            let [separation, area] =
                [ComparedQuantity::Separation, ComparedQuantity::Area].map(|k| k as usize);
            match quantity {
                Quantity::AreaOfSum => Some(sum[area]),
                Quantity::AreaOfIntegral => Some(integral[area]),
                Quantity::SeparationGap => Some(integral[separation] - sum[separation]),
                Quantity::AreaGap => Some(integral[area] - sum[area]),
                _ => None,
            }
        };
        blocks.states.iter().map(of).collect()
    }
}

impl Series {
    /// The trend of a quantity, at the load of index `load` where it depends on one.
    pub fn trend(&self, quantity: Quantity, load: usize) -> Option<&Trend> {
        self.trends.iter().find(|trend| trend.quantity == quantity && trend.load.is_none_or(|at| at == load))
    }

    /// The scales at which there are asperities, from the finest.
    pub fn found(&self) -> impl Iterator<Item = (&Scale, &Found)> {
        self.scales.iter().filter_map(|scale| Some((scale, scale.found.as_ref().ok()?)))
    }
}
