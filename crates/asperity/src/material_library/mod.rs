//! A library of engineering materials, each value with its source.
//!
//! Values are typical of the named condition at room temperature. A surface layer that was ground, rolled or worn may be
//! harder; a measured hardness of the part in question is better than any value of a table. Annealed metals have no yield
//! strength here: they harden with strain, so that their 0.2 % proof stress is a fifth to a tenth of their hardness, and laws
//! that use the one describe another material than laws that use the other.
//!
//! ```
//! use asperity::material_library;
//!
//! let steel = material_library::find("steel-100Cr6").ok_or("not in the library")?;
//! println!("E = {:e} Pa ({})", steel.young.value, steel.young.source());
//! let body = steel.material()?;
//! # assert_eq!(body.young(), 210e9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod table;

use crate::material::{Material, MaterialError};
use crate::named_enum;

/// A value with its source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sourced {
    /// The value, in SI units.
    pub value: f64,
    /// Standard, handbook, data sheet or paper, with edition.
    pub reference: &'static str,
    /// What the value is in the reference: a range, a condition, a conversion; may be empty.
    pub note: &'static str,
}

impl Sourced {
    /// The reference, and what the value is in it.
    pub fn source(&self) -> String {
        match self.note {
            "" => self.reference.to_owned(),
            note => format!("{}: {note}", self.reference),
        }
    }
}

named_enum! {
    /// What a material is, which decides how hardness and yield strength relate.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Class {
        /// Metals and alloys.
        Metal = "metals",
        /// Ceramics, glasses, semiconductors and hard coatings.
        Ceramic = "ceramics, glasses and hard coatings",
        /// Polymers.
        Polymer = "polymers",
    }
}

/// A material of the library.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LibraryMaterial {
    /// Its name in the library.
    pub name: &'static str,
    /// Composition and condition.
    pub description: &'static str,
    /// What it is.
    pub class: Class,
    /// Young's modulus, Pa.
    pub young: Sourced,
    /// Poisson's ratio.
    pub poisson: Sourced,
    /// Indentation hardness, Pa: of Vickers, unless the note names another.
    pub hardness: Option<Sourced>,
    /// Yield strength, Pa: the 0.2 % proof stress, unless the note says otherwise.
    pub yield_strength: Option<Sourced>,
    /// Electrical resistivity, ohm m.
    pub resistivity: Option<Sourced>,
    /// Thermal conductivity, W/(m K).
    pub thermal_conductivity: Option<Sourced>,
}

impl LibraryMaterial {
    const fn new(
        class: Class,
        [name, description]: [&'static str; 2],
        young: Sourced,
        poisson: Sourced,
    ) -> Self {
        Self {
            name,
            description,
            class,
            young,
            poisson,
            hardness: None,
            yield_strength: None,
            resistivity: None,
            thermal_conductivity: None,
        }
    }

    /// The body with these properties.
    ///
    /// # Errors
    /// None for the materials of the library.
    pub fn material(&self) -> Result<Material, MaterialError> {
        let value = |sourced: Option<Sourced>| sourced.map(|sourced| sourced.value);
        Material::new(self.young.value, self.poisson.value, value(self.hardness), value(self.yield_strength))?
            .conducting(value(self.resistivity), value(self.thermal_conductivity))
    }
}

/// All materials: metals, then ceramics, then polymers.
pub fn all() -> impl Iterator<Item = &'static LibraryMaterial> {
    table::METALS.iter().chain(table::CERAMICS).chain(table::POLYMERS)
}

/// The material called `name`, in upper or lower case.
pub fn find(name: &str) -> Option<&'static LibraryMaterial> {
    all().find(|material| material.name.eq_ignore_ascii_case(name.trim()))
}

/// The names of materials whose description contains `name`, then the names most similar to it; at most four, and none that
/// has little in common with it.
pub fn similar(name: &str) -> Vec<&'static str> {
    /// Least share of common pairs of letters.
    const LEAST: f64 = 0.3;
    const MOST: usize = 4;
    let wanted = letter_pairs(name);
    let mut scored: Vec<(f64, &'static str)> =
        all().map(|material| (score(name, &wanted, material), material.name)).collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    scored.into_iter().filter(|(score, _)| *score >= LEAST).map(|(_, name)| name).take(MOST).collect()
}

/// How well `name`, of the letter pairs `wanted`, fits a material: 0 to 1.
fn score(name: &str, wanted: &[[char; 2]], material: &LibraryMaterial) -> f64 {
    let name = name.trim().to_lowercase();
    let is_described = name.len() > 2 && material.description.to_lowercase().contains(&name);
    if is_described { 1.0 } else { similarity(wanted, &letter_pairs(material.name)) }
}

/// Pairs of neighbouring letters and digits, without case.
fn letter_pairs(name: &str) -> Vec<[char; 2]> {
    let letters: Vec<char> = name.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect();
    letters.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// Common pairs over the mean number of pairs (the coefficient of Dice), 0 to 1.
fn similarity(one: &[[char; 2]], other: &[[char; 2]]) -> f64 {
    let mut left = other.to_vec();
    let mut common = 0;
    for pair in one {
        if let Some(place) = left.iter().position(|found| found == pair) {
            left.swap_remove(place);
            common += 1;
        }
    }
    if common == 0 { 0.0 } else { 2.0 * common as f64 / (one.len() + other.len()) as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_is_a_body_and_has_a_source_for_each_value() {
        assert!(all().count() >= 20);
        for material in all() {
            assert!(material.material().is_ok(), "{}", material.name);
            assert!(!material.description.is_empty());
            let others = [material.hardness, material.yield_strength];
            for value in others.into_iter().flatten().chain([material.young, material.poisson]) {
                assert!(value.reference.len() > 10, "{}: {}", material.name, value.source());
            }
            assert_eq!(all().filter(|other| other.name.eq_ignore_ascii_case(material.name)).count(), 1);
        }
    }

    #[test]
    fn values_are_those_of_their_class() {
        for material in all() {
            let [young, poisson] = [material.young.value, material.poisson.value];
            let (moduli, ratios) = match material.class {
                Class::Metal => (10e9..=450e9, 0.25..=0.45),
                Class::Ceramic => (60e9..=1000e9, 0.15..=0.32),
                Class::Polymer => (0.3e9..=5e9, 0.3..=0.47),
            };
            assert!(moduli.contains(&young) && ratios.contains(&poisson), "{}", material.name);
            let hardness = material.hardness.map(|hardness| hardness.value);
            // Beyond E*/5 of equal bodies a hardness is a mistake of a unit.
            let own = young / (1.0 - poisson * poisson);
            assert!(hardness.is_none_or(|hardness| hardness < own / 5.0), "{}", material.name);
            assert!(material.class == Class::Polymer || hardness.is_some(), "{}", material.name);
            let ratio = hardness.zip(material.yield_strength).map(|(hardness, y)| hardness / y.value);
            let ratios = if material.class == Class::Metal { 2.0..=4.0 } else { 1.5..=4.0 };
            assert!(ratio.is_none_or(|ratio| ratios.contains(&ratio)), "{}: H/Y = {ratio:?}", material.name);
        }
    }

    #[test]
    fn names_are_found_and_mistaken_ones_get_suggestions() {
        assert_eq!(find("Steel-100CR6").map(|found| found.name), Some("steel-100Cr6"));
        assert!(find("steel").is_none());
        assert_eq!(similar("steel-100-Cr-6")[0], "steel-100Cr6");
        assert_eq!(similar("100Cr6")[0], "steel-100Cr6");
        assert_eq!(similar("52100")[0], "steel-100Cr6");
        assert_eq!(similar("Ti-6Al-4V")[0], "titanium-Ti6Al4V");
        assert!(similar("ptfe").contains(&"PTFE"));
        assert!(similar("").is_empty() && similar("xq").is_empty());
        assert!(similar("steel").len() <= 4);
    }
}
