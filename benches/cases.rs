//! Inputs of the benchmarks: the two surfaces of Table 1, all laws, layers on steel.

use asperity::contact_law::registry;
use asperity::{
    ContactLaw, Flat, Heights, Interface, Law, Material, MicroContact, ModulusModel, Population, Zmc,
};

/// Table 1 of Pasaribu and Schipper (2005).
pub const CASES: [(&str, Population); 2] = [
    ("case 1", Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN }),
    ("case 2", Population { radius: 1.6e-6, sigma: 2.6e-7, density: 9e10, heights: Heights::GAUSSIAN }),
];

fn material(young: f64, poisson: f64, hardness: f64) -> Material {
    Material::new(young, poisson, Some(hardness), Some(hardness / 2.8)).expect("a material")
}

fn steel() -> Material {
    material(210e9, 0.3, 7.6e9)
}

/// Steel on steel.
pub fn bare(law: impl Law + Clone) -> Box<dyn MicroContact> {
    Box::new(Interface::bare(law, &steel(), &steel()).expect("all laws accept steel"))
}

/// All laws for spheres, or for ellipses. The reference of the cost ratios, ZMC, is first.
pub fn laws(of_ellipses: bool) -> Vec<(String, Box<dyn MicroContact>)> {
    let mut laws: Vec<&ContactLaw> =
        registry().iter().filter(|law| law.is_elliptic() == of_ellipses).collect();
    laws.sort_by_key(|law| law.law().name() != "zmc");
    let on_steel =
        |law: &ContactLaw| law.interface(&steel(), &Flat::Bare(steel())).expect("all laws accept steel");
    laws.into_iter().map(|law| (law.name(), on_steel(law))).collect()
}

/// ZMC on steel: uncoated first, then coated with lead and with a hard ceramic.
pub fn flats() -> [(&'static str, Box<dyn MicroContact>); 7] {
    let under = |layer: Material, thickness: f64| -> Box<dyn MicroContact> {
        let flat = Flat::with_layer(&layer, &steel(), thickness, ModulusModel::Gao).expect("a layer");
        flat.under(Zmc::default(), &steel()).expect("a contact")
    };
    let lead = |thickness| under(material(18e9, 0.35, 0.17e9), thickness);
    let ceramic = |thickness| under(material(400e9, 0.2, 21e9), thickness);
    [
        ("uncoated", bare(Zmc::default())),
        ("10 nm of lead", lead(1e-8)),
        ("50 nm of lead", lead(5e-8)),
        ("1 um of lead", lead(1e-6)),
        ("10 nm of ceramic", ceramic(1e-8)),
        ("50 nm of ceramic", ceramic(5e-8)),
        ("1 um of ceramic", ceramic(1e-6)),
    ]
}
