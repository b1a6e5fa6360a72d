//! Polymers. They creep: modulus and hardness are those of tests of a minute, dry, at 23 °C.

use super::references::{CALLISTER, CALLISTER_QUOTED, DOWLING};
use super::{Class, LibraryMaterial, Sourced};

const ENSINGER_PEEK: &str = "Ensinger data sheet TECAPEEK natural (quoted; original not consulted)";
const ENSINGER_PA66: &str = "Ensinger data sheet TECAMID 66 natural (quoted; original not consulted)";
const POM: &str = "data sheet POM-C, rods of 40 to 60 mm (Scribd 479235228)";
const PLEXIGLAS: &str = "Röhm data sheet PLEXIGLAS GS (quoted; original not consulted)";
const BALL: &str = "ball indentation, ISO 2039-1";

const fn of(value: f64, reference: &'static str, note: &'static str) -> Sourced {
    Sourced { value, reference, note }
}

const fn polymer(
    name: &'static str,
    description: &'static str,
    [young, poisson]: [Sourced; 2],
    [hardness, yield_strength]: [Option<Sourced>; 2],
) -> LibraryMaterial {
    LibraryMaterial {
        name,
        description,
        class: Class::Polymer,
        young,
        poisson,
        hardness,
        yield_strength,
        resistivity: None,
        thermal_conductivity: None,
    }
}

pub(super) const POLYMERS: &[LibraryMaterial] = &[
    polymer(
        "PEEK",
        "polyetheretherketone, unfilled",
        [
            of(4.2e9, ENSINGER_PEEK, "in tension"),
            of(0.40, "Victrex, Materials Properties Guide (quoted; original not consulted)", "PEEK 450G"),
        ],
        [Some(of(253e6, ENSINGER_PEEK, BALL)), Some(of(116e6, ENSINGER_PEEK, ""))],
    )
    .conducting(Some(of(0.25, "matmake, thermal conductivity of polymers and plastics", "")), None),
    polymer(
        "POM",
        "polyoxymethylene, copolymer",
        [
            of(2.855e9, POM, ""),
            of(
                0.35,
                "DuPont, Delrin Design Information, module III (quoted; original not consulted)",
                "homopolymer",
            ),
        ],
        [Some(of(125e6, POM, "ball indentation, ISO 2039")), Some(of(67e6, POM, "at yield"))],
    )
    .conducting(Some(of(0.31, "Quadrant data sheet Acetron MD", "copolymer with a metal-detectable additive; 0.2 W/(m K) in Crawford, Plastics Engineering, Table 1.8")), None),
    polymer(
        "PA66",
        "polyamide 66, dry; moist it is half as stiff",
        [of(2.7e9, DOWLING, "nylon 66, dry"), of(0.41, DOWLING, "nylon 66, dry")],
        [Some(of(175e6, ENSINGER_PA66, BALL)), Some(of(84e6, ENSINGER_PA66, "at yield"))],
    )
    .conducting(Some(of(0.24, "Crawford, Plastics Engineering, Table 1.8", "")), None),
    polymer(
        "PMMA",
        "polymethyl methacrylate, cast",
        [of(2.7e9, DOWLING, "2.24 to 3.24 GPa in other tables"), of(0.35, DOWLING, "")],
        [Some(of(175e6, PLEXIGLAS, BALL)), None],
    )
    .conducting(Some(of(0.19, "MakeItFrom data sheet PMMA", "")), None),
    polymer(
        "PTFE",
        "polytetrafluoroethylene, unfilled",
        [of(0.475e9, CALLISTER, "0.40 to 0.55 GPa"), of(0.46, CALLISTER_QUOTED, "")],
        [None, Some(of(14.5e6, CALLISTER, "13.8 to 15.2 MPa"))],
    )
    .conducting(Some(of(0.25, "Crawford, Plastics Engineering, Table 1.8", "")), None),
    polymer(
        "UHMWPE",
        "polyethylene of ultra-high molecular weight",
        [
            of(0.69e9, CALLISTER, ""),
            of(
                0.46,
                "Kurtz, UHMWPE Biomaterials Handbook, 2nd ed. (2009) (quoted; original not consulted)",
                "typical",
            ),
        ],
        [None, None],
    )
    .conducting(Some(of(0.45, "matmake, thermal conductivity of polymers and plastics", "0.45 to 0.52 W/(m K)")), None),
];
