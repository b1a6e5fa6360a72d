//! Run time against error: what an integral, a sum and a random surface cost, and how exact they are for it.
//!
//! Times are medians of runs made in alternation (`timing`); errors are against evaluations in about 32
//! digits that share neither the rule nor the code with what they check
//! ([`exact`](crate::stability::exact), and the exact sums of [`sum`]).
//!
//! | module | what is measured |
//! |---|---|
//! | [`integral`] | rules of quadrature, by order or tolerance |
//! | [`sum`] | summation methods, by number of asperities, that of the separations, and threads |
//! | [`curve`] | curves of many separations, by their tolerance |
//! | [`list`] | lists of asperities read from a file, by their length |
//! | [`attribution`] | the difference between the models divided among its causes, by number of asperities and law |
//! | [`sampling`] | how far a random set is from its population, by the number of asperities |
//! | [`grid`] | error of the summits of a random map relative to an infinite one on a fine grid |

pub mod attribution;
pub mod curve;
pub mod grid;
pub mod integral;
pub mod list;
mod memory;
mod rules;
pub mod sampling;
pub mod sum;
mod timing;

/// Error levels at which the fastest method is determined.
pub const LEVELS: [f64; 3] = [1e-4, 1e-8, 1e-12];

/// Cost and error of a method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Seconds a separation.
    pub seconds: f64,
    /// The larger of the relative errors of area and load, at the separation where it is largest.
    pub error: f64,
}

/// Index of the fastest method whose error is at most `level`.
pub fn fastest<'a>(ways: impl IntoIterator<Item = &'a Cost>, level: f64) -> Option<usize> {
    let good = ways.into_iter().enumerate().filter(|(_, cost)| cost.error <= level);
    good.min_by(|a, b| a.1.seconds.total_cmp(&b.1.seconds)).map(|(place, _)| place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fastest_is_the_first_that_is_good_enough() {
        let cost = |seconds, error| Cost { seconds, error };
        let ways = [cost(3.0, 1e-15), cost(1.0, 1e-3), cost(2.0, 1e-9), cost(0.1, f64::NAN)];
        assert_eq!(fastest(&ways, 1e-2), Some(1));
        assert_eq!(fastest(&ways, 1e-8), Some(2));
        assert_eq!(fastest(&ways, 1e-12), Some(0));
        assert_eq!(fastest(&ways, 1e-16), None);
    }
}
