//! A curve at many separations within a tolerance: responses at some of them, and bounded interpolation between these.

use super::{LoadSharing, Model, Response, SamplingError};
use crate::contact::ByRegime;

/// A curve computed to a tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The responses, in the order of the given separations.
    pub responses: Vec<Response>,
    /// The separations at which the model itself was evaluated.
    pub evaluated: Vec<f64>,
}

/// Relative accuracy to which the responses of a monotonic model are monotonic.
const ACCURACY: f64 = 1e-11;

/// Number of intervals of the first round.
const COARSE: usize = 32;

/// The responses at `separations` (d/sigma). Nominal pressure and area ratio have a relative error of at most
/// `tolerance`.
///
/// Pressure and area of a monotonic model ([`Model::is_monotonic`]) lie, between two separations, between their values
/// there. The model is therefore evaluated at so many separations that from each to the next both change by at most
/// `tolerance`, and the response is interpolated linearly between them. A change by the factor f over the curve takes
/// about ln(f)/`tolerance` evaluations; where that would be more than half of the separations, or the model is not known
/// to be monotonic, the responses are those of [`Model::respond_all`].
///
/// The shares of the regimes, the contact density, the stiffness and the standard errors are interpolated too; no bound
/// holds for these.
pub fn respond_within(model: &dyn Model, separations: &[f64], tolerance: f64) -> Curve {
    let count = separations.len();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| separations[a].total_cmp(&separations[b]));
    let ascending: Vec<f64> = order.iter().map(|&k| separations[k]).collect();
    let is_bounded = tolerance > ACCURACY && count > 2 * COARSE && model.is_monotonic();
    let Some(nodes) = is_bounded.then(|| refine(model, &ascending, tolerance)).flatten() else {
        return Curve { responses: model.respond_all(separations), evaluated: separations.to_vec() };
    };
    let sigma = model.plane().sigma;
    // Every other one is overwritten below.
    let mut responses = vec![nodes[0].response; count];
    for node in &nodes {
        responses[order[node.place]] = node.response;
    }
    for pair in nodes.windows(2) {
        let [near, far] = [&pair[0].response, &pair[1].response];
        let from = near.separation_over_sigma;
        let length = far.separation_over_sigma - from;
        for &k in &order[pair[0].place + 1..pair[1].place] {
            let h = separations[k];
            let t = if length > 0.0 { (h - from) / length } else { 0.0 };
            responses[k] =
                Response { separation_over_sigma: h, separation: h * sigma, ..between(near, far, t) };
        }
    }
    let evaluated = nodes.iter().map(|node| node.response.separation_over_sigma).collect();
    Curve { responses, evaluated }
}

/// A response of the model.
struct Node {
    /// Index among the ascending separations.
    place: usize,
    response: Response,
}

/// Responses at some of the `ascending` separations, the first and the last among them. From each to the next load and
/// area change by at most `tolerance`, or no separation lies between them. `None` if the first of them show that more
/// than half of the separations are required.
fn refine(model: &dyn Model, ascending: &[f64], tolerance: f64) -> Option<Vec<Node>> {
    let evaluate = |places: &[usize]| {
        let separations: Vec<f64> = places.iter().map(|&place| ascending[place]).collect();
        let responses = model.respond_all(&separations).into_iter();
        responses.zip(places.to_vec()).map(|(response, place)| Node { place, response })
    };
    let required = |nodes: &[Node]| -> Vec<usize> {
        let between = nodes.windows(2).flat_map(|pair| {
            let step = step(&pair[0], &pair[1], tolerance);
            (pair[0].place..pair[1].place).step_by(step).skip(1)
        });
        between.collect()
    };
    let last = ascending.len() - 1;
    let coarse: Vec<usize> = (0..=COARSE).map(|k| k * last / COARSE).collect();
    let mut nodes: Vec<Node> = evaluate(&coarse).collect();
    let mut places = required(&nodes);
    if 2 * (nodes.len() + places.len()) > ascending.len() {
        return None;
    }
    while !places.is_empty() {
        nodes.extend(evaluate(&places));
        nodes.sort_by_key(|node| node.place);
        places = required(&nodes);
    }
    Some(nodes)
}

/// The number of places from one to the next, so that load and area are expected to change by at most `tolerance` over
/// it between `near` and `far`: all places between these where they do not change by more.
fn step(near: &Node, far: &Node, tolerance: f64) -> usize {
    /// More places than a uniform change requires: a round costs more than a few places.
    const MARGIN: f64 = 1.1;
    let bound = tolerance - ACCURACY;
    let places = far.place - near.place;
    let intervals = |of: fn(&Response) -> f64| {
        let [near, far] = [of(&near.response), of(&far.response)];
        if near <= (1.0 + bound) * far {
            return 1.0;
        }
        // Infinitely many where contact begins; at least two, so that a jump is found by bisection.
        (MARGIN * (near / far).ln() / bound.ln_1p()).max(2.0)
    };
    let [load, area] =
        [intervals(|response| response.pressure.total()), intervals(|response| response.area_ratio.total())];
    ((places as f64 / load.max(area)) as usize).max(1)
}

/// The response at the fraction `t` of the way from `near` to `far`: every quantity linearly, so that the parts of the
/// regimes add up to totals between those of `near` and `far`.
fn between(near: &Response, far: &Response, t: f64) -> Response {
    // In this form equal denormal numbers stay equal, and nothing becomes negative.
    let mix = |near: f64, far: f64| near + t * (far - near);
    let parts = |ByRegime(near): ByRegime, ByRegime(far): ByRegime| {
        ByRegime(std::array::from_fn(|k| mix(near[k], far[k])))
    };
    let sampling = near.sampling.zip(far.sampling).map(|(near, far)| SamplingError {
        pressure: mix(near.pressure, far.pressure),
        area_ratio: mix(near.area_ratio, far.area_ratio),
    });
    let sharing = near.sharing.zip(far.sharing).map(|(near, far)| LoadSharing {
        effective_contacts: mix(near.effective_contacts, far.effective_contacts),
        largest_share: mix(near.largest_share, far.largest_share),
        large_strain_share: mix(near.large_strain_share, far.large_strain_share),
    });
    Response {
        separation_over_sigma: mix(near.separation_over_sigma, far.separation_over_sigma),
        separation: mix(near.separation, far.separation),
        contact_density: mix(near.contact_density, far.contact_density),
        area_ratio: parts(near.area_ratio, far.area_ratio),
        pressure: parts(near.pressure, far.pressure),
        stiffness: mix(near.stiffness, far.stiffness),
        spots: std::array::from_fn(|k| mix(near.spots[k], far.spots[k])),
        sampling,
        sharing,
    }
}
