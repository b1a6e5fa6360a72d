//! The table of units.

use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

/// Symbol, word, plural and SI value. A unit without a symbol, or with one that parses as a number, repeats its word.
pub(super) type Unit = (&'static str, &'static str, &'static str, f64);

/// The units of a dimension.
pub(super) struct Units {
    pub name: &'static str,
    pub example: &'static str,
    pub si_unit: &'static str,
    pub documented: &'static [&'static str],
    /// The SI unit, if it takes prefixes.
    pub prefixed: Option<Prefixed>,
    pub others: &'static [&'static [Unit]],
}

/// A unit that takes SI prefixes.
pub(super) struct Prefixed {
    pub symbol: &'static str,
    pub word: &'static str,
    /// Words before the prefix, such as "square ".
    pub before: &'static str,
    /// The power of the prefix.
    pub power: i32,
    /// The powers of ten of the prefixes that are in use.
    pub prefixes: RangeInclusive<i32>,
}

/// Every prefix.
const ALL: RangeInclusive<i32> = -24..=24;

/// Symbol, word and power of ten.
pub(super) const PREFIXES: [(&str, &str, i32); 21] = [
    ("", "", 0),
    ("Y", "yotta", 24),
    ("Z", "zetta", 21),
    ("E", "exa", 18),
    ("P", "peta", 15),
    ("T", "tera", 12),
    ("G", "giga", 9),
    ("M", "mega", 6),
    ("k", "kilo", 3),
    ("h", "hecto", 2),
    ("da", "deca", 1),
    ("d", "deci", -1),
    ("c", "centi", -2),
    ("m", "milli", -3),
    ("u", "micro", -6),
    ("n", "nano", -9),
    ("p", "pico", -12),
    ("f", "femto", -15),
    ("a", "atto", -18),
    ("z", "zepto", -21),
    ("y", "yocto", -24),
];

pub(super) const PRESSURE: Units = Units {
    name: "pressure",
    example: "210 GPa",
    si_unit: "Pa",
    documented: &["Pa", "kPa", "MPa", "GPa", "N/mm^2", "HV", "kgf/mm^2", "bar", "psi", "ksi"],
    prefixed: Some(Prefixed { symbol: "Pa", word: "pascal", before: "", power: 1, prefixes: ALL }),
    others: &[PRESSURES],
};

pub(super) const LENGTH: Units = Units {
    name: "length",
    example: "1.2 um",
    si_unit: "m",
    documented: &["m", "cm", "mm", "um", "nm", "pm", "Å", "in", "mil"],
    prefixed: Some(Prefixed { symbol: "m", word: "meter", before: "", power: 1, prefixes: -12..=3 }),
    others: &[LENGTHS],
};

pub(super) const AREA: Units = Units {
    name: "area",
    example: "1 mm^2",
    si_unit: "m^2",
    documented: &["m^2", "cm^2", "mm^2", "um^2"],
    prefixed: Some(Prefixed { symbol: "m^2", word: "meter", before: "square ", power: 2, prefixes: ALL }),
    others: &[AREAS],
};

/// Per any unit of area.
pub(super) const DENSITY: Units = Units {
    name: "density",
    example: "6e10 /m^2",
    si_unit: "1/m^2",
    documented: &["/m^2", "/mm^2", "/um^2"],
    prefixed: None,
    others: &[],
};

pub(super) const ANGLE: Units = Units {
    name: "angle",
    example: "30 deg",
    si_unit: "rad",
    documented: &["deg", "rad"],
    prefixed: None,
    others: &[ANGLES],
};

pub(super) const FORCE: Units = Units {
    name: "force",
    example: "10 N",
    si_unit: "N",
    documented: &["N", "mN", "uN", "kN", "kgf", "lbf"],
    prefixed: Some(Prefixed { symbol: "N", word: "newton", before: "", power: 1, prefixes: ALL }),
    others: &[FORCES],
};

pub(super) const RESISTIVITY: Units = Units {
    name: "resistivity",
    example: "17 nohm m",
    si_unit: "ohm m",
    documented: &["ohm m", "uohm cm", "nohm m", "ohm mm^2/m"],
    prefixed: Some(Prefixed { symbol: "ohm m", word: "ohm meter", before: "", power: 1, prefixes: ALL }),
    others: &[RESISTIVITIES],
};

pub(super) const CONDUCTIVITY: Units = Units {
    name: "thermal conductivity",
    example: "50 W/(m K)",
    si_unit: "W/(m K)",
    documented: &["W/(m K)", "mW/(m K)"],
    prefixed: Some(Prefixed { symbol: "W/(m K)", word: "W/m/K", before: "", power: 1, prefixes: ALL }),
    others: &[CONDUCTIVITIES],
};

pub(super) const ELECTRICAL_FILM: Units = Units {
    name: "electrical resistance times area",
    example: "1e-12 ohm m^2",
    si_unit: "ohm m^2",
    documented: &["ohm m^2", "ohm cm^2", "mohm cm^2", "ohm mm^2"],
    prefixed: Some(Prefixed {
        symbol: "ohm m^2",
        word: "ohm square meter",
        before: "",
        power: 1,
        prefixes: ALL,
    }),
    others: &[ELECTRICAL_FILMS],
};

pub(super) const THERMAL_FILM: Units = Units {
    name: "thermal resistance times area",
    example: "2 mm^2 K/W",
    si_unit: "m^2 K/W",
    documented: &["m^2 K/W", "cm^2 K/W", "mm^2 K/W"],
    prefixed: None,
    others: &[THERMAL_FILMS],
};

/// Units of pressure without SI prefixes.
const PRESSURES: &[Unit] = &[
    ("HV", "HV", "HV", 9.80665e6),
    ("N/mm^2", "newton per square millimeter", "newtons per square millimeter", 1e6),
    ("kgf/m^2", "kilogram-force per square meter", "kilograms-force per square meter", 9.80665),
    ("kgf/cm^2", "kilogram-force per square centimeter", "kilograms-force per square centimeter", 9.80665e4),
    ("kgf/mm^2", "kilogram-force per square millimeter", "kilograms-force per square millimeter", 9.80665e6),
    ("gf/cm^2", "gram-force per square centimeter", "grams-force per square centimeter", 98.0665),
    ("dyn/cm^2", "dyne per square centimeter", "dynes per square centimeter", 0.1),
    ("atm", "atmosphere", "atmospheres", 1.01325e5),
    ("at", "atmosphere (technical)", "atmospheres (technical)", 98066.5),
    ("bar", "bar", "bar", 1e5),
    ("cm Hg (0 °C)", "centimeter of mercury (0 °C)", "centimeters of mercury (0 °C)", 1333.22),
    ("cm Hg", "centimeter of mercury", "centimeters of mercury", 1333.224),
    ("cm H₂O (4 °C)", "centimeter of water (4 °C)", "centimeters of water (4 °C)", 98.0638),
    ("cm H₂O", "centimeter of water", "centimeters of water", 98.0665),
    ("ft Hg", "foot of mercury", "feet of mercury", 40636.66),
    ("ft H₂O (39.2 °F)", "foot of water (39.2 °F)", "feet of water (39.2 °F)", 2988.98),
    ("ft H₂O", "foot of water", "feet of water", 2989.067),
    ("in Hg (32 °F)", "inch of mercury (32 °F)", "inches of mercury (32 °F)", 3386.38),
    ("in Hg (60 °F)", "inch of mercury (60 °F)", "inches of mercury (60 °F)", 3376.85),
    ("in Hg", "inch of mercury", "inches of mercury", 3386.389),
    ("in H₂O (39.2 °F)", "inch of water (39.2 °F)", "inches of water (39.2 °F)", 249.082),
    ("in H₂O (60 °F)", "inch of water (60 °F)", "inches of water (60 °F)", 248.84),
    ("in H₂O", "inch of water", "inches of water", 249.0889),
    ("ksi", "kip per square inch", "kips per square inch", 6.894757889515779e6),
    ("kip/in^2", "kip per square inch", "kips per square inch", 6.894757889515779e6),
    ("mbar", "millibar", "millibar", 100.0),
    ("mm Hg", "millimeter of mercury", "millimeters of mercury", 133.3224),
    ("mm H₂O", "millimeter of water", "millimeters of water", 9.80665),
    ("mTorr", "millitorr", "millitorr", 0.1333224),
    ("pdl/ft^2", "poundal per square foot", "poundals per square foot", 1.4881644346622025),
    ("lbf/ft^2", "pound-force per square foot", "pounds-force per square foot", 47.880263121637356),
    ("lbf/in^2", "pound-force per square inch", "pounds-force per square inch", 6894.757889515779),
    ("psi", "pound-force per square inch", "pounds-force per square inch", 6894.757),
    ("Torr", "torr", "torr", 133.3224),
];

/// Units of length of workshops and microscopes.
const LENGTHS: &[Unit] = &[
    ("Å", "ångström", "ångströms", 1e-10),
    ("Å", "angstrom", "angstroms", 1e-10),
    ("in", "inch", "inches", 0.0254),
    ("ft", "foot", "feet", 0.3048),
    ("uin", "microinch", "microinches", 2.54e-8),
    ("micron", "micron", "microns", 1e-6),
    ("mil", "mil", "mils", 2.54e-5),
];

/// Units without SI prefixes.
const AREAS: &[Unit] = &[
    ("ac", "acre", "acres", 4046.873),
    ("a", "are", "ares", 100.0),
    ("b", "barn", "barns", 1e-28),
    ("cmil", "circular mil", "circular mils", 5.067075e-10),
    ("ha", "hectare", "hectares", 10000.0),
    ("ft^2", "square foot", "square feet", 0.09290304),
    ("in^2", "square inch", "square inches", 6.4516e-4),
    ("mi^2", "square mile", "square miles", 2.589988110336e6),
    ("yd^2", "square yard", "square yards", 0.83612736),
];

/// All angles.
const ANGLES: &[Unit] = &[
    ("rad", "radian", "radians", 1.0),
    ("r", "revolution", "revolutions", TAU),
    ("deg", "degree", "degrees", PI / 180.0),
    ("gon", "gon", "gons", PI / 200.0),
    ("mil", "mil", "mils", 9.817477e-4),
    ("′", "minute", "minutes", 2.908882086657216e-4),
    ("″", "second", "seconds", 4.84813681109536e-6),
    ("°", "°", "°", PI / 180.0),
];

/// Units without SI prefixes.
const FORCES: &[Unit] = &[
    ("dyn", "dyne", "dynes", 1e-5),
    ("kgf", "kilogram-force", "kilograms-force", 9.80665),
    ("gf", "gram-force", "grams-force", 0.00980665),
    ("kip", "kip", "kips", 4448.222),
    ("ozf", "ounce-force", "ounces-force", 0.2780139),
    ("pdl", "poundal", "poundals", 0.138255),
    ("lbf", "pound-force", "pounds-force", 4.448222),
    ("ton-force", "ton-force", "tons-force", 8896.443),
];

/// Without the SI unit, or of other spellings.
const RESISTIVITIES: &[Unit] = &[
    ("ohm cm", "ohm centimeter", "ohm centimeters", 1e-2),
    ("mohm cm", "milliohm centimeter", "milliohm centimeters", 1e-5),
    ("uohm cm", "microohm centimeter", "microohm centimeters", 1e-8),
    ("uohm mm", "microohm millimeter", "microohm millimeters", 1e-9),
    ("ohm mm^2/m", "ohm square millimeter per meter", "ohm square millimeters per meter", 1e-6),
    ("ohm-m", "ohmmeter", "ohmmeters", 1.0),
    ("ohm-cm", "ohmcentimeter", "ohmcentimeters", 1e-2),
];

/// Other spellings of the SI unit.
const CONDUCTIVITIES: &[Unit] = &[
    ("W/mK", "watt per meter kelvin", "watts per meter kelvin", 1.0),
    ("W/m K", "W/m-K", "W/(mK)", 1.0),
    ("W m^-1 K^-1", "W m-1 K-1", "W/m/K", 1.0),
    ("W/cm/K", "W/(cm K)", "W/cmK", 100.0),
];

/// Areas times ohm.
const ELECTRICAL_FILMS: &[Unit] = &[
    ("ohm cm^2", "ohm square centimeter", "ohm square centimeters", 1e-4),
    ("mohm cm^2", "milliohm square centimeter", "milliohm square centimeters", 1e-7),
    ("uohm cm^2", "microohm square centimeter", "microohm square centimeters", 1e-10),
    ("ohm mm^2", "ohm square millimeter", "ohm square millimeters", 1e-6),
    ("ohm um^2", "ohm square micrometer", "ohm square micrometers", 1e-12),
];

/// Areas times kelvin per watt.
const THERMAL_FILMS: &[Unit] = &[
    ("m^2 K/W", "m^2K/W", "K m^2/W", 1.0),
    ("cm^2 K/W", "cm^2K/W", "K cm^2/W", 1e-4),
    ("mm^2 K/W", "mm^2K/W", "K mm^2/W", 1e-6),
];
