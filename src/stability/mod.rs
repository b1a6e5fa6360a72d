//! How far `f64` is off: thousands of scenes, random ones and such as look for trouble, each judged by an evaluation of
//! about 32 digits that shares nothing with the models.
//!
//! | file | what lives there |
//! |---|---|
//! | `family` | the families of scenes, and how far each may be off |
//! | `bodies` | bodies and law of a scene |
//! | `scenes` | the scenes themselves, each from the seed, its family and its number |
//! | [`exact`] | the same answers in about 32 digits |
//! | `judge` | how far an answer is off |
//! | `maps` | errors over a plane |

mod bodies;
pub mod exact;
mod family;
mod judge;
mod maps;
mod scenes;
pub mod wide;

pub use bodies::{Bodies, Law, Layer};
pub use family::{Family, Kind};
pub use judge::{Deviation, Fault, Judgement, Quantity};
pub use maps::Map;
pub use scenes::{Asked, Heights, Scene, SetWords};

use rayon::prelude::*;

/// What random numbers are drawn from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ranges {
    /// d/sigma.
    pub separation: [f64; 2],
    /// Radius over sigma.
    pub radius_over_sigma: [f64; 2],
    /// H/E*.
    pub hardness_over_modulus: [f64; 2],
    /// Of a layer, m.
    pub thickness: [f64; 2],
}

impl Default for Ranges {
    /// The whole representable range.
    fn default() -> Self {
        Self {
            separation: [-20.0, 37.0],
            radius_over_sigma: [1e-3, 1e9],
            hardness_over_modulus: [1e-6, 1.0],
            thickness: [1e-15, 1.0],
        }
    }
}

/// Scenes of each family, by what they ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    /// Of each family of single contacts; a quarter of it under a layer.
    pub contacts: u64,
    /// Of each family of sums.
    pub sums: u64,
    /// Of each family of integrals.
    pub integrals: u64,
    /// Of each family of load control.
    pub loads: u64,
    /// Of each family of a million asperities.
    pub millions: u64,
}

impl Default for Counts {
    fn default() -> Self {
        Self { contacts: 1000, sums: 200, integrals: 250, loads: 50, millions: 3 }
    }
}

impl Counts {
    /// Scenes of a family.
    pub fn of(&self, family: Family) -> u64 {
        match family.kind() {
            _ if family.is_large() => self.millions,
            // The tables of a layer cost as much as hundreds of contacts.
            Kind::Contact if family.is_layered() => self.contacts.div_ceil(4),
            Kind::Contact => self.contacts,
            Kind::Sum => self.sums,
            Kind::Integral => self.integrals,
            Kind::Load => self.loads,
        }
    }

    /// Scenes of all families.
    pub fn total(&self) -> u64 {
        Family::ALL.into_iter().map(|family| self.of(family)).sum()
    }
}

/// What came of the scenes of a family.
#[derive(Debug, Clone)]
pub struct FamilyFindings {
    /// Which.
    pub family: Family,
    /// How many scenes were judged.
    pub scenes: u64,
    /// Quantity by quantity.
    pub quantities: Vec<Worst>,
    /// Scenes that could not be judged as right, and why.
    pub faults: Vec<(Scene, Fault)>,
}

impl FamilyFindings {
    /// Whether every quantity of every scene is within its bound.
    pub fn holds(&self) -> bool {
        self.faults.is_empty() && self.quantities.iter().all(|worst| worst.judged <= worst.bound(self.family))
    }
}

impl Worst {
    /// How far the quantity may be off in its scene.
    pub fn bound(&self, family: Family) -> f64 {
        family.bound(self.quantity, self.scene.bodies.law)
    }
}

/// The worst of one quantity.
#[derive(Debug, Clone)]
pub struct Worst {
    /// Which.
    pub quantity: Quantity,
    /// Half of the scenes are not further off than this, as judged.
    pub median: f64,
    /// The worst, as judged.
    pub judged: f64,
    /// The scene of that.
    pub scene: Scene,
    /// The largest plain error, separations within their rounding not counted as right.
    pub error: f64,
}

/// Judges `count` scenes of one family.
pub fn family(family: Family, count: u64, seed: [u8; 32], ranges: &Ranges) -> FamilyFindings {
    let maker = scenes::Maker { seed, ranges };
    let judged: Vec<Judgement> =
        (0..count).into_par_iter().map(|index| judge::judge(maker.scene(family, index))).collect();
    let mut findings = FamilyFindings { family, scenes: count, quantities: Vec::new(), faults: Vec::new() };
    for quantity in Quantity::ALL {
        let mut all: Vec<(f64, &Scene)> = Vec::new();
        let mut error = 0.0f64;
        for Judgement { scene, outcome } in &judged {
            let of = outcome.iter().flatten().filter(|deviation| deviation.quantity == quantity);
            for deviation in of {
                all.push((deviation.judged, scene));
                error = error.max(deviation.error);
            }
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Bounds are those of a scene's law.
        let share = |(judged, scene): &(f64, &Scene)| judged / family.bound(quantity, scene.bodies.law);
        if let Some((judged, scene)) = all.iter().max_by(|a, b| share(a).total_cmp(&share(b))) {
            let median = all[all.len() / 2].0;
            let (judged, scene) = (*judged, (*scene).clone());
            findings.quantities.push(Worst { quantity, median, judged, scene, error });
        }
    }
    let faults = judged.into_iter().filter_map(|judged| Some((judged.scene, judged.outcome.err()?)));
    findings.faults.extend(faults);
    findings
}

/// Errors over the planes of the report, with so many cells along each.
pub fn maps(ranges: &Ranges, resolution: usize) -> Vec<Map> {
    maps::maps(ranges, resolution)
}
