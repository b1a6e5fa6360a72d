//! Taking the form out of a map by least squares.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use serde::Deserialize;

use super::HeightMap;
use crate::numeric::sum::in_chunks;

/// The form that is taken out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Level {
    /// Nothing.
    None,
    /// The mean.
    Mean,
    /// The least-squares plane.
    #[default]
    Plane,
    /// The least-squares polynomial of second degree.
    Quadratic,
}

/// Too few points, or points on a line, determine no such form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cannot be levelled by a {}: its present points determine none; allowed: more points, or level = \"mean\"", .0.name())]
pub struct Undetermined(Level);

/// Number of terms of the largest form.
const TERMS: usize = 6;

impl Level {
    /// As specs and reports name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Mean => "mean",
            Self::Plane => "plane",
            Self::Quadratic => "quadratic",
        }
    }

    const fn terms(self) -> usize {
        match self {
            Self::None => 0,
            Self::Mean => 1,
            Self::Plane => 3,
            Self::Quadratic => 6,
        }
    }

    /// The map without its form; the same to the bit on any number of threads.
    ///
    /// # Errors
    /// Points that determine no such form.
    pub fn apply(self, map: &HeightMap) -> Result<HeightMap, Undetermined> {
        let terms = self.terms();
        if terms == 0 {
            return Ok(map.clone());
        }
        let heights = map.heights();
        // Coordinates from -1 to 1 and heights about one of them keep the equations well conditioned.
        let centre = map.points().map(|count| 0.5 * (count - 1) as f64);
        let basis = |k: usize| {
            let (u, v) = (
                (k / map.points()[1]) as f64 / centre[0] - 1.0,
                (k % map.points()[1]) as f64 / centre[1] - 1.0,
            );
            [1.0, u, v, u * u, u * v, v * v]
        };
        let origin = heights.iter().copied().find(|z| !z.is_nan()).unwrap_or_default();
        let normal = in_chunks(
            heights.len(),
            |range| {
                let mut sums = Normal::default();
                for k in range.filter(|&k| !heights[k].is_nan()) {
                    sums.add(&basis(k), heights[k] - origin);
                }
                sums
            },
            Normal::merge,
        );
        let matrix = DMatrix::from_fn(terms, terms, |i, j| normal.matrix[i][j]);
        let right = DVector::from_fn(terms, |i, _| normal.right[i]);
        let form = determined(matrix).and_then(|factors| factors.solve(&right)).ok_or(Undetermined(self))?;
        let levelled = (0..heights.len())
            .into_par_iter()
            .map(|k| {
                let terms = basis(k);
                (heights[k] - origin) - form.iter().zip(terms).map(|(c, term)| c * term).sum::<f64>()
            })
            .collect();
        Ok(map.with_heights(levelled))
    }
}

/// The factors of normal equations that are not singular to rounding.
fn determined(
    matrix: DMatrix<f64>,
) -> Option<nalgebra::linalg::FullPivLU<f64, nalgebra::Dyn, nalgebra::Dyn>> {
    /// Smaller pivots than this, relative to the largest, are rounding.
    const SINGULAR: f64 = 1e-12;
    let factors = matrix.full_piv_lu();
    let pivots = factors.u().diagonal().map(f64::abs);
    (pivots.min() > SINGULAR * pivots.max()).then_some(factors)
}

/// The normal equations of a least-squares form.
#[derive(Default)]
struct Normal {
    matrix: [[f64; TERMS]; TERMS],
    right: [f64; TERMS],
}

impl Normal {
    fn add(&mut self, basis: &[f64; TERMS], z: f64) {
        for (i, a) in basis.iter().enumerate() {
            for (sum, b) in self.matrix[i].iter_mut().zip(basis) {
                *sum += a * b;
            }
            self.right[i] += a * z;
        }
    }

    fn merge(&mut self, other: &Self) {
        for (sum, part) in self.matrix.iter_mut().flatten().zip(other.matrix.iter().flatten()) {
            *sum += part;
        }
        for (sum, part) in self.right.iter_mut().zip(other.right) {
            *sum += part;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(height: impl Fn(f64, f64) -> f64) -> HeightMap {
        let heights = (0..40 * 30).map(|k| height((k / 30) as f64, (k % 30) as f64)).collect();
        HeightMap::new([40, 30], [1e-6, 2e-6], heights, f64::EPSILON).unwrap()
    }

    fn largest(map: &HeightMap) -> f64 {
        map.heights().iter().filter(|z| !z.is_nan()).fold(0.0, |a, z| a.max(z.abs()))
    }

    #[test]
    fn each_form_is_taken_out_and_no_more() {
        let plane = map(|x, y| 5.0 + 0.3 * x - 0.7 * y);
        let bowl = map(|x, y| 5.0 + 0.3 * x - 0.7 * y + 0.01 * x * x - 0.02 * x * y + 0.05 * y * y);
        assert!(largest(&Level::Plane.apply(&plane).unwrap()) < 1e-12);
        assert!(largest(&Level::Quadratic.apply(&bowl).unwrap()) < 1e-12);
        assert!(largest(&Level::Plane.apply(&bowl).unwrap()) > 1.0);
        assert!(largest(&Level::Mean.apply(&plane).unwrap()) > 1.0);
        assert_eq!(Level::None.apply(&bowl).unwrap(), bowl);
    }

    #[test]
    fn missing_points_stay_missing_and_do_not_count() {
        let holed = map(|x, y| if x > 20.0 && y < 9.0 { f64::NAN } else { 1e6 + 0.3 * x - 0.7 * y });
        let levelled = Level::Plane.apply(&holed).unwrap();
        assert_eq!(levelled.missing(), holed.missing());
        assert!(largest(&levelled) < 1e-9);
    }

    #[test]
    fn points_on_a_line_determine_no_plane() {
        let line = map(|x, _| if x == 3.0 { 1.0 } else { f64::NAN });
        assert_eq!(Level::Plane.apply(&line), Err(Undetermined(Level::Plane)));
        assert!(Level::Mean.apply(&line).is_ok());
    }
}
