//! Runs that are divided into tiles, which any number of processes can share.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::value::{RawValue, to_raw_value};

use crate::input::InputError;
use crate::kind::{Outcome, RunContext};

/// A plan whose work is divided into tiles. The input alone fixes the tiles, so that results are the same to the bit however
/// many processes share them.
pub trait Divided {
    /// Its results.
    type Outcome: Outcome;

    /// Number of tiles.
    fn tiles(&self) -> usize;

    /// Number of passes over all tiles. A pass needs the results of all earlier ones, of every tile.
    fn passes(&self) -> usize;

    /// What pass `earlier.len()` finds in each of `tiles`, in their order.
    ///
    /// # Errors
    /// What only a run can find: a row of a list that is no asperity.
    fn pass(
        &self,
        context: &RunContext,
        tiles: Range<usize>,
        earlier: &[Vec<TileResult>],
    ) -> Result<Vec<TileResult>, InputError>;

    /// The results of a run, from those of all tiles in all passes.
    ///
    /// # Errors
    /// As [`Self::pass`].
    fn merge(&self, context: &RunContext, passes: &[Vec<TileResult>]) -> Result<Self::Outcome, InputError>;
}

/// A [`Divided`] plan of any type.
pub trait AnyDivided: Send + Sync {
    /// Number of tiles.
    fn tiles(&self) -> usize;

    /// Number of passes over all tiles.
    fn passes(&self) -> usize;

    /// See [`Divided::pass`].
    ///
    /// # Errors
    /// What only a run can find.
    fn pass(
        &self,
        context: &RunContext,
        tiles: Range<usize>,
        earlier: &[Vec<TileResult>],
    ) -> Result<Vec<TileResult>, InputError>;

    /// See [`Divided::merge`].
    ///
    /// # Errors
    /// What only a run can find.
    fn merge(&self, context: &RunContext, passes: &[Vec<TileResult>])
    -> Result<Box<dyn Outcome>, InputError>;
}

impl<D: Divided + Send + Sync> AnyDivided for D {
    fn tiles(&self) -> usize {
        Divided::tiles(self)
    }

    fn passes(&self) -> usize {
        Divided::passes(self)
    }

    fn pass(
        &self,
        context: &RunContext,
        tiles: Range<usize>,
        earlier: &[Vec<TileResult>],
    ) -> Result<Vec<TileResult>, InputError> {
        Divided::pass(self, context, tiles, earlier)
    }

    fn merge(
        &self,
        context: &RunContext,
        passes: &[Vec<TileResult>],
    ) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(Divided::merge(self, context, passes)?))
    }
}

/// Runs all tiles in this process.
///
/// # Errors
/// As [`Divided::pass`] and [`Divided::merge`].
pub fn run_undivided<D: Divided>(divided: &D, context: &RunContext) -> Result<D::Outcome, InputError> {
    let mut passes = Vec::new();
    for _ in 0..divided.passes() {
        passes.push(divided.pass(context, 0..divided.tiles(), &passes)?);
    }
    divided.merge(context, &passes)
}

/// What a pass finds in a tile. Numbers keep every bit.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(transparent)]
pub struct TileResult(Box<RawValue>);

impl TileResult {
    /// Stores a value.
    ///
    /// # Errors
    /// A value that JSON cannot hold.
    pub fn from_value(value: &impl Serialize) -> serde_json::Result<Self> {
        to_raw_value(value).map(Self)
    }

    /// The value stored.
    ///
    /// # Errors
    /// A value of another type.
    pub fn value<T: DeserializeOwned>(&self) -> serde_json::Result<T> {
        serde_json::from_str(self.0.get())
    }
}

/// One of a number of parts that the tiles of a run are divided into: "3/16".
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Part {
    /// From 1.
    pub index: usize,
    /// Number of parts.
    pub of: usize,
}

impl Part {
    /// Its share of `tiles` tiles: neighbours, within one as many as every other part has.
    pub fn tiles(self, tiles: usize) -> Range<usize> {
        // In 128 bits, so that no product overflows.
        let end = |index: usize| (index as u128 * tiles as u128 / self.of as u128) as usize;
        end(self.index - 1)..end(self.index)
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(index, of)| index.parse().ok().zip(of.parse().ok()));
        match numbers {
            Some((index, of)) if 1 <= index && index <= of => Ok(Self { index, of }),
            _ => Err(format!("found {text}; allowed: a part and the number of parts, such as 3/16")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_share_all_tiles_evenly() {
        for (tiles, of) in [(64, 16), (64, 3), (5, 5), (7, 1), (usize::MAX, 3)] {
            let parts: Vec<_> = (1..=of).map(|index| Part { index, of }.tiles(tiles)).collect();
            assert_eq!((parts[0].start, parts[of - 1].end), (0, tiles));
            assert!(parts.windows(2).all(|pair| pair[0].end == pair[1].start));
            let lengths: Vec<usize> = parts.iter().map(Range::len).collect();
            assert!(lengths.iter().max().unwrap() - lengths.iter().min().unwrap() <= 1);
        }
    }

    #[test]
    fn a_part_is_one_of_a_number() {
        assert_eq!("3/16".parse(), Ok(Part { index: 3, of: 16 }));
        for text in ["0/3", "4/3", "3", "a/b", "1/0", "-1/2"] {
            assert!(text.parse::<Part>().unwrap_err().contains(text));
        }
    }

    #[test]
    fn results_keep_every_bit() {
        for value in [0.1 + 0.2, -0.0, f64::MIN_POSITIVE / 3.0, f64::MAX, 1.0 / 3.0] {
            let kept: f64 = TileResult::from_value(&value).unwrap().value().unwrap();
            assert_eq!(kept.to_bits(), value.to_bits());
        }
    }
}
