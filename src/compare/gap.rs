//! How far apart the two models are, in the words an engineer asks in.

use super::{Pair, Pairing};

/// Fewer contacts than this and the sum tells more about its few highest asperities than about the
/// surface.
pub const FEWEST_CONTACTS: f64 = 30.0;

/// The largest difference of one quantity over all pairs that can be trusted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// The quantity.
    pub quantity: &'static str,
    /// What the models have in common there.
    pub pairing: Pairing,
    /// Its value, Pa or in sigma.
    pub target: f64,
    /// The statistical model's answer.
    pub statistical: f64,
    /// The deterministic model's answer.
    pub deterministic: f64,
    /// The difference over the deterministic model's standard error, where it has one.
    pub over_sampling_error: Option<f64>,
}

impl Gap {
    /// Statistical minus deterministic.
    pub fn difference(&self) -> f64 {
        self.statistical - self.deterministic
    }

    /// Statistical over deterministic.
    pub fn ratio(&self) -> f64 {
        self.statistical / self.deterministic
    }
}

/// The largest gaps among the pairs that neither model's assumptions nor a handful of contacts
/// spoil: real area at most 5 % of the nominal, at least [`FEWEST_CONTACTS`] contacts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gaps {
    /// Number of pairs that count.
    pub pairs: usize,
    /// One for each quantity.
    pub largest: Vec<Gap>,
}

impl Gaps {
    /// The largest gaps of `pairs` on the nominal area `area` (m^2), separations in units of `sigma` (m).
    pub fn of(pairs: &[Pair], area: f64, sigma: f64) -> Self {
        let trusted = |pair: &&Pair| {
            !pair.is_beyond_model() && pair.deterministic.contact_density * area >= FEWEST_CONTACTS
        };
        let counted: Vec<&Pair> = pairs.iter().filter(trusted).collect();
        let largest = |gap_of: &dyn Fn(&Pair) -> Gap, pairing, size: fn(&Gap) -> f64| {
            counted
                .iter()
                .filter(|pair| pair.pairing == pairing)
                .map(|pair| gap_of(pair))
                .max_by(|a, b| size(a).total_cmp(&size(b)))
        };
        let by_ratio: fn(&Gap) -> f64 = |gap| gap.ratio().ln().abs();
        let by_difference: fn(&Gap) -> f64 = |gap| gap.difference().abs();
        Self {
            pairs: counted.len(),
            largest: [
                largest(&|pair| separation_gap(pair, sigma), Pairing::Load, by_difference),
                largest(&area_gap, Pairing::Load, by_ratio),
                largest(&pressure_gap, Pairing::Separation, by_ratio),
            ]
            .into_iter()
            .flatten()
            .collect(),
        }
    }
}

/// At equal load the separations differ by what the sampling error of the pressure, over the
/// stiffness, is the scatter of.
fn separation_gap(pair: &Pair, sigma: f64) -> Gap {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    let error = d.sampling.map(|sampling| sampling.pressure / d.stiffness / sigma);
    gap(pair, "separation_over_sigma", s.separation_over_sigma, d.separation_over_sigma, error)
}

fn area_gap(pair: &Pair) -> Gap {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    // At equal load the scatter of the area is that of the area at equal separation less what the
    // load explains; the larger, simpler bound is used.
    let error = d.sampling.map(|sampling| sampling.area_ratio);
    gap(pair, "area_ratio", s.area_ratio.total(), d.area_ratio.total(), error)
}

fn pressure_gap(pair: &Pair) -> Gap {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    let error = d.sampling.map(|sampling| sampling.pressure);
    gap(pair, "pressure_pa", s.pressure.total(), d.pressure.total(), error)
}

fn gap(pair: &Pair, quantity: &'static str, statistical: f64, deterministic: f64, error: Option<f64>) -> Gap {
    let over_sampling_error =
        error.map(|error| (statistical - deterministic).abs() / error).filter(|ratio| ratio.is_finite());
    Gap {
        quantity,
        pairing: pair.pairing,
        target: pair.target,
        statistical,
        deterministic,
        over_sampling_error,
    }
}
