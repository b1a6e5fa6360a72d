//! Where a deeper asperity carries less, or touches on less.

use super::MicroContact;
use crate::contact::Contact;

/// A range of indentations over which area or load falls as the indentation grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// Where it first begins to fall, m.
    pub from: f64,
    /// Where it has last fallen, m.
    pub to: f64,
    /// The most of it that is lost on the way: 1 - lowest/highest before.
    pub loss: f64,
}

/// Where area and load of an asperity of one radius fall as it is pressed deeper.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Falls {
    /// Of the area.
    pub area: Option<Fall>,
    /// Of the load.
    pub load: Option<Fall>,
}

impl Falls {
    /// Looks at an asperity of radius `b` (m) down to the indentation `deepest` (m), at places that are close beside
    /// the scale on which `contact` changes.
    pub fn of(contact: &dyn MicroContact, b: f64, deepest: f64) -> Self {
        /// Places between two breakpoints, and across each decade before the first.
        const PLACES: i32 = 64;
        const DECADES: i32 = 3;
        let mut ends: Vec<f64> =
            contact.breakpoints(b).into_iter().filter(|&w| w > 0.0 && w < deepest).collect();
        ends.push(deepest);
        let first = ends[0] * 0.1f64.powi(DECADES);
        ends.insert(0, first);
        let mut places: Vec<f64> = ends
            .windows(2)
            .flat_map(|end| {
                let step = (end[1] / end[0]).powf(f64::from(PLACES).recip());
                (0..PLACES).map(move |k| end[0] * step.powi(k))
            })
            .collect();
        places.push(deepest);
        let answers: Vec<(f64, Contact)> = places.into_iter().map(|w| (w, contact.contact(w, b))).collect();
        let fall = |value: fn(&Contact) -> f64| fall(answers.iter().map(|(w, contact)| (*w, value(contact))));
        Self { area: fall(|contact| contact.area), load: fall(|contact| contact.load) }
    }
}

/// What a curve of (indentation, value) loses against its highest value so far.
fn fall(curve: impl Iterator<Item = (f64, f64)>) -> Option<Fall> {
    /// Wider than rounding.
    const LEAST: f64 = 1e-9;
    let (mut highest, mut at, mut before) = (0.0, 0.0, 0.0);
    let mut found: Option<Fall> = None;
    for (w, value) in curve {
        if value < before * (1.0 - LEAST) {
            let loss = 1.0 - value / highest;
            found = Some(match found {
                None => Fall { from: at, to: w, loss },
                Some(earlier) => Fall { to: w, loss: earlier.loss.max(loss), ..earlier },
            });
        }
        if value > highest {
            (highest, at) = (value, w);
        }
        before = value;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_the_first_peak_to_the_last_low() {
        let curve = [(1.0, 1.0), (2.0, 4.0), (3.0, 3.0), (4.0, 3.5), (5.0, 5.0), (6.0, 2.0), (7.0, 6.0)];
        assert_eq!(fall(curve.into_iter()), Some(Fall { from: 2.0, to: 6.0, loss: 0.6 }));
        assert_eq!(fall(curve[..2].iter().copied()), None);
    }
}
