//! Files of instruments: the channels that a header describes, the choice of one, and its heights.

use std::collections::HashMap;

use super::content::{ChannelName, LengthUnits, Measured, Metadata, OtherChannel, transposed};
use super::error::{ReadError, too_large};
use super::source::{OF_BYTES, Source, decode};
use crate::numeric::is_positive;
use crate::numeric::stored::NumberType;
use crate::units::Dimension;

/// A map in the file of an instrument.
pub(super) struct Channel {
    /// As the file names it.
    pub(super) name: String,
    /// Points along x and y.
    pub(super) points: [u64; 2],
    /// Distance of neighbouring points along x and y, m.
    pub(super) pixel: Option<[f64; 2]>,
    pub(super) quantity: Quantity,
    /// The units that the file states of what is in metres here.
    pub(super) stated: LengthUnits,
    /// A height is the stored number x `factor` + `offset`, m; the offset is kept apart.
    pub(super) factor: f64,
    pub(super) offset: f64,
    pub(super) order: Order,
    /// Whether a stored number marks a missing point; those that are not finite do.
    pub(super) missing: Box<dyn Fn(f64) -> bool>,
    pub(super) numbers: Numbers,
}

/// What a channel holds.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Quantity {
    /// Heights in metres, after `factor`.
    Length,
    /// The file does not say: heights in the unit that its user gives.
    Unknown,
    /// Another quantity than a length, in this unit.
    Other(String),
}

/// The order of the stored numbers. The first y is the line at the top of the picture, as the instrument shows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    /// Line after line along x, the top one first.
    Lines,
    /// Line after line along x, the bottom one first.
    LinesUpwards,
    /// Column after column, each from the bottom.
    ColumnsUpwards,
    /// The same, the column at the right first.
    ColumnsUpwardsFromRight,
}

/// The stored numbers of a channel.
pub(super) enum Numbers {
    /// They lie in the file.
    Stored(Stored),
    /// They are unpacked when they are asked for; the type is that of the packed numbers.
    Packed(NumberType, Box<Unpack>),
}

/// Units of work that the numbers of a channel are before their unit and their order.
pub(super) const UNPACKED: f64 = 0.6;

/// Unpacks the numbers of a channel: [`UNPACKED`] units of work, those of reading bytes included.
type Unpack = dyn Fn(&Source) -> Result<Vec<f64>, ReadError>;

/// Numbers in a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stored {
    /// The place of the first, bytes.
    pub(super) start: u64,
    pub(super) kind: NumberType,
    pub(super) big_endian: bool,
    /// Bytes from one line to the next where others than the numbers lie between them.
    pub(super) stride: Option<u64>,
}

impl Stored {
    /// Numbers without a gap, the least significant byte first.
    pub(super) fn new(start: u64, kind: NumberType) -> Self {
        Self { start, kind, big_endian: false, stride: None }
    }
}

impl Channel {
    /// Heights in metres, line after line from the top, all of them valid.
    pub(super) fn new(name: impl Into<String>, points: [u64; 2], numbers: Numbers) -> Self {
        Self {
            name: name.into(),
            points,
            pixel: None,
            quantity: Quantity::Length,
            stated: LengthUnits::same(1.0),
            factor: 1.0,
            offset: 0.0,
            order: Order::Lines,
            missing: Box::new(|_| false),
            numbers,
        }
    }

    /// The same with the quantity and factor of a `unit`, which multiplies the factor.
    pub(super) fn in_unit(mut self, unit: &str) -> Self {
        match length(unit) {
            Some(metres) => {
                self.factor *= metres;
                self.offset *= metres;
                self.stated.z = metres;
            }
            None if unit.trim().is_empty() => self.quantity = Quantity::Unknown,
            None => self.quantity = Quantity::Other(unit.trim().to_owned()),
        }
        self
    }

    /// The same, whose pixel the file states in a unit (m); none if that is no length.
    pub(super) fn pixel_in(mut self, unit: Option<f64>) -> Self {
        self.stated.xy = unit.unwrap_or(1.0);
        self
    }

    /// How far it is from what a user means by the heights: lower is nearer.
    fn distance(&self) -> u32 {
        let name = self.name.to_lowercase();
        let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
        let kind = match self.quantity {
            Quantity::Length => 0,
            Quantity::Unknown => 8,
            Quantity::Other(_) => 16,
        };
        let named = if has(&["error", "deflection", "amplitude", "phase", "current"]) {
            4
        } else if has(&["height", "topograph", "z-axis", "z axis"]) {
            0
        } else {
            2
        };
        kind + named + u32::from(has(&["retrace", "backward"]))
    }

    /// As the file has it, not read.
    fn listed(&self) -> OtherChannel {
        let unit = match &self.quantity {
            Quantity::Length => Some("m".to_owned()),
            Quantity::Unknown => None,
            Quantity::Other(unit) => Some(unit.clone()),
        };
        OtherChannel { name: self.name.clone(), unit }
    }

    /// Bytes of a line, and of all lines.
    fn lengths(&self, stored: &Stored) -> Option<(u64, u64, u64)> {
        let (run, runs) = self.runs();
        let line = run.checked_mul(stored.kind.bytes())?;
        let stride = stored.stride.unwrap_or(line).max(line);
        Some((line, stride, stride.checked_mul(runs.checked_sub(1)?)?.checked_add(line)?))
    }

    /// Numbers that follow each other, and how many such runs there are.
    fn runs(&self) -> (u64, u64) {
        let [nx, ny] = self.points;
        match self.order {
            Order::Lines | Order::LinesUpwards => (nx, ny),
            Order::ColumnsUpwards | Order::ColumnsUpwardsFromRight => (ny, nx),
        }
    }

    /// Checks the sizes against the file.
    fn check(&self, source: &Source) -> Result<[usize; 2], ReadError> {
        let [nx, ny] = self.points;
        if nx == 0 || ny == 0 {
            return Err(corrupt!("holds a map of {nx} x {ny} points; allowed: at least 1"));
        }
        if let Some([x, y]) = self.pixel.filter(|pixel| !pixel.iter().all(|&size| is_positive(size))) {
            return Err(corrupt!("has a pixel of {x:e} x {y:e} m; allowed: positive"));
        }
        if !(self.factor.is_finite() && self.offset.is_finite()) {
            return Err(corrupt!(
                "has heights of {:e} m x a stored number + {:e} m; allowed: finite",
                self.factor,
                self.offset
            ));
        }
        if let Numbers::Stored(stored) = &self.numbers {
            let (.., bytes) = self.lengths(stored).ok_or_else(too_large)?;
            source.check(stored.start, bytes)?;
        }
        nx.checked_mul(ny).filter(|&count| count <= 1 << 40).ok_or_else(too_large)?;
        let length = |count: u64| usize::try_from(count).map_err(|_| too_large());
        Ok([length(nx)?, length(ny)?])
    }

    /// The heights, the y index running fastest; NaN where missing.
    fn heights(&self, source: &Source) -> Result<Vec<f64>, ReadError> {
        let [nx, ny] = self.check(source)?;
        let count = nx * ny;
        let mut values = match &self.numbers {
            Numbers::Packed(_, unpacked) => unpacked(source)?,
            Numbers::Stored(stored) => {
                let (line, stride, bytes) = self.lengths(stored).ok_or_else(too_large)?;
                let bytes = source.bytes(stored.start, bytes)?;
                let mut counted = source.count(UNPACKED - OF_BYTES, count);
                let mut values = vec![0.0; count];
                // Numbers without a gap are one run.
                let runs = values.chunks_mut((line / stored.kind.bytes()) as usize);
                for (run, bytes) in runs.zip(bytes.chunks(stride as usize)) {
                    decode(stored.kind, stored.big_endian, bytes, run, &mut counted);
                }
                counted.end();
                values
            }
        };
        if values.len() != count {
            return Err(corrupt!("holds {} numbers for a map of {nx} x {ny} points", values.len()));
        }
        source.count(0.5 * (1.0 - UNPACKED), count).pieces(&mut values, |piece| {
            for value in piece {
                let is_missing = !value.is_finite() || (self.missing)(*value);
                *value = if is_missing { f64::NAN } else { *value * self.factor };
            }
            Ok::<_, ReadError>(())
        })?;
        let sorted = source.count(0.5 * (1.0 - UNPACKED), count);
        Ok(match self.order {
            Order::Lines => transposed(&values, nx, sorted),
            Order::LinesUpwards => {
                values.reverse();
                values.chunks_mut(nx).for_each(<[f64]>::reverse);
                transposed(&values, nx, sorted)
            }
            Order::ColumnsUpwards => {
                values.chunks_mut(ny).for_each(<[f64]>::reverse);
                sorted.end();
                values
            }
            Order::ColumnsUpwardsFromRight => {
                values.reverse();
                sorted.end();
                values
            }
        })
    }
}

/// The channels of a file, one of them chosen.
pub(super) struct Channels {
    all: Vec<Channel>,
    chosen: usize,
}

impl Channels {
    /// Chooses the channel `wanted`, else that of the heights.
    pub(super) fn choose(mut all: Vec<Channel>, wanted: Option<&str>) -> Result<Self, ReadError> {
        number_equal_names(&mut all);
        let names = || all.iter().map(|channel| channel.listed().to_string()).collect::<Vec<_>>().join(", ");
        let Some(nearest) = (0..all.len()).min_by_key(|&k| all[k].distance()) else {
            return Err(unsupported!("holds no map of heights"));
        };
        let refused = |reason: String| Err(ReadError::Channel { reason, found: names() });
        let chosen = match wanted.map(|wanted| (wanted, named(&all, wanted.trim()))) {
            None => nearest,
            Some((_, Some(found))) => found,
            Some((wanted, None)) => return refused(format!("holds no channel \"{wanted}\"")),
        };
        match &all[chosen].quantity {
            Quantity::Other(unit) if wanted.is_some() => {
                refused(format!("holds \"{}\" in {unit}, which is no height", all[chosen].name))
            }
            Quantity::Other(_) => Err(unsupported!("holds no channel of heights; found: {}", names())),
            Quantity::Length | Quantity::Unknown => Ok(Self { all, chosen }),
        }
    }

    /// Size, pixel and channel, checked against the length of the file.
    pub(super) fn metadata(&self, source: &Source, format: &'static str) -> Result<Metadata, ReadError> {
        let channel = &self.all[self.chosen];
        let points = channel.check(source)?;
        let others = self.all.iter().enumerate().filter(|(k, _)| *k != self.chosen).map(|(_, other)| other);
        Ok(Metadata {
            pixel: channel.pixel,
            pixel_has_unit: true,
            has_unit: channel.quantity == Quantity::Length,
            stated: channel.stated,
            channel: Some(ChannelName {
                name: channel.name.clone(),
                others: others.map(Channel::listed).collect(),
            }),
            ..Metadata::new(points, format)
        })
    }

    /// The map.
    pub(super) fn measured(&self, source: &Source, format: &'static str) -> Result<Measured, ReadError> {
        let channel = &self.all[self.chosen];
        let metadata = self.metadata(source, format)?;
        let heights = channel.heights(source)?;
        let kind = match &channel.numbers {
            Numbers::Stored(stored) => stored.kind,
            Numbers::Packed(kind, _) => *kind,
        };
        let precision = if channel.factor == 1.0 { kind.precision() } else { kind.scaled_precision() };
        Ok(Measured { metadata, heights, scale: channel.factor, offset: channel.offset, precision })
    }
}

/// The channel of a name, its letters large or small where no other has just these.
fn named(all: &[Channel], wanted: &str) -> Option<usize> {
    let exact = all.iter().position(|channel| channel.name == wanted);
    exact.or_else(|| all.iter().position(|channel| channel.name.eq_ignore_ascii_case(wanted)))
}

/// Makes the names of channels differ: "Height", "Height (2)".
fn number_equal_names(all: &mut [Channel]) {
    let mut counts: HashMap<String, usize> = HashMap::new();
    for channel in all {
        let name = channel.name.clone();
        while counts.contains_key(&channel.name) {
            let count = counts.entry(name.clone()).or_default();
            *count += 1;
            channel.name = format!("{name} ({count})");
        }
        counts.insert(channel.name.clone(), 1);
    }
}

/// A unit of length as instruments write it, m; "A" is the ampere.
pub(super) fn length(unit: &str) -> Option<f64> {
    Dimension::Length.factor(&unit.replace('~', "u"))
}
