//! Levelling: removal of the form of a map by least squares.

use nalgebra::{DMatrix, DVector};
use pulp::{Arch, Simd, WithSimd};

use super::HeightMap;
use super::rows::{Rows, Strip, first_present, rows_from, strips};
use crate::named_enum;
use crate::numeric::lanes::Real;
use crate::numeric::sum::{Terms, sums_of_present};

named_enum! {
    /// The form to remove.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
    #[cfg_attr(feature = "serde", derive(serde::Deserialize))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    #[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
    pub enum Level {
        /// Nothing is removed.
        None = "none",
        /// The mean.
        Mean = "mean",
        /// The least-squares plane.
        #[default]
        Plane = "plane",
        /// The least-squares polynomial of second degree.
        Quadratic = "quadratic",
        /// The least-squares polynomial of third degree.
        Cubic = "cubic",
    }
}

/// The present points do not determine the form: too few, or on a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cannot be levelled by a {}: its present points do not determine one; allowed: more points, or level = \"mean\"", .0.name())]
pub struct Undetermined(Level);

/// Number of terms of the largest form.
const TERMS: usize = 10;

/// Powers of u and v in the terms, by degree.
const POWERS: [(i32, usize); TERMS] =
    [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3)];

/// Number of powers of v in a term, and in a product of two terms.
const DEGREES: usize = 4;
const PRODUCTS: usize = 7;

impl Level {
    const fn terms(self) -> usize {
        match self {
            Self::None => 0,
            Self::Mean => 1,
            Self::Plane => 3,
            Self::Quadratic => 6,
            Self::Cubic => 10,
        }
    }

    /// The form with terms of the next higher degree; `None` beyond the highest.
    pub const fn next(self) -> Option<Self> {
        match self {
            Self::None => Some(Self::Mean),
            Self::Mean => Some(Self::Plane),
            Self::Plane => Some(Self::Quadratic),
            Self::Quadratic => Some(Self::Cubic),
            Self::Cubic => None,
        }
    }

    /// The form without the terms of the highest degree; `None` of nothing.
    pub const fn previous(self) -> Option<Self> {
        match self {
            Self::None => None,
            Self::Mean => Some(Self::None),
            Self::Plane => Some(Self::Mean),
            Self::Quadratic => Some(Self::Plane),
            Self::Cubic => Some(Self::Quadratic),
        }
    }

    /// The least-squares form of a map; bit-identical for any number of threads.
    ///
    /// # Errors
    /// Points that do not determine the form.
    pub fn form(self, map: &dyn Rows) -> Result<Form, Undetermined> {
        let terms = self.terms();
        let mut form = Form {
            origin: 0.0,
            // Coordinates from -1 to 1 and heights about one of them keep the equations well conditioned.
            centre: map.points().map(|count| 0.5 * (count - 1) as f64),
            coefficients: [0.0; TERMS],
            terms,
        };
        if terms == 0 {
            return Ok(form);
        }
        form.origin = first_present(map);
        let mut normal = Normal::default();
        for part in strips(map, 0, |strip| form.normal(&strip)) {
            normal.merge(&part);
        }
        let matrix = DMatrix::from_fn(terms, terms, |i, j| normal.matrix[i][j]);
        let right = DVector::from_fn(terms, |i, _| normal.right[i]);
        let coefficients =
            determined(matrix).and_then(|factors| factors.solve(&right)).ok_or(Undetermined(self))?;
        form.coefficients[..terms].copy_from_slice(coefficients.as_slice());
        Ok(form)
    }

    /// The map without its form, in memory.
    ///
    /// # Errors
    /// Points that do not determine the form.
    pub fn apply(self, map: &HeightMap) -> Result<HeightMap, Undetermined> {
        Ok(HeightMap::from_rows(&Levelled { map, form: self.form(map)? }))
    }
}

/// A polynomial over the grid of a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Form {
    /// A height subtracted before the fit, m.
    origin: f64,
    centre: [f64; 2],
    coefficients: [f64; TERMS],
    terms: usize,
}

impl Form {
    /// The largest height subtracted, m: differences below its rounding error are meaningless.
    pub fn magnitude(&self) -> f64 {
        self.origin.abs() + self.coefficients.iter().map(|c| c.abs()).sum::<f64>()
    }

    fn coordinate(&self, index: usize, axis: usize) -> f64 {
        index as f64 / self.centre[axis] - 1.0
    }

    fn normal(&self, strip: &Strip) -> Normal {
        let mut sums = Normal::default();
        let columns = strip.row(0).map_or(0, <[f64]>::len);
        let along: Vec<f64> = (0..columns).map(|iy| self.coordinate(iy, 1)).collect();
        for k in 0..strip.count {
            let u = self.coordinate(strip.first + k, 0);
            let row = strip.row(k as isize).unwrap_or_default();
            // In a row only v varies: powers of v are summed, those of u are factors.
            let (all, _) = sums_of_present([row, &along], HeightsAndPowers { origin: self.origin });
            let [z, zv, zvv, zvvv, powers @ ..] = all;
            sums.add(u, powers, [z, zv, zvv, zvvv]);
        }
        sums
    }

    /// Subtracts the form from a row of heights (m) at the x index `ix`.
    pub fn subtract(&self, ix: usize, row: &mut [f64]) {
        if self.terms == 0 {
            return;
        }
        let u = self.coordinate(ix, 0);
        // In a row it is a polynomial of v.
        let mut along = [0.0; DEGREES];
        for ((power_u, power_v), coefficient) in POWERS.into_iter().zip(self.coefficients) {
            along[power_v] += coefficient * u.powi(power_u);
        }
        Arch::new().dispatch(Subtract { row, origin: self.origin, centre: self.centre[1], along });
    }
}

/// A height above an origin times the powers of v, and these powers.
#[derive(Clone, Copy)]
struct HeightsAndPowers {
    origin: f64,
}

impl Terms<2, { DEGREES + PRODUCTS }> for HeightsAndPowers {
    #[inline(always)]
    fn of<N: Real>(self, [z, v]: [N; 2]) -> [N; DEGREES + PRODUCTS] {
        let (z, v2) = (z - self.origin, v * v);
        let v3 = v2 * v;
        [z, z * v, z * v2, z * v3, z.splat(1.0), v, v2, v3, v2 * v2, v2 * v3, v3 * v3]
    }
}

/// Subtracts an origin and a polynomial of v from a row. Written to be vectorised by the compiler.
struct Subtract<'a> {
    row: &'a mut [f64],
    origin: f64,
    /// The point at which v is zero.
    centre: f64,
    /// Of the powers of v.
    along: [f64; DEGREES],
}

impl WithSimd for Subtract<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { row, origin, centre, along: [c, cv, cvv, cvvv] } = self;
        for (iy, z) in row.iter_mut().enumerate() {
            // Registers convert 32 bits at once.
            let v = f64::from(iy as i32) / centre - 1.0;
            *z = (*z - origin) - (c + v * (cv + v * (cvv + v * cvvv)));
        }
    }
}

/// A map minus its form, row by row.
pub struct Levelled<'a> {
    /// The map.
    pub map: &'a dyn Rows,
    /// The form to subtract.
    pub form: Form,
}

impl Rows for Levelled<'_> {
    rows_from!(map: points pixel precision boundary progress is_whole);

    /// Every form includes the mean, and with it the offset.
    fn offset(&self) -> f64 {
        if self.form.terms == 0 { self.map.offset() } else { 0.0 }
    }

    fn read(&self, ix: usize, row: &mut [f64]) {
        self.map.read(ix, row);
        self.form.subtract(ix, row);
    }

    fn block(&self, rows: std::ops::Range<usize>) -> Option<&[f64]> {
        if self.form.terms == 0 { self.map.block(rows) } else { None }
    }
}

/// The factorisation of normal equations; an error if they are singular to rounding.
fn determined(
    matrix: DMatrix<f64>,
) -> Option<nalgebra::linalg::FullPivLU<f64, nalgebra::Dyn, nalgebra::Dyn>> {
    /// Pivots below this, relative to the largest, count as zero.
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
    /// Adds a row at `u`, from its sums of powers of v and of heights times powers of v.
    fn add(&mut self, u: f64, powers: [f64; PRODUCTS], heights: [f64; DEGREES]) {
        for (i, (ui, vi)) in POWERS.into_iter().enumerate() {
            for (j, (uj, vj)) in POWERS.into_iter().enumerate() {
                self.matrix[i][j] += u.powi(ui + uj) * powers[vi + vj];
            }
            self.right[i] += u.powi(ui) * heights[vi];
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
    use crate::topography::roughness::RoughnessParameters;

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
        let saddle =
            map(|x, y| bowl.heights()[(x * 30.0 + y) as usize] + 1e-3 * (x * x * y - 2.0 * y * y * y));
        assert!(largest(&Level::Cubic.apply(&saddle).unwrap()) < 1e-11);
        assert!(largest(&Level::Quadratic.apply(&saddle).unwrap()) > 1.0);
        assert!(largest(&Level::Plane.apply(&bowl).unwrap()) > 1.0);
        assert!(largest(&Level::Mean.apply(&plane).unwrap()) > 1.0);
        assert_eq!(Level::None.apply(&bowl).unwrap(), bowl);
    }

    #[test]
    fn missing_points_stay_missing_and_do_not_count() {
        let holed = map(|x, y| if x > 20.0 && y < 9.0 { f64::NAN } else { 1e6 + 0.3 * x - 0.7 * y });
        let levelled = Level::Plane.apply(&holed).unwrap();
        assert_eq!(RoughnessParameters::new(&levelled).missing, RoughnessParameters::new(&holed).missing);
        assert!(largest(&levelled) < 1e-9);
    }

    /// Kept apart, an offset changes no digit of the heights; only without levelling is it still there.
    #[test]
    fn an_offset_goes_with_the_form_and_costs_no_digits() {
        let near = map(|x, y| 1e-8 * (x * y).sin());
        let far = near.clone().with_offset(1.0);
        for level in [Level::Mean, Level::Plane, Level::Quadratic] {
            assert_eq!(level.apply(&far).unwrap(), level.apply(&near).unwrap());
        }
        assert_eq!(Level::None.apply(&far).unwrap().offset(), 1.0);
        assert_eq!(RoughnessParameters::new(&far), RoughnessParameters::new(&near));
    }

    #[test]
    fn points_on_a_line_determine_no_plane() {
        let line = map(|x, _| if x == 3.0 { 1.0 } else { f64::NAN });
        assert_eq!(Level::Plane.apply(&line), Err(Undetermined(Level::Plane)));
        assert!(Level::Mean.apply(&line).is_ok());
    }
}
