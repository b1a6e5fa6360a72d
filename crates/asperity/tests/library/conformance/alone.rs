//! One asperity and one pair of bodies.

use asperity::law::Body;
use asperity::numeric::LARGEST;
use asperity::{Contact, Hertz, Inapplicable, Law, Material, Pair, Regime, YieldLimits, reduced_modulus};

use super::laws::{Entry, all};
use crate::common::{Random, Worst, slope};

/// A pair of bodies, a radius, and the indentations between which each formula holds: the first from 1e-12 of its end on,
/// the last as far as 1e8 of its beginning.
struct Sample {
    pair: Pair,
    radius: f64,
    edges: Vec<f64>,
}

impl Sample {
    fn of(entry: &Entry, random: &mut Random) -> Self {
        let mut any = || {
            let poisson = 0.499 * random.unit();
            Material::new(random.log(1e8, 1e13), poisson, None, None).unwrap()
        };
        let bodies = [any(), any()];
        let modulus = reduced_modulus(&bodies[0], &bodies[1]);
        // Either body the weaker one, or the only one that yields.
        let never = random.one_of(&[0, 1, 2]);
        let mut pair = || {
            let [rough, flat] = [0, 1].map(|k| {
                let strength = (k != never).then(|| modulus * random.log(1e-6, entry.strongest.min(1.0)));
                Material::new(bodies[k].young(), bodies[k].poisson(), strength, strength).unwrap()
            });
            Pair::between(entry.law(), &rough, &flat).ok()
        };
        // A law may refuse pairs beyond a range that no table states.
        let tries = if entry.strongest.is_finite() { 1 } else { 1000 };
        let pair = (0..tries).find_map(|_| pair()).unwrap();
        let radius = random.log(1e-9, 1e-1);
        let unit = if pair.yield_limits.onset.is_finite() { pair.ratio(1.0) * radius } else { radius };
        let places: Vec<f64> = entry.boundaries.iter().map(|boundary| boundary.place).collect();
        let ends = [places.first(), places.last()].map(|place| place.copied().unwrap_or(1.0));
        let all = [1e-12 * ends[0]].into_iter().chain(places).chain([1e8 * ends[1]]);
        Self { pair, radius, edges: all.map(|place| place * unit).collect() }
    }

    fn contact(&self, law: &dyn Law, w: f64) -> Contact {
        law.contact(w, self.radius, &self.pair)
    }

    /// The indentations of each formula, away from its ends by this part of them.
    fn ranges(&self, away: f64) -> Vec<[f64; 2]> {
        let inside = |edge: &[f64]| [edge[0] * (1.0 + away), edge[1] * (1.0 - away)];
        self.edges.windows(2).map(inside).collect()
    }

    fn boundaries(&self) -> &[f64] {
        &self.edges[1..self.edges.len() - 1]
    }
}

/// More than the rounding of a boundary.
const BESIDE: f64 = 1e-14;

/// Shows `see` every law with `count` samples each.
fn each(seed: u64, count: usize, mut see: impl FnMut(&Entry, &Sample, &mut Random)) {
    for entry in all() {
        let mut random = Random::new(seed);
        for _ in 0..count {
            let sample = Sample::of(&entry, &mut random);
            see(&entry, &sample, &mut random);
        }
    }
}

fn values(contact: &Contact) -> [f64; 3] {
    [contact.area, contact.load, contact.stiffness]
}

/// At the ends of everything that the program takes, and at the least indentations that there are.
#[test]
fn every_answer_is_a_number() {
    let ends = [1.0 / LARGEST, 1e-15, 1e-3, 1.0, 1e15, LARGEST];
    for entry in all() {
        let mut count = 0;
        for (young, strength) in ends.iter().flat_map(|&a| ends.map(|b| (a, b))) {
            let body = Material::new(young, 0.3, Some(strength), Some(strength)).unwrap();
            let pair = match Pair::between(entry.law(), &body, &body) {
                Ok(pair) => pair,
                Err(Inapplicable::TooStrong { .. }) => continue,
                Err(error) => panic!("{}: {error}", entry.label),
            };
            let tuned = entry.law.tuned(&pair);
            for (b, w) in ends.iter().flat_map(|&b| ends.map(|w| (b, w))) {
                for w in [w, w * 1e-200, f64::from_bits(1)] {
                    for law in [&entry.law, &tuned] {
                        let found = law.law().contact(w, b, &pair);
                        let good = values(&found).iter().all(|value| value.is_finite() && *value >= 0.0);
                        assert!(good, "{}: {found:?} at {w:e} of {b:e} m, {pair:?}", entry.label);
                        count += 1;
                    }
                }
            }
        }
        assert!(count > 1000, "{}: {count}", entry.label);
    }
}

#[test]
fn nothing_is_left_at_zero() {
    each(1, 20, |entry, sample, _| {
        let at = |w: f64| values(&sample.contact(entry.law(), w));
        for decades in [0, 40, 80, 120] {
            let w = sample.edges[0] * 10f64.powi(-decades);
            for (less, more) in at(1e-10 * w).into_iter().zip(at(w)).take(2) {
                assert!(more > 0.0 && less <= 1.0001e-10 * more, "{}: {less:e} {more:e}", entry.label);
            }
        }
    });
}

#[test]
fn below_the_first_boundary_it_is_hertz() {
    each(2, 50, |entry, sample, random| {
        let [low, high] = sample.ranges(BESIDE)[0];
        let w = random.log(low, high);
        let found = sample.contact(entry.law(), w);
        let hertz = Hertz.contact(w, sample.radius, &sample.pair);
        assert_eq!(found == hertz, entry.first == Regime::Elastic, "{}: {found:?}", entry.label);
    });
}

#[test]
fn within_a_range_nothing_falls() {
    each(3, 30, |entry, sample, random| {
        for [low, high] in sample.ranges(BESIDE) {
            let dense = (0..1000).map(|k| low * (high / low).powf(f64::from(k) / 1000.0));
            let scan: Vec<f64> = dense.chain([high]).collect();
            let mut pairs: Vec<[f64; 2]> = scan.windows(2).map(|pair| [pair[0], pair[1]]).collect();
            for _ in 0..300 {
                let w = random.log(low, high);
                pairs.push([w, (w * (1.0 + random.log(1e-12, 1e-3))).min(high)]);
            }
            for [w, next] in pairs {
                let [from, to] = [w, next].map(|w| sample.contact(entry.law(), w));
                let rises = |value: fn(&Contact) -> f64| value(&to) >= value(&from) * (1.0 - 4e-15);
                assert!(rises(|c| c.area) && rises(|c| c.load), "{} at {w:e}: {from:?} {to:?}", entry.label);
            }
        }
    });
}

/// Doubling is exact in binary: so are the answers.
#[test]
fn answers_scale() {
    each(4, 100, |entry, sample, random| {
        let Sample { pair, radius, edges } = sample;
        let w = random.log(edges[0], edges[edges.len() - 1]);
        let found = sample.contact(entry.law(), w);
        let larger = entry.law().contact(2.0 * w, 2.0 * radius, pair);
        assert_eq!(values(&larger), [4.0 * found.area, 4.0 * found.load, 2.0 * found.stiffness]);
        let YieldLimits { onset, strength } = pair.yield_limits;
        let yield_limits = YieldLimits { onset: 2.0 * onset, strength: 2.0 * strength };
        let stiffer = Pair { reduced_modulus: 2.0 * pair.reduced_modulus, yield_limits };
        let stiffer = entry.law().contact(w, *radius, &stiffer);
        assert_eq!(values(&stiffer), [found.area, 2.0 * found.load, 2.0 * found.stiffness]);
        assert_eq!([larger.regime, stiffer.regime], [found.regime; 2]);
    });
}

#[test]
fn jumps_are_as_stated() {
    let mut worst = Worst::default();
    each(5, 200, |entry, sample, _| {
        let found = entry.law().jumps(&sample.pair);
        let ratios = entry.law().critical_ratios(&sample.pair);
        assert_eq!([found.len(), ratios.len()], [entry.boundaries.len(); 2], "{}", entry.label);
        for (k, (&w, boundary)) in sample.boundaries().iter().zip(&entry.boundaries).enumerate() {
            let place = || format!("boundary {k} of {}, {:?}", entry.label, sample.pair);
            let Some(stated) = boundary.jumps.map(|jumps| jumps(&sample.pair)) else { continue };
            let [before, behind] =
                [1.0 - BESIDE, 1.0 + BESIDE].map(|side| sample.contact(entry.law(), w * side));
            worst.see(behind.load / before.load, stated[0], place);
            worst.see(behind.area / before.area, stated[1], place);
            worst.see(found[k], stated[0], place);
            worst.see(ratios[k] * sample.radius, w, place);
        }
    });
    worst.assert_within(1e-11, 10_000);
}

/// The digits that the documentation gives.
#[test]
fn jumps_have_the_digits_that_are_stated() {
    let mut count = 0;
    for entry in all() {
        for (poisson, digits) in &entry.digits {
            let body = Material::new(1e12, *poisson, Some(1e3), Some(1e3)).unwrap();
            let pair = Pair::between(entry.law(), &body, &body).unwrap();
            let found = entry.law().jumps(&pair);
            assert_eq!(found.len(), digits.len());
            for (jump, digits) in found.iter().zip(digits) {
                let places = digits.split('.').nth(1).map_or(0, str::len);
                assert_eq!(&format!("{jump:.places$}"), digits, "{} at {poisson}", entry.label);
                count += 1;
            }
        }
    }
    assert!(count > 10);
}

/// The slope of a smooth curve changes little from one place to the next.
#[test]
fn there_are_no_other_jumps() {
    const POINTS: i32 = 20_000;
    let mut most_bent = 0.0f64;
    each(6, 4, |entry, sample, random| {
        for [low, high] in sample.ranges(BESIDE) {
            let step = (high / low).ln() / f64::from(POINTS);
            // Of a range shorter than an e-fold the whole change may lie in it.
            let curved = (step / (high / low).ln().min(1.0)).powi(2);
            let shift = random.unit();
            let at =
                |k: i32| values(&sample.contact(entry.law(), low * ((f64::from(k) + shift) * step).exp()));
            let scan: Vec<[f64; 3]> = (0..POINTS).map(|k| at(k).map(f64::ln)).collect();
            for (k, three) in scan.windows(3).enumerate() {
                let bend = |i: usize| three[2][i] - 2.0 * three[1][i] + three[0][i];
                let change = bend(0).abs().max(bend(1).abs());
                let bent = (change - 1e-13) / curved;
                most_bent = most_bent.max(bent);
                let w = low * (k as f64 * step).exp();
                assert!(bent < 10.0, "{} jumps by {change:e} near {w:e}", entry.label);
            }
        }
    });
    println!("most bent {most_bent}");
}

#[test]
fn stiffness_is_the_slope_of_the_load() {
    let mut worst = Worst::default();
    each(7, 30, |entry, sample, random| {
        for [low, high] in sample.ranges(BESIDE) {
            let reach = (1e-3 * (high / low).ln()).min(4e-4);
            for _ in 0..20 {
                let w = random.log(low * reach.exp(), high * (-reach).exp());
                let found = sample.contact(entry.law(), w).stiffness * w;
                let exact = slope(|w| sample.contact(entry.law(), w).load, w, reach);
                worst.see(found, exact, || format!("{} at {w:e}, {:?}", entry.label, sample.pair));
            }
        }
    });
    worst.assert_within(1e-9, 5000);
}

/// Of similar laws: an elastic contact knows E* alone, an elastic-plastic one the onset too, a plastic one the strength
/// alone.
#[test]
fn regimes_come_in_order_and_know_their_properties() {
    each(8, 50, |entry, sample, random| {
        for ([low, high], regime) in sample.ranges(1e-3).into_iter().zip(entry.regimes()) {
            let w = random.log(low, high);
            let found = sample.contact(entry.law(), w);
            assert_eq!(found.regime, regime, "{} at {w:e}", entry.label);
            if !entry.law.supports_layers() {
                continue;
            }
            let Pair { reduced_modulus, yield_limits: YieldLimits { onset, strength } } = sample.pair;
            let pair = |reduced_modulus, onset, strength| Pair {
                reduced_modulus,
                yield_limits: YieldLimits { onset, strength },
            };
            // Within the range that a change of the onset or of E* by 1e-4 leaves in its place.
            let same = match regime {
                Regime::Elastic => pair(reduced_modulus, 1.0001 * onset, 0.5 * strength),
                Regime::ElasticPlastic => pair(reduced_modulus, onset, 0.5 * strength),
                Regime::Plastic => pair(1.0001 * reduced_modulus, 0.9999 * onset, strength),
            };
            assert_eq!(entry.law().contact(w, sample.radius, &same), found, "{} at {w:e}", entry.label);
            let other = match regime {
                Regime::Elastic => pair(1.0001 * reduced_modulus, onset, strength),
                Regime::ElasticPlastic => pair(reduced_modulus, 1.0001 * onset, strength),
                Regime::Plastic => pair(reduced_modulus, onset, 0.5 * strength),
            };
            assert_ne!(entry.law().contact(w, sample.radius, &other), found, "{} at {w:e}", entry.label);
        }
    });
}

#[test]
fn the_highest_load_is_that_of_a_scan() {
    each(9, 30, |entry, sample, random| {
        let [first, last] = [sample.edges[0], sample.edges[sample.edges.len() - 1]];
        for _ in 0..10 {
            let from = random.log(first, last);
            // Ends on boundaries too, and within their rounding.
            let edge = random.one_of(&sample.edges) * (1.0 + f64::EPSILON * random.one_of(&[0.0, 0.0, 4.0]));
            let near = from * random.log(1.001, 1e6);
            let to = random.one_of(&[near, last, edge]);
            if to <= from {
                continue;
            }
            let mut places: Vec<f64> =
                (0..=400).map(|k| from * (to / from).powf(f64::from(k) / 400.0)).map(|w| w.min(to)).collect();
            for &w in sample.boundaries() {
                places.extend([1.0 - BESIDE, 1.0 - 2e-16, 1.0, 1.0 + BESIDE].map(|side| w * side));
            }
            places.retain(|w| (from..=to).contains(w));
            let load = |w: f64| sample.contact(entry.law(), w).load;
            let highest = places.into_iter().map(load).fold(0.0, f64::max);
            let found = entry.law().highest_load(from, to, sample.radius, &sample.pair);
            assert!((found / highest - 1.0).abs() < 1e-12, "{}: {found:e} {highest:e}", entry.label);
        }
    });
}

/// What is worked out beforehand changes nothing but the time, and holds for its own pair alone.
#[test]
fn a_tuned_law_is_the_same_law() {
    let mut worst = [Worst::default(), Worst::default(), Worst::default()];
    let mut last: Option<Pair> = None;
    each(10, 30, |entry, sample, random| {
        let tuned = entry.law.tuned(&sample.pair);
        for [low, high] in sample.ranges(BESIDE) {
            for _ in 0..500 {
                let w = random.log(low, 1e6 * high);
                let (found, exact) = (sample.contact(tuned.law(), w), sample.contact(entry.law(), w));
                assert_eq!(found.regime, exact.regime);
                for (k, worst) in worst.iter_mut().enumerate() {
                    worst.see(values(&found)[k], values(&exact)[k], || format!("{} at {w:e}", entry.label));
                }
                let other = last.unwrap_or(sample.pair);
                if other != sample.pair {
                    let [found, exact] =
                        [&tuned, &entry.law].map(|law| law.law().contact(w, sample.radius, &other));
                    assert_eq!(found, exact, "{}", entry.label);
                }
            }
        }
        last = Some(sample.pair);
    });
    for (worst, bound) in worst.iter().zip([1e-14, 1e-14, 1e-11]) {
        worst.assert_within(bound, 1000);
    }
}

/// Nothing is guessed: what is missing is named with the body that lacks it, and so is a pair beyond the law's range.
#[test]
fn bodies_that_a_law_says_nothing_of_are_refused() {
    let body = |hardness, strength| Material::new(2e11, 0.0, hardness, strength).unwrap();
    let (elastic, hard) = (body(None, None), body(Some(1e9), None));
    for entry in all() {
        let between = |rough, flat| Pair::between(entry.law(), rough, flat);
        let lacking = |property, body| Err((property, body));
        let found = |rough, flat| match between(rough, flat) {
            Ok(_) => Ok(()),
            Err(error @ Inapplicable::Lacking { property, body, .. }) => {
                let words = error.to_string();
                assert!(words.contains(property.name()) && words.contains(&entry.label), "{words}");
                Err((property, body))
            }
            Err(error) => panic!("{}: {error}", entry.label),
        };
        let neither = entry.needs.map_or(Ok(()), |property| lacking(property, None));
        assert_eq!(found(&elastic, &elastic), neither, "{}", entry.label);
        for (rough, flat, which) in
            [(&hard, &elastic, Body::Rough), (&elastic, &hard, Body::Flat), (&hard, &hard, Body::Rough)]
        {
            let expected =
                entry.needs_beside_hardness.map_or(Ok(()), |property| lacking(property, Some(which)));
            assert_eq!(found(rough, flat), expected, "{}", entry.label);
        }
        if entry.strongest.is_finite() {
            // E* of the two is 1e11.
            let [weaker, stronger] =
                [-1e-12, 1e-12].map(|off| body(Some(1e9), Some(1e11 * entry.strongest * (1.0 + off))));
            assert!(between(&weaker, &elastic).is_ok(), "{}", entry.label);
            let refused = between(&elastic, &stronger);
            assert!(matches!(refused, Err(Inapplicable::TooStrong { .. })), "{}", entry.label);
        }
    }
}
