//! Run time against error: what an integral, a sum, a random surface and a contact by boundary elements cost, and how exact they are
//! for it.
//!
//! Times are medians of runs made in alternation (`timing`). Errors of integrals and sums are against evaluations in about 32 digits that
//! share neither the rule nor the code with what they check ([`exact`](crate::stability::exact), and the exact sums of [`sum`]).
//!
//! | module | what is measured |
//! |---|---|
//! | [`integral`] | rules of quadrature, by order or tolerance |
//! | [`sum`] | summation methods, by number of asperities |
//! | [`surface`] | summits of a random map relative to an infinite surface on a fine grid, by pixel and side |
//! | [`mod@reference`] | boundary elements on Hertz's contact, by pixel |

pub mod integral;
pub mod reference;
pub mod sum;
pub mod surface;
mod timing;

use crate::stability::wide::{Wide, relative_error};
use asperity::Population;

/// A population of Gaussian heights.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its name in tables.
    pub name: String,
    /// Its numbers.
    pub population: Population,
}

/// Time and errors of a method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Seconds per separation, or per contact.
    pub seconds: f64,
    /// The largest relative error of the area over the separations.
    pub area_error: f64,
    /// The same of the load.
    pub load_error: f64,
}

impl Cost {
    /// Of area and load at several separations, which take `seconds` in all.
    fn new(seconds: f64, values: &[[f64; 2]], exact: &[[Wide; 2]]) -> Self {
        let [area_error, load_error] = [0, 1].map(|which| {
            let pairs = values.iter().zip(exact).filter(|(_, exact)| exact[which] > Wide::ZERO);
            pairs.map(|(value, exact)| relative_error(value[which], exact[which])).fold(0.0, f64::max)
        });
        Self { seconds: seconds / values.len() as f64, area_error, load_error }
    }

    /// The larger of both errors.
    pub fn error(&self) -> f64 {
        self.area_error.max(self.load_error)
    }
}
