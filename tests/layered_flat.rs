//! What must hold for any layered flat, whatever the numbers: bounds, regimes, integrals, load control, limits.

use std::sync::atomic::{AtomicUsize, Ordering};

use asperity::asperity::{AsperitySet, Draw, HeightDensity, Ordered, Population};
use asperity::coating::{Coating, Rule};
use asperity::contact::{Contact, Regime};
use asperity::interface::{Flat, Layered, LoadBounds, MicroContact, Shapes};
use asperity::law::{Shape, Zmc};
use asperity::literature::Paper;
use asperity::material::Material;
use asperity::model::{Datum, Deterministic, Model, Statistical};
use asperity::numeric::Sum;
use asperity::numeric::interval::Interval;
use asperity::numeric::quadrature::{Variable, panels};

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in the logarithm.
    fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[(self.unit() * all.len() as f64) as usize]
    }
}

#[derive(Debug, Clone)]
struct Case {
    rough: Material,
    layer: Material,
    substrate: Material,
    thickness: f64,
    rule: Rule,
    radius: f64,
    onset: f64,
    ratio: f64,
}

impl Case {
    /// Moduli over eight decades, hardnesses over six, the rough body harder, softer, equal or never yielding.
    fn any(random: &mut Random) -> Self {
        let young = random.log(1e9, 1e12);
        let soft = young * random.log(1e-3, 0.1);
        let hard = soft * random.log(1e-3, 1e3);
        let of_rough = [
            None,
            Some(soft),
            Some(soft * random.log(1e-2, 1e2)),
            Some(hard * (soft / hard).powf(random.unit())),
        ];
        let never = random.unit() < 0.1;
        let mut body = |young: f64, hardness: Option<f64>| {
            let any_poisson = 0.499 * random.unit();
            let poisson = random.one_of(&[0.0, 0.3, 0.499, any_poisson]);
            let strength = hardness.filter(|_| random.unit() < 0.3).map(|h| h * random.log(0.05, 1.0));
            (
                Material::new(young * random.log(1e-4, 1e4), poisson, hardness, strength).unwrap(),
                random.unit(),
            )
        };
        let yields = |hardness: f64| (!never).then_some(hardness);
        let ((layer, _), (substrate, place)) = (body(young, yields(hard)), body(young, yields(soft)));
        let (rough, _) = body(young, of_rough[(4.0 * place) as usize]);
        Self {
            rough,
            layer,
            substrate,
            thickness: random.log(1e-10, 1e-4),
            rule: random.one_of(&Rule::ALL),
            radius: random.log(1e-9, 1e-2),
            onset: random.one_of(&[Zmc::ONSET, Zmc::ONSET, 0.4, 100.0, 0.89]),
            ratio: random.one_of(&[54.0, 54.0, 1.01, 110.0, 1e4]),
        }
    }

    fn coating(&self) -> Coating {
        Coating::new(&self.layer, &self.substrate, self.thickness, self.rule).unwrap()
    }

    fn contact(&self) -> Layered<Zmc> {
        Layered::new(Zmc::new(self.onset, self.ratio).unwrap(), &self.rough, &self.substrate, self.coating())
            .unwrap()
    }

    /// Where the flat becomes as hard as the rough body.
    fn kink(&self) -> Option<f64> {
        self.coating().indentation_of_hardness(self.rough.hardness()?)
    }
}

fn steel() -> Material {
    Material::new(210e9, 0.3, Some(7.6e9), None).unwrap()
}

fn under_lead(thickness: f64) -> Layered<Zmc> {
    let lead = Material::new(18e9, 0.35, Some(0.17e9), None).unwrap();
    let coating = Coating::new(&lead, &steel(), thickness, Rule::Gao).unwrap();
    Layered::new(Zmc::default(), &steel(), &steel(), coating).unwrap()
}

/// The regimes of lead on steel that PHYSICS C lists for Table 1, and where its areas fall.
#[test]
fn regimes_of_lead_on_steel_come_again() {
    use Regime::{Elastic as E, ElasticPlastic as M, Plastic as P};
    let (back, twice, once) = (vec![E, M, E, M, P], vec![E, M, P, M, P], vec![E, M, P]);
    let cases = [
        (2e-5, [1e-9, 5e-9, 2e-8].to_vec(), &back, false),
        (2e-5, [5e-8, 1e-7, 2e-7].to_vec(), &twice, true),
        (2e-5, [1e-6].to_vec(), &twice, false),
        (1.6e-6, [1e-9].to_vec(), &back, false),
        (1.6e-6, [5e-9, 1e-8, 2e-8].to_vec(), &twice, true),
        (1.6e-6, [5e-8, 1e-7].to_vec(), &twice, false),
        (1.6e-6, [2e-7, 1e-6].to_vec(), &once, false),
    ];
    for (b, thicknesses, expected, falls) in cases {
        for t in thicknesses {
            let contact = under_lead(t);
            let changes = contact.regime_changes(Shape::sphere(b));
            let ends = [1e-30].into_iter().chain(changes.iter().copied()).chain([1.0]).collect::<Vec<_>>();
            let regimes: Vec<_> = ends
                .windows(2)
                .map(|w| contact.contact((w[0] * w[1]).sqrt(), Shape::sphere(b)).regime)
                .collect();
            assert_eq!(&regimes, expected, "{t:e} m on {b:e} m");
            let curve: Vec<_> =
                (0..20_000).map(|k| contact.contact(1e-13 * 1.0015f64.powi(k), Shape::sphere(b))).collect();
            let drops = |value: fn(&Contact) -> f64| {
                curve.windows(2).any(|pair| value(&pair[1]) < value(&pair[0]) * (1.0 - 1e-12))
            };
            assert_eq!(drops(|c| c.area), falls, "area under {t:e} m on {b:e} m");
            assert!(!drops(|c| c.load), "load under {t:e} m on {b:e} m");
        }
    }
}

#[test]
fn bounds_hold_what_they_bound() {
    let mut random = Random(1);
    for _ in 0..400 {
        let case = Case::any(&mut random);
        let coating = case.coating();
        for _ in 0..20 {
            let low = case.thickness * random.log(1e-12, 1e12);
            let from = random.one_of(&[low, low, low, 0.0]);
            let w = Interval { low: from, high: low * random.log(1.0001, 1e4) };
            let b = Interval { low: case.radius, high: case.radius * random.one_of(&[1.0, 1.5]) };
            let bounds = coating.over(w, b);
            for k in 1..=20 {
                let at = w.high * (low / w.high).powf(f64::from(k - 1) / 20.0);
                let felt = coating.at(at, b.low + (b.high - b.low) * f64::from(k % 7) / 6.0);
                let holds = |range: Interval, value: f64, size: f64| {
                    let slack = 1e-12 * size;
                    assert!(value == range.low || (range.low - slack..=range.high + slack).contains(&value));
                };
                holds(bounds.compliance, felt.compliance, felt.compliance);
                holds(bounds.compliance_slope, felt.compliance_slope, felt.compliance);
                holds(bounds.hardness, felt.hardness, felt.hardness);
                holds(bounds.hardness_slope, felt.hardness_slope, 1.0);
            }
        }
    }
}

/// Against a scan of 20 000 indentations: none is missed, none is invented.
#[test]
fn every_regime_change_is_found() {
    let mut random = Random(2);
    let mut most = 0;
    for _ in 0..150 {
        let case = Case::any(&mut random);
        let contact = case.contact();
        let found = contact.regime_changes(Shape::sphere(case.radius));
        most = most.max(found.len());
        let regime = |ln_w: f64| contact.contact(ln_w.exp(), Shape::sphere(case.radius)).regime;
        for w in &found {
            assert_ne!(regime(w.ln() - 1e-11), regime(w.ln() + 1e-11), "{w:e} is none of {case:?}");
        }
        let place = |k: i32| -70.0 + 95.0 * f64::from(k) / 20_000.0;
        for k in (0..20_000).filter(|&k| regime(place(k)) != regime(place(k + 1))) {
            let range = place(k) - 1e-11..place(k + 1) + 1e-11;
            assert!(found.iter().any(|w| range.contains(&w.ln())), "{:e} of {case:?}", place(k).exp());
        }
    }
    assert!(most >= 6, "{most} changes at the most");
}

/// At this ratio of hardnesses, under equal moduli, ln(w/w1) has a place where it nor rises nor bends: three roots
/// become one. The search must neither take long nor make up roots out of rounding.
#[test]
fn three_roots_that_merge_are_one() {
    const MERGING: f64 = 0.470_749_992_671_771_3;
    let body = |hardness: f64| Material::new(1e11, 0.3, Some(hardness), None).unwrap();
    let rough = Material::new(1e11, 0.3, None, None).unwrap();
    let (w, modulus) = (1.262_129_028_277_342_4e-7, 1e11 / 0.91 / 2.0);
    for (apart, expected) in [(1e-3, 3..=3), (1e-6, 3..=3), (0.0, 1..=7), (-1e-6, 1..=1)] {
        let coating =
            Coating::new(&body(1e9 * MERGING * (1.0 - apart)), &body(1e9), 1e-7, Rule::Gao).unwrap();
        let b = w * (modulus / coating.at(w, 1e-5).hardness).powi(2) / Zmc::ONSET;
        let contact = Layered::new(Zmc::default(), &rough, &body(1e9), coating).unwrap();
        // Of these one is the end of the elastic-plastic range.
        let found = contact.regime_changes(Shape::sphere(b)).len() - 1;
        assert!(expected.contains(&found), "{found} roots at {apart:e}");
    }
}

/// The same integrals by panels a fifth of an octave wide, and kinks from the materials alone.
fn dense(contact: &dyn MicroContact, kink: Option<f64>, population: Population, h: f64) -> [f64; 3] {
    let Population { radius, sigma, density, heights } = population;
    let [start, end] = heights.window(h);
    let mut ends: Vec<f64> = (0..170).map(|k| end * 1.5f64.powi(-k)).collect();
    ends.extend((0..40).map(|k| start + (end - start) * f64::from(k) / 40.0));
    ends.extend(contact.regime_changes(Shape::sphere(radius)).into_iter().chain(kink).map(|w| w / sigma));
    ends.push(-h);
    ends.retain(|x| (start..=end).contains(x));
    ends.sort_by(f64::total_cmp);
    let mut sums = [Sum::default(); 3];
    for range in ends.windows(2).filter(|range| range[0] < range[1]) {
        for panel in panels(range[0], range[1], Variable::SquareRoot, 1) {
            for (x, weight) in panel.points.into_iter().zip(panel.weights) {
                let found = contact.contact(x * sigma, Shape::sphere(radius));
                let share = weight * (-heights.exponent(h, x)).exp();
                for (sum, value) in sums.iter_mut().zip([found.area, found.load, found.stiffness]) {
                    sum.add(share * value);
                }
            }
        }
    }
    sums.map(|sum| sum.value() * heights.scale(h) * density)
}

/// Poles next to zero, where a stiff substrate lies below a compliant layer and a compliant rough body, included.
#[test]
fn integrals_over_any_coating() {
    let mut random = Random(3);
    let mut worst = [0.0f64; 3];
    for _ in 0..500 {
        let mut case = Case::any(&mut random);
        let sigma = case.radius * random.log(1e-4, 0.3);
        case.thickness = (sigma * case.radius).sqrt() * random.log(1e-4, 1e3);
        let heights = random.one_of(&[HeightDensity::Gaussian, HeightDensity::Exponential]);
        let population = Population { radius: case.radius, sigma, density: 1e10, heights };
        let contact = case.contact();
        let model = Statistical::new(&contact, population);
        for h in [-10.0, -3.0, 0.0, 3.0, 20.0, 35.0] {
            let found = model.respond(h);
            let exact = dense(&contact, case.kink(), population, h);
            let found = [found.area_ratio.total(), found.pressure.total(), found.stiffness];
            // Where the load jumps, its slope has a share that no panel sees.
            let columns = if case.onset == Zmc::ONSET { 3 } else { 2 };
            for (k, (found, exact)) in found.into_iter().zip(exact).enumerate().take(columns) {
                let error = (found / exact - 1.0).abs();
                worst[k] = worst[k].max(error);
                let bound = if k == 2 { 2e-12 } else { 2e-14 };
                assert!(error < bound, "{error:e} of {k} at h = {h}, sigma = {sigma:e} {case:?}");
            }
        }
    }
    println!("worst {worst:?}");
}

#[test]
fn no_load_falls_but_where_it_is_said_to() {
    let mut random = Random(4);
    let (mut free, mut falling) = (0, 0);
    for _ in 0..1500 {
        let case = Case::any(&mut random);
        let (contact, shape) = (case.contact(), Shape::sphere(case.radius));
        let within = contact.may_fall(shape.into());
        free += usize::from(within.is_empty());
        let from = 1e-6 * case.thickness.min(case.thickness.powi(2) / case.radius);
        let end = 1e3 * case.thickness.max(case.thickness.powi(2) / case.radius);
        let place = |k: i32| from * (end / from).powf(f64::from(k) / 4000.0);
        for k in 0..4000 {
            let [low, high] = [place(k), place(k + 1)];
            if contact.contact(high, shape).load < contact.contact(low, shape).load * (1.0 - 1e-12) {
                falling += 1;
                let is_said = within.iter().any(|range| range.meets(Interval { low, high }));
                assert!(is_said, "falls at {low:e}, said {within:?}: {case:?}");
            }
        }
    }
    assert!(free > 500 && falling > 500, "{free} {falling}");
}

/// Back over the onset of yield, a law whose load jumps up there lets it fall.
#[test]
fn a_jump_that_is_passed_backwards_is_a_fall() {
    let lead = Material::new(18e9, 0.35, Some(0.17e9), None).unwrap();
    let coating = Coating::new(&lead, &steel(), 1e-9, Rule::Gao).unwrap();
    let contact = Layered::new(Zmc::new(0.4, 54.0).unwrap(), &steel(), &steel(), coating).unwrap();
    let back = contact.regime_changes(Shape::sphere(2e-5))[1];
    let load = |w: f64| contact.contact(w, Shape::sphere(2e-5)).load;
    assert!(load(back * (1.0 + 1e-9)) < 0.7 * load(back * (1.0 - 1e-9)));
    assert!(contact.may_fall(Shape::sphere(2e-5).into()).iter().any(|range| range.holds(back)));
}

/// Counts the bounds that a search asks for.
struct Counted<'a>(&'a dyn MicroContact, AtomicUsize);

impl MicroContact for Counted<'_> {
    fn contact(&self, w: f64, shape: Shape) -> Contact {
        self.0.contact(w, shape)
    }
    fn regime_changes(&self, shape: Shape) -> Vec<f64> {
        self.0.regime_changes(shape)
    }
    fn breakpoints(&self, shape: Shape) -> Vec<f64> {
        self.0.breakpoints(shape)
    }
    fn may_fall(&self, shapes: Shapes) -> Vec<Interval> {
        self.0.may_fall(shapes)
    }
    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.load_over(from, to, shape)
    }
    fn reference_modulus(&self) -> f64 {
        self.0.reference_modulus()
    }
    fn reference_hardness(&self) -> f64 {
        self.0.reference_hardness()
    }
    fn papers(&self) -> Vec<Paper> {
        self.0.papers()
    }
}

/// Hard films more than 1 + e^2 times as hard as what is below, under one asperity and under many: against a scan from
/// above, at loads next to each peak and anywhere. A search of a sum takes some hundred bounds of it at the most.
#[test]
fn where_the_load_falls_the_first_reach_counts() {
    let mut random = Random(5);
    let (mut peaks, mut most) = (0, 0);
    for k in 0..24 {
        let substrate = Material::new(random.log(5e10, 4e11), 0.3, Some(random.log(1e8, 1e9)), None).unwrap();
        let hardness = substrate.hardness().unwrap() * random.log(9.0, 60.0);
        let layer =
            Material::new(substrate.young() * random.log(0.5, 10.0), 0.25, Some(hardness), None).unwrap();
        let rough = Material::new(1.1e12, 0.1, None, None).unwrap();
        let sigma = random.log(3e-9, 3e-7);
        let coating = Coating::new(&layer, &substrate, sigma * random.log(0.03, 10.0), Rule::Gao).unwrap();
        let law = Zmc::new(random.one_of(&[Zmc::ONSET, Zmc::ONSET, 0.4, 0.89]), 54.0).unwrap();
        let contact = Layered::new(law, &rough, &substrate, coating).unwrap();
        let contact = Counted(&contact, AtomicUsize::new(0));
        let population = Population { radius: 1e-5, sigma, density: 1e10, heights: HeightDensity::Gaussian };
        let count = [1, 3, 30, 600][k % 4];
        let drawn = population.set(count, Draw::Random([k as u8; 32])).unwrap();
        let radii = drawn.radii().iter().map(|b| b * random.log(0.3, 3.0)).collect();
        let set = AsperitySet::new(drawn.heights().to_vec(), radii, drawn.nominal_area()).unwrap();
        let set = Ordered::new(&set);
        let deterministic = Deterministic::new(&contact, &set, Datum { mean: 0.0, sigma });
        let statistical = Statistical::new(&contact, population);
        for model in [&statistical as &dyn Model, &deterministic] {
            let pressure = |h: f64| model.respond(h).pressure.total();
            let scan: Vec<_> =
                (0..=1400).map(|k| 4.0 - 0.01 * f64::from(k)).map(|h| (h, pressure(h))).collect();
            let is_peak = |w: &[(f64, f64)]| w[1].1 >= w[0].1 && w[1].1 > w[2].1;
            let tops = scan.windows(3).filter(|w| is_peak(w)).map(|w| w[1].1).take(3);
            let mut levels: Vec<f64> = tops.flat_map(|top| [0.999 * top, 1.0005 * top]).collect();
            peaks += levels.len() / 2;
            levels.extend((0..3).map(|_| scan[1400].1 * random.log(1e-3, 1.0)));
            for level in levels {
                contact.1.store(0, Ordering::Relaxed);
                let found = model.separation_at(level);
                most = most.max(contact.1.load(Ordering::Relaxed) / count);
                let first = scan.iter().find(|point| point.1 >= level);
                let Some(h) = found else {
                    assert!(first.is_none(), "{level:e} is reached at {first:?}");
                    continue;
                };
                assert!(first.is_none_or(|point| h >= point.0 - 1e-12), "{level:e}: {h} behind {first:?}");
                assert!(pressure(h) >= level * (1.0 - 1e-12));
                assert!(pressure(h + 1e-12 * h.abs().max(1.0)) < level * (1.0 + 1e-11), "{level:e} at {h}");
            }
        }
    }
    println!("{peaks} peaks, at most {most} bounds");
    assert!(peaks > 10, "{peaks}");
    assert!(most < 1000, "{most} bounds of a sum in one search");
}

#[test]
fn stiffness_is_the_slope_of_the_load() {
    let mut random = Random(6);
    for _ in 0..300 {
        let case = Case::any(&mut random);
        let contact = case.contact();
        let kinks: Vec<f64> =
            contact.regime_changes(Shape::sphere(case.radius)).into_iter().chain(case.kink()).collect();
        for _ in 0..40 {
            let scale = random.one_of(&[case.thickness, case.thickness.powi(2) / case.radius]);
            let (w, step) = (scale * random.log(1e-6, 1e6), 2e-4);
            if kinks.iter().any(|kink| (kink / w).ln().abs() < 3.0 * step) {
                continue;
            }
            let load =
                |shift: f64| contact.contact(w * (shift * step).exp(), Shape::sphere(case.radius)).load;
            let slope = (8.0 * (load(1.0) - load(-1.0)) - (load(2.0) - load(-2.0))) / (12.0 * step);
            let found = contact.contact(w, Shape::sphere(case.radius));
            let error = (found.stiffness * w - slope).abs() / slope.abs().max(found.load);
            assert!(error < 1e-10, "{error:e} at {w:e} of {case:?}");
        }
    }
}

/// From the least to the largest thickness that is a number here, both ends included.
#[test]
fn thin_and_thick_layers_end_in_their_limits() {
    let mut random = Random(7);
    for _ in 0..40 {
        let case = Case::any(&mut random);
        let sigma = 1e-2 * case.radius;
        let population =
            Population { radius: case.radius, sigma, density: 1e10, heights: HeightDensity::Gaussian };
        let set = Ordered::new(&population.set(50, Draw::Quantiles).unwrap());
        let loads = |thickness: f64| {
            let flat = Flat::with_layer(&case.layer, &case.substrate, thickness, case.rule).unwrap();
            let contact = flat.under(Zmc::default(), &case.rough).unwrap();
            let sum = Deterministic::new(&*contact, &set, Datum { mean: 0.0, sigma });
            [&Statistical::new(&*contact, population) as &dyn Model, &sum]
                .map(|model| model.respond(1.0).pressure.total())
        };
        for (end, sign) in [(0.0, -1), (f64::INFINITY, 1)] {
            let limits = loads(end);
            let mut before = [f64::INFINITY; 2];
            for power in 0..=30 {
                let found = loads(10f64.powi(sign * power));
                for k in 0..2 {
                    let off = (found[k] / limits[k] - 1.0).abs();
                    assert!(off.is_finite() && found[k] > 0.0, "10^{} m of {case:?}", sign * power);
                    // Nearer with each decade, once the contact is small or large beside the layer.
                    if power >= 14 {
                        assert!(off <= before[k].max(4e-15), "{off:e} at 10^{} m of {case:?}", sign * power);
                    }
                    before[k] = off;
                }
            }
            assert!(before.iter().all(|&off| off < 1e-14), "{before:?} of {case:?}");
        }
    }
}
