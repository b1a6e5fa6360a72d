//! A statistical model of several classes of asperities, the weighted sum of their integrals: that of a joint density of height and
//! curvature.

use super::load_control::{LOWEST_SEPARATION, search_missing};
use super::{Model, ReferencePlane, Response, Statistical, descent, separations_of};
use crate::asperity::Population;
use crate::contact::ByRegime;
use crate::distribution::Heights;
use crate::interface::MicroContact;
use crate::numeric::parallel;
use crate::numeric::root::last_reaching;
use crate::shape::Shape;
use crate::topography::joint::{JointDensity, SummitClass};

/// Classes of asperities, each with its share of all, which report separations from one plane.
pub(crate) struct Mixture<'a> {
    classes: Vec<(f64, Statistical<'a>)>,
}

impl<'a> Mixture<'a> {
    /// At least one class.
    pub(crate) fn new(classes: Vec<(f64, Statistical<'a>)>) -> Self {
        Self { classes }
    }

    fn models(&self) -> impl Iterator<Item = &Statistical<'a>> {
        self.classes.iter().map(|(_, model)| model)
    }

    /// The separation from which on no class has contacts.
    fn highest_separation(&self) -> f64 {
        self.models().map(Statistical::highest_separation).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The largest separation with at least `pressure` (Pa), where it may be reached more than once.
    fn search(&self, pressure: f64, highest: f64) -> Option<f64> {
        let at = |h: f64| self.respond(h).pressure.total();
        let grid = descent(LOWEST_SEPARATION, highest);
        grid.windows(2).find_map(|pair| last_reaching(at, pressure, pair[1], pair[0]))
    }
}

impl Model for Mixture<'_> {
    fn plane(&self) -> ReferencePlane {
        self.classes[0].1.plane()
    }

    fn respond_all(&self, separations: &[f64]) -> Vec<Response> {
        let each = parallel::map(self.classes.len(), |k| self.classes[k].1.respond_all(separations));
        let sum = |index: usize| {
            let sum_of = |of: &dyn Fn(&Response) -> f64| {
                self.classes.iter().zip(&each).map(|((share, _), all)| share * of(&all[index])).sum::<f64>()
            };
            let by_regime = |of: fn(&Response) -> ByRegime| {
                ByRegime(std::array::from_fn(|regime| sum_of(&|response| of(response).0[regime])))
            };
            Response {
                contact_density: sum_of(&|response| response.contact_density),
                area_ratio: by_regime(|response| response.area_ratio),
                pressure: by_regime(|response| response.pressure),
                stiffness: sum_of(&|response| response.stiffness),
                spots: std::array::from_fn(|spot| sum_of(&|response| response.spots[spot])),
                ..each[0][index]
            }
        };
        (0..separations.len()).map(sum).collect()
    }

    fn may_decrease(&self) -> bool {
        self.models().any(Statistical::may_decrease)
    }

    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>> {
        let highest = self.highest_separation().max(LOWEST_SEPARATION);
        if !self.may_decrease() {
            return separations_of(self.last_reaching(pressures, LOWEST_SEPARATION, highest, &[]));
        }
        let mut found = vec![None; pressures.len()];
        search_missing(&mut found, pressures, |pressure| self.search(pressure, highest));
        found
    }
}

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
