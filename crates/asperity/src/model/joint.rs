//! The statistical model of a joint density of height and curvature.

use super::{Mixture, Model, ReferencePlane, Statistical};
use crate::asperity::Population;
use crate::distribution::Heights;
use crate::interface::MicroContact;
use crate::shape::Shape;
use crate::topography::joint::{JointDensity, SummitClass};

/// The radius of the contact of a summit with two principal curvatures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SummitShape {
    /// A sphere of radius 1/(k1 k2)^.5 (Greenwood 2006).
    GeometricMean,
    /// A sphere of radius 2/(k1 + k2), as in the deterministic model.
    ArithmeticMean,
    /// An elliptic paraboloid.
    Ellipse,
}

impl SummitShape {
    fn shape(self, class: &SummitClass) -> Shape {
        let [larger, smaller] = class.curvatures;
        let mean = 0.5 * (larger + smaller);
        match self {
            Self::GeometricMean => Shape::sphere((larger * smaller).sqrt().recip()),
            Self::ArithmeticMean => Shape::sphere(mean.recip()),
            Self::Ellipse => Shape::ellipse(mean, larger / smaller),
        }
    }
}

/// The integral of a micro-contact over a joint density of height and curvature: that over the heights of each class of summits,
/// added up. Separations are measured from and in units of `plane`, whose mean is relative to the mean plane of the surface, m.
pub fn joint_model<'a>(
    contact: &'a dyn MicroContact,
    joint: &JointDensity,
    shape: SummitShape,
    plane: ReferencePlane,
) -> impl Model + 'a {
    let class = |class: &SummitClass| {
        let shape = shape.shape(class);
        let population = Population {
            radius: shape.radius,
            sigma: class.sd,
            density: joint.density,
            heights: Heights::GAUSSIAN,
        };
        let plane = ReferencePlane { mean: plane.mean - class.height, ..plane };
        (class.share, Statistical::of_shape(contact, population, shape).reported_from(plane))
    };
    Mixture::new(joint.classes.iter().map(class).collect())
}
