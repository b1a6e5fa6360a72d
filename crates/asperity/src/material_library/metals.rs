//! Metals and alloys.

use super::references::{
    ASM_304, ASM_316, ASM_6061, ASM_7075, ASM_TITANIUM, CALLISTER, CALLISTER_QUOTED, DOWLING, EN_1561,
    EN_10083_2, EN_10083_3, EN_12166, EUROCODE, KAYE_LABY, SAMSONOV,
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
    ),
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
    ),
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
    ),
    metal(
        "steel-304",
        "austenitic stainless steel AISI 304 (1.4301), annealed",
        [
            of(193e9, CALLISTER, "stainless steel 304"),
            of(0.30, CALLISTER_QUOTED, "stainless steel 304"),
            of(129.0 * HV, ASM_304, "converted from 123 HB"),
        ],
        None,
    ),
    metal(
        "steel-316",
        "austenitic stainless steel AISI 316 (1.4401; 316L is similar), annealed",
        [
            of(193e9, ASM_316, ""),
            of(0.30, CALLISTER_QUOTED, "stainless steel 316"),
            of(155.0 * HV, ASM_316, "converted from 149 HB"),
        ],
        None,
    ),
    metal(
        "cast-iron-GJL-250",
        "grey cast iron EN-GJL-250, pearlitic",
        [
            of(110e9, EN_1561, "103 to 118 GPa"),
            of(0.26, EN_1561, ""),
            of(205.0 * HV, "Modelleria Zuin data sheet GJL-250 (EN 1561)", "Brinell, 170 to 240 HB"),
        ],
        None,
    ),
    metal(
        "aluminium-6061-T6",
        "aluminium alloy 6061, T6",
        [of(68.9e9, ASM_6061, ""), of(0.33, ASM_6061, ""), of(107.0 * HV, ASM_6061, "converted from 95 HB")],
        Some(of(276e6, ASM_6061, "typical")),
    ),
    metal(
        "aluminium-7075-T6",
        "aluminium alloy 7075, T6",
        [of(71.7e9, ASM_7075, ""), of(0.33, ASM_7075, ""), of(175.0 * HV, ASM_7075, "converted from 150 HB")],
        Some(of(503e6, ASM_7075, "typical")),
    ),
    metal(
        "titanium-Ti6Al4V",
        "titanium alloy Ti-6Al-4V (grade 5), annealed bar",
        [
            of(114e9, ASM_TITANIUM, ""),
            of(0.33, ASM_TITANIUM, ""),
            of(349.0 * HV, ASM_TITANIUM, "converted from 36 HRC"),
        ],
        Some(of(860e6, ASM_TITANIUM, "in compression; 830 MPa in tension")),
    ),
    metal(
        "bronze-CuSn8",
        "tin bronze CuSn8 (CW453K, C52100), hard",
        [
            of(110e9, "MakeItFrom data sheet UNS C52100, H04", ""),
            of(0.34, "MakeItFrom data sheet UNS C52100, H04", ""),
            of(200.0 * HV, "RCI Industries data sheet PB-IV (CuSn8)", "hard, at least"),
        ],
        Some(of(500e6, "RCI Industries data sheet PB-IV (CuSn8)", "hard, at least")),
    ),
    metal(
        "brass-CuZn37",
        "brass CuZn37 (CW508L), quarter hard wire",
        [
            of(101e9, DOWLING, "brass 70Cu-30Zn"),
            of(0.35, DOWLING, "brass 70Cu-30Zn"),
            of(130.0 * HV, EN_12166, "state H130, at least"),
        ],
        Some(of(390e6, EN_12166, "state R470, for guidance")),
    ),
    metal(
        "copper",
        "copper, pure, annealed",
        [
            of(130e9, DOWLING, ""),
            of(0.343, DOWLING, ""),
            of(369e6, SAMSONOV, "343 to 369 MPa; cold-worked up to three times as much"),
        ],
        None,
    ),
    metal(
        "nickel",
        "nickel, pure, annealed; electroplated nickel is several times as hard",
        [of(199.5e9, KAYE_LABY, "soft"), of(0.312, KAYE_LABY, "soft"), of(638e6, SAMSONOV, "")],
        None,
    ),
    metal(
        "silver",
        "silver, pure, annealed",
        [of(82.7e9, KAYE_LABY, ""), of(0.367, KAYE_LABY, ""), of(251e6, SAMSONOV, "")],
        None,
    ),
    metal(
        "gold",
        "gold, pure, annealed; electroplated hard gold is several times as hard",
        [of(78e9, KAYE_LABY, ""), of(0.44, KAYE_LABY, ""), of(216e6, SAMSONOV, "188 to 216 MPa")],
        None,
    ),
    metal(
        "lead",
        "lead, pure",
        [of(16.1e9, DOWLING, ""), of(0.44, DOWLING, ""), of(38.3e6, SAMSONOV, "Brinell, 38 to 50 MPa")],
        None,
    ),
    metal(
        "tungsten",
        "tungsten, pure",
        [of(411e9, DOWLING, ""), of(0.28, DOWLING, ""), of(3.43e9, SAMSONOV, "3.43 to 4.6 GPa")],
        None,
    ),
];
