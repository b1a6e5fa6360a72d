//! The papers behind the equations. A report lists those that its run used.

/// One source, as a report cites it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Paper {
    /// Authors and year, as the text refers to it.
    pub short: &'static str,
    /// The whole reference.
    pub full: &'static str,
}

/// The deterministic model, and both models' notation.
pub const PASARIBU_SCHIPPER_2005: Paper = Paper {
    short: "Pasaribu and Schipper 2005",
    full: "Pasaribu, H. R., Schipper, D. J. (2005). Application of a deterministic contact model to analyze the contact of a rough surface against a flat layered surface. ASME Journal of Tribology 127(2), 451-455. doi:10.1115/1.1866163",
};

/// The statistical model and the elastic-plastic law.
pub const ZHAO_MAIETTA_CHANG_2000: Paper = Paper {
    short: "Zhao, Maietta and Chang 2000",
    full: "Zhao, Y., Maietta, D. M., Chang, L. (2000). An asperity microcontact model incorporating the transition from elastic deformation to fully plastic flow. ASME Journal of Tribology 122(1), 86-93. doi:10.1115/1.555332",
};

/// The elastic limit and the plasticity index.
pub const GREENWOOD_WILLIAMSON_1966: Paper = Paper {
    short: "Greenwood and Williamson 1966",
    full: "Greenwood, J. A., Williamson, J. B. P. (1966). Contact of nominally flat surfaces. Proceedings of the Royal Society A 295, 300-319. doi:10.1098/rspa.1966.0242",
};

/// Five-point summits.
pub const GREENWOOD_1984: Paper = Paper {
    short: "Greenwood 1984",
    full: "Greenwood, J. A. (1984). A unified theory of surface roughness. Proceedings of the Royal Society A 393, 133-157. doi:10.1098/rspa.1984.0050",
};

/// Surface heights and summit heights.
pub const NAYAK_1971: Paper = Paper {
    short: "Nayak 1971",
    full: "Nayak, P. R. (1971). Random process model of rough surfaces. ASME Journal of Lubrication Technology 93(3), 398-407. doi:10.1115/1.3451608",
};

/// The areal Gaussian filter.
pub const ISO_16610_61: Paper = Paper {
    short: "ISO 16610-61:2015",
    full: "ISO 16610-61:2015. Geometrical product specification (GPS) - Filtration - Part 61: Linear areal filters: Gaussian filters.",
};
