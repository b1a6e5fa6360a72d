//! `[surface.NAME.KIND]`: where asperities come from.

use std::path::PathBuf;

use asperity::Heights;
use asperity::topography::Level;
use asperity::topography::fitness::Lines;
use asperity::topography::read::Crop;
use asperity::topography::summits::Neighbours;
use asperity::units::Dimension;
use asperity_contact_framework::input::bare::{NominalAreaRange, PixelRange, SigmaRange};
use asperity_contact_framework::input::quantity::{
    Area, ArealNumberDensity, Length, NotNegative, Pure, Quantity,
};
use asperity_contact_framework::input::{OneOrMany, Spanned, Whole, heights, named, named_or_none, schema};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};

use super::generation::GenerateSpec;
use crate::surface::files::{MapUnitSpec, MissingSpec};

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
    File(Box<FileSpec>),
    /// Two rough bodies.
    Pair(PairSpec),
}

impl SurfaceSpec {
    /// Whether it is a pair of other surfaces.
    pub fn is_pair(&self) -> bool {
        matches!(self, Self::Pair(_))
    }
}

/// Raw input: a table for each kind, of which exactly one is allowed.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Kinds {
    /// Your own list of asperities.
    asperities: Option<ListSpec>,
    /// Asperities drawn from a population of one radius.
    population: Option<PopulationSpec>,
    /// A random rough surface, whose summits are the asperities.
    generate: Option<GenerateSpec>,
    /// A measured height map, whose summits are the asperities.
    file: Option<FileSpec>,
    /// Two rough bodies: the sum of the height maps of two other surfaces at several relative positions, or the composite of two populations.
    pair: Option<PairSpec>,
}

written_schema!(SurfaceSpec, |generator| Kinds::json_schema(generator));

impl TryFrom<Kinds> for SurfaceSpec {
    type Error = String;

    fn try_from(kinds: Kinds) -> Result<Self, String> {
        let Kinds { asperities, population, generate, file, pair } = kinds;
        let given = [
            asperities.map(Self::Asperities),
            population.map(Self::Population),
            generate.map(|raw| Self::Generate(Box::new(raw))),
            file.map(|raw| Self::File(Box::new(raw))),
            pair.map(Self::Pair),
        ];
        let mut given = given.into_iter().flatten();
        match (given.next(), given.next()) {
            (Some(kind), None) => Ok(kind),
            _ => Err("found none or several kinds; allowed: exactly one of asperities, population, generate, file, pair per \
                      surface"
                .to_owned()),
        }
    }
}

/// A list of asperities: a text with columns height and radius, or an n x 2 `.npy`; for elliptic laws with kx and
/// ky too.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { file, nominal-area, unit, independent }"
)]
pub struct ListSpec {
    /// Text with the columns height and radius (kx and ky for elliptic laws; x and y where they are known), or an n x 2 (n x 4) `.npy`; relative to the spec.
    #[schemars(extend("examples" = ["asperities.csv"]))]
    pub file: Spanned<PathBuf>,
    /// Unit of heights and radii, reciprocal unit of curvatures; only where the file names none.
    #[schemars(extend("default" = "m", "examples" = ["um"]))]
    pub unit: Option<Spanned<UnitSpec>>,
    /// Whether the asperities are independent draws, so that their scatter gives intervals. Those of a surface are not; with the columns x and y they are divided into blocks.
    #[serde(default)]
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub independent: bool,
    /// Nominal area that the asperities are from.
    #[schemars(extend("examples" = ["1 mm^2"]))]
    pub nominal_area: Quantity<Area, NominalAreaRange>,
}

/// Radius, deviation of heights, density, and how a set is drawn.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { radius, sigma, density, count }"
)]
pub struct PopulationSpec {
    /// Radius of every asperity: 1/(mean curvature).
    #[schemars(extend("examples" = ["20 um"]))]
    pub radius: Quantity<Length>,
    /// The larger principal curvature of every asperity over the smaller one; needed by elliptic laws.
    #[schemars(extend("x-range" = "1 to 1e6", "examples" = [2]))]
    pub curvature_ratio: Option<Spanned<Quantity<Pure>>>,
    /// Standard deviation of the asperity heights; of the surface heights with `heights = "surface"`.
    #[schemars(extend("examples" = ["48 nm"]))]
    pub sigma: Quantity<Length, SigmaRange>,
    /// Asperities per nominal area.
    #[schemars(extend("examples" = ["6e10 /m^2"]))]
    pub density: Quantity<ArealNumberDensity>,
    /// How many asperities the deterministic model draws.
    #[schemars(extend("x-range" = "from 1", "examples" = [100000]))]
    pub count: Spanned<Whole>,
    /// Distribution of the asperity heights; `"surface"`: sigma and separations are those of the surface, converted by Nayak (1971).
    #[serde(default)]
    #[schemars(extend("default" = "gaussian", "examples" = [{ "johnson": { "skewness": -1, "kurtosis": 4.5 } }]))]
    pub heights: PopulationHeights,
    /// How the heights of the set are taken.
    #[serde(default)]
    #[schemars(extend("default" = "random", "examples" = ["quantiles"]))]
    pub draw: DrawSpec,
    /// How many sets are drawn; their scatter gives the intervals.
    #[schemars(extend("x-range" = "1 to 1000", "default" = 1, "examples" = [8]))]
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

written_schema!(PopulationHeights, |_| heights::schema(&["surface"]));

impl<'de> Deserialize<'de> for PopulationHeights {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        heights::read_or(deserializer, &[("surface", Self::Surface)], Self::Asperities)
    }
}

/// `draw` of a population.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DrawSpec {
    /// Independent draws from the spec's seed.
    #[default]
    Random,
    /// Heights at the quantiles.
    Quantiles,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { path }")]
pub struct FileSpec {
    /// The height map: a file of an instrument, `.npy` (first index x), X3P, SDF, a text matrix or columns x y z; relative to the spec.
    #[schemars(extend("examples" = ["map.npy"]))]
    pub path: Spanned<PathBuf>,
    /// Pixel size, or one along x and one along y; in place of that of the file, if it states one. The first index of a `.npy` is x; in a text x runs along a line.
    #[schemars(extend("examples" = ["0.8 um"]))]
    pub pixel: Option<Spanned<PixelSpec>>,
    /// Unit of the lengths in the file, or one of coordinates and one of heights; in place of those that the file states, with a warning. It is that of the
    /// numbers in the file, times their own factors; one unit, for a file that states that of its pixel only, is that of its heights.
    #[schemars(extend("default" = "m", "examples" = ["um", { "xy": "um", "z": "nm" }]))]
    pub unit: Option<Spanned<MapUnitSpec>>,
    /// Heights that mark missing points, in the unit of the file, and words of a text that do. `[]`: every number is a height, although one is far from all others.
    #[schemars(extend("x-default" = "none; a height far from all others is an error", "examples" = [-9999, ["***", -9999]]))]
    pub missing: Option<Spanned<MissingSpec>>,
    /// The channel of a file that holds several, by its name there.
    #[schemars(extend("x-default" = "that of the heights", "examples" = ["Height Sensor"]))]
    pub channel: Option<Spanned<String>>,
    /// The part of the map that is used, from and to along x, y or both, by lengths from its first point; all else sees this part only. A part of a periodic map is not periodic.
    #[schemars(extend("x-default" = "the whole map", "examples" = [{ "x": ["10 um", "200 um"], "y": ["0 um", "50 um"] }]))]
    pub crop: Option<Spanned<CropSpec>>,
    /// Whether x and y of the file are exchanged; `pixel` is then that of the exchanged map.
    #[serde(default)]
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub transpose: bool,
    /// Whether the map continues periodically beyond its border, as simulated surfaces do.
    #[serde(default)]
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub periodic: bool,
    /// Whether the preparation that makes the map fit is searched: remedies of the failed checks, one after the other. Keys of the preparation that stand beside it are kept.
    #[serde(default, deserialize_with = "named_or_none")]
    #[schemars(extend("x-default" = "none", "examples" = ["auto"]))]
    pub fit: Option<FitSpec>,
    /// What becomes of spikes.
    #[serde(default, deserialize_with = "named_or_none")]
    #[schemars(extend("default" = "keep", "examples" = ["remove"]))]
    pub outliers: Option<Outliers>,
    /// The axis along which lines of the scan are set to the same mean height.
    #[serde(default, deserialize_with = "named_or_none")]
    #[schemars(extend("x-default" = "none", "examples" = ["x"]))]
    pub align_lines: Option<Lines>,
    /// Radius of the stylus or tip that traced the map: what it added to the summits is eroded.
    #[schemars(extend("x-default" = "none", "examples" = ["5 um"]))]
    pub tip: Option<Quantity<Length>>,
    /// Form that is removed.
    #[serde(default, deserialize_with = "named_or_none")]
    #[schemars(extend("x-default" = "plane; none of a periodic map", "examples" = ["quadratic"]))]
    pub level: Option<Level>,
    /// Nesting indices of Gaussian S and L filters (ISO 16610-61), either or both.
    #[schemars(extend("x-default" = "none", "examples" = [{ "s": "2.5 um", "l": "80 um" }]))]
    pub filter: Option<Spanned<FilterSpec>>,
    /// Which neighbours a summit is higher than.
    #[serde(default, deserialize_with = "named")]
    #[schemars(extend("default" = "four", "examples" = ["eight"]))]
    pub neighbours: Neighbours,
}

/// `fit` of a measured map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FitSpec {
    /// By its own checks.
    Auto,
}

/// `outliers` of a measured map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Outliers {
    /// Spikes are heights like others.
    Keep,
    /// Spikes are missing points.
    Remove,
}

/// A unit of length, in metres.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub struct UnitSpec(pub f64);

written_schema!(UnitSpec, |_| schema::names(Dimension::Length.documented().iter().copied()));

impl TryFrom<String> for UnitSpec {
    type Error = String;

    fn try_from(word: String) -> Result<Self, String> {
        let unit = Dimension::Length.documented_factor(&word).map(Self);
        unit.ok_or_else(|| {
            format!("found the unit \"{word}\"; allowed: {}", Dimension::Length.documented().join(", "))
        })
    }
}

/// `crop = { x, y }`: from and to along each axis, either or both.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { x, y } of lengths from and to")]
pub struct CropSpec {
    /// From and to along x.
    #[schemars(extend("x-default" = "the whole axis", "examples" = [["10 um", "200 um"]]))]
    pub x: Option<[Quantity<Length, NotNegative>; 2]>,
    /// From and to along y.
    #[schemars(extend("x-default" = "the whole axis", "examples" = [["0 um", "50 um"]]))]
    pub y: Option<[Quantity<Length, NotNegative>; 2]>,
}

impl CropSpec {
    pub fn part(self) -> Crop {
        let ends =
            |ends: Option<[Quantity<Length, NotNegative>; 2]>| ends.map(|ends| ends.map(|end| end.value()));
        Crop { x: ends(self.x), y: ends(self.y) }
    }
}

/// `filter = { s, l }`: nesting indices (ISO 16610-61), either or both.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { s, l }")]
pub struct FilterSpec {
    /// Nesting index of the S filter, which removes shorter wavelengths.
    #[schemars(extend("examples" = ["2.5 um"]))]
    pub s: Option<Quantity<Length>>,
    /// Nesting index of the L filter, which removes longer wavelengths.
    #[schemars(extend("examples" = ["80 um"]))]
    pub l: Option<Quantity<Length>>,
}

/// Two rough bodies, of which each is another surface of the spec: with a height map, or both Gaussian populations.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table { a, b, shifts } such as { a = \"ring\", b = \"liner\", shifts = 16 }"
)]
pub struct PairSpec {
    /// The surface of the body whose material is `rough`.
    #[schemars(extend("examples" = ["ring"]))]
    pub a: Spanned<String>,
    /// The surface of the body whose material is `flat`; its x axis is mirrored, since each map is seen from outside its body.
    #[schemars(extend("examples" = ["liner"]))]
    pub b: Spanned<String>,
    /// Number of random relative positions of two maps. Maps that repeat are shifted around their border; of others the overlap counts, at least three
    /// quarters of the shorter side along each axis.
    #[schemars(extend("x-range" = "1 to 1000", "default" = 16, "examples" = [16]))]
    pub shifts: Option<Spanned<Whole>>,
    /// Whether b is also rotated at random by 0, 90, 180 or 270 degrees.
    #[serde(default)]
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub rotations: bool,
}

/// One pixel size, or one along x and one along y.
#[derive(Debug, Clone, Copy)]
pub struct PixelSpec(pub [f64; 2]);

written_schema!(PixelSpec, |_| schema::one_or_many(
    schema::quantity::<Length, PixelRange>(),
    "length, or a list of two: along x and along y"
));

impl<'de> Deserialize<'de> for PixelSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a length such as \"0.8 um\", or a list of two: along x and along y";
        let sizes =
            OneOrMany::<Quantity<Length, PixelRange>>::read(deserializer, expected)?.along_both("sizes")?;
        Ok(Self(sizes.map(|size| size.value())))
    }
}
