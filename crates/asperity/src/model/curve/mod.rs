//! A curve at many separations, interpolated between responses at some of them to a given tolerance.
//!
//! | module | content |
//! |---|---|
//! | `sampler` | adaptive choice of the separations evaluated |
//! | `interpolation` | polynomials between the responses |
//! | `quantities` | the interpolated quantities |

mod interpolation;
mod quantities;
mod sampler;

use interpolation::Scale;
use sampler::{AdaptiveSampler, DiscretisationBound};

use super::{Model, Response};

/// A curve computed to a tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The responses, in the order of the given separations.
    pub responses: Vec<Response>,
    /// The separations at which the model itself was evaluated.
    pub evaluated: Vec<f64>,
}

/// Below this number of separations the model is evaluated at each.
const MIN_SEPARATIONS: usize = 32;

/// The responses at `separations` (d/sigma). Pressure and area ratio have a relative error of at most `tolerance`, and
/// for an integral the shares of their regimes an absolute error of at most that.
///
/// The model is evaluated at some of the separations and interpolated at the rest. An interval is bisected until the
/// response in its middle agrees with the interpolation and, for a sum, until the asperities within it are too few to
/// matter (`DiscretisationBound`). Where interpolation fails, the model is evaluated at each separation. The number of
/// contacts of a sum is counted, not interpolated.
pub fn respond_within(model: &dyn Model, separations: &[f64], tolerance: f64) -> Curve {
    if separations.len() < MIN_SEPARATIONS {
        return Curve { responses: model.respond_all(separations), evaluated: separations.to_vec() };
    }
    let mut order: Vec<usize> = (0..separations.len()).collect();
    order.sort_by(|&a, &b| separations[a].total_cmp(&separations[b]));
    let counted = model.count_contacts(separations);
    let ascending: Vec<f64> = order.iter().map(|&k| separations[k]).collect();
    let bound = counted.as_ref().map(|counted| {
        DiscretisationBound::new(&ascending, order.iter().map(|&k| counted.contacts[k]).collect())
    });
    let mut sampler = AdaptiveSampler::new(ascending, bound);
    sampler.refine(model, tolerance);
    let known = &sampler.known;
    let mut evaluated: Vec<f64> = known.iter().map(|node| node.response.separation_over_sigma).collect();
    // Every other place is overwritten below.
    let mut responses = vec![known[0].response; separations.len()];
    for node in known {
        responses[order[node.place]] = node.response;
    }
    let sigma = model.plane().sigma;
    // Quantities without contact cannot be interpolated.
    let mut missing = Vec::new();
    let gaps = known.windows(2).map(|pair| pair[0].place + 1..pair[1].place);
    sampler.interpolate(gaps, Scale::Plain, |place, row| {
        let k = order[place];
        let density = counted.as_ref().map(|counted| counted.contacts[k] * counted.per_area);
        match row.quantities().response(separations[k], sigma, density) {
            Some(response) => responses[k] = response,
            None => missing.push(k),
        }
    });
    let missing_separations: Vec<f64> = missing.iter().map(|&k| separations[k]).collect();
    for (k, response) in missing.into_iter().zip(model.respond_all(&missing_separations)) {
        responses[k] = response;
    }
    evaluated.extend(missing_separations);
    Curve { responses, evaluated }
}
