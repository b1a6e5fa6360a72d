//! Sweeps: `{ from, to, points }` or `{ values = [...] }`.

use serde::Deserialize;

use crate::input::quantity::{Dimension, Positive, Pure, Quantity, Range, SeparationRange};

/// The most points that one sweep may have.
const MOST_POINTS: usize = 100_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "Quantity<D, R>: Deserialize<'de>"))]
struct Keys<D, R> {
    from: Option<Quantity<D, R>>,
    to: Option<Quantity<D, R>>,
    points: Option<usize>,
    values: Option<Vec<Quantity<D, R>>>,
}

impl<D: Dimension, R: Range> Keys<D, R> {
    /// The values, spaced by `between(from, to, fraction)`.
    fn values(self, between: fn(f64, f64, f64) -> f64) -> Result<Vec<f64>, String> {
        const ALLOWED: &str = "allowed: { from, to, points } or { values = [...] }";
        match (self.from, self.to, self.points, self.values) {
            (None, None, None, Some(values)) => match values.len() {
                0 => Err("found an empty list; allowed: at least one value".to_owned()),
                count if count > MOST_POINTS => {
                    Err(format!("found {count} values; allowed: at most {MOST_POINTS}"))
                }
                _ => Ok(values.iter().map(Quantity::value).collect()),
            },
            (Some(from), Some(to), Some(points), None) => {
                if !(2..=MOST_POINTS).contains(&points) {
                    return Err(format!("found points = {points}; allowed: 2 to {MOST_POINTS}"));
                }
                let (from, to) = (from.value(), to.value());
                let value = |k: usize| match k {
                    0 => from,
                    k if k == points - 1 => to,
                    k => between(from, to, k as f64 / (points - 1) as f64),
                };
                Ok((0..points).map(value).collect())
            }
            (None, None, None, None) => Err(format!("found nothing; {ALLOWED}")),
            (.., Some(_)) => Err(format!("found `values` together with `from`, `to` or `points`; {ALLOWED}")),
            _ => Err(format!("found only some of `from`, `to` and `points`; {ALLOWED}")),
        }
    }
}

/// Evenly spaced separations, in sigma.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Keys<Pure, SeparationRange>")]
pub struct LinearSweep(pub Vec<f64>);

impl TryFrom<Keys<Pure, SeparationRange>> for LinearSweep {
    type Error = String;

    fn try_from(keys: Keys<Pure, SeparationRange>) -> Result<Self, String> {
        keys.values(|from, to, fraction| from + (to - from) * fraction).map(Self)
    }
}

/// Logarithmically spaced positive quantities, SI.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Keys<D, Positive>", bound(deserialize = "D: Dimension"))]
pub struct LogSweep<D> {
    /// The values, SI.
    pub values: Vec<f64>,
    #[serde(skip)]
    kind: std::marker::PhantomData<D>,
}

impl<D: Dimension> TryFrom<Keys<D, Positive>> for LogSweep<D> {
    type Error = String;

    fn try_from(keys: Keys<D, Positive>) -> Result<Self, String> {
        let values = keys.values(|from, to, fraction| from * (to / from).powf(fraction))?;
        Ok(Self { values, kind: std::marker::PhantomData })
    }
}
