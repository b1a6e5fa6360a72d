//! Cost and error of boundary elements on Hertz's contact, whose solution is known.

use super::Cost;
use super::timing::{Candidate, medians};
use crate::solver::{Benchmark, BenchmarkQuantity, Unsolved, hertz};

/// Hertz's contact on one grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferencePoint {
    /// Pixels per contact radius.
    pub pixels: usize,
    /// Relative error of the area of the points in contact, not corrected for the border.
    pub counted_area_error: f64,
    /// Per contact, map and kernel included: the corrected area, and the load at the computed indentation over Hertz's load there.
    pub cost: Cost,
}

/// Solves Hertz's contact on each grid.
///
/// # Errors
/// See [`Unsolved`].
pub fn contacts(pixels: &[usize]) -> Result<Vec<ReferencePoint>, Unsolved> {
    let benchmarks: Vec<Vec<Benchmark>> =
        pixels.iter().map(|&pixels| hertz(pixels)).collect::<Result<_, _>>()?;
    let candidate =
        |&pixels: &usize| -> Candidate { Box::new(move || _ = std::hint::black_box(hertz(pixels))) };
    let seconds = medians(&mut pixels.iter().map(candidate).collect::<Vec<_>>());
    let points = pixels.iter().zip(&benchmarks).zip(seconds).map(|((&pixels, benchmarks), seconds)| {
        let error = |quantity: BenchmarkQuantity| {
            let benchmark = benchmarks.iter().find(|benchmark| benchmark.quantity == quantity);
            benchmark.map_or(f64::NAN, |benchmark| benchmark.error)
        };
        ReferencePoint {
            pixels,
            counted_area_error: error(BenchmarkQuantity::RawArea).abs(),
            cost: Cost {
                seconds,
                area_error: error(BenchmarkQuantity::Area).abs(),
                // The load is given; Hertz's grows with the indentation to the power 3/2.
                load_error: ((1.0 + error(BenchmarkQuantity::Indentation)).powf(-1.5) - 1.0).abs(),
            },
        }
    });
    Ok(points.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finer_grid_is_nearer_to_hertz() {
        let points = contacts(&[4, 16]).unwrap();
        let [coarse, fine] = &points[..] else { panic!("{points:?}") };
        assert!(fine.cost.area_error < 0.012 && fine.cost.load_error < 5e-4, "{fine:?}");
        assert!(coarse.cost.load_error > 4.0 * fine.cost.load_error, "{points:?}");
        assert!(coarse.counted_area_error > 2.0 * fine.counted_area_error, "{points:?}");
    }
}
