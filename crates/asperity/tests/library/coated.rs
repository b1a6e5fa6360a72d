//! The layered flat: against vectors of 40 digits, and properties of any layer.

use crate::common::{Row, Worst, contact, lead, rows, steel};
use asperity::{
    AsperitySet, Deterministic, Flat, Heights, LayeredFlat, Material, MicroContact, Model, ModulusModel,
    Population, ReferencePlane, Shape, Statistical,
};

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
