//! A layer on the rough body: the roles of the bodies exchanged.

use std::f64::consts::PI;

use crate::common::{lead, steel};
use asperity::bem::ElasticPair;
use asperity::contact_law::{named, registry};
use asperity::law::{Body, Inapplicable, Property};
use asperity::{Flat, LayeredFlat, Material, ModulusModel, Regime, Shape};

fn body(young: f64, poisson: f64, hardness: f64) -> Material {
    Material::new(young, poisson, Some(hardness), None).unwrap()
}

fn bronze() -> Material {
    body(110e9, 0.34, 1.9e9)
}

const T: f64 = 200e-9;
const B: f64 = 20e-6;

/// Hertz with the compliances written out: the coated steel asperity, and the bare bronze.
#[test]
fn the_effective_modulus_is_that_of_the_coated_rough_body() {
    let layered = LayeredFlat::new(&lead(), &steel(), T, ModulusModel::Gao).unwrap();
    let coated = Flat::with_layer(&lead(), &steel(), T, ModulusModel::Gao).unwrap();
    let contact = named("hertz").unwrap().interface_of(&coated, Body::Rough, &bronze()).unwrap();
    for w in [1e-12, 1e-9, 3e-8, 1e-6] {
        let (nu, young) = layered.elasticity(w, B);
        let of_bronze = (1.0 - 0.34f64.powi(2)) / 110e9;
        let modulus = ((1.0 - nu * nu) / young + of_bronze).recip();
        let found = contact.contact(w, Shape::sphere(B));
        let hertz = 4.0 / 3.0 * modulus * B.sqrt() * w.powf(1.5);
        assert!((found.load / hertz - 1.0).abs() < 1e-12, "{w:e}: {} {hertz}", found.load);
        assert!((found.area / (PI * B * w) - 1.0).abs() < 1e-12);
    }
    // Load ratios refer to the pair without the layer.
    let bare = named("hertz").unwrap().interface(&steel(), &Flat::Bare(bronze())).unwrap();
    assert_eq!(contact.reference_modulus(), bare.reference_modulus());
    let on_flat = Flat::with_layer(&lead(), &bronze(), T, ModulusModel::Gao).unwrap();
    let on_flat = named("hertz").unwrap().interface_of(&on_flat, Body::Flat, &steel()).unwrap();
    let [a, b] = [&contact, &on_flat].map(|contact| contact.contact(1e-7, Shape::sphere(B)).load);
    assert!((a / b - 1.0).abs() > 0.01, "the substrate counts: {a} {b}");
}

/// Under every law a body may be called rough or flat, layer and all.
#[test]
fn no_law_tells_the_bodies_apart() {
    for law in registry().iter().filter(|law| law.supports_layers()) {
        for t in [0.0, T, f64::INFINITY] {
            let coated = Flat::with_layer(&lead(), &steel(), t, ModulusModel::Series).unwrap();
            for bare in [steel(), bronze()] {
                let on = |body| law.interface_of(&coated, body, &bare).unwrap();
                let (rough, flat) = (on(Body::Rough), on(Body::Flat));
                for shape in [law.shape(B, 1.0), law.shape(B, 4.0)] {
                    for w in [1e-11, 1e-9, 1e-8, 1e-7, 1e-6] {
                        assert_eq!(rough.contact(w, shape), flat.contact(w, shape), "{} {t:e}", law.name());
                    }
                    assert_eq!(rough.regime_changes(shape), flat.regime_changes(shape));
                }
            }
        }
    }
}

/// The softer body yields: a hard layer moves the onset from the rough substrate, and a softer flat yields whatever the layer is.
#[test]
fn the_softer_of_coated_rough_body_and_flat_yields() {
    let zmc = named("zmc").unwrap();
    let hard = body(210e9, 0.3, 20e9);
    let onset = |substrate: Material, t: f64, bare: Material| {
        let coated = Flat::with_layer(&hard, &substrate, t, ModulusModel::Gao).unwrap();
        zmc.interface_of(&coated, Body::Rough, &bare).unwrap().regime_changes(Shape::sphere(B))[0]
    };
    let rigid = body(210e9, 0.3, 30e9);
    let bare = onset(steel(), 0.0, rigid);
    let coated = onset(steel(), 10e-6, rigid);
    assert!(coated > 2.0 * bare, "{coated:e} {bare:e}");
    let soft_flat = body(210e9, 0.3, 1e9);
    let [bare, coated] = [0.0, 10e-6].map(|t| onset(steel(), t, soft_flat));
    assert!((coated / bare - 1.0).abs() < 1e-12, "{coated:e} {bare:e}");
    let regime = |t: f64| {
        let coated = Flat::with_layer(&lead(), &steel(), t, ModulusModel::Gao).unwrap();
        zmc.interface_of(&coated, Body::Rough, &rigid).unwrap().contact(1e-8, Shape::sphere(B)).regime
    };
    assert_eq!([regime(0.0), regime(1e-5)], [Regime::Elastic, Regime::ElasticPlastic]);
}

#[test]
fn errors_name_the_body_by_its_own_role() {
    let law = named("jackson-green").unwrap();
    let elastic = Material::new(210e9, 0.3, None, None).unwrap();
    for is in [Body::Rough, Body::Flat] {
        let error = law.interface_of(&Flat::Bare(steel()), is, &elastic).err().unwrap();
        let Inapplicable::Lacking { property, body, .. } = error else { panic!("{error}") };
        assert_eq!((property, body), (Property::YieldStrength, Some(is)));
    }
}

/// Boundary elements take the sum of the displacements of both bodies.
#[test]
fn the_kernel_is_that_of_the_coated_body_and_the_bare_one() {
    let elastic = |body: Material| body.without_yielding();
    let (steel, bronze, lead) = (elastic(steel()), elastic(bronze()), elastic(lead()));
    let pair = ElasticPair::new(&bronze, &steel, Some((&lead, T)));
    let of_bronze = (1.0 - 0.34f64.powi(2)) / 110e9;
    let alone = |q: f64| pair.compliance(q) - 2.0 / q * of_bronze;
    // Long waves feel the steel below, short ones the lead.
    let half_space = |q: f64, nu: f64, young: f64| 2.0 / q * (1.0 - nu * nu) / young;
    assert!((alone(1e-4 / T) / half_space(1e-4 / T, 0.3, 210e9) - 1.0).abs() < 1e-2);
    assert!((alone(30.0 / T) / half_space(30.0 / T, 0.35, 18e9) - 1.0).abs() < 1e-9);
}
