//! Convergence of the deterministic model to the statistical one as the number of asperities grows, for equal radii and
//! heights drawn from the density of the integral.

use crate::asperity::{AsperitySet, Draw, Population, SetError};
use crate::interface::MicroContact;
use crate::model::{Deterministic, Model, ReferencePlane, Response};

use crate::model::MIN_CONTACTS;

/// One law with its exact responses.
pub struct LimitCase<'a> {
    /// The law, as tables name it.
    pub law: String,
    /// The micro-contact.
    pub contact: &'a dyn MicroContact,
    /// The limit of the sum at each separation.
    pub exact: Vec<Exact>,
}

/// The limit at one separation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exact {
    /// Response of the statistical model.
    pub statistical: Response,
    /// Fraction of asperities in contact.
    pub contact_fraction: f64,
    /// Real over nominal area.
    pub area_ratio: f64,
    /// Nominal pressure, Pa.
    pub pressure: f64,
}

impl Exact {
    /// The integral itself as the limit, with `density` asperities per nominal area (1/m^2).
    pub fn of_integral(statistical: Response, density: f64) -> Self {
        Self {
            statistical,
            contact_fraction: statistical.contact_density / density,
            area_ratio: statistical.area_ratio.total(),
            pressure: statistical.pressure.total(),
        }
    }
}

/// Sets of one size at one separation under one law.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitPoint {
    /// The law, as tables name it.
    pub law: String,
    /// The limit of the sets' responses.
    pub exact: Exact,
    /// Asperities in a set.
    pub count: usize,
    /// Response of each random set.
    pub random: Vec<Response>,
    /// Response of the set with heights at the quantiles.
    pub quantiles: Response,
}

/// A quantity whose error is evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Real contact area.
    Area,
    /// Load.
    Load,
}

impl Quantity {
    /// Both quantities.
    pub const ALL: [Self; 2] = [Self::Area, Self::Load];

    /// As tables name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Load => "load",
        }
    }
}

impl LimitPoint {
    /// Expected number of contacts.
    pub fn expected_contacts(&self) -> f64 {
        self.exact.contact_fraction * self.count as f64
    }

    /// Whether enough contacts are expected for the errors to follow their power law.
    pub fn is_fitted(&self) -> bool {
        self.expected_contacts() > MIN_CONTACTS
    }

    /// Signed relative error of one response.
    pub fn error(&self, response: &Response, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Area => response.area_ratio.total() / self.exact.area_ratio - 1.0,
            Quantity::Load => response.pressure.total() / self.exact.pressure - 1.0,
        }
    }

    /// Mean and root mean square of the random sets' relative errors.
    pub fn scatter(&self, quantity: Quantity) -> (f64, f64) {
        let count = self.random.len() as f64;
        let errors = || self.random.iter().map(|response| self.error(response, quantity));
        (errors().sum::<f64>() / count, (errors().map(|error| error * error).sum::<f64>() / count).sqrt())
    }

    /// Magnitude of the relative error of the set with heights at the quantiles.
    pub fn quantile_error(&self, quantity: Quantity) -> f64 {
        self.error(&self.quantiles, quantity).abs()
    }
}

/// A power law fitted to errors: ln(error) = constant + slope ln(count).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlopeFit {
    /// The exponent.
    pub slope: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Points fitted.
    pub points: usize,
}

impl SlopeFit {
    /// Least squares through (count, error); `None` with fewer than three positive errors.
    pub fn through(points: impl Iterator<Item = (f64, f64)>) -> Option<Self> {
        let logs: Vec<(f64, f64)> =
            points.filter(|(_, error)| *error > 0.0).map(|(count, error)| (count.ln(), error.ln())).collect();
        let n = logs.len() as f64;
        if logs.len() < 3 {
            return None;
        }
        let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
        let (x0, y0) = (mean(|p| p.0), mean(|p| p.1));
        let xx: f64 = logs.iter().map(|p| (p.0 - x0).powi(2)).sum();
        let xy: f64 = logs.iter().map(|p| (p.0 - x0) * (p.1 - y0)).sum();
        let slope = xy / xx;
        let residual: f64 = logs.iter().map(|p| (p.1 - y0 - slope * (p.0 - x0)).powi(2)).sum();
        let standard_error = (residual / (n - 2.0) / xx).sqrt();
        slope.is_finite().then_some(Self { slope, standard_error, points: logs.len() })
    }
}

/// Responses of sets of `counts` asperities of `population` under every law at every separation: `draws` random sets of
/// each size and one at the quantiles. `seed(count, draw)` is the seed of a random set; `done` is called after each
/// set.
///
/// # Errors
/// See [`Population::set`].
pub fn convergence(
    cases: &[LimitCase],
    population: &Population,
    counts: &[usize],
    draws: usize,
    seed: impl Fn(usize, usize) -> [u8; 32],
    done: impl Fn(usize),
) -> Result<Vec<LimitPoint>, SetError> {
    let plane = ReferencePlane { mean: 0.0, sigma: population.sigma };
    let mut points = Vec::new();
    for &count in counts {
        let random = (0..draws).map(|k| Draw::Random(seed(count, k)));
        // One set at a time, under every law at every separation.
        let mut responses = Vec::with_capacity(draws + 1);
        for draw in random.chain([Draw::Quantiles]) {
            let set = population.set(count, draw)?;
            responses
                .push(cases.iter().flat_map(|case| respond_to_set(case, &set, plane)).collect::<Vec<_>>());
            done(count);
        }
        let Some(quantiles) = responses.pop() else { continue };
        let limits = cases.iter().flat_map(|case| case.exact.iter().map(|exact| (&case.law, exact)));
        for (k, (law, exact)) in limits.enumerate() {
            points.push(LimitPoint {
                law: law.clone(),
                exact: *exact,
                count,
                random: responses.iter().map(|set| set[k]).collect(),
                quantiles: quantiles[k],
            });
        }
    }
    Ok(points)
}

fn respond_to_set(case: &LimitCase, set: &AsperitySet, plane: ReferencePlane) -> Vec<Response> {
    let separations: Vec<f64> =
        case.exact.iter().map(|exact| exact.statistical.separation_over_sigma).collect();
    Deterministic::new(case.contact, set.spheres(), plane).respond_all(&separations)
}
