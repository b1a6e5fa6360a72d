//! Random bodies, layers and asperities.

use asperity::{
    Flat, Inapplicable, LayeredFlat, Material, MicroContact, ModulusModel, Pair, Shape, YieldLimits,
};

use super::laws::Entry;
use crate::common::{Random, bodies};

/// An asperity on a flat with a layer.
#[derive(Clone)]
pub struct Case {
    pub rough: Material,
    pub layer: Material,
    pub substrate: Material,
    /// m; 0 and infinity included.
    pub thickness: f64,
    pub rule: ModulusModel,
    pub shape: Shape,
    /// None where the flat is homogeneous.
    pub layered: Option<LayeredFlat>,
}

impl std::fmt::Debug for Case {
    /// The data of the case, to reproduce it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { rough, layer, substrate, thickness, rule, shape, .. } = self;
        write!(f, "{rough:?}, {layer:?}, {substrate:?}, {thickness:e} m, {rule:?}, {shape:?}")
    }
}

impl Case {
    /// Bodies to which the law applies, half of them with a layer of finite thickness if the law allows it.
    pub fn of(entry: &Entry, random: &mut Random) -> Self {
        let mut all = std::iter::repeat_with(|| Self::any(entry, random)).take(10_000);
        all.find(|case| case.try_contact(entry).is_ok()).unwrap()
    }

    fn any(entry: &Entry, random: &mut Random) -> Self {
        let [rough, layer, substrate] = bodies(random);
        let radius = random.log(1e-9, 1e-2);
        let many = random.log(1.0, 100.0);
        let shape = Shape { radius, spheres: random.one_of(&[1.0, 1.0, 1.3, many]) };
        let thickness = if entry.law.supports_layers() && random.unit() < 0.5 {
            // In many of them the contact passes through the layer while formulas change.
            let critical = critical(entry, &rough, &random.one_of(&[layer, substrate]), radius);
            let depths = [random.log(1e-10, 1e-4), critical, (critical * radius).sqrt()];
            (random.one_of(&depths) * random.log(1e-2, 1e2)).clamp(1e-15, 1e15)
        } else {
            random.one_of(&[0.0, f64::INFINITY])
        };
        let rule = random.one_of(&ModulusModel::ALL);
        let layered = LayeredFlat::new(&layer, &substrate, thickness, rule).ok();
        Self { rough, layer, substrate, thickness, rule, shape, layered }
    }

    pub fn flat(&self, thickness: f64) -> Flat {
        Flat::with_layer(&self.layer, &self.substrate, thickness, self.rule).unwrap()
    }

    fn try_contact(&self, entry: &Entry) -> Result<Box<dyn MicroContact>, Inapplicable> {
        entry.law.interface(&self.rough, &self.flat(self.thickness))
    }

    pub fn contact(&self, entry: &Entry) -> Box<dyn MicroContact> {
        self.try_contact(entry).unwrap()
    }

    /// The radius of the circle that touches as the asperity does, over w^.5, squared.
    pub fn width(&self) -> f64 {
        self.shape.spheres * self.shape.radius
    }

    /// The effective homogeneous body of the flat for the asperity at indentation `w`.
    pub fn felt(&self, w: f64) -> Material {
        let Some(layered) = &self.layered else {
            return if self.thickness == 0.0 { self.substrate } else { self.layer };
        };
        let hardness = Some(layered.at(w, self.width()).hardness).filter(|hardness| hardness.is_finite());
        let (poisson, young) = layered.elasticity(w, self.width());
        Material::new(young, poisson, hardness, None).unwrap()
    }

    pub fn pair(&self, entry: &Entry, w: f64) -> Pair {
        Pair::between(entry.law(), &self.rough, &self.felt(w)).unwrap()
    }

    /// Which formula holds at `w`, and whether the rough body is the one that yields first, and the weaker one.
    pub fn state(&self, entry: &Entry, w: f64) -> (usize, bool, bool) {
        let yield_limits =
            |body: &Material| entry.law().yield_limits(body).unwrap_or(YieldLimits::NEVER_YIELDS);
        let (rough, flat) = (yield_limits(&self.rough), yield_limits(&self.felt(w)));
        let pair = self.pair(entry, w);
        let u = w / self.shape.radius * (pair.reduced_modulus / pair.yield_limits.onset).powi(2);
        (entry.formula(u), rough.onset < flat.onset, rough.strength < flat.strength)
    }

    /// Where `state` changes, ascending, by a scan and halving; from 1e-30 to 1e10 m.
    pub fn changes<T: PartialEq>(&self, state: impl Fn(f64) -> T) -> Vec<f64> {
        const POINTS: i32 = 10_000;
        let place = |k: i32| (-69.0 + 92.0 * f64::from(k) / f64::from(POINTS)).exp();
        let mut found = Vec::new();
        let mut before = state(place(0));
        for k in 1..=POINTS {
            let (mut from, to) = (place(k - 1), place(k));
            // Several changes may lie in one step.
            while state(to) != before {
                let (mut low, mut high) = (from, to);
                while high / low > 1.0 + 1e-15 && low.next_up() < high {
                    let middle = 0.5 * (low + high);
                    if state(middle) == before { low = middle } else { high = middle }
                }
                found.push(high);
                (from, before) = (high, state(high));
            }
        }
        found
    }

    /// Indentations about which something changes: those of the law, of the layer's depth and of contacts as wide as it is
    /// thick.
    pub fn scale(&self, entry: &Entry, random: &mut Random) -> f64 {
        let critical = |body: &Material| critical(entry, &self.rough, body, self.shape.radius);
        if self.layered.is_some() {
            let t = self.thickness;
            let all = [t, t.powi(2) / self.width(), critical(&self.layer), critical(&self.substrate)];
            random.one_of(&all)
        } else {
            critical(&self.felt(0.0))
        }
    }
}

/// The indentation (m) about which formulas change on a homogeneous flat; the radius where none does.
fn critical(entry: &Entry, rough: &Material, flat: &Material, radius: f64) -> f64 {
    let pair =
        Pair::between(entry.law(), rough, flat).ok().filter(|pair| pair.yield_limits.onset.is_finite());
    pair.map_or(radius, |pair| pair.ratio(1.0) * radius)
}
