//! A contact that says how often it was asked.

use super::{LoadBounds, MicroContact, Shapes};
use crate::asperity::Asperities;
use crate::contact::Contact;
use crate::law::Shape;
use crate::literature::Paper;
use crate::numeric::interval::Interval;
use crate::tally::Tally;
use crate::work::{Counter, Item};

/// A contact whose answers are counted, those to a block of asperities or nodes at once.
pub struct Counted<'a> {
    contact: &'a dyn MicroContact,
    is_layered: bool,
    counter: &'a Counter,
}

impl<'a> Counted<'a> {
    /// Counts the answers of `contact` in `counter`.
    pub fn new(contact: &'a dyn MicroContact, counter: &'a Counter) -> Self {
        Self { contact, is_layered: contact.is_layered(), counter }
    }

    fn count(&self, item: Item, count: usize) {
        self.counter.add(item, count);
        if self.is_layered {
            self.counter.add(Item::CoatingCalls, count);
        }
    }
}

impl MicroContact for Counted<'_> {
    fn contact(&self, w: f64, shape: Shape) -> Contact {
        self.count(Item::SingleContacts, 1);
        self.contact.contact(w, shape)
    }

    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds {
        self.count(Item::SingleContacts, 1);
        self.contact.load_over(from, to, shape)
    }

    fn weigh(&self, indentations: &[f64], weights: &[f64], shape: Shape, tally: &mut Tally) {
        self.count(Item::Nodes, indentations.len());
        self.contact.weigh(indentations, weights, shape, tally);
    }

    fn press(&self, asperities: Asperities<'_>, separation: f64, tally: &mut Tally) {
        self.count(Item::Asperities, asperities.count());
        self.contact.press(asperities, separation, tally);
    }

    fn is_layered(&self) -> bool {
        self.is_layered
    }

    fn regime_changes(&self, shape: Shape) -> Vec<f64> {
        self.contact.regime_changes(shape)
    }

    fn breakpoints(&self, shape: Shape) -> Vec<f64> {
        self.contact.breakpoints(shape)
    }

    fn may_fall(&self, shapes: Shapes) -> Vec<Interval> {
        self.contact.may_fall(shapes)
    }

    fn reference_modulus(&self) -> f64 {
        self.contact.reference_modulus()
    }

    fn reference_hardness(&self) -> f64 {
        self.contact.reference_hardness()
    }

    fn papers(&self) -> Vec<Paper> {
        self.contact.papers()
    }

    fn doubt(&self) -> Option<String> {
        self.contact.doubt()
    }
}
