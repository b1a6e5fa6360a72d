//! What holds on the very surface that was compared: there the sum over its asperities is exact, and the difference a number.

use super::difference::{ComparedQuantity, Difference};
use super::verdict::Accepted;
use crate::model::Exceeded;

/// Neighbouring loads at which the difference in one quantity is within what is accepted on the compared surface, or beyond it on one side;
/// over several realisations their mean.
#[derive(Debug, Clone, PartialEq)]
pub struct OnMap {
    /// The quantity.
    pub quantity: ComparedQuantity,
    /// Whether it is within.
    pub is_within: bool,
    /// Whether the loads are admissible.
    pub is_admissible: bool,
    /// Limits of admissible loads that are exceeded at some of the loads.
    pub exceeded: Exceeded,
    /// First and last load, Pa.
    pub loads: [f64; 2],
    /// What is accepted, as in [`Accepted`].
    pub accepted: f64,
    /// The load (Pa) of the largest difference, and its contrast.
    pub largest: (f64, f64),
    /// The smallest and the largest contrast.
    pub range: [f64; 2],
}

impl OnMap {
    /// Every quantity over the `differences` (any order), by growing load.
    pub fn all(differences: &[Difference], accepted: &Accepted) -> Vec<Self> {
        let mut sorted: Vec<&Difference> = differences.iter().collect();
        sorted.sort_by(|a, b| a.load.total_cmp(&b.load));
        let of = |quantity| Self::of(quantity, &sorted, accepted);
        ComparedQuantity::ALL.into_iter().flat_map(of).collect()
    }

    fn of(quantity: ComparedQuantity, sorted: &[&Difference], accepted: &Accepted) -> Vec<Self> {
        let [low, high] = accepted.band(quantity);
        let contrast = |at: &Difference| at.estimates[quantity as usize].map(|estimate| estimate.contrast);
        // Below, within or above the band; a quantity that cannot be compared breaks the stretch.
        let side = |at: &Difference| contrast(at).map(|contrast| [contrast < low, contrast > high]);
        let key = |at: &Difference| (side(at), at.exceeded().is_none());
        let stretch = |stretch: &[&Difference]| {
            let contrasts = || stretch.iter().filter_map(|at| Some((at.load, contrast(at)?)));
            let largest = contrasts().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
            let exceeded = stretch.iter().fold(Exceeded::default(), |all, at| all.union(at.exceeded()));
            let ends = (f64::INFINITY, f64::NEG_INFINITY);
            let (least, most) = contrasts().fold(ends, |(low, high), (_, at)| (low.min(at), high.max(at)));
            Some(Self {
                quantity,
                is_within: side(stretch[0]) == Some([false; 2]),
                is_admissible: exceeded.is_none(),
                exceeded,
                loads: [stretch[0].load, stretch[stretch.len() - 1].load],
                accepted: accepted.limit(quantity),
                largest,
                range: [least, most],
            })
        };
        sorted.chunk_by(|a, b| key(a) == key(b)).filter_map(stretch).collect()
    }

    /// The name of what holds.
    pub fn name(&self) -> &'static str {
        if self.is_within { "within" } else { "beyond" }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::tests::at;

    /// Without any interval, also where loads are not admissible; those are stretches of their own.
    #[test]
    fn the_difference_on_the_map_needs_no_interval() {
        let of = |(load, contacts, contrast)| at(load, contacts, contrast, None);
        let loads =
            [(4.0, 50.0, 0.3), (1.0, 9.0, -0.2), (2.0, 9.0, 0.05), (3.0, 50.0, 0.2), (5.0, 50.0, -0.3)];
        let loads = loads.map(of);
        let mut all = OnMap::all(&loads, &Accepted::DEFAULT);
        all.retain(|one| one.quantity == ComparedQuantity::Separation);
        let found: Vec<_> =
            all.iter().map(|one| (one.name(), one.is_admissible, one.loads, one.largest.1)).collect();
        let expected = [
            ("beyond", false, [1.0, 1.0], -0.2),
            ("within", false, [2.0, 2.0], 0.05),
            ("beyond", true, [3.0, 4.0], 0.3),
            ("beyond", true, [5.0, 5.0], -0.3),
        ];
        assert_eq!(found, expected);
        assert_eq!(all[2].range, [0.2, 0.3]);
    }
}
