//! The table of units.

use std::f64::consts::PI;

/// The units of a dimension.
pub(super) struct Units {
    pub example: &'static str,
    pub si_unit: &'static str,
    pub documented: &'static [&'static str],
    /// The power of a prefix before the SI unit; 0 where it takes none.
    pub power: i32,
    /// The power of ten of the largest prefix in use.
    pub largest: i32,
    /// Spellings of other units, with their SI values.
    pub others: &'static [(&'static str, f64)],
}

/// SI prefixes and their powers of ten.
pub(super) const PREFIXES: [(&str, i32); 12] = [
    ("", 0),
    ("T", 12),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("n", -9),
    ("p", -12),
];

pub(super) const PRESSURE: Units = Units {
    example: "210 GPa",
    si_unit: "Pa",
    documented: &["Pa", "kPa", "MPa", "GPa", "N/mm^2", "HV", "kgf/mm^2", "bar", "psi", "ksi"],
    power: 1,
    largest: 12,
    others: &[
        ("HV", 9.80665e6),
        ("N/mm^2", 1e6),
        ("kgf/cm^2", 9.80665e4),
        ("kgf/mm^2", 9.80665e6),
        ("atm", 1.01325e5),
        ("bar", 1e5),
        ("mbar", 100.0),
        ("ksi", 6.894757889515779e6),
        ("lbf/in^2", 6894.757889515779),
        ("psi", 6894.757),
    ],
};

pub(super) const LENGTH: Units = Units {
    example: "1.2 um",
    si_unit: "m",
    documented: &["m", "cm", "mm", "um", "nm", "pm", "Å", "in", "mil"],
    power: 1,
    largest: 3,
    others: &[
        ("meter", 1.0),
        ("meters", 1.0),
        ("centimeter", 1e-2),
        ("centimeters", 1e-2),
        ("millimeter", 1e-3),
        ("millimeters", 1e-3),
        ("micrometer", 1e-6),
        ("micrometers", 1e-6),
        ("nanometer", 1e-9),
        ("nanometers", 1e-9),
        ("Å", 1e-10),
        ("ångström", 1e-10),
        ("ångströms", 1e-10),
        ("angstrom", 1e-10),
        ("angstroms", 1e-10),
        ("in", 0.0254),
        ("inch", 0.0254),
        ("inches", 0.0254),
        ("ft", 0.3048),
        ("uin", 2.54e-8),
        ("micron", 1e-6),
        ("microns", 1e-6),
        ("mil", 2.54e-5),
        ("mils", 2.54e-5),
    ],
};

pub(super) const AREA: Units = Units {
    example: "1 mm^2",
    si_unit: "m^2",
    documented: &["m^2", "cm^2", "mm^2", "um^2"],
    power: 2,
    largest: 12,
    others: &[("ft^2", 0.09290304), ("in^2", 6.4516e-4)],
};

/// Per any unit of area.
pub(super) const DENSITY: Units = Units {
    example: "6e10 /m^2",
    si_unit: "1/m^2",
    documented: &["/m^2", "/mm^2", "/um^2"],
    power: 0,
    largest: 0,
    others: &[],
};

pub(super) const ANGLE: Units = Units {
    example: "30 deg",
    si_unit: "rad",
    documented: &["deg", "rad"],
    power: 0,
    largest: 0,
    others: &[
        ("rad", 1.0),
        ("deg", PI / 180.0),
        ("degree", PI / 180.0),
        ("degrees", PI / 180.0),
        ("°", PI / 180.0),
    ],
};

pub(super) const FORCE: Units = Units {
    example: "10 N",
    si_unit: "N",
    documented: &["N", "mN", "uN", "kN", "kgf", "lbf"],
    power: 1,
    largest: 12,
    others: &[("kgf", 9.80665), ("gf", 0.00980665), ("lbf", 4.448222)],
};

pub(super) const RESISTIVITY: Units = Units {
    example: "17 nohm m",
    si_unit: "ohm m",
    documented: &["ohm m", "uohm cm", "nohm m", "ohm mm^2/m"],
    power: 1,
    largest: 12,
    others: &[
        ("ohm cm", 1e-2),
        ("mohm cm", 1e-5),
        ("uohm cm", 1e-8),
        ("uohm mm", 1e-9),
        ("ohm mm^2/m", 1e-6),
        ("ohm-m", 1.0),
        ("ohm-cm", 1e-2),
    ],
};

pub(super) const CONDUCTIVITY: Units = Units {
    example: "50 W/(m K)",
    si_unit: "W/(m K)",
    documented: &["W/(m K)", "mW/(m K)"],
    power: 1,
    largest: 12,
    others: &[
        ("W/mK", 1.0),
        ("W/m K", 1.0),
        ("W/m-K", 1.0),
        ("W/(mK)", 1.0),
        ("W/m/K", 1.0),
        ("W m^-1 K^-1", 1.0),
        ("W m-1 K-1", 1.0),
        ("W/(cm K)", 100.0),
    ],
};

pub(super) const ELECTRICAL_FILM: Units = Units {
    example: "1e-12 ohm m^2",
    si_unit: "ohm m^2",
    documented: &["ohm m^2", "ohm cm^2", "mohm cm^2", "ohm mm^2"],
    power: 1,
    largest: 12,
    others: &[
        ("ohm cm^2", 1e-4),
        ("mohm cm^2", 1e-7),
        ("uohm cm^2", 1e-10),
        ("ohm mm^2", 1e-6),
        ("ohm um^2", 1e-12),
    ],
};

pub(super) const THERMAL_FILM: Units = Units {
    example: "2 mm^2 K/W",
    si_unit: "m^2 K/W",
    documented: &["m^2 K/W", "cm^2 K/W", "mm^2 K/W"],
    power: 0,
    largest: 0,
    others: &[("m^2 K/W", 1.0), ("cm^2 K/W", 1e-4), ("mm^2 K/W", 1e-6)],
};
