//! The layered flat: against vectors of 40 digits, and properties of any layer.

use crate::common::{Row, Worst, contact, rows};
use asperity::{
    AsperitySet, Deterministic, Flat, Heights, LayeredFlat, Material, MicroContact, Model, ModulusModel,
    Population, ReferencePlane, Shape, Statistical,
};

fn steel() -> Material {
    Material::new(210e9, 0.3, Some(7.6e9), None).unwrap()
}

fn lead() -> Material {
    Material::new(18e9, 0.35, Some(0.17e9), None).unwrap()
}

/// ZMC against a flat with a layer of any thickness, 0 and infinity included.
fn flat(rough: &Material, layer: &Material, substrate: &Material, thickness: f64) -> Box<dyn MicroContact> {
    contact("zmc", &[], rough, &Flat::with_layer(layer, substrate, thickness, ModulusModel::Gao).unwrap())
}

fn body(row: &Row, name: &str, strength: Option<f64>) -> Material {
    let number = |property: &str| row.number(&format!("{name}_{property}"));
    Material::new(number("young"), number("poisson"), Some(number("hardness")), strength).unwrap()
}

/// Every column of coating.csv.
#[test]
fn effective_properties_and_the_coated_contact() {
    let (mut properties, mut contacts) = (Worst::default(), Worst::default());
    for (k, row) in rows("coating").iter().enumerate() {
        let (w, b) = (row.number("indentation"), row.number("radius"));
        let rough = body(row, "rough", None);
        let layer = body(row, "layer", Some(row.number("layer_yield")));
        let substrate = body(row, "substrate", Some(row.number("substrate_yield")));
        let layered =
            LayeredFlat::new(&layer, &substrate, row.number("thickness"), ModulusModel::Gao).unwrap();
        let found = layered.at(w, b);
        let mut see = |value, column: &str| {
            properties.see(value, row.number(column), || format!("{column} of row {k}"))
        };
        let (poisson, young) = layered.elasticity(w, b);
        see(poisson, "effective_poisson");
        see(young, "effective_young");
        see(found.hardness, "effective_hardness");
        see((rough.plane_compliance() + found.compliance).recip(), "reduced_modulus");
        let flat = Flat::Layered { substrate, layered };
        let contact = contact("zmc", &[], &rough, &flat).contact(w, Shape::sphere(b));
        contacts.see(contact.area, row.number("area"), || format!("area of row {k}"));
        contacts.see(contact.load, row.number("load"), || format!("load of row {k}"));
        assert_eq!(contact.regime.name(), row.text("regime"), "row {k}");
    }
    properties.assert_within(1e-12, 4 * 240);
    contacts.assert_within(1e-12, 480);
}

#[test]
fn statistical_under_lead_and_under_a_hard_coating() {
    let mut worst = Worst::default();
    for row in &rows("statistical_coated") {
        let layer = body(row, "layer", None);
        let contact = flat(&steel(), &layer, &steel(), row.number("thickness"));
        let population = Population {
            radius: row.number("radius"),
            sigma: row.number("sigma"),
            density: row.number("density"),
            heights: Heights::GAUSSIAN,
        };
        let h = row.number("separation_over_sigma");
        let found = Statistical::new(&*contact, population).respond(h);
        let place = || format!("{} of {} at h = {h}", row.text("layer"), row.text("thickness"));
        worst.see(found.area_ratio.total(), row.number("area_ratio"), || format!("area, {}", place()));
        worst.see(found.pressure.total(), row.number("pressure"), || format!("pressure, {}", place()));
    }
    worst.assert_within(1e-12, 210);
}

/// Bare, under 50 nm of lead, and all lead.
#[test]
fn sums_over_asperities() {
    let asperities = rows("asperities");
    let mut worst = Worst::default();
    for row in rows("asperity_sums") {
        let contact = flat(&steel(), &lead(), &steel(), row.number("lead_thickness"));
        let members = || asperities.iter().filter(|a| a.text("set") == row.text("set"));
        let heights = members().map(|a| a.number("height")).collect();
        let radii = members().map(|a| a.number("radius")).collect();
        let set = AsperitySet::new(heights, radii, 1.0).unwrap();
        let d = row.number("separation");
        let found =
            Deterministic::new(&*contact, set.spheres(), ReferencePlane { mean: 0.0, sigma: 1.0 }).total(d);
        let place = || format!("set {} under {} at {d:e}", row.text("set"), row.text("lead_thickness"));
        assert_eq!(found.contacts(), row.number("contacts"), "{}", place());
        worst.see(found.area().total(), row.number("total_area"), place);
        worst.see(found.load().total(), row.number("total_load"), place);
    }
    worst.assert_within(1e-13, 140);
}

/// PHYSICS of the two spheres of Fig. 5: loads at given indentations, and where the regime changes.
#[test]
fn the_two_spheres_of_figure_5() {
    let copper = Material::new(140e9, 0.3, Some(1.86e9), None).unwrap();
    let sherbiny = flat(&steel(), &lead(), &copper, 1.2e-6);
    let diamond = Material::new(1140e9, 0.07, None, None).unwrap();
    let ceramic = Material::new(400e9, 0.3, Some(21e9), None).unwrap();
    let substrate = Material::new(200e9, 0.07, Some(7.6e9), None).unwrap();
    let tang_arnell = flat(&diamond, &ceramic, &substrate, 1e-6);
    let loads = |contact: &dyn MicroContact, b: f64, known: &[(f64, f64)]| {
        for &(w, load) in known {
            let found = contact.contact(w * 1e-6, Shape::sphere(b)).load;
            assert!((found / load - 1.0).abs() < 2e-6, "{found} N, expected {load} at {w} um");
        }
    };
    loads(
        &*sherbiny,
        12.75e-3,
        &[(0.1, 0.375385), (0.5, 4.06646), (1.0, 13.6708), (2.0, 39.129), (5.0, 153.356)],
    );
    loads(&*tang_arnell, 100e-6, &[(0.1, 0.0878111), (0.5, 0.908916), (1.0, 2.24359), (2.0, 4.78555)]);
    let changes = |contact: &dyn MicroContact, b: f64, known: &[f64]| {
        let found: Vec<f64> = contact.regime_changes(Shape::sphere(b)).into_iter().map(|w| w * 1e6).collect();
        assert_eq!(found.len(), known.len(), "{found:?}");
        for (found, known) in found.iter().zip(known) {
            assert!((found / known - 1.0).abs() < 1e-3, "{found} um, expected {known}");
        }
    };
    changes(&*sherbiny, 12.75e-3, &[0.0409, 1.057, 4.627, 248.6]);
    changes(&*tang_arnell, 100e-6, &[0.635, 8.76]);
}
