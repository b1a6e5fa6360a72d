//! `[surface.NAME.KIND]`: where asperities come from.

use std::fmt;
use std::path::PathBuf;

use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use toml::Spanned;

use crate::surface::generate_spec::GenerateSpec;
use crate::surface::pixel_spec::PixelSpec;
use asperity::Heights;
use asperity::topography::Level;
use asperity::topography::fitness::Lines;
use asperity::topography::summits::Neighbours;
use asperity::units::Dimension;
use asperity_framework::input::Whole;
use asperity_framework::input::heights::HeightsSpec;
use asperity_framework::input::quantity::{Area, ArealNumberDensity, Length, Pure, Quantity};

/// One surface: exactly one kind per name.
#[derive(Debug, Deserialize)]
#[serde(try_from = "Kinds")]
pub enum SurfaceSpec {
    /// A list of asperities.
    Asperities(ListSpec),
    /// A population by its three numbers.
    Population(PopulationSpec),
    /// A random rough surface.
    Generate(Box<GenerateSpec>),
    /// A measured height map.
    File(FileSpec),
}

/// Raw input: a table for each kind, of which exactly one is allowed.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Kinds {
    asperities: Option<ListSpec>,
    population: Option<PopulationSpec>,
    generate: Option<GenerateSpec>,
    file: Option<FileSpec>,
}

impl TryFrom<Kinds> for SurfaceSpec {
    type Error = String;

    fn try_from(kinds: Kinds) -> Result<Self, String> {
        let Kinds { asperities, population, generate, file } = kinds;
        let given = [
            asperities.map(Self::Asperities),
            population.map(Self::Population),
            generate.map(|raw| Self::Generate(Box::new(raw))),
            file.map(Self::File),
        ];
        let mut given = given.into_iter().flatten();
        match (given.next(), given.next()) {
            (Some(kind), None) => Ok(kind),
            _ => Err("found none or several kinds; allowed: exactly one of asperities, population, generate, file per \
                      surface"
                .to_owned()),
        }
    }
}

/// A list of asperities: a text with columns height and radius, or an n x 2 `.npy`; for elliptic laws with kx and
/// ky too.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { file, nominal-area, unit }")]
pub struct ListSpec {
    /// The file, relative to the spec.
    pub file: Spanned<PathBuf>,
    /// Unit of heights and radii, reciprocal unit of curvatures; only where the file names none.
    pub unit: Option<Spanned<UnitSpec>>,
    /// Nominal area of the asperities.
    pub nominal_area: Quantity<Area>,
}

/// Radius, deviation of heights, density, and how a set is drawn.
#[derive(Debug, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { radius, sigma, density, count }"
)]
pub struct PopulationSpec {
    /// Radius of every asperity: 1/(mean curvature).
    pub radius: Quantity<Length>,
    /// The larger principal curvature of every asperity over the smaller one, for elliptic laws.
    pub curvature_ratio: Option<Spanned<Quantity<Pure>>>,
    /// Standard deviation of the heights.
    pub sigma: Quantity<Length>,
    /// Asperities per nominal area.
    pub density: Quantity<ArealNumberDensity>,
    /// How many the deterministic model draws.
    pub count: Spanned<Whole>,
    /// Whose deviation sigma is, and of what density.
    #[serde(default)]
    pub heights: PopulationHeights,
    /// How the heights of the set are taken.
    #[serde(default)]
    pub draw: DrawSpec,
    /// How many sets are drawn.
    pub realisations: Option<Spanned<Whole>>,
}

/// `heights` of a population.
#[derive(Debug, Clone, PartialEq)]
pub enum PopulationHeights {
    /// Asperity heights of deviation sigma.
    Asperities(Heights),
    /// Gaussian; sigma and d are those of the surface, converted by Nayak (1971).
    Surface,
}

impl Default for PopulationHeights {
    fn default() -> Self {
        Self::Asperities(Heights::GAUSSIAN)
    }
}

impl<'de> Deserialize<'de> for PopulationHeights {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        const SURFACE: &str = "surface";
        struct NameOrTable;

        impl<'de> Visitor<'de> for NameOrTable {
            type Value = PopulationHeights;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(&HeightsSpec::allowed(&[SURFACE]))
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<PopulationHeights, E> {
                if name == SURFACE {
                    return Ok(PopulationHeights::Surface);
                }
                let heights = HeightsSpec::named(name, &[SURFACE]).map_err(E::custom)?;
                Ok(PopulationHeights::Asperities(heights.0))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<PopulationHeights, A::Error> {
                let heights = HeightsSpec::deserialize(MapAccessDeserializer::new(map))?;
                Ok(PopulationHeights::Asperities(heights.0))
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}

/// `draw` of a population.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DrawSpec {
    /// Independent draws from the spec's seed.
    #[default]
    Random,
    /// Heights at the quantiles.
    Quantiles,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { path }")]
pub struct FileSpec {
    /// The file, relative to the spec.
    pub path: Spanned<PathBuf>,
    /// Pixel size along x and y; only where the format contains none.
    pub pixel: Option<Spanned<PixelSpec>>,
    /// Unit of the lengths in the file; only where the format contains none.
    pub unit: Option<Spanned<UnitSpec>>,
    /// What becomes of spikes.
    #[serde(default)]
    pub outliers: Outliers,
    /// The axis along which lines of the scan are set to the same mean height.
    pub align_lines: Option<Lines>,
    /// Form that is removed.
    #[serde(default)]
    pub level: Level,
    /// S and L nesting indices.
    pub filter: Option<Spanned<FilterSpec>>,
    /// Which neighbours a summit is higher than.
    #[serde(default)]
    pub neighbours: Neighbours,
}

/// `outliers` of a measured map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outliers {
    /// Spikes are heights like others.
    #[default]
    Keep,
    /// Spikes are missing points.
    Remove,
}

/// A unit of length, in metres.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub struct UnitSpec(pub f64);

impl TryFrom<String> for UnitSpec {
    type Error = String;

    fn try_from(word: String) -> Result<Self, String> {
        let unit = Dimension::Length.documented_factor(&word).map(Self);
        unit.ok_or_else(|| {
            format!("found the unit \"{word}\"; allowed: {}", Dimension::Length.documented().join(", "))
        })
    }
}

/// `filter = { s, l }`: nesting indices (ISO 16610-61), either or both.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table { s, l }")]
pub struct FilterSpec {
    /// Wavelengths below it are taken out.
    pub s: Option<Quantity<Length>>,
    /// Wavelengths above it are taken out.
    pub l: Option<Quantity<Length>>,
}
