//! The largest differences between the two models, each with its pair of values.

use super::{Pair, Pairing};
use crate::named_enum;

named_enum! {
    /// A quantity in which the models are compared.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum GapQuantity {
        /// d/sigma at equal load.
        Separation = "separation_over_sigma",
        /// A/A_nom at equal load.
        AreaRatio = "area_ratio",
        /// Nominal pressure at equal separation, Pa.
        Pressure = "pressure_pa",
    }
}

/// The largest difference of one quantity over the valid pairs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// The quantity.
    pub quantity: GapQuantity,
    /// Whether the pair is at equal load or equal separation.
    pub pairing: Pairing,
    /// The common load (Pa) or separation (in sigma).
    pub target: f64,
    /// Value under the statistical model.
    pub statistical: f64,
    /// Value under the deterministic model.
    pub deterministic: f64,
}

impl Gap {
    /// Statistical minus deterministic.
    pub fn difference(&self) -> f64 {
        self.statistical - self.deterministic
    }

    /// Statistical over deterministic.
    pub fn ratio(&self) -> f64 {
        self.statistical / self.deterministic
    }
}

/// The largest gaps over the pairs at admissible loads.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gaps {
    /// Number of valid pairs.
    pub pairs: usize,
    /// One for each quantity that differs by more than rounding.
    pub largest: Vec<Gap>,
}

impl Gaps {
    /// The largest gap of a quantity.
    pub fn of_quantity(&self, quantity: GapQuantity) -> Option<&Gap> {
        self.largest.iter().find(|gap| gap.quantity == quantity)
    }

    /// The largest gaps of `pairs`.
    pub fn largest(pairs: &[Pair]) -> Self {
        /// In sigma, or relative to the quantity: above the tolerance of load control.
        const ROUNDING: f64 = 1e-10;
        let counted: Vec<&Pair> = pairs.iter().filter(|pair| pair.is_admissible()).collect();
        let largest = |gap_of: &dyn Fn(&Pair) -> Gap, pairing, size: fn(&Gap) -> f64| {
            counted
                .iter()
                .filter(|pair| pair.pairing == pairing)
                .map(|pair| gap_of(pair))
                .filter(|gap| size(gap) > ROUNDING)
                .max_by(|a, b| size(a).total_cmp(&size(b)))
        };
        let by_ratio: fn(&Gap) -> f64 = |gap| gap.ratio().ln().abs();
        let by_difference: fn(&Gap) -> f64 = |gap| gap.difference().abs();
        Self {
            pairs: counted.len(),
            largest: [
                largest(&separation_gap, Pairing::Load, by_difference),
                largest(&area_gap, Pairing::Load, by_ratio),
                largest(&pressure_gap, Pairing::Separation, by_ratio),
            ]
            .into_iter()
            .flatten()
            .collect(),
        }
    }
}

fn separation_gap(pair: &Pair) -> Gap {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    gap(pair, GapQuantity::Separation, s.separation_over_sigma, d.separation_over_sigma)
}

fn area_gap(pair: &Pair) -> Gap {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    gap(pair, GapQuantity::AreaRatio, s.area_ratio.total(), d.area_ratio.total())
}

fn pressure_gap(pair: &Pair) -> Gap {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    gap(pair, GapQuantity::Pressure, s.pressure.total(), d.pressure.total())
}

fn gap(pair: &Pair, quantity: GapQuantity, statistical: f64, deterministic: f64) -> Gap {
    Gap { quantity, pairing: pair.pairing, target: pair.target, statistical, deterministic }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::tests;
    use crate::contact::ByRegime;
    use crate::model::Response;

    fn response(h: f64, area_ratio: f64, pressure: f64, contacts: f64) -> Response {
        let pressure = ByRegime([0.0, pressure, 0.0]);
        Response { pressure, ..tests::response(h, area_ratio, Some(contacts)) }
    }

    #[test]
    fn the_largest_gaps_among_the_pairs_that_count() {
        let pair =
            |pairing, statistical, deterministic| Pair { pairing, target: 1.0, statistical, deterministic };
        let pairs = [
            pair(Pairing::Load, response(3.0, 2e-3, 100.0, 50.0), response(2.5, 1e-3, 100.0, 50.0)),
            pair(Pairing::Load, response(1.0, 3e-3, 100.0, 50.0), response(1.2, 1e-2, 100.0, 50.0)),
            pair(Pairing::Separation, response(1.0, 1e-3, 150.0, 50.0), response(1.0, 1e-3, 100.0, 50.0)),
            // Asperities interact; too few contacts.
            pair(Pairing::Load, response(9.0, 0.051, 100.0, 50.0), response(0.0, 1e-3, 100.0, 50.0)),
            pair(Pairing::Load, response(9.0, 1e-3, 100.0, 50.0), response(0.0, 1e-3, 100.0, 29.0)),
        ];
        let gaps = Gaps::largest(&pairs);
        assert_eq!(gaps.pairs, 3);
        let [separation, area, pressure] = &gaps.largest[..] else { panic!("three quantities") };
        assert_eq!((separation.difference(), separation.quantity), (0.5, GapQuantity::Separation));
        assert!((area.ratio() - 0.3).abs() < 1e-15);
        assert_eq!(pressure.ratio(), 1.5);
    }

    #[test]
    fn what_is_equal_but_for_rounding_is_no_gap() {
        let one = response(3.0, 1e-3, 100.0, 50.0);
        let other = response(3.0 + 1e-14, 1e-3 * (1.0 + 1e-13), 101.0, 50.0);
        let pairs = [Pairing::Load, Pairing::Separation].map(|pairing| Pair {
            pairing,
            target: 1.0,
            statistical: one,
            deterministic: other,
        });
        let gaps = Gaps::largest(&pairs);
        assert_eq!(gaps.pairs, 2);
        let quantities: Vec<GapQuantity> = gaps.largest.iter().map(|gap| gap.quantity).collect();
        assert_eq!(quantities, [GapQuantity::Pressure]);
    }
}
