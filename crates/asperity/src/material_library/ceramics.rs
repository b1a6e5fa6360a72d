//! Ceramics, glasses, semiconductors and hard coatings. They crack under sharp contacts, which no law here describes.

use super::references::{ANSTIS, CALLISTER_QUOTED, DOWLING, HEAT_TRANSFER, KAYE_LABY, OLIVER_PHARR, WANG};
use super::{Class, LibraryMaterial, Sourced};

/// One kilogram-force per square millimetre, Pa: the unit of Vickers and Knoop numbers.
const HV: f64 = 9.80665e6;

const TECHNICAL: &str = "Céramique Technique, comparative table of properties of technical ceramics";
const SCHOTT: &str = "SCHOTT data sheet N-BK7 517642.251";
const SILICA: &str = "Piter Optics data sheet fused silica";
const ASSUMED: &str = "0.25 ± 0.1 changes E* by about 5 %";

const fn of(value: f64, reference: &'static str, note: &'static str) -> Sourced {
    Sourced { value, reference, note }
}

const fn ceramic(
    name: &'static str,
    description: &'static str,
    [young, poisson, hardness]: [Sourced; 3],
) -> LibraryMaterial {
    LibraryMaterial {
        name,
        description,
        class: Class::Ceramic,
        young,
        poisson,
        hardness: Some(hardness),
        yield_strength: None,
        resistivity: None,
        thermal_conductivity: None,
    }
}

pub(super) const CERAMICS: &[LibraryMaterial] = &[
    ceramic(
        "tungsten-carbide-Co",
        "cemented carbide WC-Co",
        [of(575e9, ANSTIS, ""), of(0.22, KAYE_LABY, "tungsten carbide"), of(13.2e9, ANSTIS, "")],
    )
    .conducting(Some(of(85.0, "MakeItFrom data sheet tungsten carbide", "cobalt content not stated; 110 W/(m K) for the pure compound in other tables")), None),
    ceramic(
        "silicon-nitride",
        "silicon nitride Si3N4, sintered",
        [
            of(308e9, TECHNICAL, "300 to 315 GPa"),
            of(0.28, CALLISTER_QUOTED, "sintered"),
            of(15.5e9, TECHNICAL, "15 to 16 GPa"),
        ],
    )
    .conducting(Some(of(31.0, "MakeItFrom data sheet hot-pressed silicon nitride", "pressure-sintered; 12 to 31 W/(m K) for all grades")), None),
    ceramic(
        "alumina",
        "alumina Al2O3, 94 to 99.8 %",
        [of(360e9, TECHNICAL, "350 to 370 GPa"), of(0.22, DOWLING, ""), of(15e9, TECHNICAL, "12 to 18 GPa")],
    )
    .conducting(Some(of(32.0, "Ashby, Materials and the Environment, data sheet alumina", "26 to 38.5 W/(m K)")), None),
    ceramic(
        "zirconia-3Y-TZP",
        "zirconia with 3 mol% yttria, tetragonal",
        [
            of(205e9, CALLISTER_QUOTED, "zirconia, 3 mol% Y2O3"),
            of(0.31, CALLISTER_QUOTED, "zirconia, 3 mol% Y2O3"),
            of(1300.0 * HV, "Kientec data sheet ceramic ferrules, ZrO2", "12 to 16 GPa in other data sheets"),
        ],
    )
    .conducting(Some(of(2.5, "Kientec data sheet ceramic ferrules, ZrO2", "")), None),
    ceramic(
        "silicon-carbide",
        "silicon carbide SiC, hot-pressed (NC203)",
        [of(436e9, ANSTIS, ""), of(0.17, CALLISTER_QUOTED, "hot-pressed"), of(24e9, ANSTIS, "")],
    )
    .conducting(Some(of(120.0, "MakeItFrom data sheet silicon carbide", "120 to 170 W/(m K) for all grades")), None),
    ceramic(
        "glass-soda-lime",
        "soda-lime glass",
        [of(69e9, DOWLING, ""), of(0.20, DOWLING, ""), of(5.5e9, ANSTIS, "")],
    )
    .conducting(Some(of(1.05, "MakeItFrom data sheet soda-lime glass", "1.0 to 1.1 W/(m K)")), None),
    ceramic(
        "glass-BK7",
        "borosilicate crown glass N-BK7",
        [of(82e9, SCHOTT, ""), of(0.206, SCHOTT, ""), of(610.0 * HV, SCHOTT, "Knoop, HK 0.1/20")],
    )
    .conducting(Some(of(1.09, "Glass Dynamics data sheet BK7 and fused silica", "0.0026 cal/(cm s K) at 20 °C")), None),
    ceramic(
        "silica-fused",
        "fused silica SiO2",
        [of(73e9, SILICA, ""), of(0.17, SILICA, ""), of(500.0 * HV, SILICA, "Knoop")],
    )
    .conducting(Some(of(1.38, "Glass Dynamics data sheet BK7 and fused silica", "0.0033 cal/(cm s K) at 20 °C")), None),
    ceramic(
        "silicon-100",
        "silicon, single crystal, isotropic values for the [100] direction",
        [
            of(
                130e9,
                "Hopcroft, Nix and Kenny, J. Microelectromech. Syst. 19 (2010) 229 (quoted; original not consulted)",
                "[100] direction",
            ),
            of(
                0.28,
                "Hopcroft, Nix and Kenny, J. Microelectromech. Syst. 19 (2010) 229 (quoted; original not consulted)",
                "[100] direction",
            ),
            of(10.6e9, ANSTIS, "on (111)"),
        ],
    )
    .conducting(Some(of(148.0, HEAT_TRANSFER, "300 K, pure")), None),
    ceramic(
        "diamond",
        "diamond",
        [
            of(960e9, DOWLING, "700 to 1200 GPa in other tables"),
            of(0.20, DOWLING, ""),
            of(98e9, "MatWeb, mechanical properties of elements", "on (111); 88 to 147 GPa on (001)"),
        ],
    )
    .conducting(Some(of(2000.0, "Diamond Materials, thermal properties of CVD diamond", "CVD, 1800 W/(m K) at least; 2200 W/(m K) for natural diamond elsewhere")), None),
    ceramic(
        "coating-DLC",
        "amorphous carbon (DLC), magnetron sputtered; films differ widely",
        [
            of(166e9, WANG, "films of other processes 100 to 250 GPa"),
            of(0.25, OLIVER_PHARR, ASSUMED),
            of(16.7e9, WANG, "films of other processes 12 to 24 GPa"),
        ],
    )
    .conducting(Some(of(1.0, "Thermal conductivity of diamond-like carbon films (3ω method), abstract", "hydrogenated tetrahedral; 0.2 to 3.5 W/(m K) for all kinds of film")), None),
    ceramic(
        "coating-TiN",
        "titanium nitride TiN, magnetron sputtered",
        [of(397e9, WANG, ""), of(0.25, OLIVER_PHARR, ASSUMED), of(23.6e9, WANG, "")],
    )
    .conducting(Some(of(35.0, "Thermal conductivity of hard oxynitride coatings, Thin Solid Films 549 (2013) 232, abstract", "arc-evaporated; 29 W/(m K) for the bulk in other tables")), None),
    ceramic(
        "coating-CrN",
        "chromium nitride CrN, magnetron sputtered",
        [
            of(422e9, WANG, ""),
            of(0.25, OLIVER_PHARR, ASSUMED),
            of(17.9e9, WANG, "films of other processes 12 to 19 GPa"),
        ],
    )
    .conducting(Some(of(9.0, "Thermal conductivity of hard oxynitride coatings, Thin Solid Films 549 (2013) 232, abstract", "arc-evaporated")), None),
];
