//! The interpolated quantities of a response.

use std::mem::{offset_of, size_of};

use crate::contact::ByRegime;
use crate::model::{Response, SamplingError};
use crate::numeric::lanes::MOST;

/// The interpolated quantities of a response; [`Row`] holds the same as an array. Those interpolated as logarithms,
/// since they span decades, come first; those of a sum only come last.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct Quantities {
    /// Nominal pressure (Pa) or its logarithm: see [`super::interpolation::Scale`].
    pub pressure: f64,
    /// Area ratio or its logarithm.
    pub area_ratio: f64,
    /// Contact density (1/m^2) or its logarithm.
    pub contact_density: f64,
    /// Stiffness over pressure, 1/m; may be negative, hence no logarithm.
    pub relative_stiffness: f64,
    /// The elastic-plastic and plastic shares of the pressure; the elastic one is the rest.
    pub pressure_shares: [f64; 2],
    /// The elastic-plastic and plastic shares of the area.
    pub area_shares: [f64; 2],
    /// Relative standard error of the pressure of a sum.
    pub pressure_error: f64,
    /// Relative standard error of the area of a sum.
    pub area_error: f64,
}

impl Quantities {
    /// The quantities of a response, the first as logarithms.
    pub fn of(response: &Response) -> Self {
        /// Shares below this count as zero: their differences would be denormal, which is slow.
        const NEGLIGIBLE: f64 = 1e-100;
        let shares = |parts: &ByRegime| {
            let [_, second, third] = parts.shares().unwrap_or_default();
            [second, third].map(|share| if share < NEGLIGIBLE { 0.0 } else { share })
        };
        let [pressure, area] = [response.pressure.total(), response.area_ratio.total()];
        let relative = |error: SamplingError| [error.pressure / pressure, error.area_ratio / area];
        let [pressure_error, area_error] = response.sampling.map_or([0.0; 2], relative);
        Self {
            pressure: pressure.ln(),
            area_ratio: area.ln(),
            contact_density: response.contact_density.ln(),
            relative_stiffness: response.stiffness / pressure,
            pressure_shares: shares(&response.pressure),
            area_shares: shares(&response.area_ratio),
            pressure_error,
            area_error,
        }
    }

    /// The response at the separation `h` = d/`sigma` (sigma in m), from quantities that are not logarithms;
    /// `counted_density` (1/m^2) is the contact density if it was counted. `None` if a quantity is NaN.
    #[inline(always)]
    pub fn response(&self, h: f64, sigma: f64, counted_density: Option<f64>) -> Option<Response> {
        let &Self { pressure, area_ratio, pressure_error, area_error, .. } = self;
        if !(pressure > 0.0 && area_ratio > 0.0 && Row::from(*self).0.iter().sum::<f64>().is_finite()) {
            return None;
        }
        let parts = |total: f64, [second, third]: [f64; 2]| {
            let second = second.clamp(0.0, 1.0);
            let third = third.clamp(0.0, 1.0 - second);
            ByRegime([1.0 - second - third, second, third].map(|share| share * total))
        };
        Some(Response {
            separation_over_sigma: h,
            separation: h * sigma,
            contact_density: counted_density.unwrap_or(self.contact_density),
            area_ratio: parts(area_ratio, self.area_shares),
            pressure: parts(pressure, self.pressure_shares),
            stiffness: self.relative_stiffness * pressure,
            // Contacts are counted for a sum only.
            sampling: counted_density.map(|_| SamplingError {
                pressure: pressure_error * pressure,
                area_ratio: area_error * area_ratio,
            }),
            sharing: None,
        })
    }
}

/// [`Quantities`] as an array in the order of declaration, padded to the widest registers; those of an integral fill
/// the first [`Self::OF_AN_INTEGRAL`] entries.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub struct Row(pub [f64; Self::OF_A_SUM]);

const fn places(bytes: usize) -> usize {
    bytes / size_of::<f64>()
}

impl Row {
    /// Number of leading entries that are interpolated as logarithms.
    pub const LOGARITHMS: usize = places(offset_of!(Quantities, relative_stiffness));

    /// Number of entries of an integral.
    pub const OF_AN_INTEGRAL: usize = places(offset_of!(Quantities, pressure_error)).next_multiple_of(MOST);

    /// Number of entries of a sum: all.
    pub const OF_A_SUM: usize = Self::COUNT.next_multiple_of(MOST);

    const COUNT: usize = places(size_of::<Quantities>());

    /// All quantities zero.
    pub const ZERO: Self = Self([0.0; Self::OF_A_SUM]);

    /// The quantities by name.
    #[inline(always)]
    pub fn quantities(&self) -> Quantities {
        let [pressure, area_ratio, contact_density, relative_stiffness, p2, p3, a2, a3, rest @ ..] = self.0;
        Quantities {
            pressure,
            area_ratio,
            contact_density,
            relative_stiffness,
            pressure_shares: [p2, p3],
            area_shares: [a2, a3],
            pressure_error: rest[0],
            area_error: rest[1],
        }
    }
}

impl From<Quantities> for Row {
    #[inline(always)]
    fn from(of: Quantities) -> Self {
        let ([p2, p3], [a2, a3]) = (of.pressure_shares, of.area_shares);
        let mut row = Self::ZERO;
        row.0[..Self::COUNT].copy_from_slice(&[
            of.pressure,
            of.area_ratio,
            of.contact_density,
            of.relative_stiffness,
            p2,
            p3,
            a2,
            a3,
            of.pressure_error,
            of.area_error,
        ]);
        row
    }
}
