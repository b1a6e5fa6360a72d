//! What is interpolated of a response.

use std::ops::Range;

use crate::contact::ByRegime;
use crate::model::{Response, SamplingError};
use crate::numeric::lanes::MOST;

/// First what an integral has, in one register of the widest: the logarithms of what spans decades, the stiffness over the
/// pressure (it may be negative), then two shares of the regimes of each total, of which the first is the rest. Then what a
/// sum has besides, its relative sampling errors.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub struct Quantities(pub [f64; 2 * MOST]);

impl Quantities {
    /// None of them.
    pub const ZERO: Self = Self([0.0; 2 * MOST]);

    /// Those that an integral has come first.
    pub const OF_AN_INTEGRAL: usize = MOST;

    /// Those that a sum has.
    pub const OF_A_SUM: usize = 2 * MOST;

    /// The logarithms of pressure, area ratio and contacts come first.
    pub const LOGARITHMS: usize = 3;

    /// Places of the logarithms of pressure and area ratio.
    pub const TOTALS: Range<usize> = 0..2;

    /// Places of the shares in pressure and in area ratio beyond the first.
    pub const SHARES: [[usize; 2]; 2] = [[4, 5], [6, 7]];

    /// Those of a response.
    pub fn of(response: &Response) -> Self {
        /// Shares below this are none: their differences would be denormal, which is slow.
        const NEGLIGIBLE: f64 = 1e-100;
        let shares = |parts: &ByRegime| {
            parts.shares().unwrap_or_default().map(|share| if share < NEGLIGIBLE { 0.0 } else { share })
        };
        let [_, p2, p3] = shares(&response.pressure);
        let [_, a2, a3] = shares(&response.area_ratio);
        let [pressure, area] = [response.pressure.total(), response.area_ratio.total()];
        let relative =
            response.sampling.map_or([0.0; 2], |error| [error.pressure / pressure, error.area_ratio / area]);
        let of_an_integral = [
            pressure.ln(),
            area.ln(),
            response.contact_density.ln(),
            response.stiffness / pressure,
            p2,
            p3,
            a2,
            a3,
        ];
        let mut all = Self::ZERO;
        all.0[..MOST].copy_from_slice(&of_an_integral);
        all.0[MOST..MOST + 2].copy_from_slice(&relative);
        all
    }

    /// The response at `h`, in units of `sigma` (m), that has these, the first already what they were the
    /// logarithms of, with so many contacts an area if they were counted; `None` where they are none.
    pub fn response(&self, h: f64, sigma: f64, counted_density: Option<f64>) -> Option<Response> {
        let [pressure, area, contacts, per_pressure, p2, p3, a2, a3, of_pressure, of_area, ..] = self.0;
        // No number where one of them is none.
        let sum = pressure + area + contacts + per_pressure + p2 + p3 + a2 + a3 + of_pressure + of_area;
        if !(pressure > 0.0 && area > 0.0 && sum.is_finite()) {
            return None;
        }
        let parts = |total: f64, second: f64, third: f64| {
            let second = second.clamp(0.0, 1.0);
            let third = third.clamp(0.0, 1.0 - second);
            ByRegime([1.0 - second - third, second, third].map(|share| share * total))
        };
        Some(Response {
            separation_over_sigma: h,
            separation: h * sigma,
            contact_density: counted_density.unwrap_or(contacts),
            area_ratio: parts(area, a2, a3),
            pressure: parts(pressure, p2, p3),
            stiffness: per_pressure * pressure,
            // Only a sum has its contacts counted.
            sampling: counted_density
                .map(|_| SamplingError { pressure: of_pressure * pressure, area_ratio: of_area * area }),
        })
    }
}
