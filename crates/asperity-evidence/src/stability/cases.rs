//! Cases: random ones over the whole representable range, and adversarial groups.

use std::iter::repeat_n;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::groups::Group;
use crate::exact::{Bodies, COVERED, CoveredLaw, Layer, TWINS};
use asperity::contact_law::registry;
use asperity::law::Property;
use asperity::{Heights, Material, ModulusModel, Population, Shape, reduced_modulus};

#[derive(Debug, Clone)]
pub struct Case {
    pub group: Group,
    pub index: u64,
    pub bodies: Bodies,
    pub input: CaseInput,
}

/// Input of a case besides the bodies; lengths in m.
#[derive(Debug, Clone)]
pub enum CaseInput {
    Contact {
        w: f64,
        radius: f64,
    },
    Ellipse {
        w: f64,
        /// (kmax + kmin)/2, 1/m.
        mean_curvature: f64,
        /// kmax/kmin.
        ratio: f64,
    },
    Sum(SetParameters, f64),
    Integral(Population, f64),
    /// The pressure of an integral at a separation, to be reached again.
    LoadOfIntegral(Population, f64),
    /// The pressure of a sum at a separation, to be reached again.
    LoadOfSum(SetParameters, f64),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    Gaussian,
    /// Evenly spaced from -3 to 3 sigma about the mean.
    Line,
    /// All the same: the mean.
    Equal,
    /// So near to the flat that its own rounding decides which touch.
    Touching,
}

/// A set by a few numbers; its heights and radii are drawn from `seed`.
#[derive(Debug, Clone, Copy)]
pub struct SetParameters {
    pub heights: Layout,
    pub count: usize,
    /// Of the heights, m.
    pub mean: f64,
    /// What separations are in, m.
    pub sigma: f64,
    /// Radii are from half to twice this, m; all equal for equal heights.
    pub radius: f64,
    pub seed: u64,
}

impl SetParameters {
    /// Layout and radii, m, for the separation `h`.
    pub fn asperities(&self, h: f64) -> Vec<(f64, f64)> {
        let mut rng = CaseRng(ChaCha8Rng::seed_from_u64(self.seed));
        let flat = self.mean + h * self.sigma;
        (0..self.count)
            .map(|k| {
                let height = match self.heights {
                    Layout::Gaussian => self.mean + self.sigma * rng.normal(),
                    Layout::Line => {
                        self.mean + self.sigma * (6.0 * k as f64 / (self.count - 1).max(1) as f64 - 3.0)
                    }
                    Layout::Equal => self.mean,
                    // The first is well above the flat.
                    Layout::Touching if k == 0 => flat + self.sigma,
                    Layout::Touching => flat + (rng.below(9) as f64 - 4.0) * f64::EPSILON * flat.abs(),
                };
                let radius = match self.heights {
                    Layout::Equal => self.radius,
                    _ => self.radius * rng.between(-1.0, 1.0).exp2(),
                };
                (height, radius)
            })
            .collect()
    }
}

struct CaseRng(ChaCha8Rng);

impl CaseRng {
    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.0.random::<f64>()
    }

    fn ratio(&mut self, [from, to]: [f64; 2]) -> f64 {
        self.between(from.ln(), to.ln()).exp().clamp(from, to)
    }

    fn below(&mut self, count: usize) -> usize {
        ((self.0.random::<f64>() * count as f64) as usize).min(count - 1)
    }

    fn chance(&mut self, probability: f64) -> bool {
        self.0.random::<f64>() < probability
    }

    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.0.random::<f64>()).ln()).sqrt();
        radius * self.between(0.0, std::f64::consts::TAU).cos()
    }
}

pub const SEPARATIONS: [f64; 2] = [-20.0, 37.0];
pub const RADIUS_OVER_SIGMA: [f64; 2] = [1e-3, 1e9];
pub const HARDNESS_OVER_MODULUS: [f64; 2] = [1e-6, 1.0];
/// Of a layer, m.
pub const THICKNESSES: [f64; 2] = [1e-15, 1.0];
const YOUNG: [f64; 2] = [1e6, 1e13];
const SIGMA: [f64; 2] = [1e-9, 1e-5];
/// density * radius * sigma.
const CROWDING: f64 = 0.03;
/// Most asperities of a set that is checked asperity by asperity.
const FEW: [f64; 2] = [1.0, 300.0];
/// Y/E* that every law takes.
const STRONGEST: f64 = 0.06;

/// The case `index` of a group: it depends on the seed, the group and the index alone.
pub(super) fn case(mut seed: [u8; 32], group: Group, index: u64) -> Case {
    for (byte, of) in seed.iter_mut().zip(group.name().bytes()) {
        *byte ^= of;
    }
    let mut rng = ChaCha8Rng::from_seed(seed);
    rng.set_stream(index);
    let mut rng = CaseRng(rng);
    let bodies = bodies(&mut rng, group);
    let input = input(&mut rng, group, &bodies);
    let (bodies, input) = meet(&mut rng, group, bodies, input);
    Case { group, index, bodies, input }
}

fn bodies(rng: &mut CaseRng, group: Group) -> Bodies {
    let layered = group.is_layered();
    let law = if group == Group::Ellipses {
        let elliptic = registry().iter().filter(|law| law.is_elliptic()).filter_map(CoveredLaw::new);
        let mut laws: Vec<CoveredLaw> = elliptic.map(|law| with_options(rng, law)).collect();
        laws.swap_remove(rng.below(laws.len()))
    } else {
        law(rng, layered)
    };
    let young = rng.ratio(YOUNG);
    let body = |rng: &mut CaseRng| {
        let young = (young * rng.ratio([1e-3, 1e3])).clamp(YOUNG[0], YOUNG[1]);
        match Material::new(young, rng.between(0.0, 0.4999), None, None) {
            Ok(body) => body,
            Err(_) => unreachable!("both are within their ranges"),
        }
    };
    let (rough, flat, layer) = (body(rng), body(rng), body(rng));
    let modulus = reduced_modulus(&rough, &flat);
    let hardness = modulus * rng.ratio(HARDNESS_OVER_MODULUS);
    let harden = |rng: &mut CaseRng, body: Material| {
        let hardness = (hardness * rng.ratio([1e-2, 1e2]))
            .clamp(modulus * HARDNESS_OVER_MODULUS[0], modulus * HARDNESS_OVER_MODULUS[1]);
        let strength = match law.chosen().law().yields_by() {
            Some(Property::YieldStrength) => Some((hardness / 2.8).min(STRONGEST * modulus)),
            _ => rng.chance(0.5).then(|| hardness / rng.between(2.0, 4.0)),
        };
        Material::new(body.young(), body.poisson(), Some(hardness), strength).unwrap_or(body)
    };
    let alone = rng.below(8);
    let rough = if alone == 0 { rough } else { harden(rng, rough) };
    let (flat, layer) = if alone == 1 { (flat, layer) } else { (harden(rng, flat), harden(rng, layer)) };
    let layer = layered.then(|| Layer {
        material: layer,
        thickness: rng.ratio(THICKNESSES),
        rule: ModulusModel::ALL[rng.below(2)],
    });
    Bodies { law, rough, flat, layer }
}

fn input(rng: &mut CaseRng, group: Group, bodies: &Bodies) -> CaseInput {
    let sigma = rng.ratio(SIGMA);
    let radius = sigma * rng.ratio(RADIUS_OVER_SIGMA);
    let heights = if group == Group::OtherHeights {
        let covered = COVERED.iter().map(|density| density.heights.clone());
        let mut others: Vec<Heights> = covered.filter(|heights| *heights != Heights::GAUSSIAN).collect();
        others.swap_remove(rng.below(others.len()))
    } else {
        Heights::GAUSSIAN
    };
    let population = Population { radius, sigma, density: CROWDING / (radius * sigma), heights };
    let [nearest, furthest] = SEPARATIONS;
    let within = |rng: &mut CaseRng, from: f64, to: f64| {
        rng.between(from.clamp(nearest, furthest), to.clamp(nearest, furthest))
    };
    let set = |rng: &mut CaseRng, heights: Layout| SetParameters {
        heights,
        count: rng.ratio(FEW).round() as usize,
        mean: 0.0,
        sigma,
        radius,
        seed: rng.0.random::<u64>(),
    };
    match group {
        Group::Contacts | Group::LayeredContacts | Group::Boundaries | Group::LayeredBoundaries => {
            CaseInput::Contact { w: indentation(rng, bodies, radius), radius }
        }
        Group::Scales => CaseInput::Contact { w: radius * rng.ratio([1e-12, 1.0]), radius },
        Group::Ellipses => CaseInput::Ellipse {
            w: radius * rng.ratio([1e-12, 1.0]),
            mean_curvature: radius.recip(),
            ratio: if rng.chance(0.1) { 1.0 + rng.ratio([1e-15, 1e-3]) } else { rng.ratio([1.0, 1e12]) },
        },
        Group::Denormals => {
            let w = if rng.chance(0.2) {
                f64::from_bits(rng.below(20) as u64 + 1)
            } else {
                f64::MIN_POSITIVE * rng.ratio([1e-15, 1e15])
            };
            CaseInput::Contact { w, radius }
        }
        Group::Sums | Group::LayeredSums => {
            CaseInput::Sum(set(rng, Layout::Gaussian), within(rng, -3.0, 3.0))
        }
        Group::OneAsperity => {
            CaseInput::Sum(SetParameters { count: 1, ..set(rng, Layout::Equal) }, -rng.ratio([1e-12, 20.0]))
        }
        Group::Offset => {
            let sign = if rng.chance(0.5) { 1.0 } else { -1.0 };
            let mean = sign * sigma * rng.ratio([1.0, 1e8]);
            CaseInput::Sum(SetParameters { mean, ..set(rng, Layout::Gaussian) }, within(rng, -3.0, 2.0))
        }
        Group::Line => CaseInput::Sum(set(rng, Layout::Line), within(rng, -4.0, 3.0)),
        Group::Touching => CaseInput::Sum(set(rng, Layout::Touching), within(rng, -4.0, 4.0)),
        Group::Equal => CaseInput::Sum(set(rng, Layout::Equal), -rng.ratio([1e-6, 20.0])),
        Group::MillionEqual => CaseInput::Sum(
            SetParameters { count: 1_000_000, ..set(rng, Layout::Equal) },
            -rng.ratio([1e-3, 20.0]),
        ),
        Group::MillionLine => CaseInput::Sum(
            SetParameters { count: 1_000_000, ..set(rng, Layout::Line) },
            within(rng, -4.0, 3.0),
        ),
        Group::Integrals | Group::LayeredIntegrals | Group::OtherHeights => {
            CaseInput::Integral(population, within(rng, -10.0, 20.0))
        }
        Group::Deep => CaseInput::Integral(population, within(rng, -20.0, -10.0)),
        Group::Tail => CaseInput::Integral(population, within(rng, 20.0, 35.0)),
        Group::Last => CaseInput::Integral(population, within(rng, 35.0, 37.0)),
        Group::Vanishing => CaseInput::Integral(population, rng.between(37.0, 40.0)),
        Group::LoadsOfIntegrals => CaseInput::LoadOfIntegral(population, within(rng, -8.0, 20.0)),
        Group::LoadsOfSums => CaseInput::LoadOfSum(set(rng, Layout::Gaussian), within(rng, -4.0, 2.0)),
    }
}

/// From far below to far above where the pair of `bodies` begins to yield.
fn indentation(rng: &mut CaseRng, bodies: &Bodies, radius: f64) -> f64 {
    let modulus = reduced_modulus(&bodies.rough, &bodies.flat);
    let hardness =
        [bodies.rough, bodies.flat].iter().filter_map(Material::hardness).fold(f64::INFINITY, f64::min);
    if hardness.is_finite() && rng.chance(0.7) {
        let strain = hardness / modulus;
        radius * strain * strain * rng.ratio([1e-3, 1e6])
    } else {
        radius * rng.ratio([1e-15, 10.0])
    }
}

/// Any law by its weight; ZMC in place of a law without layers.
fn law(rng: &mut CaseRng, layered: bool) -> CoveredLaw {
    let mut twins = TWINS.iter().flat_map(|twin| repeat_n(twin, twin.weight));
    let twin = twins.nth(rng.below(TWINS.iter().map(|twin| twin.weight).sum()));
    let law = twin.and_then(|twin| CoveredLaw::named(twin.name));
    let law = law.filter(|law| !layered || law.chosen().supports_layers());
    with_options(rng, law.unwrap_or_else(CoveredLaw::zmc))
}

/// The law with random options, if it has any that are known here.
fn with_options(rng: &mut CaseRng, law: CoveredLaw) -> CoveredLaw {
    if law.twin.name != "zmc" {
        return law;
    }
    let onset = rng.chance(0.2).then(|| ("onset", rng.between(0.5, 2.0)));
    let transition_ratio = if rng.chance(0.5) { 54.0 } else { rng.ratio([1.01, 1e6]) };
    let options: Vec<(&str, f64)> =
        onset.into_iter().chain([("transition-ratio", transition_ratio)]).collect();
    law.with_options(&options).unwrap_or(law)
}

/// Moves an indentation to within 1e-15 of a boundary, or a thickness to where the weights turn.
fn meet(rng: &mut CaseRng, group: Group, mut bodies: Bodies, mut input: CaseInput) -> (Bodies, CaseInput) {
    let CaseInput::Contact { w, radius } = &mut input else { return (bodies, input) };
    match group {
        Group::Boundaries | Group::LayeredBoundaries => {
            let boundaries = bodies
                .contact()
                .map(|contact| contact.regime_changes(Shape::sphere(*radius)))
                .unwrap_or_default();
            if !boundaries.is_empty() {
                let step = [0.0, 1e-16, 2.3e-16, 4.5e-16, 1e-15][rng.below(5)];
                let sign = if rng.chance(0.5) { 1.0 } else { -1.0 };
                *w = boundaries[rng.below(boundaries.len())] * (1.0 + sign * step);
            }
        }
        Group::Scales => {
            if let Some(layer) = &mut bodies.layer {
                let contact = (*radius * *w).sqrt();
                layer.thickness = match rng.below(4) {
                    0 => contact,
                    1 => contact * (1.0 + rng.between(-1e-15, 1e-15)),
                    2 => contact * rng.ratio([1e-15, 1e15]),
                    _ => *w * rng.ratio([1e-3, 1e3]),
                }
                .clamp(1e-30, 1e30);
            }
        }
        _ => {}
    }
    (bodies, input)
}

impl Case {
    /// Every number that goes in, so that it reads back to the same `f64`.
    pub fn inputs(&self) -> String {
        let Bodies { law, rough, flat, layer } = &self.bodies;
        let body = |name: &str, body: &Material| {
            let yields = [("hardness", body.hardness()), ("yield-strength", body.yield_strength())];
            let yields =
                yields.into_iter().filter_map(|(key, value)| Some(format!(", {key} = {:e}", value?)));
            let (young, poisson) = (body.young(), body.poisson());
            format!("; {name}: young = {young:e}, poisson = {poisson:e}{}", yields.collect::<String>())
        };
        let bodies = body("rough", rough) + &body("flat", flat);
        let layer = layer.as_ref().map(|Layer { material, thickness, rule }| {
            format!("{}, thickness = {thickness:e}, rule {}", body("layer", material), rule.name())
        });
        format!("law {}{bodies}{}; {:?}", law.chosen().label(), layer.unwrap_or_default(), self.input)
    }
}
