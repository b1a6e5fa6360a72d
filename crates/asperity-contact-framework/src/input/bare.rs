//! Numbers without a unit that are hardly meant in SI: ranges that refuse them and name the likely unit.

use asperity::numeric::{LARGEST, is_positive};
use asperity::units::Dimension;

use super::quantity::Range;
use crate::report::format::input_quantity;

/// What may be written without a unit.
pub struct Bare {
    /// What the number stands for, with its article: "a Young's modulus".
    pub of: &'static str,
    /// The values that may stand without a unit, SI.
    pub allowed: [f64; 2],
    /// The values that most users mean, SI.
    usual: [f64; 2],
    /// Units that are commonly left out.
    units: &'static [&'static str],
    dimension: Dimension,
}

impl Bare {
    /// Refuses a number without a unit that is hardly meant in SI, and which the spec writes as `found`.
    pub fn check(&self, value: f64, found: &str) -> Result<(), String> {
        let [least, most] = self.allowed;
        if (least..=most).contains(&value) {
            return Ok(());
        }
        let si = self.dimension.si_unit();
        let as_it_stands = input_quantity(value, si);
        let likely = self.likely(value);
        let write = match &likely[..] {
            [] => format!("write it with its unit, as in \"{}\"", self.dimension.example()),
            likely => format!("write {}", likely.join(" or ")),
        };
        Err(format!(
            "found {found}; {write}: a bare number is in {si}, and {as_it_stands} is hardly meant as {} (if it is, write \
             \"{as_it_stands}\")",
            self.of
        ))
    }

    /// The number with each unit in which it has a usual value, as a spec would write it.
    fn likely(&self, value: f64) -> Vec<String> {
        let [least, most] = self.usual;
        let in_unit = |unit: &&str| {
            let si = value * self.dimension.factor(unit)?;
            let si_unit = self.dimension.si_unit();
            let prefixed = unit.ends_with(si_unit) && si_unit.chars().all(char::is_alphabetic);
            let written = if prefixed { input_quantity(si, si_unit) } else { format!("{value} {unit}") };
            (least..=most).contains(&si).then(|| format!("\"{written}\""))
        };
        self.units.iter().filter_map(in_unit).collect()
    }
}

macro_rules! ranges {
    ($words:literal, $short:literal, $holds:expr; $($(#[$doc:meta])* $name:ident: $bounds:expr, $bare:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum $name {}

        impl Range for $name {
            const WORDS: &'static str = $words;
            const MAGNITUDES: Option<&'static str> = Some("1e-30 to 1e30");
            const IN_SHORT: &'static str = $short;
            const BOUNDS: &'static [(&'static str, f64)] = $bounds;
            const BARE: Option<Bare> = Some($bare);
            fn holds(value: f64) -> bool {
                $holds(value)
            }
        }
    )*};
}

ranges! { "a positive finite", "above 0", is_positive;
    /// A Young's modulus; without its unit from 1 GPa to 2 TPa.
    ModulusRange: &[("minimum", 1e9), ("maximum", 2e12)], Bare {
        of: "a Young's modulus",
        allowed: [1e9, 2e12],
        usual: [1e9, 1.5e12],
        units: &["GPa", "MPa"],
        dimension: Dimension::Pressure,
    };
    /// A hardness; without its unit from 10 MPa.
    HardnessRange: &[("minimum", 1e7), ("maximum", LARGEST)], Bare {
        of: "a hardness",
        allowed: [1e7, f64::INFINITY],
        usual: [1e8, 4e10],
        units: &["GPa", "MPa", "HV"],
        dimension: Dimension::Pressure,
    };
    /// A yield strength; without its unit from 1 MPa.
    YieldRange: &[("minimum", 1e6), ("maximum", LARGEST)], Bare {
        of: "a yield strength",
        allowed: [1e6, f64::INFINITY],
        usual: [1e6, 1e10],
        units: &["MPa", "GPa"],
        dimension: Dimension::Pressure,
    };
    /// The distance of the points of a map, or another length on it; without its unit up to 1 mm.
    PixelRange: &[("exclusiveMinimum", 0.0), ("maximum", 1e-3)], up_to_a_millimetre("a length on a height map");
    /// A standard deviation of heights; without its unit up to 1 mm.
    SigmaRange: &[("exclusiveMinimum", 0.0), ("maximum", 1e-3)], up_to_a_millimetre("a standard deviation of heights");
    /// A nominal area; without its unit up to 0.01 m².
    NominalAreaRange: &[("exclusiveMinimum", 0.0), ("maximum", 1e-2)], Bare {
        of: "a nominal area",
        allowed: [0.0, 1e-2],
        usual: [1e-10, 1e-2],
        units: &["mm^2", "cm^2", "um^2"],
        dimension: Dimension::Area,
    };
    /// A nominal pressure; without its unit from 1 kPa.
    NominalPressureRange: &[("minimum", 1e3), ("maximum", LARGEST)], Bare {
        of: "a nominal pressure",
        allowed: [1e3, f64::INFINITY],
        usual: [1e3, 1e10],
        units: &["MPa", "kPa", "GPa"],
        dimension: Dimension::Pressure,
    };
    /// The thickness of a layer; without its unit up to 1 mm.
    ThicknessRange: &[("exclusiveMinimum", 0.0), ("maximum", 1e-3)], THICKNESS;
    /// An electrical resistivity; without its unit from 1 nohm m to 1 mohm m.
    ResistivityRange: &[("minimum", 1e-9), ("maximum", 1e-3)], Bare {
        of: "a resistivity",
        allowed: [1e-9, 1e-3],
        usual: [1e-8, 1e-4],
        units: &["nohm m", "uohm cm", "uohm m"],
        dimension: Dimension::Resistivity,
    };
    /// The thermal conductivity of a body; without its unit from 0.01 to 3000 W/(m K).
    ThermalConductivityRange: &[("minimum", 1e-2), ("maximum", 3e3)], Bare {
        of: "a thermal conductivity",
        allowed: [1e-2, 3e3],
        usual: [1e-2, 3e3],
        units: &["mW/(m K)"],
        dimension: Dimension::ThermalConductivity,
    };
    /// The thermal conductivity of a gas, a liquid or a paste; without its unit up to 10 W/(m K).
    GapConductivityRange: &[("exclusiveMinimum", 0.0), ("maximum", 10.0)], Bare {
        of: "the thermal conductivity of a medium in the gap",
        allowed: [0.0, 10.0],
        usual: [5e-3, 10.0],
        units: &["mW/(m K)"],
        dimension: Dimension::ThermalConductivity,
    };
    /// The resistance of a film times area; without its unit up to 1e-6 ohm m^2.
    ElectricalFilmRange: &[("exclusiveMinimum", 0.0), ("maximum", 1e-6)], Bare {
        of: "the resistance of a film on a spot",
        allowed: [0.0, 1e-6],
        usual: [1e-15, 1e-7],
        units: &["uohm cm^2", "mohm cm^2", "ohm um^2"],
        dimension: Dimension::ElectricalFilm,
    };
    /// The thermal resistance of a film times area; without its unit up to 1e-3 m^2 K/W.
    ThermalFilmRange: &[("exclusiveMinimum", 0.0), ("maximum", 1e-3)], Bare {
        of: "the thermal resistance of a film on a spot",
        allowed: [0.0, 1e-3],
        usual: [1e-9, 1e-4],
        units: &["mm^2 K/W", "cm^2 K/W"],
        dimension: Dimension::ThermalFilm,
    };
}

ranges! { "zero or a positive finite", "0 or above", |value| value == 0.0 || is_positive(value);
    /// The thickness of a layer, or none; without its unit up to 1 mm.
    ThicknessOrNone: &[("minimum", 0.0), ("maximum", 1e-3)], THICKNESS;
    /// The thickness that a gas resists more for the jumps of temperature at its borders; without its unit up to 1 mm.
    GapJumpRange: &[("minimum", 0.0), ("maximum", 1e-3)], up_to_a_millimetre("the thickness that a gas resists more at its borders");
}

const THICKNESS: Bare = Bare { usual: [1e-9, 1e-3], ..up_to_a_millimetre("the thickness of a layer") };

/// A length that is seldom above 0.1 mm.
const fn up_to_a_millimetre(of: &'static str) -> Bare {
    Bare { of, allowed: [0.0, 1e-3], usual: [1e-9, 1e-4], units: &["um", "nm"], dimension: Dimension::Length }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::quantity::{
        self, Area, Length, Pressure, Quantity, Resistivity, ThermalConductivity, ThermalFilm,
    };

    fn young(value: f64, found: &str) -> Result<f64, String> {
        Quantity::<Pressure, ModulusRange>::bare(value, found).map(|young| young.value())
    }

    fn told<D: quantity::Dimension, R: Range>(value: f64) -> String {
        Quantity::<D, R>::bare(value, &value.to_string()).err().unwrap()
    }

    /// Others stand among the bad specs.
    #[test]
    fn a_bare_number_that_is_hardly_meant_is_told_its_likely_unit() {
        for (told, write) in [
            (told::<Pressure, ModulusRange>(1500.0), "write \"1.5 TPa\" or \"1.5 GPa\""),
            (told::<Pressure, HardnessRange>(7.6), "write \"7.6 GPa\": "),
            (told::<Pressure, YieldRange>(250.0), "write \"250 MPa\": "),
            (told::<Pressure, NominalPressureRange>(1.25), "\"1.25 MPa\" or \"1.25 kPa\" or \"1.25 GPa\": "),
            (told::<Area, NominalAreaRange>(2e4), "write \"20000 um^2\": "),
            (told::<ThermalConductivity, ThermalConductivityRange>(1e4), "write \"10000 mW/(m K)\": "),
            (told::<ThermalFilm, ThermalFilmRange>(0.01), "write \"0.01 mm^2 K/W\" or \"0.01 cm^2 K/W\": "),
            (told::<Length, GapJumpRange>(0.4), "write \"400 nm\": "),
        ] {
            assert!(told.contains(write), "{told}");
        }
    }

    #[test]
    fn si_numbers_and_numbers_with_units_are_read() {
        assert_eq!(young(210e9, "210e9"), Ok(210e9));
        assert_eq!(young(2e12, "2e12"), Ok(2e12));
        let parsed = |text| Quantity::<Pressure, ModulusRange>::parse(text).map(|young| young.value());
        assert_eq!((parsed("2 MPa"), parsed("1e9 GPa")), (Ok(2e6), Ok(1e18)));
        assert!(Quantity::<Pressure, NominalPressureRange>::parse("2 Pa").is_ok());
        assert!(Quantity::<Pressure, NominalPressureRange>::bare(1000.0, "1000").is_ok());
        assert!(Quantity::<Pressure, YieldRange>::bare(5e6, "5e6").is_ok(), "lead");
        assert!(Quantity::<Area, NominalAreaRange>::parse("4 m^2").is_ok());
        assert!(Quantity::<Length, ThicknessOrNone>::bare(0.0, "0").is_ok());
        assert_eq!(
            Quantity::<Resistivity, ResistivityRange>::bare(1.7e-8, "").map(|rho| rho.value()),
            Ok(1.7e-8)
        );
        assert!(Quantity::<Resistivity, ResistivityRange>::parse("28.2 ohm m").is_ok());
        assert!(
            Quantity::<Length, ThicknessRange>::bare(-1.0, "-1").unwrap_err().contains("a positive finite")
        );
    }
}
