//! The deterministic model: a sum over the individual asperities (Pasaribu and Schipper 2005, Eqs. 1, 13).

use std::sync::OnceLock;

use super::block::{Block, Levels};
use super::load_control::{LOWEST_SEPARATION, search_missing};
use super::{Medium, Model, ReferencePlane, Response, responses_at, separations_of};
use crate::accumulator::{Accumulator, Total};
use crate::asperity::{Asperities, Ordered};
use crate::interface::{LoadBounds, MicroContact, Shapes};
use crate::numeric::Sum;
use crate::numeric::interval::Interval;
use crate::numeric::parallel::{self, once};
use crate::numeric::root::last_reaching_bounded;
use crate::numeric::sum::in_chunks;

/// The sum of the micro-contact over the asperities above the flat.
///
/// A curve is summed block by block: each block is sorted, within the cache, by the separation at which its asperities
/// are touched, so that only asperities in contact are visited.
#[derive(Clone)]
pub struct Deterministic<'a> {
    contact: &'a dyn MicroContact,
    asperities: Asperities<'a>,
    plane: ReferencePlane,
    medium: Option<Medium>,
    /// Where searches for pressures begin, d/sigma.
    near: Vec<f64>,
    /// Determined when a load is first prescribed.
    decreasing: OnceLock<Option<DecreasingLoads>>,
}

/// Where the loads of asperities may decrease.
#[derive(Debug, Clone)]
struct DecreasingLoads {
    ordered: Ordered,
    /// The ranges of indentation (m) for each class of radii.
    within: Vec<Vec<Interval>>,
    /// The class of each asperity.
    class: Vec<u8>,
    /// No load decreases at this separation or a larger one, m.
    from: f64,
}

impl DecreasingLoads {
    /// `None` where no load ever decreases.
    fn new(contact: &dyn MicroContact, asperities: Asperities) -> Option<Self> {
        /// The largest number of classes of radii, so that one sharp asperity does not affect all others.
        const CLASSES: u8 = 32;
        let (radii, spheres) = (asperities.radius_range(), asperities.sphere_range());
        if contact.may_decrease(Shapes { radii, spheres }).is_empty() {
            return None;
        }
        let octaves = (radii.high / radii.low).log2();
        let classes = if octaves > 0.0 { CLASSES } else { 1 };
        let step = octaves / f64::from(classes);
        let end = |k: u8| radii.low * (step * f64::from(k)).exp2();
        // Ends are rounded, so that classes overlap slightly.
        let shapes = |k: u8| Shapes {
            radii: Interval { low: end(k) * (1.0 - 1e-9), high: end(k + 1) * (1.0 + 1e-9) },
            spheres,
        };
        let within: Vec<Vec<Interval>> = (0..classes).map(|k| contact.may_decrease(shapes(k))).collect();
        let ordered = Ordered::new(asperities);
        let all = ordered.above(f64::NEG_INFINITY);
        let place = |&b: &f64| (((b / radii.low).log2() / step) as u8).min(classes - 1);
        let class: Vec<u8> =
            if classes == 1 { vec![0; all.count()] } else { all.radii().iter().map(place).collect() };
        let first = |&k: &u8| within[usize::from(k)].first().map_or(f64::INFINITY, |range| range.low);
        let from =
            all.heights().iter().zip(&class).map(|(z, k)| z - first(k)).fold(f64::NEG_INFINITY, f64::max);
        Some(Self { ordered, within, class, from })
    }

    /// Whether the load of asperity `index` increases throughout `indentations`.
    fn is_monotonic(&self, index: usize, indentations: Interval) -> bool {
        let within = &self.within[usize::from(self.class[index])];
        !within.iter().any(|range| range.overlaps(indentations))
    }
}

/// The largest number of blocks per task.
const BLOCKS_PER_TASK: usize = 16;

/// Number of tasks of a sum of few blocks. Fixed, so that results do not depend on the number of threads.
const TASKS: usize = 32;

impl<'a> Deterministic<'a> {
    /// The model of `asperities`, with separations measured from and in units of `plane`.
    pub fn new(contact: &'a dyn MicroContact, asperities: Asperities<'a>, plane: ReferencePlane) -> Self {
        Self { contact, asperities, plane, medium: None, near: Vec::new(), decreasing: OnceLock::new() }
    }

    /// The same model with a medium in the gap.
    #[must_use]
    pub fn with_medium(self, medium: Option<Medium>) -> Self {
        Self { medium, ..self }
    }

    /// The same model, whose searches for pressures begin at these separations d/sigma. They find the same, faster where it is near.
    #[must_use]
    pub fn searched_near(self, separations: &[f64]) -> Self {
        Self { near: separations.to_vec(), ..self }
    }

    /// The medium in the gap.
    pub fn medium(&self) -> Option<Medium> {
        self.medium
    }

    /// The sums over the asperities above `separation` (m, in the frame of the set's heights).
    pub fn total(&self, separation: f64) -> Total {
        self.totals(&[separation])[0]
    }

    /// The sums at each of many separations (m, in the frame of the set's heights).
    pub fn totals(&self, separations: &[f64]) -> Vec<Total> {
        self.totals_with(separations, self.contact.spot_properties().is_some())
    }

    fn totals_with(&self, separations: &[f64], wants_spots: bool) -> Vec<Total> {
        let mut order: Vec<usize> = (0..separations.len()).collect();
        order.sort_by(|&a, &b| separations[b].total_cmp(&separations[a]));
        let mut totals = vec![Total::empty(wants_spots); separations.len()];
        for some in order.chunks(Levels::MOST) {
            let descending: Vec<f64> = some.iter().map(|&k| separations[k]).collect();
            let levels = Levels::new(&descending);
            for (&k, total) in some.iter().zip(self.descend(&levels, wants_spots)) {
                totals[k] = total;
            }
        }
        totals
    }

    /// The sums at descending separations.
    fn descend(&self, levels: &Levels, wants_spots: bool) -> Vec<Total> {
        let count = self.asperities.count();
        let blocks = count.div_ceil(Block::MOST);
        let per_task = Block::MOST * blocks.div_ceil(TASKS).clamp(1, BLOCKS_PER_TASK);
        let part = |task: usize| -> Vec<Total> {
            let mut block = Block::default();
            let mut accumulators = vec![Accumulator::empty(wants_spots); levels.separations().len()];
            let end = count.min((task + 1) * per_task);
            for start in (task * per_task..end).step_by(Block::MOST) {
                let asperities = self.asperities.part(start..end.min(start + Block::MOST));
                block.fill(asperities, levels);
                let each = levels.separations().iter().zip(&mut accumulators);
                for (level, (&separation, accumulator)) in each.enumerate() {
                    let touching = block.above(level, &asperities);
                    if touching.count() > 0 {
                        self.contact.accumulate(touching, separation, accumulator);
                    }
                }
            }
            accumulators.iter().map(Accumulator::total).collect()
        };
        let parts = parallel::map(count.div_ceil(per_task), part);
        let mut totals = vec![Total::empty(wants_spots); levels.separations().len()];
        for part in &parts {
            totals.iter_mut().zip(part).for_each(|(total, part)| total.merge(part));
        }
        totals
    }

    fn decreasing_loads(&self) -> Option<&DecreasingLoads> {
        once(&self.decreasing, || DecreasingLoads::new(self.contact, self.asperities)).as_ref()
    }

    /// A separation in the frame of the heights, m.
    fn absolute(&self, h: f64) -> f64 {
        self.plane.mean + h * self.plane.sigma
    }

    /// The inverse of [`Self::absolute`].
    fn in_sigma(&self, separation: f64) -> f64 {
        (separation - self.plane.mean) / self.plane.sigma
    }

    /// The separation d/sigma of the highest asperity, within the range that is searched.
    fn highest_separation(&self) -> f64 {
        self.in_sigma(self.asperities.highest()).max(LOWEST_SEPARATION)
    }

    fn pressure(&self, h: f64) -> f64 {
        self.respond_without_spots(&[h])[0].pressure.total()
    }

    fn responses(&self, separations: &[f64], wants_spots: bool) -> Vec<Response> {
        let absolute: Vec<f64> = separations.iter().map(|&h| self.absolute(h)).collect();
        let totals = self.totals_with(&absolute, wants_spots);
        let medium = self.medium.filter(|_| wants_spots);
        let response = |(&h, total): (&f64, &Total)| {
            let mut response = self.response(h, total);
            medium.into_iter().for_each(|medium| medium.add_to(&mut response));
            response
        };
        separations.iter().zip(&totals).map(response).collect()
    }

    fn response(&self, h: f64, total: &Total) -> Response {
        Response::of_sum(h, self.plane, total, self.asperities.count(), self.asperities.nominal_area())
    }

    /// An upper bound of the pressure (Pa) at separations from `low` to `high`, from the highest load of each asperity,
    /// and bounds of the sum of dP/dd (N/m).
    fn pressure_over(&self, low: f64, high: f64, decreasing: &DecreasingLoads) -> (f64, Interval) {
        let (near, far) = (self.absolute(low), self.absolute(high));
        let touching = decreasing.ordered.above(near);
        let (load, slopes) = in_chunks(
            touching.count(),
            |chunk| {
                let (mut load, mut slopes) = (Sum::default(), Interval::point(0.0));
                for i in chunk {
                    let (z, shape) = (touching.heights()[i], touching.shape(i));
                    let indentations = Interval { low: (z - far).max(0.0), high: z - near };
                    // An increasing load is highest at the end and has no negative slope.
                    let bounds = if decreasing.is_monotonic(i, indentations) {
                        LoadBounds {
                            highest: self.contact.contact(z - near, shape).load,
                            slopes: Interval { low: 0.0, high: f64::INFINITY },
                        }
                    } else {
                        self.contact.load_over(indentations.low, indentations.high, shape)
                    };
                    load += bounds.highest;
                    slopes = slopes + bounds.slopes;
                }
                (load, slopes)
            },
            |(load, slopes), part| {
                *load += part.0;
                *slopes = *slopes + part.1;
            },
        );
        (load.value() / self.asperities.nominal_area(), -slopes)
    }
}

impl Model for Deterministic<'_> {
    fn plane(&self) -> ReferencePlane {
        self.plane
    }

    fn respond_all(&self, separations: &[f64]) -> Vec<Response> {
        self.responses(separations, self.contact.spot_properties().is_some())
    }

    fn respond_without_spots(&self, separations: &[f64]) -> Vec<Response> {
        self.responses(separations, false)
    }

    fn may_decrease(&self) -> bool {
        self.decreasing_loads().is_some()
    }

    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>> {
        let decreasing = self.decreasing_loads();
        let highest = self.highest_separation();
        let falling_from = decreasing.map_or(LOWEST_SEPARATION, |decreasing| self.in_sigma(decreasing.from));
        let falling_from = falling_from.clamp(LOWEST_SEPARATION, highest);
        let mut found = separations_of(self.last_reaching(pressures, falling_from, highest, &self.near));
        if let Some(decreasing) = decreasing {
            let value = |h: f64| self.pressure(h);
            let bound = |low, high| self.pressure_over(low, high, decreasing);
            search_missing(&mut found, pressures, |pressure| {
                last_reaching_bounded(&value, &bound, pressure, LOWEST_SEPARATION, falling_from)
            });
        }
        found
    }

    /// Those that the search has evaluated, where no load decreases and no spots are asked for.
    fn responses_at(&self, pressures: &[f64]) -> Vec<Option<Response>> {
        if self.contact.spot_properties().is_some() || self.decreasing_loads().is_some() {
            return responses_at(self, pressures);
        }
        self.last_reaching(pressures, LOWEST_SEPARATION, self.highest_separation(), &self.near)
    }
}
