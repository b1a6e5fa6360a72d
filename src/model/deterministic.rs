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
    rises: OnceLock<Rises>,
}

/// How deep asperities may be pressed before their load may fall.
#[derive(Debug, Clone)]
struct Rises {
    /// Of each asperity, m; empty where no load ever falls.
    to: Vec<f64>,
    /// No asperity is pressed deeper than that at this separation or a larger one, m.
    from: f64,
}

impl Rises {
    fn of<C: MicroContact + ?Sized>(contact: &C, asperities: &Ordered) -> Self {
        /// Classes of radii, so that one sharp asperity does not speak for all.
        const CLASSES: usize = 32;
        let (radii, spheres) = (asperities.radii(), asperities.spheres());
        if contact.load_rises_to(Shapes { radii, spheres }) == f64::INFINITY {
            return Self { to: Vec::new(), from: f64::NEG_INFINITY };
        }
        let step = (radii.high / radii.low).ln() / CLASSES as f64;
        let end = |k: usize| radii.low * (step * k as f64).exp();
        // Ends are rounded: classes overlap a little.
        let class = |k: usize| Shapes {
            radii: Interval { low: end(k) * (1.0 - 1e-9), high: end(k + 1) * (1.0 + 1e-9) },
            spheres,
        };
        let known: Vec<f64> = (0..CLASSES).map(|k| contact.load_rises_to(class(k))).collect();
        let all = asperities.above(f64::NEG_INFINITY);
        let place = |b: f64| ((b / radii.low).ln() / step) as usize;
        let to: Vec<f64> = all.radii().iter().map(|&b| known[place(b).min(CLASSES - 1)]).collect();
        let from = all.heights().iter().zip(&to).map(|(z, to)| z - to).fold(f64::NEG_INFINITY, f64::max);
        Self { to, from }
    }
}

impl<'a, C: MicroContact + ?Sized> Deterministic<'a, C> {
    /// The model of a set, with separations measured as `datum` says.
    pub fn new(contact: &'a C, asperities: &'a Ordered, datum: Datum) -> Self {
        Self { contact, asperities, datum, rises: OnceLock::new() }
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
    fn pressure_over(&self, low: f64, high: f64, rises: &Rises) -> (f64, Interval) {
        let (near, far) = (self.absolute(low), self.absolute(high));
        let touching = self.asperities.above(near);
        let (load, slopes) = in_chunks(
            touching.count(),
            |chunk| {
                let (mut load, mut slopes) = (Sum::default(), Interval::point(0.0));
                for i in chunk {
                    let (z, shape) = (touching.heights()[i], touching.shape(i));
                    // Where the load rises it is highest at the end, and no slope is below zero.
                    let bounds = if z - near <= rises.to[i] {
                        LoadBounds {
                            highest: self.contact.contact(z - near, shape).load,
                            slopes: Interval { low: 0.0, high: f64::INFINITY },
                        }
                    } else {
                        self.contact.load_over((z - far).max(0.0), z - near, shape)
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
        let rises = self.rises.get_or_init(|| Rises::of(self.contact, self.asperities));
        let falling_from = in_sigma(rises.from).clamp(LOWEST_SEPARATION, highest);
        let value = |h: f64| self.pressure(h);
        last_reaching(value, pressure, falling_from, highest).or_else(|| {
            if rises.to.is_empty() {
                return None;
            }
            let bound = |low, high| self.pressure_over(low, high, rises);
            last_reaching_bounded(&value, &bound, pressure, LOWEST_SEPARATION, falling_from)
        })
    }
}
