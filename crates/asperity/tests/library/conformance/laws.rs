//! All laws of the registry, and what their documentation states. Of a law that has no line in [`stated`], only the contract
//! of every law is tested.

use std::f64::consts::PI;

use asperity::contact_law::{named, registry};
use asperity::law::Property;
use asperity::{ContactLaw, Law, Material, Pair, Regime, YieldLimits, Zmc};

use super::own::Abrupt;

/// Where one formula gives way to another.
pub struct Boundary {
    /// (w/b) (E*/onset)^2.
    pub place: f64,
    /// Of the formula behind it.
    pub regime: Regime,
    /// Load and area behind it over those before it, as stated.
    pub jumps: Option<fn(&Pair) -> [f64; 2]>,
}

/// A law and what it says of itself.
pub struct Entry {
    pub label: String,
    pub law: ContactLaw,
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
}

impl Entry {
    /// What the law itself says.
    fn of(law: &ContactLaw) -> Self {
        let pair = Pair { reduced_modulus: 1.0, yield_limits: YieldLimits { onset: 1.0, strength: 1.0 } };
        let places = law.law().critical_ratios(&pair);
        let regime = |place: f64| law.law().contact(place * (1.0 + 1e-12), 1.0, &pair).regime;
        let boundary = |&place: &f64| Boundary { place, regime: regime(place), jumps: None };
        let hard = Material::new(1.0, 0.0, Some(1.0), None).unwrap();
        Self {
            label: law.label(),
            first: regime(1e-12 * places.first().unwrap_or(&1.0)),
            boundaries: places.iter().map(boundary).collect(),
            digits: Vec::new(),
            needs: law.law().needs(),
            needs_beside_hardness: law.law().yield_limits(&hard).err(),
            strongest: f64::INFINITY,
            law: law.clone(),
        }
    }

    /// The law itself.
    pub fn law(&self) -> &dyn Law {
        self.law.law()
    }

    /// As its documentation has it from here on: nothing of it is taken from the law.
    fn begins(self, first: Regime) -> Self {
        Self { first, boundaries: Vec::new(), needs: None, needs_beside_hardness: None, ..self }
    }

    fn needing(self, property: Property) -> Self {
        Self { needs: Some(property), ..self }
    }

    fn then(mut self, place: f64, regime: Regime, jumps: fn(&Pair) -> [f64; 2]) -> Self {
        self.boundaries.push(Boundary { place, regime, jumps: Some(jumps) });
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

/// ZMC, whatever its options.
fn zmc(entry: Entry, onset: f64, ratio: f64, jumps: fn(&Pair) -> [f64; 2]) -> Entry {
    entry.begins(Regime::Elastic).then(onset, Regime::ElasticPlastic, jumps).then(
        ratio * onset,
        Regime::Plastic,
        smooth,
    )
}

/// ZMC with options of its own.
fn zmc_with(label: &str, onset: f64, ratio: f64, jumps: fn(&Pair) -> [f64; 2]) -> Entry {
    let law = named("zmc").unwrap().with_options(&[("onset", onset), ("transition-ratio", ratio)]).unwrap();
    zmc(Entry { label: label.to_owned(), ..Entry::of(&law) }, onset, ratio, jumps)
}

/// wc/b over (onset/E*)^2 of all laws that begin as Chang, Etsion and Bogy's does.
const CRITICAL: f64 = PI * PI / 4.0;

fn kogut_etsion(entry: Entry) -> Entry {
    let fully_plastic = |pair: &Pair| {
        let YieldLimits { onset, strength } = pair.yield_limits;
        [
            3.0 * strength / onset * 110.0 / (1.40 * 110f64.powf(1.263)),
            2.0 * 110.0 / (0.94 * 110f64.powf(1.146)),
        ]
    };
    entry
        .begins(Regime::Elastic)
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

fn jackson_green(entry: Entry) -> Entry {
    let jumps = |pair: &Pair| {
        let YieldLimits { onset, strength } = pair.yield_limits;
        let u: f64 = 1.9;
        let width = PI * onset / (2.0 * pair.reduced_modulus) * u.sqrt();
        let hardness = 2.84 * strength * (1.0 - (-0.82 * width.powf(-0.7)).exp());
        let plastic = 4.0 * hardness / onset * (1.0 - (-u.powf(5.0 / 9.0) / 25.0).exp()) / u.sqrt();
        [(-u.powf(5.0 / 12.0) / 4.0).exp() + plastic, 1.0]
    };
    let entry = entry
        .begins(Regime::Elastic)
        .needing(Property::YieldStrength)
        .then(1.9 * CRITICAL, Regime::ElasticPlastic, jumps)
        .stating(0.0, &["1.0748"])
        .stating(0.3, &["1.0047"])
        .stating(0.3229, &["1.0000"])
        .stating(0.49, &["0.9678"]);
    Entry { strongest: 0.065, needs_beside_hardness: Some(Property::YieldStrength), ..entry }
}

/// What the documentation of a law states, by its name.
fn stated(entry: Entry) -> Entry {
    match entry.label.as_str() {
        "hertz" => entry.begins(Regime::Elastic),
        "zmc" => zmc(entry, Zmc::ONSET, 54.0, smooth).stating(0.3, &["1", "1"]),
        "ceb" => entry
            .begins(Regime::Elastic)
            .needing(Property::Hardness)
            .then(CRITICAL, Regime::ElasticPlastic, |_| [1.5, 1.0])
            .stating(0.3, &["1.5"]),
        "kogut-etsion" => kogut_etsion(entry),
        "jackson-green" => jackson_green(entry),
        "fully-plastic" => entry.begins(Regime::Plastic).needing(Property::Hardness),
        _ => entry,
    }
}

/// Every law of the registry, ZMC with options, and one from outside of which nothing is stated. An ellipse is so many spheres: laws differ for spheres alone.
pub fn all() -> Vec<Entry> {
    let spheres = registry().iter().filter(|law| !law.is_elliptic());
    let with_options = [
        zmc_with("zmc, 110", Zmc::ONSET, 110.0, smooth),
        zmc_with("zmc, wide", Zmc::ONSET, 1e4, smooth),
        zmc_with("zmc, narrow", Zmc::ONSET, 1.01, smooth),
        zmc_with("zmc, rounded", 0.89, 54.0, |_| [0.3 * PI / 0.89f64.sqrt(), 1.0])
            .stating(0.3, &["0.999024", "1"]),
        zmc_with("zmc, early", 0.4, 54.0, |_| [0.3 * PI / 0.4f64.sqrt(), 1.0]),
        zmc_with("zmc, late", 100.0, 54.0, |_| [0.03 * PI, 1.0]),
    ];
    let own = Entry::of(&ContactLaw::scalable(Abrupt { onset: 1.0 }));
    spheres.map(|law| stated(Entry::of(law))).chain(with_options).chain([own]).collect()
}
