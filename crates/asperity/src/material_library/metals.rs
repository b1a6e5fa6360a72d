//! Metals and alloys.

use super::references::{
    ASM_304, ASM_316, ASM_6061, ASM_7075, ASM_TITANIUM, CALLISTER, CALLISTER_QUOTED, DOWLING, EN_1561,
    EN_10083_2, EN_10083_3, EN_12166, EUROCODE, HEAT_TRANSFER, KAYE_LABY, MITCHELL, SAMSONOV,
};
use super::{Class, LibraryMaterial, Sourced};

/// One kilogram-force per square millimetre, Pa: the unit of Vickers and Brinell numbers.
const HV: f64 = 9.80665e6;

const fn of(value: f64, reference: &'static str, note: &'static str) -> Sourced {
    Sourced { value, reference, note }
}

/// A metal: modulus, Poisson's ratio, hardness, yield strength.
const fn metal(
    name: &'static str,
    description: &'static str,
    [young, poisson, hardness]: [Sourced; 3],
    yield_strength: Option<Sourced>,
) -> LibraryMaterial {
    LibraryMaterial {
        name,
        description,
        class: Class::Metal,
        young,
        poisson,
        hardness: Some(hardness),
        yield_strength,
        resistivity: None,
        thermal_conductivity: None,
    }
}

const BEARING: &str = "AZoM data sheet AISI 52100 alloy steel";

pub(super) const METALS: &[LibraryMaterial] = &[
    metal(
        "steel-100Cr6",
        "bearing steel 100Cr6 (AISI 52100, 1.3505), hardened to 62 HRC",
        [
            of(210e9, BEARING, "typical, 190 to 210 GPa"),
            of(0.30, BEARING, "typical, 0.27 to 0.30"),
            of(746.0 * HV, BEARING, "62 HRC, which is 746 HV (ASTM E140-12, Table 1); bearings 58 to 65 HRC"),
        ],
        None,
    )
    .conducting(Some(of(47.0, "MakeItFrom data sheet SAE-AISI 52100", "180 to 210 HB, softer than the entry")), None),
    metal(
        "steel-C45-normalised",
        "carbon steel C45 (AISI 1045, 1.0503), normalised",
        [
            of(210e9, EUROCODE, "structural steels"),
            of(0.30, EUROCODE, "structural steels"),
            of(
                195.0 * HV,
                EN_10083_2,
                "tensile strength 620 MPa at least (up to 16 mm), which is 195 HV (ISO 18265:2013, Table A.1)",
            ),
        ],
        None,
    )
    .conducting(Some(of(51.0, "MakeItFrom data sheet SAE-AISI 1045", "")), Some(of(1.62e-07, "MatWeb data sheet AISI 1045, cold drawn (quoted; original not consulted)", "annealed specimen at 0 °C"))),
    metal(
        "steel-42CrMo4-QT",
        "low-alloy steel 42CrMo4 (AISI 4140, 1.7225), quenched and tempered, up to 16 mm",
        [
            of(207e9, CALLISTER, "steel 4140"),
            of(0.30, CALLISTER_QUOTED, "plain carbon and low-alloy steels"),
            of(
                340.0 * HV,
                EN_10083_3,
                "tensile strength 1100 MPa (1100 to 1300), which is 340 HV (ISO 18265:2013, Table A.1)",
            ),
        ],
        Some(of(900e6, EN_10083_3, "at least")),
    )
    .conducting(Some(of(42.6, "Meusburger data sheet 1.7225 (42CrMo4)", "at 20 °C")), Some(of(2.2e-07, "MatWeb data sheet AISI 4140, oil quenched, 205 °C temper", "hardened and tempered specimen, 20 °C"))),
    metal(
        "steel-304",
        "austenitic stainless steel AISI 304 (1.4301), annealed",
        [
            of(193e9, CALLISTER, "stainless steel 304"),
            of(0.30, CALLISTER_QUOTED, "stainless steel 304"),
            of(129.0 * HV, ASM_304, "converted from 123 HB"),
        ],
        None,
    )
    .conducting(Some(of(16.2, ASM_304, "0 to 100 °C")), Some(of(7.2e-07, ASM_304, "at 20 °C"))),
    metal(
        "steel-316",
        "austenitic stainless steel AISI 316 (1.4401; 316L is similar), annealed",
        [
            of(193e9, ASM_316, ""),
            of(0.30, CALLISTER_QUOTED, "stainless steel 316"),
            of(155.0 * HV, ASM_316, "converted from 149 HB"),
        ],
        None,
    )
    .conducting(Some(of(14.6, "MakeItFrom data sheet AISI 316", "ambient; 15 W/(m K) for annealed 316L")), Some(of(7.4e-07, ASM_316, "at 20 °C"))),
    metal(
        "cast-iron-GJL-250",
        "grey cast iron EN-GJL-250, pearlitic",
        [
            of(110e9, EN_1561, "103 to 118 GPa"),
            of(0.26, EN_1561, ""),
            of(205.0 * HV, "Modelleria Zuin data sheet GJL-250 (EN 1561)", "Brinell, 170 to 240 HB"),
        ],
        None,
    )
    .conducting(Some(of(46.0, "MakeItFrom data sheet ASTM grade 35 (EN-JL 1040)", "grey iron of grade 250")), None),
    metal(
        "aluminium-6061-T6",
        "aluminium alloy 6061, T6",
        [of(68.9e9, ASM_6061, ""), of(0.33, ASM_6061, ""), of(107.0 * HV, ASM_6061, "converted from 95 HB")],
        Some(of(276e6, ASM_6061, "typical")),
    )
    .conducting(Some(of(167.0, ASM_6061, "typical, 25 °C")), Some(of(3.99e-08, ASM_6061, "typical, 20 °C"))),
    metal(
        "aluminium-7075-T6",
        "aluminium alloy 7075, T6",
        [of(71.7e9, ASM_7075, ""), of(0.33, ASM_7075, ""), of(175.0 * HV, ASM_7075, "converted from 150 HB")],
        Some(of(503e6, ASM_7075, "typical")),
    )
    .conducting(Some(of(130.0, ASM_7075, "")), Some(of(5.15e-08, ASM_7075, "at 20 °C"))),
    metal(
        "titanium-Ti6Al4V",
        "titanium alloy Ti-6Al-4V (grade 5), annealed bar",
        [
            of(114e9, ASM_TITANIUM, ""),
            of(0.33, ASM_TITANIUM, ""),
            of(349.0 * HV, ASM_TITANIUM, "converted from 36 HRC"),
        ],
        Some(of(860e6, ASM_TITANIUM, "in compression; 830 MPa in tension")),
    )
    .conducting(Some(of(6.6, "Lumina data sheet Ti-6Al-4V (ASTM grade 5)", "6.6 to 7.2 W/(m K) in data sheets")), Some(of(1.78e-06, ASM_TITANIUM, ""))),
    metal(
        "bronze-CuSn8",
        "tin bronze CuSn8 (CW453K, C52100), hard",
        [
            of(110e9, "MakeItFrom data sheet UNS C52100, H04", ""),
            of(0.34, "MakeItFrom data sheet UNS C52100, H04", ""),
            of(200.0 * HV, "RCI Industries data sheet PB-IV (CuSn8)", "hard, at least"),
        ],
        Some(of(500e6, "RCI Industries data sheet PB-IV (CuSn8)", "hard, at least")),
    )
    .conducting(Some(of(62.0, "MakeItFrom data sheet UNS C52100, H04", "")), Some(of(1.33e-07, "MakeItFrom data sheet UNS C52100, H04", "13 % IACS"))),
    metal(
        "brass-CuZn37",
        "brass CuZn37 (CW508L), quarter hard wire",
        [
            of(101e9, DOWLING, "brass 70Cu-30Zn"),
            of(0.35, DOWLING, "brass 70Cu-30Zn"),
            of(130.0 * HV, EN_12166, "state H130, at least"),
        ],
        Some(of(390e6, EN_12166, "state R470, for guidance")),
    )
    .conducting(Some(of(121.0, "KME data sheet CuZn37 (CW508L)", "annealed, 20 °C")), Some(of(7.1e-08, "KME data sheet CuZn37 (CW508L)", "at most (14 MS/m at least), annealed, 20 °C"))),
    metal(
        "copper",
        "copper, pure, annealed",
        [
            of(130e9, DOWLING, ""),
            of(0.343, DOWLING, ""),
            of(369e6, SAMSONOV, "343 to 369 MPa; cold-worked up to three times as much"),
        ],
        None,
    )
    .conducting(Some(of(401.0, HEAT_TRANSFER, "300 K")), Some(of(1.71e-08, MITCHELL, "5.85e7 S/m"))),
    metal(
        "nickel",
        "nickel, pure, annealed; electroplated nickel is several times as hard",
        [of(199.5e9, KAYE_LABY, "soft"), of(0.312, KAYE_LABY, "soft"), of(638e6, SAMSONOV, "")],
        None,
    )
    .conducting(Some(of(90.7, HEAT_TRANSFER, "300 K; commercial grades less")), Some(of(7e-08, "data sheet Super Pure Nickel Ni 99.98 (studylib 8758886)", "± 10 %; annealed, 20 °C"))),
    metal(
        "silver",
        "silver, pure, annealed",
        [of(82.7e9, KAYE_LABY, ""), of(0.367, KAYE_LABY, ""), of(251e6, SAMSONOV, "")],
        None,
    )
    .conducting(Some(of(429.0, HEAT_TRANSFER, "300 K")), Some(of(1.59e-08, MITCHELL, "6.3e7 S/m"))),
    metal(
        "gold",
        "gold, pure, annealed; electroplated hard gold is several times as hard",
        [of(78e9, KAYE_LABY, ""), of(0.44, KAYE_LABY, ""), of(216e6, SAMSONOV, "188 to 216 MPa")],
        None,
    )
    .conducting(Some(of(317.0, HEAT_TRANSFER, "300 K")), Some(of(2.35e-08, MITCHELL, "4.25e7 S/m; 2.44e-8 ohm m in other tables"))),
    metal(
        "lead",
        "lead, pure",
        [of(16.1e9, DOWLING, ""), of(0.44, DOWLING, ""), of(38.3e6, SAMSONOV, "Brinell, 38 to 50 MPa")],
        None,
    )
    .conducting(Some(of(35.3, HEAT_TRANSFER, "300 K")), Some(of(2.06e-07, MITCHELL, ""))),
    metal(
        "tungsten",
        "tungsten, pure",
        [of(411e9, DOWLING, ""), of(0.28, DOWLING, ""), of(3.43e9, SAMSONOV, "3.43 to 4.6 GPa")],
        None,
    )
    .conducting(Some(of(174.0, "Wolfram Industrie data sheet tungsten", "293 K")), Some(of(5.3e-08, MITCHELL, "5.3e-8 to 5.65e-8 ohm m in other tables"))),
];
