//! Verdicts: whether the difference between both models is within what the user accepts, by quantity and stretch of load.

use super::difference::{ComparedQuantity, Difference, Estimate, Support};
use crate::model::Limit;
use crate::named_enum;
use crate::numeric::median;

/// The largest difference that is accepted, by quantity: in sigma, else relative to the deterministic result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accepted {
    /// Of d/sigma.
    pub separation: f64,
    /// Of the real area.
    pub area: f64,
    /// Of the stiffness.
    pub stiffness: f64,
    /// Of the electrical and of the thermal conductance.
    pub conductance: f64,
    /// Of the coefficient of friction.
    pub friction: f64,
}

impl Accepted {
    /// 0.1 sigma, 10 % of area and friction, 20 % of stiffness and conductances.
    pub const DEFAULT: Self =
        Self { separation: 0.1, area: 0.1, stiffness: 0.2, conductance: 0.2, friction: 0.1 };

    /// That of one quantity.
    pub fn limit(&self, quantity: ComparedQuantity) -> f64 {
        match quantity {
            ComparedQuantity::Separation => self.separation,
            ComparedQuantity::Area => self.area,
            ComparedQuantity::Stiffness => self.stiffness,
            ComparedQuantity::ElectricalConductance | ComparedQuantity::ThermalConductance => {
                self.conductance
            }
            ComparedQuantity::Friction => self.friction,
        }
    }

    /// The accepted band of the contrast of a quantity; a relative difference of -100 % or less is none.
    pub fn band(&self, quantity: ComparedQuantity) -> [f64; 2] {
        let accepted = self.limit(quantity);
        let low = if quantity != ComparedQuantity::Separation && accepted >= 1.0 {
            f64::NEG_INFINITY
        } else {
            quantity.contrast_of(-accepted)
        };
        [low, quantity.contrast_of(accepted)]
    }
}

named_enum! {
    /// The answer for one quantity at one load, or over a stretch of loads.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Verdict {
        /// The 95 % interval of the difference is inside the accepted band.
        Within = "within",
        /// It is outside.
        Beyond = "beyond",
        /// A model-based interval is inside the accepted band, but not one of twice its width.
        VeryLikelyWithin = "very-likely-within",
        /// A model-based interval is outside, but not one of twice its width; or, without an interval, the difference is ten times what is
        /// accepted and of one sign on each half of the map.
        VeryLikelyBeyond = "very-likely-beyond",
        /// The interval is across the edge of the band, or there is none.
        CannotTell = "cannot-tell",
    }
}

impl Verdict {
    /// Of an estimate against the band `[low, high]` of contrasts.
    pub fn from_estimate(estimate: &Estimate, band: [f64; 2]) -> Self {
        let Some(half) = estimate.half_width() else {
            return match estimate.support {
                Support::Halves(least) if is_far_beyond(estimate.contrast, least, band) => {
                    Self::VeryLikelyBeyond
                }
                _ => Self::CannotTell,
            };
        };
        let is_generated = estimate.support == Support::Generated;
        let decisive = if is_generated { GENERATED_WIDTH * half } else { half };
        match (Side::of(estimate.contrast, decisive, band), Side::of(estimate.contrast, half, band)) {
            (Some(Side::Inside), _) => Self::Within,
            (Some(Side::Outside), _) => Self::Beyond,
            (None, Some(Side::Inside)) => Self::VeryLikelyWithin,
            (None, Some(Side::Outside)) => Self::VeryLikelyBeyond,
            (None, None) => Self::CannotTell,
        }
    }

    /// Whether it says on which side of what is accepted the difference lies, surely or very likely.
    pub fn is_told(self) -> bool {
        self != Self::CannotTell
    }

    /// Whether the difference is beyond what is accepted, surely or very likely.
    pub fn is_beyond(self) -> bool {
        matches!(self, Self::Beyond | Self::VeryLikelyBeyond)
    }

    /// Whether it is within, surely or very likely.
    pub fn is_within(self) -> bool {
        matches!(self, Self::Within | Self::VeryLikelyWithin)
    }
}

/// By how much wider than itself a model-based interval must be on one side of the edge for a verdict.
const GENERATED_WIDTH: f64 = 2.0;

/// How many times what is accepted a difference without an interval must be on all halves of the map, on the scale of contrasts.
const FAR_BEYOND: f64 = 10.0;

/// Whether a contrast, and the least magnitude of those of its sign on the halves of the map, are far beyond the band.
fn is_far_beyond(contrast: f64, least: f64, [low, high]: [f64; 2]) -> bool {
    let edge = if contrast > 0.0 { high } else { -low };
    contrast.abs().min(least) >= FAR_BEYOND * edge
}

/// Where an interval lies.
#[derive(Clone, Copy)]
enum Side {
    Inside,
    Outside,
}

impl Side {
    /// Of the contrasts within `half` of one; `None` across an edge of the band.
    fn of(contrast: f64, half: f64, [low, high]: [f64; 2]) -> Option<Self> {
        let (from, to) = (contrast - half, contrast + half);
        if low <= from && to <= high {
            Some(Self::Inside)
        } else if to < low || high < from {
            Some(Self::Outside)
        } else {
            None
        }
    }
}

/// Neighbouring admissible loads with one verdict on one quantity; beyond what is accepted, on one side.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// The quantity.
    pub quantity: ComparedQuantity,
    /// The verdict.
    pub verdict: Verdict,
    /// First and last load, Pa.
    pub loads: [f64; 2],
    /// What is accepted, as in [`Accepted`].
    pub accepted: f64,
    /// The load (Pa) of the largest difference, and its contrast; `None` where no load is admissible.
    pub largest: Option<(f64, Estimate)>,
    /// The smallest and the largest contrast.
    pub range: Option<[f64; 2]>,
    /// The outermost ends of the intervals, where all loads have one.
    pub bounds: Option<[f64; 2]>,
    /// By how much the area of the surface, or the number of its realisations, must grow for the intervals at half of the
    /// loads to leave the edges of the band, where it cannot be told; `None` where no practical growth suffices, or an
    /// area is needed for an interval first.
    pub growth: Option<f64>,
    /// The area (m^2) needed for an interval at half of the loads, where these have none.
    pub area_needed: Option<f64>,
}

impl Stretch {
    /// The verdicts on every quantity over the valid ones of the `differences` (any order); one that cannot be told over
    /// all loads where none is valid. A quantity that cannot be compared at a load breaks its stretch.
    pub fn all(differences: &[Difference], accepted: &Accepted) -> Vec<Self> {
        let mut sorted: Vec<&Difference> = differences.iter().collect();
        sorted.sort_by(|a, b| a.load.total_cmp(&b.load));
        let judge = |quantity| Self::of(quantity, &sorted, accepted);
        ComparedQuantity::ALL.into_iter().flat_map(judge).collect()
    }

    fn of(quantity: ComparedQuantity, sorted: &[&Difference], accepted: &Accepted) -> Vec<Self> {
        let band = accepted.band(quantity);
        let verdict = |at: &&Difference| {
            let estimate = at.estimates[quantity as usize].as_ref().filter(|_| at.exceeded().is_none());
            estimate.map(|estimate| Verdict::from_estimate(estimate, band))
        };
        let is_compared = sorted.iter().any(|at| at.estimates[quantity as usize].is_some());
        // A difference beyond on one side is another answer than one beyond on the other.
        let side = |at: &&Difference| {
            let contrast = at.estimates[quantity as usize].map_or(0.0, |estimate| estimate.contrast);
            verdict(at).is_some_and(Verdict::is_beyond) && contrast < 0.0
        };
        let stretches = sorted.chunk_by(|a, b| (verdict(a), side(a)) == (verdict(b), side(b)));
        let found: Vec<Self> = stretches
            .filter_map(|stretch| Some(Self::over(quantity, verdict(&stretch[0])?, stretch, accepted)))
            .collect();
        match sorted {
            [first, .., last] | [first @ last] if found.is_empty() && is_compared => {
                // Area helps where contacts are too few, not where asperities interact or strain.
                let is_few = |at: &&&Difference| {
                    at.exceeded()
                        .limits()
                        .all(|limit| matches!(limit, Limit::FewContacts | Limit::DominantContact))
                };
                let mut needed: Vec<f64> =
                    sorted.iter().filter(is_few).filter_map(|at| at.area_needed).collect();
                let is_half = 2 * needed.len() >= sorted.len();
                vec![Self {
                    quantity,
                    verdict: Verdict::CannotTell,
                    loads: [first.load, last.load],
                    accepted: accepted.limit(quantity),
                    largest: None,
                    range: None,
                    bounds: None,
                    growth: None,
                    area_needed: median(&mut needed).filter(|area| is_half && area.is_finite()),
                }]
            }
            _ => found,
        }
    }

    /// Of a stretch of admissible loads with one verdict.
    fn over(
        quantity: ComparedQuantity,
        verdict: Verdict,
        stretch: &[&Difference],
        accepted: &Accepted,
    ) -> Self {
        let each = || stretch.iter().filter_map(|at| Some((at.load, at.estimates[quantity as usize]?)));
        let largest = each().max_by(|a, b| a.1.contrast.abs().total_cmp(&b.1.contrast.abs()));
        let hull = |of: &dyn Fn(&Estimate) -> Option<[f64; 2]>| {
            let ends: Option<Vec<[f64; 2]>> = each().map(|(_, estimate)| of(&estimate)).collect();
            ends?.into_iter().reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
        };
        let is_open = verdict == Verdict::CannotTell;
        let band = accepted.band(quantity);
        let growth = |estimate: Estimate| estimate.growth(band).unwrap_or(f64::INFINITY);
        let mut growths: Vec<f64> = each().map(|(_, estimate)| growth(estimate)).collect();
        let lacks_interval = each().any(|(_, estimate)| estimate.interval().is_none());
        let mut needed: Vec<f64> = stretch.iter().map(|at| at.area_needed.unwrap_or(0.0)).collect();
        Self {
            quantity,
            verdict,
            loads: [stretch[0].load, stretch[stretch.len() - 1].load],
            accepted: accepted.limit(quantity),
            largest,
            range: hull(&|estimate| Some([estimate.contrast; 2])),
            bounds: hull(&Estimate::interval),
            growth: median(&mut growths).filter(|growth| is_open && growth.is_finite()),
            area_needed: median(&mut needed)
                .filter(|area| is_open && lacks_interval && *area > 0.0 && area.is_finite()),
        }
    }
}

/// More is no practical advice.
const LARGEST_GROWTH: f64 = 100.0;

impl Estimate {
    /// The factor of area, or of realisations, at which the half-width of the interval, which goes with its inverse root, no longer reaches the
    /// edge of the `band`; `None` without an interval, and where no practical growth suffices.
    pub fn growth(&self, [low, high]: [f64; 2]) -> Option<f64> {
        let distance = (self.contrast - low).abs().min((self.contrast - high).abs());
        let growth = (self.half_width()? / distance).powi(2).max(1.0);
        (growth < LARGEST_GROWTH).then_some(growth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::tests::{at, estimate};

    const ACCEPTED: Accepted = Accepted::DEFAULT;

    fn of(quantity: ComparedQuantity, differences: &[Difference]) -> Vec<(Verdict, [f64; 2])> {
        let all = Stretch::all(differences, &ACCEPTED);
        let of = all.iter().filter(|stretch| stretch.quantity == quantity);
        of.map(|stretch| (stretch.verdict, stretch.loads)).collect()
    }

    /// A model-based interval decides at twice its width.
    #[test]
    fn a_model_based_interval_is_likely_before_it_decides() {
        let band = ACCEPTED.band(ComparedQuantity::Separation);
        let verdict = |contrast, error| {
            let sampled = estimate(contrast, Some(error));
            Verdict::from_estimate(&Estimate { support: Support::Generated, ..sampled }, band)
        };
        assert_eq!(verdict(0.05, 0.01), Verdict::Within);
        assert_eq!(verdict(0.05, 0.02), Verdict::VeryLikelyWithin);
        assert_eq!(verdict(0.05, 0.03), Verdict::CannotTell);
        assert_eq!(verdict(-0.2, 0.03), Verdict::VeryLikelyBeyond);
        assert_eq!(verdict(-0.2, 0.02), Verdict::Beyond);
        assert_eq!(verdict(-0.15, 0.03), Verdict::CannotTell);
    }

    /// Ten times what is accepted, on the map and on each of its halves.
    #[test]
    fn without_an_interval_only_a_difference_far_beyond_on_all_halves_is_told() {
        let verdict = |quantity, contrast, least| {
            let unknown = Estimate { support: Support::Halves(least), ..estimate(contrast, None) };
            Verdict::from_estimate(&unknown, ACCEPTED.band(quantity))
        };
        use ComparedQuantity::{Area, Separation};
        assert_eq!(verdict(Separation, 1.2, 1.01), Verdict::VeryLikelyBeyond);
        assert_eq!(verdict(Separation, 1.2, 0.99), Verdict::CannotTell);
        assert_eq!(verdict(Separation, 0.9, 1.2), Verdict::CannotTell);
        assert_eq!(verdict(Area, 1.1, 1.0), Verdict::VeryLikelyBeyond);
        assert_eq!(verdict(Area, -1.1, 1.0), Verdict::CannotTell, "the lower edge is further away");
        assert_eq!(verdict(Area, -1.1, 1.06), Verdict::VeryLikelyBeyond);
    }

    #[test]
    fn an_interval_is_inside_outside_or_across_the_edge() {
        let band = ACCEPTED.band(ComparedQuantity::Separation);
        let verdict = |contrast, error| Verdict::from_estimate(&estimate(contrast, error), band);
        assert_eq!(verdict(0.05, Some(0.02)), Verdict::Within);
        assert_eq!(verdict(0.05, Some(0.03)), Verdict::CannotTell);
        assert_eq!(verdict(-0.2, Some(0.03)), Verdict::Beyond);
        assert_eq!(verdict(-0.15, Some(0.03)), Verdict::CannotTell);
        // Far inside or outside, but unknown how far.
        assert_eq!(verdict(0.0, None), Verdict::CannotTell);
        assert_eq!(verdict(9.0, None), Verdict::CannotTell);
    }

    /// A tenth of the deterministic area: the band of the logarithms is not symmetric.
    #[test]
    fn relative_differences_are_held_against_the_accepted_share() {
        let [low, high] = ACCEPTED.band(ComparedQuantity::Area);
        assert!((low - 0.9f64.ln()).abs() < 1e-15 && (high - 1.1f64.ln()).abs() < 1e-15);
        let all = Accepted { area: 1.5, ..ACCEPTED };
        assert_eq!(all.band(ComparedQuantity::Area), [f64::NEG_INFINITY, 2.5f64.ln()]);
    }

    #[test]
    fn neighbouring_loads_of_one_verdict_are_one_stretch() {
        let loads = [
            at(3.0, 90.0, 0.3, Some(0.01)),
            at(1.0, 90.0, 0.01, Some(0.01)),
            at(2.0, 90.0, -0.02, Some(0.01)),
            at(4.0, 90.0, 0.11, Some(0.01)),
            // Beyond the admissible range.
            at(0.5, 12.0, 0.01, Some(0.01)),
        ];
        use Verdict::{Beyond, CannotTell, Within};
        let expected = [(Within, [1.0, 2.0]), (Beyond, [3.0, 3.0]), (CannotTell, [4.0, 4.0])];
        assert_eq!(of(ComparedQuantity::Separation, &loads), expected);
        assert_eq!(of(ComparedQuantity::Stiffness, &loads), [], "stiffness cannot be compared");
        let all = Stretch::all(&loads, &ACCEPTED);
        let within = &all[0];
        assert_eq!(within.largest.unwrap().0, 2.0);
        assert_eq!((within.range, within.bounds), (Some([-0.02, 0.01]), Some([-0.04, 0.03])));
        assert_eq!((within.growth, within.area_needed), (None, None));
        // 0.11 with a half-width of 0.02 is 0.01 from the edge.
        assert!((all[2].growth.unwrap() - 4.0).abs() < 1e-9);
    }

    #[test]
    fn beyond_on_either_side_are_two_stretches() {
        let loads = [
            at(1.0, 90.0, -0.3, Some(0.01)),
            at(2.0, 90.0, -0.2, Some(0.01)),
            at(3.0, 90.0, 0.2, Some(0.01)),
        ];
        let expected = [(Verdict::Beyond, [1.0, 2.0]), (Verdict::Beyond, [3.0, 3.0])];
        assert_eq!(of(ComparedQuantity::Separation, &loads), expected);
    }

    #[test]
    fn without_a_valid_load_nothing_can_be_told() {
        let loads = [at(1.0, 12.0, 9.0, Some(0.01)), at(2.0, 20.0, 9.0, None)];
        assert_eq!(of(ComparedQuantity::Separation, &loads), [(Verdict::CannotTell, [1.0, 2.0])]);
        let stretch = &Stretch::all(&loads, &ACCEPTED)[0];
        assert_eq!((stretch.largest, stretch.area_needed), (None, Some(3.0)));
        // No area cures what most loads lack.
        let interacting = Difference { area_ratio: 0.2, ..loads[1].clone() };
        let mostly = [interacting.clone(), loads[1].clone(), interacting];
        assert_eq!(Stretch::all(&mostly, &ACCEPTED)[0].area_needed, None);
        assert_eq!(Stretch::all(&[], &ACCEPTED), []);
    }

    #[test]
    fn an_area_is_needed_where_half_of_the_loads_have_no_interval() {
        let of = |errors: [Option<f64>; 3]| {
            let at = |(k, error): (usize, Option<f64>)| at(k as f64 + 1.0, 90.0, 0.1, error);
            let loads: Vec<Difference> = errors.into_iter().enumerate().map(at).collect();
            let first = Stretch::all(&loads, &ACCEPTED).remove(0);
            (first.growth.is_some(), first.area_needed)
        };
        assert_eq!(of([None, None, Some(0.1)]), (false, Some(3.0)));
        // On the edge itself no area tells.
        assert_eq!(of([Some(0.1); 3]), (false, None));
        // A model-based interval of a map too small for blocks: the area that tells is that of the interval.
        let open = Difference { area_needed: Some(3.0), ..at(1.0, 90.0, 0.11, Some(0.01)) };
        let stretch = Stretch::all(&[open], &ACCEPTED).remove(0);
        assert!(stretch.growth.is_some() && stretch.area_needed.is_none());
    }
}
