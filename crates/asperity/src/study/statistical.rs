//! The statistical model of a study: a height density and one radius, independent of each other, or a joint density of both.

use crate::distribution::{HeightModel, HeightsError};
use crate::topography::joint::JointDensity;
use crate::{ContactLaw, Heights, MeanRadius, Paper, Population, SummitShape, literature};

use crate::surface::Surface;

/// A joint density of height and curvature over the summits of a Gaussian surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub enum JointModel {
    /// Summits of a continuous isotropic surface (Nayak 1971; Greenwood 2006).
    NayakGreenwood,
    /// Five-point summits on the grid of the map (Greenwood 1984).
    FivePoint,
}

impl JointModel {
    /// The name in specs and tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NayakGreenwood => "nayak-greenwood",
            Self::FivePoint => "five-point",
        }
    }

    /// What it describes, for sentences.
    pub const fn label(self) -> &'static str {
        match self {
            Self::NayakGreenwood => {
                "summits of a continuous isotropic Gaussian surface (Nayak 1971; Greenwood 2006)"
            }
            Self::FivePoint => {
                "five-point summits of a Gaussian surface on the grid of the map (Greenwood 1984)"
            }
        }
    }

    /// The density of a surface.
    ///
    /// # Errors
    /// A surface without a map, or moments that no such surface has.
    pub fn density(self, surface: &Surface) -> Result<JointDensity, HeightsError> {
        let map = surface.map.as_ref().ok_or("the joint density follows from a map, and it has none")?;
        let found = match self {
            Self::NayakGreenwood => JointDensity::nayak(map.roughness.spectral_moments()),
            Self::FivePoint => {
                JointDensity::five_point(&map.roughness.drops, map.roughness.moments.sq, map.pixel)
            }
        };
        Ok(found.ok_or("no isotropic Gaussian surface has the moments of its map")?)
    }

    /// The shape of its summits: spheres of the radius that each theory takes; under an elliptic law ellipses where both curvatures
    /// are known.
    pub fn shape(self, law: &ContactLaw) -> SummitShape {
        match self {
            Self::NayakGreenwood if law.is_elliptic() => SummitShape::Ellipse,
            Self::NayakGreenwood => SummitShape::GeometricMean,
            Self::FivePoint => SummitShape::ArithmeticMean,
        }
    }
}

/// The statistical model of a comparison.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StatisticalModel {
    /// The height density; `None` for Gaussian heights, or those of a population.
    pub heights: Option<HeightModel>,
    /// Which mean radius.
    pub mean_radius: MeanRadius,
    /// A joint density instead; the others then are those that indices and scales are computed with.
    pub joint: Option<JointModel>,
}

impl StatisticalModel {
    /// Those that a report compares, the simplest first.
    pub fn all() -> Vec<Self> {
        let given = [Heights::GAUSSIAN, Heights::EXPONENTIAL].map(HeightModel::Given);
        let heights: Vec<HeightModel> = given.into_iter().chain(HeightModel::FITTED).collect();
        let separate = MeanRadius::ALL.into_iter().flat_map(|mean_radius| {
            let of = move |heights: &HeightModel| Self {
                heights: Some(heights.clone()),
                mean_radius,
                joint: None,
            };
            heights.iter().map(of).collect::<Vec<_>>()
        });
        let joint = [JointModel::NayakGreenwood, JointModel::FivePoint];
        separate.chain(joint.map(|joint| Self { joint: Some(joint), ..Self::default() })).collect()
    }

    /// The model with the height density that stands for none: that of a `nominal` population, else the Gaussian one.
    pub fn explicit(&self, nominal: Option<&Population>) -> Self {
        let default = || nominal.map_or(Heights::GAUSSIAN, |population| population.heights.clone());
        let heights =
            self.heights.clone().or_else(|| self.joint.is_none().then(|| HeightModel::Given(default())));
        Self { heights, ..self.clone() }
    }

    /// Whether it takes more from the asperities than the model of the paper, which takes a mean radius, a standard deviation and a
    /// density: a fitted shape of the height density, the heights themselves, or the radius by height. Joint densities take three moments
    /// of a map.
    pub fn is_fitted(&self) -> bool {
        let has_fitted_heights =
            self.heights.as_ref().is_some_and(|heights| HeightModel::FITTED.contains(heights));
        self.joint.is_none() && (has_fitted_heights || self.mean_radius == MeanRadius::InContact)
    }

    /// The name in tables: the heights and the radius, or the joint density.
    pub fn name(&self) -> String {
        let heights = self.heights.as_ref().map_or("gaussian", HeightModel::name);
        self.joint.map_or_else(
            || format!("{heights}, {}", self.mean_radius.name()),
            |joint| joint.name().to_owned(),
        )
    }

    /// Its references.
    pub fn papers(&self) -> Vec<Paper> {
        let own = (self.heights == Some(HeightModel::Own)).then_some(literature::SILVERMAN_1986);
        let joint = self.joint.map(|joint| match joint {
            JointModel::NayakGreenwood => literature::GREENWOOD_2006,
            JointModel::FivePoint => literature::GREENWOOD_1984,
        });
        own.into_iter().chain(joint).collect()
    }

    /// Why its difference from the sum is not divided among causes; `None` where it is.
    pub fn undivided(&self) -> Option<&'static str> {
        if self.joint.is_some() {
            return Some("the statistical model has a joint density of height and curvature, not one radius");
        }
        (self.mean_radius == MeanRadius::InContact).then_some(
            "the statistical model takes the mean radius of the asperities in contact, which changes with the load, not one radius",
        )
    }
}
