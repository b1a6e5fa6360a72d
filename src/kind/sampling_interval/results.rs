//! Results at all sampling intervals and under all S filters: everything that the report contains.

use asperity::compare::{Accepted, ComparedQuantity, Contributions, Estimate, LeftOut, State};
use asperity::study::CaseResults;
use asperity::surface::Surface;
use asperity::{Statistics, named_enum};
use asperity_contact_framework::metadata::{ContactMetadata, Metadata};

use super::run::{Point, Trend};

/// The quantities whose differences between the models are shown.
pub const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Separation, ComparedQuantity::Area];

/// The same surfaces at several sampling intervals and under several S filters.
#[derive(Debug)]
pub struct IntervalResults {
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    /// Warnings about inputs that are hardly meant.
    pub implausible: Vec<String>,
    /// The law, as tables name it.
    pub law: String,
    /// Nominal pressures, Pa, ascending.
    pub loads: Vec<f64>,
    /// Surface by surface, in file order.
    pub surfaces: Vec<SurfaceResults>,
}

#[derive(Debug)]
pub struct SurfaceResults {
    /// As it is: at one pixel, with its own filter only.
    pub surface: Surface,
    /// At its sampling intervals, and under its S filters, where there are any.
    pub series: Vec<Series>,
}

named_enum! {
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Variation {
        /// Every so many points of the map.
        Interval = "interval",
        /// An S filter on the map.
        Filter = "s-filter",
    }
}

impl Variation {
    /// The length that is varied, for sentences and figures.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Interval => "sampling interval",
            Self::Filter => "S nesting index",
        }
    }
}

/// One surface varied in one way.
#[derive(Debug)]
pub struct Series {
    pub surface: String,
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
    pub results: Result<ScaleResults, String>,
}

/// Asperities at one scale, and both models on them at every load.
#[derive(Debug)]
pub struct ScaleResults {
    pub count: usize,
    pub asperities: Asperities,
    /// What separations are measured in, m.
    pub sigma: f64,
    pub case: CaseResults,
    /// All with each block of the map left out; `None` of a map that is too small for blocks.
    pub blocks: Option<BlocksLeftOut>,
}

/// What remains of a surface without each of its blocks.
#[derive(Debug)]
pub struct BlocksLeftOut {
    /// The asperities; `None` where none is left.
    pub asperities: Vec<Option<Asperities>>,
    pub models: LeftOut,
}

impl ScaleResults {
    /// The difference between the models in a quantity at the load of index `load`, admissible.
    pub fn difference(&self, load: usize, quantity: ComparedQuantity) -> Option<Estimate> {
        let difference = self.case.differences.get(load).filter(|at| at.exceeded().is_none())?;
        difference.estimates[quantity as usize]
    }

    /// The same divided among its causes; `None` where too few contacts carry the load.
    pub fn parts(&self, load: usize, quantity: ComparedQuantity) -> Option<&Contributions> {
        self.difference(load, quantity)?;
        self.case.attribution.get(load)?.contributions(quantity)
    }

    /// A quantity, at the load of index `load` where it depends on one, or its logarithm; `None` not admissible.
    fn value(&self, quantity: TrendQuantity, load: usize) -> Option<f64> {
        let difference = |compared| self.difference(load, compared);
        let pair = || difference(ComparedQuantity::Area).and_then(|_| self.case.comparison.pairs.get(load));
        match quantity {
            TrendQuantity::SeparationGap => Some(difference(ComparedQuantity::Separation)?.contrast),
            TrendQuantity::AreaGap => Some(difference(ComparedQuantity::Area)?.contrast),
            TrendQuantity::DeterministicArea => Some(pair()?.deterministic.area_ratio.total().ln()),
            TrendQuantity::StatisticalArea => Some(pair()?.statistical.area_ratio.total().ln()),
            _ => quantity.of_asperities(&self.asperities),
        }
    }

    /// The same without each block; `None` where it is not known without each of them, and at a load of which no interval is
    /// claimed.
    fn without_blocks(&self, quantity: TrendQuantity, load: usize) -> Option<Vec<f64>> {
        let BlocksLeftOut { asperities, models } = self.blocks.as_ref()?;
        if !quantity.is_at_load() {
            return asperities.iter().map(|rest| quantity.of_asperities(rest.as_ref()?)).collect();
        }
        self.difference(load, ComparedQuantity::Area)?.error?;
        models.states.iter().map(|states| quantity.of_models(states[load]?)).collect()
    }
}

impl Series {
    /// The same with the trends of all quantities, at each of the `loads` (Pa).
    pub fn with_trends(mut self, loads: &[f64], accepted: &Accepted) -> Self {
        for quantity in TrendQuantity::ALL {
            let loads = if quantity.is_at_load() { loads } else { &loads[..1] };
            let trend = |(index, &load)| {
                let (points, shares) = self.points(quantity, index);
                let load = quantity.is_at_load().then_some(load);
                Trend::new(quantity, load, &points, shares, quantity.tolerance(accepted))
            };
            let trends: Vec<Trend> = loads.iter().enumerate().filter_map(trend).collect();
            self.trends.extend(trends);
        }
        self
    }

    /// A quantity from the finest scale to the coarsest at which it is known without a gap, with the shares of the blocks at the
    /// finest.
    fn points(&self, quantity: TrendQuantity, load: usize) -> (Vec<Point>, &[f64]) {
        let point = |scale: &Scale| {
            let results = scale.results.as_ref().ok()?;
            let (value, without) = (results.value(quantity, load)?, results.without_blocks(quantity, load));
            Some(Point { length: scale.length, value, without })
        };
        let blocks = self.results().next().and_then(|(_, finest)| finest.blocks.as_ref());
        (self.scales.iter().map_while(point).collect(), blocks.map_or(&[], |blocks| &blocks.models.shares))
    }

    /// The scales at which there are asperities, from the finest.
    pub fn results(&self) -> impl Iterator<Item = (&Scale, &ScaleResults)> {
        self.scales.iter().filter_map(|scale| Some((scale, scale.results.as_ref().ok()?)))
    }
}

/// The gap between the models at a scale admissible.
pub struct Gap<'a> {
    /// Sampling interval or nesting index, m.
    pub length: f64,
    pub difference: Estimate,
    /// Its parts; `None` where too few contacts carry the load.
    pub parts: Option<&'a Contributions>,
}

/// The gaps in a quantity at the load of index `load`, from the finest scale.
pub fn gaps(series: &Series, load: usize, quantity: ComparedQuantity) -> Vec<Gap<'_>> {
    let gaps = series.results().filter_map(|(scale, results)| {
        let (difference, parts) = (results.difference(load, quantity)?, results.parts(load, quantity));
        Some(Gap { length: scale.length, difference, parts })
    });
    gaps.collect()
}

/// The load of a page, as an index: the highest of those at which most scales are admissible, and of these most have
/// intervals. `None` where no scale is valid at any load.
pub fn main_load(surface: &SurfaceResults, loads: &[f64]) -> Option<usize> {
    let rank = |load: usize| {
        let gaps = surface.series.iter().flat_map(|series| gaps(series, load, ComparedQuantity::Separation));
        let is_bounded: Vec<bool> = gaps.map(|gap| gap.difference.error.is_some()).collect();
        (is_bounded.len(), is_bounded.iter().filter(|bounded| **bounded).count())
    };
    (0..loads.len()).max_by_key(|&load| rank(load)).filter(|&load| rank(load).0 > 0)
}

/// Whether gaps are of one sign: `kept`; `changes` if two intervals lie on either side of zero; `cannot-tell` if one holds zero.
/// `None` of a single gap.
pub fn sign(gaps: &[Gap]) -> Option<&'static str> {
    let is_decided = |gap: &&Gap| gap.difference.contrast.abs() > gap.difference.half_width().unwrap_or(0.0);
    let signs: Vec<f64> =
        gaps.iter().filter(is_decided).map(|gap| gap.difference.contrast.signum()).collect();
    match signs.len() {
        _ if gaps.len() < 2 => None,
        _ if signs.contains(&-1.0) && signs.contains(&1.0) => Some("changes"),
        decided if decided < gaps.len() => Some("cannot-tell"),
        _ => Some("kept"),
    }
}

named_enum! {
    /// A quantity of the asperities, or of both models at a load.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum TrendQuantity {
        /// Asperities per nominal area.
        Density = "density",
        /// Arithmetic mean of the radii.
        MeanRadius = "mean-radius",
        /// 1/(mean curvature).
        RadiusOfMeanCurvature = "radius-of-mean-curvature",
        /// Standard deviation of the heights of the asperities.
        Sigma = "sigma",
        /// Nayak's bandwidth parameter of the map.
        Alpha = "nayak-alpha",
        /// Standard deviation of the radii over their mean.
        RadiusSpread = "radius-cv",
        /// Correlation of heights and radii.
        Correlation = "height-radius-correlation",
        /// Greenwood and Williamson's.
        PlasticityIndex = "plasticity-index",
        /// Real area over nominal area by the sum.
        DeterministicArea = "deterministic-area",
        /// Real area over nominal area by the integral.
        StatisticalArea = "statistical-area",
        /// d/sigma by the integral less that by the sum.
        SeparationGap = "separation-gap",
        /// Logarithm of the area by the integral over that by the sum.
        AreaGap = "area-gap",
    }
}

/// The asperities of a map, or of a part of it.
#[derive(Debug, Clone)]
pub struct Asperities {
    /// 1/m^2.
    pub density: f64,
    /// Of heights and radii.
    pub statistics: Statistics,
    /// Nayak's bandwidth parameter of the map, by differences at its interval; `None` of a flat one, and of a part.
    pub alpha: Option<f64>,
    /// Greenwood and Williamson's; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
}

impl TrendQuantity {
    /// Whether it is of both models at a load.
    pub const fn is_at_load(self) -> bool {
        matches!(self, Self::DeterministicArea | Self::StatisticalArea | Self::SeparationGap | Self::AreaGap)
    }

    /// Whether it is positive, so that it changes by a factor and may follow a power law.
    pub const fn is_positive(self) -> bool {
        !matches!(self, Self::Correlation | Self::SeparationGap | Self::AreaGap)
    }

    /// The largest change that does not matter: of a gap what the spec accepts, of a correlation 0.05, of anything else 5 %.
    pub fn tolerance(self, accepted: &Accepted) -> f64 {
        const SHARE: f64 = 0.05;
        match self {
            Self::SeparationGap => accepted.separation,
            Self::AreaGap => accepted.area.ln_1p(),
            Self::Correlation => SHARE,
            _ => SHARE.ln_1p(),
        }
    }

    /// A change relative to the quantity, of an area gap to the area by the sum; `None` of what is not changed by a factor.
    pub fn relative(self, change: f64) -> Option<f64> {
        (!matches!(self, Self::Correlation | Self::SeparationGap)).then(|| change.exp_m1())
    }

    /// Its value, or the logarithm of what is positive; `None` at a load, and of what is not defined.
    pub fn of_asperities(self, asperities: &Asperities) -> Option<f64> {
        let statistics = &asperities.statistics;
        let value = match self {
            Self::Density => Some(asperities.density),
            Self::MeanRadius => Some(statistics.mean_radius),
            Self::RadiusOfMeanCurvature => Some(statistics.radius_of_mean_curvature),
            Self::Sigma => Some(statistics.sigma),
            Self::Alpha => asperities.alpha,
            Self::RadiusSpread => Some(statistics.radius_cv),
            Self::Correlation => return statistics.height_radius_correlation,
            Self::PlasticityIndex => asperities.plasticity_index,
            Self::DeterministicArea | Self::StatisticalArea | Self::SeparationGap | Self::AreaGap => None,
        };
        value.filter(|value| *value > 0.0).map(f64::ln)
    }

    /// The same of both models at a load; `None` of a quantity of the asperities.
    pub fn of_models(self, [integral, sum]: [State; 2]) -> Option<f64> {
        let [separation, area] = [ComparedQuantity::Separation, ComparedQuantity::Area].map(|k| k as usize);
        match self {
            Self::DeterministicArea => Some(sum[area]),
            Self::StatisticalArea => Some(integral[area]),
            Self::SeparationGap => Some(integral[separation] - sum[separation]),
            Self::AreaGap => Some(integral[area] - sum[area]),
            _ => None,
        }
    }
}
