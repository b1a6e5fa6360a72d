//! The statistical model of a study (a height density and one radius, or a joint density of height and curvature), and both models on one
//! surface, for laws of spheres and of ellipses.

use std::sync::Arc;

use crate::compare::Inputs;
use crate::distribution::{HeightModel, HeightsError};
use crate::model::{Medium, WithMedium};
use crate::numeric::interval::Interval;
use crate::surface::Surface;
use crate::topography::joint::JointDensity;
use crate::{
    Asperities, ContactLaw, Deterministic, Ellipse, Ellipses, Heights, MeanRadius, MicroContact, Model,
    Paper, Population, RadiusInContact, ReferencePlane, Shape, Statistical, SummitShape, joint_model,
    literature, named_enum,
};

/// A surface with its asperities as the laws of the sums that are asked for see them.
pub struct SurfaceModels<'a> {
    surface: &'a Surface,
    population: Population,
    statistical: StatisticalModel,
    joint: Option<Arc<JointDensity>>,
    is_summed: bool,
    ellipses: Option<Ellipses<'a>>,
}

impl<'a> SurfaceModels<'a> {
    /// The models of `laws` on a surface.
    ///
    /// # Errors
    /// A statistical model that does not apply to the surface.
    pub fn new(
        surface: &'a Surface,
        statistical: &StatisticalModel,
        laws: &[ContactLaw],
        is_summed: bool,
    ) -> Result<Self, HeightsError> {
        let joint = statistical
            .joint
            .filter(|_| surface.unscattered.is_none())
            .map(|joint| joint.density(surface))
            .transpose()?;
        Self::with(joint.map(Arc::new), surface, statistical, laws, is_summed)
    }

    /// The same models of a part of the surface; a joint density stays that of the whole map.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of_part<'b>(
        &self,
        part: &'b Surface,
        laws: &[ContactLaw],
        is_summed: bool,
    ) -> Result<SurfaceModels<'b>, HeightsError> {
        SurfaceModels::with(self.joint.clone(), part, &self.statistical, laws, is_summed)
    }

    fn with(
        joint: Option<Arc<JointDensity>>,
        surface: &'a Surface,
        statistical: &StatisticalModel,
        laws: &[ContactLaw],
        is_summed: bool,
    ) -> Result<Self, HeightsError> {
        let is_elliptic = is_summed && laws.iter().any(ContactLaw::is_elliptic);
        let ellipses = if is_elliptic { Ellipses::new(&surface.set) } else { None };
        let population = surface.population(statistical.heights.as_ref(), statistical.mean_radius)?;
        Ok(Self { surface, population, statistical: statistical.clone(), joint, is_summed, ellipses })
    }

    /// Input of the statistical model.
    pub fn population(&self) -> &Population {
        &self.population
    }

    /// The mean asperity under a law.
    pub fn mean_shape(&self, law: &ContactLaw) -> Shape {
        let ellipticity = self.surface.ellipticity.filter(|_| law.is_elliptic());
        ellipticity.map_or(Shape::sphere(self.population.radius), |mean| mean.shape())
    }

    /// The sharpest and the bluntest asperity under a law.
    pub fn extreme_shapes(&self, law: &ContactLaw) -> [Shape; 2] {
        let set = &self.surface.set;
        let mean = self.mean_shape(law);
        let Some(ellipses) = set.ellipses().filter(|_| law.is_elliptic()) else {
            let Interval { low, high } = Interval::new(set.radii());
            return [low.min(mean.radius), high.max(mean.radius)].map(Shape::sphere);
        };
        let by_radius = |a: &Shape, b: &Shape| a.radius.total_cmp(&b.radius);
        ellipses.iter().map(Ellipse::shape).fold([mean; 2], |[low, high], shape| {
            [std::cmp::min_by(low, shape, by_radius), std::cmp::max_by(high, shape, by_radius)]
        })
    }

    /// What conducts in the gap, where the contact is asked for it and the mean plane of the surface is known.
    fn medium(&self, contact: &dyn MicroContact) -> Option<Medium> {
        let gap = contact.spot_properties()?.medium?;
        Some(Medium { gap, offset: self.surface.plane_above_mean_plane()? })
    }

    /// The statistical model with one contact of a law.
    pub fn statistical<'b>(&'b self, contact: &'b dyn MicroContact, law: &ContactLaw) -> Box<dyn Model + 'b> {
        let model = self.statistical_spots(contact, law);
        match self.medium(contact) {
            Some(medium) => Box::new(WithMedium { model, medium }),
            None => model,
        }
    }

    /// The same without what conducts in the gap.
    fn statistical_spots<'b>(
        &'b self,
        contact: &'b dyn MicroContact,
        law: &ContactLaw,
    ) -> Box<dyn Model + 'b> {
        if let (Some(joint), Some(density), Some(mean)) =
            (self.statistical.joint, &self.joint, self.surface.plane_above_mean_plane())
        {
            let plane = ReferencePlane { mean, sigma: self.surface.plane.sigma };
            return Box::new(joint_model(contact, density, joint.shape(law), plane));
        }
        let (population, shape) = (self.population.clone(), self.mean_shape(law));
        if self.surface.meets_in_pairs {
            return Box::new(Statistical::new(contact, population).weighed_by_survival());
        }
        let plane = self.surface.reporting_plane();
        match self.statistical.mean_radius {
            MeanRadius::InContact => {
                let (radii, origin) = (self.surface.set.radii_above(), self.surface.plane.mean);
                Box::new(RadiusInContact::new(contact, radii, population, shape, plane, origin))
            }
            MeanRadius::Arithmetic | MeanRadius::InverseMeanCurvature => {
                Box::new(Statistical::of_shape(contact, population, shape).reported_from(plane))
            }
        }
    }

    /// The asperities as a law sees them; `None` unless the sum is requested.
    fn asperities(&self, law: &ContactLaw) -> Option<Asperities<'_>> {
        if law.is_elliptic() {
            self.ellipses.as_ref().map(Ellipses::asperities)
        } else {
            self.is_summed.then(|| self.surface.set.spheres())
        }
    }

    /// What the states between both models are made from under laws of the same shapes; `None` unless the sum is requested, and
    /// of a statistical model that has not one radius. What conducts in the gap is that of `contact`.
    pub fn inputs(&self, contact: &dyn MicroContact, law: &ContactLaw) -> Option<Inputs<'_>> {
        if self.statistical.undivided().is_some() {
            return None;
        }
        // The mean ellipse is that of the mean curvature under every convention, and a nominal population has its own radius.
        let has_other = !law.is_elliptic() && self.surface.nominal.is_none();
        let other_radius = self.statistical.mean_radius.other().radius(&self.surface.statistics);
        Some(Inputs {
            asperities: self.asperities(law)?,
            set: &self.surface.set,
            plane: self.surface.plane,
            population: self.population.clone(),
            mean_shape: self.mean_shape(law),
            other_shape: has_other.then(|| Shape::sphere(other_radius)),
            reporting_plane: self.surface.reporting_plane(),
            medium: self.medium(contact),
        })
    }

    /// The sum of one contact of a law; `None` unless the sum is requested.
    pub fn deterministic<'b>(
        &'b self,
        contact: &'b dyn MicroContact,
        law: &ContactLaw,
    ) -> Option<Deterministic<'b>> {
        let sum = |asperities| Deterministic::new(contact, asperities, self.surface.plane);
        Some(sum(self.asperities(law)?).with_medium(self.medium(contact)))
    }
}

named_enum! {
    /// A joint density of height and curvature over the summits of a Gaussian surface.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    pub enum JointModel {
        /// Summits of a continuous isotropic surface (Nayak 1971; Greenwood 2006).
        NayakGreenwood = "nayak-greenwood",
        /// Five-point summits on the grid of the map (Greenwood 1984).
        FivePoint = "five-point",
    }
}

impl JointModel {
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
