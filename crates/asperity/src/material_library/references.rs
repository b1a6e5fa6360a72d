//! The references of the library. Those that say so were not at hand when the library was written: their values are quoted, and
//! are to be checked against the original.

pub(super) const CALLISTER: &str =
    "Callister, Fundamentals of Materials Science and Engineering, 3rd ed. (2008), appendix B";
/// Of zirconia, and all Poisson's ratios.
pub(super) const CALLISTER_QUOTED: &str = "Callister, Fundamentals of Materials Science and Engineering, 3rd ed. (2008), appendix B (quoted; original not consulted)";
pub(super) const DOWLING: &str = "Dowling, Mechanical Behavior of Materials, 4th ed. (2013), Table 5.2";
pub(super) const KAYE_LABY: &str = "Kaye and Laby, Tables of Physical and Chemical Constants, 16th ed. (1995), section 2.2.2 (quoted; original not consulted)";
pub(super) const SAMSONOV: &str = "Samsonov, Handbook of the Physicochemical Properties of the Elements (1968) (as quoted in tables of the elements)";
pub(super) const ASM_6061: &str = "ASM/MatWeb data sheet aluminium 6061-T6 (MA6061T6)";
pub(super) const ASM_7075: &str =
    "ASM/MatWeb data sheet aluminium 7075-T6 (MA7075T6) (quoted; original not consulted)";
pub(super) const ASM_304: &str = "ASM/MatWeb data sheet AISI 304 (MQ304A) (quoted; original not consulted)";
pub(super) const ASM_316: &str = "ASM/MatWeb data sheet AISI 316, annealed bar (MQ316J)";
pub(super) const ASM_TITANIUM: &str = "ASM/MatWeb data sheet Ti-6Al-4V, annealed bar (MTP644)";
pub(super) const ANSTIS: &str = "Anstis, Chantikul, Lawn and Marshall, J. Am. Ceram. Soc. 64 (1981) 533, Table I (quoted; original not consulted)";
pub(super) const WANG: &str = "Wang et al. (2015), coatings on cemented carbide by nanoindentation, in Materials Today Bio 15 (2022) 100270, Table 3";
pub(super) const OLIVER_PHARR: &str =
    "assumed; Oliver and Pharr, J. Mater. Res. 7 (1992) 1564 (quoted; original not consulted)";
pub(super) const EN_10083_2: &str = "EN 10083-2:2006";
pub(super) const EN_10083_3: &str = "EN 10083-3:2006";
pub(super) const EN_12166: &str = "EN 12166:1998";
pub(super) const EN_1561: &str = "EN 1561:1997, annex A (quoted; original not consulted)";
pub(super) const EUROCODE: &str = "EN 1993-1-1:2005, 3.2.6 (quoted; original not consulted)";
pub(super) const MITCHELL: &str =
    "Mitchell, An Introduction to Materials Engineering and Science (2004), appendix 8";
pub(super) const HEAT_TRANSFER: &str =
    "Mechanical Engineers' Handbook, vol. 4, Heat-Transfer Fundamentals, Table 1";
