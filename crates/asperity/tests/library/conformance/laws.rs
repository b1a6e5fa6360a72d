//! The list of all laws and what their documentation states.

use std::f64::consts::PI;

use asperity::contact::{Contact, Regime};
use asperity::interface::{Flat, MicroContact};
use asperity::law::{
    Ceb, FullyPlastic, Hertz, Inapplicable, JacksonGreen, KogutEtsion, Law, Pair, Property, ScalableLaw,
    YieldLimits, Zmc,
};
use asperity::material::Material;

/// A law, which one it may be.
pub trait AnyLaw {
    fn contact(&self, w: f64, b: f64, pair: &Pair) -> Contact;
    fn critical_ratios(&self, pair: &Pair) -> Vec<f64>;
    fn jumps(&self, pair: &Pair) -> Vec<f64>;
    fn highest_load(&self, from: f64, to: f64, b: f64, pair: &Pair) -> f64;
    fn tuned(&self, pair: &Pair) -> Box<dyn AnyLaw>;
    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property>;
    fn between(&self, rough: &Material, flat: &Material) -> Result<Pair, Inapplicable>;
    fn on(&self, flat: &Flat, rough: &Material) -> Result<Box<dyn MicroContact>, Inapplicable>;
}

/// A law and how it is put on a flat.
struct On<L>(L, OnFlat<L>);

type OnFlat<L> = fn(&L, &Flat, &Material) -> Result<Box<dyn MicroContact>, Inapplicable>;

impl<L: Law> AnyLaw for On<L> {
    fn contact(&self, w: f64, b: f64, pair: &Pair) -> Contact {
        self.0.contact(w, b, pair)
    }
    fn critical_ratios(&self, pair: &Pair) -> Vec<f64> {
        self.0.critical_ratios(pair)
    }
    fn jumps(&self, pair: &Pair) -> Vec<f64> {
        self.0.jumps(pair)
    }
    fn highest_load(&self, from: f64, to: f64, b: f64, pair: &Pair) -> f64 {
        self.0.highest_load(from, to, b, pair)
    }
    fn tuned(&self, pair: &Pair) -> Box<dyn AnyLaw> {
        Box::new(Self(self.0.clone().tuned(pair), self.1))
    }
    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property> {
        self.0.yield_limits(body)
    }
    fn between(&self, rough: &Material, flat: &Material) -> Result<Pair, Inapplicable> {
        Pair::between(&self.0, rough, flat)
    }
    fn on(&self, flat: &Flat, rough: &Material) -> Result<Box<dyn MicroContact>, Inapplicable> {
        (self.1)(&self.0, flat, rough)
    }
}

/// Where one formula gives way to another.
pub struct Boundary {
    /// (w/b) (E*/onset)^2.
    pub place: f64,
    /// Of the formula behind it.
    pub regime: Regime,
    /// Load and area behind it over those before it.
    pub jumps: fn(&Pair) -> [f64; 2],
}

/// A law and what it says of itself.
pub struct Entry {
    pub label: &'static str,
    pub law: Box<dyn AnyLaw>,
    /// Of the first formula.
    pub first: Regime,
    pub boundaries: Vec<Boundary>,
    /// Poisson's ratio, and the jumps of the load to the digits that the documentation gives, one a boundary, where next
    /// to the radius everything is small.
    pub digits: Vec<(f64, Vec<&'static str>)>,
    /// What one of the two bodies must have.
    pub needs: Option<Property>,
    /// What a body must have that has a hardness.
    pub needs_beside_hardness: Option<Property>,
    /// The largest strength over E*.
    pub strongest: f64,
    /// Whether a layer of finite thickness may lie on the flat.
    pub stands_under_layers: bool,
}

impl Entry {
    fn scalable<L: ScalableLaw>(label: &'static str, law: L, first: Regime) -> Self {
        let on = On(law, |law, flat, rough| flat.under(law.clone(), rough));
        Self::new(label, Box::new(on), first, true)
    }

    fn homogeneous<L: Law>(label: &'static str, law: L, first: Regime) -> Self {
        let on = On(law, |law, flat, rough| flat.homogeneous_under(law.clone(), rough));
        Self::new(label, Box::new(on), first, false)
    }

    fn new(label: &'static str, law: Box<dyn AnyLaw>, first: Regime, stands_under_layers: bool) -> Self {
        Self {
            label,
            law,
            first,
            boundaries: Vec::new(),
            digits: Vec::new(),
            needs: None,
            needs_beside_hardness: None,
            strongest: f64::INFINITY,
            stands_under_layers,
        }
    }

    fn needing(self, property: Property) -> Self {
        Self { needs: Some(property), ..self }
    }

    fn then(mut self, place: f64, regime: Regime, jumps: fn(&Pair) -> [f64; 2]) -> Self {
        self.boundaries.push(Boundary { place, regime, jumps });
        self
    }

    fn stating(mut self, poisson: f64, loads: &[&'static str]) -> Self {
        self.digits.push((poisson, loads.to_vec()));
        self
    }

    /// The regimes of all formulas, in order.
    pub fn regimes(&self) -> Vec<Regime> {
        [self.first].into_iter().chain(self.boundaries.iter().map(|boundary| boundary.regime)).collect()
    }

    /// Which formula holds at (w/b) (E*/onset)^2 = `u`.
    pub fn formula(&self, u: f64) -> usize {
        self.boundaries.iter().filter(|boundary| u >= boundary.place).count()
    }
}

/// Neither load nor area jumps.
fn smooth(_: &Pair) -> [f64; 2] {
    [1.0, 1.0]
}

/// ZMC with its stated options.
fn zmc(label: &'static str, onset: f64, ratio: f64, jumps: fn(&Pair) -> [f64; 2]) -> Entry {
    let law = Zmc::new(onset, ratio).unwrap();
    Entry::scalable(label, law, Regime::Elastic).then(onset, Regime::ElasticPlastic, jumps).then(
        ratio * onset,
        Regime::Plastic,
        smooth,
    )
}

/// wc/b over (onset/E*)^2 of all laws that begin as Chang, Etsion and Bogy's does.
const CRITICAL: f64 = PI * PI / 4.0;

fn kogut_etsion() -> Entry {
    let fully_plastic = |pair: &Pair| {
        let YieldLimits { onset, strength } = pair.yield_limits;
        [
            3.0 * strength / onset * 110.0 / (1.40 * 110f64.powf(1.263)),
            2.0 * 110.0 / (0.94 * 110f64.powf(1.146)),
        ]
    };
    Entry::scalable("kogut-etsion", KogutEtsion, Regime::Elastic)
        .needing(Property::Hardness)
        .then(CRITICAL, Regime::ElasticPlastic, |_| [1.03, 0.93])
        .then(6.0 * CRITICAL, Regime::ElasticPlastic, |_| {
            [1.40 / 1.03 * 6f64.powf(1.263 - 1.425), 0.94 / 0.93 * 6f64.powf(1.146 - 1.136)]
        })
        .then(110.0 * CRITICAL, Regime::Plastic, fully_plastic)
        .stating(0.0, &["1.03", "1.0168", "1.3710"])
        .stating(0.3, &["1.03", "1.0168", "1.0788"])
        .stating(0.4108, &["1.03", "1.0168", "1.000"])
}

fn jackson_green() -> Entry {
    let jumps = |pair: &Pair| {
        let YieldLimits { onset, strength } = pair.yield_limits;
        let u: f64 = 1.9;
        let width = PI * onset / (2.0 * pair.reduced_modulus) * u.sqrt();
        let hardness = 2.84 * strength * (1.0 - (-0.82 * width.powf(-0.7)).exp());
        let plastic = 4.0 * hardness / onset * (1.0 - (-u.powf(5.0 / 9.0) / 25.0).exp()) / u.sqrt();
        [(-u.powf(5.0 / 12.0) / 4.0).exp() + plastic, 1.0]
    };
    let entry = Entry::homogeneous("jackson-green", JacksonGreen::default(), Regime::Elastic)
        .needing(Property::YieldStrength)
        .then(1.9 * CRITICAL, Regime::ElasticPlastic, jumps)
        .stating(0.0, &["1.0748"])
        .stating(0.3, &["1.0047"])
        .stating(0.3229, &["1.0000"])
        .stating(0.49, &["0.9678"]);
    Entry { strongest: 0.065, needs_beside_hardness: Some(Property::YieldStrength), ..entry }
}

/// A law added here is tested by the whole suite.
pub fn all() -> Vec<Entry> {
    vec![
        Entry::scalable("hertz", Hertz, Regime::Elastic),
        zmc("zmc", Zmc::ONSET, 54.0, smooth).stating(0.3, &["1", "1"]),
        zmc("zmc, 110", Zmc::ONSET, 110.0, smooth),
        zmc("zmc, wide", Zmc::ONSET, 1e4, smooth),
        zmc("zmc, narrow", Zmc::ONSET, 1.01, smooth),
        zmc("zmc, rounded", 0.89, 54.0, |_| [0.3 * PI / 0.89f64.sqrt(), 1.0])
            .stating(0.3, &["0.999024", "1"]),
        zmc("zmc, early", 0.4, 54.0, |_| [0.3 * PI / 0.4f64.sqrt(), 1.0]),
        zmc("zmc, late", 100.0, 54.0, |_| [0.03 * PI, 1.0]),
        Entry::scalable("ceb", Ceb, Regime::Elastic)
            .needing(Property::Hardness)
            .then(CRITICAL, Regime::ElasticPlastic, |_| [1.5, 1.0])
            .stating(0.3, &["1.5"]),
        kogut_etsion(),
        jackson_green(),
        Entry::scalable("fully-plastic", FullyPlastic, Regime::Plastic).needing(Property::Hardness),
    ]
}
