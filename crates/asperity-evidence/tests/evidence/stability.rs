//! Thousands of cases against about 32 digits, and those digits against the reference vectors.

use crate::common::{Row, Worst, rows};
use asperity::progress::Silent;
use asperity::{AsperitySet, Deterministic, Heights, Material, Model, ModulusModel, ReferencePlane};
use asperity_evidence::exact::{Bodies, CoveredLaw, Exact, Integral, Layer, Shape, density_of};
use asperity_evidence::stability::{Counts, Group, Layout, SetParameters, WorstCase, check_group};
use asperity_evidence::wide::{Wide, relative_error};

const SEED: [u8; 32] = [17; 32];

/// A few thousand cases.
const COUNTS: Counts = Counts { contacts: 1000, sums: 60, integrals: 150, loads: 20, millions: 3 };

#[test]
fn every_group_is_within_its_bounds() {
    let groups = Group::ALL.map(|group| check_group(group, COUNTS.in_group(group), SEED, &Silent));
    let mut violations = Vec::new();
    for results in &groups {
        println!("{} ({} cases)", results.group.name(), results.cases);
        for WorstCase { quantity, median, largest, checked, error, case } in &results.worst {
            let name = quantity.name();
            println!("    {name}: median {median:.1e}, worst {checked:.2e} ({error:.1e}) at {}", case.index);
            assert!(median <= largest && checked <= largest && largest <= error, "{name}");
            assert_eq!(results.largest_error(*quantity), Some(*largest));
        }
        violations.extend(results.violations().map(|(violation, case)| {
            format!("{} {}: {violation}: {}", results.group.name(), case.index, case.inputs())
        }));
        assert_eq!(results.cases, COUNTS.in_group(results.group));
        assert_eq!(results.is_within_bounds(), results.violations().next().is_none());
    }
    assert!(violations.is_empty(), "{} beyond:\n{}", violations.len(), violations.join("\n"));
}

/// Heights up to 1e8 sigma from zero, 10 nm at 1 m, lose no digits: they are summed relative to one of them.
#[test]
fn the_error_of_offset_heights_does_not_grow_with_the_offset() {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    let bodies = Bodies { law: CoveredLaw::zmc(), rough: steel, flat: steel, layer: None };
    let (exact, contact) = (Exact::new(&bodies), bodies.contact().unwrap());
    for exponent in 0..=8 {
        for sign in [-1.0, 1.0] {
            let ratio = sign * 10f64.powi(exponent);
            let (sigma, radius) = (1e-7, 2e-5);
            let mean = ratio * sigma;
            let set = SetParameters { heights: Layout::Gaussian, count: 1000, mean, sigma, radius, seed: 3 };
            let asperities = set.asperities(0.5);
            let (heights, radii) = asperities.iter().copied().unzip();
            let (set, origin) = AsperitySet::new(heights, radii, 1.0).unwrap().near_zero();
            let plane = ReferencePlane { mean: mean - origin, sigma };
            let found = Deterministic::new(&*contact, set.spheres(), plane).respond(0.5);
            let total = exact.total(&asperities, Wide::new(0.5) * sigma + mean, false);
            let bound = 4.0 * f64::EPSILON * (1.0 + plane.mean.abs() / sigma);
            // Up to 16 times the range of 1000 Gaussian heights they keep their frame.
            assert!(plane.mean.abs() < 110.0 * sigma);
            assert!(relative_error(found.pressure.total(), total.total_load()) <= bound, "{ratio}");
            assert!(relative_error(found.area_ratio.total(), total.total_area()) <= bound, "{ratio}");
        }
    }
}

fn material(row: &Row, of: &str) -> Material {
    let number = |key: &str| row.number(&format!("{of}_{key}"));
    let strength = if of == "rough" { None } else { Some(number("yield")) };
    Material::new(number("young"), number("poisson"), Some(number("hardness")), strength).unwrap()
}

#[test]
fn the_wide_contacts_are_those_of_the_vectors() {
    let mut worst = Worst::default();
    for (k, row) in rows("coating").iter().enumerate() {
        let layer = Layer {
            material: material(row, "layer"),
            thickness: row.number("thickness"),
            rule: ModulusModel::Gao,
        };
        let (rough, flat) = (material(row, "rough"), material(row, "substrate"));
        let exact = Exact::new(&Bodies { law: CoveredLaw::zmc(), rough, flat, layer: Some(layer) });
        let found = exact.contacts(row.number("indentation"), &Shape::sphere(row.number("radius")));
        worst.see(found[0].area.hi(), row.number("area"), || format!("area of row {k}"));
        worst.see(found[0].load.hi(), row.number("load"), || format!("load of row {k}"));
    }
    for (k, row) in rows("laws").iter().enumerate() {
        let law = CoveredLaw::named(&row.text("law").replace('_', "-")).unwrap();
        let known = |key: &str| (!row.text(key).is_empty()).then(|| row.number(key));
        let nu = row.number("poisson");
        // Against a rigid flat, rounded once more on the way.
        let young = row.number("reduced_modulus") * (1.0 - nu * nu);
        let rough = Material::new(young, nu, known("hardness"), known("yield_strength")).unwrap();
        let flat = Material::new(1e30, 0.0, None, None).unwrap();
        let exact = Exact::new(&Bodies { law, rough, flat, layer: None });
        let found = exact.contacts(row.number("indentation"), &Shape::sphere(row.number("radius")));
        worst.see(found[0].area.hi(), row.number("area"), || format!("area of {k}"));
        worst.see(found[0].load.hi(), row.number("load"), || format!("load of {k}"));
    }
    worst.assert_within(4e-15, 100);
}

#[test]
fn the_wide_integrals_are_those_of_the_vectors() {
    let mut worst = Worst::default();
    let mut see = |bodies: Bodies, row: &Row, k: usize| {
        let of = Integral {
            sigma: row.number("sigma"),
            density: row.number("density"),
            heights: density_of(&Heights::GAUSSIAN).unwrap(),
            separation: row.number("separation_over_sigma"),
        };
        let total = Exact::new(&bodies).integral(&of, &Shape::sphere(row.number("radius"))).unwrap();
        worst.see(total.total_area().hi(), row.number("area_ratio"), || format!("area of row {k}"));
        worst.see(total.total_load().hi(), row.number("pressure"), || format!("pressure of row {k}"));
    };
    for (k, row) in rows("statistical").iter().enumerate() {
        let number = |key: &str| row.number(key);
        let body = Material::new(number("young"), number("poisson"), Some(number("hardness")), None).unwrap();
        see(Bodies { law: CoveredLaw::zmc(), rough: body, flat: body, layer: None }, row, k);
    }
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    for (k, row) in rows("statistical_coated").iter().enumerate() {
        let number = |key: &str| row.number(&format!("layer_{key}"));
        let material =
            Material::new(number("young"), number("poisson"), Some(number("hardness")), None).unwrap();
        let layer = Layer { material, thickness: row.number("thickness"), rule: ModulusModel::Gao };
        see(Bodies { law: CoveredLaw::zmc(), rough: steel, flat: steel, layer: Some(layer) }, row, k);
    }
    worst.assert_within(3e-16, 100);
}

/// A law added without equations of 32 digits is reported as not covered; these have them.
#[test]
fn published_laws_are_covered() {
    const PUBLISHED: [&str; 6] = ["hertz", "zmc", "ceb", "kogut-etsion", "fully-plastic", "jackson-green"];
    let [covered, others] = CoveredLaw::coverage();
    for name in PUBLISHED {
        assert!(covered.iter().any(|law| law == name), "{name} is among {others:?}");
        assert_eq!(CoveredLaw::named(name).unwrap().chosen().name(), name);
    }
    assert!(covered.contains(&"elliptic-zmc".to_owned()) && CoveredLaw::named("no-law").is_none());
}
