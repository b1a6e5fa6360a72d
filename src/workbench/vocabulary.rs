//! What the page needs once: the keys of a spec with their explanations, the materials of the library, the laws, units.

use asperity::contact_law;
use asperity::material_library;
use asperity::units::Dimension;
use asperity_contact_framework::keys::Default;
use asperity_contact_framework::report::format::input_quantity;
use serde_json::{Map, Value, json};

use crate::keys::all;

/// Keys by their names, materials, names of laws, units of length.
pub fn vocabulary() -> Value {
    let key = |key: &asperity_contact_framework::keys::Key| {
        let default = match &key.default {
            Default::Needed => json!("none; it is needed"),
            Default::Is(text) | Default::Words(text) => json!(text),
            Default::Open => Value::Null,
        };
        let fields = json!({
            "meaning": key.meaning,
            "kind": key.kind,
            "unit": key.unit,
            "range": key.range,
            "default": default,
            "examples": key.examples,
            "values": key.values,
        });
        (key.name(), fields)
    };
    let keys: Map<String, Value> = all().iter().map(key).collect();
    let materials: Vec<Value> = material_library::all()
        .map(|material| {
            json!({
                "name": material.name,
                "description": material.description,
                "class": material.class.name(),
                "young": input_quantity(material.young.value, "Pa"),
                "poisson": material.poisson.value,
                "hardness": material.hardness.as_ref().map(|hardness| input_quantity(hardness.value, "Pa")),
            })
        })
        .collect();
    let laws: Vec<[String; 2]> = contact_law::registry()
        .iter()
        .map(|law| {
            let papers: Vec<&str> = law.papers().iter().map(|paper| paper.short).collect();
            [law.name(), format!("{}: {}", law.name(), papers.join(", "))]
        })
        .collect();
    let lengths = Dimension::Length.documented();
    json!({ "keys": keys, "materials": materials, "laws": laws, "lengths": lengths })
}
