//! A file of heights and all that is said of it, with the rectangular part that is used.

use std::ops::Range;
use std::path::{Path, PathBuf};

use super::content::{Measured, Metadata, ReadOptions, transposed};
use super::error::{MAX_HEIGHT, ReadError};
use super::marks::{Extremes, mark_missing};
use super::npy::MapOnDisk;
use super::source::Source;
use super::{Channel, Channels, Format, Reader, npy, text};
use crate::npy::{Header, NpyError, OnDisk};
use crate::numeric::LARGEST;
use crate::progress::{Count, Progress, Share, Silent};
use crate::topography::{HeightMap, MapError, Rows, Watched, Window, rows};

/// What marks missing points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Marks {
    /// Heights, in the unit of the file (of X3P and SDF: in metres; of instruments: as stored).
    pub heights: Vec<f64>,
    /// Words of a text.
    pub words: Vec<String>,
}

/// A file of heights and how it is read.
#[derive(Debug, Clone, PartialEq)]
pub struct MapFile {
    /// Where it is.
    pub path: PathBuf,
    /// What the file does not state, or states wrongly.
    pub options: ReadOptions,
    /// What marks missing points. Where there is none stated, or others than these, a height far from all others is an error; none at all says
    /// that all are heights.
    pub missing: Option<Marks>,
    /// Whether x and y are exchanged: a pixel of the options is that of the map with x and y exchanged.
    pub transpose: bool,
    /// The part that is used of the map, with x and y exchanged where they are.
    pub crop: Crop,
    /// The channel of a file that holds several, as the file names it; that of the heights if not given.
    pub channel: Option<String>,
}

impl MapFile {
    /// A file that is read as it is.
    pub fn new(path: &Path, options: ReadOptions) -> Self {
        Self {
            path: path.to_owned(),
            options,
            missing: None,
            transpose: false,
            crop: Crop::default(),
            channel: None,
        }
    }

    /// Size, pixel and format of the map, see [`metadata`](super::metadata).
    ///
    /// # Errors
    /// As [`metadata`](super::metadata).
    pub fn metadata(&self) -> Result<Metadata, ReadError> {
        self.watched_metadata(&Silent)
    }

    /// [`Self::metadata`] with progress: a unit of work at most, of a text.
    ///
    /// # Errors
    /// As [`metadata`](super::metadata).
    pub fn watched_metadata(&self, progress: &dyn Progress) -> Result<Metadata, ReadError> {
        let (source, format) = self.open(progress)?;
        let metadata = match &format.read {
            Reader::Map { metadata, .. } => metadata(&source)?,
            Reader::Channels(channels) => self.choose(channels(&source)?)?.metadata(&source, format.name)?,
        };
        let whole = self.turned(metadata);
        // Without a pixel, which is then asked for, there is no part.
        let (false, Ok(pixel)) = (self.crop.is_whole(), whole.pixel(&self.options)) else { return Ok(whole) };
        let points = self.crop.ranges(whole.points, pixel)?.map(|range| range.len());
        let read = if self.is_array_of_rows()? { points[0] * points[1] } else { whole.read };
        Ok(Metadata { points, read, ..whole })
    }

    /// The map as stored.
    fn measured(&self, progress: &dyn Progress) -> Result<Measured, ReadError> {
        let (source, format) = self.open(progress)?;
        match &format.read {
            Reader::Map { measured, .. } => measured(&source),
            Reader::Channels(channels) => self.choose(channels(&source)?)?.measured(&source, format.name),
        }
    }

    fn open<'a>(&self, progress: &'a dyn Progress) -> Result<(Source<'a>, &'static Format), ReadError> {
        let mut source = Source::open(&self.path, progress)?;
        let format = Format::detect(&source)?;
        source.missing = self.missing.as_ref().map(|marks| marks.words.clone()).unwrap_or_default();
        match &format.read {
            _ if !source.missing.is_empty() && format.name != text::NAME => {
                Err(ReadError::NoWords { format: format.name })
            }
            Reader::Map { .. } if self.channel.is_some() => {
                Err(ReadError::NoChannels { format: format.name })
            }
            _ => Ok((source, format)),
        }
    }

    fn choose(&self, all: Vec<Channel>) -> Result<Channels, ReadError> {
        Channels::choose(all, self.channel.as_deref())
    }

    fn turned(&self, metadata: Metadata) -> Metadata {
        if self.transpose { metadata.transposed() } else { metadata }
    }

    fn marks(&self) -> &[f64] {
        self.missing.as_ref().map(|marks| &*marks.heights).unwrap_or_default()
    }

    /// Reads the map of heights in metres, relative to the offset of its file ([`Rows::offset`]).
    ///
    /// # Errors
    /// See [`ReadError`].
    pub fn height_map(&self) -> Result<HeightMap, ReadError> {
        self.watched_height_map(&Silent)
    }

    /// [`Self::height_map`] with progress: one unit of work.
    ///
    /// # Errors
    /// See [`ReadError`].
    pub fn watched_height_map(&self, progress: &dyn Progress) -> Result<HeightMap, ReadError> {
        /// The part of the work that checks of the heights are.
        const OF_CHECKS: f64 = 0.1;
        let reading = Share { progress, units: 1.0 - OF_CHECKS };
        let Measured { metadata, mut heights, scale, offset, mut precision } = self.measured(&reading)?;
        if self.transpose {
            heights = transposed(&heights, metadata.points[1], Count::new(progress, 0.0, heights.len()));
        }
        let metadata = self.turned(metadata);
        let pixel = metadata.pixel(&self.options)?;
        let ranges = self.crop.ranges(metadata.points, pixel)?;
        let points = [0, 1].map(|axis| ranges[axis].len());
        if points != metadata.points {
            heights = part(&heights, metadata.points[1], &ranges);
        }
        let unit = metadata.units(&self.options)?.z;
        if unit != 1.0 {
            precision = precision.max(f64::EPSILON);
        }
        let marks: Vec<f64> = self.marks().iter().map(|mark| mark * scale).collect();
        let count = Count::new(progress, OF_CHECKS, heights.len());
        self.check_heights(&mut heights, &marks, [unit, scale], metadata.has_unit, count)?;
        Ok(HeightMap::new(points, pixel, heights, precision)?.with_offset(offset * unit))
    }

    /// Whether [`rows`](Self::rows) leaves the map on disk: a `.npy` in C order that is neither transposed nor cut.
    ///
    /// # Errors
    /// As [`metadata`](Self::metadata).
    pub fn stays_on_disk(&self) -> Result<bool, ReadError> {
        Ok(self.crop.is_whole() && self.is_array_of_rows()?)
    }

    /// Whether rows of the map are rows of its file: of a `.npy` in C order that is not transposed.
    fn is_array_of_rows(&self) -> Result<bool, ReadError> {
        let (_, format) = self.open(&Silent)?;
        Ok(format.name == npy::NAME && !self.transpose && !Header::read(&self.path)?.is_fortran())
    }

    /// Opens the map for reading by rows. One that [stays on disk](Self::stays_on_disk) may be larger than memory; its
    /// heights are checked. Either is one unit of work for `progress`.
    ///
    /// # Errors
    /// As [`height_map`](Self::height_map).
    pub fn rows(&self, progress: &dyn Progress) -> Result<Box<dyn Rows>, ReadError> {
        let map = self.unchecked_rows(progress)?;
        if self.is_array_of_rows()? {
            self.check_rows(&Watched { map: &*map, progress })?;
        }
        Ok(map)
    }

    /// The same without reading the heights of a map that stays on disk: of one that is read in parts, which are checked
    /// with [`check_rows`](Self::check_rows) each. Another one is a unit of work for `progress`.
    ///
    /// # Errors
    /// As [`height_map`](Self::height_map).
    pub fn unchecked_rows(&self, progress: &dyn Progress) -> Result<Box<dyn Rows>, ReadError> {
        if !self.is_array_of_rows()? {
            return Ok(Box::new(self.watched_height_map(progress)?));
        }
        let metadata = self.metadata()?;
        let (pixel, unit) = (metadata.pixel(&self.options)?, metadata.units(&self.options)?.z);
        let map = MapOnDisk::new(OnDisk::open(&self.path)?, pixel, unit, self.marks().to_vec());
        if self.crop.is_whole() {
            return Ok(Box::new(map));
        }
        let [xs, ys] = self.crop.ranges(map.points(), pixel)?;
        let window = Window { map: &map, first: [xs.start, ys.start], points: [xs.len(), ys.len()] };
        let part = HeightMap::from_rows(&window);
        if map.is_whole() { Ok(Box::new(part)) } else { Err(NpyError::Shortened.into()) }
    }

    /// Checks size, units and heights of the map, or of a part of it, that was read row by row.
    ///
    /// # Errors
    /// As [`height_map`](Self::height_map); [`MapError::AllMissing`] without a single height.
    pub fn check_rows(&self, map: &dyn Rows) -> Result<(), ReadError> {
        HeightMap::check_grid(map.points(), map.pixel())?;
        let extremes = |strip: rows::Strip| {
            Extremes::new((0..strip.count as isize).filter_map(|k| strip.row(k)).flatten())
        };
        let all = rows::strips(map, 0, extremes).into_iter().fold(Extremes::NONE, Extremes::joined);
        if !map.is_whole() {
            return Err(NpyError::Shortened.into());
        }
        let Some(tallest) = all.tallest() else { return Err(MapError::AllMissing.into()) };
        let unit = self.options.unit.map_or(1.0, |units| units.z);
        self.check_extremes(all, unit)?;
        if tallest > MAX_HEIGHT { Err(ReadError::TooTall { tallest }) } else { Ok(()) }
    }

    /// Replaces `marks` of missing points, and those that the format has, by NaN, converts heights from the `unit` of their file to metres,
    /// and rejects those too large for a rough surface.
    fn check_heights(
        &self,
        heights: &mut [f64],
        marks: &[f64],
        [unit, scale]: [f64; 2],
        has_unit: bool,
        count: Count,
    ) -> Result<(), ReadError> {
        /// A larger height in metres marks a missing point, such as 1e10.
        const MARK: f64 = 1e3;
        let mark = if has_unit { MARK / unit } else { LARGEST };
        let mut all = Extremes::NONE;
        count.pieces(heights, |piece| {
            mark_missing(piece, marks);
            for z in &mut *piece {
                *z = if z.abs() <= mark { *z * unit } else { f64::NAN };
            }
            all = all.joined(Extremes::new(&*piece));
            Ok::<_, ReadError>(())
        })?;
        self.check_extremes(all, unit * scale)?;
        match all.tallest() {
            Some(tallest) if tallest > MAX_HEIGHT => Err(ReadError::TooTall { tallest }),
            _ => Ok(()),
        }
    }

    /// Rejects a mark of missing points that is not stated; `unit` is that of the heights in the file, m.
    fn check_extremes(&self, all: Extremes, unit: f64) -> Result<(), ReadError> {
        match all.mark(unit).filter(|_| self.missing != Some(Marks::default())) {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }
}

/// A part of a map by lengths from its first point, m: points at `from <= x < to`, so that the part is as long as its ends are
/// apart. `None` along an axis that is not cut.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Crop {
    /// Ends along x.
    pub x: Option<[f64; 2]>,
    /// Ends along y.
    pub y: Option<[f64; 2]>,
}

impl Crop {
    /// Whether nothing is cut off.
    pub fn is_whole(&self) -> bool {
        *self == Self::default()
    }

    /// The indices along x and y of the points of the part.
    ///
    /// # Errors
    /// Ends beyond the map or in descending order; fewer than three points between them.
    pub fn ranges(&self, points: [usize; 2], pixel: [f64; 2]) -> Result<[Range<usize>; 2], ReadError> {
        /// Of a pixel, by which a length that is a multiple of it may miss it.
        const ROUNDING: f64 = 1e-6;
        let range = |axis: usize, ends: Option<[f64; 2]>| {
            let Some(ends) = ends else { return Ok(0..points[axis]) };
            let [first, end] = ends.map(|length| (length / pixel[axis] - ROUNDING).ceil());
            if first >= 0.0 && end - first >= 3.0 && end <= points[axis] as f64 {
                Ok(first as usize..end as usize)
            } else {
                let side = points[axis] as f64 * pixel[axis];
                Err(ReadError::Crop { axis: ["x", "y"][axis], ends, side, pixel: pixel[axis] })
            }
        };
        Ok([range(0, self.x)?, range(1, self.y)?])
    }
}

/// The heights of a part of a map of `ny` points along y.
pub(super) fn part(heights: &[f64], ny: usize, [xs, ys]: &[Range<usize>; 2]) -> Vec<f64> {
    xs.clone().flat_map(|ix| &heights[ix * ny..][ys.clone()]).copied().collect()
}
