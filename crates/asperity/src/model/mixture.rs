//! A statistical model of several classes of asperities: the weighted sum of their integrals.

use super::load_control::separations_by_descent;
use super::{Model, ReferencePlane, Response, Statistical};
use crate::contact::ByRegime;
use crate::numeric::parallel;

/// Classes of asperities, each with its share of all, which report separations from one plane.
pub(crate) struct Mixture<'a> {
    classes: Vec<(f64, Statistical<'a>)>,
    may_decrease: bool,
}

impl<'a> Mixture<'a> {
    /// At least one class, whose load together may decrease on approach.
    pub(crate) fn new(classes: Vec<(f64, Statistical<'a>)>, may_decrease: bool) -> Self {
        Self { classes, may_decrease }
    }

    /// The separation from which on no class has contacts.
    fn highest_separation(&self) -> f64 {
        self.classes.iter().map(|(_, model)| model.highest_separation()).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The sum of the responses of all classes, by their shares.
    fn summed(&self, responses: impl Fn(&Statistical) -> Vec<Response> + Sync) -> Vec<Response> {
        let each = parallel::map(self.classes.len(), |k| responses(&self.classes[k].1));
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
        (0..each[0].len()).map(sum).collect()
    }
}

impl Model for Mixture<'_> {
    fn plane(&self) -> ReferencePlane {
        self.classes[0].1.plane()
    }

    fn respond_all(&self, separations: &[f64]) -> Vec<Response> {
        self.summed(|model| model.respond_all(separations))
    }

    fn respond_without_spots(&self, separations: &[f64]) -> Vec<Response> {
        self.summed(|model| model.respond_without_spots(separations))
    }

    fn may_decrease(&self) -> bool {
        self.may_decrease
    }

    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>> {
        separations_by_descent(self, pressures, self.highest_separation())
    }
}
