//! The table of materials. Sources that say so were not at hand when it was written: their values are quoted, and are to be checked against
//! the original.

use super::{Class, LibraryMaterial, Sourced};

/// One kilogram-force per square millimetre, Pa: the unit of Vickers, Brinell and Knoop numbers.
const HV: f64 = 9.80665e6;

const CALLISTER: &str =
    "Callister, Fundamentals of Materials Science and Engineering, 3rd ed. (2008), appendix B";
/// Of zirconia, and all Poisson's ratios.
const CALLISTER_QUOTED: &str = "Callister, Fundamentals of Materials Science and Engineering, 3rd ed. (2008), appendix B (quoted; original not consulted)";
const DOWLING: &str = "Dowling, Mechanical Behavior of Materials, 4th ed. (2013), Table 5.2";
const KAYE_LABY: &str = "Kaye and Laby, Tables of Physical and Chemical Constants, 16th ed. (1995), section 2.2.2 (quoted; original not consulted)";
const SAMSONOV: &str = "Samsonov, Handbook of the Physicochemical Properties of the Elements (1968) (as quoted in tables of the elements)";
const ASM_6061: &str = "ASM/MatWeb data sheet aluminium 6061-T6 (MA6061T6)";
const ASM_7075: &str = "ASM/MatWeb data sheet aluminium 7075-T6 (MA7075T6) (quoted; original not consulted)";
const ASM_304: &str = "ASM/MatWeb data sheet AISI 304 (MQ304A) (quoted; original not consulted)";
const ASM_316: &str = "ASM/MatWeb data sheet AISI 316, annealed bar (MQ316J)";
const ASM_TITANIUM: &str = "ASM/MatWeb data sheet Ti-6Al-4V, annealed bar (MTP644)";
const ANSTIS: &str = "Anstis, Chantikul, Lawn and Marshall, J. Am. Ceram. Soc. 64 (1981) 533, Table I (quoted; original not consulted)";
const WANG: &str = "Wang et al. (2015), coatings on cemented carbide by nanoindentation, in Materials Today Bio 15 (2022) 100270, Table 3";
const OLIVER_PHARR: &str =
    "assumed; Oliver and Pharr, J. Mater. Res. 7 (1992) 1564 (quoted; original not consulted)";
const EN_10083_2: &str = "EN 10083-2:2006";
const EN_10083_3: &str = "EN 10083-3:2006";
const EN_12166: &str = "EN 12166:1998";
const EN_1561: &str = "EN 1561:1997, annex A (quoted; original not consulted)";
const EUROCODE: &str = "EN 1993-1-1:2005, 3.2.6 (quoted; original not consulted)";
const MITCHELL: &str = "Mitchell, An Introduction to Materials Engineering and Science (2004), appendix 8";
const HEAT_TRANSFER: &str = "Mechanical Engineers' Handbook, vol. 4, Heat-Transfer Fundamentals, Table 1";
const BEARING: &str = "AZoM data sheet AISI 52100 alloy steel";
const TECHNICAL: &str = "Céramique Technique, comparative table of properties of technical ceramics";
const SCHOTT: &str = "SCHOTT data sheet N-BK7 517642.251";
const SILICA: &str = "Piter Optics data sheet fused silica";
const ASSUMED: &str = "0.25 ± 0.1 changes E* by about 5 %";
const POM: &str = "data sheet POM-C, rods of 40 to 60 mm (Scribd 479235228)";
const ENSINGER_PEEK: &str = "Ensinger data sheet TECAPEEK natural (quoted; original not consulted)";
const ENSINGER_PA66: &str = "Ensinger data sheet TECAMID 66 natural (quoted; original not consulted)";
const PLEXIGLAS: &str = "Röhm data sheet PLEXIGLAS GS (quoted; original not consulted)";
const BALL: &str = "ball indentation, ISO 2039-1";

/// Materials of a class: name, description, and each property with its value, reference and note.
macro_rules! materials {
    ($class:ident: $($name:literal: $description:literal;
        young = $young:expr, $young_reference:expr, $young_note:expr;
        poisson = $poisson:expr, $poisson_reference:expr, $poisson_note:expr;
        $($property:ident = $value:expr, $reference:expr, $note:expr;)*)*) => {
        &[$(LibraryMaterial {
            $($property: Some(Sourced { value: $value, reference: $reference, note: $note }),)*
            ..LibraryMaterial::new(
                Class::$class,
                [$name, $description],
                Sourced { value: $young, reference: $young_reference, note: $young_note },
                Sourced { value: $poisson, reference: $poisson_reference, note: $poisson_note },
            )
        }),*]
    };
}

pub(super) const METALS: &[LibraryMaterial] = materials! { Metal:
    "steel-100Cr6": "bearing steel 100Cr6 (AISI 52100, 1.3505), hardened to 62 HRC";
        young = 210e9, BEARING, "typical, 190 to 210 GPa";
        poisson = 0.30, BEARING, "typical, 0.27 to 0.30";
        hardness = 746.0 * HV, BEARING, "62 HRC, which is 746 HV (ASTM E140-12, Table 1); bearings 58 to 65 HRC";
        thermal_conductivity = 47.0, "MakeItFrom data sheet SAE-AISI 52100", "180 to 210 HB, softer than the entry";
    "steel-C45-normalised": "carbon steel C45 (AISI 1045, 1.0503), normalised";
        young = 210e9, EUROCODE, "structural steels";
        poisson = 0.30, EUROCODE, "structural steels";
        hardness = 195.0 * HV, EN_10083_2,
            "tensile strength 620 MPa at least (up to 16 mm), which is 195 HV (ISO 18265:2013, Table A.1)";
        thermal_conductivity = 51.0, "MakeItFrom data sheet SAE-AISI 1045", "";
        resistivity = 1.62e-07, "MatWeb data sheet AISI 1045, cold drawn (quoted; original not consulted)",
            "annealed specimen at 0 °C";
    "steel-42CrMo4-QT": "low-alloy steel 42CrMo4 (AISI 4140, 1.7225), quenched and tempered, up to 16 mm";
        young = 207e9, CALLISTER, "steel 4140";
        poisson = 0.30, CALLISTER_QUOTED, "plain carbon and low-alloy steels";
        hardness = 340.0 * HV, EN_10083_3,
            "tensile strength 1100 MPa (1100 to 1300), which is 340 HV (ISO 18265:2013, Table A.1)";
        yield_strength = 900e6, EN_10083_3, "at least";
        thermal_conductivity = 42.6, "Meusburger data sheet 1.7225 (42CrMo4)", "at 20 °C";
        resistivity = 2.2e-07, "MatWeb data sheet AISI 4140, oil quenched, 205 °C temper",
            "hardened and tempered specimen, 20 °C";
    "steel-304": "austenitic stainless steel AISI 304 (1.4301), annealed";
        young = 193e9, CALLISTER, "stainless steel 304";
        poisson = 0.30, CALLISTER_QUOTED, "stainless steel 304";
        hardness = 129.0 * HV, ASM_304, "converted from 123 HB";
        thermal_conductivity = 16.2, ASM_304, "0 to 100 °C";
        resistivity = 7.2e-07, ASM_304, "at 20 °C";
    "steel-316": "austenitic stainless steel AISI 316 (1.4401; 316L is similar), annealed";
        young = 193e9, ASM_316, "";
        poisson = 0.30, CALLISTER_QUOTED, "stainless steel 316";
        hardness = 155.0 * HV, ASM_316, "converted from 149 HB";
        thermal_conductivity = 14.6, "MakeItFrom data sheet AISI 316", "ambient; 15 W/(m K) for annealed 316L";
        resistivity = 7.4e-07, ASM_316, "at 20 °C";
    "cast-iron-GJL-250": "grey cast iron EN-GJL-250, pearlitic";
        young = 110e9, EN_1561, "103 to 118 GPa";
        poisson = 0.26, EN_1561, "";
        hardness = 205.0 * HV, "Modelleria Zuin data sheet GJL-250 (EN 1561)", "Brinell, 170 to 240 HB";
        thermal_conductivity = 46.0, "MakeItFrom data sheet ASTM grade 35 (EN-JL 1040)", "grey iron of grade 250";
    "aluminium-6061-T6": "aluminium alloy 6061, T6";
        young = 68.9e9, ASM_6061, "";
        poisson = 0.33, ASM_6061, "";
        hardness = 107.0 * HV, ASM_6061, "converted from 95 HB";
        yield_strength = 276e6, ASM_6061, "typical";
        thermal_conductivity = 167.0, ASM_6061, "typical, 25 °C";
        resistivity = 3.99e-08, ASM_6061, "typical, 20 °C";
    "aluminium-7075-T6": "aluminium alloy 7075, T6";
        young = 71.7e9, ASM_7075, "";
        poisson = 0.33, ASM_7075, "";
        hardness = 175.0 * HV, ASM_7075, "converted from 150 HB";
        yield_strength = 503e6, ASM_7075, "typical";
        thermal_conductivity = 130.0, ASM_7075, "";
        resistivity = 5.15e-08, ASM_7075, "at 20 °C";
    "titanium-Ti6Al4V": "titanium alloy Ti-6Al-4V (grade 5), annealed bar";
        young = 114e9, ASM_TITANIUM, "";
        poisson = 0.33, ASM_TITANIUM, "";
        hardness = 349.0 * HV, ASM_TITANIUM, "converted from 36 HRC";
        yield_strength = 860e6, ASM_TITANIUM, "in compression; 830 MPa in tension";
        thermal_conductivity = 6.6, "Lumina data sheet Ti-6Al-4V (ASTM grade 5)", "6.6 to 7.2 W/(m K) in data sheets";
        resistivity = 1.78e-06, ASM_TITANIUM, "";
    "bronze-CuSn8": "tin bronze CuSn8 (CW453K, C52100), hard";
        young = 110e9, "MakeItFrom data sheet UNS C52100, H04", "";
        poisson = 0.34, "MakeItFrom data sheet UNS C52100, H04", "";
        hardness = 200.0 * HV, "RCI Industries data sheet PB-IV (CuSn8)", "hard, at least";
        yield_strength = 500e6, "RCI Industries data sheet PB-IV (CuSn8)", "hard, at least";
        thermal_conductivity = 62.0, "MakeItFrom data sheet UNS C52100, H04", "";
        resistivity = 1.33e-07, "MakeItFrom data sheet UNS C52100, H04", "13 % IACS";
    "brass-CuZn37": "brass CuZn37 (CW508L), quarter hard wire";
        young = 101e9, DOWLING, "brass 70Cu-30Zn";
        poisson = 0.35, DOWLING, "brass 70Cu-30Zn";
        hardness = 130.0 * HV, EN_12166, "state H130, at least";
        yield_strength = 390e6, EN_12166, "state R470, for guidance";
        thermal_conductivity = 121.0, "KME data sheet CuZn37 (CW508L)", "annealed, 20 °C";
        resistivity = 7.1e-08, "KME data sheet CuZn37 (CW508L)", "at most (14 MS/m at least), annealed, 20 °C";
    "copper": "copper, pure, annealed";
        young = 130e9, DOWLING, "";
        poisson = 0.343, DOWLING, "";
        hardness = 369e6, SAMSONOV, "343 to 369 MPa; cold-worked up to three times as much";
        thermal_conductivity = 401.0, HEAT_TRANSFER, "300 K";
        resistivity = 1.71e-08, MITCHELL, "5.85e7 S/m";
    "nickel": "nickel, pure, annealed; electroplated nickel is several times as hard";
        young = 199.5e9, KAYE_LABY, "soft";
        poisson = 0.312, KAYE_LABY, "soft";
        hardness = 638e6, SAMSONOV, "";
        thermal_conductivity = 90.7, HEAT_TRANSFER, "300 K; commercial grades less";
        resistivity = 7e-08, "data sheet Super Pure Nickel Ni 99.98 (studylib 8758886)", "± 10 %; annealed, 20 °C";
    "silver": "silver, pure, annealed";
        young = 82.7e9, KAYE_LABY, "";
        poisson = 0.367, KAYE_LABY, "";
        hardness = 251e6, SAMSONOV, "";
        thermal_conductivity = 429.0, HEAT_TRANSFER, "300 K";
        resistivity = 1.59e-08, MITCHELL, "6.3e7 S/m";
    "gold": "gold, pure, annealed; electroplated hard gold is several times as hard";
        young = 78e9, KAYE_LABY, "";
        poisson = 0.44, KAYE_LABY, "";
        hardness = 216e6, SAMSONOV, "188 to 216 MPa";
        thermal_conductivity = 317.0, HEAT_TRANSFER, "300 K";
        resistivity = 2.35e-08, MITCHELL, "4.25e7 S/m; 2.44e-8 ohm m in other tables";
    "lead": "lead, pure";
        young = 16.1e9, DOWLING, "";
        poisson = 0.44, DOWLING, "";
        hardness = 38.3e6, SAMSONOV, "Brinell, 38 to 50 MPa";
        thermal_conductivity = 35.3, HEAT_TRANSFER, "300 K";
        resistivity = 2.06e-07, MITCHELL, "";
    "tungsten": "tungsten, pure";
        young = 411e9, DOWLING, "";
        poisson = 0.28, DOWLING, "";
        hardness = 3.43e9, SAMSONOV, "3.43 to 4.6 GPa";
        thermal_conductivity = 174.0, "Wolfram Industrie data sheet tungsten", "293 K";
        resistivity = 5.3e-08, MITCHELL, "5.3e-8 to 5.65e-8 ohm m in other tables";
};

/// Ceramics, glasses, semiconductors and hard coatings. They crack under sharp contacts, which no law here describes.
pub(super) const CERAMICS: &[LibraryMaterial] = materials! { Ceramic:
    "tungsten-carbide-Co": "cemented carbide WC-Co";
        young = 575e9, ANSTIS, "";
        poisson = 0.22, KAYE_LABY, "tungsten carbide";
        hardness = 13.2e9, ANSTIS, "";
        thermal_conductivity = 85.0, "MakeItFrom data sheet tungsten carbide",
            "cobalt content not stated; 110 W/(m K) for the pure compound in other tables";
    "silicon-nitride": "silicon nitride Si3N4, sintered";
        young = 308e9, TECHNICAL, "300 to 315 GPa";
        poisson = 0.28, CALLISTER_QUOTED, "sintered";
        hardness = 15.5e9, TECHNICAL, "15 to 16 GPa";
        thermal_conductivity = 31.0, "MakeItFrom data sheet hot-pressed silicon nitride",
            "pressure-sintered; 12 to 31 W/(m K) for all grades";
    "alumina": "alumina Al2O3, 94 to 99.8 %";
        young = 360e9, TECHNICAL, "350 to 370 GPa";
        poisson = 0.22, DOWLING, "";
        hardness = 15e9, TECHNICAL, "12 to 18 GPa";
        thermal_conductivity = 32.0, "Ashby, Materials and the Environment, data sheet alumina", "26 to 38.5 W/(m K)";
    "zirconia-3Y-TZP": "zirconia with 3 mol% yttria, tetragonal";
        young = 205e9, CALLISTER_QUOTED, "zirconia, 3 mol% Y2O3";
        poisson = 0.31, CALLISTER_QUOTED, "zirconia, 3 mol% Y2O3";
        hardness = 1300.0 * HV, "Kientec data sheet ceramic ferrules, ZrO2", "12 to 16 GPa in other data sheets";
        thermal_conductivity = 2.5, "Kientec data sheet ceramic ferrules, ZrO2", "";
    "silicon-carbide": "silicon carbide SiC, hot-pressed (NC203)";
        young = 436e9, ANSTIS, "";
        poisson = 0.17, CALLISTER_QUOTED, "hot-pressed";
        hardness = 24e9, ANSTIS, "";
        thermal_conductivity = 120.0, "MakeItFrom data sheet silicon carbide", "120 to 170 W/(m K) for all grades";
    "glass-soda-lime": "soda-lime glass";
        young = 69e9, DOWLING, "";
        poisson = 0.20, DOWLING, "";
        hardness = 5.5e9, ANSTIS, "";
        thermal_conductivity = 1.05, "MakeItFrom data sheet soda-lime glass", "1.0 to 1.1 W/(m K)";
    "glass-BK7": "borosilicate crown glass N-BK7";
        young = 82e9, SCHOTT, "";
        poisson = 0.206, SCHOTT, "";
        hardness = 610.0 * HV, SCHOTT, "Knoop, HK 0.1/20";
        thermal_conductivity = 1.09, "Glass Dynamics data sheet BK7 and fused silica", "0.0026 cal/(cm s K) at 20 °C";
    "silica-fused": "fused silica SiO2";
        young = 73e9, SILICA, "";
        poisson = 0.17, SILICA, "";
        hardness = 500.0 * HV, SILICA, "Knoop";
        thermal_conductivity = 1.38, "Glass Dynamics data sheet BK7 and fused silica", "0.0033 cal/(cm s K) at 20 °C";
    "silicon-100": "silicon, single crystal, isotropic values for the [100] direction";
        young = 130e9,
            "Hopcroft, Nix and Kenny, J. Microelectromech. Syst. 19 (2010) 229 (quoted; original not consulted)",
            "[100] direction";
        poisson = 0.28,
            "Hopcroft, Nix and Kenny, J. Microelectromech. Syst. 19 (2010) 229 (quoted; original not consulted)",
            "[100] direction";
        hardness = 10.6e9, ANSTIS, "on (111)";
        thermal_conductivity = 148.0, HEAT_TRANSFER, "300 K, pure";
    "diamond": "diamond";
        young = 960e9, DOWLING, "700 to 1200 GPa in other tables";
        poisson = 0.20, DOWLING, "";
        hardness = 98e9, "MatWeb, mechanical properties of elements", "on (111); 88 to 147 GPa on (001)";
        thermal_conductivity = 2000.0, "Diamond Materials, thermal properties of CVD diamond",
            "CVD, 1800 W/(m K) at least; 2200 W/(m K) for natural diamond elsewhere";
    "coating-DLC": "amorphous carbon (DLC), magnetron sputtered; films differ widely";
        young = 166e9, WANG, "films of other processes 100 to 250 GPa";
        poisson = 0.25, OLIVER_PHARR, ASSUMED;
        hardness = 16.7e9, WANG, "films of other processes 12 to 24 GPa";
        thermal_conductivity = 1.0, "Thermal conductivity of diamond-like carbon films (3ω method), abstract",
            "hydrogenated tetrahedral; 0.2 to 3.5 W/(m K) for all kinds of film";
    "coating-TiN": "titanium nitride TiN, magnetron sputtered";
        young = 397e9, WANG, "";
        poisson = 0.25, OLIVER_PHARR, ASSUMED;
        hardness = 23.6e9, WANG, "";
        thermal_conductivity = 35.0,
            "Thermal conductivity of hard oxynitride coatings, Thin Solid Films 549 (2013) 232, abstract",
            "arc-evaporated; 29 W/(m K) for the bulk in other tables";
    "coating-CrN": "chromium nitride CrN, magnetron sputtered";
        young = 422e9, WANG, "";
        poisson = 0.25, OLIVER_PHARR, ASSUMED;
        hardness = 17.9e9, WANG, "films of other processes 12 to 19 GPa";
        thermal_conductivity = 9.0,
            "Thermal conductivity of hard oxynitride coatings, Thin Solid Films 549 (2013) 232, abstract",
            "arc-evaporated";
};

/// Polymers. They creep: modulus and hardness are those of tests of a minute, dry, at 23 °C.
pub(super) const POLYMERS: &[LibraryMaterial] = materials! { Polymer:
    "PEEK": "polyetheretherketone, unfilled";
        young = 4.2e9, ENSINGER_PEEK, "in tension";
        poisson = 0.40, "Victrex, Materials Properties Guide (quoted; original not consulted)", "PEEK 450G";
        hardness = 253e6, ENSINGER_PEEK, BALL;
        yield_strength = 116e6, ENSINGER_PEEK, "";
        thermal_conductivity = 0.25, "matmake, thermal conductivity of polymers and plastics", "";
    "POM": "polyoxymethylene, copolymer";
        young = 2.855e9, POM, "";
        poisson = 0.35, "DuPont, Delrin Design Information, module III (quoted; original not consulted)", "homopolymer";
        hardness = 125e6, POM, "ball indentation, ISO 2039";
        yield_strength = 67e6, POM, "at yield";
        thermal_conductivity = 0.31, "Quadrant data sheet Acetron MD",
            "copolymer with a metal-detectable additive; 0.2 W/(m K) in Crawford, Plastics Engineering, Table 1.8";
    "PA66": "polyamide 66, dry; moist it is half as stiff";
        young = 2.7e9, DOWLING, "nylon 66, dry";
        poisson = 0.41, DOWLING, "nylon 66, dry";
        hardness = 175e6, ENSINGER_PA66, BALL;
        yield_strength = 84e6, ENSINGER_PA66, "at yield";
        thermal_conductivity = 0.24, "Crawford, Plastics Engineering, Table 1.8", "";
    "PMMA": "polymethyl methacrylate, cast";
        young = 2.7e9, DOWLING, "2.24 to 3.24 GPa in other tables";
        poisson = 0.35, DOWLING, "";
        hardness = 175e6, PLEXIGLAS, BALL;
        thermal_conductivity = 0.19, "MakeItFrom data sheet PMMA", "";
    "PTFE": "polytetrafluoroethylene, unfilled";
        young = 0.475e9, CALLISTER, "0.40 to 0.55 GPa";
        poisson = 0.46, CALLISTER_QUOTED, "";
        yield_strength = 14.5e6, CALLISTER, "13.8 to 15.2 MPa";
        thermal_conductivity = 0.25, "Crawford, Plastics Engineering, Table 1.8", "";
    "UHMWPE": "polyethylene of ultra-high molecular weight";
        young = 0.69e9, CALLISTER, "";
        poisson = 0.46, "Kurtz, UHMWPE Biomaterials Handbook, 2nd ed. (2009) (quoted; original not consulted)",
            "typical";
        thermal_conductivity = 0.45, "matmake, thermal conductivity of polymers and plastics", "0.45 to 0.52 W/(m K)";
};
