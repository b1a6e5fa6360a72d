//! A curve of many separations from few of them.

use super::{Model, Response, SamplingError};
use crate::contact::ByRegime;

/// A curve that holds a tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The answers, in the order of the separations that were asked for.
    pub responses: Vec<Response>,
    /// How many separations the model was asked at.
    pub asked: usize,
}

/// What is interpolated of a response: logarithms of what is positive and spans decades, shares as they are.
const QUANTITIES: usize = 12;

/// The quantities that the tolerance is held for: pressure, area ratio and the shares of both.
const HELD: usize = 8;

type Quantities = [f64; QUANTITIES];

/// Where the model was asked: the separation and its answer, as what is interpolated.
#[derive(Debug, Clone, Copy)]
struct Node {
    h: f64,
    response: Response,
    quantities: Quantities,
}

impl Node {
    fn of(response: Response) -> Self {
        let logarithm = |value: f64| if value > 0.0 { value.ln() } else { f64::NEG_INFINITY };
        let shares = |parts: &ByRegime| parts.shares().unwrap_or_default();
        let [of_pressure, of_area] = [&response.pressure, &response.area_ratio].map(shares);
        let sampling = response.sampling.unwrap_or(SamplingError { pressure: 0.0, area_ratio: 0.0 });
        let logarithms = [
            response.pressure.total(),
            response.area_ratio.total(),
            response.contact_density,
            response.stiffness,
            sampling.pressure,
            sampling.area_ratio,
        ]
        .map(logarithm);
        let mut quantities = [0.0; QUANTITIES];
        quantities[..2].copy_from_slice(&logarithms[..2]);
        quantities[2..5].copy_from_slice(&of_pressure);
        quantities[5..8].copy_from_slice(&of_area);
        quantities[HELD..].copy_from_slice(&logarithms[2..]);
        Self { h: response.separation_over_sigma, response, quantities }
    }

    /// The response that interpolated `quantities` are, at the separation `h`, with the contacts of `exact` if they are
    /// known.
    fn response(model: &dyn Model, h: f64, quantities: &Quantities, density: Option<f64>) -> Response {
        let parts = |total: f64, shares: &[f64]| {
            let shares = [0, 1, 2].map(|k| shares[k].max(0.0));
            let all: f64 = shares.iter().sum();
            ByRegime(shares.map(|share| total.exp() * share / all))
        };
        let [.., contacts, stiffness, pressure_error, area_error] = quantities.map(f64::exp);
        Response {
            separation_over_sigma: h,
            separation: h * model.datum().sigma,
            contact_density: density.unwrap_or(contacts),
            area_ratio: parts(quantities[1], &quantities[5..8]),
            pressure: parts(quantities[0], &quantities[2..5]),
            stiffness,
            sampling: model
                .samples()
                .then_some(SamplingError { pressure: pressure_error, area_ratio: area_error }),
        }
    }
}
