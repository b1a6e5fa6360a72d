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
    ///
    /// # Errors
    /// A value outside [`Self::allowed`]; the message names the likely values with their units.
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
        Area, ElectricalFilm, Length, Pressure, Quantity, Resistivity, ThermalConductivity, ThermalFilm,
    };

    fn young(value: f64, found: &str) -> Result<f64, String> {
        Quantity::<Pressure, ModulusRange>::bare(value, found).map(|young| young.value())
    }

    #[test]
    fn a_bare_number_that_is_hardly_meant_is_told_its_likely_unit() {
        let message = young(210000.0, "210000").unwrap_err();
        assert!(
            message.starts_with("found 210000; write \"210 GPa\": a bare number is in Pa, and 210 kPa is")
        );
        assert!(young(210.0, "210").unwrap_err().contains("write \"210 GPa\": "));
        assert!(young(1500.0, "1500").unwrap_err().contains("write \"1.5 TPa\" or \"1.5 GPa\""));
        assert!(young(2.1e14, "2.1e14").unwrap_err().contains("write it with its unit"));
        let hardness = |value, found| Quantity::<Pressure, HardnessRange>::bare(value, found).unwrap_err();
        assert!(hardness(7.6, "7.6").contains("write \"7.6 GPa\": "));
        assert!(hardness(775.0, "775").contains("write \"775 MPa\" or \"775 HV\""));
        let strength = Quantity::<Pressure, YieldRange>::bare(250.0, "250").unwrap_err();
        assert!(strength.contains("write \"250 MPa\": "), "{strength}");
        assert!(Quantity::<Pressure, YieldRange>::bare(5e6, "5e6").is_ok(), "lead");
        let thickness = Quantity::<Length, ThicknessOrNone>::bare(2.0, "2").unwrap_err();
        assert!(thickness.contains("write \"2 µm\" or \"2 nm\": a bare number is in m"), "{thickness}");
        let pixel = Quantity::<Length, PixelRange>::bare(0.196733, "0.196733").unwrap_err();
        assert!(pixel.contains("write \"196.733 nm\": "), "{pixel}");
        let sigma = Quantity::<Length, SigmaRange>::bare(0.4, "0.4").unwrap_err();
        assert!(sigma.contains("write \"400 nm\": "), "{sigma}");
        let area = |value, found| Quantity::<Area, NominalAreaRange>::bare(value, found).unwrap_err();
        let message = area(4.0, "4");
        assert!(
            message.starts_with(
                "found 4; write \"4 mm^2\" or \"4 cm^2\": a bare number is in m^2, and 4 m^2 is"
            )
        );
        assert!(message.ends_with("hardly meant as a nominal area (if it is, write \"4 m^2\")"), "{message}");
        assert!(area(2e4, "20000").contains("write \"20000 um^2\": "));
        let pressure = |value, found| Quantity::<Pressure, NominalPressureRange>::bare(value, found);
        let message = pressure(1.25, "1.25").unwrap_err();
        assert!(message.contains("write \"1.25 MPa\" or \"1.25 kPa\" or \"1.25 GPa\": "), "{message}");
        assert!(message.ends_with("(if it is, write \"1.25 Pa\")"), "{message}");
        assert!(pressure(1000.0, "1000").is_ok());
        let resistivity = Quantity::<Resistivity, ResistivityRange>::bare(28.2, "28.2").unwrap_err();
        assert!(
            resistivity.contains("write \"28.2 nohm m\" or \"28.2 uohm cm\" or \"28.2 uohm m\": "),
            "{resistivity}"
        );
        let film = Quantity::<ElectricalFilm, ElectricalFilmRange>::bare(1e-3, "1e-3").unwrap_err();
        assert!(
            film.contains("write \"0.001 uohm cm^2\" or \"0.001 mohm cm^2\" or \"0.001 ohm um^2\": "),
            "{film}"
        );
        let gap = Quantity::<ThermalConductivity, GapConductivityRange>::bare(26.0, "26").unwrap_err();
        assert!(gap.contains("write \"26 mW/(m K)\": "), "{gap}");
        let body = Quantity::<ThermalConductivity, ThermalConductivityRange>::bare(1e4, "1e4").unwrap_err();
        assert!(body.contains("write \"10000 mW/(m K)\": "), "{body}");
        let film = Quantity::<ThermalFilm, ThermalFilmRange>::bare(0.01, "0.01").unwrap_err();
        assert!(film.contains("write \"0.01 mm^2 K/W\" or \"0.01 cm^2 K/W\": "), "{film}");
        let jump = Quantity::<Length, GapJumpRange>::bare(0.4, "0.4").unwrap_err();
        assert!(jump.contains("write \"400 nm\": "), "{jump}");
    }

    #[test]
    fn si_numbers_and_numbers_with_units_are_read() {
        assert_eq!(young(210e9, "210e9"), Ok(210e9));
        assert_eq!(young(2e12, "2e12"), Ok(2e12));
        let parsed = |text| Quantity::<Pressure, ModulusRange>::parse(text).map(|young| young.value());
        assert_eq!((parsed("2 MPa"), parsed("1e9 GPa")), (Ok(2e6), Ok(1e18)));
        assert!(Quantity::<Pressure, NominalPressureRange>::parse("2 Pa").is_ok());
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
