//! The deterministic model: a sum over the real asperities (Pasaribu and Schipper 2005, Eqs. 1, 13).

use std::sync::OnceLock;

use super::load_control::LOWEST_SEPARATION;
use super::{Datum, Model, Response, SamplingError};
use crate::asperity::Ordered;
use crate::contact::Tally;
use crate::interface::{LoadBounds, MicroContact, Shapes};
use crate::numeric::Sum;
use crate::numeric::interval::Interval;
use crate::numeric::root::{last_reaching, last_reaching_bounded};
use crate::numeric::sum::in_chunks;

/// The micro-contact summed over the asperities that stand above the flat.
#[derive(Debug, Clone)]
pub struct Deterministic<'a, C: ?Sized> {
    contact: &'a C,
    asperities: &'a Ordered,
    datum: Datum,
    /// Found when a load is first asked for.
    falls: OnceLock<Falls>,
}

/// Where the loads of asperities may fall.
#[derive(Debug, Clone)]
struct Falls {
    /// Of each class of radii, ranges of indentation, m; empty where no load ever falls.
    within: Vec<Vec<Interval>>,
    /// The class of each asperity.
    class: Vec<u8>,
    /// No load falls at this separation or a larger one, m.
    from: f64,
}

impl Falls {
    fn of<C: MicroContact + ?Sized>(contact: &C, asperities: &Ordered) -> Self {
        /// Classes of radii at the most, so that one sharp asperity does not speak for all.
        const CLASSES: u8 = 32;
        let (radii, spheres) = (asperities.radii(), asperities.spheres());
        if contact.may_fall(Shapes { radii, spheres }).is_empty() {
            return Self { within: Vec::new(), class: Vec::new(), from: f64::NEG_INFINITY };
        }
        let octaves = (radii.high / radii.low).log2();
        let classes = if octaves > 0.0 { CLASSES } else { 1 };
        let step = octaves / f64::from(classes);
        let end = |k: u8| radii.low * (step * f64::from(k)).exp2();
        // Ends are rounded: classes overlap a little.
        let shapes = |k: u8| Shapes {
            radii: Interval { low: end(k) * (1.0 - 1e-9), high: end(k + 1) * (1.0 + 1e-9) },
            spheres,
        };
        let within: Vec<Vec<Interval>> = (0..classes).map(|k| contact.may_fall(shapes(k))).collect();
        let all = asperities.above(f64::NEG_INFINITY);
        let place = |&b: &f64| (((b / radii.low).log2() / step) as u8).min(classes - 1);
        let class: Vec<u8> =
            if classes == 1 { vec![0; all.count()] } else { all.radii().iter().map(place).collect() };
        let first = |&k: &u8| within[usize::from(k)].first().map_or(f64::INFINITY, |range| range.low);
        let firsts = all.heights().iter().zip(&class).map(|(z, k)| z - first(k));
        Self { from: firsts.fold(f64::NEG_INFINITY, f64::max), within, class }
    }

    /// Whether the load of asperity `index` rises all over `indentations`.
    fn spare(&self, index: usize, indentations: Interval) -> bool {
        let within = &self.within[usize::from(self.class[index])];
        !within.iter().any(|range| range.meets(indentations))
    }
}

impl<'a, C: MicroContact + ?Sized> Deterministic<'a, C> {
    /// The model of a set, with separations measured as `datum` says.
    pub fn new(contact: &'a C, asperities: &'a Ordered, datum: Datum) -> Self {
        Self { contact, asperities, datum, falls: OnceLock::new() }
    }

    /// What the asperities above `separation` (m, in the frame of the set's heights) add up to.
    pub fn tally(&self, separation: f64) -> Tally {
        let touching = self.asperities.above(separation);
        in_chunks(
            touching.count(),
            |chunk| {
                let mut tally = Tally::default();
                self.contact.press(touching.part(chunk), separation, &mut tally);
                tally
            },
            Tally::merge,
        )
    }

    /// A separation in the frame of the heights, m.
    fn absolute(&self, h: f64) -> f64 {
        self.datum.mean + h * self.datum.sigma
    }

    fn pressure(&self, h: f64) -> f64 {
        self.respond(h).pressure.total()
    }

    /// The highest pressure that any separation from `low` to `high` could carry, were each asperity at its own
    /// worst, and bounds of the sum of all dP/dd (N/m) over them.
    fn pressure_over(&self, low: f64, high: f64, falls: &Falls) -> (f64, Interval) {
        let (near, far) = (self.absolute(low), self.absolute(high));
        let touching = self.asperities.above(near);
        let (load, slopes) = in_chunks(
            touching.count(),
            |chunk| {
                let (mut load, mut slopes) = (Sum::default(), Interval::point(0.0));
                for i in chunk {
                    let (z, shape) = (touching.heights()[i], touching.shape(i));
                    let indentations = Interval { low: (z - far).max(0.0), high: z - near };
                    // Where the load rises it is highest at the end, and no slope is below zero.
                    let bounds = if falls.spare(i, indentations) {
                        LoadBounds {
                            highest: self.contact.contact(z - near, shape).load,
                            slopes: Interval { low: 0.0, high: f64::INFINITY },
                        }
                    } else {
                        self.contact.load_over(indentations.low, indentations.high, shape)
                    };
                    load.add(bounds.highest);
                    slopes = slopes + bounds.slopes;
                }
                (load, slopes)
            },
            |(load, slopes), part| {
                load.merge(&part.0);
                *slopes = *slopes + part.1;
            },
        );
        (load.value() / self.asperities.nominal_area(), -slopes)
    }
}

impl<C: MicroContact + ?Sized> Model for Deterministic<'_, C> {
    fn datum(&self) -> Datum {
        self.datum
    }

    fn respond(&self, h: f64) -> Response {
        let tally = self.tally(self.absolute(h));
        let count = self.asperities.count();
        let sampling = SamplingError {
            pressure: tally.load_error(count) / self.asperities.nominal_area(),
            area_ratio: tally.area_error(count) / self.asperities.nominal_area(),
        };
        let response = Response::new(h, self.datum, &tally, self.asperities.nominal_area().recip());
        Response { sampling: Some(sampling), ..response }
    }

    fn separation_at(&self, pressure: f64) -> Option<f64> {
        let in_sigma = |separation: f64| (separation - self.datum.mean) / self.datum.sigma;
        let highest = in_sigma(self.asperities.highest()).max(LOWEST_SEPARATION);
        let falls = self.falls.get_or_init(|| Falls::of(self.contact, self.asperities));
        let falling_from = in_sigma(falls.from).clamp(LOWEST_SEPARATION, highest);
        let value = |h: f64| self.pressure(h);
        last_reaching(value, pressure, falling_from, highest).or_else(|| {
            if falls.within.is_empty() {
                return None;
            }
            let bound = |low, high| self.pressure_over(low, high, falls);
            last_reaching_bounded(&value, &bound, pressure, LOWEST_SEPARATION, falling_from)
        })
    }
}
