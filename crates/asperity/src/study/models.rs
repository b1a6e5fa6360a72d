//! Both models on one surface, for laws of spheres and of ellipses.

use super::statistical::StatisticalModel;
use crate::surface::Surface;
use std::sync::Arc;

use crate::compare::Inputs;
use crate::distribution::HeightsError;
use crate::model::{Medium, WithMedium};
use crate::numeric::interval::Interval;
use crate::topography::joint::JointDensity;
use crate::{
    Asperities, ContactLaw, Deterministic, Ellipse, Ellipses, MeanRadius, MicroContact, Model, Population,
    RadiusInContact, ReferencePlane, Shape, Statistical, joint_model,
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
