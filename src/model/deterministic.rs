//! The deterministic model: a sum over the real asperities (Pasaribu and Schipper 2005, Eqs. 1, 13).

use super::load_control::LOWEST_SEPARATION;
use super::{Datum, Model, Response, SamplingError};
use crate::asperity::Ordered;
use crate::contact::Tally;
use crate::interface::MicroContact;
use crate::numeric::Sum;
use crate::numeric::interval::Interval;
use crate::numeric::root::{last_reaching, last_reaching_bounded};
use crate::numeric::sum::in_chunks;

/// The micro-contact summed over the asperities that stand above the flat.
#[derive(Debug, Clone, Copy)]
pub struct Deterministic<'a, C: ?Sized> {
    contact: &'a C,
    asperities: &'a Ordered,
    datum: Datum,
}

impl<'a, C: MicroContact + ?Sized> Deterministic<'a, C> {
    /// The model of a set, with separations measured as `datum` says.
    pub fn new(contact: &'a C, asperities: &'a Ordered, datum: Datum) -> Self {
        Self { contact, asperities, datum }
    }

    /// What the asperities above `separation` (m, in the frame of the set's heights) add up to.
    pub fn tally(&self, separation: f64) -> Tally {
        let (heights, radii) = self.asperities.above(separation);
        in_chunks(
            heights.len(),
            |chunk| {
                let mut tally = Tally::default();
                self.contact.press(&heights[chunk.clone()], &radii[chunk], separation, &mut tally);
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
    /// worst, and all slopes of the pressure, given that no load falls up to the indentation `rising` (m).
    fn pressure_over(&self, low: f64, high: f64, rising: f64) -> (f64, Interval) {
        let (near, far) = (self.absolute(low), self.absolute(high));
        let (heights, radii) = self.asperities.above(near);
        let deep = heights.partition_point(|&z| z - near > rising);
        if deep == 0 {
            return (self.pressure(low), Interval { low: f64::NEG_INFINITY, high: 0.0 });
        }
        let (load, slopes) = in_chunks(
            heights.len(),
            |chunk| {
                let (mut load, mut slopes) = (Sum::default(), Interval::point(0.0));
                for (&z, &b) in heights[chunk.clone()].iter().zip(&radii[chunk]) {
                    let bounds = self.contact.load_over((z - far).max(0.0), z - near, b);
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
        // As long as no asperity is pressed deeper than that, no load falls.
        let rising = self.contact.load_rises_to();
        let falling_from = in_sigma(self.asperities.highest() - rising).clamp(LOWEST_SEPARATION, highest);
        let value = |h: f64| self.pressure(h);
        last_reaching(value, pressure, falling_from, highest).or_else(|| {
            let bound = |low, high| self.pressure_over(low, high, rising);
            last_reaching_bounded(&value, &bound, pressure, LOWEST_SEPARATION, falling_from)
        })
    }
}
